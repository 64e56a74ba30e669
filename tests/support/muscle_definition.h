/* tests/support/muscle_definition.h - muscles in memory that tests bend out of shape.
 *
 * A chain of 12 hinges q0 to q11, the last of which nothing drives. Muscle "a" spans q0 and q1, "b"
 * q1 and q2, "c" q4 alone; l = 0.35 - 0.05 q - 0.02 q', q' the second coordinate. Each has a pull
 * at the joint of its first coordinate. */
#ifndef AMBULO_TESTS_MUSCLE_DEFINITION_H
#define AMBULO_TESTS_MUSCLE_DEFINITION_H

#include "ambulo/muscles.h"
#include "support/messages.h"
#include "support/test.h"

enum { strap_d = 12, strap_m = 3, strap_terms = 3 };

typedef struct straps {
  ambulo_link links[strap_d];
  ambulo_coordinate coordinates[strap_d];
  char names[strap_d][8];
  ambulo_muscle muscles[strap_m];
  ambulo_muscle_pull pulls[strap_m];
  unsigned char exponents[strap_terms][AMBULO_MUSCLE_COORDINATES];
  double length[strap_terms], slopes[strap_terms][3];
  ambulo_muscles_definition definition;
  ambulo_model *model;
} straps;

static inline void straps_model(straps *s) {
  ambulo_model_definition d = ambulo_model_definition_default();
  for (int i = 0; i < strap_d; i++) {
    snprintf(s->names[i], sizeof s->names[i], "q%d", i);
    s->links[i] = ambulo_link_default();
    s->links[i].name = s->names[i];
    s->links[i].parent = i - 1;
    s->links[i].type = AMBULO_REVOLUTE;
    s->links[i].a = 0.2;
    s->links[i].mass = 1.0;
    s->links[i].inertia[0] = s->links[i].inertia[1] = s->links[i].inertia[2] = 0.1;
    s->coordinates[i] = ambulo_coordinate_default();
    s->coordinates[i].name = s->names[i];
  }
  s->coordinates[strap_d - 1].actuated = 0;
  d.links = s->links;
  d.link_count = strap_d;
  d.coordinates = s->coordinates;
  d.coordinate_count = strap_d;
  d.stature = 1.75;
  assert_int_equal(ambulo_model_create(&d, NULL, NULL, &s->model), AMBULO_OK);
}

/* to be closed with straps_close */
static inline void straps_open(straps *s) {
  static const char *const names[] = {"a", "b", "c"};
  static const int spans[strap_m][3] = {{2, 0, 1}, {2, 1, 2}, {1, 4, 0}};
  memset(s, 0, sizeof *s);
  straps_model(s);
  s->exponents[1][0] = s->exponents[2][1] = 1;
  s->length[0] = 0.35;
  s->length[1] = -0.05;
  s->length[2] = -0.02;
  for (int k = 0; k < 3; k++) s->slopes[0][k] = k + 1;
  for (int i = 0; i < strap_m; i++) {
    s->pulls[i] = ambulo_muscle_pull_default();
    s->pulls[i].joint = s->names[spans[i][1]];
    s->pulls[i].link = spans[i][1];
    s->pulls[i].axes = spans[i][1] > 0 ? spans[i][1] - 1 : 0;
    s->pulls[i].term_count = 1;
    s->pulls[i].exponents = (const unsigned char(*)[AMBULO_MUSCLE_COORDINATES])s->exponents;
    s->pulls[i].slopes = (const double(*)[3])s->slopes;
    ambulo_muscle *m = &s->muscles[i];
    *m = ambulo_muscle_default();
    m->name = names[i];
    m->force = 1000.0 * (i + 1);
    m->fiber = 0.1;
    m->tendon = 0.25;
    m->coordinate_count = spans[i][0];
    m->coordinates[0] = spans[i][1];
    m->coordinates[1] = spans[i][2];
    m->term_count = spans[i][0] + 1;
    m->exponents = (const unsigned char(*)[AMBULO_MUSCLE_COORDINATES])s->exponents;
    m->length = s->length;
    m->pulls = &s->pulls[i];
    m->pull_count = i > 0;
  }
  s->definition = ambulo_muscles_definition_default();
  s->definition.name = "straps";
  s->definition.source = "own";
  s->definition.muscles = s->muscles;
  s->definition.muscle_count = strap_m;
}

static inline void straps_close(straps *s) {
  ambulo_model_free(s->model);
}

static inline ambulo_muscles *straps_good(const straps *s) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_muscles *muscles = NULL;
  ambulo_status status = ambulo_muscles_create(s->model, &s->definition, NULL, list, &muscles);
  if (ambulo_diagnostics_count(list) > 0) assert_message(list, 0, "no message");
  ambulo_diagnostics_free(list);
  assert_int_equal(status, AMBULO_OK);
  return muscles;
}

/* refused with `status`, and one message that contains `want` (NULL: none) */
static inline void straps_bad(const straps *s, ambulo_status status, const char *want) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_muscles *muscles = NULL;
  ambulo_status got = ambulo_muscles_create(s->model, &s->definition, NULL, list, &muscles);
  if (got != status) print_error("%s: %s\n", want ? want : "-", ambulo_status_name(got));
  assert_int_equal(got, status);
  assert_null(muscles);
  if (want) assert_message(list, 0, want);
  if (ambulo_diagnostics_count(list) > 1) assert_message(list, 1, "no second message");
  assert_int_equal(ambulo_diagnostics_count(list), want ? 1 : 0);
  ambulo_diagnostics_free(list);
}

#endif
