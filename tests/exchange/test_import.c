/* ambulo_import_model: arguments, files whole or not at all, memory that runs out anywhere. */
#include "support/fail_alloc.h"
#include "ambulo/tools/load.h"
#include "support/import_case.h"

static const char *const sources[] = {
    "tests/exchange/every_joint.urdf", "tests/exchange/every_joint.xml",
    "tests/exchange/every_joint_v3.osim", "tests/exchange/every_joint_v4.osim"};

static void arguments(void **state) {
  (void)state;
  char *text = NULL;
  ambulo_import_options none = {0}, odd = ambulo_import_options_default();
  odd.foot_count = 1;
  assert_int_equal(ambulo_import_model(NULL, NULL, NULL, NULL, NULL, &text), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_import_model("", NULL, NULL, NULL, NULL, &text), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_import_model("x", NULL, NULL, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_import_model("x", "", NULL, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_import_model("x", NULL, &none, NULL, NULL, &text), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_import_model("x", NULL, &odd, NULL, NULL, &text), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_import_model("no/such.urdf", NULL, NULL, NULL, NULL, &text), AMBULO_E_IO);
  assert_null(text);
}

/* without expat every file is refused in words */
static void without_expat(void **state) {
  (void)state;
  if (reads_xml()) skip();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  char *text = NULL;
  assert_int_equal(ambulo_import_model(sources[0], NULL, NULL, NULL, list, &text), AMBULO_E_IO);
  assert_message(list, 0, "cannot read XML: this ambulo was built without expat");
  ambulo_diagnostics_free(list);
}

static void files(void **state) {
  skip_without_expat();
  const char *output = scratch_path(state, "m.yaml"), *bad = scratch_path(state, "bad.urdf");
  scratch_write(bad, "<robot><link name='a'/></robot>");
  assert_int_equal(ambulo_import_model(bad, output, NULL, NULL, NULL, NULL), AMBULO_E_MODEL);
  assert_int_equal(entries_in(*state), 1); /* nothing is written */
  assert_int_equal(ambulo_import_model(sources[0], output, NULL, NULL, NULL, NULL), AMBULO_OK);
  assert_int_equal(ambulo_import_model(sources[1], output, NULL, NULL, NULL, NULL), AMBULO_E_IO);
  char *text = read_whole(output);
  assert_non_null(strstr(text, "URDF")); /* somebody may have changed it since */
  free(text);
  scratch_write(output, "mine\n");
  ambulo_import_options options = ambulo_import_options_default();
  assert_int_equal(ambulo_import_model(sources[0], output, &options, NULL, NULL, NULL),
                   AMBULO_E_IO);
  assert_file_equal(output, "mine\n");
  options.overwrite = 1;
  options.name = "my robot";
  assert_int_equal(ambulo_import_model(sources[0], output, &options, NULL, NULL, NULL), AMBULO_OK);
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load(output, NULL, NULL, NULL, &model), AMBULO_OK);
  assert_string_equal(ambulo_model_name(model), "my_robot");
  ambulo_model_free(model);
  assert_int_equal(entries_in(*state), 2);
}

/* names of other programs: spaces, the world, twice the same */
static void names(void **state) {
  import_case c = import_good(
      state,
      "<mujoco model='a b'><worldbody><body name='none'><joint name='q 1'/><geom size='1'/></body>"
      "<body name='none'><joint name='q-1'/><joint name='q 1' axis='1 0 0'/><geom size='1'/></body>"
      "<body name='leg'><joint axis='1 1 0'/><geom size='1'/></body>"
      "<body name='leg.turn'><joint axis='1 0 0'/><geom size='1'/></body>"
      "<body name='azAZ09_-.x@[`{/:'><joint axis='1 0 0'/><geom size='1'/></body>"
      "</worldbody></mujoco>");
  assert_true(ambulo_model_find_link(c.model, "leg_turn") >= 0); /* a row of leg has the other */
  assert_true(ambulo_model_find_link(c.model, "azAZ09_-.x______") >= 0);
  assert_string_equal(ambulo_model_name(c.model), "a_b");
  assert_true(ambulo_model_find_link(c.model, "base") >= 0);
  assert_true(ambulo_model_find_link(c.model, "base_2") >= 0);
  assert_true(ambulo_model_find_coordinate(c.model, "q_1") >= 0);
  assert_true(ambulo_model_find_coordinate(c.model, "q_1_2") >= 0);
  import_shut(&c);
}

static void memory_may_run_out_anywhere(void **state) {
  (void)state;
  skip_without_expat();
  for (size_t s = 0; s < sizeof sources / sizeof sources[0]; s++) {
    for (long k = 0; k < 100000; k += k < 200 ? 1 : 17) {
      fail_alloc memory = fail_alloc_at(k);
      ambulo_allocator allocator = fail_alloc_hook(&memory);
      char *text = NULL;
      ambulo_status status = ambulo_import_model(sources[s], NULL, NULL, &allocator, NULL, &text);
      if (status == AMBULO_OK)
        ambulo_text_free(text, &allocator);
      else
        assert_int_equal(status, AMBULO_E_MEMORY);
      assert_int_equal(memory.live, 0);
      if (!memory.failed) break;
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(arguments), cmocka_unit_test(without_expat),
                                     cmocka_unit_test(files), cmocka_unit_test(names),
                                     cmocka_unit_test(memory_may_run_out_anywhere)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
