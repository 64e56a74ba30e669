/* Sides and titles of coordinates, whatever they are called. */
#include "show/coordinate_name.h"
#include "ambulo/tools/load.h"
#include "support/test.h"

typedef struct named {
  const char *own, *other, *title;
  ambulo__side side;
} named;

static void check(ambulo_model *model, const int pair[2], const named *n) {
  const char *kept[2] = {model->coordinates[pair[0]].name, model->coordinates[pair[1]].name};
  model->coordinates[pair[0]].name = n->own;
  model->coordinates[pair[1]].name = n->other;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__coordinate_title(model, pair[0], &text);
  assert_string_equal(ambulo__text_data(&text), n->title);
  assert_int_equal(ambulo__coordinate_side(model, pair[0]), n->side);
  ambulo__text_free(&text);
  for (int e = 0; e < 2; e++) model->coordinates[pair[e]].name = kept[e];
}

static void test_names(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/whole_body_29.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  /* the pair's own sides: the right one's joint is on the right */
  int right = ambulo_model_find_coordinate(model, "knee_angle_r");
  assert_true(right >= 0);
  const int pair[2] = {right, model->coordinates[right].mirror};
  const named cases[] = {{"hip_flexion_r", "hip_flexion_l", "Hip flexion", AMBULO__RIGHT},
                         {"hip_flexion_l", "hip_flexion_r", "Hip flexion", AMBULO__LEFT},
                         {"left_ankle_X", "right_ankle_X", "Ankle X", AMBULO__LEFT},
                         {"arm_right_2_joint", "arm_left_2_joint", "Arm 2 joint", AMBULO__RIGHT},
                         {"LLEG_HIP_R", "RLEG_HIP_R", "LEG HIP R", AMBULO__LEFT},
                         {"R_KNEE", "L_KNEE", "KNEE", AMBULO__RIGHT},
                         {"kneeLeft", "kneeRight", "Knee", AMBULO__LEFT},
                         {"upright_l", "upright_r", "Upright", AMBULO__LEFT},
                         /* told apart by where they stand */
                         {"joint3", "joint9", "Joint3", AMBULO__RIGHT},
                         {"\xc3\xa9paule_r", "\xc3\xa9paule_l", "\xc3\xa9paule", AMBULO__RIGHT},
                         {"a<b&c_l", "a<b&c_r", "A<b&c", AMBULO__LEFT}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) check(model, pair, &cases[i]);
  const int other[2] = {pair[1], pair[0]};
  const named left = {"joint9", "joint3", "Joint9", AMBULO__LEFT};
  check(model, other, &left);
  int middle = ambulo_model_find_coordinate(model, "pelvis_tilt");
  assert_true(middle >= 0);
  assert_int_equal(ambulo__coordinate_side(model, middle), AMBULO__MIDDLE);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_names)};
  return cmocka_run_group_tests_name("picture/coordinate_name", tests, NULL, NULL);
}
