/* Rows of a heel on its pad, by hand: the walker, 0.22 m from heel to ball, its left foot
 * on its heel until 0.2 s, flat until 0.4 s, on its toes until 0.6 s; nodes every quarter of a
 * second.
 *
 * The flat foot's centre of moments at 0.25 s: S(1/2) of the way from the heel to half of 0.24 m,
 * or to half-way between the arcs. World: x forward, y up, z right. */
#include "contact/rows.h"
#include "support/row_fixture.h"
#include "support/toed_body.h"

static const double pad = 0.008, e = 0.002, o = 0.01, length = 0.22, height = 0.001;

static const ambulo_contact contacts[] = {
    {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 0.2, .place = {-0.05, 0.09}},
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.2, 0.4, .place = {-0.05, 0.09}},
    {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.4, 0.6, .place = {-0.05, 0.09}}};

/* contacts of the left foot at the first nodes */
static void prepare(row_fixture *f, ambulo_model *body, const ambulo_contact *list, int slots) {
  row_fixture_open_body(f, body);
  f->definition.contacts = list;
  f->definition.contact_count = 3;
  f->definition.contact_tolerance = e;
  f->definition.ground_height = height;
  f->definition.strike_pitch[0] = 0.2;
  f->definition.strike_pitch[1] = 0.4;
  f->definition.ground_reaction.kind = AMBULO_REACTION_SHARED;
  f->definition.ground_reaction.heel_pad = pad;
  f->context.channels.feet = 2;
  f->context.channels.slots = slots;
  free(f->channel);
  int count = ambulo__channel_count(&f->context.channels);
  f->channel = calloc((size_t)(ROW_NODES * count), sizeof(double));
  for (int k = 0; k < ROW_NODES; k++)
    for (int p = 0; p < body->point_count; p++)
      ambulo__neutral_point(body, p,
                            row_channel(f, k, ambulo__channel_point(&f->context.channels, p, 0)));
  for (int k = 0; k < 3; k++) f->active[2 * k + WALKER_LEFT] = k;
}

static void rows(row_fixture *f) {
  f->table.row_count = f->table.term_count = f->table.curved_count = 0;
  ambulo__contact_tube_rows(&f->context, &f->table);
  assert_int_equal(f->table.status, AMBULO_OK);
}

/* `force` body weights along n, `ahead` of the foothold, for a centre `center` ahead of it */
static void press(row_fixture *f, int node, int slot, const double n[3], double force, double ahead,
                  double center) {
  const ambulo__channels *c = &f->context.channels;
  double weight = ambulo__model_weight(f->model);
  for (int i = 0; i < 3; i++)
    *row_channel(f, node, ambulo__channel_foot_force(c, slot, i)) = weight * force * n[i];
  /* about the axis to the right, from forward to up */
  *row_channel(f, node, ambulo__channel_contact_moment(c, slot, 2)) =
      weight * force * (ahead - center);
}

static const double up[3] = {0.0, 1.0, 0.0};

static void expect(row_fixture *f, const char *subject, const char *detail, double time,
                   double value) {
  int row = row_find(f, "contact", subject, detail, time);
  if (fabs(row_value(f, row) - value) > 1e-12)
    print_error("%s %s at %g s: %.15g, expected %.15g\n", subject, detail, time, row_value(f, row),
                value);
  assert_close(row_value(f, row), value, 1e-12);
}

/* the two pairs that a pad moves: by d the heel's height, by the pitch p the foot's */
static void expect_pad(row_fixture *f, const char *point, double time, double off, double d,
                       double p, const double pitch[2]) {
  expect(f, point, "below", time, off + d + e);
  expect(f, point, "above", time, e - off - d);
  expect(f, "left", "toes low", time, -p - pitch[0]);
  expect(f, "left", "toes high", time, pitch[1] + p);
}

/* all that presses, wherever it does */
static void a_heel_sinks_by_what_it_carries(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, walker_create(0), contacts, 2);
  rows(&f);
  press(&f, 0, WALKER_LEFT, up, 1.2, 0.03, 0.0);
  double strike[2] = {sin(0.2), sin(0.4)}, d = pad * 1.2;
  expect_pad(&f, "l_heel", 0.0, -height, d, d / length, strike);
  expect(&f, "l_heel", "ahead", 0.0, e);
  expect(&f, "l_heel", "to the left", 0.0, e);
  row_fixture_close(&f);
}

/* at the heel, between, at the ball, 2 cm ahead of it */
static void a_flat_foot_sinks_by_what_presses_at_its_heel(void **state) {
  (void)state;
  static const double ahead[] = {0.0, 0.05, 0.22, 0.24};
  row_fixture f;
  prepare(&f, walker_create(0), contacts, 2);
  rows(&f);
  for (int i = 0; i < 4; i++) {
    press(&f, 1, WALKER_LEFT, up, 0.9, ahead[i], 0.25 * 0.24);
    double flat[2] = {-o, o}, d = pad * 0.9 * (length - ahead[i]) / length;
    expect_pad(&f, "l_heel", 0.25, -height, d, d / length, flat);
  }
  row_fixture_close(&f);
}

static void arcs(row_fixture *f, double heel_ahead) {
  ambulo_foot *foot = &f->model->feet[WALKER_LEFT];
  foot->has_arcs = 1;
  foot->arc[0] = ambulo_model_find_point(f->model, "l_heel_in");
  foot->arc[1] = ambulo_model_find_point(f->model, "l_toe_out");
  f->model->neutral[3 * foot->arc[0]] += heel_ahead;
}

/* one that rolls turns about where its ball's arc touches: its heel, behind the arc that presses,
 * sinks further */
static void a_flat_foot_with_arcs_presses_under_them(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, walker_create(0), contacts, 2);
  arcs(&f, 0.01);
  rows(&f);
  press(&f, 1, WALKER_LEFT, up, 0.9, 0.05, 0.01 + 0.25 * 0.21);
  double flat[2] = {-o, o}, d = pad * 0.9 * (length - 0.05) / 0.21;
  expect_pad(&f, "l_heel", 0.25, -height, d * length / 0.21, d / 0.21, flat);
  row_fixture_close(&f);
}

/* As a foot comes to be flat, pressed under its heel, the rows of the heel and those of the flat
 * foot hold one and the same pose: the ball touches, the heel has sunk. */
static void heel_and_flat_foot_agree_at_foot_flat(void **state) {
  (void)state;
  static ambulo_contact until[3];
  for (int flat = 0; flat < 2; flat++) {
    row_fixture f;
    memcpy(until, contacts, sizeof until);
    until[0].to = until[1].from = 0.25;
    prepare(&f, walker_create(0), until, 2);
    arcs(&f, 0.01);
    f.definition.ground_height = 0.0;
    f.active[2 + WALKER_LEFT] = flat;
    rows(&f);
    press(&f, 1, WALKER_LEFT, up, 0.9, 0.01, 0.01);
    double d = pad * 0.9, turn = d / 0.21;
    const ambulo_foot *foot = &f.model->feet[WALKER_LEFT];
    int points[] = {foot->heel_center, foot->toe_center, foot->arc[0]};
    for (int i = 0; i < 3; i++) {
      double *r = row_channel(&f, 1, ambulo__channel_point(&f.context.channels, points[i], 0));
      r[1] -= turn * (length - (r[0] + 0.05 + (i == 2 ? 0.01 : 0.0)));
    }
    const char *point = flat ? "l_heel" : "l_heel_in";
    expect(&f, point, "below", 0.25, e);
    expect(&f, point, "above", 0.25, e);
    expect(&f, "left", "toes low", 0.25, flat ? o : 0.0);
    row_fixture_close(&f);
  }
}

/* and where nodes are on events: of two contacts each bound is that of the one that sets it */
static void bounds_at_an_event_have_their_own_pad(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, walker_create(0), contacts, 2);
  row_event(&f, 1, WALKER_LEFT, 0);
  row_event(&f, 2, WALKER_LEFT, 1);
  rows(&f);
  press(&f, 1, WALKER_LEFT, up, 0.9, 0.0, 0.25 * 0.24);
  double d = pad * 0.9;
  expect(&f, "left", "toes high", 0.25, o + d / length);
  press(&f, 2, WALKER_LEFT, up, 0.8, 0.2, 0.24);
  d = pad * 0.8 * 0.02 / length;
  expect(&f, "l_heel", "below", 0.5, -height + d + e);
  expect(&f, "left", "toes low", 0.5, o - d / length); /* of the flat foot, that ends */
  expect(&f, "left", "toes high", 0.5, 0.0);           /* of the toes, which have none */
  row_fixture_close(&f);
}

static void toes_have_none(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, walker_create(0), contacts, 2);
  rows(&f);
  press(&f, 2, WALKER_LEFT, up, 0.9, 0.2, 0.24);
  expect(&f, "l_toe", "below", 0.5, e - height);
  expect(&f, "left", "toes low", 0.5, 0.95);
  expect(&f, "left", "toes high", 0.5, 0.0);
  row_fixture_close(&f);
}

/* what has no weight yet has no force: its pad is not in the rows */
static void a_contact_without_weight_has_none(void **state) {
  (void)state;
  static const ambulo_contact two[] = {
      {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.25, 1.0, .place = {-0.05, 0.09}},
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.6, .place = {-0.05, -0.09}},
      {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.6, 0.7, .place = {-0.05, -0.09}}};
  row_fixture f;
  prepare(&f, walker_create(0), two, 2);
  f.active[WALKER_LEFT] = -1;
  f.active[2 + WALKER_LEFT] = f.active[4 + WALKER_LEFT] = 0;
  rows(&f);
  assert_int_equal(f.table.rows[row_find(&f, "contact", "l_heel", "below", 0.25)].term_count, 1);
  assert_int_equal(f.table.rows[row_find(&f, "contact", "l_heel", "below", 0.5)].term_count, 2);
  row_fixture_close(&f);
}

/* A joint at the ball: the rear part presses on the heel, the toes do not. On a surface that rises
 * by a tenth; n is its normal. */
static void of_a_foot_in_two_parts_the_rear_one_presses(void **state) {
  (void)state;
  static ambulo_contact rising[3];
  row_fixture f;
  for (int k = 0; k < 3; k++) {
    rising[k] = contacts[k];
    rising[k].normal[0] = -0.1;
    rising[k].normal[2] = 1.0;
  }
  prepare(&f, toed_body_with(-0.02), rising, 4);
  rows(&f);
  const double n[3] = {-0.1 / sqrt(1.01), 1.0 / sqrt(1.01), 0.0};
  ambulo__foot_outline outline = ambulo__foot_outline_of(f.model, TOED_LEFT);
  double ahead = 0.3 * outline.length, center = 0.25 * outline.length;
  const char *heel = f.model->points[f.model->feet[TOED_LEFT].heel_center].name;
  double before[2];
  for (int k = 0; k < 2; k++)
    before[k] =
        row_value(&f, row_find(&f, "contact", k ? "left" : heel, k ? "toes low" : "below", 0.25));
  press(&f, 1, 2 + TOED_LEFT, n, 0.5, 0.1, 0.0);
  expect(&f, heel, "below", 0.25, before[0]);
  press(&f, 1, TOED_LEFT, n, 0.9, ahead, center);
  double d = pad * 0.9 * 0.7;
  expect(&f, heel, "below", 0.25, before[0] + d);
  expect(&f, "left", "toes low", 0.25, before[1] - d / outline.length);
  row_fixture_close(&f);
}

/* where ends match in places alone, forces of the last node are its own, and so is its heel */
static void the_last_node_has_its_own_pad(void **state) {
  (void)state;
  static const ambulo_contact always[] = {
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, 0.09}}};
  row_fixture f;
  prepare(&f, walker_create(0), always, 2);
  f.definition.contact_count = 1;
  f.definition.ends = AMBULO_ENDS_PERIODIC;
  for (int k = 0; k < ROW_NODES; k++) f.active[2 * k + WALKER_LEFT] = 0;
  for (int order = 0; order <= 2; order++) {
    f.definition.ends_order = order;
    for (int soft = 0; soft < 2; soft++) {
      f.definition.ground_reaction.heel_pad = soft ? pad : 0.0;
      rows(&f);
      assert_int_equal(row_count(&f, "contact", "l_heel", "below", 1.0), soft && order < 2);
    }
  }
  row_fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_heel_sinks_by_what_it_carries),
      cmocka_unit_test(a_flat_foot_sinks_by_what_presses_at_its_heel),
      cmocka_unit_test(a_flat_foot_with_arcs_presses_under_them),
      cmocka_unit_test(heel_and_flat_foot_agree_at_foot_flat),
      cmocka_unit_test(bounds_at_an_event_have_their_own_pad),
      cmocka_unit_test(toes_have_none),
      cmocka_unit_test(a_contact_without_weight_has_none),
      cmocka_unit_test(of_a_foot_in_two_parts_the_rear_one_presses),
      cmocka_unit_test(the_last_node_has_its_own_pad)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
