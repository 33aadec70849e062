"""The new model in brdfeval and in Radiance's function files, WGMDaniso.cal and WGMDiso.cal, by rcalc: TAP.

Pairs of directions all over the hemisphere, near the mirror direction, grazing, and with one below the surface. Both sides
get and give doubles in binary; brdfeval's ASCII must be the same numbers. The function files compute the formula as it
stands. With u = 2^-53 and the exponent x, each of their operations rounding once, the exponent is good to 10 u |x|, and the
value to (28 + 10 |x|) u, brdfeval's own error included: so far they may be apart, and no further.

GRAZE_PEER_SEED sets the seed (1)."""

import os
import re
import subprocess
import sys
import tempfile

import numpy as np

BIN = os.environ["BIN"]
RCALC = os.path.join(os.environ["GRAZE_PEER_BIN"], "rcalc")
LIBRARY = os.environ["GRAZE_PEER_RAYPATH"]
UNIT = 2.0**-53
COUNT = 4000


def run(command, data):
    done = subprocess.run(command, input=data, capture_output=True)
    if done.returncode != 0 or done.stderr:
        raise RuntimeError(f"{' '.join(command)}: status {done.returncode}: {done.stderr.decode(errors='replace')[:500]}")
    return done.stdout


def on_sphere(z, azimuth):
    sine = np.sqrt(1 - z * z)
    return np.stack([sine * np.cos(azimuth), sine * np.sin(azimuth), z], -1)


def pairs(random, alpha_x, alpha_y):
    """COUNT pairs of each kind, as rows lx ly lz vx vy vz."""
    azimuth = random.uniform(0, 2 * np.pi, (6, COUNT))
    anywhere = on_sphere(random.random(COUNT), azimuth[0]), on_sphere(random.random(COUNT), azimuth[1])
    v = on_sphere(random.uniform(0.05, 1, COUNT), azimuth[2])
    slope = random.normal(size=(COUNT, 2)) * [alpha_x, alpha_y]
    half = np.c_[slope, np.ones(COUNT)] / np.sqrt(1 + (slope**2).sum(1))[:, None]
    highlight = 2 * (v * half).sum(1)[:, None] * half - v, v
    low = 10 ** random.uniform(-8, -1, (2, COUNT))
    grazing = on_sphere(low[0], azimuth[3]), on_sphere(low[1], azimuth[4])
    below = on_sphere(-random.random(COUNT), azimuth[5]), on_sphere(random.random(COUNT), azimuth[0])
    rows = np.vstack([np.hstack(kind) for kind in (anywhere, highlight, grazing, below, below[::-1])])
    # The function files would also reflect between two directions below the surface.
    return rows[(rows[:, 2] > 0) | (rows[:, 5] > 0)]


def function_file(folder, name, parameters):
    """A copy with other values of its parameters."""
    with open(os.path.join(LIBRARY, name)) as file:
        text = file.read()
    for parameter, value in parameters.items():
        text, count = re.subn(rf"^{parameter} : .*;", f"{parameter} : {value!r};", text, flags=re.M)
        if count != 1:
            raise RuntimeError(f"{name} has no parameter {parameter}")
    path = os.path.join(folder, name)
    with open(path, "w") as file:
        file.write(text)
    return path


def exponents(rows, alpha_x, alpha_y):
    h = rows[:, :3] + rows[:, 3:]
    with np.errstate(divide="ignore", invalid="ignore"):
        return ((h[:, 0] / alpha_x) ** 2 + (h[:, 1] / alpha_y) ** 2) / h[:, 2] ** 2


def radiance(folder, rows, alpha_x, alpha_y, specular, diffuse, isotropic):
    parameters = {"rho_d": diffuse, "rho_s": specular}
    parameters |= {"a": alpha_x} if isotropic else {"ax": alpha_x, "ay": alpha_y}
    name = "WGMDiso" if isotropic else "WGMDaniso"
    command = [RCALC, "-id6", "-od", "-f", function_file(folder, name + ".cal", parameters)]
    command += ["-e", f"$1={name.lower()}($1,$2,$3,$4,$5,$6)"]
    return np.frombuffer(run(command, rows.tobytes()), "<f8")


def graze(rows, alpha_x, alpha_y, specular, diffuse):
    options = f"-ax {alpha_x!r} -ay {alpha_y!r} -rs {specular!r} -rd {diffuse!r}"
    command = [os.path.join(BIN, "brdfeval"), *options.split()]
    binary = np.frombuffer(run([*command, "-fd"], rows.tobytes()), "<f8")
    text = "".join(" ".join(f"{x:.17g}" for x in row) + "\n" for row in rows)
    return binary, np.array(run([*command, "-fa"], text.encode()).split(), float)


def case(folder, random, alpha_x, alpha_y, specular, diffuse, isotropic=False):
    rows = pairs(random, alpha_x, alpha_y)
    theirs = radiance(folder, rows, alpha_x, alpha_y, specular, diffuse, isotropic)
    ours, ascii = graze(rows, alpha_x, alpha_y, specular, diffuse)
    counts = len(theirs), len(ours), len(ascii)
    if set(counts) != {len(rows)}:
        return False, False, [f"{len(rows)} pairs, and so many answers of rcalc, and of brdfeval: {counts}"]
    x = exponents(rows, alpha_x, alpha_y)
    above = (rows[:, 2] > 0) & (rows[:, 5] > 0)
    # Below exp(-700) neither is a normal number any more; the largest factor before it is h.h/(pi ax ay hz^4).
    deep = above & (x > 700)
    with np.errstate(invalid="ignore"):
        allowed = np.where(above, (28 + 10 * np.where(deep, 0, x)) * UNIT * abs(theirs), 0)
    h = rows[:, :3] + rows[:, 3:]
    with np.errstate(divide="ignore", over="ignore"):
        factor = specular * (h * h).sum(1) / (np.pi * alpha_x * alpha_y * h[:, 2] ** 4)
    allowed += np.where(deep, np.minimum(factor, 1e280) * np.exp(-700.0), 0)
    wrong = ~(abs(ours - theirs) <= allowed)
    relative = abs(ours - theirs)[above & ~deep] / np.maximum(theirs[above & ~deep], 1e-300)
    notes = [f"{len(rows)} pairs, {len(relative)} within the lobe's range, largest relative difference {relative.max():.1e}"]
    if wrong.any():
        i = np.argmax(wrong)
        notes.append(f"{wrong.sum()} differ, as {rows[i].tolist()}: rcalc {theirs[i]!r}, brdfeval {ours[i]!r}")
    return not wrong.any(), np.array_equal(ours, ascii), notes


def main():
    random = np.random.default_rng(int(os.environ.get("GRAZE_PEER_SEED", "1")))
    cases = [
        # alpha_x, alpha_y, rs, rd
        (0.02, 0.08, 0.05, 0.095),
        (0.1, 0.2, 1.0, 0.0),
        (0.5, 0.05, 0.8, 0.2),
        (1.3, 0.7, 0.3, 0.7),
        (0.001, 0.3, 0.9, 0.0),
        (0.08, 0.08, 0.05, 0.095, True),
        (0.2, 0.2, 1.0, 0.0, True),
        (0.01, 0.01, 0.6, 0.25, True),
    ]
    number = 0
    with tempfile.TemporaryDirectory() as folder:
        for arguments in cases:
            alpha_x, alpha_y, specular, diffuse = arguments[:4]
            name = f"WGMD{'iso' if arguments[4:] else 'aniso'}.cal, {alpha_x} x {alpha_y}, rs {specular}, rd {diffuse}"
            agrees, same, notes = case(folder, random, *arguments)
            for good, what in [(agrees, "as rcalc has it"), (same, "the same in ASCII")]:
                number += 1
                print(f"{'ok' if good else 'not ok'} {number} - {name}: {what}")
            for note in notes:
                print("#", note, flush=True)
    print(f"1..{number}")


if __name__ == "__main__":
    sys.exit(main())
