/* problem/states.c - one node as callbacks see it (states.h). */
#include "problem/states.h"

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
