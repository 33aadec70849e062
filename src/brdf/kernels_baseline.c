/* The functions for any processor: what the compiler makes of plain C. */
#define BRDF_TABLE      brdf_kernels_baseline
#define BRDF_TABLE_NAME "baseline"
#include "brdf/instruction_set.h"
