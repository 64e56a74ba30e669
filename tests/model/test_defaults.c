/* Parts of a model that a caller starts from: what has to be given is refused until it is, the rest
 * is neutral. */
#include "ambulo/tools/tools.h"
#include "support/test.h"

typedef struct parts {
  ambulo_link link;
  ambulo_coordinate coordinate;
  ambulo_point points[4];
  ambulo_foot foot;
  ambulo_patch patch;
  ambulo_capsule capsule;
} parts;

/* a rod with a foot, a patch and a capsule; each of which says the least it has to */
static parts least_parts(void) {
  parts p = {ambulo_link_default(), ambulo_coordinate_default(), {{0}},
             ambulo_foot_default(), ambulo_patch_default(),      ambulo_capsule_default()};
  static const char *const names[4] = {"heel", "toe", "ball", "hand"};
  p.link.name = "rod";
  p.link.type = AMBULO_REVOLUTE;
  p.link.mass = 1.0;
  for (int i = 0; i < 3; i++) p.link.inertia[i] = 0.1;
  p.coordinate.name = "swing";
  p.coordinate.type = AMBULO_REVOLUTE;
  for (int i = 0; i < 4; i++) {
    p.points[i] = ambulo_point_default();
    p.points[i].name = names[i];
    p.points[i].link = 0;
    p.points[i].position[0] = 0.1 * i;
  }
  p.foot.name = "only";
  p.foot.heel[0] = p.foot.heel_center = 0;
  p.foot.toe[0] = p.foot.toe_center = 1;
  p.patch.name = "hand";
  p.patch.point = 3;
  p.patch.size[0] = p.patch.size[1] = 0.01;
  p.capsule.name = "rod";
  p.capsule.link = 0;
  p.capsule.radius = 0.05;
  return p;
}

static ambulo_status create(const parts *p, ambulo_model **model) {
  ambulo_model_definition d = ambulo_model_definition_default();
  d.links = &p->link;
  d.coordinates = &p->coordinate;
  d.points = p->points;
  d.feet = &p->foot;
  d.patches = &p->patch;
  d.capsules = &p->capsule;
  d.link_count = d.coordinate_count = d.foot_count = d.patch_count = d.capsule_count = 1;
  d.point_count = 4;
  return ambulo_model_create(&d, NULL, NULL, model);
}

static void the_rest_is_neutral(void **state) {
  (void)state;
  parts p = least_parts();
  ambulo_model *model = NULL;
  assert_int_equal(create(&p, &model), AMBULO_OK);
  const ambulo_foot *foot = ambulo_model_foot(model, 0);
  assert_int_equal(foot->mirror, 0);
  assert_int_equal(foot->heel[1], -1);
  assert_int_equal(foot->has_tip + foot->has_arcs, 0);
  assert_int_equal(ambulo_model_patch(model, 0)->mirror, 0);
  assert_int_equal(ambulo_model_capsule(model, 0)->mirror, 0);
  ambulo_model_free(model);
}

static void what_is_not_given_is_refused(void **state) {
  (void)state;
  for (int missing = 0; missing < 7; missing++) {
    parts p = least_parts();
    const ambulo_foot foot = ambulo_foot_default();
    if (missing == 0) p.points[2].link = ambulo_point_default().link;
    if (missing == 1) p.foot.heel[0] = foot.heel[0];
    if (missing == 2) p.foot.toe[0] = foot.toe[0];
    if (missing == 3) p.foot.heel_center = foot.heel_center;
    if (missing == 4) p.foot.toe_center = foot.toe_center;
    if (missing == 5) p.patch.point = ambulo_patch_default().point;
    if (missing == 6) p.capsule.link = ambulo_capsule_default().link;
    ambulo_model *model = NULL;
    if (create(&p, &model) != AMBULO_E_MODEL) fail_msg("missing %d is not refused", missing);
    assert_null(model);
  }
}

static void default_subject_is_the_one_of_the_file(void **state) {
  (void)state;
  const ambulo_subject subject = ambulo_subject_default();
  ambulo_model *plain = NULL, *scaled = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &plain),
                   AMBULO_OK);
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", &subject, NULL, NULL, &scaled),
                   AMBULO_OK);
  assert_true(ambulo_model_mass(plain) == ambulo_model_mass(scaled));
  assert_true(ambulo_model_stature(plain) == ambulo_model_stature(scaled));
  ambulo_model_free(plain);
  ambulo_model_free(scaled);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_rest_is_neutral),
      cmocka_unit_test(what_is_not_given_is_refused),
      cmocka_unit_test(default_subject_is_the_one_of_the_file),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
