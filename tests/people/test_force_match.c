/* Which foot a group of force columns belongs to: by names, by a map, and never by a guess. */
#include "people/force_columns.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/motion_text.h"

enum { FEET = 4 };

/* a trunk with a massy link and two points for each foot */
static ambulo_model *model_of(const char *const *feet, const char *const *link_names, int count) {
  ambulo_link links[1 + FEET];
  ambulo_coordinate coordinate = ambulo_coordinate_default();
  ambulo_point points[2 * FEET];
  ambulo_foot foot[FEET];
  char names[2 * FEET][16];
  for (int i = 0; i <= count; i++) {
    links[i] = ambulo_link_default();
    links[i].name = i ? link_names[i - 1] : "trunk";
    links[i].parent = i ? 0 : -1;
    links[i].type = i ? AMBULO_FIXED : AMBULO_PRISMATIC;
    links[i].mass = 1.0;
    for (int k = 0; k < 3; k++) links[i].inertia[k] = 0.1;
  }
  coordinate.name = "height";
  for (int i = 0; i < count; i++) {
    for (int k = 0; k < 2; k++) {
      snprintf(names[2 * i + k], sizeof names[0], "p%d", 2 * i + k);
      points[2 * i + k] = (ambulo_point){names[2 * i + k], i + 1, {0.1 * k, 0.0, 0.0}};
    }
    foot[i] = (ambulo_foot){.name = feet[i],
                            .heel = {2 * i, -1},
                            .toe = {2 * i + 1, -1},
                            .heel_center = 2 * i,
                            .toe_center = 2 * i + 1,
                            .mirror = -1};
  }
  ambulo_model_definition d = ambulo_model_definition_default();
  d.name = "feet";
  d.links = links;
  d.link_count = 1 + count;
  d.coordinates = &coordinate;
  d.coordinate_count = 1;
  d.points = points;
  d.point_count = 2 * count;
  d.feet = foot;
  d.foot_count = count;
  ambulo_model *model = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_model_create(&d, NULL, list, &model);
  if (status) assert_message(list, 0, "(no message)");
  assert_int_equal(status, AMBULO_OK);
  ambulo_diagnostics_free(list);
  return model;
}

static const char *const two[] = {"left", "right"}, *const two_links[] = {"foot_l", "foot_r"};

/* groups "a b c" -> ground_force_a_vx, ...; expected: foot of each, or NULL with a message */
typedef struct attempt {
  const char *groups[4]; /* names of groups; NULL ends them */
  const char *map;
  int feet[4]; /* expected */
  ambulo_status status;
  const char *message; /* of the first message; NULL: none */
} attempt;

static void try_one(const ambulo_model *model, const attempt *a) {
  char text[1024] = "time";
  int count = 0;
  for (; count < 4 && a->groups[count]; count++) {
    size_t used = strlen(text);
    int own = strncmp(a->groups[count], "grf.", 4) == 0;
    snprintf(text + used, sizeof text - used, ",%s%s", a->groups[count], own ? ".x" : "_vx");
  }
  strcat(text, "\n0");
  for (int i = 0; i < count; i++) strcat(text, ",1");
  strcat(text, "\n");
  ambulo__motion *motion = NULL;
  ambulo__force_columns c;
  ambulo__doubts doubts = {ambulo_diagnostics_create(NULL), 0, 0, 0};
  assert_int_equal(
      motion_read_text(text, strlen(text), "f.csv", AMBULO__MOTION_CSV, NULL, NULL, &motion),
      AMBULO_OK);
  assert_int_equal(ambulo__force_columns_find(motion, "f.csv", NULL, NULL, &c), AMBULO_OK);
  assert_int_equal(c.count, count);
  ambulo_status status = ambulo__force_columns_match(&c, model, a->map, &doubts);
  if (status != a->status) print_error("%s map %s\n", text, a->map ? a->map : "");
  assert_int_equal(status, a->status);
  if (a->message) assert_message(doubts.diagnostics, 0, a->message);
  assert_int_equal(ambulo_diagnostics_count(doubts.diagnostics), a->message != NULL);
  for (int i = 0; !status && i < count; i++) {
    if (c.groups[i].foot != a->feet[i]) print_error("%s: %s\n", text, c.groups[i].name);
    assert_int_equal(c.groups[i].foot, a->feet[i]);
  }
  ambulo_diagnostics_free(doubts.diagnostics);
  ambulo__force_columns_free(&c);
  ambulo__motion_free(motion);
}

static void names_tell_the_foot(void **state) {
  (void)state;
  static const attempt attempts[] = {
      {{"ground_force_r", "ground_force_l"}, NULL, {1, 0}, AMBULO_OK, NULL},
      {{"R_ground_force", "L_ground_force"}, NULL, {1, 0}, AMBULO_OK, NULL},
      {{"ground_force_left", "ground_force_right"}, NULL, {0, 1}, AMBULO_OK, NULL},
      {{"ground_force_calcn_r", "ground_force_calcn_l"}, NULL, {1, 0}, AMBULO_OK, NULL},
      {{"grf.right", "grf.left"}, NULL, {1, 0}, AMBULO_OK, NULL},
      /* the same name goes before the same side */
      {{"ground_force_r", "grf.right", "grf.left"},
       NULL,
       {-1, 1, 0},
       AMBULO_OK,
       "'ground_force_r' act on no foot and are left out"},
      {{"ground_force_calcn_r", "ground_force_calcn_l", "ground_force_hand_l"},
       NULL,
       {1, 0, -1},
       AMBULO_OK,
       "warning: the forces 'ground_force_hand_l' act on no foot and are left out"},
      {{"ground_force_r"},
       NULL,
       {1},
       AMBULO_OK,
       "warning: no columns of forces on foot 'left'; it is taken to carry nothing"}};
  ambulo_model *model = model_of(two, two_links, 2);
  for (size_t i = 0; i < sizeof attempts / sizeof *attempts; i++) try_one(model, &attempts[i]);
  ambulo_model_free(model);
}

static void nothing_is_guessed(void **state) {
  (void)state;
  static const attempt attempts[] = {
      {{"ground_force", "1_ground_force"},
       NULL,
       {0},
       AMBULO_E_SCHEMA,
       "no columns of forces are named after foot 'left'; the file has ground_force, "
       "1_ground_force\n  hint: say which: --force-columns left=NAME,right=NAME (or none)"},
      {{"ground_force_1", "ground_force_2"}, NULL, {0}, AMBULO_E_SCHEMA, "after foot 'left'"},
      {{"ground_force", "l_ground_force"}, NULL, {0}, AMBULO_E_SCHEMA, "after foot 'right'"},
      {{"ground_force_calcn_r", "ground_force_hand_l"},
       NULL,
       {0},
       AMBULO_E_SCHEMA,
       "after foot 'left'"},
      {{"ground_force_r", "ground_force_right_foot", "ground_force_l"},
       NULL,
       {0},
       AMBULO_E_SCHEMA,
       "the columns 'ground_force_r' and 'ground_force_right_foot' both fit foot 'right'"},
      {{"ground_force_l_r", "ground_force_l"}, NULL, {0}, AMBULO_E_SCHEMA, "after foot 'right'"}};
  ambulo_model *model = model_of(two, two_links, 2);
  for (size_t i = 0; i < sizeof attempts / sizeof *attempts; i++) try_one(model, &attempts[i]);
  ambulo_model_free(model);
}

/* "rear" is not right because it begins with r, nor are two left feet the same */
static void feet_are_their_names(void **state) {
  (void)state;
  static const char *const pair[] = {"rear", "right"}, *const links[] = {"a", "b"};
  static const char *const four[] = {"left_front", "left_hind", "right_front", "right_hind"};
  static const char *const legs[] = {"w", "x", "y", "z"};
  static const attempt both[] = {
      {{"ground_force_rear", "ground_force_right"}, NULL, {0, 1}, AMBULO_OK, NULL},
      {{"ground_force_r"}, NULL, {1}, AMBULO_OK, "no columns of forces on foot 'rear'"},
      {{"ground_force_r", "ground_force_l"}, NULL, {0}, AMBULO_E_SCHEMA, "after foot 'rear'"}};
  static const attempt all[] = {
      {{"ground_force_right_hind", "ground_force_left_front", "ground_force_left_hind",
        "ground_force_right_front"},
       NULL,
       {3, 0, 1, 2},
       AMBULO_OK,
       NULL},
      {{"ground_force_l", "ground_force_r"},
       NULL,
       {0},
       AMBULO_E_SCHEMA,
       "the feet 'left_front' and 'left_hind' both fit the columns 'ground_force_l'"}};
  ambulo_model *model = model_of(pair, links, 2);
  for (int i = 0; i < 3; i++) try_one(model, &both[i]);
  ambulo_model_free(model);
  model = model_of(four, legs, 4);
  for (int i = 0; i < 2; i++) try_one(model, &all[i]);
  ambulo_model_free(model);
}

/* feet without a side in their name have the one of their link */
static void links_tell_the_side(void **state) {
  (void)state;
  static const char *const feet[] = {"hoof", "claw"}, *const links[] = {"shank_l", "shank_right"};
  static const attempt one = {{"ground_force_r", "ground_force_l"}, NULL, {1, 0}, AMBULO_OK, NULL};
  ambulo_model *model = model_of(feet, links, 2);
  try_one(model, &one);
  ambulo_model_free(model);
}

static void maps_say_it(void **state) {
  (void)state;
  static const attempt attempts[] = {
      {{"ground_force", "1_ground_force"},
       "right=ground_force,left=1_ground_force",
       {1, 0},
       AMBULO_OK,
       NULL},
      {{"ground_force_1", "ground_force_2", "ground_force_3"},
       "left=2,right=1+3",
       {1, 0, 1},
       AMBULO_OK,
       NULL},
      {{"ground_force_r", "ground_force_l"},
       "left=ground_force_r,right=ground_force_l",
       {0, 1},
       AMBULO_OK,
       NULL},
      {{"ground_force", "l_ground_force"}, "right=ground_force", {1, 0}, AMBULO_OK, NULL},
      {{"ground_force_r"}, "left=none", {1}, AMBULO_OK, NULL},
      {{"ground_force"}, "left=GROUND_FORCE,right=none", {0}, AMBULO_OK, NULL},
      {{"ground_force", "1_ground_force"},
       "right=ground_force",
       {1, -1},
       AMBULO_OK,
       "no columns of forces on foot 'left'"},
      {{"ground_force_1"},
       "left=ground_force_2",
       {0},
       AMBULO_E_SCHEMA,
       "no columns of forces are called 'ground_force_2'; the file has ground_force_1"},
      {{"ground_force_1"}, "left=a:b:c", {0}, AMBULO_E_SCHEMA, "no columns 'ax', 'ay', 'az'"},
      {{"ground_force_1"}, "left=ground_force_1_v", {0}, AMBULO_E_SCHEMA, "called"},
      {{"ground_force_1"}, "centre=1", {0}, AMBULO_E_ARGUMENT, "'centre' is no foot of the model"},
      {{"ground_force_1"}, "left=1,left=none", {0}, AMBULO_E_ARGUMENT, "'left' is given twice"},
      {{"ground_force_1"},
       "left=1,right=1",
       {0},
       AMBULO_E_ARGUMENT,
       "'1' belongs to a foot already"},
      {{"ground_force_1"}, "left", {0}, AMBULO_E_ARGUMENT, "'left' is not FOOT=NAME"},
      {{"ground_force_1"}, "left=", {0}, AMBULO_E_ARGUMENT, "'left=' is not FOOT=NAME"},
      {{"ground_force_1"}, "left=1+", {0}, AMBULO_E_ARGUMENT, "'left=1+' is not FOOT=NAME"},
      {{"ground_force_1"}, "left=1,", {0}, AMBULO_E_ARGUMENT, "'' is not FOOT=NAME"},
      {{"ground_force_1"}, "", {0}, AMBULO_E_ARGUMENT, "'' is not FOOT=NAME"}};
  ambulo_model *model = model_of(two, two_links, 2);
  for (size_t i = 0; i < sizeof attempts / sizeof *attempts; i++) try_one(model, &attempts[i]);
  ambulo_model_free(model);
}

static void a_file_without_forces(void **state) {
  (void)state;
  ambulo_model *model = model_of(two, two_links, 2);
  ambulo__motion *motion = NULL;
  ambulo__force_columns c;
  ambulo__doubts doubts = {ambulo_diagnostics_create(NULL), 0, 0, 0};
  static const char text[] = "time,FP1.Fx,FP1.Fy\n0,1,2\n";
  assert_int_equal(
      motion_read_text(text, strlen(text), "f.csv", AMBULO__MOTION_CSV, NULL, NULL, &motion),
      AMBULO_OK);
  assert_int_equal(ambulo__force_columns_find(motion, "f.csv", NULL, NULL, &c), AMBULO_OK);
  assert_int_equal(ambulo__force_columns_match(&c, model, NULL, &doubts), AMBULO_E_SCHEMA);
  assert_message(doubts.diagnostics, 0, "no column of forces on a foot");
  assert_message(doubts.diagnostics, 0, "the file has FP1.Fx, FP1.Fy");
  assert_int_equal(ambulo__force_columns_match(&c, model, "left=FP1.F,right=none", &doubts),
                   AMBULO_E_SCHEMA);
  assert_int_equal(ambulo__force_columns_match(&c, model, "left=FP1.F::,right=none", &doubts),
                   AMBULO_OK);
  assert_int_equal(c.count, 1);
  assert_int_equal(c.groups[0].foot, 0);
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    c.allocator = fail_alloc_hook(&memory);
    c.groups[0].foot = -1;
    ambulo__force_columns copy = c;
    copy.groups = NULL;
    copy.count = 0;
    ambulo_status status =
        ambulo__force_columns_match(&copy, model, "left=FP1.F::,right=none", &doubts);
    ambulo__force_columns_free(&copy);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  c.allocator = (ambulo_allocator){NULL, NULL};
  c.allocator = ambulo__allocator_or_default(NULL);
  ambulo_diagnostics_free(doubts.diagnostics);
  ambulo__force_columns_free(&c);
  ambulo__motion_free(motion);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(names_tell_the_foot),  cmocka_unit_test(nothing_is_guessed),
      cmocka_unit_test(feet_are_their_names), cmocka_unit_test(links_tell_the_side),
      cmocka_unit_test(maps_say_it),          cmocka_unit_test(a_file_without_forces)};
  return cmocka_run_group_tests_name("inverse/force_match", tests, NULL, NULL);
}
