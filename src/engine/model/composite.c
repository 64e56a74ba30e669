/* model/composite.c - several rigid bodies as one.
 *
 * Parallel-axis theorem for two bodies with masses m, n and centres a, b: with d = b - a,
 *   mass = m + n,  centre = a + n/(m + n) d,
 *   I = I_m + I_n + m n/(m + n) (|d|^2 1 - d d^T)        about the common centre
 */
#include "model/composite.h"

void ambulo__part_add(ambulo__part *whole, const ambulo__part *part) {
  if (whole->mass == 0) {
    *whole = *part;
    return;
  }
  double mass = whole->mass + part->mass, reduced = whole->mass * part->mass / mass;
  double d[3];
  for (int i = 0; i < 3; i++) d[i] = part->com[i] - whole->com[i];
  const double offset[6] = {d[1] * d[1] + d[2] * d[2],
                            d[0] * d[0] + d[2] * d[2],
                            d[0] * d[0] + d[1] * d[1],
                            -d[0] * d[1],
                            -d[0] * d[2],
                            -d[1] * d[2]};
  for (int i = 0; i < 6; i++) whole->inertia[i] += part->inertia[i] + reduced * offset[i];
  for (int i = 0; i < 3; i++) whole->com[i] += part->mass / mass * d[i];
  whole->mass = mass;
}
