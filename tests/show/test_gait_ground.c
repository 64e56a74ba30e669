/* The ground of a picture: surfaces of contacts, one behind the other. */
#include "show/gait_ground.h"
#include "support/walker_result.h"

/* ground of the walker on other contacts, which the problem does not own */
static void ground_of(walk *w, const ambulo_contact *contacts, int count, ambulo__gait_ground *g) {
  ambulo_problem_definition own = w->problem->definition;
  w->problem->definition.contacts = contacts;
  w->problem->definition.contact_count = count;
  assert_int_equal(ambulo__gait_ground_create(w->problem, NULL, g), AMBULO_OK);
  w->problem->definition.contacts = own.contacts;
  w->problem->definition.contact_count = own.contact_count;
}

static double height_at(const ambulo__gait_ground *g, double x) {
  for (int i = 0; i < g->count; i++)
    if (x >= g->surface[i].from && x <= g->surface[i].to)
      return ambulo__surface_height(&g->surface[i], x);
  return NAN;
}

static void level_ground_has_no_surfaces(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo__gait_ground g;
  assert_int_equal(ambulo__gait_ground_create(w.problem, NULL, &g), AMBULO_OK);
  assert_int_equal(g.count, 0);
  ambulo__gait_ground_free(&g);
  walk_close(&w);
}

/* a step that rises: also those before and after it, with risers between their feet */
static void stairs_go_on_before_and_after(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo_contact contacts[2] = {{0, AMBULO_CONTACT_FLAT, 0.0, 0.4, .place = {0.0, 0.0, 0.0}},
                                {0, AMBULO_CONTACT_TOE, 0.4, 0.5, .place = {0.0, 0.0, 0.0}}};
  w.problem->definition.travel = 0.5;
  w.problem->definition.rise = 0.2;
  ambulo__gait_ground g;
  ground_of(&w, contacts, 2, &g);
  assert_int_equal(g.count, 6); /* heel, flat and toe of a foot are one */
  assert_true(isinf(g.surface[0].from) && isinf(g.surface[5].to));
  for (int i = -2; i <= 3; i++) {
    assert_close(height_at(&g, 0.5 * i), 0.2 * i, 1e-12);
    if (i < 3) assert_close(g.surface[i + 2].to, g.surface[i + 3].from, 0.0);
  }
  double reach = 2.0 * g.surface[2].to - 0.5;
  assert_true(reach > 0.1 && reach < 0.4);
  ambulo__gait_ground_free(&g);
  walk_close(&w);
}

static void a_slope_rises_along_its_surface(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo_contact contact = {0,   AMBULO_CONTACT_FLAT,      0.0,
                            0.4, .place = {1.0, 0.0, 0.3}, .normal = {-0.1, 0.0, 2.0}};
  w.problem->definition.ends = AMBULO_ENDS_FREE;
  ambulo__gait_ground g;
  ground_of(&w, &contact, 1, &g);
  assert_int_equal(g.count, 1);
  assert_close(height_at(&g, 1.0), 0.3, 1e-15);
  assert_close(height_at(&g, 1.4), 0.32, 1e-12);
  ambulo__gait_ground_free(&g);
  walk_close(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(level_ground_has_no_surfaces),
                                     cmocka_unit_test(stairs_go_on_before_and_after),
                                     cmocka_unit_test(a_slope_rises_along_its_surface)};
  return cmocka_run_group_tests_name("picture/gait_ground", tests, NULL, NULL);
}
