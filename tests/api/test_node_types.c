/* Every node of every kind of file that is read as YAML, replaced by values of every other type:
 * no crash, and either a legal file or a refusal with a place in it. */
#include "ambulo/tools/tools.h"
#include "base/numtext.h"
#include "support/gait_folder.h"
#include "support/yaml_mutation.h"

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

/* how one kind of file is read; the text is also written to `path` where that is not NULL */
typedef struct reading {
  const char *name, *path;
  ambulo_status (*read)(struct reading *r, const mutation *m, ambulo_diagnostics *list);
  void *user;
  int tried, refused, faults;
} reading;

static void tell(const reading *r, const mutation *m, const ambulo_diagnostics *list,
                 const char *what) {
  char buffer[2048] = "";
  print_error("%s: %s with '%s' in place of %s (line %d, column %d)\n", r->name, what,
              m->replacement, ambulo__yaml_place(m->target).path, m->line, m->column);
  for (size_t i = 0; i < ambulo_diagnostics_count(list); i++) {
    ambulo_diagnostics_format(list, i, buffer, sizeof buffer);
    print_error("  %s\n", buffer);
  }
}

/* an error that says where in the changed file */
static int has_place(const reading *r, const ambulo_diagnostics *list) {
  for (size_t i = 0; i < ambulo_diagnostics_count(list); i++) {
    const ambulo_diagnostic *one = ambulo_diagnostics_get(list, i);
    if (one->severity == AMBULO_ERROR && one->file && strcmp(one->file, r->name) == 0 &&
        one->line > 0 && one->column > 0)
      return 1;
  }
  return 0;
}

static int is_plain_number(const ambulo__yaml_node *node) {
  double value;
  return node->kind == AMBULO__YAML_SCALAR && !node->quoted &&
         ambulo__parse_double(node->text, strlen(node->text), &value);
}

/* Whether an accepted value may be of this type: of the one that stood there, or at one of the few
 * places where several are legal. */
static int is_legal(const mutation *m) {
  static const char *const either[] = {"source", "gait.step_time", "scale", "outputs[",
                                       "constraints.collision"};
  const char *path = ambulo__yaml_place(m->target).path, *value = m->replacement;
  int is_list = value[0] == '[', is_mapping = value[0] == '{', is_word = !is_list && !is_mapping;
  int is_number = value == mutation_values[0] || value == mutation_values[1];
  for (size_t i = 0; path && i < sizeof either / sizeof *either; i++)
    if (strstr(path, either[i])) return 1;
  switch (m->target->kind) {
  case AMBULO__YAML_SEQUENCE:
    return is_list;
  case AMBULO__YAML_MAPPING: /* a value by sex may be one for both */
    return is_mapping || (is_number && ambulo__yaml_find(m->target, "male"));
  case AMBULO__YAML_SCALAR:
    break;
  }
  return is_plain_number(m->target) ? is_number : is_word && value[0];
}

static void attempt(void *user, const mutation *m) {
  reading *r = user;
  if (r->path) scratch_write(r->path, m->text);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = r->read(r, m, list);
  const char *fault = NULL;
  if (status == AMBULO_OK) {
    if (ambulo_diagnostics_error_count(list) > 0) fault = "accepted with an error";
    if (!is_legal(m)) fault = "a value of another type is accepted";
  } else {
    if (!has_place(r, list)) fault = "no place in the message";
    if (status == AMBULO_E_INTERNAL || status == AMBULO_E_MEMORY || status == AMBULO_E_ARGUMENT)
      fault = ambulo_status_name(status);
  }
  if (fault) tell(r, m, list, fault);
  r->faults += fault != NULL;
  r->tried++;
  r->refused += status != AMBULO_OK;
  ambulo_diagnostics_free(list);
}

static void try_file(const char *path, reading *r, mutation_places *places) {
  ambulo__yaml *document = NULL;
  assert_int_equal(ambulo__yaml_load(path, NULL, NULL, &document), AMBULO_OK);
  mutation_walk(document, ambulo__yaml_root(document), places, attempt, r);
  ambulo__yaml_free(document);
}

/* all files of models/ of a kind */
static void try_shipped(const char *kind, reading *r, mutation_places *places) {
  DIR *stream = opendir(AMBULO_SOURCE_DIR "/models");
  assert_non_null(stream);
  for (struct dirent *e = readdir(stream); e; e = readdir(stream)) {
    char path[512];
    const char *end = strrchr(e->d_name, '.');
    if (!end || strcmp(end, ".yaml") != 0) continue;
    (void)snprintf(path, sizeof path, "%s/models/%s", AMBULO_SOURCE_DIR, e->d_name);
    ambulo__yaml *document = NULL;
    assert_int_equal(ambulo__yaml_load(path, NULL, NULL, &document), AMBULO_OK);
    const ambulo__yaml_node *own = ambulo__yaml_find(ambulo__yaml_root(document), "kind");
    int ours = strcmp(own ? own->text : "model", kind) == 0;
    ambulo__yaml_free(document);
    if (ours) try_file(path, r, places);
  }
  closedir(stream);
}

static void sum_up(const reading *r, mutation_places *places) {
  print_message("%d kinds of places, %d documents, %d refused\n", places->kinds, r->tried,
                r->refused);
  mutation_places_free(places);
  assert_int_equal(r->faults, 0);
  assert_true(r->refused > 10 &&
              r->refused < r->tried); /* it did look, and not everything is wrong */
}

/* ------------------------------------------------------------------- models */

static ambulo_status read_model(reading *r, const mutation *m, ambulo_diagnostics *list) {
  ambulo_model *model = NULL;
  ambulo_status status =
      ambulo_model_load_text(m->text, m->length, r->name, NULL, NULL, list, &model);
  assert_true((model != NULL) == (status == AMBULO_OK));
  ambulo_model_free(model);
  return status;
}

static void models(void **state) {
  (void)state;
  reading r = {.name = "model", .read = read_model};
  mutation_places places = {.most = 2};
  try_shipped("model", &r, &places);
  sum_up(&r, &places);
}

/* ----------------------------------------------------------------- problems */

static ambulo_status read_problem(reading *r, const mutation *m, ambulo_diagnostics *list) {
  ambulo_problem *problem = NULL;
  ambulo_status status =
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = m->text,
                                                      .length = m->length,
                                                      .name = r->name,
                                                      .directory = AMBULO_SOURCE_DIR "/models/"},
                               NULL, list, &problem);
  assert_true((problem != NULL) == (status == AMBULO_OK));
  ambulo_problem_free(problem);
  return status;
}

static void problems(void **state) {
  (void)state;
  reading r = {.name = "problem", .read = read_problem};
  mutation_places places = {.most = getenv("AMBULO_LONG") ? 2 : 1};
  try_shipped("problem", &r, &places);
  sum_up(&r, &places);
}

/* the keys that no shipped problem has */
static const char every_key[] =
    "ambulo: 1\nkind: problem\nname: every_key\nmodel: walker_2d.yaml\nangles: degrees\n"
    "subject: {mass: 70, stature: 1.7, sex: male}\n"
    "time: {duration: 1, intervals: 8}\n"
    "trajectory: {basis: bspline, degree: 3, intervals: 4, breakpoints: [0, 0.2, 0.5, 0.8, 1]}\n"
    "solver: {algorithm: auto, continuation: off, time_limit: 9,\n"
    "  maximum_evaluations: 100, feasibility_tolerance: 1e-6, optimality_tolerance: 1e-4,\n"
    "  dense_samples: 10}\n"
    "contacts:\n"
    "  - {foot: right, mode: flat, from: 0, to: 0.2, place: [0.1, -0.2]}\n"
    "  - {foot: left, mode: toe, from: 0.1, to: 1, place: [0.3, 0.4]}\n"
    "constraints:\n"
    "  ground_height: 0\n  ground_penetration: true\n  foot_strike: true\n  zmp: off\n"
    "  zmp_margin: 0\n  minimum_force: 0.1\n  joint_limits: nodes\n  speed_limits: true\n"
    "  torque_limits: true\n  contact_tolerance: 0.01\n  orientation_tolerance: 0.1\n"
    "  strike_pitch: [-10, 20]\n"
    "  clearance: {height: 0.02, tip_from: 0.1, ceiling: 0.3, turn: 0.1, outward: 1, inward: 1, "
    "feet: 0}\n"
    "  tubes: [{reference: FILE, coordinates: {knee_angle_r: 9}}]\n"
    "ground: {slope: 2}\n"
    "load: {link: pelvis, mass: 5, position: [0, 0.1, 0]}\n"
    "ground_reaction:\n"
    "  kind: shared\n  moment_arm: 0.2\n  slant: 0.3\n  loading_rate: 9\n  flight_tolerance: 0.1\n "
    " friction: 0.8\n"
    "  free_moment: 0.1\n  minimum_force: off\n"
    "  pressure: {heel: [-0.1, 0.1], roll: 0.5, flat: [0, 1], toe: [0, 0.1], width: 0.01}\n"
    "ends: {kind: periodic, order: 1, travel: 0.5, rise: 0, initial: {knee_angle_r: 5}, "
    "initial_speed: \n"
    "  {knee_angle_r: 5}, final: {knee_angle_l: 5}, final_speed: {knee_angle_l: 5}}\n"
    "objective:\n"
    "  - {term: torque_power, name: t, weight: 1, power: 3, smoothing: 1, scale: {default: 1},\n"
    "     passive: {knee_angle_r: [1, 2, 3, 4]}, strength: {knee_angle_r: [1, 2, 3, 4, 5, 6]},\n"
    "     offset: {pelvis_ty: body_weight}}\n"
    "  - {term: posture, name: p, angles: {knee_angle_r: 5}, scale: {knee_angle_r: 1}}\n"
    "  - {term: tracking, name: r, reference: FILE, scale: 1}\n"
    "  - {term: upright, name: u, points: [pelvis, head_top]}\n"
    "  - {term: clearance, name: c, height: 0.03}\n";

static void keys_that_no_shipped_problem_has(void **state) {
  char text[8192] = "";
  const char *table = scratch_path(state, "walk.csv"), *path = scratch_path(state, "every.yaml");
  scratch_write(table, "time,knee_angle_r,pelvis_tx\n0,0.0,0\n0.5,1.0,0.4\n1,0.0,0.6\n");
  const char *from = every_key;
  for (const char *hole; (hole = strstr(from, "FILE")); from = hole + 4) {
    strncat(text, from, (size_t)(hole - from));
    strcat(text, table);
  }
  strcat(text, from);
  scratch_write(path, text);
  reading r = {.name = "problem", .read = read_problem};
  mutation whole = {.text = text, .length = strlen(text), .replacement = "nothing"};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = read_problem(&r, &whole, list);
  if (status) print_error("every_key: %s\n", ambulo_diagnostics_get(list, 0)->message);
  ambulo_diagnostics_free(list);
  assert_int_equal(status, AMBULO_OK);
  mutation_places places = {.most = 1};
  try_file(path, &r, &places);
  sum_up(&r, &places);
}

/* ------------------------------------------------------------------- sweeps */

static const char swing[] = "ambulo: 1\nkind: problem\nname: swing\nmodel: pendulum.yaml\n"
                            "angles: degrees\ntime: {duration: 1.0, intervals: 4}\n"
                            "ends: {initial: {swing: 0}, final: {swing: 20}}\n"
                            "objective:\n  - {term: torque_squared, weight: 1}\n";

/* together they have every key of a sweep file */
static const char *const sweeps[] = {
    "ambulo: 1\nkind: sweep\nname: s\nbase: p.yaml\ncombine: grid\n"
    "axes:\n"
    "  - {key: time.duration, name: T, label: time, unit: s, range: [0.8, 1.2, 0.2]}\n"
    "  - {key: 'objective[0].weight', values: [1, 2]}\n"
    "  - {key: time.intervals, name: n, linspace: [4, 8, 2]}\n"
    "filters: ['T < 1.1', 'n != 6']\ncase_name: 'a{T}_{n}_{objective[0].weight}'\n"
    "outputs: [objective, {output: max(tau.swing), label: torque, unit: N m}]\nstart_from: "
    "neighbour\nalong: T\n"
    "limits: {seconds: 5, megabytes: 500}\n",
    "ambulo: 1\nkind: sweep\nname: s\nbase: p.yaml\ntable: t.csv\ncombine: zip\n"
    "axes:\n"
    "  - {key: 'ends.final.swing', name: angle, values: [10, 20]}\n"
    "  - {key: 'objective[0].weight', name: w, values: [1, 2]}\n"
    "cases:\n"
    "  - {name: one, set: {time.intervals: 6, 'ends.final.swing': 15}}\n"
    "  - {name: two, set: {time.duration: 1.5}}\n",
    "ambulo: 1\nkind: sweep\nname: s\nbase: p.yaml\n"
    "latin_hypercube:\n  samples: 3\n  seed: 1\n  axes:\n"
    "    - {key: time.duration, name: T, label: l, unit: s, range: [0.8, 1.2], whole: false}\n"
    "    - {key: time.intervals, range: [4, 8], whole: true}\n"
    "random:\n  samples: 2\n  seed: 4\n  axes:\n"
    "    - {key: 'objective[0].weight', name: w, range: [1, 2]}\n"};

static ambulo_status read_sweep(reading *r, const mutation *m, ambulo_diagnostics *list) {
  ambulo_sweep *sweep = NULL;
  (void)m;
  ambulo_status status = ambulo_sweep_load(r->path, NULL, list, &sweep);
  assert_true((sweep != NULL) == (status == AMBULO_OK));
  ambulo_sweep_free(sweep);
  return status;
}

static void copy_file(const char *from, const char *to) {
  char text[16384];
  FILE *file = fopen(from, "rb");
  assert_non_null(file);
  size_t length = fread(text, 1, sizeof text - 1, file);
  (void)fclose(file);
  text[length] = '\0';
  scratch_write(to, text);
}

static void all_sweeps(void **state) {
  reading r = {.name = scratch_path(state, "m.yaml"), .read = read_sweep};
  r.path = r.name;
  mutation_places places = {.most = 2};
  scratch_write(scratch_path(state, "p.yaml"), swing);
  scratch_write(scratch_path(state, "t.csv"), "time.duration,name\n1,a\n2,b\n");
  copy_file(AMBULO_SOURCE_DIR "/models/pendulum.yaml", scratch_path(state, "pendulum.yaml"));
  for (size_t i = 0; i < sizeof sweeps / sizeof *sweeps; i++) {
    const char *path = scratch_path(state, "s.yaml");
    ambulo_sweep *sweep = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    scratch_write(path, sweeps[i]);
    if (ambulo_sweep_load(path, NULL, list, &sweep))
      print_error("sweep %zu: %s\n", i, ambulo_diagnostics_get(list, 0)->message);
    assert_non_null(sweep);
    ambulo_sweep_free(sweep);
    ambulo_diagnostics_free(list);
    try_file(path, &r, &places);
  }
  sum_up(&r, &places);
}

/* ---------------------------------------------------------------- solutions */

static ambulo_status read_solution(reading *r, const mutation *m, ambulo_diagnostics *list) {
  double x[64];
  (void)m;
  assert_true(ambulo_problem_variable_count(r->user) <= 64);
  ambulo_status status = ambulo_solution_load(r->path, r->user, NULL, list, x);
  if (!status) status = ambulo_solution_start(r->path, r->user, NULL, list, x);
  return status;
}

static void solutions(void **state) {
  ambulo_problem *problem = NULL;
  assert_int_equal(
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = swing,
                                                      .length = strlen(swing),
                                                      .name = "p",
                                                      .directory = AMBULO_SOURCE_DIR "/models/"},
                               NULL, NULL, &problem),
      AMBULO_OK);
  reading r = {.name = scratch_path(state, "m.yaml"), .read = read_solution, .user = problem};
  r.path = r.name;
  mutation_places places = {.most = 3};
  const char *path = scratch_path(state, "solution.yaml");
  scratch_write(path, "ambulo: 1\nkind: solution\nduration: 1\n"
                      "trajectory: {basis: bspline, degree: 3, intervals: 2, breakpoints: [0, 0.5, "
                      "1]}\ncoordinates: [swing]\ncontrol_points:\n"
                      "  - [0]\n  - [1]\n  - [2]\n  - [3]\n  - [4]\n");
  double x[64];
  assert_int_equal(ambulo_solution_load(path, problem, NULL, NULL, x), AMBULO_OK);
  try_file(path, &r, &places);
  ambulo_problem_free(problem);
  sum_up(&r, &places);
}

/* ---------------------------------------------------------------- summaries */

/* of a result folder, as compare reads them */
static ambulo_status compare_summary(reading *r, const mutation *m, ambulo_diagnostics *list) {
  char band[SCRATCH_PATH + 16];
  ambulo_comparison *comparison = NULL;
  (void)m;
  (void)snprintf(band, sizeof band, "%s/band.csv", (const char *)r->user);
  ambulo_status status = ambulo_compare(r->user, band, NULL, NULL, list, &comparison);
  ambulo_comparison_free(comparison);
  return status;
}

static void summaries(void **state) {
  reading r = {.name = scratch_path(state, "summary.json"), .read = compare_summary};
  r.path = r.name;
  r.user = *state;
  mutation_places places = {.most = 2};
  char band[4096] = "variable,percent,mean_deg,sd_deg\n";
  for (int p = 0; p <= 100; p += 2) {
    char line[64];
    (void)snprintf(line, sizeof line, "hip_flexion,%d,%d,2\n", p, 10 + p % 30);
    strcat(band, line);
  }
  scratch_write(scratch_path(state, "band.csv"), band);
  gait_motion(*state, 0.0, 1);
  gait_summary(*state, "{\"verdict\": \"optimal\", " GAIT_STRIKES ", " GAIT_BODY "}");
  mutation whole = {.replacement = "nothing"};
  assert_int_equal(compare_summary(&r, &whole, NULL), AMBULO_OK);
  const char *copy = scratch_path(state, "copy.json");
  copy_file(r.name, copy);
  try_file(copy, &r, &places);
  sum_up(&r, &places);
}

int main(void) {
#define SCRATCH(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {cmocka_unit_test(models),
                                     cmocka_unit_test(problems),
                                     SCRATCH(keys_that_no_shipped_problem_has),
                                     SCRATCH(all_sweeps),
                                     SCRATCH(solutions),
                                     SCRATCH(summaries)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
