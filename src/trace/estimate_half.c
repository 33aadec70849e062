/* Sums over blocks of samples. */
#include "trace/estimate_half.h"

static void merge_blocks(estimate_half *h) {
    for (int i = 0; i < ESTIMATE_BLOCKS / 2; i++) {
        h->sum[i] = rgb_add(h->sum[2 * i], h->sum[2 * i + 1]);
        for (int k = 0; k < h->control_count; k++)
            h->difference[i][k] = rgb_add(h->difference[2 * i][k], h->difference[2 * i + 1][k]);
    }
    h->level++;
}

/* The block that the next sample belongs to. */
static int next_block(estimate_half *h) {
    if (h->taken >> h->level == ESTIMATE_BLOCKS)
        merge_blocks(h);
    int block = (int)(h->taken >> h->level);
    if (h->taken == (uint32_t)block << h->level) {
        h->sum[block] = rgb_gray(0);
        for (int k = 0; k < h->control_count; k++)
            h->difference[block][k] = rgb_gray(0);
    }
    return block;
}

static void add_controls(estimate_half *h, int block, const path_sample *sample) {
    for (; h->control_count < sample->control_count; h->control_count++) {
        int k = h->control_count;
        h->lit[k] = h->whole[k] = 0;
        for (int i = 0; i <= block; i++)
            h->difference[i][k] = rgb_gray(0);
    }
    for (int k = 0; k < sample->control_count; k++) {
        const path_control *control = &sample->controls[k];
        h->difference[block][k] = rgb_add(h->difference[block][k], control->difference);
        h->lit[k] += control->lit;
        h->whole[k] += control->whole;
    }
}

static void add_told(estimate_half *h, const path_sample *sample) {
    for (int i = 0; i < IRRADIANCE_PARTS; i++)
        h->told[i] = rgb_add(h->cached ? h->told[i] : rgb_gray(0), sample->told[i]);
    h->cached = true;
}

estimate_luck estimate_half_take(estimate_half *h, estimate_sample *sample, void *user) {
    sampler points = sampler_start(h->key, h->taken);
    estimate_luck luck = ESTIMATE_NOISY;
    path_sample taken;
    sample(user, &points, &taken, &luck);
    int block = next_block(h);
    h->sum[block] = rgb_add(h->sum[block], taken.radiance);
    add_controls(h, block, &taken);
    h->integrated = h->integrated || taken.integrated;
    estimate_add_rare(&h->rare, &taken.rare);
    h->unmet = taken.unmet;
    if (taken.cached)
        add_told(h, &taken);
    h->known_error = rgb_add(h->known_error, taken.known_error);
    h->luck = luck > h->luck ? luck : h->luck;
    if (h->with_parts) {
        h->parts.indirect = rgb_add(h->parts.indirect, taken.indirect);
        h->parts.albedo = rgb_add(h->parts.albedo, taken.albedo);
    }
    h->taken++;
    return luck;
}

void estimate_half_take_until(estimate_half *h, uint32_t goal, estimate_sample *sample, void *user) {
    while (h->taken < goal)
        (void)estimate_half_take(h, sample, user);
}

void estimate_half_begin(estimate_half *h, uint64_t key, bool with_parts) {
    h->key = key;
    h->taken = 0;
    h->level = h->control_count = 0;
    h->rare = (path_rare){.times = 0};
    h->unmet = NULL;
    h->integrated = false;
    h->luck = ESTIMATE_EXACT;
    h->with_parts = with_parts;
    h->cached = false;
    h->known_error = rgb_gray(0);
    h->parts = (estimate_parts){{0, 0, 0}, {0, 0, 0}};
}
