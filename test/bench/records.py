"""How fast brdfeval takes records: beside cat in a pipe, from a file, in ASCII beside Radiance's rcalc, and on more threads.

Run by `make bench`. All contenders take turns; a rate is the median of a contender's turns, and goals are ratios of such
medians, in which the machine's speed cancels out. Everything is written to /dev/null. RUNS (15) in the environment sets
how many turns.
"""

import glob
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

BRDFEVAL = os.environ["BIN"] + "/brdfeval"
PYRADIANCE = glob.glob(os.environ["GRAZE_PEER"] + "/lib/python3*/site-packages/pyradiance")[0]
RUNS = int(os.environ.get("RUNS", "15"))

# The parameters that WGMDaniso.cal comes with.
OPTIONS = "-ax .02 -ay .08 -rs .05 -rd .095".split()
RCALC = [PYRADIANCE + "/bin/rcalc", "-f", "WGMDaniso.cal", "-e", "$1=wgmdaniso($1,$2,$3,$4,$5,$6)"]

BINARY, ASCII, ASCII_RCALC = 8_000_000, 1_000_000, 100_000


def directions(random, count):
    z, azimuth = random.random(count), 2 * np.pi * random.random(count)
    sine = np.sqrt(1 - z * z)
    return np.stack([sine * np.cos(azimuth), sine * np.sin(azimuth), z], -1)


def write_records(folder):
    random = np.random.default_rng(1)
    block = np.hstack([directions(random, 1_000_000), directions(random, 1_000_000)])
    binary, ascii, few = (os.path.join(folder, name) for name in ("records.f", "records.txt", "few.txt"))
    with open(binary, "wb") as file:
        for _ in range(BINARY // len(block)):
            block.astype("f4").tofile(file)
    np.savetxt(ascii, block[:ASCII], "%.9g")
    with open(ascii) as source, open(few, "w") as file:
        file.writelines(line for line, _ in zip(source, range(ASCII_RCALC)))
    return binary, ascii, few


def check_agreement(few):
    """Both must say the same, to the last digit that rcalc prints."""
    with open(few) as source:
        theirs = subprocess.run(RCALC, stdin=source, stdout=subprocess.PIPE, check=True, text=True).stdout.split()
    with open(few) as source:
        ours = subprocess.run([BRDFEVAL, *OPTIONS], stdin=source, stdout=subprocess.PIPE, check=True, text=True).stdout.split()
    theirs, ours = np.array(theirs, float), np.array(ours, float)
    # Half a unit of the ninth digit, and what rounding the formula's operations may move a value across a half.
    half = 0.5 * 10.0 ** (np.floor(np.log10(ours)) - 8)
    wrong = abs(ours - theirs) > half + 1e-13 * ours
    if len(theirs) != ASCII_RCALC or len(ours) != len(theirs) or wrong.any():
        sys.exit(f"brdfeval and rcalc do not agree: {len(ours)} and {len(theirs)} answers, {wrong.sum()} differ")


class Contender:
    """A command that reads a file, or gets it from cat through a pipe."""

    def __init__(self, name, command, file, records, pipe=False, beside=None, goal=None):
        self.name, self.command, self.file, self.records, self.pipe = name, command, file, records, pipe
        self.beside, self.goal, self.rates, self.costs = beside, goal, [], []

    def run(self):
        start, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
        if self.pipe:
            cat = subprocess.Popen(["cat", self.file], stdout=subprocess.PIPE)
            subprocess.run(self.command, stdin=cat.stdout, stdout=subprocess.DEVNULL, check=True)
            cat.stdout.close()
            if cat.wait() != 0:
                sys.exit("cat failed")
        else:
            with open(self.file, "rb") as file:
                subprocess.run(self.command, stdin=file, stdout=subprocess.DEVNULL, check=True)
        self.rates.append(self.records / (time.perf_counter() - start))
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.costs.append((after.ru_utime - before.ru_utime, after.ru_stime - before.ru_stime))

    def report(self):
        low, median, high = statistics.quantiles(self.rates, n=4)
        user, system = (1e9 * statistics.median(cost) / self.records for cost in zip(*self.costs))
        text = f"  {self.name:30s} {median / 1e6:8.2f} ({low / 1e6:7.2f} {high / 1e6:7.2f})  {user:7.1f} {system:6.1f}"
        if self.beside:
            ratio = statistics.median(self.rates) / statistics.median(self.beside.rates)
            text += f"   {ratio:6.2f} x {self.beside.name}"
            if self.goal:
                text += f"; goal {self.goal:g}: {'met' if ratio >= self.goal else 'MISSED'}"
        print(text)


def contenders(binary, ascii, few):
    floats, text = [BRDFEVAL, *OPTIONS, "-ff"], [BRDFEVAL, *OPTIONS]
    cat = Contender("cat | cat", ["cat"], binary, BINARY, pipe=True)
    yield cat
    yield Contender("cat | brdfeval -ff -n 1", [*floats, "-n", "1"], binary, BINARY, pipe=True, beside=cat, goal=0.9)
    one = Contender("brdfeval -ff -n 1 < file", [*floats, "-n", "1"], binary, BINARY, beside=cat, goal=4)
    yield one
    yield Contender("brdfeval -ff -n 2 < file", [*floats, "-n", "2"], binary, BINARY, beside=one, goal=1)
    rcalc = Contender("rcalc < file, ASCII", RCALC, few, ASCII_RCALC)
    yield rcalc
    for threads in "1", "2":
        yield Contender(f"brdfeval -n {threads} < file, ASCII", [*text, "-n", threads], ascii, ASCII, beside=rcalc, goal=20)


def main():
    os.environ["RAYPATH"] = PYRADIANCE + "/lib"
    with tempfile.TemporaryDirectory() as folder:
        binary, ascii, few = write_records(folder)
        check_agreement(few)
        turns = list(contenders(binary, ascii, few))
        for _ in range(RUNS):
            for contender in turns:
                contender.run()
        print(f"records: millions a second, medians of {RUNS} turns (quartiles), and nanoseconds of processor time for one,\n"
              "  the programs' and the system's, those of cat included; of ratios, more is better")
        for contender in turns:
            contender.report()


if __name__ == "__main__":
    sys.exit(main())
