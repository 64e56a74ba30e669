/* tests/support/scene_reading.h - a scene.json as a document, and its series as numbers. */
#ifndef AMBULO_TESTS_SCENE_READING_H
#define AMBULO_TESTS_SCENE_READING_H

#include "support/test.h"
#include "support/yaml.h"

/* sample k of a series (docs/results.md): adds up what the file has, one number after the other */
static inline double scene_value(const ambulo__yaml_node *series, int k, double unit) {
  double value = 0.0, slope = 0.0;
  assert_true(k < ambulo__yaml_items(series));
  for (int i = 0; i <= k; i++) {
    double number = ambulo__yaml_number(ambulo__yaml_item(series, i), (double)NAN);
    if (i == 0) {
      value = number;
    } else {
      slope += number;
      value += slope;
    }
  }
  return value * unit;
}

/* axis 0 to 2 of the three series of a point */
static inline double scene_point(const ambulo__yaml_node *root, int point, int axis, int k) {
  const ambulo__yaml_node *three = ambulo__yaml_item(ambulo__yaml_get(root, "points"), point);
  return scene_value(ambulo__yaml_item(three, axis), k, 1e-4);
}

static inline const ambulo__yaml_node *scene_named(const ambulo__yaml_node *list,
                                                   const char *name) {
  for (int i = 0; i < ambulo__yaml_items(list); i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    if (strcmp(ambulo__yaml_text(ambulo__yaml_get(item, "name")), name) == 0) return item;
  }
  print_error("nothing is named %s\n", name);
  fail();
  return NULL;
}

#endif
