/* External loads of OpenSim: which table, which columns, which foot. */
#include "support/fail_alloc.h"
#include "ambulo/tools/load.h"
#include "support/import_case.h"

static ambulo_model *body(void) {
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  return model;
}

#define FORCE(name, body, more, f, p, t)                                                           \
  "<ExternalForce name='" name "'><applied_to_body>" body "</applied_to_body>" more                \
  "<force_identifier>" f "</force_identifier><point_identifier>" p                                 \
  "</point_identifier><torque_identifier>" t "</torque_identifier></ExternalForce>"
#define LOADS(inner, table)                                                                        \
  "<OpenSimDocument Version='40000'><ExternalLoads name='l'><objects>" inner "</objects>" table    \
  "</ExternalLoads></OpenSimDocument>"
#define TABLE "<datafile>grf.mot</datafile>"

typedef struct loads_case {
  ambulo_status status;
  ambulo_diagnostics *list;
  char *forces, *columns;
} loads_case;

static loads_case read_loads(void **state, const char *xml) {
  loads_case c = {AMBULO_OK, ambulo_diagnostics_create(NULL), NULL, NULL};
  ambulo_model *model = body();
  const char *path = scratch_path(state, "loads.xml");
  skip_without_expat();
  scratch_write(path, xml);
  c.status = ambulo_import_external_loads(path, model, NULL, c.list, &c.forces, &c.columns);
  ambulo_model_free(model);
  return c;
}

static void shut(loads_case *c) {
  ambulo_text_free(c->forces, NULL);
  ambulo_text_free(c->columns, NULL);
  ambulo_diagnostics_free(c->list);
}

static void good(void **state, const char *xml, const char *columns, const char *forces) {
  loads_case c = read_loads(state, xml);
  assert_int_equal(c.status, AMBULO_OK);
  assert_string_equal(c.columns, columns);
  assert_string_equal(c.forces, forces[0] == '/' ? forces : scratch_path(state, forces));
  shut(&c);
}

static void feet(void **state) {
  /* by the link's name, by a path, by the side of a body that the model has not */
  good(state,
       LOADS(FORCE("a", "foot_r", "", "ground_force_v", "ground_force_p", "ground_torque_")
                 FORCE("b", "/bodyset/calcn_l", "", "1_ground_force_v", "Unassigned", ""),
             TABLE),
       "right=ground_force_v:ground_force_p:ground_torque_,left=1_ground_force_v::", "grf.mot");
  /* two plates under one foot, none under the other */
  good(state,
       LOADS(FORCE("a", "calcn_l", "", "f1v", "f1p", "f1m") FORCE("b", "toes_l", "", "f2v", "", ""),
             TABLE),
       "right=none,left=f1v:f1p:f1m+f2v::", "grf.mot");
}

static void left_out(void **state) {
  loads_case c = read_loads(
      state, LOADS(FORCE("a", "foot_r", "<isDisabled>true</isDisabled>", "av", "", "") FORCE(
                       "b", "foot_r", "<appliesForce>false</appliesForce>", "bv", "", "")
                       FORCE("c", "hand_r", "", "cv", "", "") FORCE("d", "thorax", "", "dv", "", "")
                           FORCE("e", "foot_l", "", "ev", "", ""),
                   TABLE));
  assert_int_equal(c.status, AMBULO_OK);
  assert_string_equal(c.columns, "right=none,left=ev::");
  assert_int_equal(ambulo_diagnostics_count(c.list), 4);
  assert_message(c.list, 0, "warning: force 'a' on 'foot_r' is switched off");
  assert_message(c.list, 1, "warning: force 'b' on 'foot_r' is switched off");
  assert_message(c.list, 2, "force 'c' acts on 'hand_r', which is not a foot");
  assert_message(c.list, 3, "force 'd' acts on 'thorax', which is not a foot");
  shut(&c);
}

/* the table is beside the file, under its name where its folder is another machine's */
static void tables(void **state) {
  static const char one[] = FORCE("a", "foot_r", "", "v", "", "");
  scratch_write(scratch_path(state, "walk.mot"), "");
  char xml[1000];
  (void)snprintf(xml, sizeof xml, LOADS("%s", "<datafile>C:\\data\\walk.mot</datafile>"), one);
  good(state, xml, "right=v::,left=none", "walk.mot");
  (void)snprintf(xml, sizeof xml, LOADS("%s", "<datafile>/no/such.mot</datafile>"), one);
  good(state, xml, "right=v::,left=none", "/no/such.mot");
}

static void bad(void **state, const char *xml, const char *want) {
  loads_case c = read_loads(state, xml);
  assert_int_equal(c.status, AMBULO_E_SCHEMA);
  assert_null(c.forces);
  assert_null(c.columns);
  assert_message(c.list, 0, want);
  shut(&c);
}

static void faults(void **state) {
  bad(state, "<OpenSimDocument><Model/></OpenSimDocument>",
      "this is not a file of external loads (got <Model>)");
  bad(state, LOADS(FORCE("a", "foot_r", "", "v", "p", "t"), ""), "no <datafile>");
  bad(state, LOADS("", TABLE), "no force acts on a foot of the model 'lower_body_18'");
  bad(state, LOADS(FORCE("a", "foot_r", "", "", "p", "t"), TABLE), "<force_identifier> is ''");
  bad(state, LOADS(FORCE("a", "foot_r", "", "v", "p:q", "t"), TABLE),
      "<point_identifier> is 'p:q'");
  bad(state,
      LOADS(FORCE("a", "foot_r", "<force_expressed_in_body>calcn_r</force_expressed_in_body>", "v",
                  "p", "t"),
            TABLE),
      "<force_expressed_in_body> is 'calcn_r'");
  bad(state,
      LOADS(FORCE("a", "foot_r", "<point_expressed_in_body>/bodyset/x</point_expressed_in_body>",
                  "v", "p", "t"),
            TABLE),
      "<point_expressed_in_body> is 'x'");
}

static void arguments(void **state) {
  (void)state;
  ambulo_model *model = body();
  char *a = NULL, *b = NULL;
  assert_int_equal(ambulo_import_external_loads(NULL, model, NULL, NULL, &a, &b),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_import_external_loads("x", NULL, NULL, NULL, &a, &b), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_import_external_loads("x", model, NULL, NULL, NULL, &b),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_import_external_loads("x", model, NULL, NULL, &a, NULL),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_import_external_loads("no/such.xml", model, NULL, NULL, &a, &b),
                   AMBULO_E_IO);
  ambulo_model_free(model);
}

static void memory_may_run_out_anywhere(void **state) {
  skip_without_expat();
  ambulo_model *model = body();
  const char *path = scratch_path(state, "loads.xml");
  scratch_write(path, LOADS(FORCE("a", "foot_r", "", "v", "p", "t"), TABLE));
  for (long k = 0; k < 1000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    char *forces = NULL, *columns = NULL;
    ambulo_status status =
        ambulo_import_external_loads(path, model, &allocator, NULL, &forces, &columns);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo_text_free(forces, &allocator);
    ambulo_text_free(columns, &allocator);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(feet),      cmocka_unit_test(left_out),
      cmocka_unit_test(tables),    cmocka_unit_test(faults),
      cmocka_unit_test(arguments), cmocka_unit_test(memory_may_run_out_anywhere)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
