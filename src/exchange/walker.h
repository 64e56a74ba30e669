/* exchange/walker.h - what of a body matters for a walk: its legs, their length, where its feet
 * stand, what else it has; and texts of problem files made of it. */
#ifndef AMBULO_EXCHANGE_WALKER_H
#define AMBULO_EXCHANGE_WALKER_H

#include "ambulo/mechanics.h"
#include "ambulo/tools/import.h"
#include "base/text_buffer.h"

typedef enum ambulo__part_of_body {
  AMBULO__PART_REST = 0, /* arms, head, what is above the root */
  AMBULO__PART_ROOT,     /* between the world and where the legs part */
  AMBULO__PART_LEG
} ambulo__part_of_body;

typedef struct ambulo__walker {
  const ambulo_model *model;
  const char *file;           /* name of the model, as the problem names it */
  ambulo_allocator allocator; /* of the arrays */
  int count;                  /* coordinates */
  double *pose;               /* [count] the start pose, made symmetric where `symmetric` */
  ambulo__part_of_body *part; /* [count] */
  double *work;               /* [4 count] scratch */
  int feet, foot[4];          /* 2: left, right; 4: front left, front right, hind left, hind right:
                                 indices of the model's feet */
  double at[4][2];            /* m: those in the start pose, along forward and left */
  double leg;                 /* m: from the hip along the joints to the sole */
  double width;               /* m: between the feet */
  double mass, gravity;       /* kg, m/s^2 */
  int symmetric, planar;
  int rocks; /* legs of at most four joints: they cannot keep their feet flat */
  int has_torque_limits, has_speed_limits;
  double speed, step; /* m/s, m: of the walk */
} ambulo__walker;

/* Measures a body in its start pose. Errors, with a message: E_MODEL (not two feet, fixed to the
 * world, legs without joints), E_MEMORY. Free it in any case. */
ambulo_status ambulo__walker_measure(const ambulo_model *model, const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics, ambulo__walker *walker);
void ambulo__walker_free(ambulo__walker *walker); /* accepts a zero-filled one */

/* Slope of where a foot's heel centre is along `direction` by a coordinate, in the start pose. */
double ambulo__walker_slope(const ambulo__walker *walker, int foot, const double direction[3],
                            int coordinate);

/* ------------------------------------------------------------------- walk_text.c */

/* x with so many significant digits */
double ambulo__significant(double x, int digits);
void ambulo__walk_number(ambulo__text_buffer *text, double value); /* with four */

/* The line that names the model; in quotes where its name asks for them. */
void ambulo__walk_model(ambulo__text_buffer *text, const char *file);

/* A mapping of names to values in braces, in lines of at most 100 columns, `indent` spaces deep:
 * begin, an item each, end. */
typedef struct ambulo__walk_map {
  ambulo__text_buffer *text;
  int indent, column, items;
} ambulo__walk_map;
ambulo__walk_map ambulo__walk_map_begin(ambulo__text_buffer *text, int indent, const char *key);
void ambulo__walk_map_item(ambulo__walk_map *map, const char *name, const double *values,
                           int count);
void ambulo__walk_map_end(ambulo__walk_map *map);

/* ------------------------------------------------- walk_robot.c, walk_people.c */

void ambulo__walk_of_robot(const ambulo__walker *walker, ambulo__text_buffer *text);

/* A mapping of the coordinates of one part of the body to its start pose (walk_robot.c). */
void ambulo__walk_posture(const ambulo__walker *walker, ambulo__part_of_body part, const char *head,
                          ambulo__text_buffer *text);
/* Of sliders that are not the root's (`all`: of these too), in lengths of legs. */
void ambulo__walk_sliders(const ambulo__walker *walker, double scale, int all,
                          ambulo__text_buffer *text);

/* ------------------------------------------------------------- walk_quadruped.c */

/* "walk", "trot", "bound"; 0: no gait of four legs. */
int ambulo__is_gait_of_four(const char *name);
/* At walker->speed and with strides of walker->step, 0 of either: as the gait and the legs have it.
 */
void ambulo__walk_of_quadruped(const ambulo__walker *walker, const char *gait,
                               ambulo__text_buffer *text);

/* Whether coordinates and links have the names of OpenSim's models of people. */
int ambulo__walker_is_person(const ambulo__walker *walker);
/* By the weights of the problems in the folder `shipped`. Errors: as ambulo_problem_load. */
ambulo_status ambulo__walk_of_person(const ambulo__walker *walker, const char *shipped,
                                     ambulo_diagnostics *diagnostics, ambulo__text_buffer *text);

#endif
