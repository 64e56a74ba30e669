/* ambulo_export: models of random trees come back by the import with the same torques; motions;
 * what is refused; files whole or not at all. */
#include "mechanics/lagrangian.h"
#include "model/model.h"
#include "ambulo/tools/export.h"
#include "ambulo/tools/load.h"
#include "support/fail_sites.h"
#include "support/import_case.h"
#include "support/messages.h"
#include "support/random_model.h"
#include "support/scratch.h"
#include "support/still_walker.h"

#include <sys/stat.h>

static ambulo_export_options options_of(ambulo_export_format format) {
  ambulo_export_options o = ambulo_export_options_default();
  o.format = format;
  o.overwrite = 1;
  return o;
}

/* ---------------------------------------------------------------------- round trips */

/* tau of a model in the order of another's coordinates, by the plain recursion of the Lagrangian */
static void torques(const ambulo_model *model, const ambulo_model *order, const double *state,
                    double *tau) {
  enum { MOST = 64 };
  double q[3][MOST], own[MOST];
  int d = ambulo_model_coordinate_count(order);
  for (int i = 0; i < d; i++) {
    int at = ambulo_model_find_coordinate(model, ambulo_model_coordinate(order, i)->name);
    assert_true(at >= 0);
    for (int k = 0; k < 3; k++) q[k][at] = state[k * d + i];
  }
  void *scratch = malloc(ambulo__lagrangian_scratch_size(model));
  assert_int_equal(ambulo__lagrangian(0, model, q[0], q[1], q[2],
                                      &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = own},
                                      scratch),
                   AMBULO_OK);
  free(scratch);
  for (int i = 0; i < d; i++)
    tau[i] = own[ambulo_model_find_coordinate(model, ambulo_model_coordinate(order, i)->name)];
}

static void compare_models(const ambulo_model *a, const ambulo_model *b, random_source *source) {
  enum { MOST = 64 };
  double state[3 * MOST] = {0}, one[MOST], two[MOST], size = 1.0;
  int d = ambulo_model_coordinate_count(a);
  assert_int_equal(ambulo_model_coordinate_count(b), d);
  for (int i = 0; i < 3 * d; i++) state[i] = random_between(source, -2, 2);
  torques(a, a, state, one);
  torques(b, a, state, two);
  for (int i = 0; i < d; i++) size = fmax(size, fabs(one[i]));
  for (int i = 0; i < d; i++) assert_close(two[i] / size, one[i] / size, 1e-12);
}

static void there_and_back(void **state, uint64_t seed, ambulo_export_format format) {
  random_tree *tree = malloc(sizeof *tree);
  random_source source = {seed};
  ambulo_model *model = NULL;
  ambulo_export_options o = options_of(format);
  const char *file = scratch_path(state, "m.xml");
  random_tree_make(tree, seed, 1 + (int)(seed % 9));
  if (seed % 3 == 0) random_tree_put_on_root(tree, seed);
  /* a URDF's gravity is its reader's */
  memcpy(tree->definition.gravity, (double[]){0, -9.81, 0}, sizeof tree->definition.gravity);
  for (int i = 0; i < tree->definition.coordinate_count; i++)
    tree->coordinates[i].actuated = (int)(seed + (uint64_t)i) % 2;
  assert_int_equal(ambulo_model_create(&tree->definition, NULL, NULL, &model), AMBULO_OK);
  assert_int_equal(ambulo_export(model, NULL, file, &o, NULL, NULL), AMBULO_OK);
  import_case back = import_file(file, NULL);
  if (back.status) {
    print_error("seed %d\n", (int)seed);
    import_print(&back);
  }
  assert_int_equal(back.status, AMBULO_OK);
  for (int pose = 0; pose < 3; pose++) compare_models(model, back.model, &source);
  import_shut(&back);
  ambulo_model_free(model);
  free(tree);
}

static void urdf_comes_back(void **state) {
  skip_without_expat();
  for (uint64_t seed = 1; seed <= 60; seed++) there_and_back(state, seed, AMBULO_EXPORT_URDF);
}

static void opensim_comes_back(void **state) {
  skip_without_expat();
  for (uint64_t seed = 1; seed <= 60; seed++) there_and_back(state, seed, AMBULO_EXPORT_OPENSIM);
}

/* ranges, limits of torques, names; sliders of the root with their offset */
static void limits_come_back(void **state) {
  skip_without_expat();
  ambulo_model *model = NULL;
  ambulo_export_options o = options_of(AMBULO_EXPORT_OPENSIM);
  const char *file = scratch_path(state, "m.osim");
  assert_int_equal(ambulo_model_load("models/lower_body_21.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  assert_int_equal(ambulo_export(model, NULL, file, &o, NULL, NULL), AMBULO_OK);
  import_case back = import_file(file, NULL);
  assert_int_equal(back.status, AMBULO_OK);
  for (int i = 0; i < ambulo_model_coordinate_count(model); i++) {
    const ambulo_coordinate *a = ambulo_model_coordinate(model, i);
    const ambulo_coordinate *b =
        ambulo_model_coordinate(back.model, ambulo_model_find_coordinate(back.model, a->name));
    double offset = strcmp(a->name, "pelvis_ty") == 0 ? 0.534643 * 1.75 : 0.0;
    assert_non_null(b);
    for (int k = 0; k < 2; k++) {
      assert_close(b->range[k], a->range[k] + offset, 1e-12);
      if (a->actuated) assert_close(b->torque[k], a->torque[k], 1e-12 * fabs(a->torque[k]));
    }
  }
  import_shut(&back);
  ambulo_model_free(model);
}

/* a point of a link that is part of the ground is where that is */
static void markers(void **state) {
  ambulo_link links[2] = {ambulo_link_default(), ambulo_link_default()};
  ambulo_coordinate coordinate = ambulo_coordinate_default();
  ambulo_point point = {.name = "mark", .link = 0, .position = {0, 0.25, 0.125}};
  ambulo_model_definition d = ambulo_model_definition_default();
  ambulo_export_options o = options_of(AMBULO_EXPORT_OPENSIM);
  ambulo_model *model = NULL;
  const char *file = scratch_path(state, "m.osim");
  links[0].name = "post";
  links[0].parent = -1;
  links[0].type = AMBULO_FIXED;
  links[0].d = 0.5;
  links[1].name = "arm";
  links[1].type = coordinate.type = AMBULO_REVOLUTE;
  links[1].mass = links[1].inertia[0] = links[1].inertia[1] = links[1].inertia[2] = 1.0;
  coordinate.name = "q";
  d.name = "m";
  d.links = links;
  d.link_count = 2;
  d.coordinates = &coordinate;
  d.coordinate_count = d.point_count = 1;
  d.points = &point;
  assert_int_equal(ambulo_model_create(&d, NULL, NULL, &model), AMBULO_OK);
  assert_int_equal(ambulo_export(model, NULL, file, &o, NULL, NULL), AMBULO_OK);
  char *text = read_whole(file);
  const char *mark = strstr(text, "<Marker name=\"mark\">");
  assert_non_null(mark);
  assert_non_null(strstr(mark, "<socket_parent_frame>/ground</socket_parent_frame>"));
  assert_non_null(strstr(mark, "<location>0 0.25 0.625</location>"));
  free(text);
  ambulo_model_free(model);
}

/* -------------------------------------------------------------------------- motions */

/* element `index` of an array of an archive, whose bytes are not machine's but little-endian */
static double element(const char *archive, size_t length, const char *name, const char *shape,
                      size_t index) {
  for (size_t i = 0; i + 128 < length; i++) {
    if (memcmp(archive + i, name, strlen(name)) != 0) continue;
    const char *npy = archive + i + strlen(name);
    assert_memory_equal(npy, "\x93NUMPY", 6);
    assert_non_null(strstr(npy + 10, shape));
    size_t header = 10 + (size_t)(unsigned char)npy[8];
    uint64_t bits = 0;
    for (int b = 7; b >= 0; b--)
      bits = bits << 8 | (unsigned char)npy[header + 8 * index + (size_t)b];
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
  }
  fail();
  return 0.0;
}

/* z up, y left: the world's z is -y */
static void an_archive(void **state) {
  ambulo_model *model = walker();
  const char *motion = scratch_path(state, "m.csv"), *file = scratch_path(state, "m.npz");
  ambulo_export_options o = options_of(AMBULO_EXPORT_NPZ);
  scratch_write(motion, motion_text);
  assert_int_equal(ambulo_export(model, motion, file, &o, NULL, NULL), AMBULO_OK);
  FILE *in = fopen(file, "rb");
  assert_non_null(in);
  static char bytes[20000];
  size_t length = fread(bytes, 1, sizeof bytes, in);
  (void)fclose(in);
  static const double turned[7] = {0, 0, 0.1 + 0.534643 * 1.75, 0.70710678118654757,
                                   0, 0, 0.70710678118654757};
  static const int quaternion[4] = {6, 3, 4, 5};
  for (size_t i = 0; i < 7; i++) {
    size_t there = i < 3 ? i : (size_t)quaternion[i - 3];
    assert_close(element(bytes, length, "q.npy", "(5, 13, )", i), turned[i], 1e-12);
    assert_close(element(bytes, length, "qpos.npy", "(5, 13, )", i), turned[there], 1e-12);
  }
  static const double wrench[6] = {10, -20, 700, 0, 0, 3};
  static const double point[3] = {0.2, -0.05, 0};
  for (size_t i = 0; i < 6; i++)
    assert_close(element(bytes, length, "contact_wrench.npy", "(5, 2, 6, )", 3 * 12 + i), wrench[i],
                 1e-12);
  for (size_t i = 0; i < 3; i++)
    assert_close(element(bytes, length, "contact_point.npy", "(5, 2, 3, )", 3 * 6 + i), point[i],
                 1e-12);
  /* still: what is left over is weight less the plate, in the pelvis' axes */
  double rest = element(bytes, length, "tau.npy", "(5, 12, )", 3 * 12 + 1);
  assert_close(rest, 9.81 * ambulo_model_mass(model) - 700.0, 1e-9);
  /* the same moment is left over in all rows, once what the loads do about the root is added;
   * R' turns by -90 degrees about x */
  double moment[2][3];
  for (size_t r = 0; r < 2; r++) {
    size_t row = 3 * r;
    for (size_t i = 0; i < 3; i++)
      moment[r][i] = element(bytes, length, "tau.npy", "(5, 12, )", row * 12 + 3 + i);
    for (size_t load = 0; load < 2; load++) {
      double w[6], arm[3], turn[3];
      for (size_t i = 0; i < 6; i++)
        w[i] = element(bytes, length, "contact_wrench.npy", "(5, 2, 6, )", row * 12 + 6 * load + i);
      for (size_t i = 0; i < 3; i++)
        arm[i] =
            element(bytes, length, "contact_point.npy", "(5, 2, 3, )", row * 6 + 3 * load + i) -
            turned[i];
      for (size_t i = 0; i < 3; i++)
        turn[i] = arm[(i + 1) % 3] * w[(i + 2) % 3] - arm[(i + 2) % 3] * w[(i + 1) % 3] + w[3 + i];
      moment[r][0] += turn[0];
      moment[r][1] += turn[2];
      moment[r][2] -= turn[1];
    }
  }
  for (size_t i = 0; i < 3; i++) assert_close(moment[1][i], moment[0][i], 1e-9);
  ambulo_model_free(model);
}

/* ------------------------------------------------------------- refusals and files */

static void arguments(void **state) {
  ambulo_model *model = walker();
  const char *file = scratch_path(state, "x");
  ambulo_export_options none = {0}, o = options_of(AMBULO_EXPORT_URDF);
  assert_int_equal(ambulo_export(NULL, NULL, file, &o, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_export(model, NULL, NULL, &o, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_export(model, NULL, "", &o, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_export(model, "", file, &o, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_export(model, NULL, file, &none, NULL, NULL), AMBULO_E_ARGUMENT);
  o.format = AMBULO_EXPORT_FORMAT_NOT_SET;
  assert_int_equal(ambulo_export(model, NULL, file, &o, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(entries_in(*state), 0);
  ambulo_model_free(model);
}

static void refused(void **state, const char *model_file, const char *motion,
                    const ambulo_export_options *o, ambulo_status want, const char *said) {
  ambulo_model *model = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_model_load(model_file, NULL, NULL, NULL, &model), AMBULO_OK);
  assert_int_equal(ambulo_export(model, motion, scratch_path(state, "none"), o, NULL, list), want);
  assert_message(list, 0, said);
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

static void refusals(void **state) {
  const char *motion = scratch_path(state, "m.csv");
  const char *walker_file = "models/walker_2d.yaml";
  ambulo_export_options o = options_of(AMBULO_EXPORT_NPZ);
  scratch_write(motion, motion_text);
  refused(state, walker_file, NULL, &o, AMBULO_E_ARGUMENT, "an .npz holds a motion");
  o.format = AMBULO_EXPORT_URDF;
  refused(state, walker_file, motion, &o, AMBULO_E_ARGUMENT, "a URDF cannot hold a motion");
  o.free_root = 1;
  refused(state, "models/pendulum.yaml", NULL, &o, AMBULO_E_MODEL, "the root is not free");
  o.format = AMBULO_EXPORT_OPENSIM;
  refused(state, walker_file, NULL, &o, AMBULO_E_ARGUMENT, "only a URDF can have a free root");
  assert_int_equal(entries_in(*state), 1);
}

/* a problem is of the same body: its links by name, its coordinates, feet and patches by number */
static void a_problem_of_another_body(void **state) {
  ambulo_problem *problem = NULL;
  ambulo_export_options o = options_of(AMBULO_EXPORT_OPENSIM);
  assert_int_equal(
      ambulo_problem_load("tests/support/walker_2d_step.yaml", NULL, 0, NULL, NULL, &problem),
      AMBULO_OK);
  o.problem = problem;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/walker_2d.yaml", NULL, NULL, NULL, &model), AMBULO_OK);
  const ambulo_model own = *model;
  ambulo_link links[64];
  memcpy(links, own.links, (size_t)own.link_count * sizeof *links);
  links[0].name = "other";
  for (int other = 0; other < 6; other++) {
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    *model = own;
    if (other == 1) model->link_count--;
    if (other == 2) model->coordinate_count--;
    if (other == 3) model->links = links;
    if (other == 4) model->foot_count--;
    if (other == 5) model->patch_count--;
    ambulo_status status =
        ambulo_export(model, NULL, scratch_path(state, other ? "none" : "own"), &o, NULL, list);
    assert_int_equal(status, other ? AMBULO_E_ARGUMENT : AMBULO_OK);
    if (other) assert_message(list, 0, "the problem belongs to another body, 'walker_2d'");
    ambulo_diagnostics_free(list);
  }
  assert_int_equal(entries_in(*state), 1);
  *model = own;
  ambulo_model_free(model);
  ambulo_problem_free(problem);
}

static void what_is_lost_is_told(void **state) {
  ambulo_model *model = walker(), *up = NULL;
  ambulo_conditions slope = ambulo_conditions_default();
  ambulo_export_options o = options_of(AMBULO_EXPORT_URDF);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  slope.slope = 0.1;
  assert_int_equal(ambulo_model_adapt(model, &slope, NULL, NULL, &up), AMBULO_OK);
  assert_int_equal(ambulo_export(up, NULL, scratch_path(state, "u"), &o, NULL, list), AMBULO_OK);
  assert_message(list, 0, "a URDF has no gravity; the model's is -0.979366 0 -9.76099 m/s^2");
  assert_message(list, 1, "limits of torque or speed of 6 coordinates ('hip_flexion_r')");
  ambulo_diagnostics_free(list);
  list = ambulo_diagnostics_create(NULL); /* gravity as a URDF's reader has it is nothing lost */
  assert_int_equal(ambulo_export(model, NULL, scratch_path(state, "u"), &o, NULL, list), AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_count(list), 1);
  assert_message(list, 0, "limits of torque or speed of 6 coordinates ('hip_flexion_r')");
  ambulo_diagnostics_free(list);
  ambulo_model_free(up);
  ambulo_model_free(model);
}

static void nothing_is_written_over(void **state) {
  ambulo_model *model = walker();
  const char *motion = scratch_path(state, "m.csv"), *folder = scratch_path(state, "out");
  ambulo_export_options o = options_of(AMBULO_EXPORT_OPENSIM);
  scratch_write(motion, motion_text);
  o.overwrite = 0;
  assert_int_equal(ambulo_export(model, NULL, motion, &o, NULL, NULL), AMBULO_E_IO);
  assert_file_equal(motion, motion_text);
  assert_int_equal(ambulo_export(model, motion, folder, &o, NULL, NULL), AMBULO_OK);
  assert_int_equal(ambulo_export(model, motion, folder, &o, NULL, NULL), AMBULO_E_IO);
  o.overwrite = 1;
  assert_int_equal(ambulo_export(model, motion, folder, &o, NULL, NULL), AMBULO_OK);
  char path[600];
  (void)snprintf(path, sizeof path, "%s/notes", folder);
  scratch_write(path, "mine\n");
  assert_int_equal(ambulo_export(model, motion, folder, &o, NULL, NULL), AMBULO_E_IO);
  assert_file_equal(path, "mine\n");
  ambulo_model_free(model);
}

typedef struct export {
  const ambulo_model *model;
  const char *motion, *output;
  ambulo_export_options options;
}
export;

static ambulo_status export_once(const ambulo_allocator *allocator, void *data) {
  const export *e = data;
  return ambulo_export(e->model, e->motion, e->output, &e->options, allocator, NULL);
}

static void memory_may_run_out_anywhere(void **state) {
  static const ambulo_export_format formats[] = {AMBULO_EXPORT_OPENSIM, AMBULO_EXPORT_URDF,
                                                 AMBULO_EXPORT_NPZ, AMBULO_EXPORT_OPENSIM};
  static fail_sites sites;
  ambulo_model *model = walker();
  const char *motion = scratch_path(state, "m.csv"), *file = scratch_path(state, "file"),
             *folder = scratch_path(state, "folder");
  scratch_write(motion, motion_text);
  for (int f = 0; f < 4; f++) {
    export e = {model, f > 1 ? motion : NULL, f == 3 ? folder : file, options_of(formats[f])};
    assert_true(fail_at_every_site(&sites, export_once, &e, 2) > 0);
  }
  assert_int_equal(entries_in(*state), 3); /* no temporary is left */
  ambulo_model_free(model);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(urdf_comes_back),
      TEST(opensim_comes_back),
      TEST(limits_come_back),
      TEST(markers),
      TEST(an_archive),
      TEST(arguments),
      TEST(refusals),
      TEST(a_problem_of_another_body),
      TEST(what_is_lost_is_told),
      TEST(nothing_is_written_over),
      TEST(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
