"""Rays a second: gtrace beside Radiance's rtrace, beside Embree alone over the very rays that are traced, and on two threads;
and irradiance points at rtrace's own error. Floats in and out.

Run by `make bench BENCH=rays`. What runs on one thread is timed by the processor time of the process, less that of one that
answers a single ray: others on the machine then disturb it least. Two threads are timed by the clock, and need a quiet machine.
Medians over alternating runs. Errors: root mean square over the mean, against many samples. RUNS (3) in the environment sets how
many runs, PARTS (rtrace embree threads points) which parts.

One path a ray (--samples 1) is what an answer of rtrace's at its defaults is to be compared with: it has every light's shadow
rays, and one specular path. Where nothing casts shadows it is exact but for the specular path, by closed forms; rtrace's own
error, beside it, comes from where it puts its shadow rays.
"""

import functools
import glob
import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

BIN = os.environ["BIN"]
EMBREE = os.environ["GRAZE_BENCH_EMBREE"]
PYRADIANCE = glob.glob(os.environ["GRAZE_PEER"] + "/lib/python3*/site-packages/pyradiance")[0]
PEER = PYRADIANCE + "/bin"
RUNS = int(os.environ.get("RUNS", "3"))
PARTS = os.environ.get("PARTS", "rtrace embree threads points").split()
GTRACE, RTRACE = [f"{BIN}/gtrace", "-h", "-ff"], [f"{PEER}/rtrace", "-h", "-ff"]
ONE_PATH = ["--samples", "1"]

WALLS = """
void plastic wall 0 0 5 .6 .6 .6 0 0
void metal2 shiny 4 1 1 0 . 0 6 .6 .6 .6 .8 .05 .2
void light lamp 0 0 3 10 10 10
wall polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0
wall polygon ceiling 0 0 12 0 4 3 4 4 3 4 0 3 0 0 3
wall polygon south 0 0 12 0 0 0 0 0 3 4 0 3 4 0 0
wall polygon north 0 0 12 4 4 0 4 4 3 0 4 3 0 4 0
wall polygon west 0 0 12 0 4 0 0 4 3 0 0 3 0 0 0
wall polygon east 0 0 12 4 0 0 4 0 3 4 4 3 4 4 0
"""


def lamp(name, x0, y0, x1, y1, material="lamp"):
    return f"{material} polygon {name} 0 0 12 {x0} {y0} 2.99 {x0} {y1} 2.99 {x1} {y1} 2.99 {x1} {y0} 2.99\n"


TWO_LAMPS = lamp("lamp1", 1, 1, 2, 2) + lamp("lamp2", 3, 1, 3.5, 2)
PLACES = [(1, 1), (3, 1), (2, 3)]


def spheres(material="shiny"):
    return "".join(f"{material} sphere s{i} 0 0 4 {x} {y} .5 .5\n" for i, (x, y) in enumerate(PLACES))


@functools.cache
def mesh(triangles=100_000):
    """A bumpy ball of about that many triangles in the middle of the box."""
    rings = int((triangles / 4) ** 0.5)
    polar = np.linspace(1e-3, np.pi - 1e-3, rings + 1)
    azimuth = np.linspace(0, 2 * np.pi, 2 * rings, endpoint=False)
    p, a = np.meshgrid(polar, azimuth, indexing="ij")
    radius = 0.9 + 0.05 * np.sin(9 * p) * np.cos(11 * a)
    points = np.stack([radius * np.sin(p) * np.cos(a), radius * np.sin(p) * np.sin(a), radius * np.cos(p)], -1)
    points += [2, 2, 1.4]
    lines = []
    for i in range(rings):
        for j in range(2 * rings):
            k = (j + 1) % (2 * rings)
            corners = points[i, j], points[i + 1, j], points[i + 1, k], points[i, k]
            for t in ((0, 1, 2), (0, 2, 3)):
                numbers = " ".join(f"{v:.9g}" for c in t for v in corners[c])
                lines.append(f"wall polygon m{i}.{j}.{t[1]} 0 0 9 {numbers}\n")
    return "".join(lines)


def outside(points):
    """Which points of the room are in none of the things that scenes put into it."""
    free = np.linalg.norm(points - [2, 2, 1.4], axis=1) > 0.96
    for x, y in PLACES:
        free &= np.linalg.norm(points - [x, y, 0.5], axis=1) > 0.5
    return points[free]


class Bench:
    def __init__(self, folder):
        self.folder = folder
        self.empty = self.path("empty")
        np.zeros((1, 6), "f4").tofile(self.empty)
        random = np.random.default_rng(1)
        origins = outside(random.uniform([0.1, 0.1, 0.1], [3.9, 3.9, 2.9], (300_000, 3)))[:100_000]
        np.hstack([origins, random.normal(size=origins.shape)]).astype("f4").tofile(self.path("rays"))
        self.rays, self.few = self.path("rays"), self.path("few")
        np.fromfile(self.rays, "f4")[: 6 * 5000].tofile(self.few)
        self.many = self.path("many")  # for what the clock is to tell
        np.tile(np.fromfile(self.rays, "f4"), 8).tofile(self.many)

    def path(self, name):
        return os.path.join(self.folder, name)

    def scene(self, name, text, walls=WALLS):
        path = self.path(name + ".rad")
        if not os.path.exists(path):
            with open(path, "w") as f:
                f.write(walls + text)
        return path

    def octree(self, scene):
        path = scene + ".oct"
        if not os.path.exists(path):
            with open(path, "wb") as f:
                subprocess.run([f"{PEER}/oconv", scene], stdout=f, check=True)
        return path

    def points(self, count):
        """Points on the floor and walls, with their normals."""
        path = self.path(f"points{count}")
        random = np.random.default_rng(2)
        records = []
        for a, b, face in zip(random.uniform(0.1, 0.9, count), random.uniform(0.1, 0.9, count), random.integers(5, size=count)):
            records.append([(4 * a, 4 * b, 0, 0, 0, 1), (4 * a, 0, 3 * b, 0, 1, 0), (4 * a, 4, 3 * b, 0, -1, 0),
                            (0, 4 * a, 3 * b, 1, 0, 0), (4, 4 * a, 3 * b, -1, 0, 0)][face])
        np.array(records, "f4").tofile(path)
        np.tile(np.array(records, "f4"), (8, 1)).tofile(path + "x8")
        return path

    def one(self, command, rays, clock):
        """Seconds, and the green channel of the answers."""
        answers = self.path("answers")
        with open(rays, "rb") as source, open(answers, "wb") as sink:
            start = time.perf_counter()
            process = subprocess.Popen(command, stdin=source, stdout=sink)
            _, status, usage = os.wait4(process.pid, 0)
            elapsed = time.perf_counter() - start
        if status:
            sys.exit(f"rays.py: {command[0]} failed")
        values = np.fromfile(answers, "f4").reshape(-1, 3)[:, 1].astype(float)
        return (elapsed if clock else usage.ru_utime + usage.ru_stime), values

    def measure(self, commands, rays, clock=False, often=(), many=None):
        """For each command the median of its seconds without its start, and its answers. What is `often` is asked all the
        rays eight times, lest its start be longer than the rest: those in `many`."""
        times, answers = {c: [] for c in commands}, {}
        for _ in range(RUNS):
            for label, command in commands.items():
                start, _ = self.one(command, self.empty, clock)
                seconds, answers[label] = self.one(command, (many or self.many) if label in often else rays, clock)
                if seconds <= start:
                    sys.exit(f"rays.py: {label} took no longer for the rays than to start")
                times[label].append((seconds - start) / (8 if label in often else 1))
        return {label: (statistics.median(times[label]), answers[label]) for label in commands}

    def answers(self, command, rays):
        return self.one(command, rays, False)[1]


def error(values, reference):
    """Of the first answers, as far as the reference goes."""
    values = values[: len(reference)]
    return float(np.sqrt(np.mean((values - reference) ** 2)) / reference.mean())


def judge(text, value, goal):
    print(f"  {'met   ' if value >= goal else 'MISSED'} {text}: {value:.2f}, goal {goal:g}")


SCENES = {"small": lambda: TWO_LAMPS + spheres(), "mesh": lambda: TWO_LAMPS + mesh()}


def beside_rtrace(b):
    for name, goal in (("small", 8), ("mesh", 20)):
        scene = b.scene(name, SCENES[name]())
        octree = b.octree(scene)
        commands = {
            "rtrace": RTRACE + [octree],
            "rtrace -dj 1 -ds .02 -dt 0 -st 0": RTRACE + ["-dj", "1", "-ds", ".02", "-dt", "0", "-st", "0", octree],
            "gtrace --samples 1": GTRACE + ["-n", "1"] + ONE_PATH + [scene],
            "gtrace --samples 16": GTRACE + ["-n", "1", "--samples", "16", scene],
            "gtrace -oL": GTRACE + ["-n", "1", "-oLLL", scene],
        }
        reference = b.answers(GTRACE + ["--samples", "2048", "--seed", "9", scene], b.few)
        found = b.measure(commands, b.rays, often=("gtrace --samples 1", "gtrace -oL"))
        count = len(found["rtrace"][1])
        print(f"\n{name}: {count} rays, one thread", flush=True)
        for label, (seconds, values) in found.items():
            shown = "" if "-oL" in label else f"  error {100 * error(values, reference):6.2f}%"
            print(f"  {label:36s} {count / seconds:12,.0f} rays/s{shown}")
        seconds = found["rtrace"][0]
        ours = found["gtrace --samples 1"][0]
        constants = [error(v, reference) ** 2 * t for t, v in (found["rtrace"], found["gtrace --samples 16"])]
        print(f"  time for the same error, rtrace's over gtrace's: {constants[0] / constants[1]:.1f}")
        judge("times rtrace's rays a second", seconds / ours, goal)


def beside_embree(b):
    for name, text in (("small", SCENES["small"]), ("mesh", SCENES["mesh"]), ("million", lambda: TWO_LAMPS + mesh(1_000_000))):
        scene = b.scene(name, text())
        lines = subprocess.run([EMBREE, scene, b.rays], stdout=subprocess.PIPE, check=True, text=True).stdout.splitlines()
        rates, counts = {}, {}
        for line in lines:
            words = line.split()
            label = " ".join(words[:2])
            counts[label], rates[label] = int(words[2]), float(words[-2])
        command = {"gtrace": GTRACE + ["-n", "1"] + ONE_PATH + [scene]}
        seconds, values = b.measure(command, b.rays, often=command)["gtrace"]
        values = values[: len(values) // 8]
        print(f"\n{name}: rays traced, million a second, one thread")
        print(f"  {'':10s} {'Embree':>8s} {'geometry':>8s}")
        for kind in ("first", "shadow", "all"):
            print(f"  {kind:10s} {rates['embree ' + kind]:8.2f} {rates['geometry ' + kind]:8.2f}")
        traced = counts["embree all"] / len(values)
        rate = traced * len(values) / seconds / 1e6
        print(f"  gtrace --samples 1, {traced:.2f} rays traced for each asked: {rate:.2f}")
        judge("geometry's part of Embree's rate", rates["geometry all"] / rates["embree all"], 0.5)
        judge("gtrace's part of Embree's rate, shading and all", rate / rates["embree all"], 0.5)


def two_threads(b):
    print("\ntwo threads: how many times the rays a second of one, by the clock")
    for name in ("small", "mesh"):
        scene = b.scene(name, SCENES[name]())
        for options in (["-oLLL"], ONE_PATH, ["--samples", "16"]):
            commands = {n: GTRACE + ["-n", str(n)] + options + [scene] for n in (1, 2)}
            found = b.measure(commands, b.rays if "16" in options else b.many, clock=True)
            judge(f"{name}, {' '.join(options)}", found[1][0] / found[2][0], 1.8)


def seconds_at_error(trials, wanted):
    """By a straight line through the logarithms."""
    errors, seconds = np.log([e for e, _ in trials]), np.log([t for _, t in trials])
    slope, offset = np.polyfit(errors, seconds, 1)
    return float(np.exp(offset + slope * np.log(wanted)))


def irradiance_points(b):
    options = ["-I", "-ab", "2"]
    for name, count in (("small", 60), ("mesh", 200)):
        scene = b.scene(name, SCENES[name]())
        points = b.points(count)
        reference = b.answers(GTRACE + options + ["--samples", "131072", "--seed", "9", scene], points)
        commands = {"rtrace": RTRACE + options + ["-aa", "0", "-ad", "1024", b.octree(scene)]}
        for samples in (64, 256, 1024):  # rtrace's error lies between those of the first two
            commands[samples] = GTRACE + ["-n", "1"] + options + ["--samples", str(samples), scene]
        found = b.measure(commands, points, often=(64, 256, 1024), many=points + "x8")
        print(f"\n{name}: irradiance points, -I -ab 2, one thread")
        for label, (seconds, values) in found.items():
            shown = label if label == "rtrace" else f"gtrace --samples {label}"
            print(f"  {shown:24s} {count / seconds:10,.1f} points/s  error {100 * error(values, reference):5.2f}%")
        seconds, values = found.pop("rtrace")
        wanted = error(values, reference)
        ours = seconds_at_error([(error(v, reference), t) for t, v in found.values()], wanted)
        judge(f"times rtrace's points a second at its error, {count / ours:,.0f}/s", seconds / ours, 20)


def main():
    os.environ["RAYPATH"] = PYRADIANCE + "/lib"
    parts = {"rtrace": beside_rtrace, "embree": beside_embree, "threads": two_threads, "points": irradiance_points}
    with tempfile.TemporaryDirectory() as folder:
        b = Bench(folder)
        for part in PARTS:
            parts[part](b)


if __name__ == "__main__":
    sys.exit(main())
