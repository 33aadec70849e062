/* Numbers of ASCII records, many at a time, on processors with AVX2. */
#include "base/record_words.h"

#ifdef __x86_64__
#include <immintrin.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/number.h"
#include "base/text.h"

/* In three steps: where words end, many bytes at a time; a row for each word; and from rows to numbers, four at a time.
 * Words follow each other at places that only the word before tells, and that, not arithmetic, is what number_scan
 * waits for; here it is known beforehand.
 *
 * A row is a number `[-]d.dd...` of up to 16 digits behind the point, by far the most common kind: whole + fraction /
 * power, rounded once where no more than 53 bits come together. What is of another kind is left to number_scan. */
#define AVX2        __attribute__((target("avx2,bmi,popcnt")))
#define AVX2_INLINE AVX2 static inline __attribute__((always_inline))

typedef uint8_t bytes16 __attribute__((vector_size(16)));
typedef uint8_t bytes32 __attribute__((vector_size(32)));
typedef uint64_t longs4 __attribute__((vector_size(32)));
typedef double doubles4 __attribute__((vector_size(32)));

enum { GROUP = 64, FRACTION_MAX = 16, ROWS_WANTED = 32, ROWS_MAX = ROWS_WANTED + GROUP / 2, ENDS_AT_ONCE = 8 };

/* --- Where words end --------------------------------------------------------------------------------------------- */

typedef struct word_finder {
    const char *at, *limit;
    uint64_t blank_before; /* 1 if the byte at[-1] is blank */
} word_finder;

AVX2_INLINE uint64_t find_blanks_32(const char *bytes) {
    bytes32 v;
    memcpy(&v, bytes, sizeof v);
    bytes32 blank = (bytes32)(v == ' ') | (bytes32)(v - '\t' <= '\r' - '\t');
    return (uint32_t)_mm256_movemask_epi8((__m256i)blank);
}

/* A bit for each of the next bytes, the first one lowest. Behind the limit all is blank. */
AVX2_INLINE uint64_t find_blanks(const word_finder *f) {
    const char *bytes = f->at;
    char copy[GROUP];
    if (f->limit - bytes < GROUP) {
        memset(copy, ' ', sizeof copy);
        memcpy(copy, bytes, (size_t)(f->limit - bytes));
        bytes = copy;
    }
    return find_blanks_32(bytes) | find_blanks_32(bytes + 32) << 32;
}

/* Finds ROWS_WANTED ends of words or a few more, or all there are, as offsets from `origin`. There may be any number in
 * a group: some are noted at once, needed or not, for no processor foresees the end of a loop over them. */
AVX2 static size_t find_ends(word_finder *f, const char *origin, size_t ends[ROWS_MAX + ENDS_AT_ONCE]) {
    size_t count = 0;
    for (; count < ROWS_WANTED && f->at < f->limit; f->at += GROUP) {
        size_t offset = (size_t)(f->at - origin);
        uint64_t blank = find_blanks(f), last = blank & ~(blank << 1 | f->blank_before);
        f->blank_before = blank >> 63;
        size_t next = count + (size_t)__builtin_popcountll(last);
        do {
#pragma GCC unroll 8
            for (size_t i = 0; i < ENDS_AT_ONCE; i++, last &= last - 1)
                ends[count + i] = offset + _tzcnt_u64(last);
            count += ENDS_AT_ONCE;
        } while (count < next);
        count = next;
    }
    return count;
}

/* --- Rows -------------------------------------------------------------------------------------------------------- */

typedef struct word_rows {
    _Alignas(32) bytes16 digits[ROWS_MAX]; /* of the fraction, their values; zeros before them */
    uint64_t whole[ROWS_MAX];              /* the digit before the point */
    double power[ROWS_MAX];                /* 10 to the number of the fraction's digits */
    uint64_t bits[ROWS_MAX];               /* of the result, beside those of the quotient: the sign's */
} word_rows;

static const double powers[FRACTION_MAX + 1] = {1e0, 1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7, 1e8,
                                                1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16};

/* From masks + n on, n of 16 bytes are let pass, at their end. */
static const uint8_t masks[2 * FRACTION_MAX] = {[16] = 255, 255, 255, 255, 255, 255, 255, 255,
                                                255,        255, 255, 255, 255, 255, 255, 255};

/* Not a number, unless the whole word is one. */
static double scan_word(const char *word, const char *end, const char *limit) {
    double value;
    return number_scan(word, limit, &value) == end ? value : (double)NAN;
}

static void set_row_to(word_rows *rows, size_t i, double value) {
    rows->digits[i] = (bytes16){0};
    rows->whole[i] = 0;
    rows->power[i] = 1;
    memcpy(&rows->bits[i], &value, sizeof value);
}

/* The fraction is what lies between point and end, whatever it is: it is looked at later. Here it only has to be of the
 * right length and without what looks like an exponent. */
AVX2_INLINE void set_row(word_rows *rows, size_t i, const char *word, const char *end, const char *limit) {
    uint64_t negative = *word == '-';
    const char *whole = word + negative;
    size_t length = (size_t)(end - whole) - 2;
    if (length - 1 < FRACTION_MAX && whole[1] == '.' && (end[-4] | 0x20) != 'e') {
        bytes16 digits, mask;
        memcpy(&digits, end - sizeof digits, sizeof digits);
        memcpy(&mask, masks + length, sizeof mask);
        rows->digits[i] = (digits - '0') & mask;
        rows->whole[i] = (uint8_t)(*whole - '0');
        rows->power[i] = powers[length];
        rows->bits[i] = negative << 63;
    } else {
        set_row_to(rows, i, scan_word(word, end, limit));
    }
}

/* --- Numbers ----------------------------------------------------------------------------------------------------- */

/* The 16 digits of four rows, as numbers of 8 each, the upper one in the lower half of a row's lane: neighbours join to
 * pairs, these to fours, and these to eights. Two rows a vector become four a vector, the second and third exchanged.
 */
AVX2_INLINE longs4 join_digits(__m256i first_two, __m256i last_two) {
    const __m256i tens = _mm256_set1_epi16(1 << 8 | 10), hundreds = _mm256_set1_epi32(1 << 16 | 100);
    const __m256i thousands = _mm256_set1_epi32(1 << 16 | 10000);
    __m256i a = _mm256_madd_epi16(_mm256_maddubs_epi16(first_two, tens), hundreds);
    __m256i b = _mm256_madd_epi16(_mm256_maddubs_epi16(last_two, tens), hundreds);
    __m256i eights = _mm256_madd_epi16(_mm256_packus_epi32(a, b), thousands);
    return (longs4)_mm256_permute4x64_epi64(eights, 0xd8);
}

/* Integers below 2^52. */
AVX2_INLINE doubles4 to_doubles(longs4 n) {
    return (doubles4)(n | 0x4330000000000000) - 0x1p52;
}

/* Four rows from the ith on. Where one is none, or its digits take more than 53 bits, the result is not a number. */
AVX2_INLINE longs4 divide_rows(const word_rows *rows, size_t i) {
    const __m256i nine = _mm256_set1_epi8(9);
    __m256i digits[2];
    longs4 whole, bits;
    doubles4 power;
    memcpy(&digits[0], &rows->digits[i], sizeof digits[0]);
    memcpy(&digits[1], &rows->digits[i + 2], sizeof digits[1]);
    memcpy(&whole, &rows->whole[i], sizeof whole);
    memcpy(&power, &rows->power[i], sizeof power);
    memcpy(&bits, &rows->bits[i], sizeof bits);
    __m256i others = _mm256_subs_epu8(_mm256_max_epu8(digits[0], digits[1]), nine);
    if (!_mm256_testz_si256(others, others))
        return (longs4){0} - 1;
    longs4 eights = join_digits(digits[0], digits[1]);
    doubles4 upper = to_doubles(eights & UINT32_MAX), lower = to_doubles(eights >> 32), first = to_doubles(whole);
    /* All of this is exact below 2^53, and what is not is not below it. */
    doubles4 mantissa = upper * 1e8 + lower + first * power;
    longs4 good = (longs4)(first <= 9) & (longs4)(mantissa < 0x1p53);
    return (longs4)(mantissa / power) | bits | ~good;
}

/* Whether all of the numbers are finite. A number times 0 is 0 if it is, and else NaN. */
AVX2 static bool divide_all_rows(const word_rows *rows, size_t count, double values[ROWS_MAX]) {
    longs4 found = {0};
    for (size_t i = 0; i < count; i += 4) {
        longs4 four = divide_rows(rows, i);
        found |= (longs4)((doubles4)four * 0 != 0);
        memcpy(values + i, &four, sizeof four);
    }
    return _mm256_testz_si256((__m256i)found, (__m256i)found);
}

/* The numbers that are not finite yet, once more, and carefully: gives how many good ones there are before one that
 * cannot be helped. */
static size_t mend(const char *text, const char *limit, const size_t *ends, size_t count, double *values) {
    size_t i = 0;
    for (; i < count; i++) {
        if (isfinite(values[i]))
            continue;
        const char *word = text + (i ? ends[i - 1] : 0);
        while (text_is_blank(*word))
            word++;
        values[i] = scan_word(word, text + ends[i], limit);
        if (!isfinite(values[i]))
            break;
    }
    return i;
}

AVX2 static size_t scan_block(const char *text, const char *limit, const size_t *ends, size_t count,
                              double values[ROWS_MAX]) {
    word_rows rows;
    const char *word = text;
    for (size_t i = 0; i < count; i++) {
        while ((uint8_t)*word <= ' ' && text_is_blank(*word))
            word++;
        set_row(&rows, i, word, text + ends[i], limit);
        word = text + ends[i] + 1;
    }
    for (size_t i = count; i % 4 != 0; i++)
        set_row_to(&rows, i, 0);
    return divide_all_rows(&rows, count, values) ? count : mend(text, limit, ends, count, values);
}

bool record_words_available(void) {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("popcnt");
}

size_t record_words_scan(const char **at, const char *limit, double *values, size_t count) {
    word_finder finder = {*at, limit, 1};
    size_t good = 0;
    while (good < count) {
        size_t ends[ROWS_MAX + ENDS_AT_ONCE];
        double numbers[ROWS_MAX];
        size_t found = find_ends(&finder, *at, ends);
        if (found > count - good)
            found = count - good;
        size_t scanned = scan_block(*at, limit, ends, found, numbers);
        memcpy(values + good, numbers, scanned * sizeof *values);
        good += scanned;
        if (scanned > 0)
            *at += ends[scanned - 1] + 1;
        if (scanned < found || found == 0)
            break;
    }
    while (good < count && text_is_blank(**at))
        ++*at;
    return good;
}

#else

bool record_words_available(void) {
    return false;
}

size_t record_words_scan(const char **at, const char *limit, double *values, size_t count) {
    (void)at;
    (void)limit;
    (void)values;
    (void)count;
    return 0;
}

#endif
