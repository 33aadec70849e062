/* What a renderer needs to shade with Graze: one metal2 surface under a round light, once by sampling the light
 * (Eq. 18) and once by sampling the surface (Eq. 16). Both find the same radiance.
 *
 *   cc link_material.c $(pkg-config --cflags --libs graze) -lm */
#include <graze/material.h>
#include <math.h>
#include <stdio.h>

#define COUNT 200000

/* The light: 0.1 rad from its centre to its edge, the centre in the mirror direction of the view. */
static const graze_vec3 centre = {-0.6, 0, 0.8}, across = {0.8, 0, 0.6}, along = {0, 1, 0};
static const graze_rgb radiance = {10, 10, 10};
static const double edge_cosine = 0.99500416527802577, pi = 3.14159265358979324;

static graze_vec3 point_of_light(double s, double t) {
    double c = 1 - s * (1 - edge_cosine), r = sqrt(1 - c * c), a = r * cos(2 * pi * t), b = r * sin(2 * pi * t);
    return (graze_vec3){c * centre.x + a * across.x + b * along.x, c * centre.y + a * across.y + b * along.y,
                        c * centre.z + a * across.z + b * along.z};
}

static int light_lies_in(graze_vec3 d) {
    return d.x * centre.x + d.y * centre.y + d.z * centre.z > edge_cosine;
}

int main(void) {
    /* void metal2 brushed  4 1 1 0 .  0  6 .9 .6 .3 .8 .05 .2 */
    const graze_material brushed = {.kind = GRAZE_METAL,
                                    .model = GRAZE_BRDF_GMD,
                                    .color = {0.9, 0.6, 0.3},
                                    .specularity = 0.8,
                                    .roughness_u = 0.05,
                                    .roughness_v = 0.2,
                                    .has_orientation = 1,
                                    .orientation = {1, 1, 0}};
    const graze_vec3 normal = {0, 0, 1}, view = {0.6, 0, 0.8};
    graze_surface surface;
    graze_surface_prepare(&surface, &brushed, normal, view, NULL);

    graze_rgb by_light = {0, 0, 0}, by_surface = {0, 0, 0};
    for (int i = 0; i < COUNT; i++) {
        /* Three numbers in [0,1) that fill the cube evenly as i grows. */
        double s = (i + 0.5) / COUNT, t = fmod(i * 0.7548776662466927, 1), u = fmod(i * 0.5698402909980532, 1);

        /* Eq. 18: each sample of the light stands for its part of the light's solid angle. */
        graze_light_sample sample = {point_of_light(s, t), radiance, 2 * pi * (1 - edge_cosine) / COUNT};
        graze_rgb direct = graze_surface_direct(&surface, &sample, 1);
        by_light.r += direct.r, by_light.g += direct.g, by_light.b += direct.b;

        /* Eq. 16: the mean over all samples of weight times what is seen in the direction; the lobes add up. */
        const graze_lobe lobes[] = {GRAZE_LOBE_DIFFUSE, surface.specular_lobe};
        for (int k = 0; k < 2; k++) {
            graze_surface_sample found = graze_surface_sample_lobe(&surface, lobes[k], s, t, u);
            if (light_lies_in(found.direction)) {
                by_surface.r += found.weight.r * radiance.r / COUNT;
                by_surface.g += found.weight.g * radiance.g / COUNT;
                by_surface.b += found.weight.b * radiance.b / COUNT;
            }
        }
    }
    printf("sampling the light:   %.3f %.3f %.3f\n", by_light.r, by_light.g, by_light.b);
    printf("sampling the surface: %.3f %.3f %.3f\n", by_surface.r, by_surface.g, by_surface.b);
    printf("they agree to %.1g\n", fabs(by_surface.r / by_light.r - 1));
    return fabs(by_surface.r / by_light.r - 1) < 0.005 ? 0 : 1;
}
