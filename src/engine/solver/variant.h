/* solver/variant.h - a problem's definition with numbers moved, and the problem that it makes.
 *
 * Numbers are moved where they stand: in a deep copy of the definition, in the limits of the model,
 * in what the body weighs, how tall it is and what it climbs, in the rule of the gait. The rest
 * follows as it does for a file read with those numbers: contacts, duration and travel of a gait
 * (contact/schedule.h), the model (model/conditions.h), what is written for another body
 * (problem/resize.h). A variant without a moved number makes the problem it came from.
 */
#ifndef AMBULO_SOLVER_VARIANT_H
#define AMBULO_SOLVER_VARIANT_H

#include "problem/nlp.h"

/* Of the body, beside its limits. */
typedef struct ambulo__body {
  double mass, stature;            /* kg without loads, m */
  double slope;                    /* rad */
  double load[AMBULO__MOST_LOADS]; /* kg, of ambulo_model.loads */
} ambulo__body;

typedef struct ambulo__variant {
  ambulo_allocator allocator;
  const ambulo_problem *origin;
  ambulo_problem_definition definition; /* a copy, whose arrays may be written to */
  ambulo_coordinate *coordinates;       /* [d] likewise: range, speed, torque count */
  ambulo__body body;
  ambulo__gait_rule rule;
} ambulo__variant;

/* Of a problem, which must outlive it. E_MEMORY leaves what ambulo__variant_clear accepts. */
ambulo_status ambulo__variant_init(const ambulo_problem *problem, const ambulo_allocator *allocator,
                                   ambulo__variant *variant);
void ambulo__variant_clear(ambulo__variant *variant);

/* Arrays of the copy, to be written to. */
ambulo_contact *ambulo__variant_contacts(ambulo__variant *variant);
ambulo_term *ambulo__variant_terms(ambulo__variant *variant);
ambulo_device *ambulo__variant_devices(ambulo__variant *variant);
ambulo_hold *ambulo__variant_holds(ambulo__variant *variant);
ambulo_obstacle *ambulo__variant_obstacles(ambulo__variant *variant);
ambulo_reach *ambulo__variant_reaches(ambulo__variant *variant);
ambulo_end_value *ambulo__variant_end_values(ambulo__variant *variant);
double *ambulo__variant_array(const double *array_of_the_copy);

/* The problem as it stands now. Checked, it owns its model and outlives all else; not checked, it
 * may share the model, and numbers may be beyond the ranges of members a little: for differences.
 * Errors: as ambulo_problem_create. */
ambulo_status ambulo__variant_problem(const ambulo__variant *variant,
                                      ambulo_diagnostics *diagnostics, int checked,
                                      ambulo_problem **problem);

#endif
