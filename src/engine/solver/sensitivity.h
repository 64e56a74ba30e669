/* solver/sensitivity.h - the numbers of a problem: where each stands, what it is called, and the
 * derivative of the best objective with it.
 *
 * parameters.c has the list of numbers and the variant in which they are moved, variant_muscles.c
 * its muscles; numbers_walk.c, numbers_body.c, numbers_muscles.c and numbers_task.c fill it;
 * differences.c finds the derivatives; sensitivities.c puts them in words.
 */
#ifndef AMBULO_SOLVER_SENSITIVITY_H
#define AMBULO_SOLVER_SENSITIVITY_H

#include "ambulo/sensitivity.h"
#include "problem/members.h"
#include "problem/nlp.h"

/* ----------------------------------------------------------------- variant */

/* A problem's definition with numbers moved, and the problem that it makes.
 *
 * Numbers are moved where they stand: in a deep copy of the definition, in the limits of the model,
 * in what the body weighs, how tall it is and what it climbs, in the rule of the gait. The rest
 * follows as it does for a file read with those numbers: contacts, duration and travel of a gait
 * (contact/schedule.h), the model (model/conditions.h), what is written for another body
 * (problem/definition.h). A variant without a moved number makes the problem it came from.
 */

/* Of the body, beside its limits. */
typedef struct ambulo__body_numbers {
  double mass, stature;            /* kg without loads, m */
  double slope;                    /* rad */
  double load[AMBULO__MOST_LOADS]; /* kg, of ambulo_model.loads */
} ambulo__body_numbers;

typedef struct ambulo__variant {
  ambulo_allocator allocator;
  const ambulo_problem *origin;
  ambulo_problem_definition definition; /* a copy, whose arrays may be written to */
  ambulo_coordinate *coordinates;       /* [d] likewise: limits and drives count */
  ambulo_muscle *muscles; /* [count] likewise: force, fiber, tendon; NULL: there are none */
  ambulo__body_numbers body;
  ambulo__gait_rule rule;
} ambulo__variant;

/* Of a problem, which must outlive it. E_MEMORY leaves what can be cleared. */
ambulo_status ambulo__variant_init(const ambulo_problem *problem, const ambulo_allocator *allocator,
                                   ambulo__variant *variant);

/* An array of the copy, which the definition has as const, to be written to. */
static inline void *ambulo__variant_own(const void *array) {
  union {
    const void *view;
    void *array;
  } of = {array};
  return of.array;
}

/* The problem as it stands now. Checked, it owns its model and outlives all else; not checked, it
 * may share the model, and numbers may be beyond the ranges of members a little: for differences.
 * Errors: as ambulo_problem_create. */
ambulo_status ambulo__variant_problem(const ambulo__variant *variant,
                                      ambulo_diagnostics *diagnostics, int checked,
                                      ambulo_problem **problem);

/* variant_muscles.c: the copy of their numbers. E_MEMORY. */
ambulo_status ambulo__variant_take_muscles(ambulo__variant *variant);
/* The muscles as they stand now, of a body like `model`, which must outlive them; NULL: there are
 * none. Errors: as ambulo_muscles_create. */
ambulo_status ambulo__variant_muscles(const ambulo__variant *variant, const ambulo_model *model,
                                      ambulo_diagnostics *diagnostics, ambulo_muscles **muscles);
/* A term of the variant, times its weight, at the channels of a workspace of the origin; NaN: there
 * are no such muscles. E_MEMORY. */
ambulo_status ambulo__variant_term_value(const ambulo__variant *variant,
                                         ambulo_workspace *workspace, const ambulo_term *term,
                                         double *value);

/* ----------------------------------------------------------------- numbers */

enum { AMBULO__PARAMETER_TEXT = 320 };

/* What a label ends with when the other side's number moves along. */
#define AMBULO__BOTH_OF_A_PAIR " (both sides)"

/* A place in the variant that has the number's value, or its opposite. */
typedef struct ambulo__address {
  double *at, sign;
} ambulo__address;

/* What the Lagrangian depends on a number through. */
typedef enum ambulo__enters {
  AMBULO__ENTERS_ALL,
  AMBULO__ENTERS_TERM,  /* one term of the objective alone, at the same channels */
  AMBULO__ENTERS_LIMITS /* bounds of rows; those of torque also as strength in the objective */
} ambulo__enters;

typedef struct ambulo__parameter {
  char name[AMBULO__PARAMETER_TEXT];     /* "gait.step_length" */
  char label[AMBULO__PARAMETER_TEXT];    /* "step length" */
  char with[4 * AMBULO__PARAMETER_TEXT]; /* those that move by with_sign as much, "a, b"; "" */
  double with_sign;
  char words[3 * AMBULO__PARAMETER_TEXT];
  ambulo__quantity quantity;
  double value, derivative, step; /* SI, rad; step: a change that a person can picture */
  double error;                   /* of the derivative; NaN: not known */
  double travel;                  /* d/dp of the definition's travel, m */
  double share;                   /* of f*, by one step; NaN where f* is not positive */
  int order;                      /* before sorting */
  double low, high;               /* what a file may say, SI, rad */
  double size; /* what a file's number is multiplied by where it is written for another body */
  int address, addresses; /* first of the list's, and how many */
  ambulo__enters enters;
  int term;         /* of AMBULO__ENTERS_TERM */
  int moves_events; /* nodes, or what is active at one, go along: where it may have no derivative */
} ambulo__parameter;

typedef struct ambulo__parameters {
  ambulo_allocator allocator;
  const ambulo_problem *problem;
  ambulo__variant variant;
  ambulo__parameter *list;
  int count, capacity;
  ambulo__address *address;
  int addresses, address_capacity;
  ambulo__parameter next; /* enters, term and moves_events of those added from now on */
  int failed;             /* sticky: memory ran out */
} ambulo__parameters;

/* Every number that the problem's file has, or could have, a key for; derivatives are 0. To be
 * cleared also on failure. E_MEMORY. */
ambulo_status ambulo__parameters_init(const ambulo_problem *problem,
                                      const ambulo_allocator *allocator,
                                      ambulo__parameters *parameters);
void ambulo__parameters_clear(ambulo__parameters *parameters);
/* NULL: there is none of that name. */
ambulo__parameter *ambulo__parameters_find(const ambulo__parameters *parameters, const char *name);

/* Adds one that stands at `at`; `label` and the name's format are for people. */
void ambulo__parameter_add(ambulo__parameters *parameters, ambulo__quantity quantity, double *at,
                           const char *label, const char *name, ...);
/* The one added last stands at `at` as well, `sign` times: without a name of its own; or under one
 * (with more than one always the same sign). Without room for so many names it is dropped. */
void ambulo__parameter_place(ambulo__parameters *parameters, double sign, double *at);
void ambulo__parameter_with(ambulo__parameters *parameters, double sign, double *at,
                            const char *name, ...);
/* ... is `size` times a file's number, where that is written for another body. */
void ambulo__parameter_sized(ambulo__parameters *parameters, double size);
/* ... stays within, in a file. */
void ambulo__parameter_within(ambulo__parameters *parameters, double low, double high);
/* The label of number k of a member, and of what. */
void ambulo__member_label(const ambulo__member *member, int k, const char *of,
                          char text[AMBULO__PARAMETER_TEXT]);
/* 1: number k of a member of `item` has no key in this problem. */
typedef int ambulo__idle_number(const ambulo__parameters *parameters, const void *item,
                                const ambulo__member *member, int k);
/* Adds the numbers of `item`, which belongs to the variant, that its table has labels for: `path`
 * stands before their keys, `of` behind their labels. Numbers that are off or infinite have none.
 */
void ambulo__parameters_of_members(ambulo__parameters *parameters,
                                   const ambulo__structure *structure, void *item, const char *path,
                                   const char *of, ambulo__idle_number *idle);
/* With mirrored ends left and right have to stay alike: the coordinate whose numbers move together
 * with those of i (i itself, if it is its own image turned round), *sign times; -1: none has to. */
int ambulo__parameter_partner(const ambulo_problem *problem, int i, double *sign);
/* SI and rad per unit that the problem's file has for it, 1 of a problem made from C; 0: an angle,
 * and the file does not state its unit. */
double ambulo__parameter_unit(const ambulo_problem *problem, const ambulo__parameter *parameter);

/* The pieces: gait, contacts, duration, travel; body, its limits, muscles, devices, what hands
 * hold; terms, constraints, ground, obstacles. */
void ambulo__parameters_of_walk(ambulo__parameters *parameters);
void ambulo__parameters_of_body(ambulo__parameters *parameters);
void ambulo__parameters_of_limits(ambulo__parameters *parameters);
void ambulo__parameters_of_muscles(ambulo__parameters *parameters);
void ambulo__parameters_of_devices(ambulo__parameters *parameters);
void ambulo__parameters_of_holds(ambulo__parameters *parameters);
void ambulo__parameters_of_terms(ambulo__parameters *parameters);
void ambulo__parameters_of_task(ambulo__parameters *parameters);

/* Sets one to a value, in the variant. */
void ambulo__parameter_set(ambulo__parameters *parameters, const ambulo__parameter *parameter,
                           double value);

/* differences.c: derivative and travel of each at a point with its multipliers; the point need not
 * be optimal: then they are those of the Lagrangian. Those that have none are taken out, and limits
 * that the motion does not touch. E_MEMORY; E_NUMERIC if the point has no finite values. */
ambulo_status ambulo__parameters_differ(ambulo__parameters *parameters, const double *x,
                                        const double *multiplier);
/* *smooth 0: it has none, whatever the motion. E_MEMORY. */
ambulo_status ambulo__parameter_is_smooth(ambulo__parameters *parameters,
                                          const ambulo__parameter *parameter, int *smooth);

/* ambulo_sensitivities of a point that may not be optimal: as good as it is, without errors; of the
 * numbers of these names alone (NULL: of all). */
ambulo_status ambulo__sensitivities_nearly(const ambulo_problem *problem,
                                           const ambulo_result *result, const char *const *names,
                                           int count, const ambulo_allocator *allocator,
                                           ambulo_sensitivity_list **list);

/* parameters.c: the change that a person can picture, in unit, and in words. */
double ambulo__parameter_step(const ambulo__parameter *parameter);
const char *ambulo__parameter_more(const ambulo__parameter *parameter);

#endif
