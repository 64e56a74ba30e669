/* bench/peers/timing.h - one way to time for all peers, and the model and states they share.
 *
 * model.txt: number of coordinates, gravity (3), then for each coordinate its parent (-1: the
 * world), 1 if prismatic, axis (3), place of the joint in the parent's frame (3), mass, centre of
 * mass (3), inertia about it (xx yy zz xy xz yz). Frames stand along the world's axes when all
 * coordinates vanish; aligned axes point along +x, +y or +z.
 * states.bin: peer_states records of doubles, each q, qd, qdd, weights, tau, the gradient of
 * weights . tau with respect to q, qd, qdd (d each), and the Jacobians of tau (d * d each). */
#ifndef AMBULO_PEERS_TIMING_H
#define AMBULO_PEERS_TIMING_H

#include "bench.h"

enum { peer_states = 64, peer_repeats = 21, peer_most = 64 };

typedef struct peer_row {
  int parent, prismatic;
  double axis[3], place[3], mass, com[3], inertia[6];
} peer_row;

static inline size_t peer_record(int d) {
  return (size_t)(8 * d + 3 * d * d);
}

/* Prints "program quantity nanoseconds", the median time of one node; run(s) works on state s of
 * `count`, each state holding `nodes` time nodes. */
static inline void peer_time(const char *program, const char *quantity, void (*run)(int state),
                             int count, int nodes) {
  double times[peer_repeats];
  long rounds = 1;
  for (;; rounds *= 2) {
    double start = bench_seconds();
    for (long k = 0; k < rounds; k++)
      for (int s = 0; s < count; s++) run(s);
    if (bench_seconds() - start > 4e-3) break;
  }
  for (int t = 0; t < peer_repeats; t++) {
    double start = bench_seconds();
    for (long k = 0; k < rounds; k++)
      for (int s = 0; s < count; s++) run(s);
    times[t] = 1e9 * (bench_seconds() - start) / ((double)rounds * count * nodes);
  }
  printf("%s %s %.2f\n", program, quantity, bench_median(times, peer_repeats));
}

/* Largest difference, relative to the largest entry. */
static inline double peer_difference(const double *x, const double *y, int count) {
  double difference = 0, size = 1e-300;
  for (int i = 0; i < count; i++) {
    difference = fmax(difference, fabs(x[i] - y[i]));
    size = fmax(size, fabs(y[i]));
  }
  return difference / size;
}

/* Ends the program if a peer computes something else than the reference. */
static inline void peer_expect(const char *what, double difference) {
  if (difference < 1e-9) return;
  fprintf(stderr, "%s differs from the reference by %.1e\n", what, difference);
  exit(1);
}

static inline double *peer_read_states(const char *path, int d) {
  size_t count = peer_states * peer_record(d);
  double *states = (double *)malloc(count * sizeof *states);
  FILE *file = fopen(path, "rb");
  if (!states || !file || fread(states, sizeof *states, count, file) != count) {
    fprintf(stderr, "cannot read %s\n", path);
    exit(1);
  }
  fclose(file);
  return states;
}

#endif
