/* show/gait_people.c - see gait_people.h. */
#include "show/gait_people.h"

#include "ambulo/tools/compare.h"
#include "ambulo/tools/report.h"
#include "base/arithmetic.h"
#include "contact/row_families.h"
#include "model/neutral_pose.h"
#include "people/stride.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double level = 0.01; /* rad: ground that rises by less */
static const double degrees = 57.295779513082321;
static const char *const side_letter[] = {"", "l", "r"};
static const char *const side_word[] = {"", "left", "right"};

static int is_level(const ambulo_problem *problem) {
  const ambulo_model *model = problem->model;
  double along = -ambulo__dot(model->forward, model->gravity);
  double up = -ambulo__dot(model->up, model->gravity);
  return problem->definition.rise == 0.0 && fabs(atan2(along, up)) < level;
}

double ambulo__gait_mass(const ambulo_model *model) {
  return ambulo__model_weight(model) / sqrt(ambulo__dot(model->gravity, model->gravity));
}

/* steps that follow each other for ever: a walk or a run, on any ground */
static int repeats(const ambulo_problem *problem) {
  ambulo_ends ends = ambulo_problem_ends(problem);
  return (ends == AMBULO_ENDS_MIRRORED || ends == AMBULO_ENDS_PERIODIC) &&
         problem->definition.travel != 0.0 && problem->model->foot_count == 2;
}

int ambulo__gait_is_walk(const ambulo_problem *problem) {
  ambulo__span flight;
  return repeats(problem) && is_level(problem) &&
         !ambulo__flight_span(&problem->definition, &flight);
}

/* ------------------------------------------------------------------- strikes */

/* by the foot's name, as strikes are distinguished in summary.json; else where it stands, beside
 * the other: feet of a planar body stand in one line */
static ambulo__side side_of(const ambulo_model *model, int foot) {
  const char *name = model->feet[foot].name;
  double here[3], there[3];
  if (strstr(name, "left")) return AMBULO__LEFT;
  if (strstr(name, "right")) return AMBULO__RIGHT;
  ambulo__neutral_point(model, model->feet[foot].heel_center, here);
  ambulo__neutral_point(model, model->feet[1 - foot].heel_center, there);
  return ambulo__dot(here, model->left) > ambulo__dot(there, model->left) ? AMBULO__LEFT
                                                                          : AMBULO__RIGHT;
}

static ambulo_status find_strikes(ambulo__gait_people *g) {
  const ambulo_problem *problem = g->stride->problem;
  size_t most = (size_t)ambulo__most_strikes(problem);
  ambulo__strike *strikes = ambulo__alloc(&g->allocator, most, sizeof *strikes);
  g->strikes[AMBULO__LEFT] = ambulo__alloc(&g->allocator, most, sizeof(double));
  g->strikes[AMBULO__RIGHT] = ambulo__alloc(&g->allocator, most, sizeof(double));
  int failed = !strikes || !g->strikes[AMBULO__LEFT] || !g->strikes[AMBULO__RIGHT];
  int count = failed ? 0 : ambulo__strikes(problem, strikes);
  for (int i = 0; i < count; i++) {
    ambulo__side side = side_of(g->stride->model, strikes[i].foot);
    g->strikes[side][g->count[side]++] = strikes[i].time;
  }
  ambulo__free(&g->allocator, strikes);
  return failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

int ambulo__gait_cycles(const ambulo__gait_people *g) {
  return g->count[AMBULO__LEFT] > 0 && g->count[AMBULO__RIGHT] > 0;
}

static ambulo__side first_side(const ambulo__gait_people *g) {
  if (!ambulo__gait_cycles(g)) return AMBULO__RIGHT;
  return g->strikes[AMBULO__LEFT][0] < g->strikes[AMBULO__RIGHT][0] ? AMBULO__LEFT : AMBULO__RIGHT;
}

/* NaN without strikes */
double ambulo__gait_percent(const ambulo__gait_people *g, ambulo__side side, double t) {
  if (side == AMBULO__MIDDLE) side = first_side(g);
  int n = g->count[side];
  const double *strike = g->strikes[side];
  double period = g->stride->duration;
  if (n == 0) return (double)NAN;
  int next = 0;
  while (next < n && strike[next] <= t) next++;
  double from = next > 0 ? strike[next - 1] : strike[n - 1] - period;
  double to = next < n ? strike[next] : strike[0] + period;
  return 100.0 * (t - from) / (to - from);
}

ambulo_status ambulo__gait_people_create(const ambulo__stride *stride, const ambulo__people *people,
                                         const ambulo_allocator *allocator,
                                         ambulo__gait_people *gait) {
  ambulo__gait_people g = {.allocator = ambulo__allocator_or_default(allocator), .stride = stride};
  ambulo_status status = AMBULO_OK;
  ambulo__body_joints(stride->model, g.joints);
  if (repeats(stride->problem)) {
    status = find_strikes(&g);
    if (ambulo__gait_cycles(&g) && ambulo__gait_is_walk(stride->problem)) g.people = people;
  }
  *gait = g;
  if (status) ambulo__gait_people_free(gait);
  return status;
}

void ambulo__gait_people_free(ambulo__gait_people *gait) {
  for (int side = 0; side < 3; side++) {
    ambulo__free(&gait->allocator, gait->strikes[side]);
    gait->strikes[side] = NULL;
  }
}

/* -------------------------------------------------------------------- curves */

/* 1 if `pattern`, with the side in place of {side} or {foot}, reads first.second[.third] */
static int reads(const char *pattern, ambulo__side side, const char *const part[3]) {
  char text[2 * AMBULO__CURVE_NAME + 192] = "";
  size_t used = 0;
  for (int i = 0; i < 3 && part[i] && used < sizeof text; i++)
    used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", i ? "." : "", part[i]);
  if (used >= sizeof text) return 0;
  const char *at = text;
  for (const char *c = pattern; *c;) {
    const char *word = strncmp(c, "{side}", 6) == 0   ? side_letter[side]
                       : strncmp(c, "{foot}", 6) == 0 ? side_word[side]
                                                      : NULL;
    size_t length = word ? strlen(word) : 1;
    if (strncmp(at, word ? word : c, length) != 0) return 0;
    at += length;
    c += word ? 6 : 1;
  }
  return *at == '\0';
}

/* `joint`: whose curve it is, in the body's words in `part`; NULL: no joint of a person */
static ambulo__people_curve find(const ambulo__gait_people *g, ambulo__side side,
                                 const char *const part[3], const ambulo__body_joint *joint) {
  const char *const own[3] = {part[0], joint ? joint->name : part[1], part[2]};
  int turned = joint && joint->sign < 0 && strcmp(part[0], "power") != 0;
  ambulo__people_curve found = {.curve = NULL, .of = g, .side = side};
  for (int f = 0; g->people && side != AMBULO__MIDDLE && f < g->people->count; f++) {
    const ambulo__reference *reference = &g->people->files[f].reference;
    for (int i = 0; !found.curve && i < reference->count; i++) {
      const ambulo__map_entry *entry = reference->curves[i].entry;
      if (!reads(entry->result, side, entry->by_body ? own : part)) continue;
      found.curve = &reference->curves[i];
      found.file = f;
      found.scale = 1.0 / entry->factor;
      if (entry->opposite && side == AMBULO__RIGHT) found.scale = -found.scale;
      if (entry->by_body && turned) found.scale = -found.scale;
      if (entry->tilted) found.shift = degrees * ambulo_compare_options_default().pelvic_tilt;
    }
  }
  return found;
}

ambulo__people_curve ambulo__people_coordinate(const ambulo__gait_people *g, const char *quantity,
                                               int coordinate) {
  const ambulo_model *model = g->stride->model;
  const char *const part[3] = {quantity, model->coordinates[coordinate].name, NULL};
  const ambulo__body_joint *joint = NULL;
  for (int i = 0; i < AMBULO__BODY_JOINTS && !joint; i++)
    if (g->joints[i].coordinate == coordinate) joint = &g->joints[i];
  ambulo__people_curve found = find(g, ambulo__coordinate_side(model, coordinate), part, joint);
  if (!found.curve || found.curve->entry->unit == AMBULO__UNIT_ANGLE) return found;
  if (!g->per_kg) found.scale *= ambulo__gait_mass(model);
  if (g->stride->feet == 0) found.curve = NULL;
  return found;
}

ambulo__people_curve ambulo__people_force(const ambulo__gait_people *g, const char *direction,
                                          ambulo__side side) {
  const ambulo_model *model = g->stride->model;
  const char *const part[3] = {"grf", side_word[side], direction};
  ambulo__people_curve found = find(g, side, part, NULL);
  if (!g->per_kg) found.scale /= sqrt(ambulo__dot(model->gravity, model->gravity));
  return found;
}

int ambulo__people_at(const ambulo__people_curve *c, int k, double *mean, double *band) {
  if (!c->curve) return 0;
  double t = c->of->stride->times[k];
  return ambulo__people_at_percent(c, ambulo__gait_percent(c->of, c->side, t), mean, band);
}

int ambulo__people_at_percent(const ambulo__people_curve *c, double percent, double *mean,
                              double *band) {
  if (!c->curve) return 0;
  const double *at = c->curve->percent;
  int last = c->curve->points - 1, high = 1;
  if (!(percent >= at[0] - 1e-6) || percent > at[last] + 1e-6) return 0;
  while (high < last && at[high] < percent) high++;
  double share = (percent - at[high - 1]) / (at[high] - at[high - 1]);
  const double *m = c->curve->mean + high - 1, *s = c->curve->sd ? c->curve->sd + high - 1 : NULL;
  *mean = c->scale * (m[0] + share * (m[1] - m[0]) - c->shift);
  *band = s ? 2.0 * fabs(c->scale) * (s[0] + share * (s[1] - s[0])) : 0.0;
  return 1;
}
