/* tests/support/sweep_files.h - a small problem, its model, and a sweep over it in a scratch
 * folder. */
#ifndef AMBULO_TESTS_SWEEP_FILES_H
#define AMBULO_TESTS_SWEEP_FILES_H

#include "ambulo/tools/batch.h"
#include "support/messages.h"
#include "support/scratch.h"

static const char sweep_problem[] =
    "ambulo: 1\nkind: problem\nname: swing\nmodel: one.yaml\n"
    "angles: radians\ntime: {duration: 1.0, intervals: 10}\ntrajectory: {intervals: 6}\n"
    "ends: {initial: {pin: 0}, final: {pin: 1}}\n"
    "objective:\n  - {term: torque_squared, weight: 1}\n";
static const char sweep_model[] =
    "ambulo: 1\nkind: model\nname: one\nunits: {angle: radians}\ngravity: [0, -9.81, 0]\nforward: "
    "[1, 0, 0]\nlinks:\n"
    "  - {name: rod, parent: none, joint: revolute, dh: [-1.5708, 0, 1, 0], coordinate: {name: "
    "pin, range: [-3, 3]},\n"
    "     body: {mass: 1, com: [-0.5, 0, 0], inertia: [0, 0.1, 0.1, 0, 0, 0]}}\n";

/* writes s.yaml: the head of a sweep file and `text`, over `problem`; loads it */
static inline ambulo_status sweep_load_over(void **state, const char *problem, const char *text,
                                            const ambulo_allocator *allocator,
                                            ambulo_diagnostics *list, ambulo_sweep **sweep) {
  char whole[2048];
  snprintf(whole, sizeof whole, "ambulo: 1\nkind: sweep\nname: s\nbase: p.yaml\n%s", text);
  scratch_write(scratch_path(state, "p.yaml"), problem);
  scratch_write(scratch_path(state, "one.yaml"), sweep_model);
  scratch_write(scratch_path(state, "s.yaml"), whole);
  return ambulo_sweep_load(scratch_path(state, "s.yaml"), allocator, list, sweep);
}

static inline ambulo_status sweep_load(void **state, const char *text, ambulo_diagnostics *list,
                                       ambulo_sweep **sweep) {
  return sweep_load_over(state, sweep_problem, text, NULL, list, sweep);
}

/* it is not loaded, and the first message says so */
static inline void sweep_refused_over(void **state, const char *problem, const char *text,
                                      const char *message) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_sweep *sweep = NULL;
  assert_int_not_equal(sweep_load_over(state, problem, text, NULL, list, &sweep), AMBULO_OK);
  assert_null(sweep);
  assert_message(list, 0, message);
  ambulo_diagnostics_free(list);
}

#endif
