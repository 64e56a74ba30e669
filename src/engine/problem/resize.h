/* problem/resize.h - a definition's numbers for a body of another size.
 *
 * Bodies of one shape walk alike at one speed number v / sqrt(g H) if all that a walk is made of
 * is alike in units of the body: length H, time sqrt(H / g), mass M. Numbers for one body, in SI,
 * become for a body H' = longer H, M' = heavier M
 *
 *     lengths (tolerances, clearance, pressure, moment arm, free moment, step width)  longer
 *     loading rate, 1/s                                        1 / sqrt(longer)
 *     scale of a torque, 1 / N m                               1 / (heavier longer)
 *     scale of a force, 1 / N                                  1 / heavier
 *     torques and forces (offset, passive, strength)           their inverses
 *     rate of a torque, scale in s / N m                       sqrt(longer) / (heavier longer)
 *     turning acceleration, scale in s^2                       longer; of a translation as it is
 *     mechanical power, scale in kg / W                        1 / sqrt(longer)
 *     tendon, N m/rad; of a translation, N/m                   heavier longer; heavier / longer
 *     rate of a force, weight in s^2 by its square             longer
 *     rest of a translation, m; its scale, 1/m                 longer; 1 / longer
 *
 * Left as they are: angles, ratios, forces in body weights, prices (strength: limits), and the
 * task: speed, lengths and times of steps, contacts, ground, load, ends, tubes, references.
 * Integrals over time come out sqrt(longer) times as large, all alike.
 */
#ifndef AMBULO_PROBLEM_RESIZE_H
#define AMBULO_PROBLEM_RESIZE_H

#include "ambulo/problem.h"

/* Of the first `terms` terms of the objective, and of all else. The arrays of these terms, and the
 * list of them, belong to the caller, and are written to. */
void ambulo__definition_resize(ambulo_problem_definition *definition, int terms, double longer,
                               double heavier);

#endif
