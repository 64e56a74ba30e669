/* Contacts that share the load, in whole problems at points of no meaning: a walk with mirrored
 * ends, one on feet with a joint of the toes, and one on footholds of any height, slope and
 * heading. What the kernels give is compared with mechanics by other routes. */
#include "ambulo/ambulo.h"
#include "gait/contact_load.h"
#include "gait/stance.h"
#include "mechanics/pose.h"
#include "nlp/nlp.h"
#include "stride/impulse.h"
#include "support/toed_body.h"

enum { KINDS = 3, MOST_ERRORS = 32 };

typedef struct fixture {
  ambulo_model *model;
  ambulo_problem *problem;
  ambulo_workspace *workspace;
  double *x;
  double weight; /* m g, N */
} fixture;

/* a mirrored step of 0.54 s */
static int regular(const ambulo_model *model, ambulo_problem_definition *d,
                   ambulo_contact *contacts) {
  const ambulo_gait gait = {.steps = 1,
                            .step_length = 0.68,
                            .step_time = 0.54,
                            .step_width = 0.1,
                            .foot_flat = 0.08,
                            .heel_off = 0.38,
                            .toe_off = 0.62};
  d->duration = 0.54;
  d->ends = AMBULO_ENDS_MIRRORED;
  d->travel = 0.68;
  int count = 0;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 12, &count), AMBULO_OK);
  return count;
}

/* up a turning stair of leaning treads */
static int irregular(ambulo_problem_definition *d, ambulo_contact *contacts) {
  static const ambulo_contact list[] = {
      {0, AMBULO_CONTACT_FLAT, 0.0, 0.3, {0.0, -0.1, 0.0}, {-0.1, 0.05, 1.0}, 0.0},
      {0, AMBULO_CONTACT_TOE, 0.3, 0.4, {0.0, -0.1, 0.0}, {-0.1, 0.05, 1.0}, 0.0},
      {1, AMBULO_CONTACT_FLAT, 0.2, 0.8, {0.3, 0.1, 0.15}, {0.1, -0.2, 2.0}, 0.3},
      {0, AMBULO_CONTACT_HEEL, 0.65, 0.75, {0.6, 0.1, 0.3}, {0, 0, 0}, 0.5},
      {0, AMBULO_CONTACT_FLAT, 0.75, 1.0, {0.6, 0.1, 0.3}, {0, 0, 0}, 0.5}};
  d->duration = 1.0;
  memcpy(contacts, list, sizeof list);
  return (int)(sizeof list / sizeof *list);
}

static void fixture_open(fixture *f, int kind) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_contact contacts[12];
  ambulo_term terms[] = {ambulo_term_default(AMBULO_TORQUE_POWER),
                         ambulo_term_default(AMBULO_FORCE_RATE)};
  if (kind == 1) {
    f->model = toed_body();
  } else {
    assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &f->model),
                     AMBULO_OK);
  }
  double scale[TOED_COORDINATES];
  for (int i = 0; i < TOED_COORDINATES; i++) scale[i] = 0.01;
  terms[0].scale = scale;
  d.model = f->model;
  d.contacts = contacts;
  d.contact_count = kind == 2 ? irregular(&d, contacts) : regular(f->model, &d, contacts);
  d.intervals = 40;
  d.spline_intervals = 12;
  d.degree = 4;
  d.grid = d.knots = AMBULO_GRID_EVENTS;
  d.ground_reaction.kind = AMBULO_REACTION_SHARED;
  d.contact_tolerance = 0.002;
  d.ground_penetration = 1;
  d.clearance.height = 0.02;
  d.terms = terms;
  d.term_count = 2;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  if (ambulo_problem_create(&d, NULL, list, &f->problem)) {
    char text[400];
    ambulo_diagnostics_format(list, 0, text, sizeof text);
    fail_msg("%s", text);
  }
  ambulo_diagnostics_free(list);
  assert_int_equal(ambulo_workspace_create(f->problem, NULL, &f->workspace), AMBULO_OK);
  f->weight = ambulo__model_weight(f->model);
  int n = f->problem->coordinates;
  f->x = calloc((size_t)f->problem->variables, sizeof *f->x);
  for (int i = 0; i < f->problem->variables; i++)
    f->x[i] = (i % n < 3 ? 0.01 : 0.1) * sin(0.3 * (i / n) + 1.7 * (i % n) + kind);
  assert_int_equal(ambulo__evaluate(f->workspace, f->x), AMBULO_OK);
}

static void fixture_close(fixture *f) {
  free(f->x);
  ambulo_workspace_free(f->workspace);
  ambulo_problem_free(f->problem);
  ambulo_model_free(f->model);
}

static double channel(const fixture *f, int node, int index) {
  return f->workspace->channel[ambulo__lane_index(node, f->workspace->channel_count, index)];
}

/* of a slot at a node: weight, centre, force, moment about the centre */
typedef struct contact {
  double weight, center[3], force[3], moment[3];
} contact;

static contact contact_at(const fixture *f, int node, int slot) {
  const ambulo__channels *c = &f->problem->channels;
  int entries = ambulo__plan_ground_entries(f->problem->plan);
  const double *lane = f->problem->ground + ambulo__lane_index(node, entries, 0);
  contact of = {.weight = lane[(size_t)(3 + 4 * slot) * AMBULO__LANES]};
  for (int i = 0; i < 3; i++) {
    of.center[i] = lane[(size_t)(4 + 4 * slot + i) * AMBULO__LANES];
    of.force[i] = channel(f, node, ambulo__channel_foot_force(c, slot, i));
    of.moment[i] = channel(f, node, ambulo__channel_contact_moment(c, slot, i));
  }
  return of;
}

static void cross(const double a[3], const double b[3], double out[3]) {
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    out[i] = a[j] * b[k] - a[k] * b[j];
  }
}

/* they carry the root wrench, nothing is left to the six joints of the root, and what has no weight
 * carries nothing */
static void contacts_carry_the_body(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++) {
    fixture f;
    fixture_open(&f, kind);
    const ambulo__channels *c = &f.problem->channels;
    double most[4] = {0}, heaviest[4] = {0};
    for (int node = 0; node < f.problem->nodes; node++) {
      double sum[6] = {0};
      for (int slot = 0; slot < c->slots; slot++) {
        contact of = contact_at(&f, node, slot);
        double lever[3], size = 0.0;
        cross(of.center, of.force, lever);
        for (int i = 0; i < 3; i++) {
          sum[i] += lever[i] + of.moment[i];
          sum[3 + i] += of.force[i];
          size += fabs(of.force[i]) + fabs(of.moment[i]);
        }
        if (of.weight == 0.0) assert_true(size == 0.0);
        most[slot] = fmax(most[slot], size / f.weight);
        heaviest[slot] = fmax(heaviest[slot], of.weight);
      }
      for (int i = 0; i < 6; i++) {
        double want = channel(&f, node, ambulo__channel_moment(c, i));
        assert_close(sum[i] / f.weight, want / f.weight, 1e-11);
        assert_close(channel(&f, node, ambulo__channel_tau(c, i)) / f.weight, 0.0, 1e-11);
      }
    }
    int carry = 0;
    for (int slot = 0; slot < c->slots; slot++) {
      carry += most[slot] > 0.2;
      assert_int_equal(most[slot] > 0.2, heaviest[slot] > 0.5);
    }
    assert_true(carry >= (kind == 1 ? 3 : 2)); /* one heel is down in the mirror image only */
    fixture_close(&f);
  }
}

/* generalized force of joint i by a wrench about the world origin on `link`: by the link's motion,
 * from central differences of its frame */
static double virtual_work(ambulo__pose *pose, double *q, int i, int link, const contact *of) {
  const double h = 1e-6;
  double frame[2][12], local[3] = {0}, kept = q[i], work = 0.0, turn[3] = {0};
  ambulo__pose_at(pose, q);
  const double *now = pose->frames + 12 * (size_t)link;
  double rotation[3][3];
  for (int r = 0; r < 3; r++)
    for (int k = 0; k < 3; k++) rotation[r][k] = now[4 * r + k];
  for (int k = 0; k < 3; k++)
    for (int r = 0; r < 3; r++) local[k] += rotation[r][k] * (of->center[r] - now[4 * r + 3]);
  for (int side = 0; side < 2; side++) {
    q[i] = kept + (side ? h : -h);
    ambulo__pose_at(pose, q);
    memcpy(frame[side], pose->frames + 12 * (size_t)link, sizeof frame[side]);
  }
  q[i] = kept;
  for (int r = 0; r < 3; r++) {
    double moved = frame[1][4 * r + 3] - frame[0][4 * r + 3];
    for (int k = 0; k < 3; k++) moved += (frame[1][4 * r + k] - frame[0][4 * r + k]) * local[k];
    work += of->force[r] * moved / (2.0 * h);
  }
  for (int a = 0; a < 3; a++) { /* dR R^T is the cross product with the turn */
    int b = (a + 1) % 3, c = (a + 2) % 3;
    for (int k = 0; k < 3; k++)
      turn[a] += (frame[1][4 * c + k] - frame[0][4 * c + k]) * rotation[b][k] / (2.0 * h);
    work += of->moment[a] * turn[a];
  }
  return work;
}

/* Lagrange's equations without contacts, less the virtual work of their forces */
static void torques_are_those_of_a_body_that_is_pushed_there(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++) {
    fixture f;
    fixture_open(&f, kind);
    const ambulo__channels *c = &f.problem->channels;
    ambulo__slots slots = ambulo__slots_of(f.model);
    ambulo__pose pose;
    int n = c->coordinates;
    double q[TOED_COORDINATES], qd[TOED_COORDINATES], qdd[TOED_COORDINATES];
    double tau[TOED_COORDINATES], wrench[6], points[3 * TOED_POINTS];
    void *scratch = malloc(ambulo_lagrangian_scratch_size(f.model));
    ambulo_allocator a = ambulo__allocator_or_default(NULL);
    assert_int_equal(ambulo__pose_create(f.model, &a, &pose), AMBULO_OK);
    for (int node = 0; node < f.problem->nodes; node += 3) {
      for (int i = 0; i < n; i++) {
        q[i] = channel(&f, node, ambulo__channel_q(c, i));
        qd[i] = channel(&f, node, ambulo__channel_qd(c, i));
        qdd[i] = channel(&f, node, ambulo__channel_qdd(c, i));
      }
      assert_int_equal(
          ambulo_lagrangian_inverse_dynamics(f.model, q, qd, qdd, tau, wrench, points, scratch),
          AMBULO_OK);
      for (int slot = 0; slot < c->slots; slot++) {
        contact of = contact_at(&f, node, slot);
        for (int i = 0; i < n; i++) tau[i] -= virtual_work(&pose, q, i, slots.link[slot], &of);
      }
      for (int i = 0; i < n; i++)
        assert_close(tau[i] / f.weight, channel(&f, node, ambulo__channel_tau(c, i)) / f.weight,
                     1e-8);
    }
    ambulo__pose_free(&pose);
    free(scratch);
    fixture_close(&f);
  }
}

/* forces, places and free moments of feet, as results have them, carry the root wrench: on level
 * ground and of feet in two parts */
static void what_results_say_of_feet_is_all_there_is(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++) {
    fixture f;
    fixture_open(&f, kind);
    enum { TIMES = 23 };
    double times[TIMES], wrench[6 * TIMES], grf[6 * TIMES], cop[6 * TIMES], twist[2 * TIMES];
    for (int k = 0; k < TIMES; k++)
      times[k] = f.problem->definition.duration * (k + 0.5) / (TIMES + 1);
    ambulo_motion motion = {.wrench = wrench, .grf = grf, .cop = cop, .free_moment = twist};
    assert_int_equal(ambulo_problem_motion(f.problem, f.workspace, f.x, TIMES, times, &motion),
                     AMBULO_OK);
    int both = 0;
    for (int k = 0; k < TIMES; k++) {
      double sum[6] = {0};
      int pressing = 0, finite = 1;
      for (int foot = 0; foot < 2; foot++) {
        const double *force = grf + 6 * k + 3 * foot, *place = cop + 6 * k + 3 * foot;
        int index = ambulo_problem_contact_at(f.problem, foot, times[k]);
        if (index < 0) {
          assert_true(isnan(place[0]) && force[0] == 0.0 && twist[2 * k + foot] == 0.0);
          continue;
        }
        ambulo__contact_frame frame = ambulo__contact_frame_of(
            &f.problem->definition, ambulo_problem_contact(f.problem, index));
        double lever[3];
        cross(place, force, lever);
        pressing += !isnan(place[0]);
        finite &= !isnan(place[0]);
        if (isnan(place[0])) continue;
        assert_close(ambulo__contact_frame_along(&frame, frame.up, place), 0.0, 1e-9);
        for (int i = 0; i < 3; i++) {
          sum[i] += lever[i] + twist[2 * k + foot] * frame.up[i];
          sum[3 + i] += force[i];
        }
      }
      both += pressing == 2;
      for (int i = 0; i < 6 && finite; i++)
        assert_close(sum[i] / f.weight, wrench[6 * k + i] / f.weight, 1e-9);
    }
    assert_true(both > 0);
    fixture_close(&f);
  }
}

/* force on a foot at its contacts' first and last instants, beside another one */
static void a_force_begins_and_ends_at_zero(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++) {
    fixture f;
    fixture_open(&f, kind);
    int compared = 0;
    double duration = f.problem->definition.duration;
    for (int i = 0; i < f.problem->definition.contact_count; i++) {
      const ambulo_contact *c = ambulo_problem_contact(f.problem, i);
      ambulo__stance stance = ambulo__stance_of(&f.problem->definition, c);
      double times[2] = {stance.from + 1e-7, stance.to - 1e-7}, grf[12];
      for (int k = 0; k < 2; k++) {
        ambulo_motion motion = {.grf = grf};
        if (!(times[k] > 0.0 && times[k] < duration)) continue;
        assert_int_equal(ambulo_problem_motion(f.problem, f.workspace, f.x, 1, &times[k], &motion),
                         AMBULO_OK);
        for (int axis = 0; axis < 3; axis++)
          assert_true(fabs(grf[3 * c->foot + axis]) < 1e-8 * f.weight);
        compared++;
      }
    }
    assert_true(compared >= 2);
    fixture_close(&f);
  }
}

/* no jump of the force on any part of a foot, at events neither */
static void forces_are_continuous(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++) {
    fixture f;
    fixture_open(&f, kind);
    for (int i = 0; i < f.problem->definition.contact_count; i++) {
      const ambulo_contact *c = ambulo_problem_contact(f.problem, i);
      double grf[12], tau[2 * TOED_COORDINATES], times[2] = {c->from - 1e-8, c->from + 1e-8};
      if (times[0] < 0.0 || times[1] > f.problem->definition.duration) continue;
      ambulo_motion motion = {.grf = grf, .tau = tau};
      assert_int_equal(ambulo_problem_motion(f.problem, f.workspace, f.x, 2, times, &motion),
                       AMBULO_OK);
      int n = f.problem->coordinates;
      for (int k = 0; k < 6; k++) assert_close(grf[k] / f.weight, grf[6 + k] / f.weight, 1e-5);
      for (int k = 0; k < n; k++) assert_close(tau[k] / f.weight, tau[n + k] / f.weight, 1e-5);
    }
    fixture_close(&f);
  }
}

/* velocity of the centre of mass at a node, by central differences of the pose */
static void velocity_at(const fixture *f, int node, double velocity[3]) {
  const double h = 1e-6;
  const ambulo__channels *c = &f->problem->channels;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  ambulo__pose pose;
  double q[TOED_COORDINATES];
  memset(velocity, 0, 3 * sizeof *velocity);
  assert_int_equal(ambulo__pose_create(f->model, &a, &pose), AMBULO_OK);
  for (int side = -1; side <= 1; side += 2) {
    for (int i = 0; i < c->coordinates; i++)
      q[i] = channel(f, node, ambulo__channel_q(c, i)) +
             side * h * channel(f, node, ambulo__channel_qd(c, i));
    ambulo__pose_at(&pose, q);
    for (int b = 0; b < f->model->link_count; b++) {
      double place[3], share = f->model->links[b].mass / f->model->mass;
      ambulo__pose_point(&pose, b, f->model->links[b].com, place);
      for (int i = 0; i < 3; i++) velocity[i] += side * share * place[i] / (2.0 * h);
    }
  }
  ambulo__pose_free(&pose);
}

/* what the feet give and gravity takes is what the body's momentum changes by; of a mirrored step
 * impulses are those of a stride, whose second half has the same forward and upward ones */
static void momentum_is_balanced(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++) {
    fixture f;
    fixture_open(&f, kind);
    double impulse[6], velocity[2][3], duration = f.problem->definition.duration;
    double steps = f.problem->definition.ends == AMBULO_ENDS_MIRRORED ? 2.0 : 1.0;
    const double *axes[2] = {f.model->forward, f.model->up};
    assert_int_equal(ambulo__impulses(f.problem, f.x, NULL, impulse), AMBULO_OK);
    velocity_at(&f, 0, velocity[0]);
    velocity_at(&f, f.problem->nodes - 1, velocity[1]);
    for (int k = 0; k < 2; k++) {
      double given = 0.0, gained = 0.0;
      for (int i = 0; i < 3; i++) {
        double change = velocity[1][i] - velocity[0][i] - f.model->gravity[i] * duration;
        given += axes[k][i] * (impulse[i] + impulse[3 + i]) / steps;
        gained += axes[k][i] * f.model->mass * change;
      }
      assert_close(given / (f.weight * duration), gained / (f.weight * duration), 1e-7);
    }
    fixture_close(&f);
  }
}

static void gradients_are_those_of_differences(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++) {
    fixture f;
    fixture_open(&f, kind);
    ambulo_derivative_error errors[MOST_ERRORS];
    int count = 0, seen = 0;
    static const char *const wanted[] = {"normal_force", "friction",  "pressure",   "free_moment",
                                         "contact",      "clearance", "force_rate", "torque_power"};
    assert_int_equal(ambulo_problem_check_derivatives(f.problem, f.workspace, f.x, 0.0, errors,
                                                      MOST_ERRORS, &count),
                     AMBULO_OK);
    for (int i = 0; i < count; i++) {
      if (!(errors[i].error <= 1e-7))
        print_error("kind %d, %s %s at %g s: %g\n", kind, errors[i].family, errors[i].subject,
                    errors[i].time, errors[i].error);
      assert_true(errors[i].error <= 1e-7);
      for (int k = 0; k < 8; k++) seen += !strcmp(errors[i].family, wanted[k]);
    }
    assert_int_equal(seen, 8);
    fixture_close(&f);
  }
}

/* --------------------------------------------------------------- after a solve */

#define STANDING                                                                                   \
  "ambulo: 1\nkind: problem\nname: stand\nmodel: models/lower_body_18.yaml\n"                      \
  "subject: {mass: 75, stature: 1.75, sex: male}\nangles: degrees\n"                               \
  "time: {duration: 1.0, intervals: 12}\ntrajectory: {basis: bspline, intervals: 6}\n"             \
  "contacts:\n"                                                                                    \
  "  - {foot: left, mode: flat, from: 0, to: 1, place: [0, 0.1]}\n"                                \
  "  - {foot: right, mode: flat, from: 0, to: 1, place: [0, -0.1]}\n"                              \
  "ground_reaction: {kind: shared}\n"                                                              \
  "constraints: {contact_tolerance: 0.002}\nends: {kind: periodic, travel: 0}\n"                   \
  "objective:\n"                                                                                   \
  "  - {term: torque_squared, scale: {default: 0.01}}\n"                                           \
  "  - {term: upright, weight: 10, points: [pelvis, head_top]}\n"                                  \
  "  - {term: acceleration, weight: 1e-4}\n"

/* who stands on both feet alike has half of the weight on each */
static void standing_feet_carry_half_each(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_problem_load_text(STANDING, strlen(STANDING), "stand", ".", NULL, 0, NULL,
                                            NULL, &problem),
                   AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  enum { TIMES = 9 };
  double times[TIMES], grf[6 * TIMES], cop[6 * TIMES], weight = 75.0 * 9.81;
  for (int k = 0; k < TIMES; k++) times[k] = k / (TIMES - 1.0);
  ambulo_motion motion = {.grf = grf, .cop = cop};
  assert_int_equal(
      ambulo_problem_motion(problem, workspace, ambulo_result_x(result), TIMES, times, &motion),
      AMBULO_OK);
  for (int k = 0; k < TIMES; k++) {
    const double *right = grf + 6 * k, *left = right + 3, *place = cop + 6 * k;
    assert_close(right[1] / weight, 0.5, 1e-4); /* stands still, but for what the solver left */
    assert_close((left[1] - right[1]) / weight, 0.0, 1e-9);
    assert_close((left[0] - right[0]) / weight, 0.0, 1e-9);
    assert_close((left[2] + right[2]) / weight, 0.0, 1e-9);
    assert_close(place[0], place[3], 1e-9);
    assert_close(place[2], -place[5], 1e-9);
    assert_true(right[2] < 0.0); /* they push at the body between them */
  }
  ambulo_workspace_free(workspace);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* at most what the loading rate lets it carry; the forces' own bounds hold between the nodes */
static void a_solved_walk_loads_its_feet_in_time(void **state) {
  (void)state;
  static const char *const settings[] = {"ground_reaction={kind: shared, loading_rate: 12}",
                                         "time.grid=events",
                                         "trajectory.knots=events",
                                         "trajectory.degree=4",
                                         "trajectory.intervals=12",
                                         "time.intervals=32"};
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_workspace *workspace = NULL;
  assert_int_equal(
      ambulo_problem_load("models/walk_normal.yaml", settings, 6, NULL, NULL, &problem), AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  enum { TIMES = 26 };
  double times[TIMES], grf[6 * TIMES], weight = 75.0 * 9.81, last = 0.0;
  for (int k = 0; k < TIMES; k++) times[k] = 0.005 * k;
  ambulo_motion motion = {.grf = grf};
  assert_int_equal(
      ambulo_problem_motion(problem, workspace, ambulo_result_x(result), TIMES, times, &motion),
      AMBULO_OK);
  int strikes = ambulo_problem_contact_at(problem, 0, 0.2) < 0;
  for (int k = 0; k < TIMES; k++) {
    double upward = grf[6 * k + 3 * strikes + 1] / weight;
    assert_true(upward <= 12.0 * times[k] + 0.02);
    last = fmax(last, upward);
  }
  assert_true(last > 0.5);
  ambulo_workspace_free(workspace);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(contacts_carry_the_body),
      cmocka_unit_test(torques_are_those_of_a_body_that_is_pushed_there),
      cmocka_unit_test(what_results_say_of_feet_is_all_there_is),
      cmocka_unit_test(a_force_begins_and_ends_at_zero),
      cmocka_unit_test(forces_are_continuous),
      cmocka_unit_test(momentum_is_balanced),
      cmocka_unit_test(gradients_are_those_of_differences),
      cmocka_unit_test(standing_feet_carry_half_each),
      cmocka_unit_test(a_solved_walk_loads_its_feet_in_time)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
