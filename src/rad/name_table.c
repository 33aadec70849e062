/* A hash table of names. */
#include "rad/name_table.h"

#include <stdlib.h>
#include <string.h>

/* FNV-1a with a last mix, for the table looks at the low bits. */
static size_t hash(const char *name) {
    uint64_t h = 0xcbf29ce484222325u;
    for (; *name; ++name)
        h = (h ^ (unsigned char)*name) * 0x100000001b3u;
    return (size_t)(h ^ h >> 32);
}

/* Where the name stands, or would stand. */
static struct rad_name_slot *find_slot(const rad_name_table *table, const char *name) {
    size_t i = hash(name) & (table->capacity - 1);
    while (table->slots[i].name && strcmp(table->slots[i].name, name))
        i = (i + 1) & (table->capacity - 1);
    return &table->slots[i];
}

static bool grow_table(rad_name_table *table) {
    rad_name_table larger = {.capacity = table->capacity ? 2 * table->capacity : 256, .count = table->count};
    larger.slots = calloc(larger.capacity, sizeof *larger.slots);
    if (!larger.slots)
        return false;
    for (size_t i = 0; i < table->capacity; ++i)
        if (table->slots[i].name)
            *find_slot(&larger, table->slots[i].name) = table->slots[i];
    free(table->slots);
    *table = larger;
    return true;
}

bool rad_name_table_set(rad_name_table *table, const char *name, int32_t number) {
    if (2 * (table->count + 1) > table->capacity && !grow_table(table))
        return false;
    struct rad_name_slot *slot = find_slot(table, name);
    table->count += !slot->name;
    *slot = (struct rad_name_slot){name, number};
    return true;
}

bool rad_name_table_find(const rad_name_table *table, const char *name, int32_t *number) {
    const struct rad_name_slot *slot = table->capacity ? find_slot(table, name) : NULL;
    if (!slot || !slot->name)
        return false;
    *number = slot->number;
    return true;
}

void rad_name_table_free(rad_name_table *table) {
    free(table->slots);
    *table = (rad_name_table){0};
}
