/* ambulo_import_model: arguments, files whole or not at all, memory that runs out anywhere. */
#include "support/fail_sites.h"
#include "ambulo/tools/load.h"
#include "support/import_case.h"

static const char *const sources[] = {
    "tests/import/every_joint.urdf", "tests/import/every_joint.xml",
    "tests/import/every_joint_v3.osim", "tests/import/every_joint_v4.osim"};

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

/* lists that are not there, of a negative length, and roots that are none */
static void options_that_are_none(void **state) {
  (void)state;
  const char *const word = "a=b";
  for (int i = 0; i < 10; i++) {
    ambulo_import_options o = ambulo_import_options_default();
    int *const counts[] = {&o.pose_count, &o.foot_count, &o.heel_count, &o.toe_count};
    const char *const **const lists[] = {&o.pose, &o.feet, &o.heels, &o.toes};
    char *text = NULL;
    if (i < 4) *counts[i] = 1; /* of no list */
    if (i >= 4 && i < 8) {
      *counts[i - 4] = -1;
      *lists[i - 4] = &word;
    }
    if (i == 8) o.root = (ambulo_import_root)(AMBULO_ROOT_FIXED + 1);
    if (i == 9) o.root = (ambulo_import_root)-1;
    assert_int_equal(ambulo_import_model(sources[0], NULL, &o, NULL, NULL, &text),
                     AMBULO_E_ARGUMENT);
    assert_null(text);
  }
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

static ambulo_status import_once(const ambulo_allocator *allocator, void *path) {
  char *text = NULL;
  ambulo_status status = ambulo_import_model(path, NULL, NULL, allocator, NULL, &text);
  assert_int_equal(text != NULL, status == AMBULO_OK);
  ambulo_text_free(text, allocator);
  return status;
}

static void memory_may_run_out_anywhere(void **state) {
  static fail_sites sites;
  skip_without_expat();
  scratch_write(scratch_path(state, "leg.xml"),
                "<mujocoinclude><body name='leg'><joint name='hip'/><geom size='1'/></body>"
                "</mujocoinclude>");
  scratch_write(scratch_path(state, "all.xml"),
                "<mujoco><worldbody><include file='leg.xml'/></worldbody><actuator><motor "
                "joint='hip' ctrlrange='-1 1'/></actuator></mujoco>");
  const char *included = scratch_path(state, "all.xml");
  for (size_t s = 0; s <= sizeof sources / sizeof sources[0]; s++) {
    char path[SCRATCH_PATH + 16];
    int last = s == sizeof sources / sizeof sources[0];
    (void)snprintf(path, sizeof path, "%s", last ? included : sources[s]);
    print_message("%s: %d places\n", path, fail_at_every_site(&sites, import_once, path, 2));
  }
}

/* Most of what an import holds is cut from chunks: a longer name in front moves the end of the
 * first chunk on, to each thing in turn that then finds no second one. */
enum { CHUNK = 32768, PADDING_STEP = 72 };

static void *one_chunk(void *user, void *pointer, size_t size) {
  fail_alloc *memory = user;
  int is_chunk = size >= CHUNK && size < CHUNK + 256;
  if (is_chunk && memory->requests > 0) memory->failed = 1;
  if (is_chunk && memory->requests++ > 0) return NULL;
  long requests = memory->requests;
  void *block = fail_alloc_resize(memory, pointer, size);
  memory->requests = requests;
  return block;
}

static void memory_may_run_out_behind_a_chunk(void **state) {
  static const char *const roots[] = {"<robot ", "<mujoco ", "<OpenSimDocument ",
                                      "<OpenSimDocument "};
  static char padded[CHUNK + 32768];
  skip_without_expat();
  for (size_t s = 0; s < sizeof sources / sizeof sources[0]; s++) {
    char *text = read_whole(sources[s]);
    char *root = strstr(text, roots[s]) + strlen(roots[s]);
    const char *path = scratch_path(state, "padded.xml");
    int failures = 0;
    for (int padding = 0; padding < CHUNK - 64; padding += PADDING_STEP) {
      (void)snprintf(padded, sizeof padded, "%.*sp='%0*d' %s", (int)(root - text), text,
                     padding + 1, 0, root);
      scratch_write(path, padded);
      fail_alloc memory = fail_alloc_at(-1);
      ambulo_allocator hook = {one_chunk, &memory};
      char *made = NULL;
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      ambulo_status status = ambulo_import_model(path, NULL, NULL, &hook, list, &made);
      if (status != (memory.failed ? AMBULO_E_MEMORY : AMBULO_OK))
        assert_message(list, 0, "out of memory");
      ambulo_diagnostics_free(list);
      assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
      assert_int_equal(made != NULL, status == AMBULO_OK);
      ambulo_text_free(made, &hook);
      assert_int_equal(memory.live, 0);
      failures += memory.failed;
    }
    assert_true(failures > 50);
    free(text);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(arguments),
                                     cmocka_unit_test(options_that_are_none),
                                     cmocka_unit_test(without_expat),
                                     cmocka_unit_test(files),
                                     cmocka_unit_test(names),
                                     cmocka_unit_test(memory_may_run_out_anywhere),
                                     cmocka_unit_test(memory_may_run_out_behind_a_chunk)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
