"""What each feature of scenes costs: libraries loaded, work until the first answer, and rays a second, where the scene uses it, where
it only defines it, and where it is absent. What is absent, or defined and used by no surface, must cost nothing.

Run by `make bench BENCH=features`, which prints the table that man/performance shows. All is beside one room with two lights and
three balls of a matte plastic, gtrace on one thread. Work until the first answer is counted in instructions by valgrind, if that
is there: millions more than the room's. Rays a second: --samples 1, as in rays.py, and how many times the room's time a ray takes.
RUNS (3) in the environment sets how many runs, FEATURES some of the rows' first words.
"""

import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy as np

import rays
from rays import GTRACE, ONE_PATH, PEER, TWO_LAMPS, lamp, spheres

PLASTIC = "void plastic wall 0 0 5 .6 .6 .6 0 0\n"
WALLS = PLASTIC + "void light lamp 0 0 3 10 10 10\n" + rays.WALLS[rays.WALLS.index("wall polygon floor") :]
ROOM = WALLS + TWO_LAMPS + spheres("wall")


def pane(material):
    return f"{material} polygon pane 0 0 12 0 0 2 4 0 2 4 4 2 0 4 2\n"


def many_lamps(count):
    side = int(np.ceil(count**0.5))
    places = [(0.2 + 3.6 * (i % side) / side, 0.2 + 3.6 * (i // side) / side) for i in range(count)]
    return "".join(lamp(f"lamp{i}", x, y, x + 1.8 / side, y + 1.8 / side) for i, (x, y) in enumerate(places))


def painted(modifier):
    """The walls and balls with what is called `painted`."""
    return modifier, ROOM.replace(PLASTIC, modifier + "painted" + PLASTIC[4:])


def balls(material):
    """Of that, which is called `ball`."""
    return material, material + WALLS + TWO_LAMPS + spheres("ball")


def beside(definition, surfaces):
    return definition, definition + ROOM + surfaces


def features(folder):
    """(name, what is defined, the scene that uses it, options)"""
    data, octree, mesh = (os.path.join(folder, name) for name in ("values.dat", "part.oct", "part.rtm"))
    noise = "noise3a(9*Px,9*Py,9*Pz)"
    return [
        ("the room", "", ROOM, []),
        ("gloss: metal2", *balls("void metal2 ball 4 1 1 0 . 0 6 .6 .6 .6 .8 .05 .2\n"), []),
        ("mirrors: metal", *balls("void metal ball 0 0 5 .9 .9 .9 1 0\n"), []),
        ("mirrors: mirror", *beside("void mirror silver 0 0 3 .9 .9 .9\n", "silver polygon m 0 0 12 .1 0 1 .1 4 1 .1 4 2 .1 0 2\n"), []),
        ("pattern by a function", *painted("void brightfunc painted 2 if(sin(9*Px)*sin(9*Py),1,.6) . 0 0\n"), []),
        ("pattern by data", *painted(f"void brightdata painted 5 noop {data} . Px Py 0 0\n"), []),
        *((f"pattern by a picture, {kind.upper()}", *painted(f"void colorpict painted 7 red green blue {folder}/picture.{kind} . Px/4 Py/4 0 0\n"), [])
          for kind in ("hdr", "exr", "png")),
        ("texture by a function", *painted(f"void texfunc painted 4 .1*{noise} .1*{noise} .1*{noise} . 0 0\n"), []),
        ("mixture", *balls("void plastic dark 0 0 5 .3 .3 .3 .02 .1\nvoid plastic bright 0 0 5 .6 .6 .6 0 0\n"
                           "void mixfunc ball 4 dark bright .5+.5*sin(9*Px) . 0 0\n"), []),
        ("orientation by a function", *balls("void metal2 ball 4 Py -Px 0 . 0 6 .6 .6 .6 .8 .05 .2\n"), []),
        ("reflectance by a function", *balls("void plasfunc ball 2 noneg . 0 4 .6 .6 .6 .1\n"), []),
        ("transmission: glass", *beside("void glass clear 0 0 3 .9 .9 .9\n", pane("clear")), []),
        ("transmission: trans, rough", *beside("void trans frosted 0 0 7 .8 .8 .8 .03 .2 .7 .6\n", pane("frosted")), []),
        ("transmission: dielectric", *balls("void dielectric ball 0 0 5 .9 .9 .9 1.5 0\n"), []),
        ("lights: 8", "", WALLS + many_lamps(8) + spheres("wall"), []),
        ("lights: 200", "", WALLS + many_lamps(200) + spheres("wall"), []),
        ("lights: a spotlight", *beside("void spotlight spot 0 0 7 9 9 9 40 0 0 -1\n", lamp("spot", 2.5, 3, 2.6, 3.1, "spot")), []),
        ("a glow, -ab 1", *beside("void glow panel 0 0 4 10 10 10 0\n", lamp("panel1", 2.5, 3, 3, 3.5, "panel")), ["-ab", "1"]),
        ("no glow, -ab 1", "", ROOM, ["-ab", "1"]),
        ("a polygon with a hole", "", ROOM + "wall polygon frame 0 0 30 1 1 2 3 1 2 3 3 2 1 3 2 1 1 2 1.5 1.5 2 1.5 2.5 2 2.5 2.5 2 2.5 1.5 2 "
         "1.5 1.5 2\n", []),
        ("an octree's instances", "", ROOM + "".join(f"void instance i{i} 5 {octree} -t {i} 1 2 0 0\n" for i in (1, 2)), []),
        ("a mesh", "", ROOM + f"wall mesh m 5 {mesh} -t 2 2 2 0 0\n", []),
        ("a command, xform", "", ROOM + f"!xform -t 2 2 2 {folder}/part.rad\n", []),
        ("a command, another", "", ROOM + "!echo wall sphere other 0 0 4 2 2 2 .2\n", []),
    ]


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_files(folder):
    """What features name: 512 x 512 pixels or values."""
    side = 512
    pixels = bytes((x * y) % 251 for y in range(side) for x in range(3 * side))
    with open(os.path.join(folder, "picture.png"), "wb") as file:
        rows = b"".join(b"\0" + pixels[3 * side * y : 3 * side * (y + 1)] for y in range(side))
        header = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
    with open(os.path.join(folder, "picture.hdr"), "wb") as file:
        file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 512 +X 512\n")
        file.write(b"".join(pixels[3 * i : 3 * i + 3] + b"\x80" for i in range(side * side)))
    with open(os.path.join(folder, "values.dat"), "w") as file:
        file.write(f"2\n0 4 {side}\n0 4 {side}\n" + " ".join(str(b / 251) for b in pixels[: side * side]))
    with open(os.path.join(folder, "part.rad"), "w") as file:
        file.write("void plastic gray 0 0 5 .5 .5 .5 0 0\ngray sphere ball 0 0 4 0 0 0 .2\n")
    subprocess.run([f"{rays.BIN}/gpict", "-x", "512", "-y", "512", "--samples", "1", "-o", os.path.join(folder, "picture.exr"),
                    os.path.join(folder, "part.rad")], check=True, stderr=subprocess.DEVNULL)
    with open(os.path.join(folder, "part.obj"), "w") as file:
        file.write("v 0 0 0\nv .4 0 0\nv 0 .4 0\nv 0 0 .4\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n")
    for tool, source, target in (("oconv", "part.rad", "part.oct"), ("obj2mesh", "part.obj", "part.rtm")):
        with open(os.path.join(folder, target), "wb") as file:
            subprocess.run([f"{PEER}/{tool}", os.path.join(folder, source)], stdout=file, check=True)


def libraries(command, ray):
    with open(ray, "rb") as source:
        done = subprocess.run(command, stdin=source, capture_output=True, env=dict(os.environ, LD_DEBUG="libs"))
    if done.returncode:
        sys.exit(f"features.py: {done.stderr.decode()[-300:]}")
    # Of what a name stands for, without its version.
    return set(re.findall(r"calling init: \S*/([^/\s]+?)\.so\S*", done.stderr.decode()))


def instructions(command, ray):
    """Millions; None without valgrind."""
    if not shutil.which("valgrind"):
        return None
    tool = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    with open(ray, "rb") as source:
        done = subprocess.run(tool + command, stdin=source, capture_output=True)
    found = re.search(rb"I\s+refs:\s+([\d,]+)", done.stderr)
    return int(found[1].replace(b",", b"")) / 1e6 if found and done.returncode == 0 else None


def more(value, base):
    return "?" if value is None or base is None else f"{value - base:+.2f}"


def main():
    os.environ["RAYPATH"] = ":" + os.path.dirname(PEER) + "/lib"
    wanted = os.environ.get("FEATURES", "").split()
    with tempfile.TemporaryDirectory() as folder:
        write_files(folder)
        bench = rays.Bench(folder)
        known, room, first = set(), None, None
        print("| | libraries beyond the room's | instructions to the first answer, 10^6, if only defined | if used | rays/s | time a ray, rooms |")
        print("| --- | --- | --- | --- | --- | --- |")
        for i, (name, definition, text, options) in enumerate(features(folder)):
            if i > 0 and wanted and not any(name.startswith(word) for word in wanted):
                continue
            start = GTRACE + ["-n", "1"] + options + ONE_PATH
            used = start + [bench.scene(f"used{i}", text, "")]
            defined = start + [bench.scene(f"defined{i}", definition + ROOM, "")]
            loaded = libraries(used, bench.empty)
            idle = libraries(defined, bench.empty) - known if definition else set()
            if idle and i > 0:
                sys.exit(f"features.py: {name}: {' '.join(idle)} loaded, and nothing uses it")
            count = instructions(used, bench.empty)
            unused = instructions(defined, bench.empty) if definition else None
            if i == 0:
                room, first, known = count, used, loaded
            measured = bench.measure({"room": first, "used": used}, bench.rays)
            (base, _), (elapsed, answers) = measured["room"], measured["used"]
            extra = sorted(loaded - known) if i > 0 else sorted(loaded)
            named = " ".join(extra) if len(extra) <= 9 else f"{len(extra)} more: libOpenImageIO and what it needs"
            work = more(count, room) if i > 0 else "?" if count is None else f"{count:.2f} in all"
            idle_work = more(unused, room) if definition else ""
            print(f"| {name} | {named or 'none'} | {idle_work} | {work} | {len(answers) / elapsed:,.0f} | {elapsed / base:.2f} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
