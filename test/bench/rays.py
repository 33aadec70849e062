"""Rays a second of gtrace and of Radiance's rtrace, side by side: direct light only, floats in and out.

Run by `make bench`. Prints medians over alternating runs, with their spread, and how far the answers lie from a reference of
many samples. RUNS (3) in the environment sets how many runs.
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
BOX = """
void plastic wall 0 0 5 .6 .6 .6 0 0
void metal2 shiny 4 1 1 0 . 0 6 .6 .6 .6 .8 .05 .2
void light lamp 0 0 3 10 10 10
wall polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0
wall polygon ceiling 0 0 12 0 4 3 4 4 3 4 0 3 0 0 3
wall polygon south 0 0 12 0 0 0 0 0 3 4 0 3 4 0 0
wall polygon north 0 0 12 4 4 0 4 4 3 0 4 3 0 4 0
wall polygon west 0 0 12 0 4 0 0 4 3 0 0 3 0 0 0
wall polygon east 0 0 12 4 0 0 4 0 3 4 4 3 4 4 0
lamp polygon lamp1 0 0 12 1 1 2.99 1 2 2.99 2 2 2.99 2 1 2.99
lamp polygon lamp2 0 0 12 3 1 2.99 3 2 2.99 3.5 2 2.99 3.5 1 2.99
"""


def spheres():
    places = [(1, 1), (3, 1), (2, 3)]
    return "".join(f"shiny sphere s{i} 0 0 4 {x} {y} .5 .5\n" for i, (x, y) in enumerate(places))


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


def run(command, rays):
    start = time.perf_counter()
    out = subprocess.run(command, stdin=open(rays, "rb"), stdout=subprocess.PIPE, check=True).stdout
    return time.perf_counter() - start, np.frombuffer(out, "f4").reshape(-1, 3)[:, 1].astype(float)


def bench(name, scene_text, folder, count):
    scene, octree, rays = (os.path.join(folder, name + suffix) for suffix in (".rad", ".oct", ".rays"))
    with open(scene, "w") as f:
        f.write(BOX + scene_text)
    with open(octree, "wb") as f:
        subprocess.run([f"{PEER}/oconv", scene], stdout=f, check=True)
    random = np.random.default_rng(1)
    origin = random.uniform([0.1, 0.1, 2.4], [3.9, 3.9, 2.9], (count, 3))
    direction = random.normal(size=(count, 3))
    np.hstack([origin, direction]).astype("f4").tofile(rays)
    empty = rays + ".empty"
    np.zeros((1, 6), "f4").tofile(empty)

    gtrace, rtrace = [f"{BIN}/gtrace", "-h", "-ff"], [f"{PEER}/rtrace", "-h", "-ff"]
    commands = {}
    for threads in (1, os.cpu_count()):
        n = ["-n", str(threads)]
        commands[f"rtrace -n {threads}"] = rtrace + n + [octree]
        commands[f"rtrace -dj 1 -ds .02 -st 0 -n {threads}"] = rtrace + n + ["-dj", "1", "-ds", ".02", "-dt", "0", "-st", "0", octree]
        commands[f"gtrace --samples 2 -n {threads}"] = gtrace + n + ["--samples", "2", scene]
        commands[f"gtrace --samples 16 -n {threads}"] = gtrace + n + ["--samples", "16", scene]
        commands[f"gtrace -n {threads}"] = gtrace + n + [scene]
        commands[f"gtrace -oL -n {threads}"] = gtrace + ["-oLLL"] + n + [scene]
    _, reference = run(gtrace + ["--samples", "2048", "--seed", "9", scene], rays)
    times, starts, values = {c: [] for c in commands}, {c: [] for c in commands}, {}
    for _ in range(RUNS):
        for label, command in commands.items():
            seconds, values[label] = run(command, rays)
            starts[label].append(time_of_start(command, empty))
            times[label].append(seconds)
    print(f"\n{name}: {count} rays; rays a second without the start of the program; error: root mean square over mean")
    for label in commands:
        start = statistics.median(starts[label])
        error = np.sqrt(np.mean((values[label] - reference) ** 2)) / reference.mean()
        seconds = sorted(t - start for t in times[label])
        # A difference of times that are nearly the same says nothing.
        if seconds[0] < 0.02 * start:
            rate = "too fast beside its start"
        else:
            rate = f"{count / statistics.median(seconds):12,.0f}/s  ({count / seconds[-1]:,.0f} .. {count / seconds[0]:,.0f})"
        print(f"  {label:40s} {rate}  start {1000 * start:6.1f} ms" + ("" if "-oL" in label else f"  error {100 * error:6.2f}%"))


def time_of_start(command, empty):
    start = time.perf_counter()
    subprocess.run(command, stdin=open(empty, "rb"), stdout=subprocess.DEVNULL, check=True)
    return time.perf_counter() - start


def main():
    os.environ["RAYPATH"] = PYRADIANCE + "/lib"
    with tempfile.TemporaryDirectory() as folder:
        bench("small", spheres(), folder, 10_000)
        bench("mesh", mesh(), folder, 10_000)


if __name__ == "__main__":
    sys.exit(main())
