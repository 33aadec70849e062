/* Cutting outlines at the horizon. */
#include "brdf/outline.h"

#include <math.h>
#include <stdbool.h>

typedef struct chain {
    brdf_arc_visitor *visit;
    void *context;
    bool begun;  /* something was above the surface */
    bool late;   /* ... but not all before it */
    bool broken; /* what follows does not join what was visited last */
    graze_vec3 start, end;
} chain;

static brdf_arc straight(graze_vec3 from, graze_vec3 to) {
    return (brdf_arc){from, {to.x - from.x, to.y - from.y, to.z - from.z}, {0, 0, 0}};
}

static void join(const chain *c, graze_vec3 to) {
    brdf_arc horizon = straight(c->end, to);
    c->visit(c->context, &horizon, 0, 1);
}

static void add(chain *c, const brdf_arc *arc, double from, double to) {
    graze_vec3 start = brdf_arc_at(arc, from);
    if (!c->begun) {
        c->start = start;
        c->late = c->broken;
    } else if (c->broken) {
        join(c, start);
    }
    c->visit(c->context, arc, from, to);
    c->end = brdf_arc_at(arc, to);
    c->begun = true;
    c->broken = false;
}

/* The u in (0, 1) where the arc crosses the horizon, in order. */
static int find_crossings(const brdf_arc *arc, double u[2]) {
    double a = arc->quadratic.z, half = arc->linear.z / 2, c = arc->constant.z, square = half * half - a * c;
    if (!(square > 0))
        return 0;
    double sum = -(half + copysign(sqrt(square), half)), roots[2] = {sum / a, c / sum};
    if (roots[0] > roots[1]) {
        double larger = roots[0];
        roots[0] = roots[1];
        roots[1] = larger;
    }
    int count = 0;
    for (int i = 0; i < 2; ++i)
        if (roots[i] > 0 && roots[i] < 1)
            u[count++] = roots[i];
    return count;
}

static void add_above(chain *c, const brdf_arc *arc) {
    double crossings[2];
    int count = find_crossings(arc, crossings);
    for (int i = 0; i <= count; ++i) {
        double from = i > 0 ? crossings[i - 1] : 0, to = i < count ? crossings[i] : 1;
        if (brdf_arc_at(arc, (from + to) / 2).z > 0)
            add(c, arc, from, to);
        else
            c->broken = true;
    }
}

/* The quarter of the ellipse about angle t, by u = (1 + tan(angle from t, halved)/tan(pi/8))/2: with w that tangent,
 * the point is (1 + w^2) center + (1 - w^2) toward + 2 w aside, over 1 + w^2. */
static brdf_arc quarter_of_ellipse(const brdf_outline *o, int quarter) {
    static const double tangent = 0x1.a827999fcef32p-2; /* of pi/8 */
    static const double sines[] = {0, 1, 0, -1, 0};
    double cosine = sines[quarter + 1], sine = sines[quarter];
    graze_vec3 toward = {cosine * o->first.x + sine * o->second.x, cosine * o->first.y + sine * o->second.y,
                         cosine * o->first.z + sine * o->second.z};
    graze_vec3 aside = {cosine * o->second.x - sine * o->first.x, cosine * o->second.y - sine * o->first.y,
                        cosine * o->second.z - sine * o->first.z};
    double t = tangent, t2 = tangent * tangent;
    graze_vec3 plus = {o->center.x + toward.x, o->center.y + toward.y, o->center.z + toward.z};
    graze_vec3 minus = {t2 * (o->center.x - toward.x), t2 * (o->center.y - toward.y), t2 * (o->center.z - toward.z)};
    graze_vec3 across = {2 * t * aside.x, 2 * t * aside.y, 2 * t * aside.z};
    /* plus + s across + s^2 minus for s = 2u - 1 */
    return (brdf_arc){
        {plus.x - across.x + minus.x, plus.y - across.y + minus.y, plus.z - across.z + minus.z},
        {2 * across.x - 4 * minus.x, 2 * across.y - 4 * minus.y, 2 * across.z - 4 * minus.z},
        {4 * minus.x, 4 * minus.y, 4 * minus.z},
    };
}

void brdf_outline_visit(const brdf_outline *o, brdf_arc_visitor *visit, void *context) {
    chain c = {.visit = visit, .context = context};
    size_t arcs = o->corners ? o->count : 4;
    for (size_t i = 0; i < arcs; ++i) {
        brdf_arc arc = o->corners ? straight(o->corners[i], o->corners[i + 1 < o->count ? i + 1 : 0])
                                  : quarter_of_ellipse(o, (int)i);
        add_above(&c, &arc);
    }
    if (c.begun && (c.late || c.broken))
        join(&c, c.start);
}
