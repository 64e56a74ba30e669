/* "held" of summary.json, and its columns of motion.csv. */
#include "show/holds_json.h"

#include "formats/motion_csv.h"
#include "people/stride.h"
#include "support/fail_alloc.h"
#include "support/test.h"
#include "support/wellformed.h"

#include "ambulo/tools/tools.h"

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

static double number(const char *json, const char *key) {
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
  assert_close(number(box, "\"mass\": "), 10, 0);
  assert_close(number(box, "\"from\": "), 0.5, 0);
  assert_close(number(box, "\"to\": "), 2, 0);
  assert_close(number(rope, "\"to\": "), p->definition.duration, 1e-12);
  for (int hand = 0; hand < 2; hand++) {
    const char *at = strstr(box, hand ? "\"hand_l\": {" : "\"hand_r\": {");
    ambulo__hand_peak peak = ambulo__stride_hand_peak(&stride, 0, hand);
    assert_non_null(at);
    assert_close(number(at, "\"peak_force\": "), peak.force, 1e-12);
    assert_close(number(at, "\"peak_force_time\": "), peak.force_time, 1e-12);
    assert_close(number(at, "\"peak_moment\": "), peak.moment, 1e-12);
    assert_true(peak.force > 20 && peak.moment > 0);
  }
  double work[2];
  ambulo__stride_hold_work(&stride, 0, work);
  assert_close(number(box, "\"positive_work\": "), work[0], 1e-12);
  assert_close(number(box, "\"negative_work\": "), work[1], 1e-12);
  assert_close(number(strstr(rope, "\"hand_l\""), "\"peak_force\": "), 30, 1e-12);
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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_members),
                                     cmocka_unit_test(test_nothing_held),
                                     cmocka_unit_test(test_columns)};
  return cmocka_run_group_tests_name("report/holds_json", tests, NULL, NULL);
}
