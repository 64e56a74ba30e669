/* Faults of files of muscles, with their places; limits; memory that runs out. */
#include "ambulo/tools/load.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/model_text.h"
#include "support/scratch.h"

static ambulo_model *lower_body(void) {
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_23.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  return model;
}

static const char *const good[] = {"ambulo: 1",
                                   "kind: muscles",
                                   "name: m",
                                   "source: [own]",
                                   "license: CC0-1.0",
                                   "subject: {mass: 75, thigh: 0.4, shank: 0.45}",
                                   "mirror: {_r: _l}",
                                   "coordinates: {ankle_angle_r: [-30, 20]}",
                                   "joints: {ankle_r: {link: talus_r, axes: shank_r}}",
                                   "muscles:",
                                   "  - name: soleus_r",
                                   "    force: 3000",
                                   "    fiber: 0.05",
                                   "    tendon: 0.3",
                                   "    coordinates: [ankle_angle_r, subtalar_angle_r]",
                                   "    exponents: [[0, 0], [1, 0]]",
                                   "    length: [0.34, 0.05]",
                                   "    pull: {ankle_r: {exponents: [[0, 0]], x: [0], y: [-1], "
                                   "z: [0]}}"};
enum { LINES = sizeof good / sizeof *good };

typedef struct fault {
  int line; /* from 1: replaced */
  const char *text;
  const char *message; /* behind the file's name */
} fault;

static const fault faults[] = {
    {1, "ambulo: 2", ":1:9: error[E_SCHEMA]: got '2'; expected one of: 1"},
    {2, "kind: sweep", ":2:7: error[E_SCHEMA]: this is "},
    {2, "kind: model",
     ":2:7: error[E_SCHEMA]: this is a skeleton model; expected a file of muscles"},
    {3, "title: m", ":1:1: error[E_SCHEMA]: missing required key 'name'"},
    {6, "subject: {mass: 75, thigh: 0.4}", ":6:10: error[E_SCHEMA]: missing required key 'shank'"},
    {7, "mirror: {_r: _l, _a: _b}",
     ":7:9: error[E_SCHEMA]: 2 pairs of endings; expected one, such as {_r: _l}"},
    {8, "coordinates: {ankle_angle_r: [20, -30]}",
     ":8:30: error[E_SCHEMA]: from 20 to -30 degrees; expected the smaller first"},
    {8, "coordinates: {ankel_angle_r: [-30, 20]}",
     ":8:30: error[E_MODEL]: no coordinate 'ankel_angle_r' in model 'lower_body_23'\n"
     "  hint: did you mean 'ankle_angle_r'?"},
    {9, "joints: {ankle_r: {link: tallus_r, axes: shank_r}}",
     ":9:26: error[E_MODEL]: no link 'tallus_r' in model 'lower_body_23'\n"
     "  hint: did you mean 'talus_r'?"},
    {11, "  - name: soleus", ":11:5: error[E_SCHEMA]: muscle 'soleus' is not of the side '_r'"},
    {12, "    froce: 3000", ":11:5: error[E_SCHEMA]: missing required key 'force' in muscles[0]"},
    {12, "    force: 3000\n    frce: 1",
     ":13:5: error[E_SCHEMA]: unknown key 'frce' in muscles[0] ('soleus_r')\n"
     "  hint: did you mean 'force'?"},
    {12, "    force: -3000", ":12:12: error[E_SCHEMA]: got '-3000'"},
    {12, "    force: 0",
     ":11:5: error[E_MODEL]: muscle 'soleus_r': force (got 0); expected above 0"},
    {13, "    fiber: -0.05", ":13:12: error[E_SCHEMA]: got '-0.05'"},
    {15, "    coordinates: [ankle_angel_r, subtalar_angle_r]",
     ":15:19: error[E_MODEL]: no coordinate 'ankle_angel_r' in model 'lower_body_23'\n"
     "  hint: did you mean 'ankle_angle_r'?"},
    {15, "    coordinates: []", ":15:18: error[E_SCHEMA]: 0 coordinates; expected 1 to 4"},
    {15, "    coordinates: [pelvis_tilt, ankle_angle_r]",
     ":11:5: error[E_MODEL]: muscle 'soleus_r': a coordinate"},
    {16, "    exponents: [[0, 0], [1]]",
     ":16:25: error[E_SCHEMA]: 1 exponents; expected one for each of 2 coordinates"},
    {16, "    exponents: [[0, 0], [1, 7]]", ":16:29: error[E_SCHEMA]: got '7'"},
    {17, "    length: [0.34]", ":17:13: error[E_SCHEMA]: "},
    {18, "    pull: {ankel_r: {exponents: [[0, 0]], x: [0], y: [-1], z: [0]}}",
     ":18:21: error[E_SCHEMA]: no joint 'ankel_r' among the file's 'joints'\n"
     "  hint: did you mean 'ankle_r'?"},
    {18, "    pull: {ankle_r: {exponents: [[0, 0]], x: [0], y: [-1]}}",
     ":18:21: error[E_SCHEMA]: missing required key 'z'"},
    {18, "    elastic: knee_angle_r\n    tendon_strain: 0.05",
     ":11:5: error[E_MODEL]: muscle 'soleus_r': elastic"}};

static void write_with(const char *path, int line, const char *text) {
  char all[4000];
  size_t used = 0;
  for (int i = 1; i <= LINES; i++)
    used += (size_t)snprintf(all + used, sizeof all - used, "%s\n", i == line ? text : good[i - 1]);
  scratch_write(path, all);
}

static void every_fault_has_its_place(void **state) {
  const char *path = scratch_path(state, "m.yaml");
  write_with(path, 0, "");
  ambulo_model *model = lower_body();
  ambulo_muscles *untouched = NULL;
  assert_int_equal(ambulo_muscles_load(path, model, NULL, NULL, &untouched), AMBULO_OK);
  ambulo_muscles *const before = untouched;
  for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
    char expected[1000];
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    write_with(path, faults[i].line, faults[i].text);
    ambulo_status status = ambulo_muscles_load(path, model, NULL, list, &untouched);
    (void)snprintf(expected, sizeof expected, "%s%s", path, faults[i].message);
    assert_message(list, 0, expected);
    assert_int_equal(status, strstr(expected, "E_MODEL") ? AMBULO_E_MODEL : AMBULO_E_SCHEMA);
    assert_ptr_equal(untouched, before);
    ambulo_diagnostics_free(list);
  }
  ambulo_muscles_free(before);
  ambulo_model_free(model);
}

/* what a list may hold at most is said, not cut off */
static void limits_are_told(void **state) {
  const char *path = scratch_path(state, "m.yaml");
  ambulo_model *model = lower_body();
  for (int limit = 0; limit < 2; limit++) {
    char expected[600];
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int i = 0; i < LINES; i++)
      if (limit == 0 || i != 8) fprintf(file, "%s\n", good[i]);
    if (limit == 1) {
      fprintf(file, "joints:\n");
      for (int i = 0; i < 9; i++) fprintf(file, "  j%d: {link: talus_r, axes: shank_r}\n", i);
    }
    for (int i = 1; limit == 0 && i <= 500; i++)
      fprintf(file,
              "  - {name: m%d_r, force: 1, fiber: 0.1, tendon: 0, coordinates: [ankle_angle_r], "
              "exponents: [[0]], length: [1]}\n",
              i);
    fclose(file);
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo_muscles *none = NULL;
    assert_int_equal(ambulo_muscles_load(path, model, NULL, list, &none), AMBULO_E_LIMIT);
    (void)snprintf(expected, sizeof expected, "%s:%s", path,
                   limit == 0 ? "11:3: error[E_LIMIT]: 501 muscles; expected at most 500"
                              : "19:3: error[E_LIMIT]: 9 joints; expected at most 8");
    assert_message(list, 0, expected);
    assert_null(none);
    ambulo_diagnostics_free(list);
  }
  ambulo_model_free(model);
}

/* the shipped file: many chunks of memory */
static void memory_may_run_out_anywhere(void **state) {
  (void)state;
  ambulo_model *model = lower_body();
  long refused = 0;
  for (int once = 0; once < 2; once++)
    for (long k = 0;; k++) {
      assert_in_range(k, 0, 5000);
      fail_alloc memory = fail_alloc_at(k);
      memory.only_once = once;
      ambulo_allocator hook = fail_alloc_hook(&memory);
      ambulo_muscles *muscles = NULL;
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      ambulo_status status =
          ambulo_muscles_load("models/leg_muscles.yaml", model, &hook, list, &muscles);
      assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
      assert_int_equal(muscles != NULL, status == AMBULO_OK);
      if (status) assert_message(list, 0, "error[E_MEMORY]");
      ambulo_muscles_free(muscles);
      ambulo_diagnostics_free(list);
      assert_int_equal(memory.live, 0);
      refused += memory.failed;
      if (!memory.failed) break;
    }
  assert_true(refused > 40);
  ambulo_model_free(model);
}

static void arguments(void **state) {
  (void)state;
  ambulo_model *model = lower_body();
  ambulo_muscles *none = NULL;
  assert_int_equal(ambulo_muscles_load(NULL, model, NULL, NULL, &none), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_muscles_load("models/leg_muscles.yaml", NULL, NULL, NULL, &none),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_muscles_load("models/leg_muscles.yaml", model, NULL, NULL, NULL),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_muscles_load("models/none.yaml", model, NULL, NULL, &none), AMBULO_E_IO);
  assert_null(none);
  ambulo_model_free(model);
}

/* a body with one leg has no place for the muscles of the other */
static void a_side_without_its_image_is_refused(void **state) {
  const char *path = scratch_path(state, "m.yaml");
  model_case leg = model_good(MODEL_HEAD "links:\n  - {name: knee_r, parent: none, joint: "
                                         "revolute, dh: [0, 0, 0.4, 0], " MODEL_BODY "}\n");
  scratch_write(path, "ambulo: 1\nkind: muscles\nname: m\nsource: [own]\nlicense: CC0-1.0\n"
                      "subject: {mass: 75, thigh: 0.4, shank: 0.45}\nmirror: {_r: _l}\n"
                      "joints: {}\nmuscles:\n  - {name: bfsh_r, force: 1, fiber: 0.1, tendon: 0,\n"
                      "     coordinates: [knee_r], exponents: [[0], [1]], length: [0.1, 0.01]}\n");
  char expected[600];
  ambulo_muscles *none = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_muscles_load(path, leg.model, NULL, list, &none), AMBULO_E_MODEL);
  (void)snprintf(expected, sizeof expected,
                 "%s:11:20: error[E_MODEL]: coordinate 'knee_r' of model 't' has no mirror image",
                 path);
  assert_message(list, 0, expected);
  assert_null(none);
  ambulo_diagnostics_free(list);
  model_shut(&leg);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {
      SCRATCH_TEST(every_fault_has_its_place),
      SCRATCH_TEST(limits_are_told),
      cmocka_unit_test(memory_may_run_out_anywhere),
      SCRATCH_TEST(a_side_without_its_image_is_refused),
      cmocka_unit_test(arguments),
  };
  return cmocka_run_group_tests_name("definitions/muscle_file_faults", tests, NULL, NULL);
}
