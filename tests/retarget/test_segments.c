/* Names of many conventions, and tables that replace them. */
#include "retarget/segments.h"

#include "support/given_motion.h"
#include "support/messages.h"

static void names(void **state) {
  (void)state;
  static const struct {
    const char *name;
    int segment;
  } known[] = {
      {"hip_flexion_r", AMBULO__THIGH},
      {"left_hip_pitch_joint", AMBULO__THIGH + 1},
      {"LHipYaw", AMBULO__THIGH + 1},
      {"LeftUpLeg_x", AMBULO__THIGH + 1},
      {"leg_right_2_joint", AMBULO__THIGH},
      {"knee_angle_l", AMBULO__SHANK + 1},
      {"RightLeg_z", AMBULO__SHANK},
      {"leg_left_4_joint", AMBULO__SHANK + 1},
      {"right_ankle_roll_joint", AMBULO__FOOT},
      {"LeftFoot_y", AMBULO__FOOT + 1},
      {"subtalar_angle_r", AMBULO__FOOT},
      {"leg_left_6_joint", AMBULO__FOOT + 1},
      {"arm_flex_r", AMBULO__UPPER_ARM},
      {"left_shoulder_roll", AMBULO__UPPER_ARM + 1},
      {"arm_left_4_joint", AMBULO__FOREARM + 1},
      {"RightForeArm_x", AMBULO__FOREARM},
      {"elbow_flex_l", AMBULO__FOREARM + 1},
      {"lumbar_bending", AMBULO__TORSO},
      {"waist_yaw_joint", AMBULO__TORSO},
      {"spine2_z", AMBULO__TORSO},
      {"left_wrist_yaw_joint", -1},
      {"neck_rotation", -1},
      {"mtp_angle_r", -1},
      {"knee", -1},
      {"left_collar_x", -1},
      {"arm_left_7_joint", -1},
  };
  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    assert_int_equal(ambulo__segment_of(known[i].name), known[i].segment);
}

static void root(void **state) {
  (void)state;
  person p = person_open(person_file, 0.0);
  const ambulo__segment_map *map = &p.figure.map;
  assert_int_equal(map->slides, 3);
  assert_int_equal(map->count[AMBULO__PELVIS], 3);
  assert_string_equal(p.model->coordinates[map->slide[0]].name, "pelvis_tx");
  assert_int_equal(map->count[AMBULO__FOOT], 2);
  person_close(&p);
}

static ambulo__yaml *table(const char *text, ambulo_diagnostics *messages) {
  ambulo__yaml *document = NULL;
  assert_int_equal(
      ambulo__yaml_load_text(text, strlen(text), "map.yaml", NULL, messages, &document), AMBULO_OK);
  return document;
}

static void given(void **state) {
  (void)state;
  person p = person_open(person_file, 0.0);
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  ambulo__yaml *document = table("torso: ['neck_*']\nfoot_r: [ankle_angle_r]\n", messages);
  ambulo__segment_map map;
  ambulo__segments_find(p.model, ambulo__yaml_root(document), &map);
  assert_int_equal(ambulo__yaml_finish(document), AMBULO_OK);
  assert_int_equal(map.count[AMBULO__TORSO], 2);
  assert_int_equal(map.count[AMBULO__FOOT], 1);
  assert_int_equal(map.count[AMBULO__FOOT + 1], 2);
  ambulo__yaml_free(document);
  document = table("shank_r: [knee]\nshin_r: [knee_angle_r]\n", messages);
  ambulo__segments_find(p.model, ambulo__yaml_root(document), &map);
  assert_int_equal(ambulo__yaml_finish(document), AMBULO_E_SCHEMA);
  assert_message(messages, 0, "map.yaml:1:11");
  assert_message(messages, 0, "has no coordinate 'knee'");
  assert_message(messages, 1, "shin_r");
  ambulo__yaml_free(document);
  ambulo_diagnostics_free(messages);
  person_close(&p);
}

/* what is printed reads back as the same */
static void printed(void **state) {
  (void)state;
  person p = person_open(person_file, 0.0);
  ambulo__text_buffer text;
  ambulo__segment_map map;
  ambulo__text_init(&text, NULL);
  ambulo__text_append(&text, "source:\n");
  ambulo__segments_print(p.model, &p.figure.map, &text);
  ambulo__yaml *document = table(ambulo__text_data(&text), NULL);
  ambulo__segments_find(p.model, ambulo__yaml_get(ambulo__yaml_root(document), "source"), &map);
  assert_memory_equal(&map, &p.figure.map, sizeof map);
  assert_int_equal(ambulo__segment_above(AMBULO__FOOT + 1), AMBULO__SHANK + 1);
  assert_string_equal(ambulo__segment_word(AMBULO__FOOT + 1), "foot_l");
  ambulo__yaml_free(document);
  ambulo__text_free(&text);
  person_close(&p);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(names), cmocka_unit_test(root),
                                     cmocka_unit_test(given), cmocka_unit_test(printed)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
