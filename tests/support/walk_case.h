/* tests/support/walk_case.h - bodies that are to walk: an imported robot, an imported person. */
#ifndef AMBULO_TESTS_WALK_CASE_H
#define AMBULO_TESTS_WALK_CASE_H

#include "exchange/walker.h"
#include "support/import_case.h"

#include <stdlib.h>

/* a robot of 36 kg on legs of six joints, feet 0.18 m apart (biped.urdf) */
static inline import_case walk_biped(void) {
  return import_file("tests/users/biped.urdf", NULL);
}

/* a person of OpenSim's names (walker.osim) on soles of 0.18 m */
static inline import_case walk_person(void) {
  static const char *const heels[] = {"right=calcn_r:0,0,-0.03:0,0,0.03",
                                      "left=calcn_l:0,0,-0.03:0,0,0.03"};
  static const char *const toes[] = {"right=calcn_r:0.18,0,-0.04:0.18,0,0.04",
                                     "left=calcn_l:0.18,0,-0.04:0.18,0,0.04"};
  ambulo_import_options options = ambulo_import_options_default();
  options.heels = heels;
  options.toes = toes;
  options.heel_count = options.toe_count = 2;
  return import_file("tests/users/walker.osim", &options);
}

/* the model of a text with every `from` replaced by `to` */
static inline char *walk_changed(const char *text, const char *from, const char *to) {
  size_t length = strlen(from), room = 2 * strlen(text) + 1024, at = 0;
  char *changed = calloc(room, 1);
  assert_non_null(changed);
  while (*text) {
    int here = strncmp(text, from, length) == 0;
    assert_true(at + strlen(to) + 2 < room);
    if (here) {
      memcpy(changed + at, to, strlen(to));
      at += strlen(to);
      text += length;
    } else
      changed[at++] = *text++;
  }
  return changed;
}

static inline ambulo_model *walk_model(const char *text) {
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load_text(text, strlen(text), "m", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  return model;
}

/* the number behind a key of a problem's text */
static inline double walk_value(const char *text, const char *key) {
  const char *at = strstr(text, key);
  assert_non_null(at);
  return strtod(at + strlen(key), NULL);
}

#endif
