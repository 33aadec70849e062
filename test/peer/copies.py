"""Instances, meshes and octrees: the same rays through rtrace and gtrace. TAP.

Nothing in these scenes needs a random number: surfaces shine by themselves (a glow of radius 0 lights nothing) or reflect the
ambient value. So all that both programs say of a ray is compared: value, distance, point, normals with and without what leans
them, names. Single rays may pass an edge on the other side; of all others not one differs.

GRAZE_PEER_SEED sets the seed (1)."""

import os
import subprocess
import sys
import tempfile

import numpy as np

BIN = os.environ["BIN"]
PEER = os.environ["GRAZE_PEER_BIN"]
SEED = int(os.environ.get("GRAZE_PEER_SEED", "1"))
OPTIONS = ["-h", "-w", "-ab", "0", "-av", ".3", ".25", ".2", "-ovLpNncsmM"]
COUNT = 4000

MATERIALS = """void plastic leaf 0 0 5 .1 .5 .1 0 0
void glow ember 0 0 4 .5 .2 .1 0
"""

TREE = """void plastic leaf 0 0 5 .1 .5 .1 0 0
void glow ember 0 0 4 .5 .2 .1 0
void metal bark 0 0 5 .4 .3 .1 0 0
leaf sphere crown 0 0 4 0 0 2 1
bark cylinder trunk 0 0 7 0 0 0 0 0 1.5 .2
ember polygon card 0 0 12 1 0 1 2 0 1 2 0 2 1 0 2
leaf bubble hollow 0 0 4 -1 0 1 .5
leaf ring plate 0 0 8 0 -1 1.5 0 1 1 .1 .6
leaf cup cup 0 0 8 0 1 1 0 1.5 2 .1 .5
"""


def copy(modifier, kind, words):
    """An instance or a mesh."""
    return f"{modifier} {kind} {words.split('.')[0]} {len(words.split())} {words} 0 0\n"


GROVE = (
    copy("void", "instance", "tree.oct -t 2 0 0")
    + copy("void", "instance", "frozen.oct -rz 40 -s .3 -t -1 1 0")
    + copy("void", "mesh", "flat.rtm -s .4 -t 0 2 1")
)

FLOOR = """void plastic ground 0 0 5 .4 .4 .4 0 0
void plastic red 0 0 5 .9 .1 .1 0 0
ground polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0
"""

# What scenes are made of beside the files above.
SCENES = {
    "an instance of an octree that names files": copy("void", "instance", "tree.oct"),
    "an instance of a frozen octree": copy("void", "instance", "frozen.oct"),
    "turned, mirrored, small and large": copy("void", "instance", "tree.oct -mx -s 1.5 -rz 30 -t 3 3 0")
    + copy("void", "instance", "frozen.oct -rx 90 -my -rz -20 -s .3 -t -2 1 1")
    + copy("void", "instance", "tree.oct -mz -s .01 -t 0 0 1"),
    "the instance's own modifier": copy("red", "instance", "tree.oct -rz 50 -s 1.2"),
    "instances in instances": copy("void", "instance", "grove.oct -t 1 1 0") + copy("red", "instance", "grove.oct -mx -t -3 -3 0"),
    "arrays of instances": "!xform -n row -a 4 -t 2 0 0 -a 3 -t 0 2.5 0 -i 1 -t -4 -3 0 one.rad\n",
    "a mesh": copy("void", "mesh", "flat.rtm -t 0 0 1"),
    "a mesh with normals at its points": copy("void", "mesh", "smooth.rtm -rx 20 -s 1.7 -mx -t 0 0 2"),
    "a mesh without materials": copy("red", "mesh", "bare.rtm -s 1.5 -t 1 0 1"),
    "a mesh with another material": copy("red", "mesh", "smooth.rtm -s 2.5 -t 1 0 1"),
    "patterns in an instance": copy("void", "instance", "patterned.oct -rx 40 -s 1.3 -t 1 0 1 -mx"),
    "patterns by a mesh's texture coordinates": copy("void", "mesh", "textured.rtm -s 1.5 -t 0 0 1.5"),
    "textures in an instance": copy("void", "instance", "bumpy.oct -rx 40 -s 1.3 -t 1 0 1"),
    "a texture on a mesh with normals": copy("dents", "mesh", "smooth.rtm -s 1.5 -t 0 0 1.5"),
}

PATTERNED = """void brightfunc waves 2 .6+.4*sin(5*Px)*cos(3*Py)+.05*T*0 . 0 0
waves plastic striped 0 0 5 .7 .6 .5 0 0
waves glow lamp 0 0 4 1 .5 .2 0
striped sphere ball 0 0 4 0 0 0 1
lamp ring disk 0 0 8 0 0 1.2 0 .2 1 0 .8
"""

BUMPY = """void texfunc bumps 4 .2*sin(9*Px) .2*Pz*0 .1*cos(7*Py) . 0 0
bumps plastic rough 0 0 5 .7 .6 .5 0 0
rough sphere ball 0 0 4 0 0 0 1
rough polygon wall 0 0 12 -1 -1 -1 1 -1 -1 1 -1 1 -1 -1 1
"""

DENTS = """void texfunc dents 4 .2*sin(9*Px) 0 .1*cos(7*Py) . 0 0
dents plastic dents 0 0 5 .7 .6 .5 0 0
"""

TEXTURED = """void brightfunc checks 2 if(sin(20*Lu)*sin(9*Lv),1,.3) . 0 0
checks plastic leaf 0 0 5 .9 .8 .7 0 0
void glow ember 0 0 4 .5 .2 .1 0
"""


# Irradiance where rays hit, by a sun: meshes have their corners' normals there, textures do not count.
IRRADIANCE = {
    "irradiance on a mesh with normals": SCENES["a mesh with normals at its points"],
    "irradiance on a mesh with normals and a texture": SCENES["a texture on a mesh with normals"],
}
# Which is about 1: as wrong as rtrace's normals are.
SUN = "void light far 0 0 3 4e5 4e5 4e5\nfar source sun 0 0 4 1 -.5 1 .1\n"
TOWARDS_SUN = np.array([1, -0.5, 1])


def globe(normals, uv, materials):
    """A bumpy globe as a Wavefront object."""
    n, lines = 16, ["usemtl leaf"] if materials else []
    for i in range(n + 1):
        for j in range(2 * n):
            theta, phi = np.pi * i / n, np.pi * j / n
            d = np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])
            r = 1 + 0.1 * np.sin(5 * phi) * np.sin(theta)
            lines += ["v %.9g %.9g %.9g" % tuple(r * d), "vn %.9g %.9g %.9g" % tuple(d), f"vt {j / (2 * n)} {i / n}"]

    def corner(k):
        return f"{k}/{k if uv else ''}/{k if normals else ''}".rstrip("/")

    for i in range(n):
        if materials and i == n // 2:
            lines.append("usemtl ember")
        for j in range(2 * n):
            a, b = i * 2 * n + j + 1, (i + 1) * 2 * n + j + 1
            c, d = (i + 1) * 2 * n + (j + 1) % (2 * n) + 1, i * 2 * n + (j + 1) % (2 * n) + 1
            if i < n - 1:
                lines.append(f"f {corner(a)} {corner(b)} {corner(c)}")
            if i > 0:
                lines.append(f"f {corner(a)} {corner(c)} {corner(d)}")
    return "\n".join(lines) + "\n"


def run(command, data=b"", into=None):
    environment = dict(os.environ, PATH=PEER + ":" + os.environ["PATH"], RAYPATH=".:" + os.environ["GRAZE_PEER_RAYPATH"])
    done = subprocess.run(command, input=data, capture_output=True, env=environment)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: status {done.returncode}: {done.stderr.decode(errors='replace')[:500]}")
    if into:
        with open(into, "wb") as file:
            file.write(done.stdout)
    return done.stdout


def write(name, text):
    with open(name, "w") as file:
        file.write(text)


def make_files():
    texts = {"tree": TREE, "grove": GROVE, "patterned": PATTERNED, "bumpy": BUMPY}
    write("mats.rad", MATERIALS)
    write("textured.rad", TEXTURED)
    write("one.rad", copy("void", "instance", "tree.oct -s .5"))
    for name, normals, uv, materials in [
        ("flat", False, False, True), ("smooth", True, False, True), ("bare", False, False, False), ("textured", True, True, True)
    ]:
        write(name + ".obj", globe(normals, uv, materials))
        given = ["-a", "textured.rad" if name == "textured" else "mats.rad"] if materials else []
        run(["obj2mesh", *given, name + ".obj"], into=name + ".rtm")
    for name, text in texts.items():
        write(name + ".rad", text)
        if name == "grove":
            run(["oconv", "-f", "tree.rad"], into="frozen.oct")
        run(["oconv", name + ".rad"], into=name + ".oct")


def rays(random):
    origin = random.uniform(-4, 4, (COUNT, 3))
    direction = random.uniform(-2, 2, (COUNT, 3)) - origin
    origin[:, 2] = abs(origin[:, 2]) + 0.2
    return "".join("%.9g %.9g %.9g %.9g %.9g %.9g\n" % tuple(row) for row in np.hstack([origin, direction])).encode()


def compare(theirs, ours, value_error):
    """How many rays differ, and the first of them."""
    different, first = 0, None
    theirs, ours = theirs.decode().splitlines(), ours.decode().splitlines()
    if len(theirs) != COUNT or len(ours) != COUNT:
        return COUNT, f"{len(theirs)} and {len(ours)} answers"
    for a, b in zip(theirs, ours):
        x, y = a.split(), b.split()
        numbers = np.array(x[:15], float), np.array(y[:15], float)
        # The point and the normals of what is infinitely far differ.
        far = numbers[0][3] > 1e9
        close = np.allclose(numbers[0][:4], numbers[1][:4], rtol=2e-5, atol=value_error)
        close = close and (far or np.allclose(numbers[0][4:], numbers[1][4:], rtol=2e-5, atol=3e-5))
        # Where the smooth normal has the sun on one side and the flat one on the other, Radiance lights through the surface.
        flat, smooth = numbers[0][7:10], numbers[0][10:13]
        through = value_error > 1e-6 and (flat @ smooth) * (flat @ TOWARDS_SUN) * (smooth @ TOWARDS_SUN) < 0
        close = close or through and np.allclose(numbers[0][3:], numbers[1][3:], rtol=2e-5, atol=3e-5)
        if not close or (not far and x[15:] != y[15:]):
            different += 1
            first = first or f"rtrace: {a} | gtrace: {b}"
    return different, first


def main():
    random = np.random.default_rng(SEED)
    print(f"1..{2 * len(SCENES) + 2 * len(IRRADIANCE)}")
    failed, number = 0, 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        make_files()
        for name, text in [*SCENES.items(), *IRRADIANCE.items()]:
            irradiance = name in IRRADIANCE
            options = [*OPTIONS, "-i", "-av", "0", "0", "0", "-dv-"] if irradiance else OPTIONS
            write("scene.rad", FLOOR + (DENTS if "dents" in text else "") + (SUN if irradiance else "") + text)
            run(["oconv", "scene.rad"], into="scene.oct")
            data = rays(random)
            theirs = run(["rtrace", *options, "scene.oct"], data)
            for file in "scene.rad", "scene.oct":
                ours = run([os.path.join(BIN, "gtrace"), *options, "--samples", "2", file], data)
                different, first = compare(theirs, ours, 3e-5 if irradiance else 1e-6)
                good = different <= 4
                number, failed = number + 1, failed + (not good)
                if first:
                    print(f"# {different} of {COUNT} rays differ: {first}")
                print(f"{'ok' if good else 'not ok'} {number} - {name}: {file}")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
