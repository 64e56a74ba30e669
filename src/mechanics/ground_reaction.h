/* mechanics/ground_reaction.h - reference of the two-step ground reaction, one state at a time. */
#ifndef AMBULO_MECHANICS_GROUND_REACTION_H
#define AMBULO_MECHANICS_GROUND_REACTION_H

#include "model/model.h"

/* The output rows of a grounded plan (mechanics/plan.h) for a model with two feet. Everything but
 * `ground` (AMBULO__GROUND_ENTRIES numbers: share of foot 0, D, kappa) is complex, as interleaved
 * pairs: a complex step of a coordinate gives a column of the Jacobian. `scratch` has
 * ambulo_lagrangian_scratch_size(model) bytes. Errors: those of the reference recursion. */
ambulo_status ambulo__ground_reaction_reference(const ambulo_model *model, double ground_height,
                                                const double *ground, const double *q,
                                                const double *qd, const double *qdd, double *rows,
                                                void *scratch);

#endif
