"""Large scenes read, built and asked for their first ray, beside oconv and rtrace; how that grows with the scene; how long a
small scene takes from the process's start to its answer.

Run by `make bench BENCH=load`, which writes the scenes itself: a million triangles in 115 MB of text, and 100,000 primitives of
mixed kinds. All take turns, and of each the run of the median is shown: processor time, time by the clock, and the most memory.
RUNS (3) in the environment sets how many runs, PARTS (triangles mixed growth start) which parts.
"""

import glob
import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

BIN = os.environ["BIN"]
PYRADIANCE = glob.glob(os.environ["GRAZE_PEER"] + "/lib/python3*/site-packages/pyradiance")[0]
PEER = PYRADIANCE + "/bin"
RUNS = int(os.environ.get("RUNS", "3"))
PARTS = os.environ.get("PARTS", "triangles mixed growth start").split()
RAY = b"0 -5 0.1 0 1 0\n"
HEAD = "void plastic gray 0 0 5 .5 .5 .5 0 0\nvoid light lamp 0 0 3 100 100 100\nlamp sphere bulb 0 0 4 0 0 3 .1\n"
TIMES, MEMORY, START = 8, 1024, 6


def triangles(path, count):
    """Small ones all over a cube; of a million the text has about 115 MB."""
    random = np.random.default_rng(1)
    with open(path, "w") as file:
        file.write(HEAD)
        for start in range(0, count, 10_000):
            n = min(10_000, count - start)
            corners = random.uniform(-1, 1, (n, 1, 3)) + random.uniform(-0.01, 0.01, (n, 3, 3))
            file.write("".join(
                "gray polygon t%d\n0\n0\n9\n %.7f %.7f %.7f\n %.7f %.7f %.7f\n %.7f %.7f %.7f\n" % (start + i, *row)
                for i, row in enumerate(corners.reshape(n, 9).tolist())
            ))


def mixed(path, count):
    """Polygons of 3 to 9 corners, spheres, cylinders, cones and rings in turn."""
    random = np.random.default_rng(2)
    with open(path, "w") as file:
        file.write(HEAD)
        for i in range(count):
            at, size = random.uniform(-1, 1, 3), 0.01 * random.uniform(0.3, 1)
            kind = i % 6
            if kind < 2:
                n = 3 + i // 6 % 7
                angles = 2 * np.pi * np.arange(n) / n
                corners = at + size * np.stack([np.cos(angles), np.sin(angles), 0 * angles], -1)
                name, numbers = "polygon", corners.ravel()
            elif kind == 2:
                name, numbers = "sphere", [*at, size]
            elif kind == 3:
                name, numbers = "cylinder", [*at, *(at + size), size / 3]
            elif kind == 4:
                name, numbers = "cone", [*at, *(at + size), size / 3, size / 5]
            else:
                name, numbers = "ring", [*at, *random.normal(size=3), size / 3, size]
            file.write(f"gray {name} p{i} 0 0 {len(numbers)} {' '.join('%.8g' % x for x in numbers)}\n")


class Run:
    """What a command took: seconds of the processor and by the clock, MiB."""

    def __init__(self, command, data, sink=subprocess.DEVNULL):
        with tempfile.TemporaryFile() as source:
            source.write(data)
            source.seek(0)
            start = time.perf_counter()
            process = subprocess.Popen(command, stdin=source, stdout=sink, stderr=subprocess.DEVNULL)
            _, status, usage = os.wait4(process.pid, 0)
            self.clock = time.perf_counter() - start
        if status:
            sys.exit(f"load.py: {' '.join(command)} failed")
        self.processor = usage.ru_utime + usage.ru_stime
        self.memory = usage.ru_maxrss / 1024

    def __str__(self):
        return f"{self.processor:7.2f} s of processor  {self.clock:7.2f} s  {self.memory:6.0f} MiB"


def median(runs):
    return sorted(runs, key=lambda run: run.processor)[(len(runs) - 1) // 2]


def judge(text, value, goal, most=False):
    good = value <= goal if most else value >= goal
    print(f"  {'met   ' if good else 'MISSED'} {text}: {value:.2f}, goal {'at most ' if most else ''}{goal:g}", flush=True)


def beside_radiance(scene, name):
    print(f"\n{name}: {os.path.getsize(scene) / 1e6:.0f} MB of text, to the first ray's answer")
    octree = scene + ".oct"
    runs = {"oconv": [], "rtrace": [], "gtrace": []}
    for _ in range(RUNS):
        with open(octree, "wb") as sink:
            runs["oconv"].append(Run([f"{PEER}/oconv", scene], b"", sink))
        runs["rtrace"].append(Run([f"{PEER}/rtrace", "-h", "-ab", "0", octree], RAY))
        runs["gtrace"].append(Run([f"{BIN}/gtrace", "-h", "-ab", "0", scene], RAY))
    for command, found in runs.items():
        print(f"  {command:8s} {median(found)}")
    ratios = {
        what: statistics.median(
            (getattr(a, what) + getattr(b, what)) / getattr(c, what) for a, b, c in zip(*runs.values())
        )
        for what in ("processor", "clock")
    }
    judge("times as fast as oconv and rtrace, by the clock", ratios["clock"], TIMES)
    print(f"         and by time of the processor: {ratios['processor']:.2f}")
    judge("MiB", max(run.memory for run in runs["gtrace"]), MEMORY, most=True)


def growth(folder):
    print("\nseconds of processor for each 100,000 triangles")
    for count in (125_000, 250_000, 500_000, 1_000_000):
        scene = os.path.join(folder, f"grown{count}.rad")
        triangles(scene, count)
        run = median([Run([f"{BIN}/gtrace", "-h", "-ab", "0", scene], RAY) for _ in range(RUNS)])
        print(f"  {count:9,d} triangles {run}  {run.processor / count * 1e5:7.3f} s", flush=True)


SMALL = HEAD + """gray polygon floor 0 0 12 -5 -5 0 5 -5 0 5 5 0 -5 5 0
gray sphere ball 0 0 4 1 1 1 .5
gray cylinder pole 0 0 7 -1 1 0 -1 1 1 .2
gray ring disk 0 0 8 0 0 1 0 0 1 0 1
gray cone cone 0 0 8 2 2 0 2 2 1 .3 .1
gray polygon sail 0 0 9 0 0 2 1 0 2 0 1 2
gray sphere other 0 0 4 -2 -2 .5 .5
"""


def start(folder):
    print("\nprocess start to the answer of 10 primitives, milliseconds: least and median of 100")
    scene, octree = os.path.join(folder, "ten.rad"), os.path.join(folder, "ten.oct")
    with open(scene, "w") as file:
        file.write(SMALL)
    with open(octree, "wb") as sink:
        subprocess.run([f"{PEER}/oconv", scene], stdout=sink, check=True)
    commands = {"rtrace": [f"{PEER}/rtrace", "-h", octree], "gtrace": [f"{BIN}/gtrace", "-h", scene]}
    times = {name: [] for name in commands}
    for _ in range(100):
        for name, command in commands.items():
            times[name].append(1e3 * Run(command, RAY).clock)
    for name, found in times.items():
        print(f"  {name:8s} {min(found):6.2f} {statistics.median(found):6.2f}")
    judge("milliseconds at least", min(times["gtrace"]), START, most=True)


def main():
    os.environ["RAYPATH"] = ".:" + PYRADIANCE + "/lib"
    with tempfile.TemporaryDirectory() as folder:
        for part in PARTS:
            scene = os.path.join(folder, part + ".rad")
            if part == "triangles":
                triangles(scene, 1_000_000)
                beside_radiance(scene, "1,000,000 triangles")
            elif part == "mixed":
                mixed(scene, 100_000)
                beside_radiance(scene, "100,000 primitives of mixed kinds")
            else:
                {"growth": growth, "start": start}[part](folder)


main()
