/* nlp/ground.c - what the kernels are told about the ground at given times.
 *
 * Per block of 8 times [AMBULO__GROUND_ENTRIES][8] (mechanics/plan.h): share a_0 of foot 0, D in
 * world axes = D_f f + D_l l, kappa. Times beyond the last (padding) get a_0 = 1, D = 0,
 * kappa = 0. Centre of pressure of foot j, from the ZMP p (gait/loading.h):
 *
 *     c_0 = p + a_1 D,    c_1 = p - a_0 D
 */
#include "nlp/nlp.h"

#include "gait/loading.h"

#include <math.h>

ambulo_status ambulo__ground_fill(const ambulo_problem *p, const ambulo_allocator *a,
                                  const double *times, int count, double **ground) {
  *ground = NULL;
  if (!p->channels.feet) return AMBULO_OK;
  size_t blocks = (size_t)ambulo__block_count(count), lanes = AMBULO__LANES;
  double *g = ambulo__alloc_aligned(a, blocks * AMBULO__GROUND_ENTRIES * lanes, sizeof *g);
  ambulo__foot_outline *outlines = ambulo__foot_outlines(p->model, a);
  if (!g || !outlines) {
    ambulo__free_aligned(a, g);
    ambulo__free(a, outlines);
    return AMBULO_E_MEMORY;
  }
  for (int k = 0; k < (int)(blocks * lanes); k++) {
    ambulo__load load = {{1.0, 0.0}, {0.0, 0.0}};
    if (k < count) load = ambulo__load_at(&p->definition, outlines, times[k]);
    double *lane = g + ambulo__lane_index(k, AMBULO__GROUND_ENTRIES, 0);
    lane[0] = load.share[0];
    for (int axis = 0; axis < 3; axis++) {
      lane[(size_t)(1 + axis) * lanes] =
          load.apart[0] * p->model->forward[axis] + load.apart[1] * p->model->left[axis];
    }
    lane[4 * lanes] = k < count ? p->definition.ground_reaction.shear : 0.0;
  }
  ambulo__free(a, outlines);
  *ground = g;
  return AMBULO_OK;
}

/* (W.6) c_0 = p + a_1 D, c_1 = p - a_0 D */
void ambulo__pressure_centers(const double *ground, int node, const double *zmp, double *cop) {
  const double *lane = ground + ambulo__lane_index(node, AMBULO__GROUND_ENTRIES, 0);
  double share[2] = {lane[0], 1.0 - lane[0]};
  for (int foot = 0; foot < 2; foot++) {
    double factor = foot == 0 ? share[1] : -share[0];
    for (int axis = 0; axis < 3; axis++) {
      double apart = lane[(size_t)(1 + axis) * AMBULO__LANES];
      cop[3 * foot + axis] = share[foot] > 0.0 ? zmp[axis] + factor * apart : (double)NAN;
    }
  }
}

const ambulo_ground_reaction *ambulo_problem_ground_reaction(const ambulo_problem *p) {
  return &p->definition.ground_reaction;
}

double ambulo_problem_load_share(const ambulo_problem *p, int foot, double time) {
  if (!p->channels.feet || foot < 0 || foot > 1) return 0.0;
  ambulo__foot_outline outlines[2] = {ambulo__foot_outline_of(p->model, 0),
                                      ambulo__foot_outline_of(p->model, 1)};
  return ambulo__load_at(&p->definition, outlines, time).share[foot];
}
