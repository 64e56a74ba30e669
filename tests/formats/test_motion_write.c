/* motion.csv and motion.sto read back to the same bits. */
#include "formats/motion_write.h"
#include "formats/motion_file.h"
#include "people/stride.h"
#include "support/walker_result.h"
#include "support/motion_text.h"

static ambulo__motion_table table_of(const ambulo__stride *s) {
  ambulo__motion_table table = {.model = s->model,
                                .name = "a walk",
                                .samples = s->samples,
                                .times = s->times,
                                .q = s->q,
                                .qd = s->qd,
                                .qdd = s->qdd,
                                .tau = s->tau,
                                .zmp = s->zmp};
  return table;
}

static ambulo__motion *read_back(const ambulo__text_buffer *text, ambulo__motion_format format) {
  ambulo__motion *motion = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status =
      motion_read_text(ambulo__text_data(text), text->length, "text", format, NULL, list, &motion);
  if (status) {
    char message[400];
    ambulo_diagnostics_format(list, 0, message, sizeof message);
    print_error("%s\n", message);
  }
  ambulo_diagnostics_free(list);
  assert_int_equal(status, AMBULO_OK);
  return motion;
}

static void same_bits(const ambulo__motion *motion, const char *prefix, const ambulo__stride *s,
                      const double *values) {
  for (int i = 0; i < s->coordinates; i++) {
    char name[80];
    snprintf(name, sizeof name, "%s%s", prefix, s->model->coordinates[i].name);
    int column = ambulo__motion_column(motion, name);
    if (column < 0) print_error("no column %s\n", name);
    assert_true(column >= 0);
    for (int k = 0; k < s->samples; k++)
      assert_memory_equal(&motion->values[k * motion->columns + column],
                          &values[k * s->coordinates + i], sizeof(double));
  }
}

static void test_csv_round_trip(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo__stride s;
  assert_int_equal(ambulo__stride_create(w.problem, w.result->x, 40, NULL, &s), AMBULO_OK);
  /* readers ask for finite numbers; a flight has no zero-moment point */
  for (int k = 0; k < 3 * s.samples; k++)
    if (!isfinite(s.zmp[k])) s.zmp[k] = 0.0;
  ambulo__motion_table table = table_of(&s);
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__motion_csv(&table, &text);
  static const char start[] = "# ambulo motion: mass ";
  assert_memory_equal(ambulo__text_data(&text), start, strlen(start));
  assert_non_null(strstr(ambulo__text_data(&text), " m/s^2; SI units and radians: time s; q rad"));
  ambulo__motion *motion = read_back(&text, AMBULO__MOTION_CSV);
  assert_int_equal(motion->rows, 40);
  assert_int_equal(motion->columns, 4 * WALKER_COORDINATES + 3);
  assert_memory_equal(motion->time, s.times, (size_t)s.samples * sizeof(double));
  same_bits(motion, "q.", &s, s.q);
  same_bits(motion, "qd.", &s, s.qd);
  same_bits(motion, "qdd.", &s, s.qdd);
  same_bits(motion, "tau.", &s, s.tau);
  assert_true(ambulo__motion_column(motion, "zmp.y") >= 0);
  ambulo__motion_free(motion);
  ambulo__text_free(&text);
  ambulo__stride_free(&s);
  walk_close(&w);
}

/* ------------------------------------------------------------------ every column */

enum { ROWS = 3, FEET = 2, PATCHES = 3, HOLDS = 2, DEVICES = 2 };

/* an array that names itself: entry i is 1000 of + i */
static double *numbered(double *array, int count, int of) {
  for (int i = 0; i < count; i++) array[i] = 1000.0 * of + i;
  return array;
}

/* column `name` is entry `first` + `stride` row of the array `of` */
static void expect_column(const ambulo__motion *motion, const char *name, int of, int first,
                          int stride) {
  int column = ambulo__motion_column(motion, name);
  if (column < 0) print_error("no column %s\n", name);
  assert_true(column >= 0);
  for (int k = 0; k < ROWS; k++)
    assert_true(motion->values[k * motion->columns + column] == 1000.0 * of + first + stride * k);
}

static void expect_three(const ambulo__motion *motion, const char *name, int of, int first,
                         int stride) {
  char full[80];
  for (int i = 0; i < 3; i++) {
    snprintf(full, sizeof full, "%s.%c", name, "xyz"[i]);
    expect_column(motion, full, of, first + i, stride);
  }
}

typedef double every_column[24][6 * ROWS * PATCHES];

/* feet, patches, devices, holds and what an inverse dynamics adds; a[k] are column group k */
static void write_every_column(every_column a, ambulo__text_buffer *text) {
  ambulo_coordinate coordinate[] = {{.name = "turn", .type = AMBULO_REVOLUTE},
                                    {.name = "slide", .type = AMBULO_PRISMATIC}};
  ambulo_foot foot[] = {{.name = "left"}, {.name = "right"}};
  ambulo_patch patch[] = {{.name = "p0"}, {.name = "p1"}, {.name = "p2"}};
  ambulo_point point[] = {{.name = "h0"}, {.name = "h1"}, {.name = "h2"}};
  ambulo_model model = {.coordinates = coordinate,
                        .coordinate_count = 2,
                        .feet = foot,
                        .foot_count = FEET,
                        .patches = patch,
                        .patch_count = PATCHES,
                        .points = point,
                        .point_count = 3,
                        .mass = 70.0};
  const ambulo_device device[] = {{.name = "brace", .coordinate = 0},
                                  {.name = "cord", .coordinate = -1}};
  const ambulo_hold hold[] = {{.name = "box", .hand = {0, 1}}, {.name = "rail", .hand = {2, -1}}};
  const int shown[] = {2, 0};
  double times[ROWS] = {0.0, 0.1, 0.2};
  ambulo__motion_table table = {.model = &model,
                                .samples = ROWS,
                                .times = times,
                                .q = a[0],
                                .qd = a[1],
                                .qdd = a[2],
                                .tau = a[3],
                                .zmp = a[4],
                                .feet = FEET,
                                .grf = a[5],
                                .cop = a[6],
                                .free_moment = a[7],
                                .grf_moment = a[8],
                                .patches = 2,
                                .patch = shown,
                                .patch_force = a[9],
                                .patch_cop = a[10],
                                .patch_free_moment = a[11],
                                .patch_moment = a[12],
                                .devices = DEVICES,
                                .device = device,
                                .effort = a[13],
                                .along = a[14],
                                .device_power = a[15],
                                .holds = HOLDS,
                                .hold = hold,
                                .hold_force = a[16],
                                .hold_moment = a[17],
                                .hold_power = a[18],
                                .wrench = a[19],
                                .residual = a[20],
                                .power = a[21]};
  ambulo__motion_csv(&table, text);
}

static void every_column_has_its_own_numbers(void **state) {
  (void)state;
  static every_column a;
  ambulo__text_buffer text;
  for (int i = 0; i < 24; i++) (void)numbered(a[i], 6 * ROWS * PATCHES, i);
  ambulo__text_init(&text, NULL);
  write_every_column(a, &text);
  ambulo__motion *m = read_back(&text, AMBULO__MOTION_CSV);
  assert_int_equal(m->columns, 4 * 2 + 3 + 2 * 10 + 2 * 10 + 2 * 3 + (13 + 7) + 6 + 6 + 2);
  expect_column(m, "qdd.slide", 2, 1, 2);
  expect_column(m, "tau.turn", 3, 0, 2);
  expect_three(m, "zmp", 4, 0, 3);
  expect_three(m, "grf.right", 5, 3, 3 * FEET);
  expect_three(m, "cop.left", 6, 0, 3 * FEET);
  expect_column(m, "free_moment.right", 7, 1, FEET);
  expect_three(m, "moment.right", 8, 3, 3 * FEET);
  expect_three(m, "grf.p2", 9, 6, 3 * PATCHES);
  expect_three(m, "cop.p0", 10, 0, 3 * PATCHES);
  expect_column(m, "free_moment.p2", 11, 2, PATCHES);
  expect_three(m, "moment.p2", 12, 6, 3 * PATCHES);
  expect_column(m, "device.brace.torque", 13, 0, DEVICES);
  expect_column(m, "device.brace.angle", 14, 0, DEVICES);
  expect_column(m, "device.cord.force", 13, 1, DEVICES);
  expect_column(m, "device.cord.length", 14, 1, DEVICES);
  expect_column(m, "device.cord.power", 15, 1, DEVICES);
  expect_three(m, "held.box.h1.force", 16, 3, 6 * HOLDS);
  expect_three(m, "held.rail.h2.force", 16, 6, 6 * HOLDS);
  expect_three(m, "held.rail.h2.moment", 17, 6, 6 * HOLDS);
  expect_column(m, "held.rail.power", 18, 1, HOLDS);
  expect_three(m, "wrench.force", 19, 3, 6);
  expect_three(m, "wrench.moment", 19, 0, 6);
  expect_three(m, "residual.force", 20, 0, 6);
  expect_three(m, "residual.moment", 20, 3, 6);
  expect_column(m, "power.slide", 21, 1, 2);
  ambulo__motion_free(m);
  ambulo__text_free(&text);
}

static void test_sto_round_trip(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo__stride s;
  assert_int_equal(ambulo__stride_create(w.problem, w.result->x, 0, NULL, &s), AMBULO_OK);
  ambulo__motion_table table = table_of(&s);
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__motion_sto(&table, &text);
  assert_non_null(strstr(ambulo__text_data(&text), "inDegrees=no\n"));
  ambulo__motion *motion = read_back(&text, AMBULO__MOTION_STO);
  assert_int_equal(motion->columns, WALKER_COORDINATES);
  assert_int_equal(motion->in_degrees, 0);
  same_bits(motion, "", &s, s.q);
  ambulo__motion_free(motion);
  ambulo__text_free(&text);
  ambulo__stride_free(&s);
  walk_close(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_csv_round_trip),
                                     cmocka_unit_test(every_column_has_its_own_numbers),
                                     cmocka_unit_test(test_sto_round_trip)};
  return cmocka_run_group_tests_name("formats/motion_write", tests, NULL, NULL);
}
