/* Patches in whole problems: who carries what, by hand and by a law that is solved otherwise; what
 * does not go with them. */
#include "support/contact_index.h"
#include "mechanics/pose.h"
#include "solver/result.h"
#include "support/moved_problem.h"
#include "support/patched_problem.h"

static void refuse(const ambulo_problem_definition *d, const char *phrase) {
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_problem_create(d, NULL, list, &problem), AMBULO_E_PROBLEM);
  assert_message(list, 0, phrase);
  ambulo_diagnostics_free(list);
}

/* ------------------------------------------------------------------- four legs */

enum { LEGS = 4 };
static const double leg_forward[LEGS] = {0.3, 0.3, -0.3, -0.3};
static const double leg_left[LEGS] = {0.2, -0.2, 0.2, -0.2};
static const double foot_length = 0.06, beyond = 0.02;

/* the walker whose pelvis stands on four legs instead, 0.3 m below it: feet of 0.06 m that press
 * 0.04 m ahead of their heels where they are flat, or patches */
static ambulo_model *four_legs(int on_feet) {
  static const char *const names[LEGS] = {"fore_l", "fore_r", "hind_l", "hind_r"};
  static const char *const heels[LEGS] = {"fhl", "fhr", "hhl", "hhr"};
  static const char *const toes[LEGS] = {"ftl", "ftr", "htl", "htr"};
  ambulo_model *body = walker_create(0), *model = NULL;
  ambulo_point points[2 * LEGS];
  ambulo_foot feet[LEGS];
  ambulo_patch patches[LEGS];
  int link = ambulo_model_find_link(body, "pelvis");
  for (int i = 0; i < LEGS; i++) { /* x up, y backward, z right */
    double heel = leg_forward[i] - (on_feet ? 0.5 * (foot_length + beyond) : 0.0);
    points[i] = (ambulo_point){heels[i], link, {-0.3, -heel, -leg_left[i]}};
    points[LEGS + i] = (ambulo_point){toes[i], link, {-0.3, -heel - foot_length, -leg_left[i]}};
    feet[i] = (ambulo_foot){.name = names[i],
                            .heel = {i, -1},
                            .toe = {LEGS + i, -1},
                            .heel_center = i,
                            .toe_center = LEGS + i,
                            .mirror = i ^ 1};
    patches[i] = (ambulo_patch){names[i], i, {0.02, 0.02}, i ^ 1};
  }
  ambulo_model_definition d = ambulo_model_definition_default();
  d.links = body->links;
  d.link_count = body->link_count;
  d.coordinates = body->coordinates;
  d.coordinate_count = body->coordinate_count;
  d.points = points;
  d.point_count = 2 * LEGS;
  d.feet = feet;
  d.patches = patches;
  *(on_feet ? &d.foot_count : &d.patch_count) = LEGS;
  assert_int_equal(ambulo_model_create(&d, NULL, NULL, &model), AMBULO_OK);
  ambulo_model_free(body);
  return model;
}

static void four_legs_carry_a_quarter_each(void **state) {
  (void)state;
  for (int on_feet = 0; on_feet < 2; on_feet++) {
    ambulo_model *model = four_legs(on_feet);
    ambulo_contact contacts[LEGS];
    for (int i = 0; i < LEGS; i++) {
      double heel = leg_forward[i] - (on_feet ? 0.5 * (foot_length + beyond) : 0.0);
      contacts[i] = (ambulo_contact)OF_PATCH(i, 0.0, 1.0, {heel, leg_left[i], 0.62});
      if (!on_feet) continue;
      contacts[i].foot = i;
      contacts[i].mode = AMBULO_CONTACT_FLAT;
    }
    ambulo_problem_definition d = definition_of(model, contacts, LEGS);
    posed p = pose(&d, 0.0, 0.0);
    double force[3 * LEGS], cop[3 * LEGS], tau[8], time = 0.4;
    ambulo_motion motion = {.size = sizeof(ambulo_motion), .tau = tau};
    *(on_feet ? &motion.grf : &motion.patch_force) = force;
    *(on_feet ? &motion.cop : &motion.patch_cop) = cop;
    read_motion(&p, 1, &time, &motion);
    for (int i = 0; i < LEGS; i++) {
      assert_close(force[3 * i + 1] / weight, 0.25, 1e-9);
      /* as far to the outside on each side */
      assert_close(force[3 * i] / weight, -leg_forward[i] / 0.3 * fabs(force[0]) / weight, 1e-9);
      assert_close(fabs(cop[3 * i]), fabs(cop[0]), 1e-9);
    }
    for (int i = 0; i < 3; i++) assert_close(tau[i] / weight, 0.0, 1e-11);
    unpose(&p);
    ambulo_model_free(model);
  }
}

/* ---------------------------------------------------------------- hand on a rail */

enum { HELD = 3, UNKNOWN = 6 * HELD, SIZE = UNKNOWN + 6 };

static void solve(double a[SIZE][SIZE + 1]) {
  for (int k = 0; k < SIZE; k++) {
    int pivot = k;
    for (int i = k + 1; i < SIZE; i++)
      if (fabs(a[i][k]) > fabs(a[pivot][k])) pivot = i;
    for (int j = 0; j <= SIZE; j++) {
      double kept = a[k][j];
      a[k][j] = a[pivot][j];
      a[pivot][j] = kept;
    }
    for (int i = 0; i < SIZE; i++) {
      double factor = i == k ? 0.0 : a[i][k] / a[k][k];
      for (int j = k; j <= SIZE && factor != 0.0; j++) a[i][j] -= factor * a[k][j];
    }
  }
  for (int k = 0; k < SIZE; k++) a[k][SIZE] /= a[k][k];
}

/* forces and moments [HELD][6] about p that sum up to (M, F) about the origin and minimize
 * sum f.A^-1 f + m.B^-1 m: its conditions of first order, all at once */
static void share(const double w[HELD], const double p[HELD][3], const double center[3],
                  const double wrench[6], double moment_arm, double slant, double out[HELD][6]) {
  double a[SIZE][SIZE + 1] = {{0}};
  for (int c = 0; c < HELD; c++) {
    double e[3], length = 0.0;
    for (int i = 0; i < 3; i++) length += (center[i] - p[c][i]) * (center[i] - p[c][i]);
    for (int i = 0; i < 3; i++) e[i] = (center[i] - p[c][i]) / sqrt(length);
    for (int i = 0; i < 3; i++) {
      int f = 6 * c + i, m = f + 3, u = (i + 1) % 3, v = (i + 2) % 3;
      for (int k = 0; k < 3; k++)
        a[f][6 * c + k] = ((i == k) - (1.0 - slant * slant) * e[i] * e[k]) / w[c];
      a[m][m] = 1.0 / (w[c] * moment_arm * moment_arm);
      /* sum f = F; sum m + p x f = M */
      a[UNKNOWN + i][f] = 1.0;
      a[UNKNOWN + 3 + i][m] = 1.0;
      a[UNKNOWN + 3 + i][6 * c + v] += p[c][u];
      a[UNKNOWN + 3 + i][6 * c + u] -= p[c][v];
    }
  }
  for (int i = 0; i < 3; i++) {
    a[UNKNOWN + i][SIZE] = wrench[3 + i];
    a[UNKNOWN + 3 + i][SIZE] = wrench[i];
  }
  for (int r = UNKNOWN; r < SIZE; r++)
    for (int k = 0; k < UNKNOWN; k++) a[k][r] = a[r][k];
  solve(a);
  for (int c = 0; c < HELD; c++)
    for (int i = 0; i < 6; i++) out[c][i] = a[6 * c + i][SIZE];
}

static double smooth(double u) {
  return u * u * (3.0 - 2.0 * u);
}

static void center_of_mass(const posed *p, double time, double center[3]) {
  const ambulo_model *model = ambulo_problem_model(p->problem);
  double q[7], place[3];
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .q = q};
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  ambulo__pose links;
  read_motion(p, 1, &time, &motion);
  assert_int_equal(ambulo__pose_create(model, &a, &links), AMBULO_OK);
  ambulo__pose_at(&links, q);
  for (int i = 0; i < 3; i++) center[i] = 0.0;
  for (int b = 0; b < model->link_count; b++) {
    ambulo__pose_point(&links, b, model->links[b].com, place);
    for (int i = 0; i < 3; i++) center[i] += place[i] * model->links[b].mass / model->mass;
  }
  ambulo__pose_free(&links);
}

/* both feet flat and a hand on a rail from 0.2 to 0.8 s, half of its weight at 0.35 s */
static void a_hand_on_a_rail_takes_what_the_law_says(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0);
  ambulo_problem_definition d = definition_of(model, feet_and_hand, 3);
  posed at_rail = pose(&d, 0.03, 0.4);
  static const double times[] = {0.25, 0.35, 0.5, 0.7};
  double feet[4 * 6], hands[4 * PATCHES * 3], cop[4 * PATCHES * 3], wrench[4 * 6], tau[4 * 7];
  ambulo_motion motion = {.size = sizeof(ambulo_motion),
                          .tau = tau,
                          .wrench = wrench,
                          .grf = feet,
                          .patch_force = hands,
                          .patch_cop = cop};
  read_motion(&at_rail, 4, times, &motion);
  for (int k = 0; k < 4; k++) {
    double t = times[k], out[HELD][6], center[3];
    const double in = fmin(1.0, (t - 0.2) / 0.3), gone = fmax(0.0, (t - 0.5) / 0.3);
    const double w[HELD] = {1.0, 1.0, smooth(in) * (1.0 - smooth(gone))};
    /* a flat foot's centre is half of 0.22 + 0.02 m ahead of its heel; z is to the right */
    const double p[HELD][3] = {{0.07, 0.0, 0.09}, {0.07, 0.0, -0.09}, {0.4, 1.22, 0.25}};
    center_of_mass(&at_rail, t, center);
    share(w, p, center, wrench + 6 * k, d.ground_reaction.moment_arm, d.ground_reaction.slant, out);
    for (int i = 0; i < 3; i++) {
      assert_close(feet[6 * k + i] / weight, out[0][i] / weight, 1e-9);
      assert_close(feet[6 * k + 3 + i] / weight, out[1][i] / weight, 1e-9);
      assert_close(hands[3 * PATCHES * k + i] / weight, out[2][i] / weight, 1e-9);
      assert_close(tau[7 * k + i] / weight, 0.0, 1e-11);
      assert_true(hands[3 * (PATCHES * k + SEAT) + i] == 0.0);
    }
    assert_true(hands[3 * PATCHES * k + 1] > 0.005 * weight);
    assert_true(isnan(cop[3 * (PATCHES * k + SEAT)]));
    /* (c - p) x f about the normal alone */
    const double *at = cop + 3 * PATCHES * k, *f = hands + 3 * PATCHES * k;
    assert_close(at[1], 1.22, 1e-12);
    double ahead = at[0] - 0.4, right = at[2] - 0.25;
    assert_close((-right * f[1]) / weight, out[2][3] / weight, 1e-9);
    assert_close((ahead * f[1]) / weight, out[2][5] / weight, 1e-9);
  }
  const ambulo_problem *problem = at_rail.problem;
  for (double t = 0.1; t < 1.0; t += 0.2) {
    assert_int_equal(patch_contact_index_at(problem, HAND_R, t), t > 0.2 && t < 0.8 ? 2 : -1);
    assert_int_equal(patch_contact_index_at(problem, SEAT, t), -1);
  }
  for (int foot = 0; foot < 2; foot++)
    assert_int_equal(contact_index_at(problem, foot, 0.5), foot == WALKER_RIGHT ? 0 : 1);
  unpose(&at_rail);
  ambulo_model_free(model);
}

/* ------------------------------------------------------------------- refusals */

static void what_does_not_go_is_refused(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0), *legs = four_legs(1), *no_feet = four_legs(0);
  const ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, -0.09}},
      OF_PATCH(HAND_R, 0.0, 1.0, {0.4, -0.25, 1.22})};
  ambulo_problem_definition d = definition_of(model, contacts, 2);
  d.model = no_feet;
  d.contact_count = 0;
  d.ground_reaction.kind = AMBULO_REACTION_SHARED;
  refuse(&d, "press on the surroundings with 0 links (toes behind a joint count); expected 1 to 6");
  /* four feet and three patches */
  const int link = ambulo_model_find_link(legs, "pelvis");
  const ambulo_point points[] = {{"a", link, {0, 0, 0}}, {"b", link, {0, 0, 1}}, {"c", link, {0}}};
  int first = legs->point_count;
  const ambulo_patch patches[] = {{"one", first, {0.1, 0.1}, -1},
                                  {"two", first + 1, {0.1, 0.1}, -1},
                                  {"three", first + 2, {0.1, 0.1}, -1}};
  legs = with_more(legs, points, 3, patches, 3);
  const ambulo_contact seven[] = {OF_PATCH(0, 0.0, 1.0, {0.0}), OF_PATCH(1, 0.0, 1.0, {0.0}),
                                  OF_PATCH(2, 0.0, 1.0, {0.0})};
  d.model = legs;
  d.contacts = seven;
  d.contact_count = 3;
  refuse(&d, "press on the surroundings with 7 links");
  d.contact_count = 2; /* six are not too many */
  ambulo_problem_free(create(&d));
  /* a hand that is too far away */
  d.model = model;
  ambulo_contact far[] = {contacts[0], contacts[1]};
  far[1].place[0] = 3.0;
  d.contacts = far;
  d.contact_count = 2;
  refuse(&d, "contacts[0] (foot 'right') and contacts[1] (patch 'hand_r') are out of reach");
  ambulo_model_free(model);
  ambulo_model_free(legs);
  ambulo_model_free(no_feet);
}

/* what is true at any point, with any multipliers: those are such that every row counts */
static ambulo_result *scattered_at(const ambulo_problem *problem, const posed *p) {
  ambulo_result *result = NULL;
  ambulo_options options = ambulo_problem_options(problem);
  assert_int_equal(ambulo_audit_point(problem, &options, p->x, NULL, NULL, &result), AMBULO_OK);
  for (int r = 0; r < result->rows; r++) result->multiplier[r] = 0.1 * sin(1.0 + 2.3 * r);
  result->verdict = AMBULO_OPTIMAL;
  return result;
}

static const ambulo_sensitivity *find_number(const ambulo_sensitivity_list *list,
                                             const char *name) {
  for (int i = 0; i < list->count; i++)
    if (!strcmp(list->items[i].name, name)) return &list->items[i];
  print_error("no '%s' of %d numbers\n", name, list->count);
  return NULL;
}

/* where the hand is, ahead and up, and how far off it may be: derivatives of the Lagrangian against
 * central differences of problems made anew */
static void sensitivities_know_of_hands(void **state) {
  (void)state;
  static const char *const names[] = {"contacts[2].place[0]", "contacts[2].place[1]",
                                      "contacts[2].place[2]", "constraints.contact_tolerance"};
  static const double by = 1e-5;
  ambulo_model *model = patched_walker(0);
  ambulo_contact contacts[3];
  memcpy(contacts, feet_and_hand, sizeof contacts);
  ambulo_problem_definition d = definition_of(model, contacts, 3);
  ambulo_term terms[2] = {ambulo_term_default(AMBULO_ACCELERATION),
                          ambulo_term_default(AMBULO_GROUND_FORCE)};
  d.terms = terms;
  d.term_count = 2;
  posed p = pose(&d, 0.03, 0.4);
  ambulo_result *result = scattered_at(p.problem, &p);
  ambulo_sensitivity_list *list = NULL;
  assert_int_equal(ambulo_sensitivities(p.problem, result, NULL, &list), AMBULO_OK);
  assert_string_equal(list->reason, "");
  assert_true(list->count > 6);
  double *const numbers[] = {&contacts[2].place[0], &contacts[2].place[1], &contacts[2].place[2],
                             &d.contact_tolerance};
  for (int i = 0; i < 4; i++) {
    const ambulo_sensitivity *s = find_number(list, names[i]);
    assert_non_null(s);
    double kept = *numbers[i], value[2];
    for (int k = 0; k < 2; k++) {
      *numbers[i] = kept + (k ? by : -by);
      ambulo_problem *moved = create(&d);
      value[k] = lagrangian_at(moved, result->x, result->multiplier, result->rows);
      ambulo_problem_free(moved);
    }
    *numbers[i] = kept;
    double difference = (value[1] - value[0]) / (2.0 * by);
    assert_true(fabs(difference) > 1e-3);
    assert_close(s->derivative, difference,
                 1e-7 * fabs(difference) + 1e-14 * (fabs(value[0]) + 1.0) / by);
  }
  ambulo_sensitivities_free(list);
  ambulo_result_free(result);
  unpose(&p);
  ambulo_model_free(model);
}

/* the left hand is no mirror image of the right one: smaller, elsewhere, or on another link */
static void mirrored_ends_ask_for_partners(void **state) {
  (void)state;
  static const char *const said[] = {
      NULL, "patch 'hand_r' (0.08 by 0.04 m) is not the mirror image of 'hand_l' (0.1 by 0.04 m)",
      "is not the mirror image of 'hand_l' (0.08 by 0.04 m), by 0.1 m at q = 0",
      "patch 'hand_r' moves with 'pelvis_tx' and its mirror image 'hand_l' with 'hip_l'"};
  for (int off = 0; off < 4; off++) {
    ambulo_model *model = patched_walker(0);
    ambulo_patch *hand = &model->patches[HAND_L];
    ambulo_problem_definition d = definition_of(model, feet_and_hand, 3);
    d.ends = AMBULO_ENDS_MIRRORED;
    if (off == 1) hand->size[0] = 0.05;
    if (off == 2) model->neutral[3 * hand->point] += 0.1;
    if (off == 3) model->points[hand->point].link = ambulo_model_find_link(model, "thigh_l");
    if (said[off]) {
      refuse(&d, said[off]);
    } else {
      ambulo_problem_free(create(&d));
    }
    d.contact_count = 2; /* what is not used may be anything */
    ambulo_problem_free(create(&d));
    ambulo_model_free(model);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(four_legs_carry_a_quarter_each),
                                     cmocka_unit_test(a_hand_on_a_rail_takes_what_the_law_says),
                                     cmocka_unit_test(what_does_not_go_is_refused),
                                     cmocka_unit_test(sensitivities_know_of_hands),
                                     cmocka_unit_test(mirrored_ends_ask_for_partners)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
