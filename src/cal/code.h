/* What is compiled: instructions over registers. Nothing in it changes; any number of threads run it at once. */
#ifndef CAL_CODE_H
#define CAL_CODE_H

#include <stdint.h>

#include "base/arena.h"
#include "cal/library.h"

/* d is the register written, a and b are those read, k an index of constants. Registers count from the frame's first,
 * in main code or in that of a function; t is an instruction to go on at.
 *
 * Functions of the library note a fault where their value is no number, or where one was noted while their arguments
 * were computed, and then have the value 0. They forget one that was noted before: those marked `fresh` themselves,
 * for others a CAL_OP_FORGET stands before the arguments. A division by 0 notes a fault too. So it is in Radiance. */
typedef enum cal_op {
    CAL_OP_CONSTANT, /* d = k */
    CAL_OP_CHANNEL,  /* d = channel a */
    CAL_OP_MOVE,     /* d = a */
    CAL_OP_ADD,
    CAL_OP_ADD_CONSTANT, /* d = a + k */
    CAL_OP_SUBTRACT,
    CAL_OP_SUBTRACT_FROM, /* d = k - a */
    CAL_OP_MULTIPLY,
    CAL_OP_MULTIPLY_CONSTANT,
    CAL_OP_MULTIPLY_ADD, /* d = a*b + c, rounded twice */
    CAL_OP_DIVIDE,
    CAL_OP_DIVIDE_CONSTANT, /* d = k/a */
    CAL_OP_NEGATE,
    CAL_OP_FORGET,
    CAL_OP_CHECK,   /* d is the value of a function of the library */
    CAL_OP_MINIMUM, /* d = b < a ? b : a */
    CAL_OP_MAXIMUM,
    CAL_OP_FLOOR,
    CAL_OP_SQRT,
    CAL_OP_SQUARE,
    CAL_OP_REAL_1,   /* d = functions[b](a) */
    CAL_OP_REAL_2,   /* d = functions[c](a, b) */
    CAL_OP_NOISE,    /* d = noise of the kind `extra` at (a, b, c) */
    CAL_OP_ARGUMENT, /* d = the real of number a; fails with message b */
    CAL_OP_JUMP,
    CAL_OP_UNLESS_POSITIVE,       /* to t = d unless a > 0 */
    CAL_OP_UNLESS_ABOVE,          /* to t = d unless a > b */
    CAL_OP_UNLESS_ABOVE_CONSTANT, /* to t = d unless a > k */
    CAL_OP_UNLESS_BELOW_CONSTANT, /* to t = d unless a < k */
    CAL_OP_IF_ZERO,               /* notes a fault, d = 0, to t = b if a is 0 */
    CAL_OP_SELECT,                /* to t = the d of the instruction that is a (from 1) behind this one; 0: d of this */
    /* What is computed at first need. A flag is a register: 0, or 1 when done, or 2 while at it. */
    CAL_OP_ENTER,        /* flag a: to t = d if done; else goes on, and CAL_OP_DONE goes to t */
    CAL_OP_NEED,         /* flag a: unless done, to t = d and back */
    CAL_OP_NEED_OF_MAIN, /* the same, of the main code's frame, flag a, from a function's */
    CAL_OP_DONE,         /* flag a */
    CAL_OP_OF_MAIN,      /* d = a of the main frame */
    /* Calls. Parameter i of a function is registers 2i, its value, and 2i + 1, where that is computed. */
    CAL_OP_CALL,           /* d = functions a with the arguments that follow, b of them */
    CAL_OP_GIVE_VALUE,     /* a */
    CAL_OP_GIVE_LATER,     /* what t = a computes in this frame, and ends with CAL_OP_ANSWER */
    CAL_OP_NEED_PARAMETER, /* a */
    CAL_OP_ANSWER,         /* a */
    CAL_OP_RETURN,         /* a */
    CAL_OP_OUTPUT,         /* output d is a */
    CAL_OP_FAIL,           /* with message a */
    CAL_OP_END
} cal_op;

typedef struct cal_instruction {
    uint16_t op;
    uint8_t fresh, extra;
    uint32_t d, a, b, c;
} cal_instruction;

typedef struct cal_unit {
    uint32_t entry, frame_size, flags_begin, flag_count;
} cal_unit;

struct cal_code {
    arena *memory;
    cal_instruction *instructions;
    double *constants;
    const cal_function **functions;
    const char **messages; /* with their places */
    const char *undefined; /* one of them, of a name that is not defined; or null */
    const double *reals;
    cal_unit *units; /* the main code, then functions that are called */
    uint32_t instruction_count, constant_count, function_count, message_count, real_count, unit_count;
    uint32_t output_count, return_count; /* places to go back to at once, where nothing is called */
    uint64_t channels;
};

#endif
