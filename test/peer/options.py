"""Options that say which light counts, light through and by way of clear bodies and mirrors, and all that in instances, through
real rtrace and gtrace: TAP. test/support/peer.py says how they are compared."""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../support"))
from materials import LAMP, LAMPS, MATERIALS, PATTERNS, SKY, TEXTURES, board, looks
from peer import FLOOR, Case, aim, grid, main, sensors

GLOWS = """
void brightfunc bands 2 1.5+.5*sin(3*Dx)*cos(4*Dy) . 0 0
bands glow bright 0 0 4 1 2 3 0
bright source sky 0 0 4 0 0 1 180
void glow dark 0 0 4 .2 .2 .1 0
dark source ground 0 0 4 0 0 -1 180
"""
# Two mirrors that face each other, and what is between them. (After the last reflection glossy surfaces still see glows here, and
# not in Radiance: so nothing is glossy.)
HALL = """
void metal silver 0 0 5 .9 .85 .8 .9 0
void plastic tile 0 0 5 .6 .3 .2 0 0
silver polygon near 0 0 12 -1 0 0 1 0 0 1 0 2 -1 0 2
silver polygon far 0 0 12 -1 2 0 -1 2 2 1 2.1 2 1 2.1 0
tile polygon between 0 0 12 -.5 .5 .5 .5 .5 .4 .5 1.5 .5 -.5 1.5 .6
void glow dim 0 0 4 .5 .6 .7 0
dim source sky 0 0 4 0 0 1 360
void light lit 0 0 3 9000 8500 8000
lit sphere lamp 0 0 4 .2 .9 2.4 .01
"""


def instance(text, words="", name="copy", modifier="void"):
    """What is in an octree of its own."""
    octree = f"FOLDER/{name}.oct"
    return f"!echo '{' '.join(text.split())}' | oconv -f - >{octree}.$$ && mv {octree}.$$ {octree} && " \
           f"echo {modifier} instance {name} {1 + len(words.split())} {octree} {words} 0 0\n"


def what_counts(random):
    tiles = LAMPS + SKY + board(MATERIALS, "void")
    yield Case("the ambient value on every material", tiles, looks(len(MATERIALS), random), "-ab 0 -st 1 -av .3 .2 .1", repeat=16,
               own_repeat=2048)
    passing = [*MATERIALS, "WGMDfunc M 13 void .1 .1 .1 void .5 .1 .1 void 1 .2 0 . 0 9 .5 .4 .3 .1 .2 .6 0 0 0",
               "BRTDfunc M 10 0 0 0 .5 .5 .5 0 0 0 . 0 9 .5 .4 .3 .1 .2 .6 0 0 0", "transfunc M 2 lobe modifiers.cal 0 7 .6 .5 .4 .4 .5 .5 .9"]
    yield Case("irradiance on every material", LAMPS + SKY + board(passing, "void"), looks(len(passing), random, each=3), "-i -ab 0",
               repeat=16)
    # What Radiance samples of ashik2's gloss it does not weight by the model.
    some = [material for material in MATERIALS if "ashik2" not in material]
    yield Case("gloss that counts as diffuse", LAMPS + SKY + board(some, "void"), looks(len(some), random, each=3), "-ab 0 -st .3 -av .3 .2 .1",
               "-ss 4096", repeat=24, own_repeat=512, samples=8192)
    across = aim([0.3, 1, 1.2], grid([-0.9, 0, 0.1], [0.9, 0, 1.9], 49, random))
    across[:, 3:] *= np.where(np.arange(len(across)) % 2, 1, -1)[:, None]
    for limit in "-lr 1", "-lr 2", "-lr 5", "-lr 9 -lw .5", "-lr -3":
        yield Case("reflections " + limit, HALL, across, "-ab 0 " + limit, repeat=64, own_repeat=2048)
    yield Case("lights unseen", HALL, np.vstack([across, aim([0.3, 1, 1.2], [[.2, .9, 2.4], [.2, -.9, 2.4]])]), "-ab 0 -dv-", repeat=64)
    names = "void plastic red 0 0 5 .6 .12 .1 0 0\nred polygon wall 0 0 12 -2 2 0 2 2 0 2 2 2 -2 2 2\nvoid alias pink red\n" \
            "pink polygon other 0 0 12 -2 -2 0 -2 -2 2 2 -2 2 2 -2 0\n"
    under = sensors([-2.2, -1.8, 0], [2.2, 1.8, 0], 16, [0, 0, 1], random)
    for option in "-ae red", "-ai matte -ai red", "-aE excluded", "-aI excluded", "":
        yield Case(f"two bounces {option}".strip(), FLOOR + LAMP + names, under, f"-I -ab 2 -av .3 .2 .1 {option}", "-ad 256", repeat=64,
                   samples=8192)


SLAB = "!genbox clear slab 3 3 .3 | xform -t -1.5 -1.5 .6\n"
CLEAR = {
    "a slab of glass": "void dielectric clear 0 0 5 .6 .8 .9 1.5 0\n" + SLAB,
    "a slab of glass with a pattern": PATTERNS["brightfunc"] + "\nP dielectric clear 0 0 5 .6 .8 .9 1.5 0\n" + SLAB,
    "a slab of wavy glass": TEXTURES["texfunc"] + "\nP dielectric clear 0 0 5 .6 .8 .9 1.5 0\n" + SLAB,
    "water on glass": "void dielectric clear 0 0 5 .6 .8 .9 1.5 0\nvoid interface wet 0 0 8 .6 .8 .9 1.5 .9 .95 1 1.33\n"
    "void dielectric water 0 0 5 .9 .95 1 1.33 0\nclear ring bottom 0 0 8 0 0 .5 0 0 -1 0 2\nwet ring middle 0 0 8 0 0 .7 0 0 1 0 2\n"
    "water ring top 0 0 8 0 0 1 0 0 1 0 2\nclear cylinder low 0 0 7 0 0 .5 0 0 .7 2\nwater cylinder high 0 0 7 0 0 .7 0 0 1 2\n",
    "a ball of glass": "void dielectric clear 0 0 5 .6 .8 .9 1.5 0\nclear sphere ball 0 0 4 0 0 1 .8\n",
    "a thin ball": "void dielectric clear 0 0 5 .6 .8 .9 1.5 0\nclear sphere ball 0 0 4 0 0 1 .8\nclear bubble hollow 0 0 4 0 0 1 .7\n",
}
MIRROR = "silver polygon upright 0 0 12 -2 2 0 2 2 0 2 2 3 -2 2 3\n"
MIRRORS = {
    "a mirror": "void mirror silver 0 0 3 .9 .8 .7\n" + MIRROR,
    "a mirror with a pattern": PATTERNS["colorfunc"] + "\nP mirror silver 0 0 3 .9 .8 .7\n" + MIRROR,
    "an alias of a mirror": "void mirror bright 0 0 3 .9 .8 .7\nvoid alias silver bright\n" + MIRROR,
    "a mirror behind a pane": "void mirror silver 0 0 3 .9 .8 .7\nvoid glass pane 0 0 3 .8 .9 .7\n" + MIRROR
    + "pane polygon front 0 0 12 -2 1.8 0 2 1.8 0 2 1.8 3 -2 1.8 3\n",
}
PANE = "M polygon pane 0 0 12 -3 -3 1.2 3 -3 1.2 3 3 1.2 -3 3 1.2 "
COPIES = {
    "a pane": "void glass M 0 0 3 .85 .7 .5 " + PANE,
    "a pane with a pattern": "void colorfunc P 4 .5+.3*sin(3*Px) .5 .4+.3*cos(2*Py) . 0 0 P glass M 0 0 3 .85 .7 .5 " + PANE,
    "a mixed pane": "void glass F 0 0 3 .85 .7 .5 void plastic B 0 0 5 .5 .2 .1 0 0 void mixfunc M 4 F B .5+.5*sin(3*Px)*cos(2*Py) . 0 0 " + PANE,
    "a smooth trans": "void trans M 0 0 7 .8 .7 .6 .04 0 .7 .6 " + PANE,
}


def clear_bodies(random):
    under = sensors([-1.8, -1.8, 0], [1.8, 1.8, 0], 25, [0, 0, 1], random)
    for name, text in CLEAR.items():
        yield Case(f"the sky through {name}, irradiance", FLOOR + GLOWS + text, under[::2], "-I -ab 1", "-ad 512 -lr -99", repeat=64, samples=8192,
                   commands=True)
        yield Case(f"the floor through {name}", FLOOR + GLOWS + text, aim([.4, -2.5, 2.2], under[:9, :3] * .8), "-ab 1",
                   "-ad 512 -lr -99", repeat=64, samples=16384, commands=True)
    floor = sensors([-2.2, -2.2, 0], [2.2, 1.7, 0], 36, [0, 0, 1], random)
    for name, text in MIRRORS.items():
        yield Case(f"lit by {name}", FLOOR + LAMP + text, floor, "-I -ab 0", "-dr 1 -dp 0", repeat=64)
        yield Case(f"seen in {name}", FLOOR + LAMP + text, aim([.4, -2, 1.2], grid([-1.5, 2, .1], [1.5, 2, 2.5], 36, random)), "-ab 0",
                   "-dr 1 -dp 0", repeat=64, own_repeat=2048)
    yield Case("a pane and a texture on a mirror", FLOOR + LAMP + TEXTURES["texfunc"] + "\nP mirror silver 0 0 3 .9 .8 .7\n" + MIRROR,
               aim([.4, -2, 1.2], grid([-1.5, 2, .1], [1.5, 2, 2.5], 36, random)), "-ab 0", "-dr 0", repeat=16)
    for name, text in COPIES.items():
        scene = FLOOR + LAMP + instance(text, "-rz 20 -s .9 -t .1 .2 .1", f"copy{len(name)}")
        yield Case(f"lit through {name} in an instance", scene, floor, "-I -ab 0", repeat=32, commands=True)
        yield Case(f"the floor through {name} in an instance", scene, aim([.4, -2, 3], floor[:, :3]), "-ab 0", repeat=64,
                   own_repeat=8192, samples=16384, commands=True)
    nested = FLOOR + LAMP + instance("void glass M 0 0 3 .85 .7 .5 " + PANE, "-rz 20 -s .9", "once") + \
        "void instance two 7 FOLDER/once.oct -rx 3 -t 0 0 .3 0 0\n"
    yield Case("lit through panes in two instances", nested, floor, "-I -ab 0", repeat=32, commands=True)
    yield Case("a mirror in an instance, seen", FLOOR + LAMP + instance("void mirror silver 0 0 3 .9 .8 .7 " + MIRROR, "-rz 10", "glazed"),
               aim([.4, -2, 1.2], grid([-1.3, 2, .1], [1.3, 2, 2.5], 36, random)), "-ab 0", "-dr 1", repeat=32, commands=True)


def cases():
    random = np.random.default_rng(20261124)
    yield from what_counts(random)
    yield from clear_bodies(random)


if __name__ == "__main__":
    main(cases())
