/* The machine that runs code.h's instructions. */
#include "cal/evaluate.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "cal/code.h"

/* Where calls are left in code, this is there for their frames, and for places to go back to. */
enum { CALL_REGISTERS = 1 << 17, CALL_RETURNS = 1 << 15 };

typedef struct go_back {
    uint32_t at, frame, d;
} go_back;

typedef struct memory_head {
    const char *failure;
    cal_noise_memory noise;
} memory_head;

/* A register: a value, or where a parameter is computed. */
typedef union cell {
    double value;
    struct {
        uint32_t entry, frame; /* entry 0: it is known */
    } later;
    uint64_t flag;
} cell;

enum { FLAG_DONE = 1, FLAG_AT_IT = 2 };

static size_t size_of(const cal_code *code, size_t call_registers, size_t call_returns) {
    return sizeof(memory_head) + (code->units[0].frame_size + call_registers) * sizeof(cell) +
           (code->return_count + call_returns) * sizeof(go_back);
}

size_t cal_memory_size(const cal_code *code) {
    return code->unit_count > 1 ? size_of(code, CALL_REGISTERS, CALL_RETURNS) : size_of(code, 0, 0);
}

const char *cal_failure(const cal_code *code, const void *memory) {
    (void)code;
    return ((const memory_head *)memory)->failure;
}

static inline bool is_number(double x) {
    return fabs(x) <= DBL_MAX;
}

static void clear_flags(cell *frame, const cal_unit *unit) {
    for (uint32_t i = 0; i < unit->flag_count; i++)
        frame[unit->flags_begin + i].flag = 0;
}

/* The value of a function of the library: no number is a fault, and so is one that its arguments noted. */
#define FUNCTION_VALUE(expression)                                                                                     \
    do {                                                                                                               \
        double function_value = (expression);                                                                          \
        fault = fault && !i->fresh;                                                                                    \
        if (fault || !is_number(function_value)) {                                                                     \
            fault = true;                                                                                              \
            function_value = 0;                                                                                        \
        }                                                                                                              \
        r[i->d].value = function_value;                                                                                \
    } while (0)

/* All that an evaluation changes is in its memory and in its outputs. */
typedef struct machine {
    const cal_code *code;
    memory_head *head;
    cell *registers;
    go_back *returns;
    size_t register_count, return_count;
    uint32_t top, depth, calls;
} machine;

static cal_outcome fail(machine *m, const char *why) {
    m->head->failure = why;
    return CAL_FAILED;
}

static bool push(machine *m, uint32_t at, uint32_t frame, uint32_t d) {
    if (m->depth == m->return_count)
        return false;
    m->returns[m->depth++] = (go_back){at, frame, d};
    return true;
}

static const char *const too_deep = "the functions called call others too deeply";
static const char *const endless = "the functions called do not come to an end";
static const char *const circular = "a variable is defined by itself";

/* A frame for a call, with the arguments that follow the instruction; null where there is no room. */
static cell *new_frame(machine *m, const cal_instruction *call, const cell *r, uint32_t frame) {
    const cal_unit *unit = &m->code->units[call->a];
    if (m->top + unit->frame_size > m->register_count)
        return NULL;
    cell *fresh = m->registers + m->top;
    for (uint32_t k = 0; k < call->b; k++) {
        const cal_instruction *give = call + 1 + k;
        if (give->op == CAL_OP_GIVE_VALUE) {
            fresh[2 * k] = r[give->a];
            fresh[2 * k + 1].later.entry = 0;
        } else {
            fresh[2 * k + 1].later.entry = give->a;
            fresh[2 * k + 1].later.frame = frame;
        }
    }
    clear_flags(fresh, unit);
    m->top += unit->frame_size;
    return fresh;
}

static cal_outcome run(machine *m, const double *channels, double *outputs) {
    const cal_code *code = m->code;
    const cal_instruction *const instructions = code->instructions;
    const double *const k = code->constants;
    const cal_instruction *i = instructions + code->units[0].entry;
    cell *r = m->registers;
    bool fault = false, out_of_range = false;
    for (;; i++) {
        switch ((cal_op)i->op) {
        case CAL_OP_CONSTANT:
            r[i->d].value = k[i->b];
            break;
        case CAL_OP_CHANNEL:
            r[i->d].value = channels[i->a];
            break;
        case CAL_OP_MOVE:
            r[i->d] = r[i->a];
            break;
        case CAL_OP_ADD:
            r[i->d].value = r[i->a].value + r[i->b].value;
            break;
        case CAL_OP_ADD_CONSTANT:
            r[i->d].value = r[i->a].value + k[i->b];
            break;
        case CAL_OP_SUBTRACT:
            r[i->d].value = r[i->a].value - r[i->b].value;
            break;
        case CAL_OP_SUBTRACT_FROM:
            r[i->d].value = k[i->b] - r[i->a].value;
            break;
        case CAL_OP_MULTIPLY:
            r[i->d].value = r[i->a].value * r[i->b].value;
            break;
        case CAL_OP_MULTIPLY_CONSTANT:
            r[i->d].value = r[i->a].value * k[i->b];
            break;
        case CAL_OP_MULTIPLY_ADD:
            r[i->d].value = r[i->a].value * r[i->b].value + r[i->c].value;
            break;
        case CAL_OP_DIVIDE:
        case CAL_OP_DIVIDE_CONSTANT: {
            bool of_constant = i->op == CAL_OP_DIVIDE_CONSTANT;
            double numerator = of_constant ? k[i->b] : r[i->a].value;
            double denominator = r[of_constant ? i->a : i->b].value;
            fault = fault || denominator == 0;
            r[i->d].value = denominator == 0 ? 0 : numerator / denominator;
            break;
        }
        case CAL_OP_NEGATE:
            r[i->d].value = -r[i->a].value;
            break;
        case CAL_OP_FORGET:
            fault = false;
            break;
        case CAL_OP_CHECK:
            FUNCTION_VALUE(r[i->d].value);
            break;
        case CAL_OP_MINIMUM:
            r[i->d].value = r[i->b].value < r[i->a].value ? r[i->b].value : r[i->a].value;
            break;
        case CAL_OP_MAXIMUM:
            r[i->d].value = r[i->b].value > r[i->a].value ? r[i->b].value : r[i->a].value;
            break;
        case CAL_OP_FLOOR:
            FUNCTION_VALUE(floor(r[i->a].value));
            break;
        case CAL_OP_SQRT:
            FUNCTION_VALUE(sqrt(r[i->a].value));
            break;
        case CAL_OP_SQUARE:
            FUNCTION_VALUE(r[i->a].value * r[i->a].value);
            break;
        case CAL_OP_REAL_1:
            FUNCTION_VALUE(code->functions[i->b]->real_1(r[i->a].value));
            break;
        case CAL_OP_REAL_2:
            FUNCTION_VALUE(code->functions[i->c]->real_2(r[i->a].value, r[i->b].value));
            break;
        case CAL_OP_NOISE: {
            const double point[3] = {r[i->a].value, r[i->b].value, r[i->c].value};
            FUNCTION_VALUE(cal_noise((cal_noise_kind)i->extra, point, &m->head->noise));
            break;
        }
        case CAL_OP_ARGUMENT: {
            double n = floor(r[i->a].value + .5);
            if (n > code->real_count)
                return fail(m, code->messages[i->b]);
            FUNCTION_VALUE(n >= 1 ? code->reals[(size_t)n - 1] : n < 1 ? code->real_count : (double)NAN);
            break;
        }
        case CAL_OP_JUMP:
            i = instructions + i->d - 1;
            break;
        case CAL_OP_UNLESS_POSITIVE:
            if (!(r[i->a].value > 0))
                i = instructions + i->d - 1;
            break;
        case CAL_OP_UNLESS_ABOVE:
            if (!(r[i->a].value > r[i->b].value))
                i = instructions + i->d - 1;
            break;
        case CAL_OP_UNLESS_ABOVE_CONSTANT:
            if (!(r[i->a].value > k[i->b]))
                i = instructions + i->d - 1;
            break;
        case CAL_OP_UNLESS_BELOW_CONSTANT:
            if (!(r[i->a].value < k[i->b]))
                i = instructions + i->d - 1;
            break;
        case CAL_OP_IF_ZERO:
            if (r[i->a].value == 0) {
                fault = true;
                r[i->d].value = 0;
                i = instructions + i->b - 1;
            }
            break;
        case CAL_OP_SELECT: {
            double which = r[i->a].value + .5;
            fault = fault && !i->fresh;
            if (which >= 0 && which < 1) {
                r[i->d].value = i->b;
            } else if (which >= 1 && which < i->b + 1.) {
                i += (int)which;
            } else {
                fault = true;
                r[i->d].value = 0;
            }
            break;
        }
        case CAL_OP_ENTER:
            if (r[i->a].flag == FLAG_DONE) {
                i = instructions + i->d - 1;
                break;
            }
            if (r[i->a].flag == FLAG_AT_IT)
                return fail(m, circular);
            r[i->a].flag = FLAG_AT_IT;
            if (!push(m, i->d, (uint32_t)(r - m->registers), 0))
                return fail(m, too_deep);
            break;
        case CAL_OP_NEED:
        case CAL_OP_NEED_OF_MAIN: {
            cell *frame = i->op == CAL_OP_NEED ? r : m->registers;
            if (frame[i->a].flag == FLAG_DONE)
                break;
            if (frame[i->a].flag == FLAG_AT_IT)
                return fail(m, circular);
            frame[i->a].flag = FLAG_AT_IT;
            if (!push(m, (uint32_t)(i + 1 - instructions), (uint32_t)(r - m->registers), 0))
                return fail(m, too_deep);
            r = frame;
            i = instructions + i->d - 1;
            break;
        }
        case CAL_OP_DONE: {
            const go_back back = m->returns[--m->depth];
            r[i->a].flag = FLAG_DONE;
            r = m->registers + back.frame;
            i = instructions + back.at - 1;
            break;
        }
        case CAL_OP_OF_MAIN:
            r[i->d] = m->registers[i->a];
            break;
        case CAL_OP_CALL: {
            uint32_t frame = (uint32_t)(r - m->registers);
            cell *fresh = new_frame(m, i, r, frame);
            if (!fresh || !push(m, (uint32_t)(i + 1 + i->b - instructions), frame, frame + i->d))
                return fail(m, too_deep);
            if (++m->calls > CAL_CALLS_MOST)
                return fail(m, endless);
            r = fresh;
            i = instructions + code->units[i->a].entry - 1;
            break;
        }
        case CAL_OP_GIVE_VALUE:
        case CAL_OP_GIVE_LATER:
            break;
        case CAL_OP_NEED_PARAMETER: {
            cell *later = &r[i->a + 1];
            if (later->later.entry == 0)
                break;
            uint32_t frame = (uint32_t)(r - m->registers);
            if (!push(m, (uint32_t)(i + 1 - instructions), frame, frame + i->a))
                return fail(m, too_deep);
            i = instructions + later->later.entry - 1;
            r = m->registers + later->later.frame;
            break;
        }
        case CAL_OP_ANSWER: {
            const go_back back = m->returns[--m->depth];
            m->registers[back.d].value = r[i->a].value;
            m->registers[back.d + 1].later.entry = 0;
            r = m->registers + back.frame;
            i = instructions + back.at - 1;
            break;
        }
        case CAL_OP_RETURN: {
            const go_back back = m->returns[--m->depth];
            m->registers[back.d].value = r[i->a].value;
            m->top = (uint32_t)(r - m->registers);
            r = m->registers + back.frame;
            i = instructions + back.at - 1;
            break;
        }
        case CAL_OP_OUTPUT:
            outputs[i->d] = r[i->a].value;
            if (!is_number(outputs[i->d])) {
                outputs[i->d] = 0;
                out_of_range = true;
            }
            break;
        case CAL_OP_FAIL:
            return fail(m, code->messages[i->a]);
        case CAL_OP_END:
            return fault || out_of_range ? CAL_FAULT : CAL_FINE;
        }
    }
}

/* How many registers and places to go back to fit into the memory; false where the main code's own do not. */
static bool divide(machine *m, size_t size) {
    const cal_code *code = m->code;
    size_t needed = size_of(code, 0, 0);
    m->register_count = code->units[0].frame_size;
    m->return_count = code->return_count;
    if (size < needed)
        return false;
    if (code->unit_count == 1)
        return true;
    /* As many of one kind for one of the other as in the largest memory. */
    enum { FOR_ONE = CALL_REGISTERS / CALL_RETURNS };
    size_t returns = (size - needed) / (FOR_ONE * sizeof(cell) + sizeof(go_back));
    if (returns > CALL_RETURNS)
        returns = CALL_RETURNS;
    m->register_count += FOR_ONE * returns;
    m->return_count += returns;
    return true;
}

cal_outcome cal_evaluate_within(const cal_code *code, const double *channels, double *outputs, void *memory,
                                size_t size, bool *cramped) {
    memory_head *head = memory;
    cell *registers = (cell *)(head + 1);
    machine m = {.code = code, .head = head, .registers = registers, .top = code->units[0].frame_size};
    *cramped = !divide(&m, size);
    if (*cramped)
        return CAL_FAILED;
    m.returns = (go_back *)(registers + m.register_count);
    head->failure = NULL;
    head->noise.known = 0;
    clear_flags(registers, &code->units[0]);
    cal_outcome outcome = run(&m, channels, outputs);
    *cramped = outcome == CAL_FAILED && head->failure == too_deep && size < cal_memory_size(code);
    return outcome;
}

cal_outcome cal_evaluate(const cal_code *code, const double *channels, double *outputs, void *memory) {
    bool cramped;
    return cal_evaluate_within(code, channels, outputs, memory, cal_memory_size(code), &cramped);
}
