/* Feet that roll, at times far between the nodes: the ground does next to no work on the shipped
 * walks, what is loaded slips no further than its tolerance, and what the feet give is what the
 * body's momentum gains.
 *
 * Work, two ways that share nothing but the motion: what the joints give,
 *
 *     W_joints = sum over the joints of int tau qd dt,   W_ground = m g . (path) - W_joints
 *
 * as the body's energy is the same after a step but for the height it has gained; and what the feet
 * take, from their points and the ground's forces alone,
 *
 *     W_ground = sum over the feet of int F . (v + omega x (c - h)) + M n . omega dt
 *
 * with h the heel's centre and v its velocity, c the centre of pressure, M the free moment, omega
 * from the foot's own three axes x_i: omega = sum x_i x (dx_i / dt) / 2. Velocities are central
 * differences of positions. */
#include "problem/nlp.h"
#include "support/solved_walk.h"

enum { WALKS = 11 };

static const double most_work = 0.01; /* of the ground, by the joints' positive, of feet that may
                                       * be half a millimetre off; more in proportion */

static const struct {
  const char *path, *setting;
} walks[WALKS] = {{"models/walk.yaml", NULL},
                  {"models/walk.yaml", "gait.speed=0.6"},
                  {"models/walk.yaml", "gait.speed=0.8"},
                  {"models/walk.yaml", "gait.speed=1.8"},
                  {"models/walk.yaml", "gait.speed=2.2"},
                  {"models/walk_normal.yaml", NULL},
                  {"models/walk_loaded.yaml", NULL},
                  {"models/walk_uphill.yaml", NULL},
                  {"models/walk_asymmetric.yaml", NULL},
                  {"models/walk_tracking.yaml", NULL},
                  {"models/walk.yaml", "constraints.contact_tolerance=0.0005"}};

static const char *name_of(int i) {
  return walks[i].setting ? walks[i].setting : walks[i].path;
}

/* half millimetres that the feet may be off, at least one */
static double looseness(const walk *w) {
  double tolerance = w->problem->definition.contact_tolerance;
  return fmax(tolerance / 0.0005, 1.0);
}

static double lifted(const walk *w) {
  const double *g = ambulo_model_gravity(w->model);
  double work = 0.0;
  static const char *const root[3] = {"pelvis_tx", "pelvis_ty", "pelvis_tz"};
  int d = ambulo_model_coordinate_count(w->model);
  for (int i = 0; i < 3; i++) {
    int c = ambulo_model_find_coordinate(w->model, root[i]);
    assert_true(c >= 0);
    /* sideways a mirrored step ends where its image begins, across gravity */
    if (i < 2) work -= g[i] * (w->q[(SAMPLES - 1) * d + c] - w->q[c]);
  }
  return ambulo_model_mass(w->model) * work;
}

static double work_at_the_feet(const walk *w) {
  double work = 0.0;
  for (int foot = 0; foot < FEET; foot++) {
    int point[FOOT_POINTS];
    points_of(w, foot, point);
    for (int k = 0; k < SAMPLES; k++) work += power(w, point, foot, k) * part_of_interval(w, k);
  }
  return work;
}

/* speed along the surface of the point of a foot at its centre of pressure where it carries more
 * than a twentieth of the body, m/s; *rms over the time that feet do */
static double slip(const walk *w, double *rms) {
  const double *up = ambulo_model_up(w->model), *g = ambulo_model_gravity(w->model);
  double least = 0.05 * ambulo_model_mass(w->model) * sqrt(dot(g, g)), most = 0.0, sum = 0.0;
  double time = 0.0;
  for (int foot = 0; foot < FEET; foot++) {
    int point[FOOT_POINTS];
    points_of(w, foot, point);
    for (int k = 0; k < SAMPLES; k++) {
      double omega[3], velocity[3], part = part_of_interval(w, k);
      if (dot(w->grf + 3 * (FEET * k + foot), up) <= least) continue;
      assert_true(motion_at_contact(w, point, foot, k, omega, velocity));
      double rise = dot(velocity, up), square = dot(velocity, velocity) - rise * rise;
      most = fmax(most, sqrt(square));
      sum += square * part;
      time += part;
    }
  }
  *rms = sqrt(sum / time);
  return most;
}

/* ------------------------------------------------------------------ momentum */

/* m v: the root's force for accelerations that are the velocities, of a body at rest without
 * gravity */
static void momentum(const walk *w, int k, double out[3]) {
  int d = ambulo_model_coordinate_count(w->model);
  double *still = room(1), with[6], without[6];
  ambulo_mechanics *mechanics = NULL;
  assert_true(d <= SAMPLES);
  assert_int_equal(ambulo_mechanics_create(w->model, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, 1, w->q + k * d, still, w->qd + k * d,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .wrench = with}),
                   AMBULO_OK);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, 1, w->q + k * d, still, still,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .wrench = without}),
                   AMBULO_OK);
  for (int i = 0; i < 3; i++) out[i] = with[3 + i] - without[3 + i];
  ambulo_mechanics_free(mechanics);
  free(still);
}

/* what the feet give less what the body gains, along its axes, as a share of the weight times the
 * duration */
static double momentum_left(const walk *w) {
  const double *g = ambulo_model_gravity(w->model);
  double mass = ambulo_model_mass(w->model), duration = w->times[SAMPLES - 1];
  double before[3], after[3], worst = 0.0;
  momentum(w, 0, before);
  momentum(w, SAMPLES - 1, after);
  for (int i = 0; i < 3; i++) {
    double left = mass * g[i] * duration - (after[i] - before[i]);
    for (int k = 0; k < SAMPLES; k++)
      for (int foot = 0; foot < FEET; foot++)
        left += w->grf[3 * (FEET * k + foot) + i] * part_of_interval(w, k);
    worst = fmax(worst, fabs(left) / (mass * sqrt(dot(g, g)) * duration));
  }
  return worst;
}

/* ------------------------------------------------------------------- the walks */

static void the_ground_does_next_to_no_work(void **state) {
  const walk *all = *state;
  for (int i = 0; i < WALKS; i++) {
    const walk *w = &all[i];
    double positive, net = joint_work(w, &positive), ground = lifted(w) - net;
    double feet = work_at_the_feet(w), most = most_work * looseness(w) * positive;
    if (!(fabs(ground) <= most && fabs(feet - ground) <= 0.002 * positive))
      print_error("%s: the ground does %.3f J, at the feet %.3f J; joints %.2f J\n", name_of(i),
                  ground, feet, positive);
    assert_true(positive > 20.0);
    assert_true(fabs(ground) <= most);
    assert_true(fabs(feet - ground) <= 0.002 * positive);
  }
}

/* at rest would be 0: feet move within contact_tolerance and orientation_tolerance, to and fro as
 * fast as the trajectory's knots let them (measured with half a millimetre: 57 to 80 mm/s at most,
 * 23 to 30 rms; with 1 mm, walk.yaml: 78 to 170 at most, 33 to 70 rms) */
static void loaded_feet_slip_within_their_tolerance(void **state) {
  const walk *all = *state;
  for (int i = 0; i < WALKS; i++) {
    double rms, loose = looseness(&all[i]), most = slip(&all[i], &rms);
    if (!(most <= 0.105 * loose && rms <= 0.043 * loose))
      print_error("%s: %.1f mm/s at most, %.1f rms\n", name_of(i), 1e3 * most, 1e3 * rms);
    assert_true(most <= 0.105 * loose && rms <= 0.043 * loose);
  }
}

/* so that it is the tolerance that slips, not the arcs: less than 1 mm/s rms, 2 mm/s at most */
static void feet_that_are_held_do_not_slip(void **state) {
  (void)state;
  ONLY_IN_CHECK_LONG();
  static const char *const settings[] = {"trajectory.intervals=28",
                                         "constraints.contact_tolerance=4e-6",
                                         "constraints.orientation_tolerance=4e-5"};
  walk w;
  double rms;
  open_walk(&w, "models/walk_normal.yaml", settings, 3);
  double most = slip(&w, &rms);
  if (!(most <= 0.003 && rms <= 0.001))
    print_error("%.2f mm/s at most, %.2f rms\n", 1e3 * most, 1e3 * rms);
  assert_true(most <= 0.003 && rms <= 0.001);
  close_walk(&w);
}

static void momentum_is_balanced(void **state) {
  const walk *all = *state;
  for (int i = 0; i < WALKS; i++) assert_true(momentum_left(&all[i]) <= 1e-6);
}

static int open_all(void **state) {
  walk *all = calloc(WALKS, sizeof *all);
  assert_non_null(all);
  for (int i = 0; i < WALKS; i++)
    open_walk(&all[i], walks[i].path, &walks[i].setting, walks[i].setting != NULL);
  *state = all;
  return 0;
}

static int close_all(void **state) {
  walk *all = *state;
  for (int i = 0; i < WALKS; i++) close_walk(&all[i]);
  free(all);
  return 0;
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_ground_does_next_to_no_work),
                                     cmocka_unit_test(loaded_feet_slip_within_their_tolerance),
                                     cmocka_unit_test(feet_that_are_held_do_not_slip),
                                     cmocka_unit_test(momentum_is_balanced)};
  return cmocka_run_group_tests(tests, open_all, close_all);
}
