/* Whatever step on a file or request of memory fails: an inverse dynamics says so, leaves the old
 * table or the whole new one, and nothing besides. */
#define _GNU_SOURCE
#include "ambulo/tools/tools.h"
#include "support/fail_alloc.h"
#include "support/fail_io.h"
#include "support/messages.h"
#include "support/scratch.h"

static const char old_table[] = "# ambulo motion: an old table\n";

typedef struct files {
  const char *model, *motion, *forces, *output;
} files;

static files make_files(void **state) {
  files f = {"models/opensim_2d_gait10.yaml", scratch_path(state, "motion.csv"),
             scratch_path(state, "forces.csv"), scratch_path(state, "torques.csv")};
  FILE *file = fopen(f.motion, "w");
  assert_non_null(file);
  fprintf(file, "time,pelvis_tx,pelvis_ty,pelvis_tilt,lumbar,hip_flexion_r,knee_angle_r,"
                "ankle_angle_r,hip_flexion_l,knee_angle_l,ankle_angle_l\n");
  for (int k = 0; k < 10; k++)
    fprintf(file, "%g,0.3,0.9,0,0,0.6,0,0,-0.6,0,%g\n", 0.01 * k, 0.01 * k);
  fclose(file);
  scratch_write(f.forces, "time,ground_force_r_vx,ground_force_r_vy,ground_force_r_px,"
                          "ground_force_r_py,ground_torque_r_z,ground_force_l_vx,ground_force_l_vy,"
                          "ground_force_l_px,ground_force_l_py,ground_torque_l_z\n"
                          "0,0,300,0.6,0,0,0,300,0.1,0,0\n0.05,0,300,0.6,0,0,0,300,0.1,0,0\n"
                          "0.1,0,300,0.6,0,0,0,300,0.1,0,0\n");
  return f;
}

/* the whole path that the command takes */
static ambulo_status run(const files *f, const ambulo_allocator *allocator,
                         ambulo_diagnostics *list, int *loaded) {
  ambulo_model *model = NULL;
  ambulo_inverse_options options = ambulo_inverse_options_default();
  options.forces = f->forces;
  options.cutoff = options.force_cutoff = 4.0;
  static const char *const overrides[] = {"links[torso].body.mass=28.2403"};
  ambulo_status status =
      ambulo_model_load_with(f->model, overrides, 1, NULL, allocator, list, &model);
  *loaded = status == AMBULO_OK;
  if (!status)
    status = ambulo_inverse_dynamics_motion(model, f->motion, f->output, &options, allocator, list,
                                            NULL);
  ambulo_model_free(model);
  return status;
}

static char *contents(const char *path) {
  static char text[1 << 16];
  FILE *file = fopen(path, "r");
  if (!file) return NULL;
  text[fread(text, 1, sizeof text - 1, file)] = '\0';
  fclose(file);
  return text;
}

static void every_step_on_files_may_fail(void **state) {
  files f = make_files(state);
  int faults = 0, loaded;
  assert_int_equal(run(&f, NULL, NULL, &loaded), AMBULO_OK);
  char *good = strdup(contents(f.output));
  for (int at = 0; at < 2 * FAIL_IO_STEPS; at++) {
    int step = at / 2, replace = at % 2;
    for (long k = 0;; k++) {
      assert_in_range(k, 0, 60);
      unlink(f.output);
      if (replace) scratch_write(f.output, old_table);
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      fail_io_arm(step, k);
      ambulo_status status = run(&f, NULL, list, &loaded);
      int failed = fail_io_disarm();
      const char *text = contents(f.output);
      faults += failed;
      int whole = text && strcmp(text, good) == 0, kept = text && strcmp(text, old_table) == 0;
      if (status == AMBULO_OK) {
        assert_true(whole); /* a closed descriptor that complains changes nothing any more */
      } else {
        assert_true(failed);
        assert_int_equal(status, AMBULO_E_IO);
        assert_true(ambulo_diagnostics_error_count(list) > 0);
        assert_true(whole || (replace ? kept : !text));
      }
      /* what cannot be told to be its own is not written over */
      assert_int_equal(entries_in(*state), 2 + (text != NULL));
      ambulo_diagnostics_free(list);
      if (!failed) break;
    }
  }
  assert_true(faults > 30);
  free(good);
}

/* how often the model alone asks for memory */
static long requests_of_loading(const files *f) {
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator hook = fail_alloc_hook(&memory);
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load_with(f->model, NULL, 0, NULL, &hook, NULL, &model), AMBULO_OK);
  ambulo_model_free(model);
  return memory.requests;
}

static void every_request_of_memory_may_fail(void **state) {
  files f = make_files(state);
  long faults = 0, loading = requests_of_loading(&f);
  int loaded;
  assert_int_equal(run(&f, NULL, NULL, &loaded), AMBULO_OK);
  char *good = strdup(contents(f.output));
  for (int once = 0; once < 2; once++) {
    for (long k = 0;; k++) {
      assert_in_range(k, 0, 20000);
      fail_alloc memory = fail_alloc_at(k);
      ambulo_allocator hook = fail_alloc_hook(&memory);
      memory.only_once = once;
      scratch_write(f.output, old_table);
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      ambulo_status status = run(&f, &hook, list, &loaded);
      const char *text = contents(f.output);
      faults += memory.failed;
      assert_int_equal(memory.live, 0);
      /* once, while the model is loaded, it may be the memory for a hint alone */
      int only_a_hint = once && status == AMBULO_OK && k < loading;
      assert_int_equal(status, memory.failed && !only_a_hint ? AMBULO_E_MEMORY : AMBULO_OK);
      if (status && loaded) assert_true(ambulo_diagnostics_error_count(list) > 0);
      assert_string_equal(text ? text : "", status ? old_table : good);
      assert_int_equal(entries_in(*state), 3);
      ambulo_diagnostics_free(list);
      if (!memory.failed) break;
      /* loading the model is tested elsewhere: only every seventh of its requests */
      if (!loaded) k += 6;
    }
  }
  assert_true(faults > 100);
  free(good);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {SCRATCH_TEST(every_step_on_files_may_fail),
                                     SCRATCH_TEST(every_request_of_memory_may_fail)};
  return cmocka_run_group_tests_name("inverse/inverse_faults", tests, NULL, NULL);
}
