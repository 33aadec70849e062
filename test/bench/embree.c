/* What rays cost in Embree alone and in src/geometry: the same rays, one thread, nothing but asking.
 *
 * usage: embree SCENE RAYS: rays are those of gtrace -ff; from each hit, shadow rays go to a point of every light.
 * Prints millions of rays a second, the median of RUNS (5) rounds: Embree's own, on plain triangles and spheres, then
 * ours. First hits alone, shadow rays alone, and all in the order in which a path asks, when what was hit is still in
 * the cache. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/options.h"
#include "geometry/embree.h"
#include "geometry/geometry.h"
#include "geometry/solid_angle.h"
#include "scene/scene.h"

enum { MOST_RUNS = 101 };

typedef struct shadow_ray {
    geometry_ray ray;
    int target;
    size_t first; /* whose hit it starts at */
} shadow_ray;

typedef struct bench {
    graze_scene *scene;
    RTCDevice device;
    RTCScene plain; /* Embree's own view of the same shapes */
    size_t count, shadow_count;
    geometry_ray *rays;
    shadow_ray *shadows;
} bench;

static void *check(void *memory) {
    if (!memory) {
        fputs("embree: out of memory\n", stderr);
        exit(2);
    }
    return memory;
}

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void read_rays(bench *b, const char *path) {
    FILE *file = fopen(path, "rb");
    float record[6];
    size_t room = 0;
    while (file && fread(record, sizeof record, 1, file) == 1) {
        if (b->count == room) {
            room = room ? 2 * room : 1024;
            b->rays = check(realloc(b->rays, room * sizeof *b->rays));
        }
        vec3 direction = vec3_safe_normalize(vec3_make(record[3], record[4], record[5]));
        b->rays[b->count++] = (geometry_ray){
            .origin = {record[0], record[1], record[2]}, .direction = direction, .far = GEOMETRY_FAR, .from = -1};
    }
    if (!file || b->count == 0) {
        fprintf(stderr, "embree: %s: no rays\n", path);
        exit(1);
    }
    fclose(file);
}

/* A shadow ray as direct light asks it, towards a middle point of each light. */
static void make_shadows(bench *b) {
    const graze_scene *scene = b->scene;
    b->shadows = check(malloc((b->count * scene->light_count + 1) * sizeof *b->shadows));
    unsigned random = 1;
    for (size_t i = 0; i < b->count; i++) {
        geometry_hit hit;
        if (!geometry_intersect(scene->geometry, &b->rays[i], &hit))
            continue;
        vec3 normal = vec3_dot(hit.normal, b->rays[i].direction) > 0 ? vec3_negate(hit.normal) : hit.normal;
        for (size_t k = 0; k < scene->first_source; k++) {
            double u[2];
            for (int j = 0; j < 2; j++) {
                random = random * 1664525u + 1013904223u;
                u[j] = (random >> 8) * 0x1p-24;
            }
            solid_angle_sample s = solid_angle_draw(scene->lights[k].shape, hit.point, u[0], u[1]);
            if (s.density > 0 && vec3_dot(s.direction, normal) > 0)
                b->shadows[b->shadow_count++] = (shadow_ray){
                    {.origin = hit.point, .direction = s.direction, .far = s.distance, .from = hit.surface},
                    scene->lights[k].surface,
                    i};
        }
    }
}

static void attach(bench *b, RTCGeometry part) {
    rtcCommitGeometry(part);
    rtcAttachGeometry(b->plain, part);
    rtcReleaseGeometry(part);
}

/* Embree at its best: its own defaults, careful building. */
static void build_plain(bench *b) {
    const graze_scene *scene = b->scene;
    size_t triangles = 0, spheres = 0;
    for (size_t i = 0; i < scene->surface_count; i++) {
        const shape *s = &scene->shapes[i];
        triangles += s->kind == SHAPE_POLYGON ? s->polygon.triangle_count : 0;
        spheres += s->kind == SHAPE_SPHERE;
    }
    b->device = rtcNewDevice("threads=1");
    b->plain = rtcNewScene(b->device);
    rtcSetSceneBuildQuality(b->plain, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry mesh = rtcNewGeometry(b->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *vertex = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * triangles);
    unsigned *index = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles);
    RTCGeometry balls = rtcNewGeometry(b->device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    float *ball =
        rtcSetNewGeometryBuffer(balls, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, spheres ? spheres : 1);
    for (unsigned i = 0; i < 3 * triangles; i++)
        index[i] = i;
    for (size_t i = 0; i < scene->surface_count; i++) {
        const shape *s = &scene->shapes[i];
        if (s->kind == SHAPE_SPHERE) {
            *ball++ = (float)s->sphere.center.x;
            *ball++ = (float)s->sphere.center.y;
            *ball++ = (float)s->sphere.center.z;
            *ball++ = (float)s->sphere.radius;
        }
        for (uint32_t k = 0; s->kind == SHAPE_POLYGON && k < s->polygon.triangle_count; k++)
            for (int c = 0; c < 3; c++) {
                vec3 v = s->polygon.vertices[s->polygon.triangles[k][c]];
                *vertex++ = (float)v.x;
                *vertex++ = (float)v.y;
                *vertex++ = (float)v.z;
            }
    }
    attach(b, mesh);
    if (spheres)
        attach(b, balls);
    else
        rtcReleaseGeometry(balls);
    rtcCommitScene(b->plain);
}

static struct RTCRay plain_ray(const geometry_ray *r, double near, double far) {
    return (struct RTCRay){.org_x = (float)r->origin.x,
                           .org_y = (float)r->origin.y,
                           .org_z = (float)r->origin.z,
                           .dir_x = (float)r->direction.x,
                           .dir_y = (float)r->direction.y,
                           .dir_z = (float)r->direction.z,
                           .tnear = (float)near,
                           .tfar = (float)far,
                           .mask = UINT32_MAX};
}

static size_t embree_first(const bench *b, size_t i) {
    embree_context context;
    embree_context_init(&context);
    struct RTCRayHit r = {.ray = plain_ray(&b->rays[i], 0, INFINITY), .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
    embree_intersect(b->plain, &context, &r);
    return r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

static size_t embree_shadow(const bench *b, size_t i) {
    embree_context context;
    embree_context_init(&context);
    struct RTCRay r = plain_ray(&b->shadows[i].ray, 1e-4, b->shadows[i].ray.far * (1 - 1e-4));
    embree_occluded(b->plain, &context, &r);
    return r.tfar < 0;
}

static size_t our_first(const bench *b, size_t i) {
    geometry_hit hit;
    return geometry_intersect(b->scene->geometry, &b->rays[i], &hit);
}

static size_t our_shadow(const bench *b, size_t i) {
    return geometry_occluded(b->scene->geometry, &b->shadows[i].ray, b->shadows[i].target);
}

typedef size_t ask(const bench *, size_t);

/* Asks first hits, shadow rays, or both. */
static size_t ask_all(const bench *b, ask *first, ask *shadow) {
    size_t hits = 0, next = 0;
    for (size_t i = 0; i < b->count; i++) {
        hits += first ? first(b, i) : 0;
        for (; shadow && next < b->shadow_count && b->shadows[next].first == i; next++)
            hits += shadow(b, next);
    }
    return hits;
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv) {
    static const struct {
        const char *name;
        ask *first, *shadow;
    } questions[] = {{"embree first", embree_first, NULL},        {"geometry first", our_first, NULL},
                     {"embree shadow", NULL, embree_shadow},      {"geometry shadow", NULL, our_shadow},
                     {"embree all", embree_first, embree_shadow}, {"geometry all", our_first, our_shadow}};
    enum { QUESTIONS = sizeof questions / sizeof *questions };
    bench b = {0};
    if (argc != 3) {
        fputs("usage: embree SCENE RAYS\n", stderr);
        return 1;
    }
    graze_report report = options_standard_error_report("embree");
    const char *scene = argv[1];
    if (graze_scene_load(&b.scene, &scene, 1, NULL, &report) != GRAZE_OK)
        return 1;
    read_rays(&b, argv[2]);
    make_shadows(&b);
    build_plain(&b);
    const char *wanted = getenv("RUNS");
    int runs = wanted ? atoi(wanted) : 5;
    runs = runs < 1 ? 1 : runs > MOST_RUNS ? MOST_RUNS : runs;
    double times[QUESTIONS][MOST_RUNS];
    size_t hits[QUESTIONS];
    for (int run = 0; run < runs; run++)
        for (int q = 0; q < QUESTIONS; q++) {
            double start = seconds();
            hits[q] = ask_all(&b, questions[q].first, questions[q].shadow);
            times[q][run] = seconds() - start;
        }
    for (int q = 0; q < QUESTIONS; q++) {
        size_t count = (questions[q].first ? b.count : 0) + (questions[q].shadow ? b.shadow_count : 0);
        qsort(times[q], (size_t)runs, sizeof **times, by_size);
        printf("%-16s %8zu rays %8zu hits %8.3f million/s\n", questions[q].name, count, hits[q],
               (double)count / times[q][runs / 2] / 1e6);
    }
    rtcReleaseScene(b.plain);
    rtcReleaseDevice(b.device);
    free(b.shadows);
    free(b.rays);
    graze_scene_destroy(b.scene);
    return 0;
}
