/* Devices and loads: where they are, when they act, and how they are drawn. */
#include "ambulo/tools/tools.h"
#include "show/gait_surroundings.h"
#include "support/test.h"

#include <string.h>

static int count_of(const char *svg, const char *what) {
  int count = 0;
  for (const char *at = svg; (at = strstr(at, what)) != NULL; at++) count++;
  return count;
}

static const char *const overrides[] = {
    "time.intervals=30", "trajectory.intervals=9",
    "load={link: thorax, mass: 8, position: [-0.1, 0.2, 0]}",
    "devices=[{name: exo_r, kind: spring, coordinate: ankle_angle_r, stiffness: 150, rest: 0, "
    "side: "
    "above, foot: right, engaged: {from: 0.1, to: 0.6}, mirror: true}, {name: band, kind: spring, "
    "between: [{link: foot_r, position: [0.04, 0, 0]}, {link: foot_l, position: [0.04, 0, 0]}], "
    "stiffness: 120, rest: 0}]"};

typedef struct wearer {
  ambulo_problem *problem;
  double *x;
  ambulo__stride stride;
  ambulo__worn_list list;
} wearer;

static void open_wearer(wearer *w) {
  w->problem = NULL;
  assert_int_equal(ambulo_problem_load("models/walk.yaml", overrides, 4, NULL, NULL, &w->problem),
                   AMBULO_OK);
  w->x = calloc((size_t)w->problem->variables, sizeof *w->x);
  assert_non_null(w->x);
  for (int j = 0; j < w->problem->variables; j++) w->x[j] = 0.2;
  assert_int_equal(ambulo__stride_create(w->problem, w->x, 21, NULL, &w->stride), AMBULO_OK);
  assert_int_equal(ambulo__worn_create(&w->stride, NULL, &w->list), AMBULO_OK);
  assert_int_equal(w->list.count, 4);
}

static void close_wearer(wearer *w) {
  ambulo__worn_free(&w->list);
  ambulo__stride_free(&w->stride);
  free(w->x);
  ambulo_problem_free(w->problem);
}

static double apart(const double a[3], const double b[3]) {
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
              (a[2] - b[2]) * (a[2] - b[2]));
}

/* a brace holds shank and foot and turns at the ankle, a band goes from foot to foot, and 8 kg on
 * the back are a box of 16 litres, upright where the body is */
static void places_of_what_is_worn(void **state) {
  (void)state;
  wearer w;
  open_wearer(&w);
  const ambulo_model *m = w.problem->model;
  const ambulo__worn *brace = &w.list.mark[0], *band = &w.list.mark[1], *load = &w.list.mark[3];
  assert_int_equal(brace->kind, AMBULO__WORN_BRACE);
  assert_string_equal(m->links[brace->link[0]].name, "shank_r");
  assert_string_equal(m->links[brace->link[1]].name, "foot_r");
  assert_string_equal(m->links[brace->link[2]].name, "ankle_r");
  assert_true(brace->at[0][1] < -0.15); /* below the middle of the shank */
  assert_int_equal(band->kind, AMBULO__WORN_CABLE);
  assert_string_equal(m->links[band->link[1]].name, "foot_l");
  assert_close(band->at[1][0], 0.04, 0);
  assert_int_equal(load->kind, AMBULO__WORN_LOAD);
  assert_close(load->at[0][1], 0.2, 0);
  assert_close(8.0 * load->half[0] * load->half[1] * load->half[2], 0.98 * 8.0 / 500.0, 1e-12);
  assert_close(load->at[1][0] - load->at[0][0], load->half[0], 1e-12); /* X is forward, Y up */
  assert_close(load->at[2][1] - load->at[0][1], load->half[2], 1e-12);
  assert_close(apart(load->at[1], load->at[0]), load->half[0], 1e-12);
  close_wearer(&w);
}

/* an idle device is there, but pale */
static void drawn_as_what_it_is(void **state) {
  (void)state;
  wearer w;
  open_wearer(&w);
  ambulo__pose pose;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  assert_int_equal(ambulo__pose_create(w.problem->model, NULL, &pose), AMBULO_OK);
  const ambulo__figure_view view = {0.0, 1.0, 500.0, 300.0, 100.0, 0.0, 0.1};
  int seen = 0;
  for (int k = 0; k < w.stride.samples; k++) {
    ambulo__pose_at(&pose, w.stride.q + (size_t)k * (size_t)w.stride.coordinates);
    ambulo__text_clear(&text);
    for (int ahead = 0; ahead < 2; ahead++)
      ambulo__gait_worn_draw(&w.stride, &w.list, k, ahead, &pose, &view, &text);
    const char *svg = ambulo__text_data(&text);
    int idle = 0;
    for (int i = 0; i < w.stride.devices; i++) {
      double peak = fabs(ambulo__stride_device_work(&w.stride, i).peak);
      int acts = ambulo__worn_acts(&w.stride, k, i);
      assert_int_equal(acts, fabs(w.stride.effort[3 * k + i]) >= 0.02 * peak);
      if (i != 1) idle += !acts;
      if (i == 0) seen |= 1 << acts;
    }
    assert_int_equal(count_of(svg, "\"brace\"") + count_of(svg, "\"brace idle\""), 2);
    assert_int_equal(count_of(svg, "\"brace idle\""), idle);
    assert_int_equal(count_of(svg, "<circle"), 2);
    assert_int_equal(count_of(svg, "<line"), 5); /* four cuffs and the band */
    assert_int_equal(count_of(svg, "<path class=\"load\""), 1);
  }
  assert_int_equal(seen, 3);
  ambulo__text_free(&text);
  ambulo__pose_free(&pose);
  close_wearer(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(places_of_what_is_worn),
                                     cmocka_unit_test(drawn_as_what_it_is)};
  return cmocka_run_group_tests_name("picture/gait_worn", tests, NULL, NULL);
}
