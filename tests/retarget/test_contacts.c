/* Contacts of feet whose strikes are known: heel and ball move by formulas. */
#include "retarget/contacts.h"

#include "support/fail_alloc.h"
#include "support/given_motion.h"

enum { ROWS = 201 };
static const double period = 1.0, stance = 0.6, step = 1.2; /* s, m */

/* At rest, then forward on an arch: the heel leaves `lag` before and strikes `lag` before the ball
 */
static void point(double time, double shift, double lag, double out[3]) {
  double u = (time + shift + lag) / period, turns = floor(u), share = u - turns;
  double swing = share < stance ? 0.0 : (share - stance) / (1.0 - stance);
  out[0] = step * (turns + swing);
  out[2] = 0.2 * sin(acos(-1.0) * swing);
}

static void walk_of(const ambulo__figure *f, double time[ROWS], ambulo__posture posture[ROWS]) {
  for (int k = 0; k < ROWS; k++) {
    ambulo__posture *p = &posture[k];
    time[k] = 2.0 * period * k / (ROWS - 1);
    for (int s = 0; s < AMBULO__SEGMENTS; s++) p->turn[s] = ambulo__rigid_identity();
    p->pelvis[0] = step * time[k];
    p->pelvis[1] = 0.0;
    p->pelvis[2] = 0.9;
    for (int side = 0; side < 2; side++) {
      point(time[k], 0.5 * side, 0.08, p->heel[side]);
      point(time[k], 0.5 * side, 0.0, p->toe[side]);
      p->heel[side][1] = p->toe[side][1] = side ? 0.1 : -0.1;
      p->heel[side][0] += f->heel[side][0];
      p->toe[side][0] += f->toe[side][0];
    }
  }
}

static void finds_walk(void **state) {
  (void)state;
  person p = person_open(person_file, 0.0);
  static double time[ROWS];
  static ambulo__posture posture[ROWS];
  ambulo__standings found;
  walk_of(&p.figure, time, posture);
  assert_int_equal(ambulo__standings_find(&p.figure, time, posture, ROWS, NULL, NULL, &found),
                   AMBULO_OK);
  int whole = 0;
  for (int i = 0; i < found.count; i++) {
    const ambulo__standing *s = &found.stance[i];
    double from = s->phase[0].from, to = s->phase[s->phases - 1].to;
    if (from < 0.02 || to > 1.98) continue; /* cut by the ends */
    whole++;
    /* strike of the heel to rise of the ball */
    assert_int_equal(s->phases, 3);
    assert_int_equal(s->phase[0].tread, AMBULO__ON_HEEL);
    assert_int_equal(s->phase[1].tread, AMBULO__ON_SOLE);
    assert_int_equal(s->phase[2].tread, AMBULO__ON_TOE);
    assert_close(to - from, stance + 0.08, 0.05);
    assert_close(s->phase[1].from - from, 0.08, 0.03);
    assert_close(s->heading, 0.0, 1e-12);
    assert_close(s->ankle[2], 0.0, 0.01);
    /* the foot of each strike is a step further than the one before */
    assert_close(s->ankle[0], step * floor(s->ankle[0] / step + 0.5), 0.03);
  }
  assert_true(whole >= 2);
  ambulo__standings_free(&found);
  person_close(&p);
}

/* stairs have floors of their own */
static void finds_floors(void **state) {
  (void)state;
  person p = person_open(person_file, 0.0);
  static double time[ROWS];
  static ambulo__posture posture[ROWS];
  ambulo__standings found;
  walk_of(&p.figure, time, posture);
  for (int k = 0; k < ROWS; k++)
    for (int side = 0; side < 2; side++) {
      double *heel = posture[k].heel[side], *toe = posture[k].toe[side];
      heel[2] += 0.3 * (heel[0] - p.figure.heel[side][0]) / step;
      toe[2] += 0.3 * (toe[0] - p.figure.toe[side][0]) / step;
    }
  assert_int_equal(ambulo__standings_find(&p.figure, time, posture, ROWS, NULL, NULL, &found),
                   AMBULO_OK);
  for (int i = 0; i < found.count; i++)
    assert_close(found.stance[i].ankle[2], 0.3 * floor(found.stance[i].ankle[0] / step + 0.5),
                 0.02);
  ambulo__standings_free(&found);
  person_close(&p);
}

static void flies(void **state) {
  (void)state;
  person p = person_open(person_file, 0.0);
  static double time[ROWS];
  static ambulo__posture posture[ROWS];
  ambulo__standings found;
  walk_of(&p.figure, time, posture);
  for (int k = 0; k < ROWS; k++)
    for (int side = 0; side < 2; side++)
      for (int i = 0; i < 3; i += 2) {
        posture[k].heel[side][i] += 3.0 * time[k];
        posture[k].toe[side][i] += 3.0 * time[k];
      }
  assert_int_equal(ambulo__standings_find(&p.figure, time, posture, ROWS, NULL, NULL, &found),
                   AMBULO_E_SCHEMA);
  person_close(&p);
}

static void memory_may_run_out_anywhere(void **state) {
  (void)state;
  person p = person_open(person_file, 0.0);
  static double time[ROWS];
  static ambulo__posture posture[ROWS];
  walk_of(&p.figure, time, posture);
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__standings found;
    ambulo_status status =
        ambulo__standings_find(&p.figure, time, posture, ROWS, &allocator, NULL, &found);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    if (!status) ambulo__standings_free(&found);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  person_close(&p);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(finds_walk), cmocka_unit_test(finds_floors),
                                     cmocka_unit_test(flies),
                                     cmocka_unit_test(memory_may_run_out_anywhere)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
