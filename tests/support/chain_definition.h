/* tests/support/chain_definition.h - a definition in memory that tests bend out of shape.
 *
 * Links a - b - c, each a revolute coordinate qa, qb, qc and a body of 1, 2, 4 kg; points heel
 * and toe on c; one foot of them. */
#ifndef AMBULO_TESTS_CHAIN_DEFINITION_H
#define AMBULO_TESTS_CHAIN_DEFINITION_H

#include "ambulo/model.h"
#include "support/messages.h"
#include "support/test.h"

typedef struct chain {
  ambulo_link links[3];
  ambulo_coordinate coordinates[3];
  ambulo_point points[2];
  ambulo_foot feet[2];
  ambulo_model_definition definition;
} chain;

static inline void chain_make(chain *c) {
  static const char *const links[] = {"a", "b", "c"}, *const names[] = {"qa", "qb", "qc"};
  for (int i = 0; i < 3; i++) {
    c->links[i] = ambulo_link_default();
    c->links[i].name = links[i];
    c->links[i].parent = i - 1;
    c->links[i].type = AMBULO_REVOLUTE;
    c->links[i].a = 0.5;
    c->links[i].mass = 1 << i;
    c->links[i].inertia[0] = c->links[i].inertia[1] = c->links[i].inertia[2] = 0.1;
    c->coordinates[i] = ambulo_coordinate_default();
    c->coordinates[i].name = names[i];
  }
  c->points[0] = (ambulo_point){"heel", 2, {-0.1, 0, 0}};
  c->points[1] = (ambulo_point){"toe", 2, {0.2, 0, 0}};
  c->feet[0] = (ambulo_foot){"foot", {0, -1}, {1, -1}, 0, 1, -1, .tip = -1};
  c->feet[1] = (ambulo_foot){"other", {0, -1}, {1, -1}, 0, 1, -1, .tip = -1};
  c->definition = ambulo_model_definition_default();
  c->definition.links = c->links;
  c->definition.link_count = 3;
  c->definition.coordinates = c->coordinates;
  c->definition.coordinate_count = 3;
  c->definition.points = c->points;
  c->definition.point_count = 2;
  c->definition.feet = c->feet;
  c->definition.foot_count = 1;
}

/* refused with `status`; the first message contains `want` (NULL: there is none) */
static inline void chain_bad(const chain *c, ambulo_status status, const char *want) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_create(&c->definition, NULL, list, &model), status);
  assert_null(model);
  if (want) assert_message(list, 0, want);
  assert_int_equal(ambulo_diagnostics_count(list), want ? 1 : 0);
  ambulo_diagnostics_free(list);
}

static inline ambulo_model *chain_good(const chain *c) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_model *model = NULL;
  ambulo_status status = ambulo_model_create(&c->definition, NULL, list, &model);
  if (ambulo_diagnostics_count(list) > 0) assert_message(list, 0, "no message");
  ambulo_diagnostics_free(list);
  assert_int_equal(status, AMBULO_OK);
  return model;
}

#endif
