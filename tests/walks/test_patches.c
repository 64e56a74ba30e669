/* Patches in whole problems: who carries what, by hand and by a law that is solved otherwise; what
 * strides and results say of them. */
#include "ambulo/ambulo.h"
#include "format/motion_csv.h"
#include "judge/dense.h"
#include "mechanics/pose.h"
#include "stride/impulse.h"
#include "stride/stride.h"
#include "support/messages.h"
#include "support/patched_walker.h"

static const double weight = 72.0 * 9.81;

static ambulo_problem_definition definition_of(const ambulo_model *model,
                                               const ambulo_contact *contacts, int count) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = model;
  d.contacts = contacts;
  d.contact_count = count;
  d.intervals = 8;
  d.ground_reaction.kind = AMBULO_REACTION_SHARED;
  d.contact_tolerance = 0.002;
  return d;
}

static ambulo_problem *create(const ambulo_problem_definition *d) {
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_problem_create(d, NULL, list, &problem);
  if (status) assert_message(list, 0, "no message");
  ambulo_diagnostics_free(list);
  assert_int_equal(status, AMBULO_OK);
  return problem;
}

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
    ambulo_problem *problem = create(&d);
    ambulo_workspace *workspace = NULL;
    assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
    double *x = calloc((size_t)ambulo_problem_variable_count(problem), sizeof *x);
    double force[3 * LEGS], cop[3 * LEGS], tau[8], time = 0.4;
    ambulo_motion motion = {.tau = tau};
    *(on_feet ? &motion.grf : &motion.patch_force) = force;
    *(on_feet ? &motion.cop : &motion.patch_cop) = cop;
    assert_int_equal(ambulo_problem_motion(problem, workspace, x, 1, &time, &motion), AMBULO_OK);
    for (int i = 0; i < LEGS; i++) {
      assert_close(force[3 * i + 1] / weight, 0.25, 1e-9);
      /* as far to the outside on each side */
      assert_close(force[3 * i] / weight, -leg_forward[i] / 0.3 * fabs(force[0]) / weight, 1e-9);
      assert_close(fabs(cop[3 * i]), fabs(cop[0]), 1e-9);
    }
    for (int i = 0; i < 3; i++) assert_close(tau[i] / weight, 0.0, 1e-11);
    free(x);
    ambulo_workspace_free(workspace);
    ambulo_problem_free(problem);
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

static void center_of_mass(const ambulo_problem *problem, ambulo_workspace *workspace,
                           const double *x, double time, double center[3]) {
  const ambulo_model *model = ambulo_problem_model(problem);
  double q[7], place[3];
  ambulo_motion motion = {.q = q};
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  ambulo__pose pose;
  assert_int_equal(ambulo_problem_motion(problem, workspace, x, 1, &time, &motion), AMBULO_OK);
  assert_int_equal(ambulo__pose_create(model, &a, &pose), AMBULO_OK);
  ambulo__pose_at(&pose, q);
  for (int i = 0; i < 3; i++) center[i] = 0.0;
  for (int b = 0; b < model->link_count; b++) {
    ambulo__pose_point(&pose, b, model->links[b].com, place);
    for (int i = 0; i < 3; i++) center[i] += place[i] * model->links[b].mass / model->mass;
  }
  ambulo__pose_free(&pose);
}

/* both feet flat and a hand on a rail from 0.2 to 0.8 s, half of its weight at 0.35 s */
static void a_hand_on_a_rail_takes_what_the_law_says(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0);
  const ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, -0.09}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, 0.09}},
      OF_PATCH(HAND_R, 0.2, 0.8, {0.4, -0.25, 1.22})};
  ambulo_problem_definition d = definition_of(model, contacts, 3);
  ambulo_problem *problem = create(&d);
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  int n = ambulo_problem_variable_count(problem), d7 = ambulo_model_coordinate_count(model);
  double *x = calloc((size_t)n, sizeof *x);
  for (int i = 0; i < n; i++) x[i] = 0.03 * sin(0.4 * (i / d7) + 1.3 * (i % d7));
  static const double times[] = {0.25, 0.35, 0.5, 0.7};
  double feet[4 * 6], hands[4 * PATCHES * 3], cop[4 * PATCHES * 3], wrench[4 * 6], tau[4 * 7];
  ambulo_motion motion = {
      .tau = tau, .wrench = wrench, .grf = feet, .patch_force = hands, .patch_cop = cop};
  assert_int_equal(ambulo_problem_motion(problem, workspace, x, 4, times, &motion), AMBULO_OK);
  for (int k = 0; k < 4; k++) {
    double t = times[k], out[HELD][6], center[3];
    const double in = fmin(1.0, (t - 0.2) / 0.3), gone = fmax(0.0, (t - 0.5) / 0.3);
    const double w[HELD] = {1.0, 1.0, smooth(in) * (1.0 - smooth(gone))};
    /* a flat foot's centre is half of 0.22 + 0.02 m ahead of its heel; z is to the right */
    const double p[HELD][3] = {{0.07, 0.0, 0.09}, {0.07, 0.0, -0.09}, {0.4, 1.22, 0.25}};
    center_of_mass(problem, workspace, x, t, center);
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
  for (double t = 0.1; t < 1.0; t += 0.2) {
    assert_int_equal(ambulo_problem_patch_contact_at(problem, HAND_R, t),
                     t > 0.2 && t < 0.8 ? 2 : -1);
    assert_int_equal(ambulo_problem_patch_contact_at(problem, SEAT, t), -1);
  }
  assert_int_equal(ambulo_problem_patch_contact_at(problem, PATCHES, 0.5), -1);
  assert_int_equal(ambulo_problem_patch_contact_at(problem, -1, 0.5), -1);
  assert_int_equal(ambulo_problem_contact_at(problem, 2, 0.5), -1);
  free(x);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

/* ------------------------------------------------------------ mirrored strides */

/* the field under a heading, in line k of the numbers; NULL: there is no such heading */
static const char *field(const char *table, const char *heading, int k) {
  const char *line = strchr(table, '\n') + 1, *at = strstr(line, heading);
  if (!at || at > strchr(line, '\n')) return NULL;
  int column = 0;
  for (const char *c = line; c < at; c++) column += *c == ',';
  for (int i = 0; i <= k; i++) line = strchr(line, '\n') + 1;
  for (; column > 0; line++) column -= *line == ',';
  return line;
}

/* both hands, of which one is down in the second step only; no seat */
static void expect_columns(const ambulo__stride *s) {
  static const int hands[] = {HAND_L, HAND_R};
  ambulo__motion_table table = {.model = s->model,
                                .name = "hands",
                                .samples = s->samples,
                                .times = s->times,
                                .q = s->q,
                                .qd = s->qd,
                                .qdd = s->qdd,
                                .tau = s->tau,
                                .zmp = s->zmp,
                                .feet = s->feet,
                                .grf = s->grf,
                                .cop = s->cop,
                                .free_moment = s->free_moment,
                                .patches = 2,
                                .patch = hands,
                                .patch_force = s->patch_force,
                                .patch_cop = s->patch_cop,
                                .patch_free_moment = s->patch_free_moment};
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__motion_csv(&table, &text);
  const char *csv = ambulo__text_data(&text);
  for (int k = 0; k < s->samples; k++) {
    for (int i = 0; i < 2; i++) {
      char heading[40];
      size_t at = (size_t)(PATCHES * k + hands[i]);
      snprintf(heading, sizeof heading, "grf.%s.y", s->model->patches[hands[i]].name);
      assert_close(strtod(field(csv, heading, k), NULL), s->patch_force[3 * at + 1], 0.0);
      snprintf(heading, sizeof heading, "free_moment.%s", s->model->patches[hands[i]].name);
      assert_close(strtod(field(csv, heading, k), NULL), s->patch_free_moment[at], 0.0);
      snprintf(heading, sizeof heading, "cop.%s.x", s->model->patches[hands[i]].name);
      double place = strtod(field(csv, heading, k), NULL);
      assert_true(place == s->patch_cop[3 * at] || (isnan(place) && isnan(s->patch_cop[3 * at])));
    }
  }
  assert_null(field(csv, "grf.seat", 0));
  ambulo__text_free(&text);
}

/* the right hand in one step is the left one in the next: force, place and contact reflected */
static void strides_mirror_patches(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0);
  const ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, -0.09}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, 0.09}},
      OF_PATCH(HAND_R, 0.2, 0.8, {0.4, -0.25, 1.22})};
  ambulo_problem_definition d = definition_of(model, contacts, 3);
  d.ends = AMBULO_ENDS_MIRRORED;
  ambulo_problem *problem = create(&d);
  int n = ambulo_problem_variable_count(problem);
  double *x = calloc((size_t)n, sizeof *x), impulse[5 * 3];
  for (int i = 0; i < n; i++) x[i] = 0.02 * sin(0.4 * (i / 7) + 1.3 * (i % 7));
  ambulo__stride s;
  assert_int_equal(ambulo__stride_create(problem, x, 21, NULL, &s), AMBULO_OK);
  assert_int_equal(s.patches, PATCHES);
  int pressed = 0;
  for (int k = 0; k < 10; k++) {
    const double *one = ambulo__stride_patch_force(&s, k, HAND_R);
    const double *other = ambulo__stride_patch_force(&s, k + 10, HAND_L);
    const double *place = s.patch_cop + 3 * (PATCHES * k + HAND_R);
    const double *image = s.patch_cop + 3 * (PATCHES * (k + 10) + HAND_L);
    if (k == 0) continue; /* a sample at T is of the first step */
    for (int i = 0; i < 3; i++) {
      double sign = i == 2 ? -1.0 : 1.0;
      assert_close(sign * one[i] / weight, other[i] / weight, 1e-12);
      if (!isnan(place[0])) assert_close(sign * place[i], image[i], 1e-12);
    }
    pressed += one[1] != 0.0;
    double t = s.times[k];
    assert_ptr_equal(ambulo__stride_contact(&s, 2 + HAND_R, t),
                     ambulo__stride_contact(&s, 2 + HAND_L, t + 1.0));
    assert_null(ambulo__stride_contact(&s, 2 + HAND_L, t));
  }
  assert_true(pressed >= 5);
  assert_close(ambulo__stride_patch_peak(&s, HAND_R), ambulo__stride_patch_peak(&s, HAND_L), 1e-12);
  assert_true(ambulo__stride_patch_peak(&s, HAND_R) > 0.01);
  assert_close(ambulo__stride_patch_peak(&s, SEAT), 0.0, 0.0);
  expect_columns(&s);
  ambulo__stride_free(&s);
  assert_int_equal(ambulo__impulses(problem, x, NULL, impulse), AMBULO_OK);
  for (int i = 0; i < 3; i++)
    assert_close(impulse[3 * (2 + HAND_R) + i] * (i == 2 ? -1.0 : 1.0),
                 impulse[3 * (2 + HAND_L) + i], 1e-9);
  assert_true(impulse[3 * (2 + HAND_R) + 1] > 1.0);
  free(x);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

/* ------------------------------------------------------------ between the nodes */

enum { NODES = 8, FINER = 10 };

typedef struct seen {
  const char *family, *subject;
  int count;
  double value, first, last;
} seen;

static void keep(void *user, const ambulo__dense_sample *sample) {
  seen *s = user;
  if (strcmp(sample->family, s->family) != 0 || strcmp(sample->subject, s->subject) != 0) return;
  s->first = s->count ? fmin(s->first, sample->time) : sample->time;
  s->last = fmax(s->last, sample->time);
  s->count++;
  if (sample->time > 0.25 && sample->time < 0.75) s->value = fmax(s->value, sample->value);
}

/* slip of a hand along a wall, which does not care about the way to the wall and back, and how far
 * its force is from the lines between the nodes, from the motion itself */
static void patches_are_looked_at_between_nodes(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0);
  ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, -0.09}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, 0.09}},
      OF_PATCH(HAND_R, 0.2, 0.8, {0.4, -0.25, 1.22})};
  contacts[2].normal[0] = -1.0;
  ambulo_problem_definition d = definition_of(model, contacts, 3);
  ambulo_problem *problem = create(&d);
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  int n = ambulo_problem_variable_count(problem), points = model->point_count;
  double *x = calloc((size_t)n, sizeof *x), *place, *force, times[NODES * FINER + 1];
  for (int i = 0; i < n; i++) x[i] = 0.02 * sin(1.1 * (i / 7) + 1.3 * (i % 7));
  int count = NODES * FINER + 1, palm = model->patches[HAND_R].point;
  for (int k = 0; k < count; k++) times[k] = (double)k / (count - 1);
  place = calloc((size_t)(3 * points * count), sizeof *place);
  force = calloc((size_t)(3 * PATCHES * count), sizeof *force);
  ambulo_motion motion = {.points = place, .patch_force = force};
  assert_int_equal(ambulo_problem_motion(problem, workspace, x, count, times, &motion), AMBULO_OK);
  double slip = 0.0, bent = 0.0;
  for (int k = 2 * FINER; k < 6 * FINER; k++) {
    double off[2][3], part = (double)(k % FINER) / FINER;
    int a = k / FINER * FINER;
    for (int i = 0; i < 3; i++) {
      int r = 3 * points, at = 3 * palm + i, f = 3 * PATCHES, of = 3 * HAND_R + i;
      off[0][i] =
          place[r * k + at] - (1.0 - part) * place[r * a + at] - part * place[r * (a + FINER) + at];
      off[1][i] = (force[f * k + of] - (1.0 - part) * force[f * a + of] -
                   part * force[f * (a + FINER) + of]) /
                  weight;
    }
    slip = fmax(slip, hypot(off[0][1], off[0][2]));
    bent = fmax(bent, sqrt(off[1][0] * off[1][0] + off[1][1] * off[1][1] + off[1][2] * off[1][2]));
  }
  assert_true(slip > 1e-5 && bent > 1e-3);
  ambulo__dense dense;
  assert_int_equal(ambulo__dense_open(problem, x, FINER, 0.0, NULL, NULL, &dense), AMBULO_OK);
  seen slipping = {.family = "slip", .subject = "palm_r"};
  seen pushing = {.family = "ground_force", .subject = "hand_r"};
  ambulo__dense_slip(&dense, keep, &slipping);
  ambulo__dense_force(&dense, keep, &pushing);
  assert_close(slipping.value, slip, 1e-12);
  assert_close(slipping.first, 0.2, 1e-12); /* where the contact begins, and ends */
  assert_close(slipping.last, 0.8, 1e-12);
  assert_close(pushing.value, bent, 1e-12);
  seen others[] = {{.family = "slip", .subject = "palm_l"},
                   {.family = "slip", .subject = "seat"},
                   {.family = "ground_force", .subject = "seat"}};
  for (int i = 0; i < 3; i++) {
    ambulo__dense_slip(&dense, keep, &others[i]);
    ambulo__dense_force(&dense, keep, &others[i]);
    assert_int_equal(others[i].count, 0);
  }
  ambulo__dense_close(&dense);
  free(x);
  free(place);
  free(force);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
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
  d.ground_reaction.kind = AMBULO_REACTION_TWO_STEP;
  refuse(&d, "contacts[1]: patch 'hand_r' does not go with ground_reaction: {kind: two_step}; "
             "expected feet alone");
  d.model = legs;
  d.contact_count = 1;
  refuse(&d, "ground_reaction: kind two_step, but the model 'model' has 4 feet; expected 2");
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

static ambulo_status no_problem(void *user, const double *values, const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics, ambulo_problem **problem) {
  (void)user, (void)values, (void)allocator, (void)diagnostics, (void)problem;
  return AMBULO_E_INTERNAL;
}

/* no sensitivities yet, and so nothing that is chosen by them */
static void there_are_no_sensitivities_yet(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0);
  const ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, -0.09}},
      OF_PATCH(HAND_R, 0.2, 0.8, {0.4, -0.25, 1.22})};
  ambulo_problem_definition d = definition_of(model, contacts, 2);
  ambulo_term term = ambulo_term_default(AMBULO_ACCELERATION);
  d.terms = &term;
  d.term_count = 1;
  ambulo_problem *problem = create(&d), *best = NULL;
  ambulo_options options = ambulo_problem_options(problem);
  double *zero = calloc((size_t)ambulo_problem_variable_count(problem), sizeof *zero);
  ambulo_result *result = NULL;
  ambulo_sensitivity_list *list = NULL;
  assert_int_equal(ambulo_audit_point(problem, &options, zero, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_sensitivities(problem, result, NULL, &list), AMBULO_OK);
  assert_int_equal(list->count, 0);
  assert_string_equal(list->reason, "there are none yet for contacts of patches");
  ambulo_sensitivities_free(list);
  ambulo_result_free(result);
  ambulo_parameter item = {.name = "subject.mass", .lower = 50.0, .upper = 90.0};
  ambulo_parameters free_ones = ambulo_parameters_default();
  free_ones.items = &item;
  free_ones.count = 1;
  free_ones.problem_at = no_problem;
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  assert_int_equal(
      ambulo_solve_parameters(problem, &free_ones, NULL, NULL, NULL, messages, &best, &result),
      AMBULO_E_ARGUMENT);
  assert_message(messages, 0, "which contacts of patches do not have yet");
  ambulo_diagnostics_free(messages);
  free(zero);
  ambulo_problem_free(problem);
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
    const ambulo_contact contacts[] = {
        {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, -0.09}},
        {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, 0.09}},
        OF_PATCH(HAND_R, 0.2, 0.8, {0.4, -0.25, 1.22})};
    ambulo_problem_definition d = definition_of(model, contacts, 3);
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
                                     cmocka_unit_test(strides_mirror_patches),
                                     cmocka_unit_test(patches_are_looked_at_between_nodes),
                                     cmocka_unit_test(what_does_not_go_is_refused),
                                     cmocka_unit_test(there_are_no_sensitivities_yet),
                                     cmocka_unit_test(mirrored_ends_ask_for_partners)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
