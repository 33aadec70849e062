"""Time for equal error: pictures by gpict and by Radiance's rtrace, side by side, over the scenes in scenes/bench.

Run by `make bench BENCH=pictures`. Prints a table for each scene and writes time versus error to out/bench/pictures.svg and
.png. References are computed once, in some minutes, and kept in build/bench-cache, by scene, view and settings, not by the
program that computed them: after a change that gives gpict other pictures, not only sooner, remove that folder. RUNS (3) in the
environment sets how many runs, SCENES which scenes (all).

What is compared. Both programs answer for the ray through each pixel's centre, so that their pictures converge to the same
numbers and the edges of objects, which only more rays in a pixel could smooth, say nothing. rpict and rtrace are one renderer;
rtrace takes exactly these rays, writes floats, and runs on all cores: a process a core, each with every so-maniest row, which
serves Radiance better than `rtrace -n`, whose pipe costs more than cheap rays do. Its octree is made beforehand; gpict's time has
all of it, from reading the scene to writing the layers of the EXR file.

The error. With r the reference's and a the answer's luminance, m the mean of r, the relative mean squared error is the mean of
(a - r)^2 / (r^2 + (0.05 m)^2): a dark pixel counts no more than by its part of the picture's mean. Pixels that show lamps or
nothing are left out of it and of m. The error of the reference, known from its two halves, is subtracted. Nobody sees an error of
less than 0.1%: it counts as that, so that pictures which gpict integrates without sampling are not infinitely better. `worst 1%`
is the share in it of the worst pixels, large where fireflies decide; `bias` is that of the picture's mean.

The constant is error x seconds: where errors fall as with independent samples, it does not depend on how many there are.
"""

import functools
import glob
import hashlib
import os
import re
import shlex
import statistics
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from dataclasses import dataclass, field

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
GPICT, GTRACE = os.environ["BIN"] + "/gpict", os.environ["BIN"] + "/gtrace"
PYRADIANCE = glob.glob(os.environ["GRAZE_PEER"] + "/lib/python3*/site-packages/pyradiance")[0]
CACHE, OUT = ROOT + "/build/bench-cache", ROOT + "/out/bench"
RUNS = int(os.environ.get("RUNS", "3"))
CORES = os.cpu_count()

BRIGHTNESS = np.array([0.265, 0.670, 0.065])
FLOOR = 0.05
LEAST_ERROR = 1e-6
# What has a curve of its own, in the order of their colours; not every scene has the last.
KINDS = ("gpict --samples", "gpict --error", "rtrace", "rtrace (glow)")
GOAL, GOAL_OF_OFFICE, GOAL_OF_MEAN = 10, 50, 30


@dataclass
class Scene:
    name: str
    side: int
    reference: int  # samples of each half of the reference
    radiance: list  # settings of rtrace
    limit: str  # those with which it converges
    glow: list = field(default_factory=list)  # settings for the same scene with `glow` in place of `light`
    glow_limit: str = ""
    common: str = ""  # options of both programs
    samples: tuple = (4, 16, 64)
    errors: tuple = (0.1, 0.03)
    goal: float = GOAL


SCENES = [
    Scene(
        "grazing-large", 256, 1024,
        radiance=["", "-ds .05 -dj 0", "-ds .02 -dj 0", "-ds .01 -dj 0", "-ds .005 -dj 0"],
        limit="-ds .002 -dj 1",
        glow=["-ss 16", "-ss 256"],
        glow_limit="-ss 1024",
    ),
    Scene(
        "grazing-small", 256, 1024,
        radiance=["", "-ds .01 -dj 0", "-ds .002 -dj 0", "-ds .001 -dj 0", "-ds .001 -dj 1"],
        limit="-ds .0005 -dj 0",
        glow=["-ss 16", "-ss 256"],
        glow_limit="-ss 1024",
    ),
    Scene(
        "sphere", 256, 1024,
        radiance=["", "-ds .05 -dt 0 -dc 1", "-ds .05 -dj 0 -ss 4 -st 0", "-ds .02 -dj 0 -ss 4 -st 0",
                  "-ds .01 -dj 0 -ss 16 -st 0"],
        limit="-ds .005 -dj 0 -dt 0 -dc 1 -ss 64 -st 0",
    ),
    Scene(
        "office", 128, 2048,
        common="-ab 3",
        radiance=["-aa 0 -ad 16 -as 0 -ss 4 -st 0", "-aa 0 -ad 64 -as 0 -ss 8 -st 0", "-aa 0 -ad 256 -as 0 -ss 16 -st 0",
                  "-aa .3 -ad 256 -as 64 -ss 4 -st 0 -ar 16"],
        limit="-aa 0 -ad 512 -as 0 -ss 32 -st 0",
        goal=GOAL_OF_OFFICE,
    ),
    Scene(
        "hall", 128, 2048,
        radiance=["", "-ss 4 -st 0 -lw 1e-2 -lr -12", "-ss 16 -st 0 -lw 1e-2 -lr -12"],
        limit="-ss 16 -st 0 -dt 0 -dc 1 -lw 1e-3 -lr -12",
    ),
]  # fmt: skip


def read_exr(path):
    """The luminance of a picture: scan lines, compressed by ZIP, of floats only, as gpict writes them."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, at = {}, 8
    while data[at]:
        name, kind, rest = data[at:].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name.decode()] = data[at + 4 : at + 4 + size]
        at += 4 + size
    # After each name come its 0, the type (4 bytes, a float's is 2) and 12 more bytes.
    channels = [c.decode() for c in re.findall(rb"([^\0]+)\0\x02\0{3}.{12}", attributes["channels"], re.DOTALL)]
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    blocks = struct.unpack_from(f"<{(height + 15) // 16}Q", data, at + 1)
    picture = []
    for block in blocks:
        size = struct.unpack_from("<i", data, block + 4)[0]
        stored = data[block + 8 : block + 8 + size]
        rows = min(16, height - 16 * len(picture))
        if size < rows * width * 4 * len(channels):
            # Each byte but the first is its difference to the one before, plus 128; then come the even bytes, then the odd ones.
            differences = np.frombuffer(zlib.decompress(stored), np.uint8).astype(np.int64)
            differences[1:] -= 128
            halves = np.cumsum(differences).astype(np.uint8)
            stored = np.empty_like(halves)
            stored[0::2], stored[1::2] = np.split(halves, [(len(halves) + 1) // 2])
            stored = stored.tobytes()
        picture.append(np.frombuffer(stored, "<f4").reshape(rows, len(channels), width))
    picture = np.concatenate(picture)
    return sum(f * picture[:, channels.index(c)].astype(float) for f, c in zip(BRIGHTNESS, "RGB"))


def run_all(commands):
    """Runs all at once; wall seconds, and processor seconds of all of them."""
    start, cpu = time.perf_counter(), 0
    processes = [subprocess.Popen(command, stdin=stdin, stdout=stdout) for command, stdin, stdout in commands]
    for process in processes:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        cpu += usage.ru_utime + usage.ru_stime
    wall = time.perf_counter() - start
    for process in processes:
        if process.returncode != 0:
            sys.exit(f"failed: {shlex.join(process.args)}")
    return wall, cpu


class Place:
    """A scene, with its lights as `light` or as `glow`, ready for both programs; its pictures and its reference."""

    def __init__(self, scene, folder, glow):
        self.scene, self.glow = scene, glow
        source = f"{ROOT}/scenes/bench/{scene.name}"
        base = f"{folder}/{scene.name}{'-glow' if glow else ''}"
        self.file, self.octree, self.ambient, self.exr = base + ".rad", base + ".oct", base + ".amb", base + ".exr"
        self.view = source + ".vf"
        with open(source + ".rad") as file:
            self.text = file.read()
        if glow:
            self.text = re.sub(r"^void light (\w+) 0 0 3 (.*)$", r"void glow \1 0 0 4 \2 0", self.text, flags=re.MULTILINE)
        with open(self.file, "w") as file:
            file.write(self.text)
        with open(self.octree, "wb") as file:
            subprocess.run(["oconv", self.file], stdout=file, check=True)
        side = str(scene.side)
        vwrays = ["vwrays", "-fd", "-pa", "0", "-x", side, "-y", side, "-vf", self.view]
        rays = subprocess.run(vwrays, stdout=subprocess.PIPE, check=True).stdout
        command = [GTRACE, "-h", "-fda", "-oM", self.file]
        materials = subprocess.run(command, input=rays, stdout=subprocess.PIPE, check=True).stdout.decode().split()
        lamps = re.findall(r"^void (?:light|glow) (\w+)", self.text, flags=re.MULTILINE)
        self.lit = ~np.isin(materials, [*lamps, "*", "void"]).reshape(scene.side, scene.side)
        rays = np.frombuffer(rays, "f8").reshape(scene.side, scene.side, 6)
        self.shares = [f"{base}.{core}.rays" for core in range(CORES)]
        for core, share in enumerate(self.shares):
            rays[core::CORES].tofile(share)

    def gpict(self, settings, seed):
        options = [*shlex.split(self.scene.common), *shlex.split(settings), "--seed", str(seed), "-n", str(CORES), "-w-"]
        side = str(self.scene.side)
        command = [GPICT, *options, "-pj", "0", "-pa", "0", "-x", side, "-y", side, "-vf", self.view, "-o", self.exr, self.file]
        times = run_all([(command, subprocess.DEVNULL, subprocess.DEVNULL)])
        return *times, read_exr(self.exr)

    def rtrace(self, settings):
        options = [*shlex.split(self.scene.common), *shlex.split(settings)]
        if self.scene.common and "-aa 0" not in settings:
            # The processes share what they put into their caches of ambient light, through a file.
            if os.path.exists(self.ambient):
                os.remove(self.ambient)
            options += ["-af", self.ambient]
        command = ["rtrace", "-h", "-w-", "-fdf", *options, self.octree]
        commands = [(command, open(share, "rb"), open(share + ".out", "wb")) for share in self.shares]
        times = run_all(commands)
        picture = np.empty((self.scene.side, self.scene.side))
        for core, (_, stdin, stdout) in enumerate(commands):
            stdin.close()
            stdout.close()
            picture[core::CORES] = np.fromfile(stdout.name, "f4").reshape(-1, self.scene.side, 3) @ BRIGHTNESS
        return *times, picture

    def cached(self, settings, compute):
        """A picture that has been computed before with these settings, or is now."""
        with open(self.view) as view:
            key = repr((self.text, view.read(), self.scene.side, self.scene.common, settings))
        path = f"{CACHE}/{self.scene.name}-{hashlib.sha256(key.encode()).hexdigest()[:16]}.npy"
        if not os.path.exists(path):
            print(f"  computing {settings} of {self.label()} for {CACHE.removeprefix(ROOT + '/')}", flush=True)
            os.makedirs(CACHE, exist_ok=True)
            _, _, picture = compute()
            with open(path + ".new", "wb") as file:
                np.save(file, picture)
            os.rename(path + ".new", path)
        return np.load(path)

    def label(self):
        return f"{self.scene.name} with {'glow' if self.glow else 'light'}"

    @functools.cached_property
    def reference(self):
        settings = f"--samples {self.scene.reference}"
        halves = [self.cached(f"gpict {settings} --seed {s}", lambda s=s: self.gpict(settings, s)) for s in (1001, 1002)]
        return Reference(self.lit, *halves)

    def print_agreement(self):
        """Whether Radiance's own limit is the reference: a wrong scene, view or exposure would show here."""
        settings = self.scene.glow_limit if self.glow else self.scene.limit
        limit = self.cached(f"rtrace {settings}", lambda: self.rtrace(settings))
        error, bias, _ = self.reference.compare(limit)
        print(f"  {'glow' if self.glow else 'light'}: mean of rtrace {settings}: {1 + bias:.4f} of the reference's;"
              f" error between them {root_text(error)}; of the reference {root_text(self.reference.own)}")


class Reference:
    def __init__(self, lit, first, second):
        self.lit = lit
        halves = first[lit], second[lit]
        self.values = (halves[0] + halves[1]) / 2
        self.mean = self.values.mean()
        self.weights = 1 / (self.values**2 + (FLOOR * self.mean) ** 2)
        self.own = np.mean(self.weights * ((halves[0] - halves[1]) / 2) ** 2)

    def compare(self, picture):
        """The relative mean squared error, the bias, and the share of the worst hundredth of the pixels in the error."""
        values = picture[self.lit]
        squares = self.weights * (values - self.values) ** 2
        worst = np.sort(squares)[-(len(squares) // 100) :].sum() / max(squares.sum(), 1e-300)
        return squares.mean() - self.own, values.mean() / self.mean - 1, worst


def root_text(error):
    return f"{100 * error**0.5:.3g}%" if error > 0 else "below the reference's"


class Contender:
    def __init__(self, place, program, settings, kind):
        self.place, self.program, self.settings, self.kind = place, program, settings, kind
        self.walls, self.cpus, self.errors, self.biases, self.worsts = [], [], [], [], []

    def run(self, number):
        if self.program == "gpict":
            wall, cpu, picture = self.place.gpict(self.settings, number)
        else:
            wall, cpu, picture = self.place.rtrace(self.settings)
        values = self.place.reference.compare(picture)
        for name, value in zip((self.walls, self.cpus, self.errors, self.biases, self.worsts), (wall, cpu, *values)):
            name.append(value)

    def finish(self):
        self.wall, self.cpu = statistics.median(self.walls), statistics.median(self.cpus)
        # An error that the reference cannot tell from its own counts as its own.
        self.error = max(statistics.mean(self.errors), self.place.reference.own, LEAST_ERROR)

    def print(self):
        print(f"  {self.program + (' glow ' if self.place.glow else ' ') + (self.settings or '(defaults)'):46s}"
              f" {self.wall:7.2f} {self.cpu:7.2f}  {100 * self.error**.5:8.3g}%  {100 * statistics.mean(self.biases):+8.3f}%"
              f"  {100 * statistics.mean(self.worsts):4.0f}%  {self.error * self.cpu:9.2g} {self.error * self.wall:9.2g}")


def seconds_for(error, contenders):
    """How long gpict takes for the error or less: between the settings that were measured, and as its constants tell beyond."""
    curve = sorted(((c.wall, c.error) for c in contenders), key=lambda point: point[0])
    if error < curve[-1][1]:
        return min(wall * found / error for wall, found in curve)
    for (faster, more), (slower, less) in zip(curve, curve[1:]):
        if less <= error < more:
            part = np.log(more / error) / np.log(more / less)
            return float(np.exp((1 - part) * np.log(faster) + part * np.log(slower)))
    return curve[0][0]


def bench(scene, folder):
    print(f"\n{scene.name}, {scene.side} x {scene.side}{' ' + scene.common if scene.common else ''}")
    places = [Place(scene, folder, glow) for glow in ((False, True) if scene.glow else (False,))]
    for place in places:
        place.print_agreement()
    contenders = [Contender(places[0], "rtrace", s, "rtrace") for s in scene.radiance]
    contenders += [Contender(places[1], "rtrace", s, "rtrace (glow)") for s in scene.glow]
    contenders += [Contender(places[0], "gpict", f"--samples {n}", "gpict --samples") for n in scene.samples]
    contenders += [Contender(places[0], "gpict", f"--error {e}", "gpict --error") for e in scene.errors]
    for number in range(1, RUNS + 1):
        for contender in contenders:
            contender.run(number)
    print(f"  {'':46s}    wall     CPU     error      bias  worst   constant: CPU    wall\n"
          f"  {'':46s} seconds seconds                         1%")
    for contender in contenders:
        contender.finish()
        contender.print()
    return contenders


def ratios(scene, contenders):
    """How many times Graze's time Radiance takes: by the best constants, and for the error of Radiance's best setting."""
    theirs = [c for c in contenders if c.program == "rtrace"]
    ours = [c for c in contenders if c.program == "gpict"]
    best = min(theirs, key=lambda c: c.error * c.wall)
    cpu = min(c.error * c.cpu for c in theirs) / min(c.error * c.cpu for c in ours)
    wall = best.error * best.wall / min(c.error * c.wall for c in ours)
    same = best.wall / seconds_for(best.error, [c for c in ours if c.kind == "gpict --samples"])
    return cpu, wall, same


def draw(results, folder):
    """A panel a scene, a curve a kind; the script reads its data from FOLDER/SCENE.csv."""
    for scene, contenders in results.items():
        with open(f"{folder}/{scene}.csv", "w") as file:
            blocks = []
            for kind in KINDS:
                points = sorted((c.wall, c.error**0.5) for c in contenders if c.kind == kind)
                if points:
                    blocks.append("\n".join([f'"{kind}"'] + [f"{wall},{error}" for wall, error in points]))
            file.write("\n\n\n".join(blocks) + "\n")
    os.makedirs(OUT, exist_ok=True)
    settings = f"data='{folder}'; scenes='{' '.join(results)}'; out='{OUT}/pictures'; here='{ROOT}/figures'"
    subprocess.run(["gnuplot", "-e", settings, f"{ROOT}/test/bench/pictures.gp"], check=True)
    print(f"\ntime versus error: {OUT.removeprefix(ROOT + '/')}/pictures.svg and .png")


def main():
    os.environ["RAYPATH"] = PYRADIANCE + "/lib"
    os.environ["PATH"] = PYRADIANCE + "/bin:" + os.environ["PATH"]
    chosen = os.environ.get("SCENES", "").split()
    scenes = [s for s in SCENES if not chosen or s.name in chosen]
    print(f"pictures: medians of {RUNS} runs on {CORES} cores; error: root of the relative mean squared error; of constants, less"
          " is better")
    with tempfile.TemporaryDirectory() as folder:
        results = {scene.name: bench(scene, folder) for scene in scenes}
        print(f"\n  {'times faster than the best of rtrace':46s}     CPU    wall  at its error")
        walls = []
        for scene in scenes:
            cpu, wall, same = ratios(scene, results[scene.name])
            walls.append(wall)
            print(f"  {scene.name:46s} {cpu:7.2f} {wall:7.2f} {same:8.2f}   goal {scene.goal}: {verdict(wall, scene.goal)}")
        mean = statistics.geometric_mean(walls)
        print(f"  {'geometric mean':46s}         {mean:7.2f}            goal {GOAL_OF_MEAN}: {verdict(mean, GOAL_OF_MEAN)}")
        draw(results, folder)


def verdict(ratio, goal):
    return "met" if ratio >= goal else "MISSED"


if __name__ == "__main__":
    sys.exit(main())
