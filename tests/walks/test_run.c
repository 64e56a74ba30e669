/* The shipped runs, from zero: in flight the centre of mass falls and the angular momentum about it
 * stays, at ten times as many times as there are nodes; contacts and forces are those of a runner.
 *
 * Momenta are found apart from inverse dynamics, from where the bodies of the links are at q and a
 * little along qd to either side. */
#include "support/contact_index.h"
#include "support/scratch.h"
#include "support/shared_data.h"

#include "ambulo/tools/tools.h"
#include "contact/row_families.h"
#include "mechanics/pose.h"
#include "problem/nlp.h"

typedef struct run {
  ambulo_problem *problem;
  ambulo_result *result;
  ambulo_workspace *workspace;
} run;

static run solve_run(const char *name, const char *speed) {
  char path[SCRATCH_PATH];
  const char *settings[] = {speed};
  run r = {NULL, NULL, NULL};
  snprintf(path, sizeof path, "%s/models/%s.yaml", AMBULO_SOURCE_DIR, name);
  assert_int_equal(ambulo_problem_load(path, settings, speed != NULL, NULL, NULL, &r.problem),
                   AMBULO_OK);
  ambulo_options options = ambulo_problem_options(r.problem);
  assert_int_equal(ambulo_solve(r.problem, &options, NULL, NULL, NULL, &r.result), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(r.problem, NULL, &r.workspace), AMBULO_OK);
  ambulo_verdict verdict = ambulo_result_verdict(r.result);
  double violation = ambulo_result_audit(r.result)->violation.worst;
  if (verdict != AMBULO_OPTIMAL || !(violation <= 1e-6))
    print_error("%s: %s, violation %g\n", name, ambulo_verdict_name(verdict), violation);
  assert_true(verdict == AMBULO_OPTIMAL && violation <= 1e-6);
  return r;
}

static void free_run(run *r) {
  ambulo_workspace_free(r->workspace);
  ambulo_result_free(r->result);
  ambulo_problem_free(r->problem);
}

/* ------------------------------------------------------------------- momenta */

enum { COORDINATES = 31, FEET = 2 }; /* at most */

static const double apart = 1e-5; /* s: between the poses */

typedef struct momenta {
  double linear[3], angular[3]; /* N s; N m s about the centre of mass */
} momenta;

/* a x b, times factor */
static void add_cross(const double a[3], const double b[3], double factor, double c[3]) {
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    c[i] += factor * (a[j] * b[k] - a[k] * b[j]);
  }
}

/* I omega of a link's own body, world axes: of R' R^T = omega x, R in the frame's first columns */
static void add_own(const ambulo_link *link, const double *before, const double *now,
                    const double *after, double sum[3]) {
  double omega[3] = {0.0}, local[3] = {0.0};
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    for (int c = 0; c < 3; c++)
      omega[i] += (after[4 * k + c] - before[4 * k + c]) / (2.0 * apart) * now[4 * j + c];
  }
  for (int c = 0; c < 3; c++)
    for (int i = 0; i < 3; i++) local[c] += now[4 * i + c] * omega[i];
  const double *I = link->inertia;
  const double spin[3] = {I[0] * local[0] + I[3] * local[1] + I[4] * local[2],
                          I[3] * local[0] + I[1] * local[1] + I[5] * local[2],
                          I[4] * local[0] + I[5] * local[1] + I[2] * local[2]};
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 3; c++) sum[i] += now[4 * i + c] * spin[c];
}

static momenta momenta_of(const ambulo_model *m, ambulo__pose pose[3], const double *q,
                          const double *qd) {
  momenta sum = {{0.0}, {0.0}};
  double moved[COORDINATES], center[3][3];
  for (int s = 0; s < 3; s++) {
    for (int i = 0; i < m->coordinate_count; i++) moved[i] = q[i] + (s - 1) * apart * qd[i];
    ambulo__pose_at(&pose[s], moved);
    ambulo__pose_center_of_mass(&pose[s], center[s]);
  }
  for (int i = 0; i < 3; i++)
    sum.linear[i] = m->mass * (center[2][i] - center[0][i]) / (2.0 * apart);
  for (int l = 0; l < m->link_count; l++) {
    const ambulo_link *link = &m->links[l];
    double at[3][3], arm[3], velocity[3];
    for (int s = 0; s < 3; s++) ambulo__pose_point(&pose[s], l, link->com, at[s]);
    for (int i = 0; i < 3; i++) {
      arm[i] = at[1][i] - center[1][i];
      velocity[i] = (at[2][i] - center[2][i] - at[0][i] + center[0][i]) / (2.0 * apart);
    }
    add_cross(arm, velocity, link->mass, sum.angular);
    add_own(link, pose[0].frames + 12 * l, pose[1].frames + 12 * l, pose[2].frames + 12 * l,
            sum.angular);
  }
  return sum;
}

/* Momenta about the centre of mass in the time since the flight began. The flight tolerance alone
 * would let the angular one of a flight of 0.4 s change by .6 kg m^2/s; what it does at nodes and
 * between them cancels. */
static void momenta_are_those_of_a_body_in_flight(run *r) {
  enum { MOST = 800 };
  const ambulo_model *m = ambulo_problem_model(r->problem);
  static double times[MOST], q[MOST * COORDINATES], qd[MOST * COORDINATES];
  ambulo__span flight;
  ambulo__pose pose[3];
  int count = 0;
  assert_int_equal(ambulo__flight_span(&r->problem->definition, &flight), 1);
  for (int k = 0; k + 1 < r->problem->nodes; k++)
    for (int s = 0; s < 10; s++) {
      double from = r->problem->times[k], t = from + 0.1 * s * (r->problem->times[k + 1] - from);
      if (t >= flight.from && t <= flight.to && count < MOST) times[count++] = t;
    }
  const int n = m->coordinate_count;
  assert_true(count > 100 && count < MOST && n <= COORDINATES);
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .q = q, .qd = qd};
  assert_int_equal(ambulo_problem_motion(r->problem, r->workspace, ambulo_result_x(r->result),
                                         count, times, &motion),
                   AMBULO_OK);
  for (int s = 0; s < 3; s++) assert_int_equal(ambulo__pose_create(m, NULL, &pose[s]), AMBULO_OK);
  momenta first = momenta_of(m, pose, q, qd);
  for (int k = 1; k < count; k++) {
    momenta now = momenta_of(m, pose, q + k * n, qd + k * n);
    double since = times[k] - times[0], pushed = 0.1, turned = 0.05; /* N s, kg m^2/s */
    for (int i = 0; i < 3; i++) {
      double fallen = first.linear[i] + m->mass * m->gravity[i] * since;
      if (!(fabs(now.linear[i] - fallen) <= pushed &&
            fabs(now.angular[i] - first.angular[i]) <= turned))
        print_error("axis %d, %g s: %g N s, %g kg m^2/s\n", i, times[k], now.linear[i] - fallen,
                    now.angular[i] - first.angular[i]);
      assert_true(fabs(now.linear[i] - fallen) <= pushed);
      assert_true(fabs(now.angular[i] - first.angular[i]) <= turned);
    }
  }
  for (int s = 0; s < 3; s++) ambulo__pose_free(&pose[s]);
}

/* -------------------------------------------------------------------- forces */

enum { SAMPLES = 401 };

typedef struct force_curve {
  double up[SAMPLES]; /* of the foot that strikes at 0, body weights */
  double contact;     /* s above 2 % of the body weight */
  double peak;
  double swing, stance; /* largest knee angle, and that of the loaded leg, rad */
  double knee, ankle;   /* largest torques, N m/kg */
  int peaks;            /* maxima above half a body weight */
} force_curve;

static force_curve forces_of(run *r) {
  static double times[SAMPLES], grf[3 * FEET * SAMPLES], q[COORDINATES * SAMPLES],
      tau[COORDINATES * SAMPLES];
  const ambulo_model *m = ambulo_problem_model(r->problem);
  double duration = ambulo_problem_duration(r->problem);
  const int n = ambulo_model_coordinate_count(m);
  const int ankle = ambulo_model_find_coordinate(m, "ankle_angle_l");
  int foot = contact_index_at(r->problem, 1, 0.05) >= 0;
  int knee[2] = {ambulo_model_find_coordinate(m, "knee_angle_l"),
                 ambulo_model_find_coordinate(m, "knee_angle_r")};
  force_curve f = {.peak = 0.0};
  for (int k = 0; k < SAMPLES; k++) times[k] = duration * k / (SAMPLES - 1.0);
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .grf = grf, .q = q, .tau = tau};
  assert_int_equal(ambulo_problem_motion(r->problem, r->workspace, ambulo_result_x(r->result),
                                         SAMPLES, times, &motion),
                   AMBULO_OK);
  for (int k = 0; k < SAMPLES; k++) {
    f.up[k] = grf[3 * FEET * k + 3 * foot + 1] / (m->mass * 9.81);
    f.contact += f.up[k] > 0.02 ? times[1] : 0.0;
    f.peak = fmax(f.peak, f.up[k]);
    for (int side = 0; side < 2; side++) f.swing = fmax(f.swing, q[k * n + knee[side]]);
    if (f.up[k] > 0.02) f.stance = fmax(f.stance, q[k * n + knee[0]]);
    f.knee = fmax(f.knee, fabs(tau[k * n + knee[0]]) / m->mass);
    f.ankle = fmax(f.ankle, fabs(tau[k * n + ankle]) / m->mass);
    assert_true(f.up[k] > -0.01);
  }
  for (int k = 1; k + 1 < SAMPLES; k++)
    f.peaks += f.up[k] > 0.5 && f.up[k] > f.up[k - 1] && f.up[k] >= f.up[k + 1];
  return f;
}

/* ------------------------------------------------------- measured against people */

/* column `mean` of a variable and condition of a table (quantity, variable, condition, percent,
 * mean, sd, n) at percents 0, 1 ... 100 */
static void read_curve(const char *path, const char *variable, const char *condition,
                       double mean[101]) {
  char line[200], name[60], when[30];
  double percent, value;
  int found = 0;
  FILE *file = fopen(path, "r");
  assert_non_null(file);
  while (fgets(line, sizeof line, file)) {
    if (sscanf(line, "%*[^,],%59[^,],%29[^,],%lf,%lf", name, when, &percent, &value) != 4) continue;
    if (strcmp(name, variable) || strcmp(when, condition)) continue;
    mean[(int)(percent + 0.5)] = value;
    found++;
  }
  fclose(file);
  assert_int_equal(found, 101);
}

static double correlation(const double *a, const double *b, int n) {
  double ma = 0.0, mb = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (int i = 0; i < n; i++) {
    ma += a[i] / n;
    mb += b[i] / n;
  }
  for (int i = 0; i < n; i++) {
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
    ab += (a[i] - ma) * (b[i] - mb);
  }
  return ab / sqrt(aa * bb);
}

/* the leg that strikes at 0 over its stride: its own half, then the mirror image's of the other */
static void leg_curve(run *r, const char *joint, double angle[101]) {
  static double times[101], q[101 * COORDINATES];
  const ambulo_model *m = ambulo_problem_model(r->problem);
  double duration = ambulo_problem_duration(r->problem);
  char name[40];
  for (int k = 0; k < 101; k++) times[k] = duration * (k <= 50 ? k : k - 50) / 50.0;
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .q = q};
  assert_int_equal(ambulo_problem_motion(r->problem, r->workspace, ambulo_result_x(r->result), 101,
                                         times, &motion),
                   AMBULO_OK);
  for (int k = 0; k < 101; k++) {
    snprintf(name, sizeof name, "%s_%s", joint, k <= 50 ? "l" : "r");
    angle[k] = q[k * ambulo_model_coordinate_count(m) + ambulo_model_find_coordinate(m, name)];
  }
}

/* skipped, and told, without the measured curves */
static void angles_go_as_those_of_a_runner(run *r, const char *condition) {
  static const struct {
    const char *joint, *curve;
    double r;
  } joints[] = {{"hip_flexion", "hip_flexion_r", 0.91},
                {"knee_angle", "knee_angle_r", 0.92},
                {"ankle_angle", "ankle_angle_r", 0.9}};
  char path[300];
  double angle[101], mean[101];
  if (!shared_data_path("motions/hamner2013_one_subject_run_2_3.csv", path, sizeof path)) {
    puts("skipped: angles of a runner: no measured curves");
    return;
  }
  for (int j = 0; j < 3; j++) {
    leg_curve(r, joints[j].joint, angle);
    read_curve(path, joints[j].curve, condition, mean);
    double found = correlation(angle, mean, 101);
    if (!(found >= joints[j].r)) print_error("%s, %s: r %.3f\n", joints[j].joint, condition, found);
    assert_true(found >= joints[j].r);
  }
}

/* ---------------------------------------------------------------------- tests */

typedef struct person {
  const char *name, *speed;
  double contact; /* s: Hamner & Delp (2013), one runner */
  const char *curve;
  double stance; /* degrees: knees bend by no more under load */
  int is_long;   /* between others: with AMBULO_LONG */
} person;

static const person people[] = {
    {"run", "gait.speed=2", 0.3445, "run_2.0", 51.0, 0},
    {"run", NULL, 0.292, "run_3.0", 51.0, 0},
    {"run", "gait.speed=4", 0.251, NULL, 58.0, 1},
    {"run", "gait.speed=5", 0.219, NULL, 66.0, 0},
    {"run_forefoot", NULL, 0.292, NULL, 51.0, 0},
    {"run_forefoot", "gait.speed=2", 0.3445, NULL, 51.0, 1},
    {"run_whole_body", "gait.speed=2", 0.3445, NULL, 51.0, 1},
    {"run_whole_body", NULL, 0.292, NULL, 51.0, 0},
    {"run_whole_body", "gait.speed=5", 0.219, NULL, 58.0, 1},
};

/* Contact within 15 % of people's, one peak of 1.8 to 2.8 body weights. Knees bend by 38 to 51
 * degrees under load up to 3 m/s (people: 40 to 50), too far at 4 and 5 m/s; by 80 to 110 in
 * swing. Knees hold 1.8 to 3.2 N m/kg up to 4 m/s (people 2 to 3), ankles 1.8 to 3.0 (1.8 to 2.6).
 */
static int is_human(const person *p, const force_curve *f) {
  const double degree = 57.29577951308232, ratio = f->contact / p->contact;
  const double stance = f->stance * degree, swing = f->swing * degree;
  int fast = p->speed && !strcmp(p->speed, "gait.speed=5");
  int good = fabs(ratio - 1.0) <= 0.15 && f->peak >= 1.8 && f->peak <= 2.8 && f->peaks == 1 &&
             swing >= 80.0 && swing <= 110.0 && stance >= 38.0 && stance <= p->stance &&
             f->knee >= 1.8 && f->knee <= (fast ? 4.3 : 3.2) && f->ankle >= 1.8 && f->ankle <= 3.0;
  if (!good)
    print_error("%s %s: contact %.3f of people's, %d peaks, %.3f body weights, knee %.1f %.1f, "
                "%.2f and %.2f N m/kg\n",
                p->name, p->speed ? p->speed : "", ratio, f->peaks, f->peak, stance, swing, f->knee,
                f->ankle);
  return good;
}

static void runners_bounce_on_bent_knees(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof people / sizeof *people; i++) {
    if (people[i].is_long && !getenv("AMBULO_LONG")) continue;
    run r = solve_run(people[i].name, people[i].speed);
    force_curve f = forces_of(&r);
    assert_true(is_human(&people[i], &f));
    momenta_are_those_of_a_body_in_flight(&r);
    if (people[i].curve) angles_go_as_those_of_a_runner(&r, people[i].curve);
    free_run(&r);
  }
}

/* As a man who jumps: knees bend to 85 to 110 degrees, arms swing back and up, and the centre of
 * mass rises by 0.3 m and more over where it stands. No joint is weaker than its torque. */
static void it_jumps_as_people(run *r) {
  static double times[SAMPLES], q[COORDINATES * SAMPLES], tau[COORDINATES * SAMPLES];
  const ambulo_model *m = ambulo_problem_model(r->problem);
  const double turn = 57.295779513082321;
  const int n = m->coordinate_count, knee = ambulo_model_find_coordinate(m, "knee_angle_l");
  const int arm = ambulo_model_find_coordinate(m, "arm_flex_l");
  double bent = 0.0, back = 0.0, up = 0.0, stands = 0.0, highest = 0.0;
  assert_true(n <= COORDINATES && knee >= 0 && arm >= 0);
  for (int k = 0; k < SAMPLES; k++)
    times[k] = ambulo_problem_duration(r->problem) * k / (SAMPLES - 1.0);
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .q = q, .tau = tau};
  assert_int_equal(ambulo_problem_motion(r->problem, r->workspace, ambulo_result_x(r->result),
                                         SAMPLES, times, &motion),
                   AMBULO_OK);
  ambulo__pose pose;
  assert_int_equal(ambulo__pose_create(m, NULL, &pose), AMBULO_OK);
  for (int k = 0; k < SAMPLES; k++) {
    double center[3];
    ambulo__pose_at(&pose, q + k * n);
    ambulo__pose_center_of_mass(&pose, center);
    if (k == 0) stands = center[1];
    highest = fmax(highest, center[1]);
    bent = fmax(bent, turn * q[k * n + knee]);
    back = fmin(back, turn * q[k * n + arm]);
    up = fmax(up, turn * q[k * n + arm]);
    for (int c = 0; c < n; c++) {
      const ambulo_coordinate *limits = ambulo_model_coordinate(m, c);
      if (!limits->actuated) continue;
      assert_true(tau[k * n + c] >= 1.01 * limits->torque[0]);
      assert_true(tau[k * n + c] <= 1.01 * limits->torque[1]);
    }
  }
  ambulo__pose_free(&pose);
  assert_true(highest - stands > 0.3);
  assert_true(bent > 85.0 && bent < 110.0);
  assert_true(back < -30.0 && up > 100.0);
}

/* nobody asks for the countermovement, nor how the ground is pushed; both legs do the same */
static void a_jump_goes_down_first(void **state) {
  (void)state;
  run r = solve_run("jump", NULL);
  it_jumps_as_people(&r);
  force_curve f = forces_of(&r);
  double least = 1.0;
  for (int k = 0; k < SAMPLES / 2; k++) least = fmin(least, 2.0 * f.up[k]);
  assert_true(least < 0.8 && 2.0 * f.peak > 2.0 && 2.0 * f.peak < 3.5);
  assert_close(f.contact, 0.82, 0.03);
  momenta_are_those_of_a_body_in_flight(&r);
  free_run(&r);
}

/* of 0.4 s; of 0.24 s that goes on from the last node at the first; beside a step */
static void flights_are_ballistic(void **state) {
  (void)state;
  static const char *const names[] = {"jump_landing", "hop", "skip"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    if (i == 0 && !getenv("AMBULO_LONG"))
      continue; /* a flight as long is a_jump_goes_down_first's */
    run r = solve_run(names[i], NULL);
    momenta_are_those_of_a_body_in_flight(&r);
    free_run(&r);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(runners_bounce_on_bent_knees),
                                     cmocka_unit_test(a_jump_goes_down_first),
                                     cmocka_unit_test(flights_are_ballistic)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
