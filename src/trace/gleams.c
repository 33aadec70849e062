/* Finding gleams: the points at which balls mirror lights, and how far around these they show them. */
#include "trace/gleams.h"

#include "base/angle.h"

/* A symmetric matrix. */
typedef struct matrix {
    double xx, xy, yy;
} matrix;

static matrix add_scaled(matrix a, double s, matrix b) {
    return (matrix){a.xx + s * b.xx, a.xy + s * b.xy, a.yy + s * b.yy};
}

static matrix inverse(matrix m) {
    double per = 1 / (m.xx * m.yy - m.xy * m.xy);
    return (matrix){per * m.yy, -per * m.xy, per * m.xx};
}

/* M S M. */
static matrix spread_by(matrix m, matrix s) {
    double ax = m.xx * s.xx + m.xy * s.xy, ay = m.xx * s.xy + m.xy * s.yy;
    double bx = m.xy * s.xx + m.yy * s.xy, by = m.xy * s.xy + m.yy * s.yy;
    return (matrix){ax * m.xx + ay * m.xy, ax * m.xy + ay * m.yy, bx * m.xy + by * m.yy};
}

/* a S b. */
static double between(const double a[2], matrix s, const double b[2]) {
    return a[0] * (s.xx * b[0] + s.xy * b[1]) + a[1] * (s.xy * b[0] + s.yy * b[1]);
}

/* How a ball shows a light to a point. */
typedef struct mirroring {
    vec3 at, normal, to_point, to_light;
    double point_distance, light_distance;
    vec3 x, y;          /* the lobe's frame there */
    double px, py;      /* to_point in it */
    double half_height; /* of the sum of both directions */
} mirroring;

/* So many steps of Newton's method find the point whose normal is halfway between both directions, as if a place on the
 * ball changed these alike to all sides. */
#define STEPS 4

/* Seen flatter than this, gleams are stretched beyond what is known of them. */
#define LEAST_COSINE 0.02

static vec3 unit(vec3 a, double *length) {
    *length = vec3_length(a);
    return vec3_scale(1 / *length, a);
}

static void set_directions(mirroring *m, vec3 point, vec3 light) {
    m->to_point = unit(vec3_subtract(point, m->at), &m->point_distance);
    m->to_light = unit(vec3_subtract(light, m->at), &m->light_distance);
}

static void set_frame(mirroring *m, const scene_ball *ball) {
    m->y = ball->has_orientation ? vec3_safe_normalize(vec3_cross(m->normal, ball->orientation)) : (vec3){0, 0, 0};
    if (vec3_max_abs(m->y) == 0)
        m->y = vec3_perpendicular(m->normal);
    m->x = vec3_cross(m->y, m->normal);
    m->px = vec3_dot(m->to_point, m->x);
    m->py = vec3_dot(m->to_point, m->y);
}

/* The point is outside of the ball. */
static bool find_mirroring(mirroring *m, const scene_ball *ball, const scene_ball_light *light, vec3 point) {
    vec3 goal = light->source ? vec3_add(point, light->summary.middle) : light->summary.middle;
    if (!(vec3_length(vec3_subtract(goal, ball->center)) > ball->radius))
        return false;
    m->at = ball->center;
    set_directions(m, point, goal);
    m->normal = vec3_normalize(vec3_add(m->to_point, m->to_light));
    for (int i = 0; i < STEPS; i++) {
        m->at = vec3_add_scaled(ball->center, ball->radius, m->normal);
        set_directions(m, point, goal);
        double length, turn = ball->radius * (1 / m->point_distance + 1 / m->light_distance);
        vec3 half = unit(vec3_add(m->to_point, m->to_light), &length);
        m->normal = vec3_normalize(vec3_add_scaled(half, turn / length, m->normal));
    }
    double cosine = vec3_dot(m->normal, m->to_point), other = vec3_dot(m->normal, m->to_light);
    if (!(cosine > LEAST_COSINE && other > LEAST_COSINE))
        return false;
    m->half_height = cosine + other;
    set_frame(m, ball);
    return true;
}

/* Beyond this, even of mirrors and points of light, directions are spread: that is about as exactly as the gleam's
 * place is known. */
#define LEAST_SPREAD 1e-6

/* How the places on the ball are spread, in its tangent plane, at which the light is seen: those where the slopes of
 * the half vector are as the lobe (17) is spread, half the square of its roughness to each side, and the light.
 * Directions to a point from places that lie s apart differ by s across them, over the distance. */
static matrix spread_of_places(const mirroring *m, const scene_ball *ball, const scene_ball_light *light) {
    matrix across = {1 - m->px * m->px, -m->px * m->py, 1 - m->py * m->py};
    double curvature = 1 / ball->radius, turn = (1 / m->point_distance + 1 / m->light_distance) / m->half_height;
    matrix slope_of_place = add_scaled((matrix){curvature, 0, curvature}, turn, across);
    double seen = m->light_distance * m->half_height, u = ball->roughness_u, v = ball->roughness_v;
    matrix slopes = {u * u / 2 + LEAST_SPREAD, 0, v * v / 2 + LEAST_SPREAD};
    slopes = add_scaled(slopes, light->summary.spread / (2 * seen * seen), across);
    return spread_by(inverse(slope_of_place), slopes);
}

/* The directions in which the point sees them. */
static void set_gleam(gleam *g, const mirroring *m, matrix places) {
    g->seen = true;
    g->middle = vec3_negate(m->to_point);
    g->x = vec3_perpendicular(g->middle);
    g->y = vec3_cross(g->middle, g->x);
    double per = 1 / m->point_distance, x[2] = {per * vec3_dot(g->x, m->x), per * vec3_dot(g->x, m->y)},
           y[2] = {per * vec3_dot(g->y, m->x), per * vec3_dot(g->y, m->y)};
    double yy = between(y, places, y);
    g->xx = sqrt(between(x, places, x));
    g->xy = between(x, places, y) / g->xx;
    g->yy = sqrt(fmax(yy - g->xy * g->xy, 1e-9 * yy));
}

/* Whether the direction leads to the ball. */
static bool leads_to(const gleams_of_ball *b, vec3 direction) {
    double along = vec3_dot(b->to_middle, direction);
    return along > 0 && along * along > b->tangent_square * vec3_dot(direction, direction);
}

/* A quarter of what a ball's cross-section gets goes evenly to all sides. So much of the light that all else sends to
 * the point that is as brightly lit varies as much as gleams do, as found by trial; where gleams are known not to be
 * hidden, directions that are drawn for them are well spent. */
#define ALL_ELSE           0.2
#define ALL_ELSE_WHEN_SEEN 0.05

/* Gleams in proportion to the rest. */
static double thrown_to(const scene_ball *ball, vec3 to_middle, double square, vec3 normal, double all_else) {
    double distance = sqrt(square), seen = ball->radius / (2 * distance - ball->radius);
    double height = vec3_dot(to_middle, normal), least = 0.1 * ball->radius;
    if (height <= -ball->radius)
        return 0;
    return ball->thrown * seen * seen * fmax(height, least) / (all_else * distance);
}

/* A ball that makes less of the light is met by luck. */
#define LEAST_SHARE 1e-3
/* The surface of a ball does not see its own gleams. */
#define LEAST_TANGENT 1e-6

static void expect(gleams *all, const graze_scene *scene, vec3 point, vec3 normal, double all_else) {
    const scene_balls *balls = scene->balls;
    all->scene = scene;
    all->point = point;
    all->count = 0;
    all->share = 0;
    for (int i = 0; i < balls->count; i++) {
        const scene_ball *ball = &balls->of[i];
        vec3 to_middle = vec3_subtract(ball->center, point);
        double square = vec3_dot(to_middle, to_middle), own = ball->radius * ball->radius, tangent = square - own;
        double thrown = tangent > LEAST_TANGENT * own ? thrown_to(ball, to_middle, square, normal, all_else) : 0;
        if (!(thrown >= LEAST_SHARE))
            continue;
        gleams_of_ball *b = &all->of[all->count++];
        b->ball = ball;
        b->to_middle = to_middle;
        b->tangent_square = tangent;
        b->share = thrown;
        b->found = false;
        all->share += thrown;
    }
}

/* The rest needs its samples, too: where gleams are not quite what is known of them, these find it. */
#define MOST 0.3

static void divide(gleams *all) {
    double scale = fmin(1 / (1 + all->share), MOST / all->share);
    for (int i = 0; i < all->count; i++)
        all->of[i].share *= scale;
    all->share *= scale;
}

void gleams_expect(gleams *all, const graze_scene *scene, vec3 point, vec3 normal) {
    expect(all, scene, point, normal, ALL_ELSE);
    divide(all);
}

static bool is_hidden(const gleams *all, const gleams_of_ball *b, const mirroring *m, const scene_ball_light *light,
                      int64_t surface) {
    geometry_ray seen = {
        .origin = all->point, .direction = vec3_negate(m->to_point), .far = m->point_distance, .from = surface};
    geometry_ray lit = {.origin = m->at,
                        .direction = m->to_light,
                        .far = light->source ? GEOMETRY_FAR : m->light_distance,
                        .from = b->ball->surface};
    return geometry_occluded_but_for_panes(all->scene->geometry, &seen, b->ball->surface, NULL) ||
           geometry_occluded_but_for_panes(all->scene->geometry, &lit, light->surface, NULL);
}

/* What hides the middle of a gleam may leave some of it. */
#define SHARE_OF_HIDDEN 0.125

/* `surface`: that the point is on; null: not known, and not asked what hides gleams. */
static void find(const gleams *all, gleams_of_ball *b, const int64_t *surface) {
    const scene_balls *balls = all->scene->balls;
    b->found = true;
    for (int k = 0; k < balls->light_count; k++) {
        mirroring m;
        b->lights[k] = b->ball->light[k];
        b->of[k].seen = b->lights[k] > 0 && find_mirroring(&m, b->ball, &balls->lights[k], all->point);
        if (!b->of[k].seen)
            continue;
        set_gleam(&b->of[k], &m, spread_of_places(&m, b->ball, &balls->lights[k]));
        if (surface && is_hidden(all, b, &m, &balls->lights[k], *surface))
            b->lights[k] *= SHARE_OF_HIDDEN;
    }
}

/* Leaves of a ball's share what its gleams that are seen have of it. */
static void leave_seen(const gleams *all, gleams_of_ball *b) {
    double sum = 0;
    int count = all->scene->balls->light_count;
    for (int k = 0; k < count; k++)
        sum += b->lights[k] = b->of[k].seen ? b->lights[k] : 0;
    for (int k = 0; k < count; k++)
        b->lights[k] = double_share(b->lights[k], sum);
    b->share *= sum;
}

void gleams_look(gleams *all, const graze_scene *scene, vec3 point, vec3 normal, int64_t surface) {
    int kept = 0;
    expect(all, scene, point, normal, ALL_ELSE_WHEN_SEEN);
    all->share = 0;
    for (int i = 0; i < all->count; i++) {
        gleams_of_ball *b = &all->of[i];
        find(all, b, &surface);
        leave_seen(all, b);
        all->share += b->share;
        if (b->share > 0)
            all->of[kept++] = *b;
    }
    all->count = kept;
    divide(all);
}

static double below_one(double x) {
    return fmin(x, 0x1.fffffffffffffp-1);
}

/* (p, q) has the density 1/(pi w) (1 + (p^2 + q^2)/w)^-2: in the middle about as high as that of a normal distribution
 * of variance 1, and not much less beyond: there, gleams may be brighter than is known. */
#define WIDTH 2.0

static vec3 draw_gleam(const gleam *g, double s, double t) {
    double u = fmin(s, 1 - 1e-9), radius = sqrt(WIDTH * u / (1 - u));
    double p = radius * cos(2 * PI * t), q = radius * sin(2 * PI * t);
    return vec3_normalize(vec3_add_scaled(vec3_add_scaled(g->middle, g->xx * p, g->x), g->xy * p + g->yy * q, g->y));
}

/* Takes from the number in [0, sum of the shares) which of them it falls into, and where in that. */
static gleams_of_ball *choose_ball(gleams *all, double *random) {
    gleams_of_ball *b = all->of;
    while (*random >= b->share && b + 1 < all->of + all->count)
        *random -= (b++)->share;
    *random = below_one(*random / b->share);
    return b;
}

static const gleam *choose_light(const gleams *all, const gleams_of_ball *b, double *random) {
    int k = 0;
    while (*random >= b->lights[k] && k + 1 < all->scene->balls->light_count)
        *random -= b->lights[k++];
    *random = below_one(*random / b->lights[k]);
    return &b->of[k];
}

bool gleams_turn(gleams *all, const graze_surface *s, double random[2]) {
    if (random[0] >= all->share) {
        random[0] = below_one((random[0] - all->share) / (1 - all->share));
        return true;
    }
    gleams_of_ball *b = choose_ball(all, &random[0]);
    if (!b->found)
        find(all, b, NULL);
    const gleam *g = choose_light(all, b, &random[0]);
    if (!g->seen)
        return false;
    vec3 direction = draw_gleam(g, random[0], random[1]);
    if (vec3_dot(direction, s->n) <= 0 || !leads_to(b, direction))
        return false;
    double x = vec3_dot(direction, s->x), y = vec3_dot(direction, s->y), turn = atan2(y, x) / (2 * PI);
    random[0] = below_one(x * x + y * y);
    random[1] = turn < 0 ? below_one(turn + 1) : turn;
    return true;
}

static double density_of(const gleam *g, vec3 direction) {
    double c = vec3_dot(direction, g->middle);
    if (!g->seen || c <= 0)
        return 0;
    double a = vec3_dot(direction, g->x) / c, b = vec3_dot(direction, g->y) / c;
    double p = a / g->xx, q = (b - g->xy * p) / g->yy, falls = 1 + (p * p + q * q) / WIDTH;
    return 1 / (PI * WIDTH * falls * falls * g->xx * g->yy * c * c * c);
}

double gleams_weight(gleams *all, vec3 direction, vec3 normal) {
    double even = fmax(vec3_dot(direction, normal), 0) / PI, density = (1 - all->share) * even;
    for (int i = 0; i < all->count; i++) {
        gleams_of_ball *b = &all->of[i];
        if (!leads_to(b, direction))
            continue;
        if (!b->found)
            find(all, b, NULL);
        for (int k = 0; k < all->scene->balls->light_count; k++)
            density += b->share * b->lights[k] * density_of(&b->of[k], direction);
    }
    return density > 0 ? even / density : 0;
}
