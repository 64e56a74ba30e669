/* Contacts that share the load, in whole problems (support/shared_fixture.h). What the kernels give
 * is compared with mechanics by other routes. */
#include "support/contact_index.h"
#include "mechanics/lagrangian.h"
#include "contact/contacts.h"
#include "mechanics/pose.h"
#include "people/stride_measures.h"
#include "support/shared_fixture.h"

enum { MOST_ERRORS = 32 };

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
    ambulo__slots slots = ambulo__slots_of(&f.problem->definition);
    ambulo__pose pose;
    int n = c->coordinates;
    double q[TOED_COORDINATES], qd[TOED_COORDINATES], qdd[TOED_COORDINATES];
    double tau[TOED_COORDINATES], wrench[6], points[3 * TOED_POINTS];
    void *scratch = malloc(ambulo__lagrangian_scratch_size(f.model));
    ambulo_allocator a = ambulo__allocator_or_default(NULL);
    assert_int_equal(ambulo__pose_create(f.model, &a, &pose), AMBULO_OK);
    for (int node = 0; node < f.problem->nodes; node += 3) {
      for (int i = 0; i < n; i++) {
        q[i] = channel(&f, node, ambulo__channel_q(c, i));
        qd[i] = channel(&f, node, ambulo__channel_qd(c, i));
        qdd[i] = channel(&f, node, ambulo__channel_qdd(c, i));
      }
      assert_int_equal(ambulo__lagrangian(0, f.model, q, qd, qdd,
                                          &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                            .tau = tau,
                                                            .wrench = wrench,
                                                            .points = points},
                                          scratch),
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

/* forces, places and free moments of feet and patches, as results have them, carry the root wrench:
 * on level ground, of feet in two parts, beside walls */
static void what_results_say_of_contacts_is_all_there_is(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++) {
    fixture f;
    fixture_open(&f, kind);
    enum { TIMES = 23 };
    double times[TIMES], wrench[6 * TIMES], force[3 * EFFECTORS * TIMES];
    double cop[3 * EFFECTORS * TIMES], twist[EFFECTORS * TIMES];
    int effectors = ambulo__effector_count(f.model), both = 0;
    for (int k = 0; k < TIMES; k++)
      times[k] = f.problem->definition.duration * (k + 0.5) / (TIMES + 1);
    effectors_at(&f, times, TIMES, force, cop, twist, wrench);
    for (int k = 0; k < TIMES; k++) {
      double sum[6] = {0};
      int pressing = 0, finite = 1;
      for (int e = 0; e < effectors; e++) {
        int at = k * EFFECTORS + e, patch = ambulo__effector_patch(f.model, e);
        const double *push = force + 3 * at, *place = cop + 3 * at;
        int index = patch < 0 ? contact_index_at(f.problem, e, times[k])
                              : patch_contact_index_at(f.problem, patch, times[k]);
        if (index < 0) {
          assert_true(isnan(place[0]) && push[0] == 0.0 && twist[at] == 0.0);
          continue;
        }
        ambulo__contact_frame frame = ambulo__contact_frame_of(
            &f.problem->definition, ambulo_problem_contact(f.problem, index));
        double lever[3];
        cross(place, push, lever);
        pressing += !isnan(place[0]);
        finite &= !isnan(place[0]);
        if (isnan(place[0])) continue;
        assert_close(ambulo__contact_frame_along(&frame, frame.up, place), 0.0, 1e-9);
        for (int i = 0; i < 3; i++) {
          sum[i] += lever[i] + twist[at] * frame.up[i];
          sum[3 + i] += push[i];
        }
      }
      both += pressing >= 2 && finite;
      for (int i = 0; i < 6 && finite; i++)
        assert_close(sum[i] / f.weight, wrench[6 * k + i] / f.weight, 1e-9);
    }
    assert_true(both > 0);
    fixture_close(&f);
  }
}

/* moments about the origin add up to the root's, whether or not each force has a place, or pulls */
static void what_results_say_of_moments_is_all_there_is(void **state) {
  (void)state;
  int placeless = 0;
  for (int kind = 0; kind < KINDS; kind++) {
    fixture f;
    fixture_open(&f, kind);
    enum { TIMES = 23 };
    double times[TIMES], wrench[6 * TIMES];
    size_t n = 3 * TIMES * EFFECTORS;
    double *feet = calloc(n, sizeof *feet), *patches = calloc(n, sizeof *patches);
    double *cop = calloc(n, sizeof *cop), *force = calloc(n, sizeof *force);
    for (int k = 0; k < TIMES; k++)
      times[k] = f.problem->definition.duration * (k + 0.5) / (TIMES + 1);
    ambulo_motion motion = {.size = sizeof(ambulo_motion),
                            .wrench = wrench,
                            .grf_moment = feet,
                            .patch_moment = patches,
                            .grf = force,
                            .cop = cop};
    assert_int_equal(ambulo_problem_motion(f.problem, f.workspace, f.x, TIMES, times, &motion),
                     AMBULO_OK);
    int of[2] = {f.model->foot_count, f.model->patch_count};
    for (int k = 0; k < TIMES; k++) {
      double sum[3] = {0.0};
      for (int i = 0; i < 3 * (of[0] + of[1]); i++)
        sum[i % 3] +=
            i < 3 * of[0] ? feet[3 * of[0] * k + i] : patches[3 * of[1] * k + i - 3 * of[0]];
      for (int i = 0; i < 3; i++)
        assert_close(sum[i] / f.weight, wrench[6 * k + i] / f.weight, 1e-11);
      for (int foot = 0; foot < of[0]; foot++) {
        int at = 3 * (of[0] * k + foot);
        placeless += isnan(cop[at]) && force[at] != 0.0;
      }
    }
    free(feet);
    free(patches);
    free(cop);
    free(force);
    fixture_close(&f);
  }
  assert_true(placeless > 0);
}

/* force on a foot or a patch at its contacts' first and last instants, beside another one */
static void a_force_begins_and_ends_at_zero(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++) {
    fixture f;
    fixture_open(&f, kind);
    int compared = 0, patches = 0;
    double duration = f.problem->definition.duration;
    for (int i = 0; i < f.problem->definition.contact_count; i++) {
      const ambulo_contact *c = ambulo_problem_contact(f.problem, i);
      ambulo__stance stance = ambulo__stance_of(&f.problem->definition, c);
      double times[2] = {stance.from + 1e-7, stance.to - 1e-7}, force[3 * EFFECTORS];
      double cop[3 * EFFECTORS], twist[EFFECTORS];
      int e = ambulo__effector_of(f.model, c);
      for (int k = 0; k < 2; k++) {
        if (!(times[k] > 0.0 && times[k] < duration)) continue;
        effectors_at(&f, &times[k], 1, force, cop, twist, NULL);
        for (int axis = 0; axis < 3; axis++)
          assert_true(fabs(force[3 * e + axis]) < 1e-8 * f.weight);
        compared++;
        patches += c->foot < 0;
      }
    }
    assert_true(compared >= 2);
    assert_int_equal(patches, kind == 3 ? 3 : 0);
    fixture_close(&f);
  }
}

/* no jump of the force on any part of a foot or on a patch, at events neither */
static void forces_are_continuous(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++) {
    fixture f;
    fixture_open(&f, kind);
    for (int i = 0; i < f.problem->definition.contact_count; i++) {
      const ambulo_contact *c = ambulo_problem_contact(f.problem, i);
      double force[6 * EFFECTORS], cop[6 * EFFECTORS], twist[2 * EFFECTORS];
      double tau[2 * TOED_COORDINATES], times[2] = {c->from - 1e-8, c->from + 1e-8};
      if (times[0] < 0.0 || times[1] > f.problem->definition.duration) continue;
      ambulo_motion motion = {.size = sizeof(ambulo_motion), .tau = tau};
      effectors_at(&f, times, 2, force, cop, twist, NULL);
      assert_int_equal(ambulo_problem_motion(f.problem, f.workspace, f.x, 2, times, &motion),
                       AMBULO_OK);
      int n = f.problem->coordinates, numbers = 3 * ambulo__effector_count(f.model);
      for (int k = 0; k < numbers; k++)
        assert_close(force[k] / f.weight, force[3 * EFFECTORS + k] / f.weight, 1e-5);
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

/* what the contacts give and gravity takes is what the body's momentum changes by; of a mirrored
 * step impulses are those of a stride, whose second half has the same forward and upward ones */
static void momentum_is_balanced(void **state) {
  (void)state;
  for (int kind = 0; kind < KINDS; kind++) {
    fixture f;
    fixture_open(&f, kind);
    double impulse[3 * EFFECTORS], velocity[2][3], duration = f.problem->definition.duration;
    double steps = f.problem->definition.ends == AMBULO_ENDS_MIRRORED ? 2.0 : 1.0;
    const double *axes[2] = {f.model->forward, f.model->up};
    assert_int_equal(ambulo__impulses(f.problem, f.x, NULL, impulse), AMBULO_OK);
    velocity_at(&f, 0, velocity[0]);
    velocity_at(&f, f.problem->nodes - 1, velocity[1]);
    for (int k = 0; k < 2; k++) {
      double given = 0.0, gained = 0.0;
      for (int i = 0; i < 3; i++) {
        double change = velocity[1][i] - velocity[0][i] - f.model->gravity[i] * duration;
        for (int e = 0; e < ambulo__effector_count(f.model); e++)
          given += axes[k][i] * impulse[3 * e + i] / steps;
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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(contacts_carry_the_body),
      cmocka_unit_test(torques_are_those_of_a_body_that_is_pushed_there),
      cmocka_unit_test(what_results_say_of_contacts_is_all_there_is),
      cmocka_unit_test(what_results_say_of_moments_is_all_there_is),
      cmocka_unit_test(a_force_begins_and_ends_at_zero),
      cmocka_unit_test(forces_are_continuous),
      cmocka_unit_test(momentum_is_balanced),
      cmocka_unit_test(gradients_are_those_of_differences)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
