"""The function language against Radiance's rcalc, and its noise against rtrace: TAP.

Expressions and definitions, chosen for what is odd in the language, and random ones, over the same records of doubles,
in and out in binary. Both must give the same bits, but for two units in the last place where a power has a part in it (a
square is x*x here, not pow()); what rcalc refuses must be refused here.

The rcalc at hand was built without regard for infinities and NaN: the value that a function has outside of its domain, 0
by Radiance's sources and here, is there -inf or NaN, and goes on as that. So no expression takes a function there, nor
divides infinities; test/cal has those. Division by 0 is as the sources say.

GRAZE_PEER_SEED sets the seed (1)."""

import os
import random
import subprocess
import sys
import tempfile

import numpy as np

PEER = os.environ["GRAZE_PEER_BIN"]
VALUES = os.path.abspath(os.path.join(os.environ["BUILD"], "test/bench/cal_values"))
ENVIRONMENT = dict(os.environ, RAYPATH=os.environ["GRAZE_PEER_RAYPATH"])
UNIT = 2.0**-52

# Numbers that functions have an edge at, and others.
RECORDS = np.array(
    [[0, 0, 0], [1, 2, 3], [-1, 0.5, 2], [0.5, -0.5, 1], [2.5, 1e-3, -7], [-0.1, 0, 4], [1e10, -1e-10, 0.25], [-3, -2, 5.5]]
)

# An expression in $1, $2, $3, alone or behind definitions.
EXPRESSIONS = """
$1+$2*$3 | $1-$2-$3 | $1/($2+10)/($3+20) | $1*$2/($3+9)*4 | -$1^2 | -$2^$3 | 2^-1+$1 | 2^3^2+$1 | (2^3)^2-$1 | +$1-+$2 | $1- -$2 | 1-(-$1)
$1^2 | $1^3 | $1^4 | $1^.5 | $1^-1 | $1^0 | 0^$1 | 1^$1 | $1^1 | ($1^2)^.5 | 3^(2+$2)^2 | 2^($1/100)
$1*0 | 0*$1 | 0/$1 | $1/4 | $1/3 | $1/3*3 | $1*3/3 | 2*$1*3 | 1+$1+2+$2+3 | 1-$1+2-3-$2 | $1-(2-$2)-(3+$3) | ($1+1)+(2+$2)+(3+4) | .1+$1+.2 | $1+.1+.2+.3
(1+2)*(3+4)*$1 | 1e3*$1 | 1.5e-3*$1 | .5E+2+$1 | 5.+$1 | 5.e1+$1 | 007+$1 | 1e0*$1
{c}$1{ {nested} }+{x}2{} | $1{a}+{b}$2 | $ 1 + $ 2 | ( $1 ) | ((($1)))
sin($1) | cos($2) | tan($3) | asin($1/10) | acos($1/10) | asin($1) | acos($1) | atan($1) | atan2($1,$2) | atan2($2,$1) | exp($1) | log($1) | log10($1) | log($1*$1+1)
sqrt($1) | sqrt($1*$1+$2*$2) | floor($1) | ceil($1) | floor(-$1) | ceil(-$2) | floor($1/3) | exp(1e3*$1) | exp(-1e3*$3) | rand($1) | rand($2*100) | rand(-$3)
if($1,$2,$3) | if(-$1,$2,$3) | if($1-1,$2,$3) | if(1-$1,$2,$3) | if($1-$2,1,2) | if($1+$2,$1,$2) | if($1,1/$2,1) | if(0,$1,$2) | if(1,$1,$2) | if($1,$1,if($2,$2,$3))
min($1,$2,$3) | max($1,$2,$3) | min($1) | max($1,0) | max(min($1,1),0) | min($1,2,$2,-1) | max(1,2,3)*$1
select($3,1,2,3,4,5,6) | select(2,$1,$2,$3) | select(0,$1,$2) | select($2+1.4,$1,$2,$3) | select(1,$1) | select(-.4,$1,$2)
1/$1 | 1/$2 | $3/$1 | 1/($1-1) | (1/$1)+1 | 5+1/$1*2 | sqrt(4+1/$1) | if(1,5+1/$1,0) | 1/$1+sin($2) | sin($2)+1/$1 | sqrt(1/$1+sin($2)) | sqrt(sin($2)+1/$1)
atan2(1/$1,sin($2)) | atan2(sin($2),1/$1) | (1/$1)^sin($2) | sin($2)^(1/$1) | min(1/$1,sin($2)) | max(sin($2),1/$1,2) | max(1/$1,sin($2),cos($2)) | select(2,1/$1,3+1/$2) | 1/(1/$1)
log($1*$1+1)+1 | ($1-1)/($1-1) | sin(1/$1)/sin($2) | sin($2)/(1/$1)
1e300*$1*1e10 | ($1*1e200)^2 | floor(1e300*$1) | 1e308*$3+1e308*$3-1e308*$3-1e308*$3
PI*$1 | sin(PI*$1) | cos(PI/3)*$1 | sqrt(2)*$1 | max(3,4)^2+$1 | if(PI-3,$1,$2) | atan2(1,1)*$1 | rand(.5)+$1
""".replace("\n", "|").split("|")

# Definitions, and an expression.
PROGRAMS = [
    ("f(x) = x*x;", "f($1)+f($2)"),
    ("f(x) : x*x;", "f($1)+f(3)"),
    ("f(x,y) = x-y;", "f($1,$2)*f($2,$1)"),
    ("f(x,y) = x;", "f($1)"),
    ("f(x) = x;", "f($1,$2,$3)"),
    ("f(a,b) = if(a,a,b);", "f(1)+$1"),
    ("fact(n) : if(n-1,n*fact(n-1),1);", "fact(10)*$1"),
    ("fact(n) = if(n-1,n*fact(n-1),1);", "fact(floor($3))"),
    ("abs(x) : if(x,x,-x); fib(n) = if(n-1.5,fib(n-1)+fib(n-2),n);", "fib(abs($3)+3)"),
    ("abs(x) : if(x,x,-x); ack(m,n) = if(m-.5,if(n-.5,ack(m-1,ack(m,n-1)),ack(m-1,1)),n+1);", "ack(2,floor(abs($2))+2)"),
    ("even(n) = if(n-.5,odd(n-1),1); odd(n) = if(n-.5,even(n-1),-1);", "even(floor(max($3,0)))"),
    ("g(f,x) = f(x)+f(2*x); h(x) = x*x;", "g(h,$1)+g(sin,$2)"),
    ("twice(f,x) = f(f(x)); sq(x) = x*x;", "twice(sq,$1)+twice(cos,$2)"),
    ("sum(f,n) = if(n-.5,f(n)+sum(f,n-1),0); sq(x) = x*x;", "sum(sq,floor(max($3,0)))+sum(sin,3)"),
    ("fold(f,n,x) = if(n-.5,fold(f,n-1,f(x)),x); h(x) = x*.5+1;", "fold(h,max($3,1),$1)"),
    ("pass(f,x) = call(f,x); call(f,x) = f(x);", "pass(sin,$1)"),
    ("v(i) = select(i,$1,$2,$3); dot(a,b) = a(1)*b(1)+a(2)*b(2)+a(3)*b(3);", "dot(v,v)"),
    ("lazy(n,x) = if(n-.5,lazy(n-1,x/0.5),n);", "lazy(max($3,1),1/$1)"),
    ("late(n,x) = if(n-.5,late(n-1,x),x+1);", "late(max($3,1),1/$1)"),
    ("late(n,x) = if(n-.5,late(n-1,x),x+x);", "sqrt(late(max($3,1),sin($1)))"),
    ("x = $1+1; y = x*x;", "x+y+x"),
    ("x = 1/$1;", "x+sqrt(x*x+4)"),
    ("x = 1/$1;", "sqrt(x*x+4)+x"),
    ("x = sin($1);", "if($1,x,2)+x"),
    ("x = sin($1);", "if($1,x+1,x+2)*if($2,x,1)"),
    ("x = sin($1); f(n) = if(n-.5,f(n-1)+x,0);", "f(max($3,0))+x"),
    ("x = sin($1); f(n) = if(n-.5,f(n-1)+x,0);", "x+f(max($3,0))"),
    ("x = $1*y; y = $2+z; z = sqrt($3+8); f(n) = if(n-.5,f(n-1)*.5+x+y+z,0);", "f(max($3,0))+if($1,y,z)"),
    ("A : 2; B : A*3; A : 5;", "A+B+$1"),
    ("A : 2; b = A+1; A : 5;", "b+A*$1"),
    ("A = 2; b = A+1; A = 5;", "b+A*$1"),
    ("x = 5; y : x;", "y+$1"),
    ("f(x) : x+A; A : 3;", "f($1)"),
    ("A : 3; f(x) : x+A; A : 4;", "f($1)"),
    ("sin(x) = x;", "sin($1)"),
    ("s = sin(1); sin(x) : x*2;", "s+sin($1)"),
    ("sin = 3;", "sin+sin($1)"),
    ("x(a) = a; x = 2;", "x+$1"),
    ("x = 2; x(a) = a+1;", "x($1)"),
    ("x` = 3;", "x+$1"),
    ("`x = 3;", "`x+x`+$1"),
    ("x`a = 3; x = 4;", "x`a*10+x+$1"),
    ("x`a`b = 3;", "x`a`b+$1"),
    ("a.b_c1 = 3;", "a.b_c1*$1"),
    ("f(sin) = sin+1;", "f($1)"),
    ("f(f) = f*2;", "f($1)"),
    ("f(x,x) = x;", "f($1,$2)"),
    (";;a=1;;b=2;", "a+b+$1"),
    ("a=1;b=2", "a+b+$1"),
    ("{ c } a { d } = { e } 1 { f } ; { g }", "a+$1"),
    ("cse(x) = sqrt(x)+sqrt(x);", "cse($1)"),
    ("noneg(x) = if(x,x,0); n(x) = noneg(x-1)+noneg(x+1);", "n($1)*n($2)"),
    ("f(a,b,c,d,e,g,h,i,j,k,l,m) = a+b*c+d*e+g*h+i*j+k*l*m;", "f($1,2,3,$2,5,6,7,8,9,$3,11,12)"),
    ("m(n,d) : n-floor(n/d)*d; tri(n,d) : if(d-m(n-d,2*d),d-m(n-d,2*d),m(n-d,2*d)-d);", "tri($1,3)+m($2,.3)"),
    ("w(x) = if(x-1,x,if(x+1,x*x,if(x+5,1/x,select(2,x,x/3))));", "w($1)+w($2)*w($3)"),
]

# What rcalc ends with an error at, here or when it is evaluated.
REFUSED = [
    ("", e)
    for e in "--$1|$1+|(1+$1|1)|$1^|*2|foo|foo(1)|sin()|atan2($1)|if($1)|$1 $1|2x|1e|1e+|.|$1..2|sin(1,|{open|$1;$2|1/0|0/0|"
    "$1/0|sin(1/0)|select(3,1,2)|if($1,foo,foo)|a=1|$1&2|$1>2|!$1|atan2(1)|f(1)(2)|[1]|1,2".split("|")
] + [
    ("f(x) = y;", "f($1)"),
    ("f(x,y) = y;", "f($1)"),
    ("f = 3;", "f($1)"),
    ("f(x) = x;", "f"),
    ("f(g) = g(1);", "f(2)"),
    ("f(g) = g(1);", "f(1+$1)"),
    ("f(g) = g(1); a = 1;", "f(a)"),
    ("f(x) : 1/x;", "f(0)+$1"),
    ("f(x) : g(x); a = f(2); g(x) : x;", "a"),
    ("f(1) = 2;", "$1"),
    ("f(x`a) = 2;", "$1"),
    ("f() = 2;", "$1"),
    ("1 = 2;", "$1"),
    ("a 1;", "$1"),
    ("a = 1 b = 2;", "$1"),
    ("A : 1/0;", "$1"),
    ("{ a = 1;", "$1"),
    ("a = ;", "$1"),
    ("_a = 1;", "$1"),
]


class Both:
    def __init__(self, folder):
        self.folder, self.message = folder, ""

    def run(self, definitions, expressions, records):
        """Values by rcalc and by us, or None where there are none; one column an expression."""
        path = os.path.join(self.folder, "definitions.cal")
        with open(path, "w") as file:
            file.write(definitions)
        channels = records.shape[1]
        theirs = [os.path.join(PEER, "rcalc"), f"-id{channels}", "-od", "-w", "-f", path]
        for i, e in enumerate(expressions):
            theirs += ["-e", f"${i + 1}={e}"]
        ours = [VALUES, "-c", str(channels), "-e", definitions, "--", *expressions]
        return [self.values(command, records, len(expressions)) for command in (theirs, ours)]

    def values(self, command, records, columns):
        done = subprocess.run(command, input=records.astype("f8").tobytes(), capture_output=True, env=ENVIRONMENT)
        if done.returncode < 0:
            raise RuntimeError(f"{command}: signal {-done.returncode}: {done.stderr.decode()[:300]}")
        self.message = self.message * (command[0] == VALUES) + done.stderr.decode()
        return np.frombuffer(done.stdout, "f8").reshape(-1, columns) if done.returncode == 0 else None


def differs(theirs, ours, units):
    """Where they are apart by more than so many units; infinite is no number, and 0 here."""
    theirs = np.where(np.isfinite(theirs), theirs, 0)
    return ~((theirs == ours) | (abs(ours - theirs) <= units * UNIT * abs(theirs)))


class Tap:
    def __init__(self):
        self.count = 0

    def result(self, good, name, *notes):
        self.count += 1
        print(f"{'ok' if good else 'not ok'} {self.count} - {name}")
        if not good:
            for note in notes:
                print("#", note)
        sys.stdout.flush()


def compare(tap, both, definitions, expression, units=0):
    theirs, ours = both.run(definitions, [expression], RECORDS)
    name = f"{definitions} {expression}".replace("#", "")
    if theirs is None or ours is None or theirs.shape != ours.shape:
        tap.result(False, name, f"rcalc {theirs}", f"ours {ours}", both.message)
        return
    wrong = differs(theirs, ours, units)[:, 0]
    tap.result(not wrong.any(), name, *(f"{r}: rcalc {t[0]!r}, ours {o[0]!r}" for r, t, o in zip(RECORDS[wrong], theirs[wrong], ours[wrong])))


class Random:
    """Random programs, whose functions come to an end, and are taken within their domains."""

    def __init__(self, seed):
        self.r = random.Random(seed)

    def number(self):
        return self.r.choice(["0", "1", "2", ".5", "3", "1e-3", "10", f"{self.r.uniform(0, 5):.3f}", "-1", "-.25"])

    def expression(self, depth, names, functions):
        r = self.r
        sub = lambda: self.expression(depth - 1, names, functions)
        if depth <= 0 or r.random() < 0.1:
            return f"({self.number()})" if r.random() < 0.3 else r.choice(names)
        kind = r.random()
        if kind < 0.45:
            return f"({sub()}{r.choice('+-*/+-*')}{sub()})" if r.random() < 0.5 else f"({sub()}){r.choice('+-*+-*/')}({sub()})".join("()")
        if kind < 0.5:
            return f"(-({sub()}))"
        if kind < 0.55:
            return f"(max({sub()},.1)^{r.choice(['2', '3', '.5', '-1', f'max(min({sub()},3),-3)'])})"
        if kind < 0.7:
            call = r.choice(["sin(_)", "cos(_)", "sqrt(max(_,0))", "floor(_)", "ceil(_)", "exp(min(_,5))", "log(max(_,.01))", "atan(_)", "rand(max(min(_,1e3),-1e3))"])
            return call.replace("_", sub())
        if kind < 0.8:
            return f"if({sub()},{sub()},{sub()})"
        if kind < 0.85:
            return f"{r.choice(['min', 'max'])}({','.join(sub() for _ in range(r.randint(1, 4)))})"
        if kind < 0.9:
            return f"select({r.choice(['1', '2', '3', f'min(max({sub()},-3),9)'])},{sub()},{sub()},{sub()})"
        if functions and kind < 0.98:
            name, count = r.choice(functions)
            return f"{name}({','.join(sub() for _ in range(count))})"
        # The sign of a 0 decides between angles, and is not always there in the rcalc at hand: ceil(-.5) is +0.
        x, y = (f"if({e},.1+({e}),({e})-.1)" for e in (sub(), sub()))
        return f"atan2({y},{x})"

    def program(self):
        r = self.r
        text, names, functions = [], ["$1", "$2", "$3"], []
        for i in range(r.randint(0, 5)):
            kind = r.random()
            if kind < 0.4:
                text.append(f"v{i} = {self.expression(3, names, functions)};")
                names.append(f"v{i}")
            elif kind < 0.8:
                count = r.randint(1, 3)
                parameters = [f"p{k}" for k in range(count)]
                text.append(f"f{i}({','.join(parameters)}) = {self.expression(3, names + 3 * parameters, functions)};")
                functions.append((f"f{i}", count))
            else:
                inner = self.expression(2, names + ["n", "x"] * 2, functions)
                step = self.expression(1, ["x", "n", "$1"], [])
                text.append(f"f{i}(n,x) = if(n-.5,({inner})+f{i}(n-1,{step}),x);")
                text.append(f"r{i}(x) = f{i}(min(max(floor(x),0),4),x);")
                functions.append((f"r{i}", 1))
        return " ".join(text), self.expression(4, names, functions)


def random_programs(tap, both, seed, count):
    """In libm's functions both have the same library; powers differ in last places, which what follows may enlarge: where
    the answer changes much when records change in their last places, it says nothing."""
    source = Random(seed)
    generator = np.random.default_rng(seed)
    bad, compared, notes = 0, 0, []
    for _ in range(count):
        definitions, expression = source.program()
        records = np.vstack([RECORDS, generator.normal(size=(8, 3)) * 3])
        theirs, ours = both.run(definitions, [expression], records)
        if theirs is None or ours is None:
            if (theirs is None) != (ours is None):
                bad += 1
                notes += [f"{definitions} {expression}: rcalc {theirs is not None}, ours {ours is not None}: {both.message.strip()[:200]}"]
            continue
        compared += 1
        wrong = differs(theirs, ours, 8)[:, 0]
        if wrong.any():
            for nudge in (-64, -4, 4, 64):
                nudged, _ = both.run(definitions, [expression], records * (1 + nudge * UNIT))
                with np.errstate(invalid="ignore"):
                    wrong &= nudged is None or abs(nudged - theirs)[:, 0] < abs(ours - theirs)[:, 0] / 64
        if wrong.any():
            i = np.argmax(wrong)
            bad += 1
            notes.append(f"{definitions} {expression} at {records[i].tolist()}: rcalc {theirs[i, 0]!r}, ours {ours[i, 0]!r}")
    tap.result(bad == 0, f"{count} random programs, {compared} with an answer", f"{bad} differ", *notes[:8])


# rayinit.cal's names, for the channels and reals of scenes.
SCENE = """
bound(-1,$1,1) | bound($1,$2,$3) | Acos($1) | Asin($1*.5) | Atan2($1,$2) | Exp($1) | Exp(-$1*60) | Sqrt($1) | PI*$1 | DEGREE*$1 | FTINY*$1
and($1,$2) | or($1,$2) | not($1) | xor($1,$2) | xor($2,$3) | abs($1) | sgn($1) | sgn($2) | sq($1) | inside($1,$2,$3) | frac($1) | mod($1,$2) | mod($1,.7) | tri($1,3) | tri($2*9,2)
linterp($1,$2,$3) | noop($1) | clip($1) | noneg($1) | red($1,$2,$3) | green($1,$2,$3) | blue($1,$2,$3) | grey($1,$2,$3) | clip_r($1,$2,$3) | clip_g($1,$2,$3) | clip_b($1,$2,$3)
clipgrey($1,$2,$3) | dot(D,N) | dot(P,P) | cross(1,D,N) | cross(2,D,P) | cross(3,N,P) | fade($1,$2,$3*3+10) | hermite($1,$2,$3,$4,$5) | bezier($1,$2,$3,$4,$5) | bspline($1,$2,$3,$4,$5)
unif2norm($1*.1+.5) | unif2norm(rand($1)) | nrand($2) | U | V | U*V+Nx | Ldx($1,$2,$3) | Ldy($1,$2,$3) | Ldz($1,$2,$3) | Idx | Idy | Idz | AC | A1+A2*A3 | A4 | D(2) | N(1)+P(3)
Dx | T+Rdot*S | Tx+Ty+Tz | Ix+Iy*Iz | Jx+Jy*Jz | Kx+Ky*Kz | Ts | Lu-Lv | NxP+NyP | RdotP | CrP+CgP*CbP | DxA*DyA-DzA
""".replace("\n", "|").split("|")

# How rcalc, which knows nothing of scenes, is told of them.
CHANNELS = (
    "Dx Dy Dz Nx Ny Nz Px Py Pz T Rdot S Tx Ty Tz Ix Iy Iz Jx Jy Jz Kx Ky Kz Ts Lu Lv NxP NyP NzP RdotP CrP CgP CbP DxA DyA DzA".split()
)
REALS = [0.3, -1.2, 0.9, 0.5]


def scene_names(tap):
    """All of rayinit.cal that does not need noise, with the same channels."""
    records = np.random.default_rng(1).normal(size=(64, len(CHANNELS)))
    told = "".join(f"{name}=${i + 1};" for i, name in enumerate(CHANNELS))
    told += f"arg(n)=select(n+1,{len(REALS)},{','.join(map(str, REALS))});"
    reals = [word for real in REALS for word in ("-a", repr(real))]
    for expression in filter(None, (e.strip() for e in SCENE)):
        theirs = [os.path.join(PEER, "rcalc"), f"-id{len(CHANNELS)}", "-od", "-w", "-e", told, "-f", "rayinit.cal", "-e", f"$1={expression}"]
        ours = [VALUES, "-s", "-c", str(len(CHANNELS)), *reals, "--", expression]
        theirs, ours = (subprocess.run(c, input=records.tobytes(), capture_output=True, env=ENVIRONMENT) for c in (theirs, ours))
        a, b = (np.frombuffer(done.stdout, "f8") for done in (theirs, ours))
        good = len(a) == len(b) == len(records)
        # Sums in another order, of terms some times as large as the sum.
        near = good and (abs(a - b) <= 64 * UNIT * np.maximum(abs(a), 0.1)).all()
        tap.result(near, f"rayinit.cal: {expression}", theirs.stderr.decode()[:200], ours.stderr.decode()[:200], f"{a[:4]} {b[:4]}")


# What only the renderer knows: noise, reals, function files and their contexts. An expression, and the file's text.
RENDERED = [
    ("noise3(Px,Py,Px-Py)", ""),
    ("noise3(Px*9-3,Py*9,Px+7)", ""),
    ("noise3x(Px,Py,.3)", ""),
    ("noise3y(Px*3,Py,.3+Px)", ""),
    ("noise3z(Px*3,Py*2,Px*Py)", ""),
    ("noise3a(Px,Py,1.5)+noise3b(Px,Py,1.5)+noise3c(Px,Py,1.5)", ""),
    ("noise3d(2,Px,Py,.5)", ""),
    ("fnoise3(Px,Py,Px-Py)", ""),
    ("fnoise3(Px*5-20,Py*7,-Px)", ""),
    ("turbulence(Px,Py,.7,A1)", ""),
    ("turbulence(Px,Py,.7,.01)*.1", ""),
    ("turbulencex(Px,Py,.7,A1)*.1+turbulencey(Px,Py,.7,A1)*.1", ""),
    ("turbulencez(Px,Py,.7,.2)*.1", ""),
    ("turbulence(Px,Py,.7,abs(Py)+.1)", ""),
    ("arg(2)*Px+AC", ""),
    ("erf(Px)+erfc(Py)", ""),
    ("answer", "answer = sq(3)*Px; sq(x) = x+1;"),
    ("answer", "sq(x) = x+1; answer = sq(3)*Px;"),
    ("answer", "answer = sq`(3)*Px; sq(x) = x+1;"),
    ("answer", "sq(x) = x+1; answer = sq`(3)*Px;"),
    ("answer", "sq(x) = x+1; answer = `sq(3)*Px + sq`file(Py);"),
    ("answer", "Px = 2; answer = Px*Px`;"),
    ("answer", "answer = PI*Px; PI : 3;"),
    ("answer", "PI : 3; answer = PI*Px;"),
    ("answer", "turbulence(x,y,z,s) = if(s-1,x,1+turbulence(x*2,y,z,s*2)); answer = turbulence(Px,Py,1,.3);"),
    ("answer", "if(a,b,c) = a+b*c; answer = if(Px,Py,2);"),
    ("answer", "answer = if(Px,Py,2); if(a,b,c) = a+b*c;"),
    ("answer", "x`inner = 3; x = Px; answer = x*x`inner;"),
    ("source_corr(2,0)+source_corr(3,1)", ""),
    ("source_corr(2,4)+source_corr(3,2)", ""),
    ("source_corr(2,3)", ""),
    ("source_phi(360)*.01+source_theta(0)*.01", ""),
    ("source_phi(180)*.01-source_phi(90)*.1", ""),
    ("U-V*Rdot+T*Ts", ""),
]


def write(path, text):
    with open(path, "w") as file:
        file.write(text)


def rendered(tap, folder):
    """A plane that glows as the expression says. rtrace has colours as floats."""
    generator = np.random.default_rng(1)
    points, directions = generator.uniform(-4, 4, size=(200, 2)), np.tile([0, 0, -1.0], (200, 1))
    directions[::2, :2] = generator.normal(size=(100, 2))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    # From 1 above the plane, to hit it in these points.
    distances = -1 / directions[:, 2:]
    rays = np.hstack([np.hstack([points, np.zeros((200, 1))]) - distances * directions, directions])
    channels = np.zeros((200, len(CHANNELS)))
    channels[:, :3], channels[:, 5], channels[:, 6:8] = directions, 1, points
    channels[:, [9, 24]], channels[:, 10], channels[:, [11, 15, 19, 23]] = distances, -directions[:, 2], 1
    for expression, text in RENDERED:
        write(os.path.join(folder, "file.cal"), text)
        scene = f"void brightfunc p 2 ({expression})*.25+2 {'file.cal' if text else '.'} 0 4 .25 2 3 4\np glow g 0 0 4 1 1 1 0\n"
        write(os.path.join(folder, "s.rad"), scene + "g polygon f 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n")
        environment = dict(ENVIRONMENT, RAYPATH=f"{folder}:{ENVIRONMENT['RAYPATH']}")
        oconv = subprocess.run([os.path.join(PEER, "oconv"), "s.rad"], cwd=folder, capture_output=True, env=environment)
        with open(os.path.join(folder, "s.oct"), "wb") as file:
            file.write(oconv.stdout)
        trace = [os.path.join(PEER, "rtrace"), "-h", "-w", "-ov", "-fdd", "-ab", "0", "s.oct"]
        theirs = subprocess.run(trace, cwd=folder, input=rays.tobytes(), capture_output=True, env=environment)
        command = [VALUES, "-s", "-c", str(len(CHANNELS)), "-a", ".25", "-a", "2", "-a", "3", "-a", "4"]
        command += [*(["-f", "file.cal"] if text else []), "--", f"({expression})*.25+2"]
        ours = subprocess.run(command, cwd=folder, input=channels.tobytes(), capture_output=True)
        a, b = np.frombuffer(theirs.stdout, "f8")[::3], np.frombuffer(ours.stdout, "f8")
        good = len(a) == len(b) == 200
        wrong = abs(a - b) > 3e-7 * abs(a) if good else np.ones(1)
        notes = [theirs.stderr.decode()[:200], ours.stderr.decode()[:200]]
        if good and wrong.any():
            i = np.argmax(wrong)
            notes.append(f"{wrong.sum()} differ, at {points[i].tolist()}: rtrace {a[i]!r}, ours {b[i]!r}")
        tap.result(not wrong.any(), f"rendered: {expression} {text}".replace("#", ""), *notes)


def main():
    tap = Tap()
    with tempfile.TemporaryDirectory() as folder:
        both = Both(folder)
        for expression in filter(None, (e.strip() for e in EXPRESSIONS)):
            compare(tap, both, "", expression, 2 if "^" in expression else 0)
        for definitions, expression in PROGRAMS:
            compare(tap, both, definitions, expression)
        for definitions, expression in REFUSED:
            theirs, ours = both.run(definitions, [expression], RECORDS)
            tap.result(theirs is None and ours is None and both.message, f"refused: {definitions} {expression}".replace("#", ""),
                       f"rcalc {theirs}", f"ours {ours}")
        seed = int(os.environ.get("GRAZE_PEER_SEED", "1"))
        for part in range(4):
            random_programs(tap, both, 4 * seed + part, 150)
        scene_names(tap)
        rendered(tap, folder)
    print(f"1..{tap.count}")


if __name__ == "__main__":
    sys.exit(main())
