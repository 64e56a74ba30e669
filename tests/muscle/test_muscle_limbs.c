/* Which muscles are one limb, and how kernels see it: slots rise whatever the order of a path. */
#include "muscle/muscles.h"
#include "support/muscle_definition.h"
#include "support/random_muscles.h"

/* "a" and "b" share q1; "c" stands alone until it is joined */
static void muscles_of_common_coordinates_are_one_limb(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  ambulo_muscles *m = straps_good(&s);
  assert_int_equal(m->limb_count, 2);
  const ambulo__muscle_limb *first = &m->limbs[0], *other = &m->limbs[1];
  assert_true(first->count == 2 && first->coordinate_count == 3 && first->elastic == -1);
  for (int k = 0; k < 3; k++) assert_int_equal(first->coordinates[k], k);
  assert_true(first->strands[0].muscle == 0 && first->strands[1].muscle == 1);
  assert_true(first->strands[1].slots[0] == 1 && first->strands[1].slots[1] == 2);
  assert_true(other->count == 1 && other->coordinate_count == 1 && other->coordinates[0] == 4);
  assert_true(other->strands[0].muscle == 2 && other->strands[0].slots[0] == 0);
  ambulo_muscles_free(m);
  straps_close(&s);
}

/* c joins a limb through b, though it comes first in the list: chains are followed both ways */
static void chains_are_one_limb(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  static const int spans[strap_m][2] = {{0, 1}, {8, 4}, {4, 1}};
  for (int i = 0; i < strap_m; i++) {
    s.muscles[i].coordinate_count = 2;
    s.muscles[i].term_count = strap_terms;
    s.muscles[i].pull_count = 0;
    memcpy(s.muscles[i].coordinates, spans[i], sizeof spans[i]);
  }
  ambulo_muscles *m = straps_good(&s);
  assert_int_equal(m->limb_count, 1);
  static const int want[] = {0, 1, 4, 8};
  assert_int_equal(m->limbs[0].coordinate_count, 4);
  assert_int_equal(m->limbs[0].count, 3);
  for (int k = 0; k < 4; k++) assert_int_equal(m->limbs[0].coordinates[k], want[k]);
  /* "b" of q8 and q4: its second exponents now come first */
  const ambulo_muscle *b = ambulo_muscles_get(m, 1);
  assert_true(b->coordinates[0] == 4 && b->coordinates[1] == 8);
  assert_true(b->exponents[1][1] == 1 && b->exponents[2][0] == 1 && b->exponents[1][0] == 0);
  ambulo_muscles_free(m);
  straps_close(&s);
}

/* ---------------------------------------------------------------- their order */

enum { states = 9 };

typedef struct outcome {
  double cost[states], activation[states * leg_m], force[states * leg_m], reserve[states * leg_d];
  double by_q[states * leg_d], by_qd[states * leg_d];
} outcome;

static void share_all(const ambulo_muscles *muscles, outcome *o) {
  random_source source = {17};
  double q[states * leg_d], qd[states * leg_d], tau[states * leg_d], rate[states * leg_d];
  for (int i = 0; i < states * leg_d; i++) {
    q[i] = random_between(&source, -0.6, 0.6);
    qd[i] = random_between(&source, -6, 6);
    tau[i] = random_between(&source, -100, 100);
    rate[i] = random_between(&source, -1000, 1000);
  }
  const ambulo_sharing_states s = {sizeof s, states, q, qd, tau, rate};
  ambulo_sharing_outputs out = ambulo_sharing_outputs_default();
  ambulo_sharing prices = ambulo_sharing_default();
  prices.metabolic = 0.3;
  out.cost = o->cost;
  out.activation = o->activation;
  out.force = o->force;
  out.reserve = o->reserve;
  out.by_q = o->by_q;
  out.by_qd = o->by_qd;
  assert_int_equal(ambulo_muscles_share(muscles, &prices, &s, NULL, &out), AMBULO_OK);
}

/* Fisher and Yates; exponents, ranges and those of a pull go along */
static void permute(leg *l, int i, random_source *source, ambulo_muscle_pull *pull,
                    unsigned char (*exponents)[AMBULO_MUSCLE_COORDINATES]) {
  ambulo_muscle *m = &l->list[i];
  for (int k = m->coordinate_count - 1; k > 0; k--) {
    int j = random_below(source, k + 1), swapped = m->coordinates[k];
    m->coordinates[k] = m->coordinates[j];
    m->coordinates[j] = swapped;
    for (int end = 0; end < 2; end++) {
      double bound = m->range[k][end];
      m->range[k][end] = m->range[j][end];
      m->range[j][end] = bound;
    }
    for (int t = 0; t < leg_terms; t++) {
      unsigned char e = l->exponents[i][t][k];
      l->exponents[i][t][k] = l->exponents[i][t][j];
      l->exponents[i][t][j] = e;
    }
    unsigned char e = exponents[0][k];
    exponents[0][k] = exponents[0][j];
    exponents[0][j] = e;
  }
  pull->exponents = (const unsigned char(*)[AMBULO_MUSCLE_COORDINATES])exponents;
}

/* the same bits, and the same muscle to whoever asks */
static void order_of_coordinates_does_not_matter(void **state) {
  (void)state;
  static leg l;
  static ambulo_muscle_pull pulls[leg_m];
  static unsigned char exponents[leg_m][1][AMBULO_MUSCLE_COORDINATES];
  static const double slopes[1][3] = {{1.0, 2.0, 3.0}};
  static outcome first, again;
  for (uint64_t seed = 1; seed <= 4; seed++) {
    leg_open(&l, seed);
    random_source source = {seed + 40};
    for (int i = 0; i < leg_m; i++) {
      pulls[i] = ambulo_muscle_pull_default();
      pulls[i].joint = "joint";
      pulls[i].link = 3;
      pulls[i].axes = 1;
      pulls[i].term_count = 1;
      pulls[i].slopes = slopes;
      for (int k = 0; k < AMBULO_MUSCLE_COORDINATES; k++) {
        exponents[i][0][k] = (unsigned char)(k < l.list[i].coordinate_count ? k + 1 : 0);
        if (k >= l.list[i].coordinate_count) continue;
        l.list[i].range[k][0] = -l.list[i].coordinates[k];
        l.list[i].range[k][1] = 1.0 + l.list[i].coordinates[k];
      }
      pulls[i].exponents = (const unsigned char(*)[AMBULO_MUSCLE_COORDINATES])exponents[i];
      l.list[i].pulls = &pulls[i];
      l.list[i].pull_count = 1;
    }
    ambulo_muscles *own = NULL, *other = NULL;
    assert_int_equal(ambulo_muscles_create(l.model, &l.definition, NULL, NULL, &own), AMBULO_OK);
    for (int i = 0; i < leg_m; i++) permute(&l, i, &source, &pulls[i], exponents[i]);
    assert_int_equal(ambulo_muscles_create(l.model, &l.definition, NULL, NULL, &other), AMBULO_OK);
    share_all(own, &first);
    share_all(other, &again);
    assert_memory_equal(&first, &again, sizeof first);
    for (int i = 0; i < leg_m; i++) {
      const ambulo_muscle *a = ambulo_muscles_get(own, i), *b = ambulo_muscles_get(other, i);
      assert_memory_equal(a->coordinates, b->coordinates, sizeof a->coordinates);
      assert_memory_equal(a->range, b->range, sizeof a->range);
      assert_memory_equal(a->exponents, b->exponents, leg_terms * sizeof *a->exponents);
      assert_memory_equal(a->pulls[0].exponents, b->pulls[0].exponents, sizeof *a->exponents);
      for (int k = 0; k < a->coordinate_count; k++) {
        assert_true(a->range[k][0] == -a->coordinates[k]);
        if (k > 0) assert_true(a->coordinates[k] > a->coordinates[k - 1]);
      }
    }
    ambulo_muscles_free(own);
    ambulo_muscles_free(other);
    leg_close(&l);
  }
}

/* -------------------------------------------------------------------- refusals */

/* "a" to "c" over q0 to q7 are eight; one more is too many */
static void a_limb_has_at_most_eight_coordinates(void **state) {
  (void)state;
  for (int last = 7; last <= 8; last++) {
    straps s;
    straps_open(&s);
    static const unsigned char exponents[1][AMBULO_MUSCLE_COORDINATES] = {{0}};
    static const int first[strap_m] = {0, 3, 6};
    for (int i = 0; i < strap_m; i++) {
      ambulo_muscle *m = &s.muscles[i];
      m->coordinate_count = i == 2 ? last - 5 : 4;
      for (int k = 0; k < m->coordinate_count; k++) m->coordinates[k] = first[i] + k;
      m->exponents = exponents;
      m->term_count = 1;
      m->pull_count = 0;
    }
    if (last == 7) {
      ambulo_muscles *m = straps_good(&s);
      assert_int_equal(m->limb_count, 1);
      assert_int_equal(m->limbs[0].coordinate_count, 8);
      ambulo_muscles_free(m);
    } else {
      straps_bad(&s, AMBULO_E_MODEL,
                 "the limb of muscle 'c' has too many coordinates; expected at most 8");
    }
    straps_close(&s);
  }
}

/* of one limb; another limb may have its own */
static void one_elastic_coordinate(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  for (int i = 0; i < strap_m; i++) {
    s.muscles[i].elastic = s.muscles[i].coordinates[0];
    s.muscles[i].tendon_strain = 0.05;
  }
  straps_bad(&s, AMBULO_E_MODEL,
             "the limb of muscle 'b' has tendons that stretch with two coordinates; expected one");
  s.muscles[0].elastic = 1;
  ambulo_muscles *m = straps_good(&s);
  assert_int_equal(m->limbs[0].elastic, 1);
  assert_int_equal(m->limbs[1].elastic, 0);
  /* sum F_max r(0): "a" 1000 N at 0.02 m, "b" 2000 N at 0.05 m; "c" 3000 N at 0.05 m */
  assert_close(m->limbs[0].elastic_torque, 120.0, 1e-14);
  assert_close(m->limbs[1].elastic_torque, 150.0, 1e-14);
  assert_close(m->limbs[0].strands[1].stretch, 0.25 * 0.05, 1e-16);
  ambulo_muscles_free(m);
  straps_close(&s);
}

/* a term q^2, or one with another coordinate, gives no moment arm at q = 0 */
static void elastic_tendons_need_a_moment_arm(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  s.muscles[2].elastic = 4;
  s.muscles[2].tendon_strain = 0.05;
  s.exponents[1][0] = 2;
  straps_bad(&s, AMBULO_E_MODEL,
             "the limb of muscle 'c' has elastic tendons without a moment arm at q = 0");
  s.exponents[1][0] = 1;
  s.muscles[2].elastic = -1;
  s.muscles[0].elastic = 0;
  s.muscles[0].tendon_strain = 0.05;
  s.exponents[1][1] = 1;
  straps_bad(&s, AMBULO_E_MODEL,
             "the limb of muscle 'a' has elastic tendons without a moment arm at q = 0");
  s.exponents[1][1] = 0;
  ambulo_muscles_free(straps_good(&s));
  straps_close(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(muscles_of_common_coordinates_are_one_limb),
      cmocka_unit_test(chains_are_one_limb),
      cmocka_unit_test(order_of_coordinates_does_not_matter),
      cmocka_unit_test(a_limb_has_at_most_eight_coordinates),
      cmocka_unit_test(one_elastic_coordinate),
      cmocka_unit_test(elastic_tendons_need_a_moment_arm),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
