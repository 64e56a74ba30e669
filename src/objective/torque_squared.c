/* objective/torque_squared.c - effort: phi(u) = u^2, u = scale (tau - offset).
 *
 * phi' = 2 u, phi'' = 2. */
#include "objective/term.h"

ambulo__residual ambulo__torque_squared(double u) {
  ambulo__residual r = {u * u, 2.0 * u, 2.0};
  return r;
}
