/* Capsules, obstacles and reaches of a definition made in C: every number that counts, and what
 * mirrored ends ask of them. The keys of files are those of
 * tests/definitions/test_problem_constraints.c. */
#include "support/find_capsule.h"
#include "contact/row_families.h"
#include "ambulo/tools/load.h"
#include "model/neutral_pose.h"
#include "support/messages.h"
#include "support/test.h"

/* lower_body_18 for 1 s, its shanks kept apart, its knees at their distance, a fence */
typedef struct fixture {
  ambulo_model *model;
  ambulo_capsule_pair pair;
  ambulo_obstacle fence;
  ambulo_reach reach;
  ambulo_problem_definition definition;
} fixture;

static int point(const fixture *f, const char *name) {
  int index = ambulo_model_find_point(f->model, name);
  assert_true(index >= 0);
  return index;
}

static ambulo_capsule *capsule(const fixture *f, const char *name) {
  int index = find_capsule(f->model, name);
  assert_true(index >= 0);
  return &f->model->capsules[index];
}

static void open_fixture(fixture *f) {
  memset(f, 0, sizeof *f);
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &f->model),
                   AMBULO_OK);
  f->definition = ambulo_problem_definition_default();
  f->definition.model = f->model;
  f->definition.duration = 1.0;
  f->pair =
      (ambulo_capsule_pair){find_capsule(f->model, "shank_l"), find_capsule(f->model, "shank_r")};
  f->definition.collision =
      (ambulo_collision){AMBULO_COLLISION_PAIRS, &f->pair, .pair_count = 1, .margin = 0.01};
  f->fence = (ambulo_obstacle){.shape = AMBULO_OBSTACLE_BOX,
                               .name = "fence",
                               .center = {1.0, 0.0, 0.5},
                               .half = {0.1, 1.0, 0.5},
                               .margin = 0.02};
  f->reach = (ambulo_reach){.point = point(f, "knee_r"),
                            .is_relative = 1,
                            .about = point(f, "knee_l"),
                            .place = {0.0, -0.17, 0.0},
                            .to = INFINITY,
                            .tolerance = 0.01};
  f->definition.reaches = &f->reach;
  f->definition.reach_count = 1;
}

typedef ambulo_status (*judge)(const ambulo_problem_definition *definition,
                               ambulo_diagnostics *list);

/* NULL: nothing is said. Closes the fixture. */
static void expect(fixture *f, judge check, const char *phrase) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = check(&f->definition, list);
  if (phrase || status) assert_message(list, 0, phrase ? phrase : "nothing");
  assert_int_equal(ambulo_diagnostics_count(list), phrase ? 1 : 0);
  assert_int_equal(status, phrase ? AMBULO_E_PROBLEM : AMBULO_OK);
  ambulo_diagnostics_free(list);
  ambulo_model_free(f->model);
}

/* the fixture with something changed */
#define SAYS(check, phrase, ...)                                                                   \
  do {                                                                                             \
    fixture f;                                                                                     \
    open_fixture(&f);                                                                              \
    __VA_ARGS__;                                                                                   \
    expect(&f, check, phrase);                                                                     \
  } while (0)

static void every_number_is_looked_at(void **state) {
  (void)state;
#define HOLDS(...) SAYS(ambulo__collision_check, __VA_ARGS__)
#define FENCED f.definition.obstacles = &f.fence, f.definition.obstacle_count = 1
  HOLDS(NULL, (void)f);
  HOLDS(NULL, FENCED);
  HOLDS(NULL, f.reach.to = 1.0);
  HOLDS("from 0 s to 1.1 s; expected times in 0 to 1 s", f.reach.to = 1.1);
  HOLDS("from 0 s to nan s", f.reach.to = NAN);
  HOLDS("from -0.1 s to inf s", f.reach.from = -0.1);
  HOLDS("from 0.5 s to 0.4 s", f.reach.from = 0.5, f.reach.to = 0.4);
  HOLDS("a place further than 1000 m away", f.reach.place[2] = NAN);
  HOLDS("a tolerance of -1 m", f.reach.tolerance = -1.0);
  HOLDS("names point -1", f.reach.point = -1);
  HOLDS("is relative to point -1; expected another one", f.reach.about = -1);
  HOLDS("is relative to point", f.reach.about = f.reach.point);
  HOLDS(NULL, f.reach.is_relative = 0, f.reach.about = -1);
  HOLDS("names capsules 99 and", f.pair.one = 99);
  HOLDS("are parts of one rigid body", f.pair.one = f.pair.other);
  HOLDS("constraints.collision.margin is -0.01 m", f.definition.collision.margin = -0.01);
  HOLDS("unknown collision mode 7", f.definition.collision.mode = (ambulo_collision_mode)7);
  HOLDS("obstacles[0] ('fence'): a number is out of range", FENCED, f.fence.half[1] = 0.0);
  HOLDS("out of range", FENCED, f.fence.center[0] = NAN);
  HOLDS("out of range", FENCED, f.fence.heading = INFINITY);
  HOLDS("out of range", FENCED, f.fence.shape = AMBULO_OBSTACLE_CAPSULE); /* of no radius */
  HOLDS("margin is nan m", FENCED, f.fence.margin = NAN);
  HOLDS("its shape is unknown (got 5)", FENCED, f.fence.shape = (ambulo_obstacle_shape)5);
  HOLDS("its shape is not set (got 0); expected box or capsule", FENCED,
        f.fence.shape = AMBULO_OBSTACLE_SHAPE_NOT_SET);
  HOLDS("has no name", FENCED, f.fence.name = "");
}

/* the same place at q = 0 on the shank, which moves otherwise */
static void move_to_the_shank(const fixture *f, int *link, double position[3]) {
  double place[3];
  ambulo__neutral_place(f->model, *link, position, place);
  *link = ambulo_model_find_link(f->model, "shank_l");
  ambulo__neutral_local(f->model, *link, place, position);
}

static void heels(fixture *f) {
  f->reach.point = point(f, "heel_r");
  f->reach.about = point(f, "heel_l");
}

/* one step stands for both: the way from a point to its image, to the side, all along */
static void mirrored_reaches_are_their_own_images(void **state) {
  (void)state;
#define MIRRORED(phrase, ...)                                                                      \
  SAYS(ambulo__collision_mirror_check, phrase, f.definition.ends = AMBULO_ENDS_MIRRORED;           \
       __VA_ARGS__)
  static const char other[] = "the mirror image of constraints.reach[0] is another one";
  MIRRORED(NULL, (void)f);
  MIRRORED(NULL, f.reach.to = 1.0);
  MIRRORED(NULL, heels(&f));
  MIRRORED("constraints.reach[0] asks for a place once", f.reach.is_relative = 0);
  MIRRORED(other, f.reach.place[0] = 0.01);
  MIRRORED(other, f.reach.place[2] = 0.01);
  MIRRORED(other, f.reach.from = 0.1);
  MIRRORED(other, f.reach.to = 0.9);
  MIRRORED(other, f.reach.about = point(&f, "ankle_l"));
  MIRRORED(other, heels(&f); f.reach.about = point(&f, "toe_l")); /* another place of that link */
  MIRRORED(other, heels(&f);
           ambulo_point *heel = &f.model->points[f.reach.about]; /* that place of another link */
           move_to_the_shank(&f, &heel->link, heel->position));
  SAYS(ambulo__collision_mirror_check, NULL, f.definition.ends = AMBULO_ENDS_PERIODIC;
       f.reach.is_relative = 0);
}

/* of the capsules that are used: radius, place from either end, and what moves them */
static void mirrored_capsules_are_images(void **state) {
  (void)state;
  static const char no_image[] = "is not the mirror image of";
  MIRRORED(no_image, capsule(&f, "shank_l")->radius += 0.001);
  MIRRORED(no_image, capsule(&f, "shank_l")->to[1] += 0.001);
  MIRRORED(NULL, capsule(&f, "thigh_l")->radius += 0.001); /* nobody asks */
  MIRRORED(
      NULL, ambulo_capsule *c = capsule(&f, "shank_l"); for (int i = 0; i < 3; i++) {
        double from = c->from[i];
        c->from[i] = c->to[i];
        c->to[i] = from;
      });
  MIRRORED(no_image, f.pair.one = find_capsule(f.model, "foot_l");
           f.pair.other = find_capsule(f.model, "foot_r");
           ambulo_capsule *foot = capsule(&f, "foot_l"); int link = foot->link;
           move_to_the_shank(&f, &foot->link, foot->from); move_to_the_shank(&f, &link, foot->to));
  MIRRORED("obstacle 'fence' stands once", FENCED);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_number_is_looked_at),
                                     cmocka_unit_test(mirrored_reaches_are_their_own_images),
                                     cmocka_unit_test(mirrored_capsules_are_images)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
