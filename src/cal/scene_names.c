/* The names that Radiance's rayinit.cal and renderer give to scenes, defined in our words. What is behind a mark,
 * as in NAME`own, is for this text alone. */
#include "cal/scene_names.h"

#include <stddef.h>

const char *const cal_scene_names[] = {
    /* Channels, numbered as in program.h. */
    "Dx = $1; Dy = $2; Dz = $3; Nx = $4; Ny = $5; Nz = $6; Px = $7; Py = $8; Pz = $9; T = $10; Rdot = $11;",
    "S = $12; Tx = $13; Ty = $14; Tz = $15; Ix = $16; Iy = $17; Iz = $18; Jx = $19; Jy = $20; Jz = $21;",
    "Kx = $22; Ky = $23; Kz = $24; Ts = $25; Lu = $26; Lv = $27; NxP = $28; NyP = $29; NzP = $30; RdotP = $31;",
    "CrP = $32; CgP = $33; CbP = $34; DxA = $35; DyA = $36; DzA = $37;",
    /* The primitive's reals. */
    "AC = arg(0); A1 = arg(1); A2 = arg(2); A3 = arg(3); A4 = arg(4); A5 = arg(5); A6 = arg(6); A7 = arg(7);",
    "A8 = arg(8); A9 = arg(9); A10 = arg(10); PI : 3.14159265358979323846; DEGREE : PI/180; FTINY : 1e-7;",
    /* Logic: what is above 0 is true. */
    "and(p, q) : if(p, q, p); or(p, q) : if(p, p, q); not(p) : if(p, -1, 1); xor(p, q) : if(p, not(q), q);",
    "inside(low, v, high) : and(v - low, high - v);",
    /* Numbers. */
    "abs(v) : max(v, -v); sgn(v) : if(v, 1, if(-v, -1, 0)); sq(v) : v*v;",
    "bound(low, v, high) : if(low - v, low, if(v - high, high, v)); frac(v) : v - floor(v);",
    "mod(v, unit) : v - floor(v/unit)*unit; tri(v, half) : abs(half - mod(v - half, 2*half));",
    "linterp(t, from, to) : (1 - t)*from + t*to;",
    /* Functions that take every number. */
    "Acos(v) : acos(bound(-1, v, 1)); Asin(v) : asin(bound(-1, v, 1));",
    "Atan2(y, x) : if(y*y + x*x, atan2(y, x), 0); Exp(v) : if(-v - 100, 0, exp(v));", "Sqrt(v) : if(v, sqrt(v), 0);",
    /* Colours. */
    "noop(v) : v; clip(v) : bound(0, v, 1); noneg(v) : max(v, 0); red(r, g, b) : max(r, 0);",
    "green(r, g, b) : max(g, 0); blue(r, g, b) : max(b, 0);",
    "grey(r, g, b) : noneg(.265074126*r + .670114631*g + .064811243*b); clip_r(r, g, b) : bound(0, r, 1);",
    "clip_g(r, g, b) : bound(0, g, 1); clip_b(r, g, b) : bound(0, b, 1);", "clipgrey(r, g, b) : min(grey(r, g, b), 1);",
    "fade(near, far, distance) : far + if(16 - distance, (near - far)/(1 + distance*distance), 0);",
    /* Vectors are functions of 1, 2, 3. */
    "D(axis) = select(axis, Dx, Dy, Dz); N(axis) = select(axis, Nx, Ny, Nz);",
    "P(axis) = select(axis, Px, Py, Pz); dot(a, b) : a(1)*b(1) + a(2)*b(2) + a(3)*b(3);",
    "cross(axis, a, b) : select(axis, a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1));",
    /* Curves. */
    ("hermite(a, b, slope_a, slope_b, t) : a*((2*t - 3)*t*t + 1) + b*(3 - 2*t)*t*t + slope_a*(((t - 2)*t + 1)*t) + "
     "slope_b*((t - 1)*t*t);"),
    "bezier(a, b, c, d, t) : a*(1 + t*(-3 + t*(3 - t))) + b*3*t*(1 + t*(-2 + t)) + c*3*t*t*(1 - t) + d*t*t*t;",
    ("bspline(a, b, c, d, t) : a*(1/6 + t*(-.5 + t*(.5 - 1/6*t))) + b*(2/3 + t*t*(-1 + .5*t)) + c*(1/6 + t*(.5 + t*(.5 "
     "- .5*t))) + d*(1/6*t*t*t);"),
    /* Noise. */
    "noise3a(x, y, z) : noise3x(x, y, z); noise3b(x, y, z) : noise3y(x, y, z);", "noise3c(x, y, z) : noise3z(x, y, z);",
    "noise3d(axis, x, y, z) : select(axis, noise3x(x, y, z), noise3y(x, y, z), noise3z(x, y, z));",
    /* Sums over octaves from the size s up to 1. */
    "turbulence(x, y, z, s) : if(s - 1.01, 0, abs(noise3(x/s, y/s, z/s)*s) + turbulence(x, y, z, 2*s));",
    "slope`own(f, x, y, z) : sgn(noise3(x, y, z))*f(x, y, z);",
    "turbulencex(x, y, z, s) : if(s - 1.01, 0, slope`own(noise3x, x/s, y/s, z/s) + turbulencex(x, y, z, 2*s));",
    "turbulencey(x, y, z, s) : if(s - 1.01, 0, slope`own(noise3y, x/s, y/s, z/s) + turbulencey(x, y, z, 2*s));",
    "turbulencez(x, y, z, s) : if(s - 1.01, 0, slope`own(noise3z, x/s, y/s, z/s) + turbulencez(x, y, z, 2*s));",
    /* Normal deviates from uniform ones: C. Hastings's approximation 26.2.23 in Abramowitz and Stegun, to 4.5e-4. */
    "quantile`own(t) : t - ((.010328*t + .802853)*t + 2.515517)/(((.001308*t + .189269)*t + 1.432788)*t + 1);",
    "tail`own(p) : quantile`own(sqrt(-2*log(p))); unif2norm(p) : if(.5 - p, -tail`own(p), tail`own(1 - p));",
    "nrand(v) = unif2norm(rand(v));",
    /* Coordinates in a plane of the normal N = U x V, U level. */
    "level`own = Nx*Nx + Ny*Ny; lies`own = FTINY - level`own;", "U = if(-lies`own, (Py*Nx - Px*Ny)/level`own, Px);",
    "V = if(-lies`own, Pz - Nz*(Px*Nx + Py*Ny)/level`own, Py);",
    /* Directions seen from the surface, whose upward vector is the last three reals. */
    "up`own(axis) = arg(AC + axis - 3); n`own(axis) = select(axis, NxP, NyP, NzP);",
    "s1`own = cross(1, up`own, n`own); s2`own = cross(2, up`own, n`own); s3`own = cross(3, up`own, n`own);",
    "per`own = 1/sqrt(s1`own*s1`own + s2`own*s2`own + s3`own*s3`own);",
    "v1`own = s1`own*per`own; v2`own = s2`own*per`own; v3`own = s3`own*per`own;",
    "v`own(axis) = select(axis, v1`own, v2`own, v3`own);",
    "u1`own = cross(1, n`own, v`own); u2`own = cross(2, n`own, v`own); u3`own = cross(3, n`own, v`own);",
    "Ldx(x, y, z) = x*u1`own + y*u2`own + z*u3`own; Ldy(x, y, z) = x*v1`own + y*v2`own + z*v3`own;",
    "Ldz(x, y, z) = x*NxP + y*NyP + z*NzP; Idx = Ldx(-Dx, -Dy, -Dz); Idy = Ldy(-Dx, -Dy, -Dz); Idz = RdotP;",
    /* Photometry of lights, in degrees: from the axis -z, and about it with the symmetry of 90, 180, or 360. */
    "source_theta(any) = Acos(Dz)/DEGREE; turn`own = atan2(-Dy, -Dx)/DEGREE;",
    "phi`own = if(-turn`own, turn`own + 360, turn`own); half`own = if(180 - phi`own, phi`own, phi`own - 180);",
    ("source_phi(symmetry) = select(symmetry/90, if(90 - half`own, half`own, 180 - half`own), if(180 - phi`own, "
     "phi`own, 360 - phi`own), log(-symmetry), phi`own);"),
    /* Candela to radiance by what is seen of: nothing, a plane, a box, a box nearby, a cylinder. */
    "reach`own(x, half) : noneg(abs(x) - half/2); height`own = if(1 - Dz, Dz, 1 - FTINY);",
    "box`own = abs(Dx)*A3*A4 + abs(Dy)*A2*A4 + abs(Dz)*A2*A3;",
    "near`own = reach`own(Px - Dx*Ts, A2)*A3*A4 + reach`own(Py - Dy*Ts, A3)*A2*A4 + reach`own(Pz - Dz*Ts, A4)*A2*A3;",
    "tube`own = A2*A3*sqrt(1 - height`own*height`own) + .25*PI*A2*A2*abs(height`own);",
    "corrected`own(v, shape) = if(v, select(shape + 1, v, v/Rdot, v/box`own, v*Ts/near`own, v/tube`own), 0);",
    "source_corr(v, shape) = corrected`own(if(AC - 1.5, v*A1, v), shape);", NULL};
