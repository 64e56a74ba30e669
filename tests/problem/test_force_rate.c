/* Differences of the forces on contacts between neighbouring nodes, as shares of ten body weights a
 * second. */
#include "form_fixture.h"

enum { RATE_SLOTS = 3, RATE_CHANNELS = 4 * 2 + 6 + 3 * 2 + 6 * RATE_SLOTS + 3 };

typedef struct rate_fixture {
  ambulo_model *model;
  double lanes[RATE_CHANNELS * AMBULO__LANES];
  ambulo__term_context context;
  double weight;
} rate_fixture;

static const double times[FORM_NODES] = {0.0, 0.1, 0.35};

static void rate_open(rate_fixture *f, int slots) {
  f->model = arm_create();
  const double *g = ambulo_model_gravity(f->model);
  f->weight = ambulo_model_mass(f->model) * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  for (int i = 0; i < RATE_CHANNELS * AMBULO__LANES; i++) f->lanes[i] = sin(1.7 * i);
  f->context = (ambulo__term_context){.model = f->model,
                                      .channels = {.coordinates = 2,
                                                   .points = 2,
                                                   .feet = slots ? 2 : 0,
                                                   .slots = slots,
                                                   .slot_rows = 6},
                                      .channel_count = RATE_CHANNELS,
                                      .lanes = f->lanes,
                                      .nodes = FORM_NODES,
                                      .times = times};
}

static double *rate_at(rate_fixture *f, int node, int slot, int axis) {
  int channel = ambulo__channel_foot_force(&f->context.channels, slot, axis);
  return &f->lanes[ambulo__lane_index(node, RATE_CHANNELS, channel)];
}

static void the_rate_is_the_difference_over_the_step(void **state) {
  (void)state;
  rate_fixture f;
  ambulo_term term = ambulo_term_default(AMBULO_FORCE_RATE);
  rate_open(&f, RATE_SLOTS);
  for (int node = 0; node < 2; node++) {
    assert_int_equal(ambulo__term_forms(&term, &f.context, node), 3 * RATE_SLOTS);
    for (int j = 0; j < 3 * RATE_SLOTS; j++) {
      ambulo__form form;
      ambulo__term_form(&term, &f.context, node, j, &form);
      double change = *rate_at(&f, node + 1, j / 3, j % 3) - *rate_at(&f, node, j / 3, j % 3);
      double step = times[node + 1] - times[node];
      assert_close(form.u, change / (10.0 * f.weight * step), 1e-15);
      assert_int_equal(form.count, 2);
    }
  }
  ambulo_model_free(f.model);
}

/* u is linear in the two forces: its slopes are exact differences */
static void slopes_are_what_a_change_makes(void **state) {
  (void)state;
  rate_fixture f;
  ambulo_term term = ambulo_term_default(AMBULO_FORCE_RATE);
  rate_open(&f, RATE_SLOTS);
  for (int j = 0; j < 3 * RATE_SLOTS; j++) {
    ambulo__form form, moved;
    ambulo__term_form(&term, &f.context, 1, j, &form);
    for (int c = 0; c < form.count; c++) {
      double *value =
          &f.lanes[ambulo__lane_index(1 + form.ahead[c], RATE_CHANNELS, form.channel[c])];
      assert_true(value == rate_at(&f, 1 + form.ahead[c], j / 3, j % 3));
      *value += 1000.0;
      ambulo__term_form(&term, &f.context, 1, j, &moved);
      assert_close(form.slope[c], (moved.u - form.u) / 1000.0, 1e-12);
      *value -= 1000.0;
    }
  }
  ambulo_model_free(f.model);
}

/* ten body weights more in a second are 1, steady forces 0; the last node begins no interval */
static void a_steady_force_costs_nothing(void **state) {
  (void)state;
  rate_fixture f;
  ambulo_term term = ambulo_term_default(AMBULO_FORCE_RATE);
  ambulo__form form;
  rate_open(&f, 1);
  *rate_at(&f, 0, 0, 1) = *rate_at(&f, 1, 0, 1) = 500.0;
  *rate_at(&f, 2, 0, 1) = 500.0 + 2.5 * f.weight;
  ambulo__term_form(&term, &f.context, 0, 1, &form);
  assert_close(form.u, 0.0, 0.0);
  ambulo__term_form(&term, &f.context, 1, 1, &form);
  assert_close(form.u, 1.0, 1e-14);
  assert_int_equal(ambulo__term_forms(&term, &f.context, 2), 0);
  assert_true(ambulo__term_is_rate(&term));
  ambulo_model_free(f.model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_rate_is_the_difference_over_the_step),
                                     cmocka_unit_test(slopes_are_what_a_change_makes),
                                     cmocka_unit_test(a_steady_force_costs_nothing)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
