/* solver/sensitivity_parameters.h - the numbers of a problem under the names that a file has for
 * them. */
#ifndef AMBULO_SOLVER_SENSITIVITY_PARAMETERS_H
#define AMBULO_SOLVER_SENSITIVITY_PARAMETERS_H

#include "ambulo/sensitivity.h"
#include "problem/members.h"
#include "solver/partials.h"

enum { AMBULO__PARAMETER_TEXT = 320 };

/* What a label ends with when the other side's number moves along. */
#define AMBULO__BOTH_OF_A_PAIR " (both sides)"

typedef struct ambulo__parameter {
  char name[AMBULO__PARAMETER_TEXT];     /* "gait.step_length" */
  char label[AMBULO__PARAMETER_TEXT];    /* "step length" */
  char with[4 * AMBULO__PARAMETER_TEXT]; /* those that move by with_sign as much, "a, b"; "" */
  double with_sign;
  char words[3 * AMBULO__PARAMETER_TEXT];
  ambulo__quantity quantity;
  double value, derivative, step; /* SI, rad; step after ambulo__parameters_say */
  double travel;                  /* d/dp of the definition's travel, m */
  double share;                   /* of f*, by one step; NaN where f* is not positive */
  int order;                      /* before sorting */
} ambulo__parameter;

typedef struct ambulo__parameters {
  ambulo_allocator allocator;
  const ambulo_problem *problem;
  const ambulo__partials *partials;
  ambulo__parameter *list;
  int count, capacity;
  int failed; /* sticky: memory ran out */
  int all;    /* 1: also limits that the motion does not touch */
} ambulo__parameters;

/* Adds one; `label` and the name's format are for people. */
void ambulo__parameter_add(ambulo__parameters *parameters, ambulo__quantity quantity, double value,
                           double derivative, const char *label, const char *name, ...);

/* The one added last moves along with another, `sign` times; with more than one always the same.
 * Without room for so many names it is dropped. */
void ambulo__parameter_with(ambulo__parameters *parameters, double sign, const char *name, ...);
/* ... moves the travel by `travel` per unit. */
void ambulo__parameter_travels(ambulo__parameters *parameters, double travel);
/* With mirrored ends left and right have to stay alike: the coordinate whose numbers move together
 * with those of i (i itself, if it is its own image turned round), *sign times; -1: none has to. */
int ambulo__parameter_partner(const ambulo_problem *problem, int i, double *sign);

/* Every number of the problem, with df*_dp; E_MEMORY leaves what ambulo__free of the list frees. */
ambulo_status ambulo__parameters_collect(ambulo__parameters *parameters);
/* The same without a solution: names, values and quantities, derivatives 0; limits that no motion
 * has touched are among them. */
ambulo_status ambulo__parameters_name(ambulo__parameters *parameters);
/* SI and rad per unit that the problem's file has for it; 0: its unit of angle is not stated. */
double ambulo__parameter_unit(const ambulo_problem *problem, const ambulo__parameter *parameter);
/* The pieces: lengths, times, speed, travel; margins, obstacles, reaches; footholds of listed
 * contacts; their events; devices; what hands hold; terms of the objective. */
void ambulo__parameters_of_walk(ambulo__parameters *parameters);
void ambulo__parameters_of_bodies(ambulo__parameters *parameters);
void ambulo__parameters_of_footholds(ambulo__parameters *parameters);
/* 1 if the motion repeats and a listed foothold at its end is one at its begin that has travelled.
 */
int ambulo__footholds_meet(const ambulo_problem_definition *definition);
void ambulo__parameters_of_events(ambulo__parameters *parameters);
/* dL/dv through phases that are functions of the speed v; 0: none is; NaN: they have none. */
double ambulo__phases_by_speed(const ambulo__parameters *parameters);
void ambulo__parameters_of_devices(ambulo__parameters *parameters);
void ambulo__parameters_of_holds(ambulo__parameters *parameters);
void ambulo__parameters_of_terms(ambulo__parameters *parameters);

/* ambulo_sensitivities of a point that may not be optimal: as good as it is. */
ambulo_status ambulo__sensitivities_nearly(const ambulo_problem *problem,
                                           const ambulo_result *result,
                                           const ambulo_allocator *allocator,
                                           ambulo_sensitivity_list **list);

/* Steps, shares and words; the largest share comes first. */
void ambulo__parameters_say(ambulo__parameters *parameters, double objective);

#endif
