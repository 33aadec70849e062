/* What kernels_baseline.c, kernels_avx2.c and kernels_avx512.c have in common: all functions, compiled for the
 * instruction set that is in force where this is included, and the table of them. The macro BRDF_FMA says that fma() is
 * one fast instruction there; double_double.h has what uses it. kernels.h has the map. */
#include "brdf/field_loops.h"
#include "brdf/float_conversion.h"
#include "brdf/float_loops.h"
#include "brdf/kernels.h"
#include "brdf/pair_loops.h"
#include "brdf/panel_kernels.h"
#include "brdf/sample_loops.h"

const brdf_kernels BRDF_TABLE = {
    .name = BRDF_TABLE_NAME,
    .value = value,
    .ward_density = ward_density,
    .ward_weight = ward_weight,
    .pair_density = pair_density,
    .pair_weight = pair_weight,
    .value_batch = value_batch,
    .ward_density_batch = ward_density_batch,
    .ward_weight_batch = ward_weight_batch,
    .pair_density_batch = pair_density_batch,
    .pair_weight_batch = pair_weight_batch,
    .value_float_batch = value_float_batch,
    .sample_ward = sample_ward,
    .sample_pair = sample_pair,
    .sample_ward_batch = sample_ward_batch,
    .sample_pair_batch = sample_pair_batch,
    .widen = widen,
    .narrow = narrow,
    .field_along_pieces = field_along_pieces,
    .panel = panel,
};
