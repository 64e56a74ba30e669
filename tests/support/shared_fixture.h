/* support/shared_fixture.h - contacts that share the load, at points of no meaning: a walk with
 * mirrored ends (kind 0), one on feet with a joint of the toes (1), one on footholds of any height,
 * slope and heading (2), and that with a seat and a hand besides (3). */
#ifndef AMBULO_TESTS_SHARED_FIXTURE_H
#define AMBULO_TESTS_SHARED_FIXTURE_H

#include "ambulo/tools/tools.h"
#include "contact/contacts.h"
#include "problem/nlp.h"
#include "support/toed_body.h"

enum { KINDS = 4, EFFECTORS = 4 /* at most */ };

typedef struct fixture {
  ambulo_model *model;
  ambulo_problem *problem;
  ambulo_workspace *workspace;
  double *x;
  double weight; /* m g, N */
} fixture;

/* a mirrored step of 0.54 s */
static inline int regular(const ambulo_model *model, ambulo_problem_definition *d,
                          ambulo_contact *contacts) {
  const ambulo_gait gait = {.size = sizeof(ambulo_gait),
                            .contact_size = sizeof(ambulo_contact),
                            .steps = 1,
                            .step_length = 0.68,
                            .step_time = 0.54,
                            .step_width = 0.1,
                            .foot_flat = 0.08,
                            .heel_off = 0.38,
                            .toe_off = 0.62,
                            .other_step_length = AMBULO_OFF,
                            .other_step_time = AMBULO_OFF};
  d->duration = 0.54;
  d->ends = AMBULO_ENDS_MIRRORED;
  d->travel = 0.68;
  int count = 0;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 12, &count), AMBULO_OK);
  return count;
}

/* up a turning stair of leaning treads */
static inline int irregular(ambulo_problem_definition *d, ambulo_contact *contacts) {
  static const ambulo_contact list[] = {
      {0, AMBULO_CONTACT_FLAT, 0.0, 0.3, .place = {0.0, -0.1, 0.0}, .normal = {-0.1, 0.05, 1.0},
       .heading = 0.0},
      {0, AMBULO_CONTACT_TOE, 0.3, 0.4, .place = {0.0, -0.1, 0.0}, .normal = {-0.1, 0.05, 1.0},
       .heading = 0.0},
      {1, AMBULO_CONTACT_FLAT, 0.2, 0.8, .place = {0.3, 0.1, 0.15}, .normal = {0.1, -0.2, 2.0},
       .heading = 0.3},
      {0, AMBULO_CONTACT_HEEL, 0.65, 0.75, .place = {0.6, 0.1, 0.3}, .normal = {0, 0, 0},
       .heading = 0.5},
      {0, AMBULO_CONTACT_FLAT, 0.75, 1.0, .place = {0.6, 0.1, 0.3}, .normal = {0, 0, 0},
       .heading = 0.5}};
  d->duration = 1.0;
  memcpy(contacts, list, sizeof list);
  return (int)(sizeof list / sizeof *list);
}

/* the body with two patches more: a seat on the pelvis, a hand that is the top of the head */
static inline ambulo_model *with_patches(void) {
  ambulo_model *body = NULL, *model = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &body),
                   AMBULO_OK);
  const ambulo_patch patches[] = {
      {"seat", ambulo_model_find_point(body, "pelvis"), {0.1, 0.15}, -1},
      {"hand", ambulo_model_find_point(body, "head_top"), {0.02, 0.04}, -1}};
  ambulo_model_definition d = ambulo_model_definition_default();
  d.name = body->name;
  d.links = body->links;
  d.link_count = body->link_count;
  d.coordinates = body->coordinates;
  d.coordinate_count = body->coordinate_count;
  d.points = body->points;
  d.point_count = body->point_count;
  d.feet = body->feet;
  d.foot_count = body->foot_count;
  d.patches = patches;
  d.patch_count = 2;
  assert_int_equal(ambulo_model_create(&d, NULL, NULL, &model), AMBULO_OK);
  ambulo_model_free(body);
  return model;
}

/* a seat that is left, and a wall ahead that is leant on by and by */
static inline int seat_and_hand(ambulo_contact *contacts) {
  static const ambulo_contact list[] = {{.foot = -1,
                                         .mode = AMBULO_CONTACT_PATCH,
                                         .patch = 0,
                                         .from = 0.05,
                                         .to = 0.5,
                                         .place = {-0.2, 0.0, 0.5},
                                         .normal = {0.1, -0.1, 1.0}},
                                        {.foot = -1,
                                         .mode = AMBULO_CONTACT_PATCH,
                                         .patch = 1,
                                         .from = 0.25,
                                         .to = 1.0,
                                         .place = {0.3, -0.1, 1.0},
                                         .normal = {-1.0, 0.2, 0.1},
                                         .heading = 0.1}};
  memcpy(contacts, list, sizeof list);
  return (int)(sizeof list / sizeof *list);
}

static inline void fixture_open(fixture *f, int kind) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_contact contacts[12];
  ambulo_term terms[] = {ambulo_term_default(AMBULO_TORQUE_POWER),
                         ambulo_term_default(AMBULO_FORCE_RATE)};
  if (kind == 1) {
    f->model = toed_body();
  } else if (kind == 3) {
    f->model = with_patches();
  } else {
    assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &f->model),
                     AMBULO_OK);
  }
  double scale[TOED_COORDINATES];
  for (int i = 0; i < TOED_COORDINATES; i++) scale[i] = 0.01;
  terms[0].scale = scale;
  d.model = f->model;
  d.contacts = contacts;
  d.contact_count = kind >= 2 ? irregular(&d, contacts) : regular(f->model, &d, contacts);
  if (kind == 3) d.contact_count += seat_and_hand(contacts + d.contact_count);
  d.intervals = 40;
  d.spline_intervals = 12;
  d.degree = 4;
  d.grid = d.knots = AMBULO_GRID_EVENTS;
  d.ground_reaction.kind = AMBULO_REACTION_SHARED;
  d.ground_reaction.heel_pad = 0.008;
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

static inline void fixture_close(fixture *f) {
  free(f->x);
  ambulo_workspace_free(f->workspace);
  ambulo_problem_free(f->problem);
  ambulo_model_free(f->model);
}

/* forces [count][EFFECTORS][3], places and free moments of feet and patches at `count` times */
static inline void effectors_at(const fixture *f, const double *times, int count, double *force,
                                double *cop, double *free_moment, double *wrench) {
  const ambulo_model *m = f->model;
  size_t n = (size_t)count, feet = (size_t)m->foot_count, patches = (size_t)m->patch_count;
  double *block = calloc(7 * n * (feet + patches), sizeof *block);
  ambulo_motion motion = {.size = sizeof(ambulo_motion),
                          .wrench = wrench,
                          .grf = block,
                          .cop = block + 3 * n * feet,
                          .free_moment = block + 6 * n * feet};
  double *of_patches = block + 7 * n * feet;
  motion.patch_force = of_patches;
  motion.patch_cop = of_patches + 3 * n * patches;
  motion.patch_free_moment = of_patches + 6 * n * patches;
  assert_int_equal(ambulo_problem_motion(f->problem, f->workspace, f->x, count, times, &motion),
                   AMBULO_OK);
  for (size_t k = 0; k < n; k++) {
    for (size_t e = 0; e < feet + patches; e++) {
      size_t at = k * EFFECTORS + e, own = e < feet ? k * feet + e : k * patches + e - feet;
      memcpy(force + 3 * at, (e < feet ? motion.grf : motion.patch_force) + 3 * own,
             3 * sizeof(double));
      memcpy(cop + 3 * at, (e < feet ? motion.cop : motion.patch_cop) + 3 * own,
             3 * sizeof(double));
      free_moment[at] = (e < feet ? motion.free_moment : motion.patch_free_moment)[own];
    }
  }
  free(block);
}

static inline double channel(const fixture *f, int node, int index) {
  return f->workspace->channel[ambulo__lane_index(node, f->workspace->channel_count, index)];
}

/* of a slot at a node: weight, centre, force, moment about the centre */
typedef struct contact {
  double weight, center[3], force[3], moment[3];
} contact;

static inline contact contact_at(const fixture *f, int node, int slot) {
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

#endif
