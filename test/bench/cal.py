"""How fast expressions of the function language are evaluated: beside Radiance's rcalc, and on two threads.

Run by `make bench`. Both read the same million records of doubles from a file and write doubles to /dev/null. Time is the
processor's, of the user, and what reading and writing alone costs each program is in it; of ratios, more is better. For
threads there are the clock's time for the evaluation alone, which needs a second processor that is free, and the
processors' time of both, which does not: it is that of one thread where they do not hinder each other. All take turns,
and figures are medians. RUNS (7) in the environment sets how many turns.
"""

import glob
import os
import resource
import statistics
import subprocess
import sys
import tempfile

import numpy as np

VALUES = os.environ["BUILD"] + "/test/bench/cal_values"
PYRADIANCE = glob.glob(os.environ["GRAZE_PEER"] + "/lib/python3*/site-packages/pyradiance")[0]
RUNS = int(os.environ.get("RUNS", "7"))
RECORDS = 1_000_000

# Name, function file, definitions, expression of $1 to $6.
CASES = [
    ("$1", "", "", "$1"),
    ("a sum of products", "", "", "$1*$2+$3*$4-$5*$6+.5*$1*$1"),
    ("variables", "", "r = sqrt($1*$1+$2*$2); t = atan2($2,$1); u = r*cos(2*t); v = r*sin(2*t);", "u*u-v*v+u*v+r"),
    ("conditions", "rayinit.cal", "", "tri($1*9,2)+mod($2*9,.7)*if($3-.5,clip($4*3-1),bound(.2,$5,.4))"),
    ("vectors", "rayinit.cal", "a(i) = select(i,$1,$2,$3); b(i) = select(i,$4,$5,$6);", "dot(a,b)+cross(1,a,b)*cross(2,a,b)"),
    ("wgmdaniso()", "WGMDaniso.cal", "", "wgmdaniso($1,$2,$3,$4,$5,$6)"),
    ("recursion", "", "f(n,x) = if(n-.5,x+f(n-1,x*.5),0);", "f(floor($1*8),$2)"),
]


def time_of(command, file, environment):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    with open(file, "rb") as source:
        done = subprocess.run(command, stdin=source, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=True, env=environment)
    user = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return user, float(done.stderr or "0")


def measure(case, file, environment):
    name, functions, definitions, expression = case
    theirs = [PYRADIANCE + "/bin/rcalc", "-id6", "-od", "-w", *(["-f", functions] if functions else []), "-e", f"{definitions} $1={expression}"]
    ours = [VALUES, "-v", "-c", "6", *(["-f", f"{PYRADIANCE}/lib/{functions}"] if functions else []), "-e", definitions]
    times = {"rcalc": [], 1: [], 2: []}
    clocks = {1: [], 2: []}
    for _ in range(RUNS):
        times["rcalc"].append(time_of(theirs, file, environment)[0])
        for threads in 1, 2:
            user, clock = time_of([*ours, "-t", str(threads), "--", expression], file, environment)
            times[threads].append(user)
            clocks[threads].append(clock)
    rcalc, one = (1e9 * statistics.median(times[who]) / RECORDS for who in ("rcalc", 1))
    alone = 1e9 * statistics.median(clocks[1]) / RECORDS
    gain = statistics.median(a / b for a, b in zip(clocks[1], clocks[2]))
    ratio = statistics.median(a / b for a, b in zip(times["rcalc"], times[1]))
    hindered = statistics.median(b / a for a, b in zip(times[1], times[2]))
    verdict = "met" if ratio >= 1 else "MISSED"
    print(f"  {name:20s} {rcalc:8.1f} {one:8.1f} {alone:8.1f}   {ratio:6.2f} x; goal 1: {verdict}   {gain:5.2f} x   {hindered:5.2f}", flush=True)


def main():
    environment = dict(os.environ, RAYPATH=PYRADIANCE + "/lib")
    print("function language: ns of processor time a record, reading included, of rcalc and of us; ns of our evaluation alone;\n"
          "  times as fast as rcalc; times as fast on two threads, and their processor time beside that of one")
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "records")
        np.random.default_rng(1).random((RECORDS, 6)).tofile(file)
        for case in CASES:
            measure(case, file, environment)


if __name__ == "__main__":
    sys.exit(main())
