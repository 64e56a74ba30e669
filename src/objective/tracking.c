/* objective/tracking.c - nearness to a reference: phi(u) = u^2, u = scale (q - q_ref).
 *
 * phi' = 2 u, phi'' = 2. */
#include "objective/term.h"

ambulo__residual ambulo__tracking(double u) {
  ambulo__residual r = {u * u, 2.0 * u, 2.0};
  return r;
}
