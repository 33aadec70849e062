/* Scenes of few surfaces, looked through from the first to the last; for the instruction set that is in force where
 * this is included, which defines LANES, how many numbers are reckoned with at once, and MASK(flags), a bit for each.
 * What is offered is decided by functions that all share: no answer depends on it. */
#ifndef GEOMETRY_FEW_LOOK_H
#define GEOMETRY_FEW_LOOK_H

#include "geometry/few.h"
#include "geometry/query.h"

/* LANES numbers, and what comparisons of them give: all bits of a number, or none. */
typedef double numbers __attribute__((vector_size(LANES * sizeof(double))));
typedef int64_t flags __attribute__((vector_size(LANES * sizeof(int64_t))));
typedef double stored __attribute__((vector_size(LANES * sizeof(double)), aligned(8), may_alias));

typedef struct numbers3 {
    numbers x, y, z;
} numbers3;

/* Vectors are never handed to a function that is really called. */
#define IN_PLACE static inline __attribute__((always_inline))

/* A bound for what roundings do to where a ray meets a plane, per unit of all coordinates, where it does at a right
 * angle. */
#define ROUNDINGS 0x1p-45

IN_PLACE numbers at(const double *of_all) {
    return *(const stored *)of_all;
}

IN_PLACE numbers3 at3(const few_vec3 *of_all, int number) {
    return (numbers3){at(of_all->x + number), at(of_all->y + number), at(of_all->z + number)};
}

IN_PLACE numbers dot(numbers3 a, numbers3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

IN_PLACE numbers all(double a) {
    return a - (numbers){0};
}

IN_PLACE numbers3 all3(vec3 a) {
    return (numbers3){all(a.x), all(a.y), all(a.z)};
}

IN_PLACE flags above(numbers a, numbers b) {
    return (flags)(a > b);
}

IN_PLACE flags all_above(numbers a, numbers b, numbers c, numbers d, numbers limit) {
    return above(a, limit) & above(b, limit) & above(c, limit) & above(d, limit);
}

/* The ray, for every lane. */
typedef struct rays {
    numbers3 origin, direction;
    numbers blur;       /* of a point's place */
    numbers coincident; /* how far beyond the end something may still count */
} rays;

/* Beyond this nothing counts but what coincides with what is there. */
IN_PLACE numbers end_of(const query *q) {
    return all(q->nearest ? q->nearest->distance : q->far);
}

/* Offers those plates, from one on, that the ray meets before its end, or may. */
IN_PLACE void look_at_plates(query *q, const few_plates *p, int from, const rays *ray) {
    numbers3 normal = at3(&p->normal, from);
    numbers steep = 1 / dot(normal, ray->direction), height = at(p->offset + from) - dot(normal, ray->origin);
    numbers distance = height * steep, stretch = (numbers)((flags)steep & INT64_MAX), cut = at(p->cut + from);
    numbers3 point = {ray->origin.x + distance * ray->direction.x, ray->origin.y + distance * ray->direction.y,
                      ray->origin.z + distance * ray->direction.z};
    numbers u = dot(at3(&p->u, from), point) + at(p->u0 + from), v = dot(at3(&p->v, from), point) + at(p->v0 + from);
    numbers not_u = 1 - u - cut * v, not_v = 1 - v - cut * u;
    numbers margin = at(p->blur + from) * (ray->blur + at(p->uneven + from)) * stretch;
    unsigned met = MASK(all_above(u, v, not_u, not_v, -margin) & above(distance, all(0)) &
                        above(end_of(q) + ray->coincident * stretch, distance));
    if (!met)
        return;
    unsigned certain = MASK(all_above(u, v, not_u, not_v, margin));
    for (int i = from; met && !q->found_any; i++, met >>= 1, certain >>= 1)
        if (met & 1)
            query_offer_plate(q, &q->scene.tree->triangles[p->first[i]], p->count[i], certain & 1);
}

/* The same of curved surfaces whose balls the ray meets. */
IN_PLACE void look_at_balls(query *q, const few_balls *b, int from, const rays *ray) {
    numbers3 center = at3(&b->center, from);
    numbers3 to_center = {center.x - ray->origin.x, center.y - ray->origin.y, center.z - ray->origin.z};
    numbers middle = dot(to_center, ray->direction), away2 = dot(to_center, to_center);
    numbers radius = at(b->radius + from), radius2 = radius * radius;
    unsigned met =
        MASK(above(radius2 + 1e-12 * away2, away2 - middle * middle) & (above(middle, all(0)) | above(radius2, away2)) &
             above(radius + end_of(q) + ray->coincident, middle));
    for (int i = from; met && !q->found_any; i++, met >>= 1)
        if (met & 1)
            (void)query_offer_curved(q, (unsigned)i);
}

IN_PLACE void look_through(query *q) {
    const geometry_few *few = q->scene.tree->few;
    const rays ray = {all3(q->origin), all3(q->direction), all(ROUNDINGS * (q->size + q->geometry->largest_reach)),
                      all(2 * q->farthest_coincidence)};
    for (int i = 0; i < few->plate_count && !q->found_any; i += LANES)
        look_at_plates(q, &few->plates, i, &ray);
    for (int i = 0; i < few->ball_count && !q->found_any; i += LANES)
        look_at_balls(q, &few->balls, i, &ray);
}

#endif
