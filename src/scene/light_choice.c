/* Choosing lights: down the tree, a group's entry in proportion to its weight. */
#include "scene/light_choice.h"

static void set_rgb(float to[3], rgb reflectance, double most) {
    to[0] = (float)(rgb_brightness((rgb){1, 0, 0}) * reflectance.r / most);
    to[1] = (float)(rgb_brightness((rgb){0, 1, 0}) * reflectance.g / most);
    to[2] = (float)(rgb_brightness((rgb){0, 0, 1}) * reflectance.b / most);
}

static light_weights_input input_of(const light_tree *tree, const light_receiver *r) {
    vec3 p = light_tree_point(tree, r->point);
    const graze_surface *s = r->surface;
    double most = fmax(fmax(rgb_max(r->diffuse), rgb_max(r->glossy)),
                       fmax(rgb_max(r->ambient_diffuse), rgb_max(r->ambient_glossy)));
    most = most > 0 ? most : 1;
    light_weights_input in = {
        .px = p.x,
        .py = p.y,
        .pz = p.z,
        .xx = (float)s->x.x,
        .xy = (float)s->x.y,
        .xz = (float)s->x.z,
        .yx = (float)s->y.x,
        .yy = (float)s->y.y,
        .yz = (float)s->y.z,
        .nx = (float)s->n.x,
        .ny = (float)s->n.y,
        .nz = (float)s->n.z,
        .vx = (float)s->local_view.x,
        .vy = (float)s->local_view.y,
        .vz = (float)s->local_view.z,
        .alpha_x2 = (float)(s->lobe.alpha_x * s->lobe.alpha_x),
        .alpha_y2 = (float)(s->lobe.alpha_y * s->lobe.alpha_y),
        .has_lobe = !rgb_is_black(r->glossy) || !rgb_is_black(r->ambient_glossy),
    };
    set_rgb(in.diffuse, r->diffuse, most);
    set_rgb(in.glossy, r->glossy, most);
    set_rgb(in.ambient_diffuse, r->ambient_diffuse, most);
    set_rgb(in.ambient_glossy, r->ambient_glossy, most);
    return in;
}

/* Whether the light is wanted and has a part above the horizon and in front of its plane. */
static bool can_reach(const graze_scene *scene, int index, const light_receiver *r, vec3 point, bool ambient) {
    const scene_light *light = &scene->lights[index];
    const light_entries *e = &scene->light_tree.entries;
    size_t i = scene->light_tree.entry_of[index];
    if (scene->light_tree.group_of[index] < 0 || (light_is_ambient(light) && !ambient))
        return false;
    vec3 middle = {e->x[i], e->y[i], e->z[i]}, axis = {(double)e->ax[i], (double)e->ay[i], (double)e->az[i]};
    vec3 to_middle = light->shape ? vec3_subtract(middle, point) : middle;
    double radius = 1.000001 * (double)e->radius[i], height = -vec3_dot(axis, to_middle);
    if (vec3_dot(to_middle, r->surface->n) <= -radius)
        return false;
    return height > 0 || e->all_around[i] > 0 || (height > -1e-6 * radius && vec3_length(to_middle) < radius);
}

bool light_choice_is_above(const graze_scene *scene, int index, vec3 at, vec3 normal) {
    const light_entries *e = &scene->light_tree.entries;
    size_t i = scene->light_tree.entry_of[index];
    if (scene->light_tree.group_of[index] < 0)
        return false;
    vec3 middle = {e->x[i], e->y[i], e->z[i]}, point = light_tree_point(&scene->light_tree, at);
    vec3 to_middle = scene->lights[index].shape ? vec3_subtract(middle, point) : middle;
    return vec3_dot(to_middle, normal) > 1.000001 * (double)e->radius[i];
}

/* Of a few lights, only whether they can reach the point is asked. */
static void prepare_every(light_choice *choice, const graze_scene *scene) {
    const light_receiver *r = &choice->receiver;
    vec3 point = light_tree_point(&scene->light_tree, r->point);
    bool ambient = !rgb_is_black(r->ambient_diffuse) || !rgb_is_black(r->ambient_glossy);
    choice->root.candidates = 0;
    choice->every = (int)light_choice_count(scene, r);
    for (int i = 0; i < choice->every; i++) {
        bool reaches = can_reach(scene, i, r, point, ambient);
        choice->root.of[i] = reaches ? 1 : 0;
        choice->root.candidates += reaches;
    }
}

void light_choice_prepare(light_choice *choice, const graze_scene *scene, const light_receiver *receiver) {
    const light_tree *tree = &scene->light_tree;
    choice->tree = tree;
    choice->receiver = *receiver;
    choice->windows.count = 0;
    if (scene->windows && receiver->window_draws > 0 &&
        (!rgb_is_black(receiver->ambient_diffuse) || !rgb_is_black(receiver->ambient_glossy)))
        window_choice_prepare(&choice->windows, scene, receiver->point, receiver->surface->n, receiver->window_draws);
    if (light_choice_is_every_one(choice)) {
        prepare_every(choice, scene);
        return;
    }
    choice->input = input_of(tree, receiver);
    tree->weigh(tree, &tree->groups[0], &choice->input, &choice->root);
}

void light_choice_none(light_choice *choice) {
    choice->tree = NULL;
    choice->windows.count = 0;
    choice->root.candidates = 0;
}

double light_expectation(const light_choice *choice, int light) {
    const light_tree *tree = choice->tree;
    if (!light_choice_is_possible(choice) || tree->group_of[light] < 0)
        return 0;
    if (light_choice_is_every_one(choice))
        return light < choice->every ? (double)choice->root.of[light] : 0;
    int index = tree->group_of[light];
    size_t entry = tree->entry_of[light];
    double probability = 1;
    while (index != 0) {
        const light_group *group = &tree->groups[index];
        light_weights weights;
        tree->weigh(tree, group, &choice->input, &weights);
        if (weights.candidates == 0)
            return 0;
        probability *= (double)weights.of[entry - group->first] / weights.total;
        entry = group->parent_entry;
        index = group->parent;
    }
    return choice->receiver.draws * probability * ((double)choice->root.of[entry] / choice->root.total);
}

/* Chooses an entry: its lane, then its block. `random` becomes where the number was between the entry's ends. */
static size_t choose_entry(const light_group *group, const light_weights *w, double *random, double *expectation) {
    double left = *random * w->total;
    size_t lane = 0, last = 0;
    while (lane + 1 < LIGHT_LANES && left >= w->lanes[lane])
        left -= w->lanes[lane++];
    /* Where rounding leaves more than there is, the last that can be chosen is. */
    while (w->lanes[lane] == 0)
        lane--;
    for (size_t block = 0; block < (size_t)group->blocks; block++) {
        size_t at = block * LIGHT_LANES + lane;
        double weight = (double)w->of[at];
        if (weight == 0)
            continue;
        last = at;
        if (left < weight)
            break;
        left -= weight;
    }
    double weight = (double)w->of[last];
    *random = fmin(fmax(left / weight, 0), 0x1.fffffffffffffp-1);
    *expectation *= weight / w->total;
    return group->first + last;
}

int light_choose(const light_choice *choice, double random, double *expectation) {
    const light_tree *tree = choice->tree;
    const light_group *group = &tree->groups[0];
    *expectation = choice->receiver.draws;
    size_t entry = choose_entry(group, &choice->root, &random, expectation);
    while (!group->of_lights) {
        light_weights weights;
        group = &tree->groups[tree->entries.child[entry]];
        tree->weigh(tree, group, &choice->input, &weights);
        if (weights.candidates == 0)
            return -1;
        entry = choose_entry(group, &weights, &random, expectation);
    }
    return tree->entries.child[entry];
}
