"""The same rays through real rtrace and through gtrace: TAP. What test/peer/*.py of that kind share; they hold the cases.

Radiance is asked for its converged answer: direct light with -dj 1, so that each shadow ray goes to a random point of its
part of the light and the lobe is not widened by the light's size; specular light with so many samples (-ss) that stopping
after a fixed number of accepted ones does not bias the mean; ambient light without interpolation (-aa 0), without
supersampling. Only -u+ is unbiased where paths have two random bounces (-u- is off by 0.2 % in the box). Each ray is traced many
times within one run, which gives Radiance's mean and its standard error; gtrace gives its own error with -ove.

Two mistakes of Radiance 6.0a are kept out. Its Fresnel estimate of mirrors subtracts 0.00202943064 where exp(-5.85) =
0.00287989916 makes it vanish at normal incidence, as 6.1a does; the constant is replaced in a copy of the program. And with
-ss above 1 a single sample that meets a `light` blackens all samples of its hit (m_light clears the coefficient that they
share); where a lobe may see both a light and something else, Radiance traces the lights and the rest as scenes of their own,
whose radiances add up.

Three results a case: every ray agrees within 4.5 standard errors; the mean square of the normalised differences is that of
independent errors as large as both sides say; the sums over all rays agree within 4 standard errors and 0.5 %. Student's t
of the few repetitions is turned into a normal deviate first (Wallace's approximation).

A scene is given by the names of files in test/peer/scenes, or as text of several lines, where FOLDER is
one for its files. test/peer/NAME.py [CASE...] runs the cases
named. GRAZE_PEER_SEED sets the seed of both sides (1)."""

import os
import re
import struct
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from threading import Lock

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
PEER_TESTS = os.path.join(os.path.dirname(HERE), "peer")
SCENES = os.path.join(PEER_TESTS, "scenes")
BIN = os.environ["BIN"]
PEER = os.environ["GRAZE_PEER_BIN"]
SEED = os.environ.get("GRAZE_PEER_SEED", "1")

CONVERGED = "-u+ -dj 1 -ds .01 -dt 0 -dc 1 -dr 0 -st 0 -lw 1e-6 -lr -12 -aa 0 -as 0".split()
# What many scenes stand on.
FLOOR = "void plastic matte 0 0 5 .5 .4 .3 0 0\nmatte polygon floor 0 0 12 -4 -4 0 4 -4 0 4 4 0 -4 4 0\n"


def run(command, data, **environment):
    done = subprocess.run(command, input=data, capture_output=True, cwd=SCENES, env={**os.environ, **environment})
    # A scene of glows has none of what Radiance calls light sources; and it does not always hit its thinnest cylinders.
    errors = done.stderr.decode(errors="replace")
    errors = re.sub('rtrace: warning - (no light sources found|aiming failure for light source ".*")\n', "", errors)
    if done.returncode != 0 or errors:
        raise RuntimeError(f"{' '.join(command)}: status {done.returncode}: {errors[:2000]}")
    return done.stdout


class Radiance:
    """Real oconv and rtrace, with a clock that stands still and the right Fresnel constant."""

    def __init__(self, folder):
        self.folder, self.written, self.lock = folder, {}, Lock()
        clock = os.path.join(folder, "repeatable.so")
        subprocess.run(["cc", "-shared", "-fPIC", "-o", clock, os.path.join(PEER_TESTS, "repeatable.c")], check=True)
        self.rtrace = os.path.join(folder, "rtrace")
        with open(os.path.join(PEER, "rtrace"), "rb") as file:
            program = file.read()
        # For the view c itself is in the program, for lights 1 + c.
        for wrong, right in [(0.00202943064, 0.00287989916), (1.00202943064, 1.00287989916)]:
            wrong, right = struct.pack("<d", wrong), struct.pack("<d", right)
            if program.count(wrong) == 1 and program.count(right) == 0:
                program = program.replace(wrong, right)
        with open(self.rtrace, "wb") as file:
            file.write(program)
        os.chmod(self.rtrace, 0o755)
        self.environment = {
            "PATH": PEER + ":" + os.environ["PATH"],
            "RAYPATH": ".:" + os.environ["GRAZE_PEER_RAYPATH"],
            "LD_PRELOAD": clock,
            "GRAZE_PEER_SEED": SEED,
        }

    def files(self, scenes):
        """Paths of what a scene consists of."""
        if "\n" not in scenes:
            return [name + ".rad" for name in scenes.split()]
        with self.lock:
            if scenes not in self.written:
                self.written[scenes] = os.path.join(self.folder, f"scene{len(self.written)}.rad")
                with open(self.written[scenes], "w") as file:
                    file.write(scenes.replace("FOLDER", self.folder))
            return [self.written[scenes]]

    def octree(self, scenes, *options):
        tools = {name: self.environment[name] for name in ("PATH", "RAYPATH")}
        with tempfile.NamedTemporaryFile(dir=self.folder, suffix=".oct", delete=False) as file:
            file.write(run(["oconv", *options, *self.files(scenes)], b"", **tools))
        return file.name

    def trace(self, scenes, options, data):
        return run([self.rtrace, "-h", *options, self.octree(scenes)], data, **self.environment)


def gtrace(files, options, data, **environment):
    return run([os.path.join(BIN, "gtrace"), "-h", *options, *files], data, **environment)


def standard_normal(t, freedom):
    """The normal deviate as improbable as Student's t (Wallace 1959)."""
    size = (8 * freedom + 1) / (8 * freedom + 3) * np.sqrt(freedom * np.log1p(t * t / freedom))
    return np.copysign(size, t)


class Case:
    """Radiance traces each of `parts`, whose light adds up to the scene's, with `repeat` repetitions. `octree` are oconv's options
    where gtrace shall read an octree, too; where there are `commands` in the scene it finds Radiance's programs. gtrace's samples are
    divided among `own_repeat` repetitions: all of them where a choice between two things is drawn, of which stratified numbers may
    draw the same part every time but the rarest."""

    def __init__(self, name, scene, rays, options, peer_options="", repeat=64, samples=4096, parts=None, own_options="", letter="v",
                 octree=None, commands=False, own_repeat=32):
        self.name, self.scene, self.parts, self.rays = name, scene, parts or [scene], np.asarray(rays, "<f4")
        self.options, self.peer_options, self.own_options = options.split(), peer_options.split(), own_options.split()
        self.repeat, self.samples, self.letter = repeat, samples, letter
        self.octree, self.commands, self.own_repeat = octree, commands, own_repeat

    def files(self, radiance):
        return radiance.files(self.scene) if self.octree is None else [radiance.octree(self.scene, *self.octree.split())]

    def environment(self, radiance):
        return {name: radiance.environment[name] for name in ("PATH", "RAYPATH")} if self.commands else {}

    def radiance(self, radiance):
        data = np.repeat(self.rays, self.repeat, axis=0).tobytes()
        options = [*CONVERGED, *self.options, *self.peer_options, "-ff", "-o" + self.letter]
        parts = [np.frombuffer(radiance.trace(part, options, data), "<f4") for part in self.parts]
        values = sum(part.reshape(len(self.rays), self.repeat, 3).astype(float) for part in parts)
        return values.mean(1), values.std(1, ddof=1) / np.sqrt(self.repeat), self.repeat - 1

    def graze(self, radiance):
        # Independent estimates, whose scatter is known better than the error they state: where light is smooth that is too large,
        # and letters other than v have none.
        repeat = self.own_repeat
        data = np.repeat(self.rays, repeat, axis=0).tobytes()
        letters = "ve" if self.letter == "v" else self.letter
        options = [*self.options, *self.own_options, "--samples", str(self.samples // repeat), "--seed", SEED, "-o" + letters, "-ff"]
        answers = np.frombuffer(gtrace(self.files(radiance), options, data, **self.environment(radiance)), "<f4").reshape(len(self.rays), repeat, -1, 3).astype(float)
        values, stated = answers[:, :, 0], answers[:, :, -1]
        scatter = values.std(1, ddof=1)
        if self.letter == "v":
            # A choice between two things that are known, by stratified numbers, falls out alike almost always: that there is no
            # scatter then tells nothing.
            scatter = np.where(scatter > 0, scatter, np.sqrt((stated**2).mean(1)))
        return values.mean(1), scatter / np.sqrt(repeat), repeat - 1

    def results(self, radiance):
        r, r_error, r_freedom = self.radiance(radiance)
        g, g_error, g_freedom = self.graze(radiance)
        variance = r_error**2 + g_error**2
        # Welch and Satterthwaite's degrees of freedom of the difference.
        with np.errstate(divide="ignore", invalid="ignore"):
            freedom = variance**2 / (r_error**4 / r_freedom + g_error**4 / g_freedom)
        freedom = np.where(np.isfinite(freedom), freedom, min(r_freedom, g_freedom))
        # rtrace computes colours in single precision, and leaves out what a colour has less of than a millionth.
        largest = np.maximum(abs(r), abs(g))
        sigma = np.sqrt(variance + (1e-5 * largest + 1e-6 * largest.max(1, keepdims=True)) ** 2)
        t = np.divide(g - r, sigma, out=np.zeros_like(r), where=sigma > 0)
        z = standard_normal(t, freedom)
        notes = [f"{len(r)} rays, mean radiance {r.mean(0).round(6)}, median relative error of rtrace "
                 f"{np.median(r_error[r > 0] / r[r > 0]):.1e}, of gtrace {np.median(g_error[g > 0] / g[g > 0]):.1e}"]

        worst = np.unravel_index(np.argmax(abs(z)), z.shape)
        notes.append(f"worst ray {worst[0]} channel {worst[1]}: rtrace {r[worst]:.6g} +- {r_error[worst]:.2g}, "
                     f"gtrace {g[worst]:.6g} +- {g_error[worst]:.2g}, z = {z[worst]:.2f}, ray {self.rays[worst[0]]}")
        wrong = np.flatnonzero((~np.isfinite(g) | (abs(z) > 4.5)).any(1))
        if len(wrong):
            notes.append(f"{len(wrong)} rays disagree: {' '.join(map(str, wrong[:40]))}")
        every = len(wrong) == 0

        # One value a ray: its channels share their random numbers. Rays that both sides know exactly say nothing here.
        random = variance.sum(1) > 1e-9 * (r**2).sum(1)
        square = (z**2).mean(1)[random]
        spread = 4.5 * np.sqrt(2 / max(len(square), 1))
        notes.append(f"mean square of z {square.mean() if len(square) else 1:.3f} (1 +- {spread:.2f})")
        consistent = len(square) == 0 or abs(square.mean() - 1) < spread

        total, error = (g - r).sum(0), np.sqrt((sigma**2).sum(0))
        bias = total / r.sum(0)
        notes.append(f"sum of all rays: relative difference {np.array2string(bias, precision=6)}, in standard errors "
                     f"{np.array2string(total / error, precision=2)}")
        unbiased = (abs(bias) < 0.005).all() and (abs(total) < 4 * error).all()
        return [(every, "every ray"), (consistent, "spread of the differences"), (unbiased, "sum of all rays")], notes


class Geometry:
    """What rays hit, field by field."""

    def __init__(self, name, scene, rays, fields):
        self.name, self.scene, self.rays, self.fields = name, scene, np.asarray(rays), fields

    def table(self, output):
        return [line.split() for line in output.decode().splitlines()]

    def results(self, radiance):
        data = "".join(" ".join(f"{x:.9g}" for x in ray) + "\n" for ray in self.rays).encode()
        theirs = self.table(radiance.trace(self.scene, ["-faa", "-o" + self.fields], data))
        ours = self.table(gtrace(radiance.files(self.scene), ["-faa", "-o" + self.fields, "--samples", "2"], data))
        wrong = []
        for index, (r, g) in enumerate(zip(theirs, ours)):
            if len(r) != len(g) or not all(self.same(a, b) for a, b in zip(r, g)):
                pairs = [f"{a} {b}" for a, b in zip(r, g) if not self.same(a, b)]
                wrong.append(f"ray {index} {' '.join(r[:6])}: rtrace and gtrace say {', '.join(pairs)}")
        good = not wrong and len(theirs) == len(ours) == len(self.rays)
        hits = len({r[-1] for r in theirs})
        return ([(good, f"-o{self.fields}")],
                [f"{len(self.rays)} rays, {hits} different last fields, {len(wrong)} differ"] + wrong[:8])

    @staticmethod
    def same(a, b):
        try:
            x, y = float(a), float(b)
        except ValueError:
            return a == b
        return abs(x - y) <= 2e-6 * max(abs(x), abs(y), 1)


class Tree:
    """Trace mode: what the surfaces at each depth contribute to each ray, on the average of many trees."""

    def __init__(self, name, scene, rays, options, peer_options, paths, repeat=128):
        self.name, self.scene, self.rays, self.repeat = name, scene, np.asarray(rays), repeat
        self.options, self.peer_options, self.own_options = options.split(), peer_options.split(), ["--samples", str(paths), "--seed", SEED]

    def contributions(self, output):
        """For each ray, (depth, surface) -> its contribution in each tree."""
        tables, tree, number = [{} for _ in self.rays], {}, 0
        for line in output.decode().splitlines():
            depth = len(line) - len(line.lstrip("\t"))
            surface, *value = line.split()
            tree[depth, surface] = tree.get((depth, surface), 0) + float(value[1])
            if depth == 0:
                for key, sum_of_tree in tree.items():
                    tables[number // self.repeat].setdefault(key, []).append(sum_of_tree)
                tree, number = {}, number + 1
        if number != len(self.rays) * self.repeat:
            raise RuntimeError(f"{number} trees, not {len(self.rays) * self.repeat}")
        return tables

    def mean_and_error(self, values):
        values = np.array(values + [0] * (self.repeat - len(values)))
        return values.mean(), values.std(ddof=1) / np.sqrt(self.repeat)

    def results(self, radiance):
        data = "".join(self.repeat * (" ".join(f"{x:.9g}" for x in ray) + "\n") for ray in self.rays).encode()
        theirs = self.contributions(radiance.trace(self.scene, [*CONVERGED, *self.options, *self.peer_options, "-oTsV"], data))
        ours = self.contributions(gtrace(radiance.files(self.scene), [*self.options, *self.own_options, "-oTsV"], data))
        z, worst = [], ("", 0)
        for index, (a, b) in enumerate(zip(theirs, ours)):
            whole = max(np.mean(values) for (depth, _), values in [*a.items(), *b.items()] if depth == 0)
            for key in sorted(a.keys() | b.keys()):
                (r, r_error), (g, g_error) = self.mean_and_error(a.get(key, [])), self.mean_and_error(b.get(key, []))
                if max(r, g) <= 0.01 * whole:
                    continue
                deviation = (g - r) / np.hypot(np.hypot(r_error, g_error), 1e-5 * max(r, g))
                z.append(standard_normal(deviation, self.repeat - 1))
                if abs(z[-1]) > worst[1]:
                    worst = (f"ray {index} depth {key[0]} {key[1]}: rtrace {r:.6g} +- {r_error:.2g}, gtrace {g:.6g} +- {g_error:.2g}", abs(z[-1]))
        depths = {depth for table in theirs for depth, _ in table}
        good = len(z) > 1.5 * len(self.rays) and worst[1] <= 4.5
        return [(good, "every surface at every depth")], [f"{len(z)} contributions from depths {sorted(depths)}", f"worst: {worst[0]}, z = {worst[1]:.2f}"]


def normalized(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def aim(eye, points):
    """Rays from the eye to points."""
    points = np.atleast_2d(points)
    return np.c_[np.broadcast_to(eye, points.shape), normalized(points - eye)]


def grid(low, high, count, generator):
    """Points in a box (flat where low == high), stratified along its two long axes."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    side = int(np.sqrt(count))
    cells = np.stack(np.meshgrid(np.arange(side), np.arange(side), indexing="ij"), -1).reshape(-1, 2)
    unit = np.full((len(cells), 3), 0.5)
    unit[:, np.flatnonzero(high > low)[:2]] = (cells + generator.random((len(cells), 2))) / side
    return low + unit * (high - low)


def sensors(low, high, count, normal, generator):
    points = grid(low, high, count, generator)
    return np.c_[points, np.broadcast_to(normal, points.shape)]


def main(cases):
    if not os.access(os.path.join(BIN, "gtrace"), os.X_OK):
        sys.exit("no gtrace in " + BIN)
    chosen = [case for case in cases if len(sys.argv) == 1 or any(word in case.name for word in sys.argv[1:])]
    number = 0
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        radiance = Radiance(folder)
        for case, future in [(case, pool.submit(case.results, radiance)) for case in chosen]:
            try:
                results, notes = future.result()
            except RuntimeError as error:
                results, notes = [(False, "runs")], str(error).splitlines()
            for good, what in results:
                number += 1
                print(f"{'ok' if good else 'not ok'} {number} - {case.name}: {what}")
            for note in notes:
                print("#", note.replace("\n", " "), flush=True)
    print(f"1..{number}")

