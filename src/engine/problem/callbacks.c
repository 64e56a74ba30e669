/* problem/callbacks.c - functions of the caller: see callbacks.h. */
#include "problem/callbacks.h"

#include <math.h>
#include <string.h>

void ambulo__node_state_fill(const ambulo_workspace *workspace, int node, double *state) {
  for (int c = 0; c < workspace->channel_count; c++)
    state[c] = workspace->channel[ambulo__lane_index(node, workspace->channel_count, c)];
}

ambulo_node_state ambulo__node_state_view(const ambulo_problem *p, int node, const double *state) {
  int d = p->coordinates;
  ambulo_node_state view = {p->times[node], node,          state,         state + d,
                            state + 2 * d,  state + 3 * d, state + 4 * d, state + 4 * d + 6};
  return view;
}

ambulo_node_gradient ambulo__node_gradient_view(const ambulo_problem *p, double *slope) {
  int d = p->coordinates;
  ambulo_node_gradient view = {slope,         slope + d,     slope + 2 * d,
                               slope + 3 * d, slope + 4 * d, slope + 4 * d + 6};
  return view;
}

/* ------------------------------------------------------------ terms of the caller */

/* Curvature. A square has that of Gauss and Newton, 2 (dr/dy)(dr/dy)', exact where r is linear. Of
 * another function only the gradient g is known. With signs s_c = +-1 and steps d_c,
 *
 *     D_c = s_c ( g_c(y + d s) - g_c(y) ) / d_c
 *
 * is the diagonal of the second derivatives H plus sum_{e != c} s_c s_e H_ce d_e / d_c. The signs
 * of four probes are the rows of a Hadamard matrix, drawn for each channel and node: of two
 * channels with different columns the cross terms cancel over the four, of the others they change
 * sign from node to node (Bekas, Kokiopoulou & Saad 2007). A function that is a sum over channels
 * has its exact diagonal, whatever its scale. What is negative, or not finite, counts as no
 * curvature: the metric is a guess that only decides how fast a solve goes, never where it ends.
 */

enum { PROBES = 4 };
static const double share = 1e-4; /* of a channel's usual size: step of a probe */

static double call(const ambulo_workspace *workspace, const ambulo_term *term, int node,
                   const double *state, double *slope) {
  const ambulo_problem *p = workspace->problem;
  ambulo_node_state view = ambulo__node_state_view(p, node, state);
  if (!slope) return term->function(term->user, &view, NULL);
  memset(slope, 0, (size_t)workspace->channel_count * sizeof *slope);
  ambulo_node_gradient gradient = ambulo__node_gradient_view(p, slope);
  return term->function(term->user, &view, &gradient);
}

double ambulo__user_term_value(const ambulo_workspace *workspace, const ambulo_term *term,
                               int node) {
  ambulo__node_state_fill(workspace, node, workspace->node_state);
  double r = call(workspace, term, node, workspace->node_state, NULL);
  return term->kind == AMBULO_USER_SQUARE ? r * r : r;
}

void ambulo__user_term_slope(const ambulo_workspace *workspace, const ambulo_term *term, int node,
                             double *slope) {
  ambulo__node_state_fill(workspace, node, workspace->node_state);
  double r = call(workspace, term, node, workspace->node_state, slope);
  if (term->kind != AMBULO_USER_SQUARE) return;
  for (int c = 0; c < workspace->channel_count; c++) slope[c] *= 2.0 * r;
}

/* ---------------------------------------------------------------- curvature */

/* what a channel moves by in a motion: rad, m; their rates; N m, N; m */
static double usual_size(const ambulo_problem *p, int channel) {
  static const double motion[] = {0.5, 5.0, 50.0};
  const int d = p->coordinates, points = ambulo__channel_point(&p->channels, 0, 0);
  if (channel < 3 * d) return motion[channel / d];
  if (channel < points) return p->table.weight;
  return channel < points + 3 * p->channels.points ? 0.5 : p->table.weight;
}

/* column of a 4 x 4 Hadamard matrix for a channel of a node: a hash of both (Knuth) */
static unsigned column_of(int node, int channel) {
  unsigned h = (unsigned)node * 2654435761u + (unsigned)channel * 2246822519u;
  h ^= h >> 15;
  h *= 2654435761u;
  return (h >> 28) & 3u;
}

static double sign_of(unsigned column, unsigned probe) {
  unsigned both = column & probe;
  return (both ^ (both >> 1)) & 1u ? -1.0 : 1.0;
}

static void estimate(const ambulo_workspace *workspace, const ambulo_term *term, int node,
                     double *scratch, double *curvature) {
  const ambulo_problem *p = workspace->problem;
  const int count = workspace->channel_count;
  double *state = scratch, *moved = state + count, *slope = moved + count, *bent = slope + count;
  ambulo__node_state_fill(workspace, node, state);
  (void)call(workspace, term, node, state, slope);
  memset(curvature, 0, (size_t)count * sizeof *curvature);
  for (unsigned probe = 0; probe < PROBES; probe++) {
    for (int c = 0; c < count; c++)
      moved[c] = state[c] + sign_of(column_of(node, c), probe) * share * usual_size(p, c);
    (void)call(workspace, term, node, moved, bent);
    for (int c = 0; c < count; c++) {
      double step = moved[c] - state[c];
      if (step != 0.0) curvature[c] += (bent[c] - slope[c]) / (PROBES * step);
    }
  }
  for (int c = 0; c < count; c++) {
    if (!(curvature[c] > 0.0) || !isfinite(curvature[c])) curvature[c] = 0.0;
  }
}

/* (P.2a) four probes with signs after Hadamard */
void ambulo__user_term_curvature(const ambulo_workspace *workspace, const ambulo_term *term,
                                 int node, double *scratch, double *curvature, int *count) {
  const int channels = workspace->channel_count;
  *count = channels;
  if (term->kind != AMBULO_USER_SQUARE) {
    estimate(workspace, term, node, scratch, curvature);
    return;
  }
  ambulo__node_state_fill(workspace, node, scratch);
  (void)call(workspace, term, node, scratch, curvature);
  for (int c = 0; c < channels; c++) curvature[c] *= sqrt(2.0);
  *count = -1;
}
