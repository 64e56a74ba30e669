/* A motion that turns, from above: prints lie along the headings of their contacts, all to one
 * scale. */
#include "ambulo/tools/tools.h"
#include "contact/contacts.h"
#include "show/gait_svg.h"
#include "solver/result.h"
#include "support/test.h"

#include <string.h>

enum { PRINTS = 5, HEEL = 0, TIP = 6 }; /* corners of a print */

static char *picture(const char *name, ambulo_problem **problem) {
  ambulo_result *result = NULL;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  assert_int_equal(ambulo_problem_load(name, NULL, 0, NULL, NULL, problem), AMBULO_OK);
  assert_int_equal(ambulo__result_create(*problem, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo__gait_svg(*problem, result, NULL, &text), AMBULO_OK);
  char *svg = strdup(ambulo__text_data(&text));
  assert_non_null(svg);
  ambulo__text_free(&text);
  ambulo_result_free(result);
  return svg;
}

static int count_of(const char *svg, const char *what) {
  int count = 0;
  for (const char *at = svg; (at = strstr(at, what)) != NULL; at++) count++;
  return count;
}

static void corner_of(const char *path, int corner, double at[2]) {
  char step;
  path = strchr(path, 'M');
  for (int i = 0; i < corner; i++) path = strchr(path + 1, 'L');
  assert_int_equal(sscanf(path, "%c%lf %lf", &step, &at[0], &at[1]), 3);
}

/* those of one foothold have one print: headings of -22.5, -22.5, -7.5, 7.5 and 22.5 degrees */
static void prints_point_along_their_headings(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  char *svg = picture("models/walk_turn.yaml", &problem);
  const ambulo_problem_definition *d = &problem->definition;
  double scale = 0.0;
  int prints = 0;
  const char *print = svg;
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *c = &d->contacts[i];
    int seen = 0;
    for (int k = 0; k < i; k++) seen |= d->contacts[k].place[0] == c->place[0];
    if (seen) continue;
    double heel[2], tip[2];
    print = strstr(print + 1, "-print\" d=");
    assert_non_null(print);
    corner_of(print, HEEL, heel);
    corner_of(print, TIP, tip);
    double length = hypot(tip[0] - heel[0], tip[1] - heel[1]);
    assert_close(atan2(heel[1] - tip[1], tip[0] - heel[0]), c->heading, 0.01);
    double now = length / (1.14 * ambulo__foot_reach(problem->model, c->foot));
    if (prints++ > 0) assert_close(now / scale, 1.0, 1e-3);
    scale = now;
  }
  assert_int_equal(prints, PRINTS);
  assert_null(strstr(print + 1, "-print\" d="));
  assert_true(scale > 100.0);
  assert_int_equal(count_of(svg, "<line class=\"trunk\""), 13); /* bars across the way */
  free(svg);
  ambulo_problem_free(problem);
}

static void only_turns_are_seen_from_above(void **state) {
  (void)state;
  static const char *const names[] = {"models/walk_turn.yaml", "models/squat.yaml",
                                      "models/walk_normal.yaml", "models/two_link_reach.yaml"};
  for (int i = 0; i < 4; i++) {
    ambulo_problem *problem = NULL;
    char *svg = picture(names[i], &problem);
    assert_int_equal(ambulo__gait_turns(problem), i == 0);
    assert_int_equal(count_of(svg, "From above"), i == 0);
    free(svg);
    ambulo_problem_free(problem);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(prints_point_along_their_headings),
                                     cmocka_unit_test(only_turns_are_seen_from_above)};
  return cmocka_run_group_tests_name("picture/gait_plan", tests, NULL, NULL);
}
