/* ambulo/again.h - solving again beside a solution.
 *
 * What was solved once need not be found again. A solution has two halves: its control points, and
 * the multipliers of its rows, which are the expensive one. A solve that begins with both takes a
 * few iterations where one from zero takes fifty: models/walk.yaml at 1.293 m/s from its solution
 * at 1.28 m/s, 8 for 104.
 */
#ifndef AMBULO_AGAIN_H
#define AMBULO_AGAIN_H

#include "ambulo/solve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Multipliers of a result of `problem`, for ambulo_options.multipliers of a solve that starts from
 * its control points. They are densities over time, kept by the names of the rows and their shares
 * of the duration; so they serve problems with other numbers, durations, grids and trajectories.
 * What has no row there is left out. They need neither problem nor result afterwards. E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_multipliers_of(const ambulo_problem *problem,
                                                                const ambulo_result *result,
                                                                const ambulo_allocator *allocator,
                                                                ambulo_multipliers **multipliers);
AMBULO_API void ambulo_multipliers_free(ambulo_multipliers *multipliers); /* accepts NULL */

#ifdef __cplusplus
}
#endif
#endif
