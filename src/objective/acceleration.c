/* objective/acceleration.c - smoothness: phi(u) = u^2, u = scale qdd.
 *
 * phi' = 2 u, phi'' = 2. */
#include "objective/term.h"

ambulo__residual ambulo__acceleration(double u) {
  ambulo__residual r = {u * u, 2.0 * u, 2.0};
  return r;
}
