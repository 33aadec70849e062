/* Scenes of few surfaces: the same answers as from Embree, from all versions of the loop, and no leaks. */
#include "geometry/few.h"

#include "geometry/scenes.h"

/* So many that have no area, and are met by no ray, are more than few. */
#define CROWD (2 * GEOMETRY_FEW + 1)
#define MOST  24

typedef struct pair_of_scenes {
    shape shapes[MOST + CROWD];
    size_t count;
    geometry *few, *baseline, *crowded;
} pair_of_scenes;

static geometry *build(const shape *shapes, size_t count) {
    geometry *g;
    messages m = {0};
    graze_report report = {messages_write, &m};
    if (geometry_build(&g, &(geometry_group){.shapes = shapes, .shape_count = count}, 1, 1, &report) != GRAZE_OK)
        fail_msg("%s", m.last);
    return g;
}

static void build_both(pair_of_scenes *p) {
    static const vec3 nothing[3];
    p->few = build(p->shapes, p->count);
    p->baseline = build(p->shapes, p->count);
    for (size_t i = 0; i < CROWD; i++)
        shape_from_triangle(&p->shapes[p->count + i], nothing);
    p->crowded = build(p->shapes, p->count + CROWD);
    assert_true(p->few->trees[0].few && !p->few->trees[0].scene);
    assert_true(!p->crowded->trees[0].few && p->crowded->trees[0].scene);
    p->baseline->trees[0].few->look = few_look_baseline;
}

static void destroy_both(pair_of_scenes *p) {
    geometry_destroy(p->few);
    geometry_destroy(p->baseline);
    geometry_destroy(p->crowded);
}

/* A ray that goes for an edge at a grazing angle Embree may let pass, where no neighbour shares the edge. */
static bool intersect_alike(const pair_of_scenes *p, const geometry_ray *ray, bool at_edge, geometry_hit *hit) {
    geometry_hit other;
    bool found = geometry_intersect(p->few, ray, hit);
    const geometry *others[] = {p->baseline, p->crowded};
    for (int i = 0; i < (at_edge ? 1 : 2); i++) {
        assert_int_equal(geometry_intersect(others[i], ray, &other), found);
        assert_int_equal(hit->surface, other.surface);
        if (found)
            assert_true(hit->distance == other.distance && vec3_is_same(hit->point, other.point) &&
                        vec3_is_same(hit->normal, other.normal));
    }
    return found;
}

static bool occluded_alike(const pair_of_scenes *p, const geometry_ray *ray, bool at_edge, int64_t target) {
    bool occluded = geometry_occluded(p->few, ray, target);
    assert_int_equal(geometry_occluded(p->baseline, ray, target), occluded);
    if (!at_edge)
        assert_int_equal(geometry_occluded(p->crowded, ray, target), occluded);
    return occluded;
}

static shape roll_parallelogram(dice *d, vec3 at, double scale) {
    vec3 a = vec3_add(at, roll_in_cube(d, scale)), u = roll_in_cube(d, scale), v = roll_in_cube(d, scale);
    return quadrangle(a, vec3_add(a, u), vec3_add(vec3_add(a, u), v), vec3_add(a, v));
}

/* With as many corners as roll_outline gives it there may be more plates than few. */
static shape roll_concave(dice *d, vec3 at, double scale) {
    frame f = frame_around(roll_direction(d));
    vec3 origin = vec3_add(at, roll_in_cube(d, scale)), v[5];
    for (int i = 0; i < 5; i++) {
        double angle = 2 * PI * i / 5, radius = scale * (i == 2 ? 0.2 : 1);
        v[i] = vec3_add_scaled(vec3_add_scaled(origin, radius * cos(angle), f.x), radius * sin(angle), f.y);
    }
    return make_polygon(5, v);
}

static shape roll_curved(dice *d, vec3 at, double scale, int kind) {
    vec3 p0 = vec3_add(at, roll_in_cube(d, scale)), p1 = vec3_add(p0, roll_in_cube(d, 0.5 * scale));
    double r = scale * roll_between(d, 0.01, 0.4);
    shape s = kind == 0   ? make_sphere(p0, r)
              : kind == 1 ? make_cone(p0, p1, r, roll(d) < 0.5 ? r : 0)
                          : make_ring(p0, vec3_subtract(p1, p0), 0.3 * r, 1.5 * r);
    s.inward = kind != 2 && roll(d) < 0.3;
    return s;
}

/* All through one another, and some twice, as both sides of sheets. */
static void roll_few(pair_of_scenes *p, dice *d, vec3 at, double scale) {
    p->count = 1 + (size_t)(roll(d) * (MOST / 2));
    for (size_t i = 0; i < p->count; i++) {
        shape *s = &p->shapes[i];
        switch ((int)(roll(d) * 6)) {
        case 0:
            *s = roll_concave(d, at, scale);
            break;
        case 1:
            *s = triangle(vec3_add(at, roll_in_cube(d, scale)), vec3_add(at, roll_in_cube(d, scale)),
                          vec3_add(at, roll_in_cube(d, scale)));
            break;
        case 2:
            *s = roll_curved(d, at, scale, (int)(roll(d) * 3));
            break;
        case 3:
            if (i > 0) {
                *s = p->shapes[i - 1];
                s->shines = roll(d) < 0.5;
                break;
            }
            /* fall through */
        default:
            *s = roll_parallelogram(d, at, scale);
        }
    }
}

/* Anywhere, or a corner, or the middle of an edge. */
static vec3 roll_aim(const pair_of_scenes *p, dice *d, vec3 at, double scale, bool at_edge) {
    const shape *s = &p->shapes[(size_t)(roll(d) * (double)p->count)];
    if (s->kind != SHAPE_POLYGON || !at_edge)
        return vec3_add(at, roll_in_cube(d, scale));
    vec3 a = s->polygon.vertices[0], b = s->polygon.vertices[1];
    return roll(d) < 0.5 ? a : vec3_add_scaled(a, 0.5, vec3_subtract(b, a));
}

static void same_as_embree(void **state) {
    (void)state;
    dice d = {61};
    const double scales[] = {1, 1e-3, 1e3}, aways[] = {0, 1e4};
    int hits = 0, later_hits = 0, occluded = 0;
    for (int scene = 0; scene < 240; scene++) {
        static pair_of_scenes p;
        double scale = scales[scene % 3];
        vec3 at = roll_in_cube(&d, aways[scene / 3 % 2] * scale);
        roll_few(&p, &d, at, scale);
        build_both(&p);
        for (int i = 0; i < 200; i++) {
            vec3 origin = vec3_add(at, roll_in_cube(&d, (i % 3 ? 2 : 1000) * scale));
            bool at_edge = i % 4 == 3;
            vec3 aim = roll_aim(&p, &d, at, scale, at_edge);
            geometry_ray ray = ray_from(origin, vec3_subtract(aim, origin), -1);
            geometry_hit hit;
            bool found = intersect_alike(&p, &ray, at_edge, &hit);
            hits += found;
            for (int bounce = 0; found && bounce < 3; bounce++) {
                aim = roll_aim(&p, &d, at, scale, at_edge);
                ray = ray_from(hit.point, vec3_subtract(aim, hit.point), hit.surface);
                found = intersect_alike(&p, &ray, at_edge, &hit);
                later_hits += found;
            }
            aim = roll_aim(&p, &d, at, scale, at_edge);
            ray = ray_from(origin, vec3_subtract(aim, origin), -1);
            ray.far = vec3_length(vec3_subtract(aim, origin));
            occluded += occluded_alike(&p, &ray, at_edge, i % 2 ? (int64_t)(roll(&d) * (double)p.count) : -1);
        }
        destroy_both(&p);
    }
    assert_true(hits > 15000 && later_hits > 10000 && occluded > 8000);
}

/* Of a polygon that is a little bent, its triangles are met where they are, not where its plane is. */
static void edges_of_bent_polygons(void **state) {
    (void)state;
    static pair_of_scenes p;
    dice d = {63};
    int hits = 0, rays = 0;
    for (int scene = 0; scene < 40; scene++) {
        const double bend = 1e-4;
        vec3 v[4] = {{0, 0, 0}, {1, 0, bend}, {1, 1, 0}, {0, 1, bend}};
        double reals[12];
        bool degenerate;
        messages m;
        frame f = frame_around(roll_direction(&d));
        for (int i = 0; i < 4; i++) {
            v[i] = frame_to_world(&f, v[i]);
            memcpy(&reals[3 * i], &v[i], sizeof v[i]);
        }
        assert_int_equal(try_shape(&p.shapes[0], &degenerate, &m, RAD_POLYGON, 12, reals), GRAZE_OK);
        p.count = 1;
        build_both(&p);
        for (int i = 0; i < 500; i++, rays++) {
            int side = (int)(roll(&d) * 4);
            vec3 edge = vec3_subtract(v[(side + 1) % 4], v[side]);
            vec3 aside = vec3_scale(roll_between(&d, -bend, bend), vec3_cross(edge, f.z));
            vec3 aim = vec3_add(vec3_add_scaled(v[side], roll(&d), edge), aside);
            vec3 origin = vec3_add(vec3_scale(i % 2 ? 2 : -2, f.z), roll_in_cube(&d, 1.5));
            geometry_ray ray = ray_from(origin, vec3_subtract(aim, origin), -1);
            geometry_hit hit;
            hits += intersect_alike(&p, &ray, false, &hit);
        }
        destroy_both(&p);
    }
    assert_true(hits > rays / 4 && hits < 3 * rays / 4);
}

/* A turned box of six parallelograms, or of twelve triangles: no ray gets out, not by the edges either. */
static void no_leaks(void **state) {
    (void)state;
    dice d = {62};
    for (int scene = 0; scene < 40; scene++) {
        shape shapes[12];
        frame f = frame_around(roll_direction(&d));
        vec3 away = roll_in_cube(&d, scene % 2 ? 1e4 : 1), corners[8];
        for (int i = 0; i < 8; i++)
            corners[i] =
                vec3_add(away, frame_to_world(&f, vec3_make(i & 1 ? 1 : -1, i & 2 ? 2 : -2, i & 4 ? 0.5 : -0.5)));
        static const int faces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                        {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
        size_t count = 0;
        for (int i = 0; i < 6; i++) {
            const vec3 a = corners[faces[i][0]], b = corners[faces[i][1]], c = corners[faces[i][2]],
                       e = corners[faces[i][3]];
            if (scene % 4 < 2) {
                shapes[count++] = quadrangle(a, b, c, e);
            } else {
                shapes[count++] = triangle(a, b, c);
                shapes[count++] = triangle(a, c, e);
            }
        }
        geometry *g = build(shapes, count);
        for (int i = 0; i < 5000; i++) {
            vec3 inside = frame_to_world(&f, roll_in_cube(&d, 0.4));
            int corner = (int)(roll(&d) * 8), next = corner ^ 1 << (int)(roll(&d) * 3);
            vec3 aim = vec3_add_scaled(corners[corner], roll(&d), vec3_subtract(corners[next], corners[corner]));
            vec3 origin = vec3_add(away, inside);
            geometry_ray ray = ray_from(origin, i % 2 ? vec3_subtract(aim, origin) : roll_direction(&d), -1);
            geometry_hit hit;
            assert_true(geometry_intersect(g, &ray, &hit));
            assert_true(geometry_occluded(g, &ray, -1));
        }
        geometry_destroy(g);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_as_embree),
        cmocka_unit_test(edges_of_bent_polygons),
        cmocka_unit_test(no_leaks),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
