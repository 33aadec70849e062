/* Numbers that more than one file needs. */
#ifndef BRDF_CONSTANTS_H
#define BRDF_CONSTANTS_H

/* pi to 106 bits; the upper half is pi in double precision, and 2 and 4 times it and its half are exact. */
static const double brdf_pi = 0x1.921fb54442d18p+1, brdf_pi_low = 0x1.1a62633145c07p-53;

/* log 2; the upper half has 40 bits, so that n times it is exact for |n| < 2^13. */
static const double brdf_ln2_hi = 0x1.62e42fefa2p-1, brdf_ln2_lo = 0x1.9ef35793c7673p-41;

/* Slopes of more than so many times the roughness are nothing to a mean: exp(-5.25^2) is 1e-12. */
static const double brdf_farthest_slope = 5.25;

#endif
