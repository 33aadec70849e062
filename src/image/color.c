/* Conversion between primaries, and between linear and sRGB values. */
#include "image/color.h"

#include <math.h>

const image_primaries image_radiance_primaries = {{.640, .330}, {.290, .600}, {.150, .060}, {1 / 3., 1 / 3.}};

static image_color_matrix multiply(image_color_matrix a, image_color_matrix b) {
    image_color_matrix product;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            product.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
    return product;
}

static void apply(const image_color_matrix *a, const double v[3], double result[3]) {
    for (int i = 0; i < 3; i++)
        result[i] = a->m[i][0] * v[0] + a->m[i][1] * v[1] + a->m[i][2] * v[2];
}

/* By cofactors. False for a matrix that is singular, nearly, or not finite. */
static bool invert(const image_color_matrix *a, image_color_matrix *inverse) {
    image_color_matrix cofactor;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            cofactor.m[j][i] = a->m[i1][j1] * a->m[i2][j2] - a->m[i1][j2] * a->m[i2][j1];
        }
    double determinant = 0;
    for (int j = 0; j < 3; j++)
        determinant += a->m[0][j] * cofactor.m[j][0];
    if (!(fabs(determinant) > 1e-6) || !isfinite(determinant))
        return false;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inverse->m[i][j] = cofactor.m[i][j] / determinant;
    return true;
}

/* XYZ of a chromaticity with Y = 1. */
static void white_xyz(const double white[2], double xyz[3]) {
    xyz[0] = white[0] / white[1];
    xyz[1] = 1;
    xyz[2] = (1 - white[0] - white[1]) / white[1];
}

/* RGB to XYZ: columns are the primaries, scaled so that (1, 1, 1) gives white with Y = 1. */
static bool to_xyz(const image_primaries *p, image_color_matrix *matrix) {
    const double *corner[3] = {p->red, p->green, p->blue};
    for (int j = 0; j < 3; j++) {
        matrix->m[0][j] = corner[j][0];
        matrix->m[1][j] = corner[j][1];
        matrix->m[2][j] = 1 - corner[j][0] - corner[j][1];
    }
    image_color_matrix inverse;
    if (!(p->white[0] > 1e-3) || !(p->white[1] > 1e-3) || !invert(matrix, &inverse))
        return false;
    double white[3], scale[3];
    white_xyz(p->white, white);
    apply(&inverse, white, scale);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            matrix->m[i][j] *= scale[j];
    return true;
}

/* Von Kries adaptation of white `from` to white `to` with the sharp sensors of Finlayson, Drew and Funt. */
static bool adaptation(const double from[2], const double to[2], image_color_matrix *matrix) {
    static const image_color_matrix sharp = {
        {{1.2694, -0.0988, -0.1706}, {-0.8364, 1.8006, 0.0357}, {0.0297, -0.0315, 1.0018}}};
    double from_xyz[3], to_xyz_white[3], from_cone[3], to_cone[3];
    white_xyz(from, from_xyz);
    white_xyz(to, to_xyz_white);
    apply(&sharp, from_xyz, from_cone);
    apply(&sharp, to_xyz_white, to_cone);
    image_color_matrix scaled = sharp, inverse;
    for (int i = 0; i < 3; i++) {
        if (!(from_cone[i] > 1e-3))
            return false;
        for (int j = 0; j < 3; j++)
            scaled.m[i][j] *= to_cone[i] / from_cone[i];
    }
    if (!invert(&sharp, &inverse))
        return false;
    *matrix = multiply(inverse, scaled);
    return true;
}

bool image_color_from_primaries(image_color_matrix *matrix, const image_primaries *p) {
    image_color_matrix xyz, adapted;
    if (!to_xyz(p, &xyz) || !adaptation(p->white, image_radiance_primaries.white, &adapted))
        return false;
    *matrix = multiply(image_color_from_xyz(), multiply(adapted, xyz));
    return true;
}

bool image_color_to_primaries(image_color_matrix *matrix, const image_primaries *p) {
    image_color_matrix from;
    return image_color_from_primaries(&from, p) && invert(&from, matrix);
}

image_color_matrix image_color_to_xyz(void) {
    image_color_matrix xyz = {{{0}}};
    to_xyz(&image_radiance_primaries, &xyz);
    return xyz;
}

image_color_matrix image_color_from_xyz(void) {
    image_color_matrix xyz = image_color_to_xyz(), inverse = {{{0}}};
    invert(&xyz, &inverse);
    return inverse;
}

double image_srgb_encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

double image_srgb_decode(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}
