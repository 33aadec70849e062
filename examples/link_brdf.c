/* The reflectance of a brushed metal: its value in some directions, one by one and all at once, and its albedo twice,
 * as the mean weight of samples and as an integral. C11 and C++17.
 *
 *   cc link_brdf.c $(pkg-config --cflags --libs graze) -lm */
#include <graze/brdf.h>
#include <graze/brdf_batch.h>
#include <math.h>
#include <stdio.h>

#define COUNT   9
#define SAMPLES 4096

static const double degree = 3.14159265358979324 / 180;

/* In the plane of incidence, y = 0; a negative angle lies on the other side. */
static graze_vec3 direction(double angle) {
    graze_vec3 d = {sin(angle * degree), 0, cos(angle * degree)};
    return d;
}

int main(void) {
    const graze_brdf brushed = {GRAZE_BRDF_GMD, 0.05, 0.2};
    const graze_vec3 view = direction(60);
    int failed = 0;

    /* The values around the mirror direction, -60 degrees, where the view is the same for all. */
    double lx[COUNT], ly[COUNT], lz[COUNT], vx[COUNT], vy[COUNT], vz[COUNT], values[COUNT];
    for (int i = 0; i < COUNT; i++) {
        graze_vec3 l = direction(-40 - 5 * i);
        lx[i] = l.x, ly[i] = l.y, lz[i] = l.z;
        vx[i] = view.x, vy[i] = view.y, vz[i] = view.z;
    }
    const graze_vec3_arrays l = {lx, ly, lz}, v = {vx, vy, vz};
    graze_brdf_value_batch(&brushed, COUNT, l, v, values);
    for (int i = 0; i < COUNT; i++) {
        graze_vec3 one = {lx[i], ly[i], lz[i]};
        printf("value at %d degrees: %.6g\n", -40 - 5 * i, values[i]);
        failed |= values[i] != graze_brdf_value(&brushed, one, view);
    }

    /* Table of albedos. Each sample's weight is the share of light from its direction that goes to the view. */
    for (int angle = 0; angle < 90; angle += 15) {
        graze_vec3 from = direction(angle);
        double albedo = graze_brdf_albedo(&brushed, from), mean = 0;
        for (int i = 0; i < SAMPLES; i++) {
            double s = (i + 0.5) / SAMPLES, t = fmod(i * 0.7548776662466927, 1), u = fmod(i * 0.5698402909980532, 1);
            mean += graze_brdf_sample_pair(&brushed, from, s, t, u).weight / SAMPLES;
        }
        printf("albedo at %d degrees: %.9f, from samples %.4f\n", angle, albedo, mean);
        failed |= fabs(mean - albedo) > 0.001;
    }
    printf("albedo of the hemisphere: %.9f\n", graze_brdf_mean_albedo(&brushed));
    return failed;
}
