/* support/lagrangian_energy.h - energies from the matrices that the reference recursion leaves in
 * its scratch:
 *
 *     T = sum tr(B J B^T) / 2,  V = -sum m g . c                                        (E)
 */
#ifndef TEST_LAGRANGIAN_ENERGY_H
#define TEST_LAGRANGIAN_ENERGY_H

#include "mechanics/lagrangian.h"
#include "model/model.h"
#include "support/test.h"

/* J, the integral of r r^T dm over a link, r = (x, y, z, 1) in its frame */
static inline double pseudo_inertia(const ambulo_link *link, int a, int b) {
  static const int product[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  const double *in = link->inertia, r[4] = {link->com[0], link->com[1], link->com[2], 1.0};
  double j = link->mass * r[a] * r[b];
  if (a == b && a < 3) j += 0.5 * (in[0] + in[1] + in[2]);
  return a < 3 && b < 3 ? j - in[product[a][b]] : j;
}

/* J; the potential is zero at the world's origin */
static inline void lagrangian_energy(const ambulo_model *model, const double *q, const double *qd,
                                     double *kinetic, double *potential, void *scratch) {
  double rest[64] = {0.0};
  assert_true(model->coordinate_count <= 64);
  assert_int_equal(ambulo__lagrangian(0, model, q, qd, rest, NULL, scratch), AMBULO_OK);
  const link_state *states = scratch;
  *kinetic = *potential = 0.0;
  for (int i = 0; i < model->link_count; i++) {
    const ambulo_link *link = &model->links[i];
    for (int row = 0; row < 3; row++) {
      double place = creal(states[i].a.e[row][3]);
      for (int k = 0; k < 3; k++) place += creal(states[i].a.e[row][k]) * link->com[k];
      *potential -= link->mass * model->gravity[row] * place;
      for (int a = 0; a < 4; a++)
        for (int b = 0; b < 4; b++)
          *kinetic += 0.5 * creal(states[i].b.e[row][a]) * pseudo_inertia(link, a, b) *
                      creal(states[i].b.e[row][b]);
    }
  }
}

#endif
