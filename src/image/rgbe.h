/* Radiance's four-byte pixel: three mantissas of 8 bits with one exponent. */
#ifndef IMAGE_RGBE_H
#define IMAGE_RGBE_H

/* Mantissas are cut, not rounded, for a reader puts the half back. NaN and negative values become 0; what is too large
 * becomes the largest that the format holds; below 1e-32 all is black. */
void image_rgbe_encode(const float rgb[3], unsigned char rgbe[4]);
/* The middle of what the mantissas stand for, (m + 1/2) 2^(E - 136); 0 where E is 0. */
void image_rgbe_decode(const unsigned char rgbe[4], double rgb[3]);

#endif
