"""The same rays through real rtrace and through gtrace: TAP.

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

gtrace.py [CASE...] runs the cases named. GRAZE_PEER_SEED sets the seed of both sides (1)."""

import os
import struct
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(HERE, "scenes")
BIN = os.environ["BIN"]
PEER = os.environ["GRAZE_PEER_BIN"]
SEED = os.environ.get("GRAZE_PEER_SEED", "1")

CONVERGED = "-u+ -dj 1 -ds .01 -dt 0 -dc 1 -dr 0 -st 0 -lw 1e-6 -lr -12 -aa 0 -as 0".split()
FAR = 1e10


def run(command, data, **environment):
    done = subprocess.run(command, input=data, capture_output=True, cwd=SCENES, env={**os.environ, **environment})
    # A scene of glows has none of what Radiance calls light sources.
    errors = done.stderr.decode(errors="replace").replace("rtrace: warning - no light sources found\n", "")
    if done.returncode != 0 or errors:
        raise RuntimeError(f"{' '.join(command)}: status {done.returncode}: {errors[:2000]}")
    return done.stdout


class Radiance:
    """Real oconv and rtrace, with a clock that stands still and the right Fresnel constant."""

    def __init__(self, folder):
        self.folder = folder
        clock = os.path.join(folder, "repeatable.so")
        subprocess.run(["cc", "-shared", "-fPIC", "-o", clock, os.path.join(HERE, "repeatable.c")], check=True)
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

    def trace(self, scenes, options, data):
        octree = run(["oconv", *files(scenes)], b"", PATH=self.environment["PATH"], RAYPATH=self.environment["RAYPATH"])
        with tempfile.NamedTemporaryFile(dir=self.folder, suffix=".oct") as file:
            file.write(octree)
            file.flush()
            return run([self.rtrace, "-h", *options, file.name], data, **self.environment)


def files(scenes):
    return [name + ".rad" for name in scenes.split()]


def gtrace(scenes, options, data):
    return run([os.path.join(BIN, "gtrace"), "-h", *options, *files(scenes)], data)


def standard_normal(t, freedom):
    """The normal deviate as improbable as Student's t (Wallace 1959)."""
    size = (8 * freedom + 1) / (8 * freedom + 3) * np.sqrt(freedom * np.log1p(t * t / freedom))
    return np.copysign(size, t)


class Case:
    """Radiance traces each of `parts`, whose light adds up to the scene's, with `repeat` repetitions."""

    def __init__(self, name, scene, rays, options, peer_options="", repeat=64, samples=4096, parts=None, own_options="", letter="v"):
        self.name, self.scene, self.parts, self.rays = name, scene, parts or [scene], np.asarray(rays, "<f4")
        self.options, self.peer_options, self.own_options = options.split(), peer_options.split(), own_options.split()
        self.repeat, self.samples, self.letter = repeat, samples, letter

    def radiance(self, radiance):
        data = np.repeat(self.rays, self.repeat, axis=0).tobytes()
        options = [*CONVERGED, *self.options, *self.peer_options, "-ff", "-o" + self.letter]
        parts = [np.frombuffer(radiance.trace(part, options, data), "<f4") for part in self.parts]
        values = sum(part.reshape(len(self.rays), self.repeat, 3).astype(float) for part in parts)
        return values.mean(1), values.std(1, ddof=1) / np.sqrt(self.repeat), self.repeat - 1

    def graze(self):
        # Independent estimates, whose scatter is known better than the error they state: where light is smooth that is too large,
        # and letters other than v have none.
        repeat = 32
        data = np.repeat(self.rays, repeat, axis=0).tobytes()
        letters = "ve" if self.letter == "v" else self.letter
        options = [*self.options, *self.own_options, "--samples", str(self.samples // repeat), "--seed", SEED, "-o" + letters, "-ff"]
        answers = np.frombuffer(gtrace(self.scene, options, data), "<f4").reshape(len(self.rays), repeat, -1, 3).astype(float)
        values, stated = answers[:, :, 0], answers[:, :, -1]
        scatter = values.std(1, ddof=1)
        if self.letter == "v":
            # A choice between two things that are known, by stratified numbers, falls out alike almost always: that there is no
            # scatter then tells nothing.
            scatter = np.where(scatter > 0, scatter, np.sqrt((stated**2).mean(1)))
        return values.mean(1), scatter / np.sqrt(repeat), repeat - 1

    def results(self, radiance):
        r, r_error, r_freedom = self.radiance(radiance)
        g, g_error, g_freedom = self.graze()
        variance = r_error**2 + g_error**2
        # Welch and Satterthwaite's degrees of freedom of the difference.
        with np.errstate(divide="ignore", invalid="ignore"):
            freedom = variance**2 / (r_error**4 / r_freedom + g_error**4 / g_freedom)
        freedom = np.where(np.isfinite(freedom), freedom, min(r_freedom, g_freedom))
        # rtrace computes colours in single precision.
        sigma = np.sqrt(variance + (1e-5 * np.maximum(abs(r), abs(g))) ** 2)
        t = np.divide(g - r, sigma, out=np.zeros_like(r), where=sigma > 0)
        z = standard_normal(t, freedom)
        notes = [f"{len(r)} rays, mean radiance {r.mean(0).round(6)}, median relative error of rtrace "
                 f"{np.median(r_error[r > 0] / r[r > 0]):.1e}, of gtrace {np.median(g_error[g > 0] / g[g > 0]):.1e}"]

        worst = np.unravel_index(np.argmax(abs(z)), z.shape)
        notes.append(f"worst ray {worst[0]} channel {worst[1]}: rtrace {r[worst]:.6g} +- {r_error[worst]:.2g}, "
                     f"gtrace {g[worst]:.6g} +- {g_error[worst]:.2g}, z = {z[worst]:.2f}, ray {self.rays[worst[0]]}")
        every = np.isfinite(g).all() and (abs(z) <= 4.5).all()

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
        ours = self.table(gtrace(self.scene, ["-faa", "-o" + self.fields, "--samples", "2"], data))
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
        ours = self.contributions(gtrace(self.scene, [*self.options, *self.own_options, "-oTsV"], data))
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
    turned = np.vstack([np.c_[other.uniform(-0.6, 0.6, (60, 2)), np.zeros(60)], normalized(other.normal(size=(60, 3))) * 0.6 + [2, 0, 0.6]])
    yield Case("grooves by functions", "lamp lathe", aim([0.4, -2, 3], turned), "-ab 0 -st 1", repeat=256)
    terrace = np.vstack([floor[::3], sensors([-2, 1, 0.1], [2, 1, 1.4], 36, [0, -1, 0], random)])
    around = aim([0, 0, 3], [0, 0, 3] + normalized(other.normal(size=(64, 3))) * [1, 1, 0.5])
    for sky in ["sky_clear", "sky_perez", "sky_picture"]:
        yield Case(sky + ", irradiance", sky + " terrace", terrace[::2], "-I -ab 1", "-ad 1024", repeat=64, samples=8192)
        yield Case(sky + ", seen", sky, around, "-ab 0", repeat=64)
    yield Case("luminaires", "luminaires", aim([0.5, -3, 2.5], floor[:, :3] * 0.7), "-ab 0", repeat=256)
    yield Case("luminaires, seen", "luminaires", aim([0.1, 0.2, 0.1], [[-0.8, -0.8, 2], [-0.7, -0.9, 2], [1.01, 1.02, 1.6], [1, -1.05, 1.8], [-1, 1, 2]]), "-ab 0", repeat=64)
    yield Case("screen", "screen", aim([0.5, -3, 2.5], floor[:, :3] * 0.7), "-ab 0 -st 1", repeat=256)
    squares = np.c_[other.uniform(-2, 2, (120, 2)), np.zeros(120)]
    yield Case("reflectance functions", "lamp functions", aim([0.4, -2, 3], squares), "-ab 0", repeat=256)
    yield Case("reflectance functions from below", "lamp functions", aim([0.4, -2, -3], squares), "-ab 0", repeat=256)
    yield Case("WGMDfunc", "lamp wgmd", aim([0.4, -2, 3], squares), "-ab 0 -st 1", repeat=256)
    yield Case("WGMDfunc from below", "lamp wgmd", aim([0.4, -2, -3], squares), "-ab 0 -st 1", repeat=256)
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


def main():
    if not os.access(os.path.join(BIN, "gtrace"), os.X_OK):
        sys.exit("no gtrace in " + BIN)
    chosen = [case for case in cases() if len(sys.argv) == 1 or any(word in case.name for word in sys.argv[1:])]
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


main()
