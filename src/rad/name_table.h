/* Numbers by name. */
#ifndef RAD_NAME_TABLE_H
#define RAD_NAME_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Open addressing with linear probes, at most half full. All 0: empty. Names are not copied. */
typedef struct rad_name_table {
    struct rad_name_slot {
        const char *name; /* null: free */
        int32_t number;
    } * slots;
    size_t capacity, count; /* capacity: a power of two */
} rad_name_table;

/* Sets a name's number, in place of a former one. False when out of memory. */
bool rad_name_table_set(rad_name_table *, const char *name, int32_t number);
bool rad_name_table_find(const rad_name_table *, const char *name, int32_t *number);
void rad_name_table_free(rad_name_table *);

#endif
