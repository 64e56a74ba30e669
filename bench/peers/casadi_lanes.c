/* bench/peers/casadi_lanes.c - times the code that casadi_lanes.py wrote.
 *
 *   casadi_lanes FOLDER     built with -DLANES=8 (AVX-512) or -DLANES=4 (AVX2), with glibc's
 * libmvec
 */
#include "timing.h"

typedef double lanes __attribute__((vector_size(8 * LANES)));
static inline lanes broadcast(double x) {
  return x + (lanes){0};
}
#if LANES == 8
lanes _ZGVeN8v_sin(lanes x);
lanes _ZGVeN8v_cos(lanes x);
#define lanes_sin _ZGVeN8v_sin
#define lanes_cos _ZGVeN8v_cos
#else
lanes _ZGVdN4v_sin(lanes x);
lanes _ZGVdN4v_cos(lanes x);
#define lanes_sin _ZGVdN4v_sin
#define lanes_cos _ZGVdN4v_cos
#endif
#include "casadi_lanes.h"

enum { groups = peer_states / LANES, d = coordinates };
static lanes in[groups][4][d], tau[d], gradient[3][d], jacobian[3][d * d];

static void run_tau(int g) {
  const lanes *from[] = {in[g][0], in[g][1], in[g][2]};
  lanes *to[] = {tau};
  casadi_tau(from, to);
}
static void run_vjp(int g) {
  const lanes *from[] = {in[g][0], in[g][1], in[g][2], in[g][3]};
  lanes *to[] = {tau, gradient[0], gradient[1], gradient[2]};
  casadi_vjp(from, to);
}
static void run_jacobians(int g) {
  const lanes *from[] = {in[g][0], in[g][1], in[g][2]};
  lanes *to[] = {tau, jacobian[0], jacobian[1], jacobian[2]};
  casadi_jacobians(from, to);
}

static void expect(const char *what, const lanes *values, const int *places, int count, int size,
                   const double *states, size_t at, int group) {
  double dense[d * d];
  for (int lane = 0; lane < LANES; lane++) {
    memset(dense, 0, sizeof dense);
    for (int i = 0; i < count; i++) dense[places ? places[i] : i] = values[i][lane];
    const double *record = states + (size_t)(group * LANES + lane) * peer_record(d);
    peer_expect(what, peer_difference(dense, record + at, size));
  }
}

#define PATTERN(k) pattern_##k, (int)(sizeof pattern_##k / sizeof *pattern_##k)

int main(int argc, char **argv) {
  char path[512];
  if (argc < 2) return 1;
  (void)snprintf(path, sizeof path, "%s/states.bin", argv[1]);
  double *states = peer_read_states(path, d);
  for (int s = 0; s < peer_states; s++)
    for (int k = 0; k < 4 * d; k++)
      in[s / LANES][k / d][k % d][s % LANES] = states[(size_t)s * peer_record(d) + (size_t)k];
  for (int g = 0; g < groups; g++) {
    run_tau(g);
    expect("CasADi's tau", tau, NULL, d, d, states, 4 * d, g);
    run_vjp(g);
    for (size_t k = 0; k < 3; k++)
      expect("CasADi's gradient", gradient[k], NULL, d, d, states, (5 + k) * d, g);
    run_jacobians(g);
    expect("CasADi's Jacobian", jacobian[0], PATTERN(0), d * d, states, 8 * d, g);
    expect("CasADi's Jacobian", jacobian[1], PATTERN(1), d * d, states, 8 * d + d * d, g);
    expect("CasADi's Jacobian", jacobian[2], PATTERN(2), d * d, states, 8 * d + 2 * d * d, g);
  }
  peer_time("casadi_lanes", "tau", run_tau, groups, LANES);
  peer_time("casadi_lanes", "tau+vjp", run_vjp, groups, LANES);
  peer_time("casadi_lanes", "jacobians", run_jacobians, groups, LANES);
  free(states);
  return 0;
}
