"""Every kind of pattern, texture and mixture on every kind of material, and lit through what is clear, through real rtrace and
gtrace: TAP. test/support/peer.py says how they are compared.

A board of tiles has one material each, between lamps above and below and a sky all around that only mirrors and panes show (a
glow of radius 0). With -st 1 rough lobes reflect lamps alone, which needs no random number on either side."""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../support"))
from peer import FLOOR, Case, Geometry, aim, grid, main, normalized, sensors

LAMPS = """
void light lit 0 0 3 9000 8500 8000
lit sphere lamp 0 0 4 1.5 -2 6 .01
void light small_lit 0 0 3 5000 9000 12000
small_lit sphere small_lamp 0 0 4 -3 2 4 .008
void light low_lit 0 0 3 9000 9000 12000
low_lit sphere low_lamp 0 0 4 1 1 -4 .01
"""
SKY = """
void brightfunc bands 2 .6+.2*sin(9*Dx)*cos(7*Dy) . 0 0
bands glow sky_glow 0 0 4 2 1.8 1.4 0
sky_glow source sky 0 0 4 0 0 1 360
"""

# NAME of a pattern or texture to the line that makes it; P is its name in scenes.
PATTERNS = {
    "brightfunc": "void brightfunc P 4 share modifiers.cal -s .7 0 0",
    "colorfunc": "void colorfunc P 9 redness greenness blueness modifiers.cal -mx -t .3 .1 -.2 0 1 1.5",
    "brightdata": "void brightdata P 7 noop modifiers.dat modifiers.cal 1.6*Px 1.4*Py -rz 10 0 0",
    "colordata": "void colordata P 11 some some some modifiers.dat modifiers2.dat modifiers.dat modifiers.cal Px Py -rz 45 0 0",
    "colorpict": "void colorpict P 13 red green blue modifiers.hdr modifiers.cal Px Py -s .9 -t -.5 -.4 0 0 0",
    # An alias of a pattern with no modifier of its own counts twice in Radiance.
    "three patterns and an alias": "void brightfunc O 2 share modifiers.cal 0 0\nvoid brightfunc Q 2 .4+.3*sin(3*Py) . 0 0\nO alias R Q\n"
    "R colorfunc P 5 .3+.2*sin(5*Px) .5 A1*T/5 . -mz 0 1 .3",
}
TEXTURES = {
    "texfunc": "void texfunc P 8 leanx leany leanz modifiers.cal -s .7 -rx 20 0 1 .2",
    "texdata": "void texdata P 13 third swap more modifiers.dat modifiers2.dat modifiers.dat modifiers.cal Px Py -rz 45 -s .8 0 0",
}
MATERIALS = [
    "plastic M 0 0 5 .7 .8 .9 .05 .1",
    "plastic M 0 0 5 .7 .8 .9 .05 0",
    "metal M 0 0 5 .7 .6 .5 .8 0",
    "plastic2 M 4 1 .3 0 . 0 6 .7 .6 .5 .1 .1 .2",
    "metal2 M 6 1 .3 0 . -rz 20 0 6 .7 .6 .5 .6 .1 .2",
    "trans M 0 0 7 .8 .7 .6 .04 0 .7 .6",
    "trans M 0 0 7 .8 .7 .6 .04 .05 .7 .3",
    "trans2 M 4 1 .3 0 . 0 8 .8 .7 .6 .04 .05 .08 .7 .3",
    "glass M 0 0 3 .85 .7 .5",
    "glass M 0 0 4 .9 .95 .8 1.8",
    "ashik2 M 4 1 .2 0 . 0 8 .3 .2 .1 .4 .5 .6 20 40",
    "mirror M 0 0 3 .9 .8 .7",
    "plasfunc M 2 lobe modifiers.cal 0 5 .6 .5 .4 .4 .9",
    "metfunc M 2 lobe modifiers.cal 0 5 .6 .5 .4 .4 .9",
    "plasdata M 4 scaled modifiers_line.dat modifiers.cal height 0 5 .6 .5 .4 .4 .9",
    "WGMDfunc M 13 inherit .3 .15 .2 void 0 0 0 void 1 .2 0 . 0 9 .5 .4 .3 .1 .2 .6 0 0 0",
]
LIGHTS = [
    "light M 0 0 3 3 2 1",
    "glow M 0 0 4 3 2 1 0",
    "glow M 0 0 4 3 2 1 -1",
    "spotlight M 0 0 7 3 2 1 70 .1 .2 1",
]


def corner(i):
    return np.array([-2.4 + 1.2 * (i % 4), -2.4 + 1.2 * (i // 4), 0])


def board(materials, modifier):
    """A tile of each material."""
    text = ""
    for i, material in enumerate(materials):
        x, y, _ = corner(i)
        text += f"{modifier} {material.replace(' M ', f' m{i} ')}\n"
        text += f"m{i} polygon tile{i} 0 0 12 {x} {y} 0 {x + 1.1} {y} 0 {x + 1.1} {y + 1.1} 0 {x} {y + 1.1} 0\n"
    return text


def looks(count, random, eyes=((0.3, -1, 5), (0.3, -1, -5)), each=6):
    """Rays to points of each tile from both sides."""
    points = np.vstack([corner(i) + np.c_[random.uniform(0.03, 1.07, (each, 2)), np.zeros(each)] for i in range(count)])
    return np.vstack([aim(np.array(eye), points) for eye in eyes])


# Pairs of a mixture: what {fore} and {back} are.
PAIRS = [
    ("plastic F 0 0 5 .7 .2 .1 .05 .2", "metal B 0 0 5 .2 .4 .8 .7 .3"),
    ("plastic F 0 0 5 .7 .2 .1 .05 0", "trans B 0 0 7 .8 .7 .6 .04 0 .7 .6"),
    ("glass F 0 0 3 .85 .7 .5", "plastic B 0 0 5 .7 .2 .1 0 0"),
    ("glass F 0 0 3 .85 .7 .5", "glass B 0 0 4 .5 .95 .8 1.8"),
    ("mirror F 0 0 3 .9 .8 .7", "plastic2 B 4 1 .3 0 . 0 6 .7 .6 .5 .1 .2 .3"),
    ("ashik2 F 4 1 .2 0 . 0 8 .3 .2 .1 .4 .5 .6 4 8", "plasfunc B 2 lobe modifiers.cal 0 5 .6 .5 .4 .4 .9"),
]
MIXTURES = {
    "mixfunc": "mixfunc M 6 F B share modifiers.cal -s .5 0 0",
    "mixdata": "mixdata M 7 F B noop modifiers.dat modifiers.cal 1.6*Px Py 0 0",
    "mixpict": "mixpict M 9 F B grey modifiers.hdr modifiers.cal .3+.2*Px .4+.2*Py -rz 10 0 0",
}
# Of these one bends what is seen through it. Bodies of them lie in a room of glows.
BENDING = [
    ("dielectric F 0 0 5 .6 .8 .9 1.5 0", "plastic B 0 0 5 .5 .4 .3 0 0"),
    ("dielectric F 0 0 5 .6 .8 .9 1.5 0", "void"),
    ("metal F 0 0 5 .2 .4 .8 .7 0", "dielectric B 0 0 5 .9 .8 .7 1.33 0"),
    ("dielectric F 0 0 5 .6 .8 .9 1.5 0", "dielectric B 0 0 5 .9 .3 .7 1.2 0"),
    ("interface F 0 0 8 .9 .5 .7 1.5 1 1 1 1.33", "glass B 0 0 3 .85 .7 .5"),
    ("prism1 F 5 .6-.2*Rdot Dx+.3*sin(9*Py) Dy Dz-.2 . 0 0", "trans B 0 0 7 .8 .7 .6 .04 0 .7 .6"),
    ("void", "prism2 B 9 if(Rdot,.3,.5) Dx Dy -Dz .4*abs(Dz) Dx+.3 Dy Dz . 0 0"),
    ("prism1 F 5 .7 Dx Dy-.2 Dz . 0 0", "dielectric B 0 0 5 .9 .8 .7 1.33 0"),
]
ROOM = """
void glow red 0 0 4 3 .2 .1 0
void glow green 0 0 4 .2 2 .3 0
void colorfunc tiles 4 .6+.4*sin(5*Px)*sin(4*Py) .3+.2*sin(6*Px) .3 . 0 0
tiles glow bright 0 0 4 3 2 1 0
bright polygon floor 0 0 12 -6 -6 -1 6 -6 -1 6 6 -1 -6 6 -1
red polygon wall 0 0 12 -6 6 -1 6 6 -1 6 6 5 -6 6 5
green polygon other 0 0 12 -6 -6 -1 -6 6 -1 -6 6 5 -6 -6 5
"""
LAMP = "void light lit 0 0 3 9000 8500 8000\nlit sphere lamp 0 0 4 .5 -.3 4 .01\n"
# What a pane over the floor is made of, and how the lamp above shines through it.
PANE = "M polygon pane 0 0 12 -3 -3 1.2 3 -3 1.2 3 3 1.2 -3 3 1.2\n"
PANES = {
    "a pane with a pattern": PATTERNS["brightfunc"] + "\nP glass M 0 0 3 .85 .7 .5\n",
    "a pane with a texture": TEXTURES["texfunc"] + "\nP glass M 0 0 3 .85 .7 .5\n",
    "a smooth trans with a pattern": PATTERNS["colorfunc"] + "\nP trans M 0 0 7 .8 .7 .6 .04 0 .7 .6\n",
    "a smooth trans with a texture": TEXTURES["texfunc"] + "\nP trans M 0 0 7 .8 .7 .6 .04 0 .7 .6\n",
    "a pane mixed with another": "void glass F 0 0 3 .85 .7 .5\nvoid glass B 0 0 4 .3 .95 .8 1.8\nvoid mixfunc M 4 F B share modifiers.cal 0 0\n",
    "a pane mixed with a wall": "void glass F 0 0 3 .85 .7 .5\nvoid plastic B 0 0 5 .3 .95 .8 0 0\nvoid mixfunc M 4 F B share modifiers.cal 0 0\n",
    "a pane mixed by a picture": "void glass F 0 0 3 .85 .7 .5\nvoid trans B 0 0 7 .8 .7 .6 .04 0 .7 .6\n"
    "void mixpict M 7 F B grey modifiers.hdr modifiers.cal .5+.1*Px .4+.1*Py 0 0\n",
    "an alias of a pane with a pattern": "void glass Q 0 0 3 .85 .7 .5\n" + PATTERNS["colorfunc"] + "\nP alias M Q\n",
}


def mixtures(text):
    parts, names = "", []
    for i, (fore, back) in enumerate(PAIRS):
        parts += f"void {fore.replace(' F ', f' f{i} ')}\nvoid {back.replace(' B ', f' b{i} ')}\n"
        names.append(text.replace(" F B ", f" f{i} b{i} "))
    return parts + board(names, "void")


def bodies(text):
    """Balls, some of which lie in others' places, of the mixtures."""
    made = ""
    for i, (fore, back) in enumerate(BENDING):
        names = []
        for part, name, letter in (fore, f"f{i}", " F "), (back, f"b{i}", " B "):
            names.append("void" if part == "void" else name)
            made += "" if part == "void" else f"void {part.replace(letter, f' {name} ')}\n"
        made += f"void {text.replace(' F B ', f' {names[0]} {names[1]} ').replace(' M ', f' m{i} ')}\n"
        made += f"m{i} sphere ball{i} 0 0 4 {1.2 * (i % 4) - 1.8} {1.2 * (i // 4)} 0 .55\n"
    return made


def cases():
    random = np.random.default_rng(20261122)
    for kind, text in PATTERNS.items():
        yield Case(f"{kind} on every material", text + LAMPS + SKY + board(MATERIALS, "P"), looks(len(MATERIALS), random),
                   "-ab 0 -st 1", repeat=16, own_repeat=2048)
        yield Case(f"{kind} on every light", text + "\n" + board(LIGHTS, "P"), looks(len(LIGHTS), random, each=16), "-ab 0", repeat=8)
    for kind, text in TEXTURES.items():
        yield Case(f"{kind} on every material", text + LAMPS + SKY + board(MATERIALS, "P"), looks(len(MATERIALS), random),
                   "-ab 0 -st 1", repeat=16, own_repeat=2048)
    for kind, text in MIXTURES.items():
        yield Case(f"{kind} of materials", LAMPS + SKY + mixtures(text), looks(len(PAIRS), random), "-ab 0 -st 1", repeat=64,
                   own_repeat=2048)
    yield Case("mixtures of mixtures", LAMPS + SKY + """
void glass clear 0 0 3 .85 .7 .5
void plastic solid 0 0 5 .7 .2 .1 .05 .2
void alias painted solid
void metal shiny 0 0 5 .2 .4 .8 .7 0
void brightfunc striped 2 share modifiers.cal 0 0
striped plastic marked 0 0 5 .7 .8 .9 0 0
void mixfunc one 4 clear painted .3 . 0 0
void mixfunc two 4 shiny marked share*.9 modifiers.cal 0 0
void mixfunc both 4 one two .4+.2*sin(Py) . 0 0
both ring disk 0 0 8 0 0 0 0 0 1 0 2.5
""", aim([0.3, -1, 5], grid([-1.5, -1.5, 0], [1.5, 1.5, 0], 64, random)), "-ab 0 -st 1", repeat=128, own_repeat=2048)
    # From behind, Radiance adds what leans a normal to the other one.
    leaning = f"void plastic F 0 0 5 .7 .2 .1 0 0\n{TEXTURES['texfunc']}\nP metal B 0 0 5 .2 .4 .8 .7 0\nvoid {MIXTURES['mixfunc']}\n"
    # Rays of their own: those of other cases, some of which go by a hair's breadth, do not depend on these.
    bending = np.random.default_rng(20261123)
    sides = aim(np.array([0, 0, 3]), bending.uniform([-0.8, -0.8, 0], [0.8, 0.8, 0], (20, 3)))
    yield Geometry("a mixture with a texture", leaning + "M ring disk 0 0 8 0 0 0 0 0 1 0 2\n", sides, "LpNnsmM")
    yield Geometry("a mixture", mixtures(MIXTURES["mixdata"]), looks(len(PAIRS), bending), "LpNnsmM")
    for kind, text in MIXTURES.items():
        around = aim([0.2, -4, 2.5], bending.uniform([-2.3, -0.5, -0.4], [2.3, 1.7, 0.4], (96, 3)))
        yield Case(f"{kind} with what bends", ROOM + bodies(text), around, "-ab 0 -st 1", "-lr -48", repeat=4, own_repeat=2048,
                   samples=32768)
        if kind == "mixfunc":
            yield Case(f"{kind} with what bends, backs unseen", ROOM + bodies(text), around, "-ab 0 -st 1 -bv-", "-lr -48", repeat=4, own_repeat=2048,
                       samples=32768)
    # As many dimensions as there may be.
    sixfold = " ".join(["6"] + 6 * ["0 1 2"] + [str(37 * i % 64 / 64) for i in range(64)])
    places = "Px Py Px+Py Px*Py .5-Px .3"
    yield Case("data of six dimensions", ROOM + f"!echo {sixfold} >FOLDER/six.dat; echo void alias six red\nvoid brightdata P 9 noop FOLDER/six.dat . {places} 0 0\n"
               "P glow M 0 0 4 1 1 1 0\nM polygon square 0 0 12 0 0 0 .9 0 0 .9 .9 0 0 .9 0\n", aim([0.3, -1, 5], grid([0, 0, 0], [.9, .9, 0], 64, bending)), "-ab 0", repeat=2)
    failing = "void plastic F 0 0 5 .7 .2 .1 0 0\nvoid metal B 0 0 5 .2 .4 .8 .7 0\nvoid mixfunc M 4 F B if(Px,.5,1/(Px-Px)) . 0 0\n"
    yield Case("a mixture whose share fails", ROOM + failing + "M ring disk 0 0 8 0 0 0 0 0 1 0 2\n", aim([0.3, -1, 5], grid([-1.5, -1.5, 0], [1.5, 1.5, 0], 64, bending)),
               "-ab 0 -st 1 -w", repeat=4, own_repeat=2048)
    under = sensors([-2.2, -2.2, 0], [2.2, 2.2, 0], 36, [0, 0, 1], random)
    for kind, text in PANES.items():
        yield Case(f"lit through {kind}", FLOOR + LAMP + text + PANE, under, "-I -ab 0", repeat=32)
        yield Case(f"the floor through {kind}", FLOOR + LAMP + text + PANE, aim([0.4, -2, 3], under[:, :3]), "-ab 0",
                   repeat=64, own_repeat=8192, samples=16384)


if __name__ == "__main__":
    main(cases())
