/* Shell pipelines taken apart, to find the xform commands that are done here. */
#include "rad/pipeline.h"

#include <stdbool.h>
#include <string.h>

typedef struct span {
    const char *begin, *end;
} span;

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

/* Passes a quoted piece or an escaped byte that begins at `p`; null where a quote has no end. */
static const char *pass_quoted(const char *p, const char *end) {
    if (*p == '\\')
        return p + 1 < end ? p + 2 : end;
    char quote = *p++;
    while (p < end && *p != quote)
        p += *p == '\\' && quote == '"' && p + 1 < end ? 2 : 1;
    return p < end ? p + 1 : NULL;
}

static bool is_quoting(char c) {
    return c == '\\' || c == '\'' || c == '"';
}

/* Whether double quotes hold something that the shell replaces. */
static bool is_inert(span piece) {
    if (*piece.begin != '"')
        return true;
    size_t length = (size_t)(piece.end - piece.begin);
    return !memchr(piece.begin, '$', length) && !memchr(piece.begin, '`', length);
}

static bool begins_word(const char *p, const char *text) {
    return p == text || is_blank(p[-1]) || p[-1] == '|';
}

/* Finds the pipes of the text. False where it is not clearly one single pipeline, so that a part of it cannot be taken
 * for one side of a pipe. */
static bool find_pipes(span text, const char **pipes, int *count) {
    *count = 0;
    for (const char *p = text.begin; p < text.end;) {
        if (is_quoting(*p)) {
            const char *next = pass_quoted(p, text.end);
            if (!next || !is_inert((span){p, next}))
                return false;
            p = next;
            continue;
        }
        if (strchr(";&()`\n", *p) || (*p == '$' && p + 1 < text.end && strchr("({'\"", p[1])))
            return false;
        if ((*p == '#' || *p == '!' || *p == '{') && begins_word(p, text.begin))
            return false;
        if (*p == '|') {
            bool is_other = (p + 1 < text.end && p[1] == '|') || (p > text.begin && p[-1] == '>');
            if (is_other)
                return false;
            pipes[(*count)++] = p;
        }
        ++p;
    }
    return true;
}

static bool is_all_blank(span text) {
    for (const char *p = text.begin; p < text.end; ++p)
        if (!is_blank(*p))
            return false;
    return true;
}

static const char *skip_blanks(const char *p, const char *end) {
    while (p < end && (is_blank(*p) || (*p == '\\' && p + 1 < end && p[1] == '\n')))
        p += *p == '\\' ? 2 : 1;
    return p;
}

/* Copies the word at *p, without its quotes, to `out`, and moves *p behind it. False where it needs the shell. */
static bool read_word(const char **p, const char *end, char **out) {
    const char *q = *p;
    if (*q == '~' || *q == '#')
        return false;
    while (q < end && !is_blank(*q)) {
        if (*q == '\\' && q + 1 < end && q[1] == '\n') {
            q += 2;
        } else if (*q == '\\') {
            if (q + 1 >= end)
                return false;
            *(*out)++ = q[1];
            q += 2;
        } else if (*q == '\'' || *q == '"') {
            const char *next = pass_quoted(q, end);
            if (!next || !is_inert((span){q, next}) || (*q == '"' && memchr(q, '\\', (size_t)(next - q))))
                return false;
            memcpy(*out, q + 1, (size_t)(next - q - 2));
            *out += next - q - 2;
            q = next;
        } else if (strchr("$`*?[]{}<>;&()!\n", *q)) {
            return false;
        } else {
            *(*out)++ = *q++;
        }
    }
    *(*out)++ = 0;
    *p = q;
    return true;
}

static bool is_xform(const char *program) {
    const char *slash = strrchr(program, '/');
    return !strcmp(slash ? slash + 1 : program, "xform");
}

/* The argument file of `-f -` comes from the pipe. */
static bool reads_arguments_from_input(const rad_stage *stage) {
    for (int i = 2; i < stage->count; ++i)
        if (!strcmp(stage->words[i - 1], "-f") && !strcmp(stage->words[i], "-"))
            return true;
    return false;
}

/* Puts the text's words into *stage if they are a simple xform; *simple tells. False when out of memory. */
static bool read_stage(rad_stage *stage, span text, bool *simple, arena *memory) {
    size_t length = (size_t)(text.end - text.begin);
    char *out = arena_allocate(memory, length + 1);
    const char **words = arena_allocate(memory, (length / 2 + 1) * sizeof *words);
    if (!out || !words)
        return false;
    *stage = (rad_stage){words, 0};
    *simple = false;
    for (const char *p = skip_blanks(text.begin, text.end); p < text.end; p = skip_blanks(p, text.end)) {
        words[stage->count++] = out;
        if (!read_word(&p, text.end, &out))
            return true;
        if (stage->count == 1 && !is_xform(words[0]))
            return true;
    }
    *simple = stage->count > 0;
    return true;
}

static size_t count_bars(const char *p) {
    size_t count = 0;
    for (; *p; ++p)
        count += *p == '|';
    return count;
}

bool rad_pipeline_split(rad_pipeline *pipeline, const char *command, arena *memory) {
    *pipeline = (rad_pipeline){.front = command};
    span rest = {command, command + strlen(command)};
    size_t most = count_bars(command) + 1;
    const char **pipes = arena_allocate(memory, most * sizeof *pipes);
    rad_stage *stages = arena_allocate(memory, most * sizeof *stages);
    if (!pipes || !stages)
        return false;
    int pipe_count;
    if (!find_pipes(rest, pipes, &pipe_count))
        return true;
    int first = pipe_count + 1; /* of the stages that are ours; they are found from the last one on */
    while (first > 0) {
        const char *begin = first > 1 ? pipes[first - 2] + 1 : command;
        bool simple;
        if (!read_stage(&stages[first - 1], (span){begin, rest.end}, &simple, memory))
            return false;
        if (!simple)
            break;
        --first;
        rest.end = first > 0 ? pipes[first - 1] : command;
        /* What comes before it is for the shell: it gives words, no scene. */
        pipeline->front_is_options = reads_arguments_from_input(&stages[first]);
        if (pipeline->front_is_options)
            break;
    }
    if (first > pipe_count || (first > 0 && is_all_blank(rest)))
        return true;
    pipeline->stages = stages + first;
    pipeline->stage_count = pipe_count + 1 - first;
    pipeline->front = NULL;
    if (first > 0)
        pipeline->front = arena_copy_text(memory, rest.begin, (size_t)(rest.end - rest.begin));
    return first == 0 || pipeline->front;
}
