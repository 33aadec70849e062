/* Skies, lamps, windows and rounded surfaces: CIE's skies as gensky asks for them, Perez's as gendaylit does, the
 * photometry of ies2rad, the distributions of mkillum, coated panes as glaze does, and the interpolated normals of
 * genrev, gensurf and obj2rad. */
#include "cal/own_files.h"

#include <stddef.h>
#include <string.h>

/* R. Perez, R. Seals, J. Michalsky: All-weather model for sky luminance distribution. Solar Energy 50 (1993). A1 is the
 * norm, A2 the ground, A3 .. A7 the coefficients, A8 .. A10 the sun. Sky and ground fade into each other about the
 * horizon, here and below, in proportion to (Dz + 1.01)^10 and its reciprocal. */
#define PEREZ                                                                                                          \
    "tosun = A8*Dx + A9*Dy + A10*Dz; high = max(Dz, .01);"                                                             \
    "intersky = A1*(1 + A3*Exp(A4/high))*(1 + A5*Exp(A6*Acos(tosun)) + A7*tosun*tosun);"                               \
    "up = (Dz + 1.01)^10; down = 1/up; skybright = (up*intersky + down*A2)/(up + down);"
static const char perezlum[] = PEREZ;

/* gendaylit -C: A. Diakite-Kortlever, M. Knoop: Forecast accuracy of existing luminance-related spectral sky models.
 * Lighting Research & Technology 53 (2021). The luminance of a place tells its correlated colour temperature in K, the
 * same everywhere where A11, the clearness, says overcast; a cubic in the reciprocal of that tells x of CIE's 1931
 * chromaticity, A12 .. A15 up to 7000 K and A16 .. A19 above; a parabola in x, A20 .. A22, tells y. From XYZ to RGB by
 * Radiance's numbers, of which the first is .004 more than the others ask for. */
static const char perezlum_c[] =
    PEREZ "temperature = if(1.065 - arg(11), 6191, 1e6/(78.648*log10(skybright) - 180.956));"
          "cubic(n) = ((arg(n)/temperature + arg(n + 1))/temperature + arg(n + 2))/temperature + arg(n + 3);"
          "x = cubic(if(temperature - 7000, 16, 12)); y = (arg(20)*x + arg(21))*x + arg(22);"
          "X = skybright*x/y; Z = skybright*(1 - x - y)/y;"
          "skybright_r = 2.5693*X - 1.1668*skybright - .3984*Z;"
          "skybright_g = 1.9783*skybright - 1.0221*X + .0438*Z;"
          "skybright_b = 1.1772*Z - .0747*X - .2519*skybright;";

/* CIE's clear (1), overcast (2) and intermediate sky (4), and a uniform one (3), by A1; A2 is the zenith, A3 the
 * ground, A4 the norm for the sun's height, A5 .. A7 the sun. */
static const char skybright[] =
    "tosun = A5*Dx + A6*Dy + A7*Dz; gamma = Acos(tosun); fromzenith = Acos(Dz); sunzenith = Acos(A7);"
    "sunnysky = A2/A4*(.91 + .45*tosun*tosun + 10*exp(-3*gamma))*if(Dz - .01, 1 - exp(-.32/Dz), 1);"
    "cloudysky = A2*(1 + 2*Dz)/3; unifsky = A2;"
    "intersky = A2/A4*(6.37 - fromzenith + sin(4.396 - 2.6*sunzenith)*(3.12 + 1.35*sin(5.631 - 3.59*fromzenith)))/2.326"
    "  *exp(-.563*gamma*(.812 + (2.629 - fromzenith)*(1.562 - sunzenith)));"
    "up = (Dz + 1.01)^10; down = (Dz + 1.01)^-10;"
    "skybr = (up*select(A1, sunnysky, cloudysky, unifsky, intersky) + down*A3)/(up + down);";

/* Angles in degrees from the axis -z, and about it from x; and factors from candela to radiance for A1, a multiplier,
 * and A2 .. A4, the sizes of a box, or A2 and A3, a cylinder's diameter and height. */
static const char source[] = "corr(v) = if(AC - .5, A1*v, v); flatcorr(v) = corr(v)/Rdot;"
                             "boxcorr(v) = A1*v/(A2*A3*abs(Dz) + A2*A4*abs(Dy) + A3*A4*abs(Dx));"
                             "beyond(p, size) = noneg(abs(p) - size/2);"
                             "lboxcorr(v) = A1*v*Ts/(beyond(Px - Dx*Ts, A2)*A3*A4 + beyond(Py - Dy*Ts, A3)*A2*A4 + "
                             "beyond(Pz - Dz*Ts, A4)*A2*A3);"
                             "cylcorr(v) = A1*v/(A2*A3*sqrt(1 - Dz*Dz) + A2*A2*PI/4*abs(Dz));"
                             "src_theta = Acos(Dz)/DEGREE; src_phi = mod(Atan2(-Dy, -Dx)/DEGREE, 360);"
                             "src_phi2 = tri(src_phi, 180); src_phi4 = tri(src_phi, 90);"
                             "srcB_vert = atan2(-Dx, Dz)/DEGREE; srcB_horiz = atan2(Dy, Dz)/DEGREE;"
                             "srcB_vert2 = abs(srcB_vert); srcB_horiz2 = abs(srcB_horiz);";

/* Where in a distribution of light a ray finds itself: of a sphere the height of its direction and the angle about z
 * from x; of a flat illum the square of its cosine with the normal, A7 .. A9, and the angle against it from A1 .. A3
 * towards A4 .. A6. Angles are in 0 .. 2 PI. */
static const char illum[] = "turn(angle) = if(angle, angle, angle + 2*PI); against(x, y, z) = -(Dx*x + Dy*y + Dz*z);"
                            "il_alt = Dz; il_azi = turn(Atan2(Dy, Dx)); il_alth = against(A7, A8, A9)^2;"
                            "il_azih = turn(Atan2(against(A4, A5, A6), against(A1, A2, A3)));";

/* Of a lamp that is hung tilted (ies2rad of TILT=INCLUDE), by how it stands in the scene: the angles in degrees of its
 * axis z from the scene's, and about its x. */
static const char tilt[] = "tilt_ang = Acos(Kz)/DEGREE; tilt_xang = Atan2(Jy, abs(Jz))/DEGREE;"
                           "tilt_ang2 = tri(tilt_ang, 90); tilt_xang2 = tri(tilt_xang, 90);";

/* Panes of the BRTDfunc that glaze writes. A reflectance becomes 1, and a transmittance 0, towards grazing angles. */
#define GRAZING                                                                                                        \
    "least : exp(-5.85); rising = exp(-5.85*abs(Rdot)) - least;"                                                       \
    "fr(r) = r + rising*(1 - r); ft(t) = t - rising*t; rclr = fr(.076); tclr = ft(.883);"

/* One pane, whose plain side is in front for A10 of 1 and behind for -1. A frit covers arg(11) of the other side. Of a
 * coating arg(11) .. arg(13) is what the plain side reflects, arg(14) .. arg(16) the other, and arg(17) .. arg(19) is
 * transmitted. */
static const char glaze1[] = GRAZING "bare = 1 - arg(11); frit = rclr*if(A10*Rdot, 1, bare); through = tclr*bare;"
                                     "sr_frit_r = frit; sr_frit_g = frit; sr_frit_b = frit;"
                                     "st_frit_r = through; st_frit_g = through; st_frit_b = through;"
                                     "coat(n) = fr(arg(if(A10*Rdot, n, n + 3)));"
                                     "sr_clear_r = coat(11); sr_clear_g = coat(12); sr_clear_b = coat(13);"
                                     "st_clear_r = ft(arg(17)); st_clear_g = ft(arg(18)); st_clear_b = ft(arg(19));";

/* Two panes: what the second one reflects is seen through the first one, once. */
static const char glaze2[] = GRAZING "cr(front, pane, back) = front + pane*pane*back;";

/* What genrev -s adds to a cone's normal: along the axis z a line in the height, A1 and A2, and away from the axis one
 * in the distance, A3 and A4. */
static const char rev[] =
    "lean = A3 + A4/sqrt(Px*Px + Py*Py); rev_dx = lean*Px; rev_dy = lean*Py; rev_dz = A1*Pz + A2;";

/* What gensurf -s adds to a quadrangle's normal: bilinear in the two coordinates that follow A1 (0 for x, 1 for y, 2
 * for z); the rows of three from A2 on belong to their product, the first, the second, and 1. */
static const char surf[] = "surf_u = select(A1 + 1, Py, Pz, Px); surf_v = select(A1 + 1, Pz, Px, Py);"
                           "bilinear(n) = surf_u*(surf_v*arg(n) + arg(n + 3)) + surf_v*arg(n + 6) + arg(n + 9);"
                           "surf_dx = bilinear(2); surf_dy = bilinear(3); surf_dz = bilinear(4);";

/* What obj2rad, tmesh2rad and mgf2rad add to a triangle's normal, and its texture coordinates: linear in the two
 * coordinates that follow A1, three rows of factors of the first, of the second, and of 1. The normal is brought to
 * length 1. */
static const char tmesh[] =
    "bu = select(A1 + 1, Py, Pz, Px); bv = select(A1 + 1, Pz, Px, Py);"
    "row(n) = bu*arg(n) + bv*arg(n + 1) + arg(n + 2); v1 = row(2); v2 = row(5); v3 = row(8);"
    "size = sqrt(v1*v1 + v2*v2 + v3*v3); dx = v1/size - Nx; dy = v2/size - Ny; dz = v3/size - Nz;"
    "u = frac(v1); v = frac(v2);";

static const struct {
    const char *name, *text;
} files[] = {
    {"perezlum", perezlum}, {"perezlum_c", perezlum_c}, {"skybright", skybright}, {"source", source}, {"illum", illum},
    {"tilt", tilt},         {"glaze1", glaze1},         {"glaze2", glaze2},       {"rev", rev},       {"surf", surf},
    {"tmesh", tmesh}};

const char *cal_own_file(const char *name) {
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        size_t length = strlen(files[i].name);
        if (strncmp(name, files[i].name, length) == 0 && (!name[length] || strcmp(name + length, ".cal") == 0))
            return files[i].text;
    }
    return NULL;
}
