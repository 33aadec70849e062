/* The table of functions that exists once for each instruction set, and the choice of one.
 *
 * How values, densities, weights and samples are computed, from the public function down to the arithmetic:
 *
 * - entry_points.c: the functions of brdf.h and brdf_batch.h; roughness is brought into its range, then one call
 *   through the table. Float densities, weights and samples are those in double, a block at a time (widened_floats.c).
 * - dispatch.c: which table this processor can run.
 * - kernels_{baseline,avx2,avx512}.c: a table each, instruction_set.h compiled for that instruction set.
 * - {pair,sample,float}_loops.h: one element or arrays of them, the model made a constant by models.h.
 * - {pair,sample}_kernels.h: one element, without branches, out of double_double.h and elementary.h.
 * - out_of_range.c, out_of_range_mean_weight.c: the pairs that the kernels leave alone, one at a time; powers of two
 *   are taken out, and the same arithmetic serves.
 *
 * Whole lights (lobe_light.c) are integrals along outlines (outline.c), in parts (lobe_part.c), of a field
 * (lobe_field.h) that the table has as well: field_loops.h, by the rules of gauss.h. The diffuse term's
 * (diffuse_light.c) of a panel is there, too: panel_kernels.h.
 *
 * Integrals over all directions (albedo*.c, mean_albedo.c, over the slopes of slope_plane.c, by the rule of
 * quadrature.c) and the diffuse term (diffuse.c) are plain C and libm. */
#ifndef BRDF_KERNELS_H
#define BRDF_KERNELS_H

#include <stdbool.h>
#include <stddef.h>

#include "brdf/blocks.h"
#include "brdf/lobe_field.h"
#include "graze/brdf.h"
#include "graze/brdf_batch.h"

/* Pairs of directions to one number each, in double and single precision. */
typedef double brdf_scalar_function(const graze_brdf *, graze_vec3 l, graze_vec3 v);
typedef void brdf_batch_function(const graze_brdf *, size_t, graze_vec3_arrays l, graze_vec3_arrays v, double *);
typedef void brdf_float_batch_function(const graze_brdf *, size_t, graze_vec3_float_arrays l, graze_vec3_float_arrays v,
                                       float *);

/* Samplers: of Ward, and of pairs. */
typedef graze_brdf_sample brdf_sample_ward_function(const graze_brdf *, graze_vec3 v, double s, double t);
typedef graze_brdf_sample brdf_sample_pair_function(const graze_brdf *, graze_vec3 v, double s, double t, double u);
typedef void brdf_sample_ward_batch_function(const graze_brdf *, size_t, graze_vec3_arrays v, const double *s,
                                             const double *t, graze_brdf_sample_arrays);
typedef void brdf_sample_pair_batch_function(const graze_brdf *, size_t, graze_vec3_arrays v, const double *s,
                                             const double *t, const double *u, graze_brdf_sample_arrays);

/* Elements `start` to `start` + `length` of so many arrays into a block, and from one. */
typedef void brdf_widen_function(brdf_block *to, const float *const *from, int arrays, size_t start, size_t length);
typedef void brdf_narrow_function(float *const *to, const brdf_block *from, int arrays, size_t start, size_t length);

/* Part of an integral along an outline, BRDF_MOST_PIECES of it at most; lobe_field.h has what it is of. */
typedef double brdf_field_along_pieces_function(const brdf_lobe_field *, const brdf_piece *, int count);

/* Of a panel with four corners, as seen from a point of a surface with this normal, what Lambert's formula sums up.
 * False where a corner is not above the surface, or an edge spans more than the series of arc_tangent.h reaches. */
typedef bool brdf_panel_function(graze_vec3 point, graze_vec3 normal, const graze_vec3 *corners, double *sum);

/* Functions of brdf.h and brdf_batch.h, compiled for one instruction set. All tables give the same bits. */
typedef struct brdf_kernels {
    const char *name;
    brdf_scalar_function *value, *ward_density, *ward_weight, *pair_density, *pair_weight;
    brdf_batch_function *value_batch, *ward_density_batch, *ward_weight_batch, *pair_density_batch, *pair_weight_batch;
    brdf_float_batch_function *value_float_batch;
    brdf_sample_ward_function *sample_ward;
    brdf_sample_pair_function *sample_pair;
    brdf_sample_ward_batch_function *sample_ward_batch;
    brdf_sample_pair_batch_function *sample_pair_batch;
    brdf_widen_function *widen;
    brdf_narrow_function *narrow;
    brdf_field_along_pieces_function *field_along_pieces;
    brdf_panel_function *panel;
} brdf_kernels;

extern const brdf_kernels brdf_kernels_baseline;
#if defined(__x86_64__) && defined(__GNUC__)
#define BRDF_X86_64
extern const brdf_kernels brdf_kernels_avx2;   /* AVX2 and FMA */
extern const brdf_kernels brdf_kernels_avx512; /* AVX-512 F, DQ, VL, and FMA */
#endif

/* What the choice depends on: all false where the processor is not of the x86-64 kind. */
typedef struct brdf_processor {
    bool avx2, fma, avx512f, avx512dq, avx512vl;
} brdf_processor;

/* The best table that such a processor can run. */
const brdf_kernels *brdf_kernels_for(brdf_processor);

/* The best one for this processor. */
const brdf_kernels *brdf_kernels_best(void);

#endif
