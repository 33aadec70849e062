/* Transforms: reading, composing and applying them. */
#include "rad/transform.h"

#include <math.h>
#include <string.h>

#include "base/angle.h"
#include "base/number.h"

/* Beyond this, products of coordinates and distances squared leave a double's range. */
static const double largest_element = 1e100;

rad_transform rad_transform_identity(void) {
    return (rad_transform){.m = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}, .scale = 1, .mirrored = false};
}

rad_transform rad_transform_then(const rad_transform *first, const rad_transform *second) {
    rad_transform both = {.scale = first->scale * second->scale, .mirrored = first->mirrored != second->mirrored};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 3; ++column) {
            double sum = row == 3 ? second->m[3][column] : 0;
            for (int k = 0; k < 3; ++k)
                sum += first->m[row][k] * second->m[k][column];
            both.m[row][column] = sum;
        }
    return both;
}

vec3 rad_transform_vector(const rad_transform *t, vec3 v) {
    return vec3_make(v.x * t->m[0][0] + v.y * t->m[1][0] + v.z * t->m[2][0],
                     v.x * t->m[0][1] + v.y * t->m[1][1] + v.z * t->m[2][1],
                     v.x * t->m[0][2] + v.y * t->m[1][2] + v.z * t->m[2][2]);
}

vec3 rad_transform_point(const rad_transform *t, vec3 p) {
    return vec3_add(rad_transform_vector(t, p), vec3_make(t->m[3][0], t->m[3][1], t->m[3][2]));
}

/* The linear part is a rotation or reflection times the scale. */
rad_transform rad_transform_inverse(const rad_transform *t) {
    rad_transform inverse = {.scale = 1 / t->scale, .mirrored = t->mirrored};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            inverse.m[row][column] = t->m[column][row] / t->scale / t->scale;
    vec3 moved = rad_transform_vector(&inverse, vec3_make(t->m[3][0], t->m[3][1], t->m[3][2]));
    inverse.m[3][0] = -moved.x;
    inverse.m[3][1] = -moved.y;
    inverse.m[3][2] = -moved.z;
    return inverse;
}

/* The scale says it for the rest of the matrix. */
static bool is_in_range(const rad_transform *t) {
    for (int column = 0; column < 3; ++column)
        if (!(fabs(t->m[3][column]) <= largest_element))
            return false;
    return t->scale >= 1 / largest_element && t->scale <= largest_element;
}

/* Exact for whole quarter turns, which most scenes are made of. */
static void sine_and_cosine(double degrees, double *sine, double *cosine) {
    double reduced = fmod(degrees, 360);
    if (fmod(reduced, 90) == 0) {
        static const double sines[4] = {0, 1, 0, -1};
        int quarter = ((int)(reduced / 90) + 4) % 4;
        *sine = sines[quarter];
        *cosine = sines[(quarter + 1) % 4];
        return;
    }
    *sine = sin(angle_radians(reduced));
    *cosine = cos(angle_radians(reduced));
}

static rad_transform rotation(int axis, double degrees) {
    rad_transform t = rad_transform_identity();
    int y = (axis + 1) % 3, z = (axis + 2) % 3;
    double sine, cosine;
    sine_and_cosine(degrees, &sine, &cosine);
    t.m[y][y] = t.m[z][z] = cosine;
    t.m[y][z] = sine;
    t.m[z][y] = -sine;
    return t;
}

static rad_transform scaling(double factor) {
    rad_transform t = {.scale = fabs(factor), .mirrored = factor < 0};
    for (int axis = 0; axis < 3; ++axis)
        t.m[axis][axis] = factor;
    return t;
}

static rad_transform mirroring(int axis) {
    rad_transform t = rad_transform_identity();
    t.m[axis][axis] = -1;
    t.mirrored = true;
    return t;
}

static bool read_numbers(const char *const *words, int available, int count, double *values) {
    if (available < count)
        return false;
    for (int i = 0; i < count; ++i)
        if (!text_to_real(words[i], &values[i]))
            return false;
    return true;
}

/* One operation at words[0] other than -i: how many words it takes, 0 where there is none. */
static int read_operation(rad_transform *t, const char *const *words, int count) {
    const char *name = words[0] + 1;
    int axis = name[0] ? name[1] - 'x' : -1;
    bool has_axis = axis >= 0 && axis < 3 && !name[2];
    double values[3];
    if (!strcmp(name, "t") && read_numbers(words + 1, count - 1, 3, values)) {
        *t = rad_transform_identity();
        memcpy(t->m[3], values, sizeof values);
        return 4;
    }
    if (!strcmp(name, "s") && read_numbers(words + 1, count - 1, 1, values) && values[0] != 0) {
        *t = scaling(values[0]);
        return 2;
    }
    if (name[0] == 'r' && has_axis && read_numbers(words + 1, count - 1, 1, values)) {
        *t = rotation(axis, values[0]);
        return 2;
    }
    if (name[0] == 'm' && has_axis) {
        *t = mirroring(axis);
        return 1;
    }
    return 0;
}

/* By squaring: the count may be anything. */
static rad_transform power(rad_transform t, int n) {
    rad_transform result = rad_transform_identity();
    for (; n > 0; n /= 2) {
        if (n % 2)
            result = rad_transform_then(&result, &t);
        if (n > 1)
            t = rad_transform_then(&t, &t);
    }
    return result;
}

int rad_transform_leading(rad_transform *transform, const char *const *words, int count, bool *in_range) {
    rad_transform total = rad_transform_identity(), repeated = total, step;
    int repetitions = 1, used = 0;
    while (used < count && words[used][0] == '-') {
        int next;
        if (!strcmp(words[used], "-i") && used + 1 < count && text_to_integer(words[used + 1], &next)) {
            step = power(repeated, repetitions);
            total = rad_transform_then(&total, &step);
            repeated = rad_transform_identity();
            repetitions = next;
            used += 2;
            continue;
        }
        int taken = read_operation(&step, words + used, count - used);
        if (!taken)
            break;
        repeated = rad_transform_then(&repeated, &step);
        used += taken;
    }
    step = power(repeated, repetitions);
    total = rad_transform_then(&total, &step);
    *in_range = is_in_range(&total);
    *transform = *in_range ? total : rad_transform_identity();
    return used;
}

const char *rad_transform_wants(const char *word) {
    static const struct {
        const char *word, *wants;
    } operations[] = {
        {"-t", "three numbers are to follow"},       {"-s", "a number that is not 0 is to follow"},
        {"-rx", "an angle in degrees is to follow"}, {"-ry", "an angle in degrees is to follow"},
        {"-rz", "an angle in degrees is to follow"}, {"-i", "a whole number is to follow"},
    };
    for (size_t i = 0; i < sizeof operations / sizeof *operations; i++)
        if (!strcmp(word, operations[i].word))
            return operations[i].wants;
    return "there is no such transform";
}

graze_status rad_transform_parse(rad_transform *transform, const char *const *words, int count, const place *where,
                                 const graze_report *report) {
    bool in_range;
    int used = rad_transform_leading(transform, words, count, &in_range);
    if (used < count)
        return report_error(report, where, "bad transform at '%.64s': %s", words[used],
                            rad_transform_wants(words[used]));
    if (!in_range)
        return report_error(report, where, "transform out of range");
    return GRAZE_OK;
}
