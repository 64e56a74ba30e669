/* Versions of what is running: from the libraries themselves; parts of summary.json. */
#include "mechanics/plan.h"
#include "ambulo/ambulo.h"
#include "ambulo/tools/tools.h"
#include "formats/motion_write.h"
#include "people/stride.h"
#include "people/stride_measures.h"
#include "people/walking_cost.h"
#include "show/summary_json.h"
#include "support/fail_alloc.h"
#include "support/patched_walker.h"
#include "support/test.h"
#include "support/wellformed.h"
#include "support/yaml.h"

#include <string.h>

static void test_versions(void **state) {
  (void)state;
  ambulo_versions v;
  int major, minor, patch;
  ambulo_versions_get(&v);
  assert_string_equal(v.ambulo, AMBULO_VERSION_STRING);
  assert_int_equal(sscanf(v.nlopt, "%d.%d.%d", &major, &minor, &patch), 3);
  assert_int_equal(sscanf(v.libyaml, "%d.%d.%d", &major, &minor, &patch), 3);
  assert_string_equal(v.instruction_set, ambulo__instruction_set());
  assert_int_equal(strspn(v.engine, "0123456789abcdef"), 16);
  assert_int_equal(strlen(v.engine), 16);
  assert_true(strlen(v.blas) > 3);
  assert_null(strchr(v.blas, '\n'));
}

static int test_versions_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_versions)};
  return cmocka_run_group_tests_name("report/versions", tests, NULL, NULL);
}

/* "work" and "center_of_mass" of summary.json. */

/* {...} of a problem's point of zeros */
static void write(const char *file, ambulo__text_buffer *text) {
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_allocator own = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo_problem_load(file, NULL, 0, NULL, NULL, &problem), AMBULO_OK);
  ambulo_options options = ambulo_problem_options(problem);
  options.maximum_iterations = 2;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  ambulo__text_init(text, &own);
  ambulo__json json = {.text = text};
  ambulo__json_open(&json, NULL, '{');
  assert_int_equal(ambulo__economy_json(&json, problem, result, 0), AMBULO_OK);
  ambulo__json_close(&json, '}');
  assert_true(is_json(ambulo__text_data(text)));
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static double number(const char *json, const char *key) {
  const char *at = strstr(json, key);
  assert_non_null(at);
  return strtod(at + strlen(key), NULL);
}

/* the numbers of one coordinate */
static void expect_of(const char *json, const char *name, const ambulo__economy *e, int i) {
  char key[64];
  (void)snprintf(key, sizeof key, "\"%s\": {", name);
  const char *at = strstr(json, key);
  assert_non_null(at);
  assert_close(number(at, "\"positive\": "), e->positive[i], 1e-9 * e->positive_sum);
  assert_close(number(at, "\"negative\": "), e->negative[i], 1e-9 * e->positive_sum);
}

/* as people/stride_measures.h has it by itself; nothing is left allocated */
static void the_numbers_are_the_economys(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator counting = fail_alloc_hook(&memory);
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo__stride stride;
  ambulo__economy economy;
  ambulo__walking_cost cost;
  ambulo__text_buffer text;
  assert_int_equal(ambulo_problem_load("models/walk_normal.yaml", NULL, 0, NULL, NULL, &problem),
                   AMBULO_OK);
  ambulo_options options = ambulo_problem_options(problem);
  options.maximum_iterations = 2;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  ambulo__text_init(&text, &counting);
  ambulo__json json = {.text = &text};
  assert_int_equal(ambulo__economy_json(&json, problem, result, 0), AMBULO_OK);
  assert_int_equal(ambulo__stride_create(problem, ambulo_result_x(result), 1001, NULL, &stride),
                   AMBULO_OK);
  assert_int_equal(ambulo__economy_of(&stride, NULL, &economy), AMBULO_OK);
  const char *data = ambulo__text_data(&text);
  double way = economy.distance * problem->model->mass;
  assert_close(number(data, "\"rise\": "), economy.rise, 1e-9);
  assert_close(number(data, "\"sway\": "), economy.sway, 1e-9);
  assert_true(fabs(economy.rise - economy.sway) > 1e-6);
  assert_close(number(data, "\"negative\": "), economy.negative_sum, 1e-8 * economy.positive_sum);
  assert_close(number(data, "\"negative_per_kg_metre\": "), economy.negative_sum / way, 1e-8);
  assert_int_equal(ambulo__walking_cost_of(&stride, NULL, &cost), AMBULO_OK);
  assert_int_equal(cost.is_walk, 1);
  assert_close(number(data, "\"metabolic\": "), cost.net, 1e-8 * cost.net);
  assert_close(number(data, "\"swing\": "), cost.swing, 1e-8 * cost.swing);
  for (int i = 0; i < stride.coordinates; i++)
    if (problem->model->coordinates[i].actuated)
      expect_of(data, problem->model->coordinates[i].name, &economy, i);
  ambulo__economy_free(&economy);
  ambulo__stride_free(&stride);
  ambulo__text_free(&text);
  assert_int_equal(memory.live, 0);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static void a_walk_says_what_it_costs(void **state) {
  (void)state;
  ambulo__text_buffer text;
  write("models/walk_normal.yaml", &text);
  const char *json = ambulo__text_data(&text);
  double positive = number(json, "\"positive\": "), negative = number(json, "\"negative\": ");
  double distance = number(json, "\"distance\": ");
  assert_true(positive > 0.0 && negative < 0.0);
  assert_close(number(json, "\"positive_per_kg_metre\": "), positive / (75.0 * distance),
               1e-9 * positive);
  assert_close(number(json, "\"metabolic_per_kg_metre\": ") * 75.0 * distance,
               number(json, "\"metabolic\": "), 1e-9 * positive);
  assert_close(number(json, "\"people_per_kg_metre\": "), ambulo__people_walking_cost(1.28), 0.1);
  assert_true(number(json, "\"limb_work\": ") > 0.0 && number(json, "\"unsteadiness\": ") > 0.0);
  assert_non_null(strstr(json, "\"ankle_angle_r\": {"));
  assert_null(strstr(json, "pelvis_tilt"));
  assert_true(number(json, "\"rise\": ") > 0.0 && number(json, "\"sway\": ") > 0.0);
  ambulo__text_free(&text);
}

/* without ground reaction torques are not those of joints; standing there is no metre, nor where
 * feet stay and the centre of mass moves, as in lifting */
static void what_there_is_not_is_not_said(void **state) {
  (void)state;
  ambulo__text_buffer text;
  write("tests/support/walk_without_reaction.yaml", &text);
  assert_null(strstr(ambulo__text_data(&text), "\"work\""));
  assert_non_null(strstr(ambulo__text_data(&text), "\"center_of_mass\": {"));
  ambulo__text_free(&text);
  write("models/stand_quietly.yaml", &text);
  assert_non_null(strstr(ambulo__text_data(&text), "\"work\": {"));
  assert_null(strstr(ambulo__text_data(&text), "per_kg_metre"));
  assert_null(strstr(ambulo__text_data(&text), "metabolic"));
  ambulo__text_free(&text);
  write("models/lift.yaml", &text);
  assert_true(fabs(number(ambulo__text_data(&text), "\"distance\": ")) > 0.001);
  assert_null(strstr(ambulo__text_data(&text), "per_kg_metre"));
  ambulo__text_free(&text);
}

static int test_economy_json_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_walk_says_what_it_costs),
                                     cmocka_unit_test(the_numbers_are_the_economys),
                                     cmocka_unit_test(what_there_is_not_is_not_said)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* "held" of summary.json, and its columns of motion.csv. */

#define LOADS                                                                                      \
  "load=[{name: box, hands: [hand_r, hand_l], mass: 10, center: [0.05, 0, -0.1], from: 0.5, to: "  \
  "2}, {name: rope, hands: [hand_l], force: [30, 0, 0]}]"

static const char *const overrides[] = {"time.intervals=32", "constraints.reach=[]", "obstacles=[]",
                                        LOADS};

static void open_result(const char *const *with, int count, ambulo_problem **p,
                        ambulo_result **result) {
  assert_int_equal(ambulo_problem_load("models/lift.yaml", with, count, NULL, NULL, p), AMBULO_OK);
  ambulo_options options = ambulo_problem_options(*p);
  options.maximum_iterations = 1;
  assert_int_equal(ambulo_solve(*p, &options, NULL, NULL, NULL, result), AMBULO_OK);
}

static double test_holds_json_number(const char *json, const char *key) {
  const char *at = strstr(json, key);
  assert_non_null(at);
  return strtod(at + strlen(key), NULL);
}

static void test_members(void **state) {
  (void)state;
  ambulo_problem *p = NULL;
  ambulo_result *result = NULL;
  ambulo__stride stride;
  ambulo__text_buffer text;
  open_result(overrides, 4, &p, &result);
  ambulo__text_init(&text, NULL);
  ambulo__json json = {.text = &text};
  ambulo__json_open(&json, NULL, '{');
  assert_int_equal(ambulo__holds_json(&json, p, result), AMBULO_OK);
  ambulo__json_close(&json, '}');
  const char *all = ambulo__text_data(&text);
  assert_true(is_json(all));
  assert_int_equal(ambulo__stride_create(p, ambulo_result_x(result), 1001, NULL, &stride),
                   AMBULO_OK);
  const char *box = strstr(all, "\"box\": {"), *rope = strstr(all, "\"rope\": {");
  assert_true(box && rope && rope > box);
  assert_close(test_holds_json_number(box, "\"mass\": "), 10, 0);
  assert_close(test_holds_json_number(box, "\"from\": "), 0.5, 0);
  assert_close(test_holds_json_number(box, "\"to\": "), 2, 0);
  assert_close(test_holds_json_number(rope, "\"to\": "), p->definition.duration, 1e-12);
  for (int hand = 0; hand < 2; hand++) {
    const char *at = strstr(box, hand ? "\"hand_l\": {" : "\"hand_r\": {");
    ambulo__hand_peak peak = ambulo__stride_hand_peak(&stride, 0, hand);
    assert_non_null(at);
    assert_close(test_holds_json_number(at, "\"peak_force\": "), peak.force, 1e-12);
    assert_close(test_holds_json_number(at, "\"peak_force_time\": "), peak.force_time, 1e-12);
    assert_close(test_holds_json_number(at, "\"peak_moment\": "), peak.moment, 1e-12);
    assert_true(peak.force > 20 && peak.moment > 0);
  }
  double work[2];
  ambulo__stride_hold_work(&stride, 0, work);
  assert_close(test_holds_json_number(box, "\"positive_work\": "), work[0], 1e-12);
  assert_close(test_holds_json_number(box, "\"negative_work\": "), work[1], 1e-12);
  assert_close(test_holds_json_number(strstr(rope, "\"hand_l\""), "\"peak_force\": "), 30, 1e-12);
  assert_null(strstr(rope, "\"hand_r\""));
  ambulo__stride_free(&stride);
  ambulo__text_free(&text);
  ambulo_result_free(result);
  ambulo_problem_free(p);
}

static void test_nothing_held(void **state) {
  (void)state;
  const char *const none[] = {"time.intervals=32", "constraints.reach=[]", "load=null"};
  ambulo_problem *p = NULL;
  ambulo_result *result = NULL;
  ambulo__text_buffer text;
  open_result(none, 3, &p, &result);
  ambulo__text_init(&text, NULL);
  ambulo__json json = {.text = &text};
  assert_int_equal(ambulo__holds_json(&json, p, result), AMBULO_OK);
  assert_int_equal(text.length, 0);
  ambulo__text_free(&text);
  ambulo_result_free(result);
  ambulo_problem_free(p);
}

/* the cell of a line below a name of the header */
static double cell(const char *header, const char *line, const char *name) {
  const char *at = strstr(header, name);
  assert_non_null(at);
  for (const char *h = header; h <= at; h++)
    if (*h == ',') line = strchr(line, ',') + 1;
  return strtod(line, NULL);
}

/* the header's names, that a line has as many numbers, and which */
static void test_columns(void **state) {
  (void)state;
  ambulo_problem *p = NULL;
  ambulo_result *result = NULL;
  ambulo__stride s;
  ambulo__text_buffer text;
  open_result(overrides, 4, &p, &result);
  assert_int_equal(ambulo__stride_create(p, ambulo_result_x(result), 5, NULL, &s), AMBULO_OK);
  const ambulo__motion_table table = {.model = s.model,
                                      .samples = 5,
                                      .times = s.times,
                                      .q = s.q,
                                      .qd = s.qd,
                                      .qdd = s.qdd,
                                      .tau = s.tau,
                                      .zmp = s.zmp,
                                      .holds = s.holds,
                                      .hold = p->definition.holds,
                                      .hold_force = s.hold_force,
                                      .hold_moment = s.hold_moment,
                                      .hold_power = s.hold_power};
  ambulo__text_init(&text, NULL);
  ambulo__motion_csv(&table, &text);
  const char *header = strchr(ambulo__text_data(&text), '\n') + 1;
  assert_non_null(strstr(header, ",held.box.hand_r.force.x,held.box.hand_r.force.y,"
                                 "held.box.hand_r.force.z,held.box.hand_r.moment.x,"));
  assert_non_null(strstr(header, ",held.box.hand_l.moment.z,held.box.power,"
                                 "held.rope.hand_l.force.x,"));
  const char *line = strchr(header, '\n') + 1;
  for (int k = 0; k < 5; k++) {
    int names = 1, cells = 1;
    const char *c = line;
    for (const char *h = header; *h != '\n'; h++) names += *h == ',';
    for (; *c != '\n'; c++) cells += *c == ',';
    assert_int_equal(cells, names);
    const double *box = s.hold_force + 12 * k, *moment = s.hold_moment + 12 * k;
    assert_close(cell(header, line, ",held.box.hand_r.force.y"), box[1], 1e-12);
    assert_close(cell(header, line, ",held.box.hand_l.force.x"), box[3], 1e-12);
    assert_close(cell(header, line, ",held.box.hand_l.moment.z"), moment[5], 1e-12);
    assert_close(cell(header, line, ",held.box.power"), s.hold_power[2 * k], 1e-12);
    assert_close(cell(header, line, ",held.rope.hand_l.force.x"), box[6], 1e-12);
    line = c + 1;
  }
  ambulo__text_free(&text);
  ambulo__stride_free(&s);
  ambulo_result_free(result);
  ambulo_problem_free(p);
}

static int test_holds_json_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_members),
                                     cmocka_unit_test(test_nothing_held),
                                     cmocka_unit_test(test_columns)};
  return cmocka_run_group_tests_name("report/holds_json", tests, NULL, NULL);
}

/* What feet and patches got, in summary.json. */

static ambulo_problem *stand(const ambulo_model *model, ambulo_reaction_kind kind) {
  static const ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, -0.09}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, 0.09}},
      OF_PATCH(HAND_R, 0.2, 0.8, {0.4, -0.25, 1.22})};
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_problem *problem = NULL;
  d.model = model;
  d.contacts = contacts;
  d.contact_count = 3;
  d.intervals = 8;
  d.contact_tolerance = 0.002;
  d.ground_reaction.kind = kind;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &problem), AMBULO_OK);
  return problem;
}

/* {"ground_reaction": ...} of the point of zeros */
static ambulo_status test_reaction_json_write(const ambulo_problem *problem,
                                              const ambulo_allocator *allocator,
                                              ambulo__text_buffer *text) {
  ambulo_options options = ambulo_problem_options(problem);
  double *zero = calloc((size_t)ambulo_problem_variable_count(problem), sizeof *zero);
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_audit_point(problem, &options, zero, NULL, NULL, &result), AMBULO_OK);
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__text_init(text, &own);
  ambulo__json json = {.text = text};
  ambulo__json_open(&json, NULL, '{');
  ambulo_status status = ambulo__reaction_json(&json, problem, result);
  ambulo__json_close(&json, '}');
  if (!status) status = ambulo__text_status(text);
  ambulo_result_free(result);
  free(zero);
  return status;
}

static void patches_in_contact_stand_beside_feet(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0);
  ambulo_problem *problem = stand(model, AMBULO_REACTION_SHARED);
  ambulo__text_buffer text;
  assert_int_equal(test_reaction_json_write(problem, NULL, &text), AMBULO_OK);
  const char *json = ambulo__text_data(&text);
  assert_true(is_json(json));
  static const char *const there[] = {"\"right\": {",          "\"left\": {",      "\"hand_r\": {",
                                      "\"impulse_forward\": ", "\"impulse_up\": ", "\"peak\": "};
  for (size_t i = 0; i < sizeof there / sizeof *there; i++) assert_non_null(strstr(json, there[i]));
  assert_null(strstr(json, "hand_l"));
  assert_null(strstr(json, "seat"));
  ambulo__text_free(&text);
  ambulo_problem_free(problem);
  problem = stand(model, AMBULO_REACTION_NONE);
  assert_int_equal(test_reaction_json_write(problem, NULL, &text), AMBULO_OK);
  assert_null(strstr(ambulo__text_data(&text), "ground_reaction"));
  ambulo__text_free(&text);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

static int test_reaction_json_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(patches_in_contact_stand_beside_feet)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_versions_tests() + test_economy_json_tests() + test_holds_json_tests() +
         test_reaction_json_tests();
}
