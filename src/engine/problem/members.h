/* problem/members.h - the members of a problem's definition and of the solver's options: one row of
 * a table says all about one.
 *
 * Loops over the tables set defaults, check ranges, copy and free definitions, take those of older
 * headers, make the hash (definition.h), read problem files (definitions/problem_reader.h), and
 * name the numbers that have sensitivities. A new member is a row here, and whatever rows or terms
 * of the motion look at it.
 */
#ifndef AMBULO_PROBLEM_MEMBERS_H
#define AMBULO_PROBLEM_MEMBERS_H

#include "ambulo/problem.h"
#include "ambulo/solve.h"

/* What a number is, which decides on its unit and on the change that a person can picture. */
typedef enum ambulo__quantity {
  AMBULO__STEP_LENGTH,   /* m: 1 cm */
  AMBULO__SHORT_LENGTH,  /* m: 1 mm, of tolerances */
  AMBULO__ANGLE,         /* rad: 1 degree */
  AMBULO__SMALL_ANGLE,   /* rad: 0.1 degrees, of tolerances */
  AMBULO__TIME,          /* s: 10 ms */
  AMBULO__SPEED,         /* m/s: 0.1 */
  AMBULO__TURNING_SPEED, /* rad/s: 0.1 */
  AMBULO__MASS,          /* kg: 1 */
  AMBULO__TORQUE,        /* N m: 1 */
  AMBULO__FORCE,         /* N: 10 */
  AMBULO__BODY_WEIGHT,   /* body weights: 0.01 */
  AMBULO__TURNING_JOLT,  /* rad/s^2: 1 */
  AMBULO__JOLT,          /* m/s^2: 0.1 */
  AMBULO__LOADING_RATE,  /* body weights/s: 1 */
  AMBULO__STRIDE_SHARE,  /* 1 % of the stride, of an event */
  AMBULO__EVENT_TIME,    /* s: 10 ms, of an event */
  AMBULO__TURNING_STIFF, /* N m/rad: 1, of a spring that has none yet */
  AMBULO__STIFF,         /* N/m: 10 */
  AMBULO__RATIO,         /* any: 1 % of the value */
  AMBULO__BYTES          /* of memory */
} ambulo__quantity;
const char *ambulo__quantity_unit(ambulo__quantity quantity); /* "m", "" */

typedef enum ambulo__member_type {
  AMBULO__NUMBER,       /* double[count] */
  AMBULO__FILE_ANGLE,   /* the same, in files in their unit of angle */
  AMBULO__INTEGER,      /* int[count] */
  AMBULO__FLAG,         /* int: true, false; with words, every second of them is true */
  AMBULO__CHOICE,       /* an enumeration: one of `words` */
  AMBULO__INDEX,        /* int[count]: of something of the model, -1: of nothing */
  AMBULO__TEXT,         /* const char * */
  AMBULO__NUMBER_ARRAY, /* const double *, [length][count] */
  AMBULO__INDEX_ARRAY,  /* const int *, [length] */
  AMBULO__ITEMS,        /* structures, [length] */
  AMBULO__PART,         /* a structure by value */
  AMBULO__BORROWED      /* a pointer to what is the caller's */
} ambulo__member_type;

/* Lengths of arrays. */
typedef enum ambulo__extent {
  AMBULO__COUNTED,         /* an int at count_at of the same structure */
  AMBULO__EACH_COORDINATE, /* of the model */
  AMBULO__EACH_NODE,
  AMBULO__EACH_KNOT,
  AMBULO__EACH_DEVICE,
  AMBULO__EACH_FOOT,
  AMBULO__EACH_NODE_COORDINATE,
  AMBULO__EACH_NODE_COUNTED, /* of each node as many as count_at says */
  AMBULO__EACH_NODE_FOOT,
  AMBULO__EACH_SAMPLE_COORDINATE /* samples at count_at */
} ambulo__extent;

enum { AMBULO__MOST_INTERVALS = 100000 };

enum {
  AMBULO__MAY_BE_OFF = 1,           /* AMBULO_OFF, in files `off` */
  AMBULO__MAY_BE_INFINITE = 1 << 1, /* in C */
  AMBULO__EXACT_RANGE = 1 << 2,     /* the range holds in C as well (ambulo__member_range) */
  AMBULO__REQUIRED = 1 << 3,        /* in files */
  AMBULO__RISING = 1 << 4,          /* two numbers, the first below the second */
  AMBULO__READ_APART = 1 << 5,      /* from files by code of its own, not by the loop */
  AMBULO__BODY_LENGTH = 1 << 6,     /* as large as the body is long (problem/definition.h) */
  AMBULO__NOT_COPIED = 1 << 7,      /* a text that the problem does not own */
  AMBULO__NOT_HASHED = 1 << 8       /* the problem's name: two files that say the same are one */
};

typedef struct ambulo__structure ambulo__structure;

typedef struct ambulo__member {
  const char *key; /* its place in a file, below that of the structure: "zmp_margin"; NULL: none */
  size_t at;       /* its place in the structure */
  ambulo__member_type type;
  int count;        /* numbers or indices in a row; of an array for each of its length */
  double low, high; /* what a file may say */
  double usual[2];  /* default; all behind the second as the second */
  int flags;        /* AMBULO__MAY_BE_OFF | ... */
  ambulo__quantity quantity;
  const char *label; /* for people, of each number by itself "first|second"; NULL: not a number
                        that moves smoothly */
  int of_kinds;      /* of ambulo_term: kinds that have it (AMBULO__TERM_...); 0: all */
  const char *const *words; /* [word_count] of a choice; the first stands for first_word */
  int word_count, first_word;
  ambulo__extent extent;       /* of an array or items */
  size_t count_at;             /* of the int that counts, in the same structure */
  size_t size_at;              /* of the size of items or parts, in the definition */
  const ambulo__structure *of; /* items or parts */
} ambulo__member;

struct ambulo__structure {
  const char *key; /* of items and parts, in a file */
  size_t size;
  const ambulo__member *members;
  int count;
};

extern const ambulo__structure ambulo__definition_members, ambulo__clearance_members,
    ambulo__ground_reaction_members, ambulo__collision_members, ambulo__contact_members,
    ambulo__end_value_members, ambulo__tube_members, ambulo__obstacle_members,
    ambulo__reach_members, ambulo__device_members, ambulo__hold_members, ambulo__term_members,
    ambulo__user_row_members, ambulo__capsule_pair_members, ambulo__options_members;

/* How many items, or rows of numbers, an array has; `item` is what it is a member of. */
size_t ambulo__member_length(const ambulo__member *member,
                             const ambulo_problem_definition *definition, const void *item);
/* What stands in an array member; NULL: nothing. */
const void *ambulo__member_array(const ambulo__member *member, const void *item);
/* The range in C: a thousand times wider than that of files, on either side of 0. */
void ambulo__member_range(const ambulo__member *member, double range[2]);
/* Sets an item to its defaults; nothing that belongs to it is freed. */
void ambulo__members_fill(const ambulo__structure *structure, void *item);

#endif
