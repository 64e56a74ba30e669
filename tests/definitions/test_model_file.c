#include "support/fail_alloc.h"
#include "ambulo/tools/load.h"
#include "support/model_text.h"

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

static void header(void **state) {
  (void)state;
  model_case c = model_good("ambulo: 1\nkind: model\nname: t-1.b\nsource: [one, \"two: x\"]\n"
                            "gravity: [0, 0, -1.62]\nforward: [0, 2, 0]\n"
                            "units: {angle: degrees}\n" MODEL_ROD);
  assert_string_equal(ambulo_model_name(c.model), "t-1.b");
  assert_close(ambulo_model_gravity(c.model)[2], -1.62, 0);
  assert_close(ambulo_model_up(c.model)[2], 1, 0);
  assert_close(ambulo_model_forward(c.model)[1], 1, 0);
  assert_close(ambulo_model_left(c.model)[0], -1, 0);
  assert_close(ambulo_model_stature(c.model), 0, 0);
  model_shut(&c);
  c = model_good(MODEL_HEAD MODEL_ROD "source: one\n");
  assert_close(ambulo_model_gravity(c.model)[1], -9.81, 0);
  model_shut(&c);
}

static void broken_headers(void **state) {
  (void)state;
  model_bad("ambulo: 2\nname: t\nunits: {angle: degrees}\n" MODEL_ROD, AMBULO_E_SCHEMA,
            "t.yaml:1:9: error[E_SCHEMA]: got '2'; expected one of: 1");
  model_bad("name: t\nunits: {angle: degrees}\n" MODEL_ROD, AMBULO_E_SCHEMA,
            "t.yaml:1:1: error[E_SCHEMA]: missing required key 'ambulo'");
  model_bad(MODEL_HEAD MODEL_ROD "kind: problem\n", AMBULO_E_SCHEMA,
            "t.yaml:6:7: error[E_SCHEMA]: this is a problem; expected a skeleton model");
  model_bad("ambulo: 1\nname: t t\nunits: {angle: degrees}\n" MODEL_ROD, AMBULO_E_SCHEMA,
            "t.yaml:2:7: error[E_SCHEMA]: got 't t'; expected a name");
  model_bad("ambulo: 1\nname: t\n" MODEL_ROD, AMBULO_E_SCHEMA,
            "t.yaml:1:1: error[E_SCHEMA]: missing required key 'units'");
  model_bad(MODEL_HEAD, AMBULO_E_SCHEMA,
            "t.yaml:1:1: error[E_SCHEMA]: missing required key 'links'");
  model_bad(MODEL_HEAD "links: 3\n", AMBULO_E_SCHEMA,
            "t.yaml:4:8: error[E_SCHEMA]: `links` is not a list");
  model_bad(MODEL_HEAD MODEL_ROD "gravty: [0, 0, 0]\n", AMBULO_E_SCHEMA,
            "t.yaml:6:1: error[E_SCHEMA]: unknown key 'gravty'");
  model_bad(MODEL_HEAD MODEL_ROD "gravity: [0, 0, 0]\n", AMBULO_E_MODEL,
            "t.yaml:1:1: error[E_MODEL]: gravity must be finite and not zero");
  model_bad(MODEL_HEAD MODEL_ROD "forward: [0, 1, 0]\n", AMBULO_E_MODEL,
            "t.yaml:1:1: error[E_MODEL]: the walking direction `forward` must not be zero");
  model_bad(MODEL_HEAD MODEL_ROD "source: {a: b}\n", AMBULO_E_SCHEMA,
            "t.yaml:6:9: error[E_SCHEMA]: got a mapping; expected a text");
}

/* a reader goes on after a fault: one run shows them all, in the order of reading */
static void all_faults_at_once(void **state) {
  (void)state;
  model_case c = model_open("ambulo: 1\nname: ''\nunits: {angle: turns}\nlinks:\n"
                            "  - {name: rod, parent: nowhere, joint: hinge, dh: [0, 0, 0]}\n"
                            "points:\n  - {name: tip, link: rud, position: x}\n");
  static const char *const want[] = {
      ":2:7: ", ":3:16: ", ":5:41: ", ":5:25: ", ":5:52: ", ":7:23: ", ":7:38: "};
  assert_int_equal(ambulo_status_exit_code(c.status), 3);
  for (size_t i = 0; i < 7; i++) assert_message(c.list, i, want[i]);
  assert_int_equal(ambulo_diagnostics_count(c.list), 7);
  model_shut(&c);
}

static void too_many(void **state) {
  (void)state;
  enum { ITEMS = 4097 };
  char *text = malloc(200 + 3 * ITEMS), *at = text;
  at += sprintf(at, "%slinks: [", MODEL_HEAD);
  for (int i = 0; i < ITEMS; i++) at += sprintf(at, i ? ",1" : "1");
  sprintf(at, "]\n");
  model_bad(text, AMBULO_E_LIMIT,
            "t.yaml:4:8: error[E_LIMIT]: too many links (got 4097); expected at most 4096");
  free(text);
}

static void files(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_model_load("no/such.yaml", NULL, NULL, list, &model), AMBULO_E_IO);
  assert_message(list, 0, "no/such.yaml: error[E_IO]");
  assert_int_equal(ambulo_model_load(".", NULL, NULL, list, &model), AMBULO_E_IO);
  assert_int_equal(ambulo_model_load(NULL, NULL, NULL, list, &model), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_model_load("x", NULL, NULL, list, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_model_load_text(NULL, 0, "x", NULL, NULL, list, &model),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_model_load_text("a: [", 4, "x", NULL, NULL, list, &model),
                   AMBULO_E_PARSE);
  assert_null(model);
  ambulo_diagnostics_free(list);
}

/* every prefix of a file is refused or, at the end of an item, a smaller model; none crashes */
static void truncated(void **state) {
  (void)state;
  static const char text[] =
      MODEL_HEAD MODEL_ROD "points:\n  - {name: tip, link: rod, position: [0, 0, 0]}\n";
  for (size_t length = 0; length < sizeof text; length++) {
    ambulo_model *model = NULL;
    ambulo_status status = ambulo_model_load_text(text, length, "t.yaml", NULL, NULL, NULL, &model);
    assert_int_equal(status == AMBULO_OK, model != NULL);
    ambulo_model_free(model);
  }
}

static void values_are_replaced(void **state) {
  (void)state;
  static const char file[] = AMBULO_SOURCE_DIR "/models/walker_2d.yaml";
  static const char *const good[] = {"gravity=[0, -1.62, 0]", "model.name=lunar"};
  static const char *const bad[] = {"gravity", "=1", "gravty=[0, 0, 0]", "gravity=[0, 0]",
                                    "links[nowhere].body.mass=4"};
  ambulo_model *model = NULL;
  ambulo_subject subject = {.size = sizeof(ambulo_subject), .mass = 60.0, .stature = AMBULO_OFF};
  assert_int_equal(ambulo_model_load_with(file, good, 2, &subject, NULL, NULL, &model), AMBULO_OK);
  assert_close(ambulo_model_gravity(model)[1], -1.62, 0.0);
  assert_string_equal(ambulo_model_name(model), "lunar");
  ambulo_model_free(model);
  for (int i = 0; i < 5; i++) {
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    model = NULL;
    assert_int_equal(ambulo_model_load_with(file, &bad[i], 1, NULL, NULL, list, &model),
                     i < 2 ? AMBULO_E_ARGUMENT : AMBULO_E_SCHEMA);
    assert_null(model);
    assert_message(list, 0, i < 2 ? "expected path=value" : i == 2 ? "'gravty'" : "--set ");
    ambulo_diagnostics_free(list);
  }
}

static void memory_runs_out(void **state) {
  (void)state;
  static const char *const overrides[] = {"model.name=other"};
  for (int once = 0; once < 2; once++) {
    long k = 0;
    for (;; k++) {
      fail_alloc memory = fail_alloc_at(k);
      memory.only_once = once;
      ambulo_allocator allocator = fail_alloc_hook(&memory);
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      ambulo_model *model = NULL;
      ambulo_status status = ambulo_model_load_with(AMBULO_SOURCE_DIR "/models/walker_2d.yaml",
                                                    overrides, 1, NULL, &allocator, list, &model);
      ambulo_diagnostics_free(list);
      if (status != AMBULO_OK) assert_int_equal(status, AMBULO_E_MEMORY);
      assert_int_equal(model != NULL, status == AMBULO_OK);
      ambulo_model_free(model);
      assert_int_equal(memory.live, 0);
      if (!memory.failed) break;
    }
    assert_in_range(k, 15, 5000);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(header),
                                     cmocka_unit_test(broken_headers),
                                     cmocka_unit_test(too_many),
                                     cmocka_unit_test(all_faults_at_once),
                                     cmocka_unit_test(files),
                                     cmocka_unit_test(truncated),
                                     cmocka_unit_test(values_are_replaced),
                                     cmocka_unit_test(memory_runs_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
