"""Scenes in which light goes many ways, through real rtrace and gtrace: TAP. test/support/peer.py says how they are compared."""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../support"))
from peer import Case, Geometry, Tree, aim, grid, main, normalized, sensors


def cases():
    random = np.random.default_rng(20100401)
    up, floor = [0, 0, 1], sensors([-2, -2, 0], [2, 2, 0], 144, [0, 0, 1], random)
    room = np.vstack([sensors([0.1, 0.1, 0], [3.9, 2.9, 0], 64, up, random),
                      sensors([0, 0.1, 0.1], [0, 2.9, 2.4], 25, [1, 0, 0], random),
                      sensors([0.1, 3, 0.1], [3.9, 3, 2.4], 25, [0, -1, 0], random)])
    yield Case("box, panel light, irradiance", "box", room, "-I -ab 0", repeat=256)
    yield Case("box, two bounces, irradiance", "box", room[::2], "-I -ab 2", "-ad 1024", repeat=64, samples=32768)
    yield Case("box, one bounce, radiance", "box", aim([3.2, 0.4, 1.5], grid([0.2, 2.9, 0.1], [3.8, 2.9, 2.3], 49, random)),
               "-ab 1", "-ad 2048", repeat=64, samples=32768)
    yield Case("sphere light, irradiance", "sphere_light", floor, "-I -ab 0", repeat=512)
    yield Case("disk and tube lights, radiance", "ring_cylinder",
               aim([0.5, -3, 2], grid([-1.5, -1.5, 0], [1.5, 1.5, 0], 144, random)), "-ab 0", "-dj .5", repeat=512)
    yield Case("sun and sky, irradiance", "sky",
               np.vstack([floor[::2], sensors([-2, 1, 0.1], [2, 1, 1.4], 36, [0, -1, 0], random)]),
               "-I -ab 1", "-ad 2048", repeat=64, samples=16384)
    yield Case("sources that overlap, irradiance", "suns",
               np.vstack([floor[1::2], sensors([-2, 1, 0.1], [2, 1, 1.4], 36, [0, -1, 0], np.random.default_rng(20100404))]),
               "-I -ab 1", "-ad 2048", repeat=64, samples=16384)
    yield Case("sources that overlap, seen", "suns", aim([0, 0, 1], [[0.3, -0.2, 1.8], [0.316, -0.2, 1.8], [0.4, 0, 1.8], [-1, 0, 1.8]]),
               "-ab 0", repeat=64)
    yield Case("spotlights, irradiance", "spot", sensors([-2, -1, 0], [2, 1, 0], 144, up, random), "-I -ab 0", repeat=256)

    ball = normalized(random.normal(size=(150, 3))) * [1, 1, 1] + [0, 0, 1]
    yield Case("glossy ball", "plastic_sphere", aim([0, -6, 2.5], ball), "-ab 0", "-ss 2048", repeat=48, samples=8192)
    plate = random.uniform(-0.7, 0.7, size=(120, 2)) @ [[0.8, 0.55], [-0.55, 0.8]]
    yield Case("brushed plate, turned", "brushed brushed_panel brushed_glows",
               aim([-0.2, -2.5, 1.2], np.c_[plate, np.full(len(plate), 0.1)]), "-ab 0", "-ss 1024", repeat=512,
               samples=16384, parts=["brushed brushed_panel", "brushed brushed_shadow brushed_glows"])
    yield Case("facing mirrors", "mirrors", aim([0.3, 1, 1.2], grid([-0.9, 0, 0.1], [0.9, 0, 1.9], 100, random)),
               "-ab 0", repeat=64)
    other = np.random.default_rng(20100402)
    across = aim([0.3, 1, 1.2], grid([-0.9, 0, 0.1], [0.9, 0, 1.9], 49, other))
    across[:, 3:] *= np.where(np.arange(len(across)) % 2, 1, -1)[:, None]
    yield Case("facing mirrors, what they show", "mirrors", across, "-ab 0", repeat=64, letter="r")
    yield Case("facing mirrors, the rest", "mirrors", across, "-ab 0", repeat=64, letter="x")
    walls = aim([3.2, 0.4, 1.5], grid([0.2, 2.9, 0.1], [3.8, 2.9, 2.3], 16, other))
    yield Case("box, irradiance where rays hit", "box", walls, "-i -ab 1", "-ad 2048", repeat=64, samples=32768)
    yield Case("box, white walls left out of interreflection", "box", room[::3], "-I -ab 2 -av .3 .2 .1 -ae white", "-ad 1024",
               repeat=64, samples=32768)
    yield Case("box, interreflection on red and green walls alone", "box", room[1::3], "-I -ab 2 -av .3 .2 .1 -ai red -ai green",
               "-ad 1024", repeat=64, samples=32768)
    yield Tree("trees, facing mirrors", "mirrors", across[14:35], "-ab 0", "", 16)
    yield Tree("trees, box, two bounces", "box", walls[::2], "-ab 2", "-ad 16 -ds 0", 64)
    along = 10 ** random.uniform(0.4, 1.6, 120)
    yield Case("grazing plane", "grazing", aim([0, 0, 0.1], np.c_[random.uniform(-0.05, 0.05, 120) * along, along, 0 * along]),
               "-ab 0", "-ss 64 -ds .001", repeat=512, samples=8192)
    # What Radiance does by default, drawing again and leaving the weights out, is `--strategy unweighted`.
    yield Case("grazing plane, a glow, without weights", "grazing_glow",
               aim([0, 0, 0.1], np.c_[random.uniform(-0.05, 0.05, 60) * along[:60], along[:60], 0 * along[:60]]),
               "-ab 0", "-ss 1", repeat=16384, samples=65536, own_options="--strategy unweighted")

    tiles = np.c_[[[-2.4 + 1.2*(i % 4), -2.4 + 1.2*(i // 4), 0] for i in range(16)]].repeat(9, axis=0)
    tiles += np.c_[other.uniform(0.02, 1.08, (144, 2)), np.zeros(144)]
    yield Case("patterns, textures, mixtures", "lamp patterns", aim([0.3, -1, 5], tiles), "-ab 0", repeat=512)
    yield Case("patterns seen from below", "lamp patterns", aim([0.3, -1, -5], tiles), "-ab 0", repeat=64)
    outward, middle = normalized(other.normal(size=(200, 3))), np.where(np.arange(200)[:, None] % 2, [0, 0, 1], [2.5, 0, 1])
    relief = 0.8 * outward + middle
    seen = (([1, -3, 1.5] - relief) * outward).sum(1) > 0
    yield Case("relief", "lamp relief", aim([1, -3, 1.5], relief[seen]), "-ab 0 -st 1", repeat=512)
    ground = sensors([-2.6, -3, 0], [2.9, 2, 0], 400, up, np.random.default_rng(20221122))[:, :3]
    yield Case("rounded surfaces, tilted lamps", "lamp rounded", aim([0.5, -4, 4], ground), "-ab 0 -st 1", repeat=256)
    turned = np.vstack([np.c_[other.uniform(-0.6, 0.6, (60, 2)), np.zeros(60)], normalized(other.normal(size=(60, 3))) * 0.6 + [2, 0, 0.6]])
    yield Case("grooves by functions", "lamp lathe", aim([0.4, -2, 3], turned), "-ab 0 -st 1", repeat=256)
    terrace = np.vstack([floor[::3], sensors([-2, 1, 0.1], [2, 1, 1.4], 36, [0, -1, 0], random)])
    around = aim([0, 0, 3], [0, 0, 3] + normalized(other.normal(size=(64, 3))) * [1, 1, 0.5])
    for sky in ["sky_clear", "sky_perez", "sky_picture"]:
        yield Case(sky + ", irradiance", sky + " terrace", terrace[::2], "-I -ab 1", "-ad 1024", repeat=64, samples=8192)
        yield Case(sky + ", seen", sky, around, "-ab 0", repeat=64)
    yield Case("sky_perez_color, seen", "sky_perez_color", around, "-ab 0", repeat=64)
    windows = np.random.default_rng(20261123).uniform([0, 0, 0], [5, 2, 0], (100, 3))
    yield Case("glazing from both sides", "glazing", np.vstack([aim([2, -2, height], windows) for height in (1.5, -.4)]), "-ab 0", repeat=4)
    yield Case("luminaires", "luminaires", aim([0.5, -3, 2.5], floor[:, :3] * 0.7), "-ab 0", repeat=256)
    yield Case("luminaires, seen", "luminaires", aim([0.1, 0.2, 0.1], [[-0.8, -0.8, 2], [-0.7, -0.9, 2], [1.01, 1.02, 1.6], [1, -1.05, 1.8], [-1, 1, 2]]), "-ab 0", repeat=64)
    yield Case("screen", "screen", aim([0.5, -3, 2.5], floor[:, :3] * 0.7), "-ab 0 -st 1", repeat=256)
    squares = np.c_[other.uniform(-2, 2, (120, 2)), np.zeros(120)]
    yield Case("reflectance functions", "lamp functions", aim([0.4, -2, 3], squares), "-ab 0", repeat=256)
    yield Case("reflectance functions from below", "lamp functions", aim([0.4, -2, -3], squares), "-ab 0", repeat=256)
    yield Case("WGMDfunc", "lamp wgmd", aim([0.4, -2, 3], squares), "-ab 0 -st 1", repeat=256)
    yield Case("WGMDfunc from below", "lamp wgmd", aim([0.4, -2, -3], squares), "-ab 0 -st 1", repeat=256)
    for name, eye in [("from above", [0.4, -2, 3]), ("from below", [0.4, -2, -3])]:
        yield Case("transmission by functions " + name, "lamp letting", aim(eye, squares), "-ab 0 -st 1", repeat=256)
    yield Case("transmission by functions, one bounce", "lamp letting wall", aim([0.4, -2, -3], squares[squares[:, 0] < 0][::3]),
               "-ab 1 -st 1", "-ad 1024", repeat=64, samples=8192)
    yield Case("reflectance functions, one bounce", "lamp functions wall", aim([0.4, -2, 3], squares[squares[:, 0] < 0][::3]), "-ab 1", "-ad 1024", repeat=64)
    # Radiance's diffuse interreflection goes by the surface's own normal: not where there are textures.
    yield Case("patterns, one bounce", "lamp patterns wall", aim([0.3, -1, 5], np.vstack([tiles[:72:4], tiles[99::4]])), "-ab 1 -st 1", "-ad 2048", repeat=64,
               samples=8192)

    # Surfaces that light goes through. Radiance adds a light's size to the width of lobes, so the lamps are small.
    clear = np.random.default_rng(20100403)
    under = sensors([-2.5, -2.5, 0], [2.5, 2.5, 0], 100, up, clear)
    yield Case("floor lit through panes, irradiance", "panes", under, "-I -ab 0", repeat=256)
    yield Case("panes seen from above", "panes", aim([-.5, -3.5, 2.6], grid([-2.5, -2.5, 0], [2.5, 2.5, 0], 100, clear)), "-ab 0",
               repeat=256, samples=16384)
    yield Case("floor under a glass roof, irradiance", "greenhouse", under, "-I -ab 1", "-ad 1024", repeat=64, samples=16384)
    yield Case("glass roof from below", "greenhouse", aim([0, -1, .3], grid([-1.8, -1.8, 1.1], [1.8, 1.8, 1.1], 49, clear)), "-ab 1",
               "-ad 1024", repeat=64, samples=16384)
    yield Case("irradiance where rays hit, behind panes", "panes",
               aim([-.5, -3.5, 2.6], grid([-2.5, -2.5, 0], [-.2, 2.5, 0], 36, clear)), "-i -ab 0", repeat=64)
    below = sensors([-2, -2, -1], [2, 2, -1], 100, up, clear)
    for name, scene in [("WGMDfunc that transmits", "veils"), ("mixtures with void", "holes")]:
        yield Case(f"floor under {name}, irradiance", f"lamp {scene}", below, "-I -ab 0", repeat=256)
        for side, eye in [("from above", [.2, -.4, 14]), ("from below", [.3, -1, -.8])]:
            yield Case(f"{name} {side}", f"lamp {scene}", aim(eye, grid([-2, -2, 0], [2, 2, 0], 100, clear)), "-ab 0", "-ss 64",
                       repeat=256, samples=8192)
    signs = grid([-2, -2, 0], [3.8, 2, 0], 144, clear)
    for side, eye in [("from above", [.2, -.4, 14]), ("from below", [.3, -1, -.8])]:
        yield Case("mixtures that shine " + side, "lamp signs", aim(eye, signs), "-ab 0", "-ss 64", repeat=256, samples=8192,
                   own_options="-w-")
    yield Case("floor under mixtures that shine, irradiance", "lamp signs", below[::4], "-I -ab 1", "-ad 1024", repeat=64,
               samples=16384, own_options="-w-")
    # As deep as the world: of the sky below nothing is left but where nothing is absorbed.
    water = ("void colorfunc c 4 .6+.4*Dx .6+.4*Dy .6+.4*Dz . 0 0\nc glow g 0 0 4 3 2 1 0\ng source sky 0 0 4 0 0 1 360\n"
             "void dielectric d 0 0 5 .5 .9999 1 1.33 0\nd polygon pool 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 2 0\nd polygon lid 0 0 12 -2 -2 3 -2 2 3 2 2 3 2 -2 3\n")
    yield Case("open bodies under a sky", water, np.vstack([aim([.3, -1.5, height], grid([-2, -2, 0], [2, 2, 3], 64, np.random.default_rng(3))) for height in (1, -1)]),
               "-ab 0", repeat=2, samples=16384)
    yield Case("rippled panes", "ripples", aim([.4, -4, 1.2], grid([-2, 0, 0], [3, 0, 2], 144, clear)), "-ab 0", "-ss 64", repeat=256,
               samples=8192)
    sheets = grid([-.95, 0, .1], [1.95, 0, 1.9], 144, clear)
    yield Case("sheets before lamps", "frosted", aim([.4, -2, 1.4], sheets), "-ab 0", "-ds .001 -ss 64", repeat=256, samples=8192)
    yield Case("sheets before a glow", "frosted_glow", aim([.5, -8, 1], sheets), "-ab 1", "-ss 64 -ad 1024", repeat=64, samples=16384)
    yield Case("highlights of ashik2", "ashik", aim([.4, -2, 2], grid([-1.5, -.8, 0], [3.5, 2.8, 0], 144, clear)), "-ab 0", "-ds .001",
               repeat=256, samples=8192)
    yield Case("floor lit by a mirror, irradiance", "images", under, "-I -ab 0", "-dr 1 -dp 0", repeat=512, samples=16384)
    yield Case("mirror and what it lights", "images", aim([.3, -3.5, 2], grid([-2, 2, 0], [2, 2, 2.5], 64, clear)), "-ab 0",
               "-dr 1 -dp 0", repeat=256, samples=16384)
    yield Case("glass ball, drop and bead", "clear", aim([.2, -4, 1.5], grid([-1.8, 0, -.9], [1.9, 0, .9], 144, clear)), "-ab 0",
               repeat=4, samples=32768)

    yield Case("lights in water", "immersed", aim([.1, -4, 1], grid([-.9, 0, -.4], [1, 0, .4], 144, np.random.default_rng(20100406))), "-ab 0 -st 1",
               "-dr 1 -dp 0", repeat=64, samples=16384)

    # Lights that are seen as other things, and what is not where it seems.
    odd = np.random.default_rng(20100405)
    yield Case("illums, irradiance", "illum", sensors([-2.5, -2.5, 0], [2.5, 2.5, 0], 144, up, odd), "-I -ab 0", repeat=256)
    yield Case("illums, one bounce", "illum", sensors([-2.5, -2.5, 1.4], [2.5, 2.5, 1.4], 36, [0, 0, -1], odd), "-I -ab 1", "-ad 1024", repeat=64, samples=16384)
    yield Case("illums, seen", "illum", aim([0, -.5, .3], grid([-1.8, -2.5, 1.7], [1.8, 2.6, 1.7], 100, odd)), "-ab 0 -st 1", repeat=64)
    yield Case("illums, seen from above", "illum", aim([0, 0, 4], grid([-2, -2.5, 0], [2, 2.5, 0], 100, odd)), "-ab 0 -st 1", repeat=256)

    # Radiance's virtual lights in prisms are where it takes them to be by one ray: what only bounces find is exact.
    yield Case("prisms, irradiance", "prisms", sensors([-2.5, -2.5, 0], [2.5, 2.5, 0], 64, up, odd), "-I -ab 1", "-dr 0 -ad 1024", repeat=32, samples=32768)
    yield Case("prisms, seen", "prisms_seen", np.vstack([aim(eye, grid([-2, 1.5, .1], [2, 1.5, 2.1], 81, odd)) for eye in [[.1, -3, 1], [.1, 4, 1]]]),
               "-ab 0", repeat=4, samples=16384)

    yield Case("alternates of mirrors, irradiance", "alternates", sensors([-2.8, -2.8, 0], [2.8, 1.9, 0], 100, up, odd), "-I -ab 0", "-dr 1 -dp 0", repeat=256)
    yield Case("alternates of mirrors, one bounce", "alternates", sensors([-2.8, -2.8, 0], [2.8, 1.9, 0], 36, up, odd), "-I -ab 1", "-dr 1 -dp 0 -ad 1024", repeat=64,
               samples=16384)
    yield Case("alternates of mirrors, seen", "alternates", np.vstack([aim(eye, grid([-2.8, 2, .1], [2.8, 2, 2], 64, odd)) for eye in [[.1, -2, 1], [.1, 4, 1]]]),
               "-ab 0", "-dr 1 -dp 0", repeat=64)

    yield Case("antimatter, seen", "antimatter", np.vstack([aim(eye, grid([-2, -2.2, .01], [2, 1.2, .01], 144, odd) + [0, 0, .6] * (np.arange(144)[:, None] % 2))
               for eye in [[.1, -4, 2], [-2, 1, 3]]]), "-ab 0", repeat=256)
    yield Case("antimatter, irradiance", "antimatter", sensors([-2.8, -1, 0], [2.8, 1.9, 0], 144, up, odd), "-I -ab 0", repeat=256)

    foggy = aim([.1, -4, 1.2], grid([-2.2, 0, .05], [2.2, 0, 2.2], 100, odd))
    yield Case("mist, seen", "mist", foggy, "-ab 0 -av .1 .2 .3 -ma .8 .7 .6 -mg .5", "-ms .05", repeat=128, samples=16384)
    yield Case("mist, irradiance", "mist", sensors([-2.8, -2.8, 0], [2.8, 2.8, 0], 100, up, odd), "-I -ab 0 -ma .8 .7 .6 -mg .5", "-ms .05", repeat=128)
    yield Case("mist everywhere", "mist", foggy[::3], "-ab 0 -av .1 .2 .3 -me .1 .15 .2 -ma .9 .8 .7 -mg .5", "-ms .05", repeat=128, samples=16384)

    away = normalized(random.normal(size=(600, 3)))
    towards = random.uniform([-2.5, -1.5, -1], [2.5, 3, 2.5], size=(600, 3)) - 6 * away
    inside = np.c_[random.uniform([-2, -1, -0.5], [2, 2, 2], size=(600, 3)), away]
    shapes = np.vstack([np.c_[towards, away], inside]).astype("<f4")
    yield Geometry("shapes", "shapes", shapes, "odpLNnsmM")
    yield Geometry("shapes", "shapes", shapes, "lXws")
    yield Geometry("box", "box", room, "pLNs")
    # The effective length, by way of mirrors, which rtrace 6.0 follows only where their material is `mirror`.
    yield Geometry("box", "box", room, "lRs")
    yield Geometry("textures", "lamp patterns relief", np.vstack([aim([0.3, -1, 5], tiles), aim([0.3, -1, -5], tiles[:108])]), "LpnNsmM")
    yield Geometry("turned plate", "brushed brushed_panel brushed_glows", np.vstack([inside, np.c_[0.3 * towards, away]]).astype("<f4"), "LpnNsM")


main(cases())
