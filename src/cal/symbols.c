/* A table of names, and the rules of contexts. */
#include "cal/symbols.h"

#include <string.h>

static unsigned hash(const char *name, size_t length, const char *context) {
    unsigned h = 2166136261u;
    for (size_t i = 0; i < length; i++)
        h = (h ^ (unsigned char)name[i]) * 16777619u;
    for (; *context; context++)
        h = (h ^ (unsigned char)*context) * 16777619u;
    return h % CAL_HASH_SIZE;
}

/* A name as written, taken apart. */
typedef struct written {
    const char *text;
    size_t length;
    bool own, outermost;
} written;

static written read_marks(const char *name) {
    written w = {name, strlen(name), false, false};
    if (w.length > 1 && w.text[0] == '`') {
        w.own = true;
        w.text++;
        w.length--;
    }
    if (w.length > 1 && w.text[w.length - 1] == '`') {
        w.outermost = true;
        w.own = false;
        w.length--;
    }
    return w;
}

static cal_symbol *find_in(const cal_symbols *s, const written *w, const char *context) {
    cal_symbol *symbol = s->table[hash(w->text, w->length, context)];
    while (symbol && (strncmp(symbol->name, w->text, w->length) != 0 || strcmp(symbol->name + w->length, context) != 0))
        symbol = symbol->next;
    return symbol;
}

static cal_symbol *add(cal_symbols *s, const written *w, const char *context) {
    size_t tail = strlen(context) + 1;
    cal_symbol *symbol = arena_allocate(s->memory, sizeof *symbol);
    char *name = arena_allocate(s->memory, w->length + tail);
    if (!symbol || !name)
        return NULL;
    memcpy(name, w->text, w->length);
    memcpy(name + w->length, context, tail);
    cal_symbol **slot = &s->table[hash(w->text, w->length, context)];
    *symbol = (cal_symbol){.name = name, .library = cal_library_find(name), .next = *slot};
    return *slot = symbol;
}

static const char *outer(const char *context) {
    size_t length = strcspn(context + 1, "`");
    return context + 1 + length;
}

cal_symbol *cal_symbols_find(cal_symbols *s, const char *context, const char *name) {
    written w = read_marks(name);
    if (w.outermost)
        return find_in(s, &w, "");
    for (;; context = outer(context)) {
        cal_symbol *symbol = find_in(s, &w, context);
        if (symbol || !*context || w.own)
            return symbol;
    }
}

cal_symbol *cal_symbols_use(cal_symbols *s, const char *context, const char *name) {
    cal_symbol *symbol = cal_symbols_find(s, context, name);
    written w = read_marks(name);
    if (symbol)
        return symbol;
    return add(s, &w, w.outermost || cal_library_find(name) ? "" : context);
}

cal_symbol *cal_symbols_define(cal_symbols *s, const char *context, const char *name) {
    written w = read_marks(name);
    if (w.outermost)
        context = "";
    cal_symbol *symbol = find_in(s, &w, context);
    return symbol ? symbol : add(s, &w, context);
}

static bool has_suffix(const char *file, size_t length) {
    const char *s = file + length - 4;
    return length > 4 && s[0] == '.' && (s[1] | 32) == 'c' && (s[2] | 32) == 'a' && (s[3] | 32) == 'l';
}

const char *cal_context_of_file(arena *memory, const char *file) {
    if (!file || strcmp(file, ".") == 0)
        return "";
    size_t length = strlen(file);
    if (has_suffix(file, length))
        length -= 4;
    while (length > 0 && *file == '`') {
        file++;
        length--;
    }
    char *context = arena_allocate(memory, length + 2);
    if (!context)
        return NULL;
    context[0] = '`';
    for (size_t i = 0; i < length; i++)
        context[i + 1] = cal_is_name_character(file[i]) ? file[i] : '_';
    while (context[length] == '`' && length > 0)
        length--;
    context[length ? length + 1 : 0] = 0;
    return context;
}
