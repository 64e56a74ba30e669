/* Sensitivities of the shipped problems against those that were derived by hand.
 *
 * tests/solver/sensitivity_reference.txt has them at a point that needs no solve: the start pose
 * and a wave, with a multiplier of its own for each row. The identity df*_dp = dL/dp holds there as
 * well as at a solution, and every row counts. Numbers of one key and many coordinates are one
 * line, a sum weighted by their names:
 *
 *     NAME COUNT VALUE DERIVATIVE TRAVEL SIZE
 *
 * SIZE is the sum of the derivatives' sizes. A difference counts against that, and against the
 * rounding of the Lagrangian, the sizes of whose parts add up to what stands behind the problem's
 * name. Rows of friction and flight, slopes under a posture, the moments of contacts and the
 * pressure of arcs have had other laws since, some files another grid: differences alone compare
 * those (test_differences.c).
 */
#include "ambulo/tools/load.h"
#include "ambulo/sensitivity.h"
#include "problem/nlp.h"
#include "solver/result.h"
#include "support/problem_path.h"
#include "support/test.h"

enum { MOST_LINES = 600, NAME = 200, WAVE_PERIOD = 1000 };

typedef struct line {
  char name[NAME];
  int count;
  double value, derivative, travel, size;
  double rounding; /* of the derivative, of a Lagrangian of parts that add up to 1 */
} line;

typedef struct lines {
  int count;
  line list[MOST_LINES];
} lines;

/* ------------------------------------------------------------------ the point */

static unsigned long long hash_of(unsigned long long hash, const char *text) {
  for (; *text; text++) hash = (hash ^ (unsigned char)*text) * 1099511628211ULL;
  return hash;
}

static double *point_of(const ambulo_problem *p) {
  double *x = calloc((size_t)p->variables, sizeof *x);
  ambulo__start_pose(p, x);
  for (int k = 0; k < p->variables; k++) {
    int coordinate = k % p->coordinates, control_point = k / p->coordinates;
    x[k] += 0.02 * sin(1.0 + 0.7 * coordinate + 0.4 * control_point);
  }
  return x;
}

static double *multipliers_of(const ambulo_problem *p) {
  double *multiplier = calloc((size_t)p->rows + 1, sizeof *multiplier);
  for (int r = 0; r < p->rows; r++) {
    ambulo_row row;
    assert_int_equal(ambulo_problem_row(p, r, &row), AMBULO_OK);
    unsigned long long hash = hash_of(14695981039346656037ULL, row.family);
    hash = hash_of(hash_of(hash, row.subject), row.detail);
    multiplier[r] = 0.1 * sin((double)(hash % WAVE_PERIOD) + 0.37 * row.node);
    if (!strcmp(row.family, "friction") || !strcmp(row.family, "collision"))
      multiplier[r] = 0.0; /* rows of another law since; those in test_numbers_task.c */
  }
  return multiplier;
}

static ambulo_sensitivity_list *list_of(const ambulo_problem *p) {
  ambulo_sensitivity_list *list = NULL;
  ambulo_result at = {.verdict = AMBULO_OPTIMAL, .variables = p->variables, .rows = p->rows};
  at.x = point_of(p);
  at.multiplier = multipliers_of(p);
  at.objective = 1.0;
  assert_int_equal(ambulo_sensitivities(p, &at, NULL, &list), AMBULO_OK);
  free(at.x);
  free(at.multiplier);
  return list;
}

/* -------------------------------------------------------------- one line each */

/* "objective[effort].scale.*" of "objective[effort].scale.knee_angle_r[1]" */
static void name_line(const char *name, char text[NAME]) {
  static const char limits[] = "model.links[*].coordinate.";
  (void)snprintf(text, NAME, "%s", name);
  char *last = strrchr(text, '.'), *first = strchr(text, '.');
  int is_folded = strncmp(name, "ends.", 5) == 0 || strncmp(name, "objective[", 10) == 0 ||
                  strncmp(name, "constraints.tubes", 17) == 0;
  if (strncmp(name, "model.", 6) == 0) {
    const char *key = strrchr(name, '.') + 1;
    (void)snprintf(text, NAME, "%s%.*s*", limits, (int)strcspn(key, "["), key);
  } else if (last != first && is_folded) {
    (void)snprintf(last, (size_t)(text + NAME - last), ".*");
  }
}

static line *line_named(lines *all, const char *name) {
  for (int i = 0; i < all->count; i++)
    if (strcmp(all->list[i].name, name) == 0) return &all->list[i];
  assert_true(all->count < MOST_LINES);
  line *next = &all->list[all->count++];
  *next = (line){.count = 0};
  (void)snprintf(next->name, NAME, "%s", name);
  return next;
}

static void gather(const ambulo_sensitivity_list *list, lines *all) {
  all->count = 0;
  for (int i = 0; i < list->count; i++) {
    const ambulo_sensitivity *s = &list->items[i];
    char name[NAME];
    name_line(s->name, name);
    double weight =
        strcmp(name, s->name) == 0
            ? 1.0
            : 1.0 + (double)(hash_of(14695981039346656037ULL, s->name) % WAVE_PERIOD) / WAVE_PERIOD;
    line *to = line_named(all, name);
    to->count++;
    to->value += weight * s->value;
    to->derivative += weight * s->derivative;
    to->travel += weight * s->travel;
    to->size += weight * fabs(s->derivative);
    to->rounding += weight * 1e-12 / s->step;
  }
}

/* ------------------------------------------------------------------ comparing */

static int is_quick(const char *problem) {
  static const char *const quick[] = {"fig5b_torque",
                                      "pendulum_swing",
                                      "support/forefoot_run_without_toes",
                                      "support/rigid_squat",
                                      "support/rigid_stairs_down",
                                      "support/rigid_stairs_up",
                                      "support/two_link_reach",
                                      "support/walk_without_toes",
                                      "walk_asymmetric",
                                      "support/rigid_walk_start",
                                      "support/rigid_walk_turn",
                                      "support/walk_without_toes+ankle_exoskeleton",
                                      "support/walker_2d_step",
                                      "yardstick_12"};
  for (size_t i = 0; i < sizeof quick / sizeof *quick; i++)
    if (strcmp(problem, quick[i]) == 0) return 1;
  return getenv("AMBULO_LONG") != NULL;
}

static const line *find(const lines *all, const char *name) {
  for (int i = 0; i < all->count; i++)
    if (strcmp(all->list[i].name, name) == 0) return &all->list[i];
  return NULL;
}

/* 1: they agree */
static int compare(const char *problem, double parts, const line *want, const lines *all) {
  const double tolerance = 1e-7;
  const line *got = find(all, want->name);
  if (!got) {
    print_error("%s: %s is not there\n", problem, want->name);
    return 0;
  }
  double allowed = tolerance * want->size + got->rounding * parts;
  int same = got->count == want->count &&
             fabs(got->value - want->value) <= 1e-8 * (1.0 + fabs(want->value));
  if (same && fabs(got->derivative - want->derivative) <= allowed &&
      fabs(got->travel - want->travel) <= tolerance * (1.0 + fabs(want->travel)))
    return 1;
  print_error("%s: %s: %d, %.12g, %.12g, %.12g; expected %d, %.12g, %.12g, %.12g (+- %.3g)\n",
              problem, want->name, got->count, got->value, got->derivative, got->travel,
              want->count, want->value, want->derivative, want->travel, allowed);
  return 0;
}

/* what walks wore before they had toes: NAME+WORN is NAME with these settings */
#define LOOSE "constraints.contact_tolerance=0.0005", "constraints.orientation_tolerance=0.005"
enum { MOST_SETTINGS = 7 };
static const struct {
  const char *name, *settings[MOST_SETTINGS];
} worn[] = {
    {"ankle_exoskeleton",
     {LOOSE, "gait.speed=1.25",
      "devices=[{name: ankle_spring_r, kind: spring, coordinate: ankle_angle_r, stiffness: 180, "
      "rest: 0, side: above, foot: right, engaged: {from: 0.02, to: 0.64, ramp: 0.04}, mirror: "
      "true}]"}},
    {"backpack",
     {LOOSE, "load=[{link: thorax, mass: 16, position: [-0.18, 0.25, 0]}, {link: pelvis, mass: 2, "
             "position: [0, 0.05, 0.16]}, {link: pelvis, mass: 2, position: [0, 0.05, -0.16]}]"}},
    {"exotendon",
     {LOOSE, "gait.step_time=0.53", "free={gait.step_time: [0.3, 0.9]}",
      "devices=[{name: tendon, kind: spring, between: [{link: foot_r, position: [0.04, 0, 0]}, "
      "{link: foot_l, position: [0.04, 0, 0]}], stiffness: 120, rest: 0.22, side: above, "
      "smoothing: 0.02}]"}},
    {"knee_brace",
     {LOOSE, "gait.steps=2", "ends.kind=periodic", "time.intervals=192", "trajectory.intervals=28",
      "devices=[{name: brace, kind: spring, coordinate: knee_angle_r, stiffness: 500, rest: 40, "
      "side: above, smoothing: 4}]"}},
};

/* the settings of NAME+WORN, whose +WORN goes */
static const char *const *settings_of(char *name, int *count) {
  char *plus = strchr(name, '+');
  *count = 0;
  if (!plus) return NULL;
  *plus = '\0';
  for (size_t i = 0; i < sizeof worn / sizeof *worn; i++) {
    if (strcmp(worn[i].name, plus + 1) != 0) continue;
    while (*count < MOST_SETTINGS && worn[i].settings[*count]) ++*count;
    return worn[i].settings;
  }
  fail_msg("no settings of %s", plus + 1);
  return NULL;
}

/* rigid feet press in boxes that are given, whatever the outline of their sole; the flat one is not
 * there where the file has its own */
static void open_problem(const char *name, lines *all) {
  static const char *const boxes[] = {
      "ground_reaction.pressure.heel=[-0.02, 0.03]", "ground_reaction.pressure.toe=[-0.02, 0.055]",
      "ground_reaction.pressure.width=0.035", "ground_reaction.pressure.arc=0.0045",
      "ground_reaction.pressure.flat=[-0.005, 0.02]"};
  char path[256], file[NAME];
  ambulo_problem *problem = NULL;
  int own = !strcmp(name, "support/rigid_stairs_up"), count;
  (void)snprintf(file, sizeof file, "%s", name);
  const char *const *settings = settings_of(file, &count);
  if (strstr(name, "rigid_")) {
    settings = boxes;
    count = 5 - own;
  }
  problem_path(file, path, sizeof path);
  assert_int_equal(ambulo_problem_load(path, settings, count, NULL, NULL, &problem), AMBULO_OK);
  ambulo_sensitivity_list *list = list_of(problem);
  gather(list, all);
  ambulo_sensitivities_free(list);
  ambulo_problem_free(problem);
}

static void as_by_hand(void **state) {
  (void)state;
  char text[400], problem[NAME] = "";
  int compared = 0, apart = 0, skips = 1;
  double parts = 0.0;
  lines *all = calloc(1, sizeof *all);
  FILE *file = fopen("tests/solver/sensitivity_reference.txt", "r");
  assert_non_null(file);
  while (fgets(text, sizeof text, file)) {
    line want;
    if (text[0] == '#' || text[0] == '\n') continue;
    if (sscanf(text, "problem %199s %lf", problem, &parts) == 2) {
      skips = !is_quick(problem);
      if (!skips) open_problem(problem, all);
      continue;
    }
    assert_int_equal(sscanf(text, "%199s %d %lf %lf %lf %lf", want.name, &want.count, &want.value,
                            &want.derivative, &want.travel, &want.size),
                     6);
    if (skips) continue;
    compared++;
    apart += !compare(problem, parts, &want, all);
  }
  (void)fclose(file);
  free(all);
  assert_true(compared > 400);
  assert_int_equal(apart, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(as_by_hand)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
