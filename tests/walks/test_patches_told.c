/* Patches in whole problems: what strides, tables, and the look between the nodes say of them. */
#include "formats/motion_write.h"
#include "solver/dense.h"
#include "people/stride_measures.h"
#include "people/stride.h"
#include "support/patched_problem.h"

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
                                .grf_moment = s->grf_moment,
                                .patches = 2,
                                .patch = hands,
                                .patch_force = s->patch_force,
                                .patch_cop = s->patch_cop,
                                .patch_free_moment = s->patch_free_moment,
                                .patch_moment = s->patch_moment};
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
      snprintf(heading, sizeof heading, "moment.%s.z", s->model->patches[hands[i]].name);
      assert_close(strtod(field(csv, heading, k), NULL), s->patch_moment[3 * at + 2], 0.0);
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
  ambulo_problem_definition d = definition_of(model, feet_and_hand, 3);
  d.ends = AMBULO_ENDS_MIRRORED;
  posed p = pose(&d, 0.02, 0.4);
  double impulse[5 * 3];
  ambulo__stride s;
  assert_int_equal(ambulo__stride_create(p.problem, p.x, 21, NULL, &s), AMBULO_OK);
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
  assert_int_equal(ambulo__impulses(p.problem, p.x, NULL, impulse), AMBULO_OK);
  for (int i = 0; i < 3; i++)
    assert_close(impulse[3 * (2 + HAND_R) + i] * (i == 2 ? -1.0 : 1.0),
                 impulse[3 * (2 + HAND_L) + i], 1e-9);
  assert_true(impulse[3 * (2 + HAND_R) + 1] > 1.0);
  unpose(&p);
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

/* of the right hand at every sample: its place, and its force in body weights */
typedef struct sampled {
  double place[3], force[3];
} sampled;

static void sample_hand(const posed *p, int count, sampled *out) {
  const ambulo_model *model = ambulo_problem_model(p->problem);
  int points = model->point_count, palm = model->patches[HAND_R].point;
  double *times = calloc((size_t)count, sizeof *times);
  double *place = calloc((size_t)(3 * points * count), sizeof *place);
  double *force = calloc((size_t)(3 * PATCHES * count), sizeof *force);
  for (int k = 0; k < count; k++) times[k] = (double)k / (count - 1);
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .points = place, .patch_force = force};
  read_motion(p, count, times, &motion);
  for (int k = 0; k < count; k++)
    for (int i = 0; i < 3; i++) {
      out[k].place[i] = place[3 * (points * k + palm) + i];
      out[k].force[i] = force[3 * (PATCHES * k + HAND_R) + i] / weight;
    }
  free(times);
  free(place);
  free(force);
}

/* how far from the line between its values at the nodes around */
static void off_line(const sampled *at, int k, double place[3], double force[3]) {
  const sampled *before = at + k / FINER * FINER, *after = before + FINER;
  double part = (double)(k % FINER) / FINER;
  for (int i = 0; i < 3; i++) {
    place[i] = at[k].place[i] - (1.0 - part) * before->place[i] - part * after->place[i];
    force[i] = at[k].force[i] - (1.0 - part) * before->force[i] - part * after->force[i];
  }
}

/* slip of a hand along a wall, which does not care about the way to the wall and back, and how far
 * its force is from the lines between the nodes, from the motion itself */
static void patches_are_looked_at_between_nodes(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0);
  ambulo_contact contacts[] = {feet_and_hand[0], feet_and_hand[1], feet_and_hand[2]};
  contacts[2].normal[0] = -1.0;
  ambulo_problem_definition d = definition_of(model, contacts, 3);
  posed p = pose(&d, 0.02, 1.1);
  sampled hand[NODES * FINER + 1];
  sample_hand(&p, NODES * FINER + 1, hand);
  double slip = 0.0, bent = 0.0;
  for (int k = 2 * FINER; k < 6 * FINER; k++) {
    double place[3], force[3];
    off_line(hand, k, place, force);
    slip = fmax(slip, hypot(place[1], place[2]));
    bent = fmax(bent, sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]));
  }
  assert_true(slip > 1e-5 && bent > 1e-3);
  ambulo__dense dense;
  assert_int_equal(ambulo__dense_open(p.problem, p.x, FINER, 0.0, NULL, NULL, &dense), AMBULO_OK);
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
  unpose(&p);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(strides_mirror_patches),
                                     cmocka_unit_test(patches_are_looked_at_between_nodes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
