"""Every surface with either side out, as a body and as a lamp, transforms, and what Radiance's generators and oconv make, through
real rtrace and gtrace: TAP. test/support/peer.py says how they are compared."""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../support"))
from peer import FLOOR, Case, Geometry, aim, grid, main, normalized, sensors

# So small that hardly a ray ends in a penumbra.
LAMPS = """
void light lit 0 0 3 9e5 8.5e5 8e5
lit sphere lamp 0 0 4 1.5 -2 6 .001
void light low_lit 0 0 3 9e5 9e5 1.2e6
low_lit sphere low_lamp 0 0 4 -5 1 -4 .001
"""
# Both sides of a body differ in color, and the front of a lamp alone shines.
BODY = """
void colorfunc sides 4 if(Rdot,1,.2) .5 if(Rdot,.3,1) . 0 0
sides plastic painted 0 0 5 .7 .6 .5 .05 .2
void glow ember 0 0 4 3 2 1 0
"""
SHAPES = {
    "polygon": "12 -1 -1 0 1 -1 .2 1 1 .4 -1 1 .2",
    "polygon of the other side": "12 -1 -1 0 -1 1 .2 1 1 .4 1 -1 .2",
    "polygon with a hole": "30 -1 -1 0 1 -1 0 1 1 0 -1 1 0 -1 -1 0 -.3 -.4 0 -.3 .5 0 .4 .5 0 .4 -.4 0 -.3 -.4 0",
    "sphere": "4 0 0 .2 .9",
    "bubble": "4 0 0 .2 .9",
    "cone": "8 -.4 0 -.6 .4 .2 .9 .9 .2",
    "cup": "8 -.4 0 -.6 .4 .2 .9 .2 .9",
    "cylinder": "7 -.4 0 -.6 .4 .2 .9 .7",
    "tube": "7 -.4 0 -.6 .4 .2 .9 .7",
    "ring": "8 0 0 .1 .2 .3 1 .2 1",
}


def shape(name, numbers, material, position):
    return f"!echo {material} {name.split()[0]} {material} 0 0 {numbers} | xform -t {position}\n"


def around(count, random, size=1.0):
    """Rays from all sides and from within to points near the origin and its copy at 3 0 0."""
    targets = random.uniform(-size, size, (count, 3)) + np.where(np.arange(count)[:, None] % 2, [0, 0, 0], [3, 0, 0])
    away = normalized(random.normal(size=(count, 3)))
    return np.c_[targets - np.where(np.arange(count)[:, None] % 3, 4, 0.3) * away, away]


# Small, so that rtrace's approximations of their shapes do not show: it takes spheres and rings for squares about their middle,
# cylinders for lines and triangles for rectangles as large, whose random points (-dj) miss them now and then, and spotlights from spheres and rings differ as much as these are large beside their distance.
SHINING = {
    "a triangle": "light L 0 0 3 3e7 2e7 1e7\nL polygon lamp 0 0 9 .1 .1 2 .1 .102 2 .103 .101 2.001",
    "a parallelogram": "light L 0 0 3 3e5 2e5 1e5\nL polygon lamp 0 0 12 .1 .1 2 .11 .12 2 .13 .13 2.01 .12 .11 2.01",
    "a sphere": "light L 0 0 3 3e5 2e5 1e5\nL sphere lamp 0 0 4 .1 .2 2 .01",
    "a ring": "light L 0 0 3 3e5 2e5 1e5\nL ring lamp 0 0 8 .1 .2 2 .1 .2 -1 0 .01",
    "a cylinder": "light L 0 0 3 3e7 2e7 1e7\nL cylinder lamp 0 0 7 .1 .2 2 .15 .25 2.05 .00003",
    "a distant light": "light L 0 0 3 3e6 2e6 1e6\nL source lamp 0 0 4 .1 .2 2 .5",
    "a glow as far as it reaches": "glow L 0 0 4 3e5 2e5 1e5 2.9\nL sphere lamp 0 0 4 .1 .2 2 .01",
    "a glow that lights nothing": "glow L 0 0 4 3e5 2e5 1e5 -1\nL sphere lamp 0 0 4 .1 .2 2 .01\nvoid glow M 0 0 4 3 2 1 1\nM source all 0 0 4 0 0 1 360\n"
    "void light dim 0 0 3 9 9 9\ndim sphere other 0 0 4 2 1 3 .3",
    "a spotlight": "spotlight L 0 0 7 3e5 2e5 1e5 60 .1 .2 -1\nL polygon lamp 0 0 12 .1 .1 2 .1 .11 2 .11 .11 2 .11 .1 2",
    "the light of an alias": "light Q 0 0 3 3e5 2e5 1e5\nvoid brightfunc half 2 .5 . 0 0\nhalf alias L Q\nL sphere lamp 0 0 4 .1 .2 2 .01",
}


JITTER = {"a triangle": "-dj 0", "a cylinder": "-dj .5"}


def lamps(random):
    under = sensors([-2.2, -2.2, 0], [2.2, 2.2, 0], 64, [0, 0, 1], random)
    for name, text in SHINING.items():
        yield Case(f"light of {name}", f"{FLOOR}void {text}\n", under, "-I -ab 0", JITTER.get(name, ""),
                   repeat=64)
        yield Case(f"light of {name}, seen", f"{FLOOR}void {text}\n", aim([.3, -3, 1.5], under[:36, :3] * .7), "-ab 0",
                   JITTER.get(name, ""), repeat=32)


# What Radiance guesses at in silence, and Graze with a warning.
GUESSED = {
    "a source's angle above 360": "light L 0 0 3 3e6 2e6 1e6\nL source lamp 0 0 4 .1 .2 2 719.5\n"
    "void glow M 0 0 4 3 2 1 -1\nM source sky 0 0 4 0 0 1 600",
    "a spotlight's angle above 360": "spotlight L 0 0 7 3e5 2e5 1e5 660 .1 .2 -1\nL polygon lamp 0 0 12 .1 .1 2 .1 .11 2 .11 .11 2 .11 .1 2",
    "alternates that are not there": "light L 0 0 3 3e5 2e5 1e5\nL polygon lamp 0 0 12 .1 .1 2 .1 .11 2 .11 .11 2 .11 .1 2\n"
    "void illum I 1 nowhere 0 3 3e2 3e2 3e2\nI polygon window 0 0 12 1 -1 1 1 -.9 1 1.1 -.9 1 1.1 -1 1\n"
    "void antimatter A 1 nowhere 0 0\nA sphere ball 0 0 4 -1 1 .8 .5\n"
    "void mirror R 1 nowhere 0 3 .8 .7 .6\nR polygon glass 0 0 12 2.5 -2 0 2.5 -2 1 2.5 2 1 2.5 2 0",
}


# A source with a mixture is not there, and neither what it would shine by.
GUESSED["a source of a mixture"] = (
    "glow M 0 0 4 3 2 1 -1\nM source sky 0 0 4 0 0 1 360\nvoid glow N 0 0 4 9 9 9 0\nvoid mixfunc X 4 N void .5 . 0 0\nX source sun 0 0 4 .2 0 1 60\n"
    "void light L 0 0 3 3e5 2e5 1e5\nL polygon lamp 0 0 12 .1 .1 2 .1 .11 2 .11 .11 2 .11 .1 2")


def guesses(random):
    under = sensors([-2.2, -2.2, 0], [2.2, 2.2, 0], 64, [0, 0, 1], random)
    looking = np.vstack([aim([.3, -3, 1.5], under[:, :3]), aim([0, 0, 1], [0, 0, 1] + normalized(random.normal(size=(64, 3))))])
    for name, text in GUESSED.items():
        yield Case(f"{name}: light", f"{FLOOR}void {text}\n", under, "-I -ab 0 -w-", "-dr 1", repeat=64)
        yield Case(f"{name}: seen", f"{FLOOR}void {text}\n", looking, "-ab 0 -w-", "-dr 1", repeat=32)


# What stands for `xform` and its words; the scene's other lines are in a file of its own.
PART = """
void plastic leaf 0 0 5 .2 .6 .1 .05 .2
void brightfunc grain 4 .6+.4*sin(9*Px) . -s 2 0 0
grain plastic2 bark 4 1 .2 0 . 0 6 .5 .4 .3 .1 .1 .3
leaf polygon card 0 0 12 0 0 0 .6 0 0 .6 .4 .2 0 .4 .2
bark cone trunk 0 0 8 .3 .2 -.6 .3 .2 0 .2 .1
bark sphere fruit 0 0 4 .3 .2 .4 .2
leaf ring plate 0 0 8 .3 .2 .7 .1 0 1 .1 .3
"""
TRANSFORMS = {
    "turned and moved": "-rx 30 -ry -20 -rz 50 -t .5 .3 .2",
    "mirrored and scaled": "-mx -s 1.4 -my -mz -mx -t .2 .1 -.3",
    "repeated": "-t .1 0 0 -i 3 -rz 10 -t .1 0 .1 -i 1 -s .8",
    "an array": "-a 4 -t .9 .1 0",
    "an array of arrays": "-n grove -a 3 -t .9 0 0 -a 2 -t 0 1 .1 -i 1 -t -1 -1 0 -rz 10",
    "a spiral": "-a 7 -rz 51 -t .2 0 .1 -s .9",
    "inside out": "-I -rz 20",
    "another material": "-m other -rz 20",
    "a name": "-n tree -t .2 0 0",
}


def transforms(random):
    rays = np.vstack([around(60, random)[::2], aim([.4, -3, 2.5], random.uniform([-1, -1, -.5], [2, 1, 1], (60, 3)))])
    for name, words in TRANSFORMS.items():
        quoted = PART.replace("\n", " ")
        text = f"{LAMPS}void metal other 0 0 5 .6 .5 .4 .6 .3\n!echo '{quoted}' | xform {words}\n!echo '{quoted}' | xform -t -3 0 0 | xform {words}\n"
        yield Case(f"transform: {name}", text, rays, "-ab 0 -st 1", repeat=16)
        yield Geometry(f"transform: {name}", text, rays, "LpNnsmM")
    yield Geometry("transforms of a file of transforms", "!xform -f moves.xf part.rad\n!xform -n row -f moves.xf -t 0 2 0 part.rad\n", rays, "LpNsmM")


# What makes surfaces of which form, with smoothed normals and textures of their own.
GENERATED = {
    "genbox": "!genbox shiny crate 1.2 .8 .6 | xform -rz 20 -t -.5 -.4 0",
    "genbox, beveled": "!genbox shiny crate 1.2 .8 .6 -b .1 -i | xform -t -.5 -.4 0",
    "genbox, rounded": "!genbox shiny crate 1.2 .8 .6 -r .1 | xform -t -.5 -.4 0",
    "gensurf": "!gensurf shiny hill '2*s-1' '2*t-1' '.4*sin(4*s)*cos(5*t)' 6 7",
    "gensurf, smooth": "!gensurf shiny hill '2*s-1' '2*t-1' '.4*sin(4*s)*cos(5*t)' 6 7 -s",
    "genrev": "!genrev shiny vase 't' '.6+.2*sin(6*t)' 8",
    "genrev, smooth": "!genrev shiny vase 't' '.6+.2*sin(6*t)' 8 -s",
    "genworm": "!genworm shiny worm 'cos(4*t)' 'sin(4*t)' 't' '.1+.1*t' 9",
    "genprism": "!genprism shiny plate 5 -1 -1 1 -1 1.2 .2 0 1 -1 .8 -l .1 .1 .5",
    "genprism, rounded": "!genprism shiny plate 5 -1 -1 1 -1 1.2 .2 0 1 -1 .8 -l 0 0 .5 -r .15",
    "genblinds": "!genblinds shiny blind .1 2 1 8 40 | xform -t -.5 -1 0",
}


def generators(random):
    rays = np.vstack([aim([.4, -3, 2.5], random.uniform([-1, -1, -.2], [1, 1, .8], (80, 3))),
                      aim([-.4, 2.5, -1.5], random.uniform([-1, -1, -.2], [1, 1, .8], (40, 3)))])
    for name, command in GENERATED.items():
        text = f"{LAMPS}void plastic shiny 0 0 5 .7 .6 .5 .05 .2\n{command}\n"
        yield Case(f"{name}", text, rays, "-ab 0 -st 1", repeat=16, commands=True)
    stone = "void plastic stone 0 0 5 .4 .38 .35 0 0\nstone polygon wall 0 0 12  -2 1 0  2 1 0  2 1 1.5  -2 1 1.5\n"
    ground = "\nskyfunc glow sky_glow 0 0 4 .9 1 1.2 0\nsky_glow source sky 0 0 4 0 0 1 180\nskyfunc glow ground_glow 0 0 4 1 .9 .6 0\nground_glow source ground 0 0 4 0 0 -1 180\n"
    upward = np.vstack([sensors([-2, -2, 0], [2, 2, 0], 16, [0, 0, 1], random), sensors([-2, .9, .1], [2, .9, 1.4], 9, [0, -1, 0], random)])
    looking = aim([0, 0, 1], [0, 0, 1] + normalized(random.normal(size=(40, 3))))
    for name, command in {
        "gensky, sunny": "!gensky 6 21 11.5 +s -a 47 -o -15 -m -15 -g .2 -t 3", "gensky, no sun": "!gensky 3 21 9 -s", "gensky, overcast": "!gensky 12 21 12 -c -B 50",
        "gensky, uniform": "!gensky -ang 40 30 -u", "gensky, intermediate": "!gensky 9 21 15 +i",
        "gendaylit": "!gendaylit 6 21 11.5 -W 700 120 -a 47 -o -15 -m -15", "gendaylit, overcast": "!gendaylit 12 21 12 -W 30 120 -a 47 -o -15 -m -15",
        "gendaylit, turned": "!gendaylit -ang 35 -40 -W 500 200 | xform -rz 25",
    }.items():
        yield Case(f"{name}, irradiance", command + ground + stone, upward, "-I -ab 1", "-ad 512", repeat=64, samples=8192, commands=True)
        yield Case(f"{name}, seen", command + ground, looking, "-ab 0", repeat=8, commands=True)
    under = sensors([-2.2, -2.2, 0], [2.2, 2.2, 0], 64, [0, 0, 1], random)
    # Of which size the luminaire is; ies2rad makes a rectangle, a box, a disk or a small ball of it.
    for i, (form, size, options) in enumerate([("rectangle", ".3 .2 0", ""), ("box", ".2 .2 .1", "-t default -c 1 .9 .7"),
                                               ("disk", "-.02 0 0", "-m .8"), ("point", "0 0 0", "-df")]):
        yield Case(f"ies2rad, {form}", f"{FLOOR}!sed 's/SIZE/{size}/' luminaire.ies >FOLDER/{i}.ies; ies2rad {options} -o FOLDER/lamp{i} FOLDER/{i}.ies "
                   f"2>FOLDER/log{i}; xform -rz 30 -t .1 .2 2.5 FOLDER/lamp{i}.rad\n", under, "-I -ab 0", repeat=256, commands=True)


def octrees(random):
    rays = aim([.3, -1, 5], grid([-2.4, -2.4, 0], [2.4, 2.4, 0], 144, random))
    for name, options in {"frozen": "-f", "not frozen": "", "frozen, with other cells": "-f -n 3 -r 2048"}.items():
        yield Case(f"an octree, {name}", "lamp patterns", rays, "-ab 0", repeat=64, octree=options, own_repeat=64)
    yield Case("a frozen octree of commands", f"{LAMPS}void plastic leaf 0 0 5 .2 .6 .1 .05 .2\n!genbox leaf box 1 1 1 | xform -a 3 -t 1.2 .1 0\n",
               aim([.4, -3, 2.5], random.uniform([0, 0, 0], [3, 1, 1], (60, 3))), "-ab 0 -st 1", repeat=16, octree="-f")


def instance(modifier, of, words):
    """A command that makes an octree of a scene, and an instance of that."""
    return f"!oconv -f {of}.rad >FOLDER/{of}.oct && echo {modifier} instance {of} {1 + len(words.split())} FOLDER/{of}.oct {words} 0 0\n"


def volumes(random):
    """Antimatter and mist in instances, and as the modifiers of some."""
    lamp = "void light lit 0 0 3 5e7 4e7 3e7\nlit sphere lamp 0 0 4 .2 -.3 2.9 .0001\n"
    floor = "void plastic grey 0 0 5 .5 .4 .3 0 0\ngrey polygon floor 0 0 12 -3 -3 0 3 -3 0 3 3 0 -3 3 0\n"
    seen = np.vstack([aim(eye, grid([-2, -1.6, .01], [2, 1.2, .01], 100, random) + [0, 0, .6] * (np.arange(100)[:, None] % 2)) for eye in [[.1, -4, 2], [-2, 1, 3]]])
    bitten = lamp + floor + instance("void", "bitten", "-s .8 -t 0 -.6 0") + instance("void", "bitten", "-mx -rz 30 -s .7 -t 0 .8 .2")
    yield Case("antimatter in instances", bitten, seen, "-ab 0", "-dj 0", repeat=2, commands=True, letter="x")
    cut = lamp + floor + "void plastic red 0 0 5 .7 .2 .1 0 0\nred sphere ball 0 0 4 0 0 1 .7\nvoid antimatter hole 1 red 0 0\n"
    yield Case("instances of antimatter", cut + instance("hole", "blob", "-s .5 -t .3 -.5 1.2") + instance("red", "blob", "-s .5 -t 1.4 0 .8")
               + "hole sphere other 0 0 4 1.3 -.3 1 .3\n", seen, "-ab 0", "-dj 0", repeat=2, commands=True, letter="x")
    foggy = aim([.1, -4, 1.2], grid([-2.2, 0, .05], [2.2, 0, 2.2], 100, random))
    clouds = lamp + floor + instance("void", "cloud", "-t -.4 0 0") + instance("void", "cloud", "-s .7 -t 1.4 .3 .2")
    yield Case("mist in instances", clouds, foggy, "-ab 0 -av .1 .2 .3 -ma .8 .7 .6 -mg .5", "-ms .05", repeat=128, samples=16384, commands=True)
    yield Case("instances of mist", lamp + floor + "void mist fog 1 lamp 0 3 .5 .25 .75\n" + instance("fog", "blob", "-s .8 -t -.5 0 1"), foggy[::2],
               "-ab 0 -av .1 .2 .3 -ma .8 .7 .6 -mg .5", "-ms .05", repeat=128, samples=16384, commands=True)


def cases():
    random = np.random.default_rng(20261123)
    for name, numbers in SHAPES.items():
        text = BODY + LAMPS + shape(name, numbers, "painted", "0 0 0") + shape(name, numbers, "ember", "3 0 0")
        rays = around(96, random)
        yield Case(f"{name}, both sides", text, rays, "-ab 0 -st 1", repeat=16)
        yield Case(f"{name}, turned inside out", text.replace("xform -t", "xform -I -t"), rays[:48], "-ab 0 -st 1", repeat=16)
    everything = BODY + LAMPS + "".join(
        shape(name, numbers, "painted", f"{3 * (i % 4)} {3 * (i // 4)} 0") for i, (name, numbers) in enumerate(SHAPES.items()))
    rays = np.vstack([around(48, random) + [3 * i, 3 * j, 0, 0, 0, 0] for i in (0, 2) for j in range(3)])
    yield Case("backs unseen", everything, rays, "-ab 0 -st 1 -bv-", repeat=16)
    yield Case("no farther than that", everything, rays * [1, 1, 1, 3.9, 3.9, 3.9], "-ab 0 -st 1 -ld+", repeat=16)

    yield from lamps(random)
    yield from guesses(np.random.default_rng(360))
    yield from transforms(random)
    yield from generators(random)
    yield from octrees(random)
    yield from volumes(random)


if __name__ == "__main__":
    main(cases())
