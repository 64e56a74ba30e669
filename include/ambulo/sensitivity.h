/* ambulo/sensitivity.h - how the least objective changes with each number of a problem.
 *
 * For every number p that a problem is made of - step length and width, times, phases, slope,
 * subject and load, limits, tolerances, friction, weights, strengths, prescribed ends - the
 * derivative of the least objective f* with p, without another solve. By the envelope theorem
 * (Fiacco, Mathematical Programming 12, 1976) it is the derivative of the Lagrangian at the
 * solution x* with its multipliers (ambulo_result_multipliers), found by differences in p:
 *
 *     df*_dp = d/dp [ f(x*; p) - sum_r multiplier_r c_r(x*; p) ]
 *
 * A change of p by d changes the least objective by df*_dp d + O(d^2) as long as the same rows stay
 * active and the solution stays in its valley. How good it is:
 *
 *   - x* is known to options.optimality_tolerance; the error of df*_dp is of the first order in it,
 *     and `error` estimates it. For more digits solve with a tighter tolerance.
 *   - Where active rows depend on each other (ambulo_audit.rank < active_rows), multipliers are not
 *     unique and those of the audit are one choice of many. If p moves dependent rows together,
 *     as a step length moves the corners of a flat foot, every choice gives the same value. If p
 *     moves one of them alone, f* has a kink at p (or the problem has a solution on one side
 *     only), and the value is between the slopes of the two sides.
 *   - Functions of the caller are taken to depend on p only through their node's state.
 *
 * What moves together:
 *
 *   - On grids on events (AMBULO_GRID_EVENTS without node_times) nodes go along with phases and
 *     times of contacts, and so do knots on events; each phase keeps its number of intervals.
 *   - Contacts that begin or end at one time go on doing so; contacts of a foot that follow each
 *     other on one foothold stay on one.
 *   - With mirrored ends left and right stay alike, muscles too.
 *   - Muscles grow with the body: forces with its mass to the power 2/3, lengths with its stature.
 *
 * What is not listed:
 *
 *   - Numbers that the grid, or what is active at a node, depends on in jumps: times on uniform
 *     grids, numbers of intervals, what would leave level ground.
 *   - Times of events beside references, tubes and functions of the caller, and a duration beside
 *     other times in seconds: listed contacts, breakpoints, node times, steps of two times,
 *     references, reaches within the motion, on grids on events what hands hold.
 *   - Footholds at 0 and T of a motion that repeats, with travel and rise: none moves alone.
 *   - Numbers at a kink: an event at 0, T, another event or a knot of a cubic; the height of a
 *     foothold as high as the one before.
 *   - Limits that the motion does not touch.
 */
#ifndef AMBULO_SENSITIVITY_H
#define AMBULO_SENSITIVITY_H

#include "ambulo/solve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One number. Strings belong to the list. */
typedef struct ambulo_sensitivity {
  const char *name;  /* as a problem file has it, and --set: "gait.step_length",
                        "objective[upright].weight", "model.links[shank_r].coordinate.range[1]";
                        the same for problems made from C */
  const char *with;  /* the names of numbers that move along, separated by ", ": with mirrored ends,
                        where both sides have to be alike, that of the other side; of a foothold
                        those of the foot's other contacts on it; of a time those of all contacts
                        that begin or end then; "" for none */
  double with_sign;  /* ... with this factor: 1 or -1; 0 for none */
  const char *label; /* in words: "step length" */
  const char *unit;  /* SI and rad, also where a file has degrees; "" for weights, scales,
                        phases */
  double value;      /* what it is now, in unit */
  double file_value; /* the same in the file's unit, for its body: what --set takes; NaN: an angle,
                        and the file does not state its unit (--set angles=degrees does) */
  double derivative; /* df*_dp with all other keys of the file as they are, per unit: a step length
                        at a given speed brings the step time along, `subject.mass` brings torque
                        limits that are shares of the weight */
  double error;      /* of the derivative, since the solve ended a little before the optimum: an
                        estimate that the true error rarely exceeds (solver/sensitivities.c); NaN:
                        not known */
  double travel;     /* d travel / dp, m per unit: what it adds to the distance between the ends */
  double step;       /* a change that one can picture, in unit: 1 cm, 1 degree, 1 kg, 1 % */
  double share;      /* derivative * step / f*: .008 is 0.8 %; NaN where f* is not positive */
  const char *words; /* "1 cm more step length raises the objective by 0.8 %" */
} ambulo_sensitivity;

typedef struct ambulo_sensitivity_list {
  const ambulo_sensitivity *items; /* largest derivative * step first */
  int count;
  const char *reason; /* why there is none: the point is not optimal, or there is no objective; ""
                         otherwise */
} ambulo_sensitivity_list;

/* `result` is one of `problem`. A list is returned whatever the verdict. E_ARGUMENT, E_MEMORY,
 * E_NUMERIC (a value at the result's point is not finite). */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_sensitivities(const ambulo_problem *problem,
                                                               const ambulo_result *result,
                                                               const ambulo_allocator *allocator,
                                                               ambulo_sensitivity_list **list);
AMBULO_API void ambulo_sensitivities_free(ambulo_sensitivity_list *list); /* accepts NULL */

#ifdef __cplusplus
}
#endif
#endif
