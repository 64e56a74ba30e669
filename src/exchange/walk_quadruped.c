/* exchange/walk_quadruped.c - a problem in which a robot on four legs walks, trots or bounds.
 *
 * A gait says when in a stride each foot comes down, and for which share of it a foot is down:
 *
 *              fl    fr    hl    hr    share   stride T / sqrt(l / g)   speed v / sqrt(g l)
 *     walk     1/4   3/4   0     1/2   0.8     5                        0.12
 *     trot     0     1/2   1/2   0     0.6     2.6                      0.3
 *     bound    0     0     1/2   1/2   0.45    2.5                      0.5
 *
 * with l the length of the legs. A walk has three or four feet down at any time; a trot two, and
 * four where pairs change; a bound is in flight twice. Footholds are under the places that feet
 * have in the start pose when the body is half-way through their stance. Where left and right are
 * images of each other, walk and trot are half a stride and its mirror image.
 *
 * Lengths, times and torques are counted as in walk_robot.c. Forces are not drawn to the centre of
 * mass (slant 1): seen from feet that stand wide it is too far aside for friction.
 */
#include "exchange/walker.h"

#include <math.h>
#include <string.h>

enum { FEET = 4, INTERVALS = 240, PIECES = 20 };

typedef struct gait_of_four {
  const char *name;
  double strike[FEET], share; /* of a stride */
  double stride, speed;       /* in sqrt(l / g), in sqrt(g l) */
  int mirrors;                /* its second half is the mirror image of the first */
} gait_of_four;

static const gait_of_four gaits[] = {
    {"walk", {0.25, 0.75, 0.0, 0.5}, 0.8, 5.0, 0.12, 1},
    {"trot", {0.0, 0.5, 0.5, 0.0}, 0.6, 2.6, 0.3, 1},
    {"bound", {0.0, 0.0, 0.5, 0.5}, 0.45, 2.5, 0.5, 0},
};

static const gait_of_four *find(const char *name) {
  for (size_t i = 0; i < sizeof gaits / sizeof *gaits; i++)
    if (strcmp(gaits[i].name, name) == 0) return &gaits[i];
  return NULL;
}

int ambulo__is_gait_of_four(const char *name) {
  return find(name) != NULL;
}

/* what is written: a stride, or the half of one */
typedef struct stride {
  const ambulo__walker *w;
  const gait_of_four *gait;
  double time, travel, part; /* of a whole stride, s and m; 1 or 1/2 of it is written */
  ambulo__text_buffer *text;
} stride;

static void line(const stride *s, const char *before, double value, const char *after) {
  ambulo__text_append(s->text, before);
  ambulo__walk_number(s->text, value);
  ambulo__text_append(s->text, after);
}

/* whole steps of `by`, so that images of places and times agree to the last digit */
static double stepped(double value, double by) {
  return round(value / by) * by;
}

static void exact(const stride *s, const char *before, double value, const char *after) {
  ambulo__text_append(s->text, before);
  ambulo__text_append_number(s->text, ambulo__significant(value, 9));
  ambulo__text_append(s->text, after);
}

static void print_head(const stride *s) {
  const ambulo__walker *w = s->w;
  ambulo__text_append_format(
      s->text, "# A %s of %s, by 'ambulo new %s --for': %s.\n", s->gait->name, w->file,
      s->gait->name, s->part < 1.0 ? "half a stride, followed by its mirror image" : "a stride");
  line(s, "#\n# Numbers follow from the body, ", w->mass, " kg on legs of ");
  line(s, "", w->leg,
       " m: lengths are shares of the legs, torques of weight\n# times legs, times ");
  line(s, "of the pendulum they make. It goes at ", s->travel / s->time, " m/s.\n\n");
  ambulo__text_append_format(s->text,
                             "ambulo: 1\nkind: problem\nname: %s\nmodel: %s\nangles: degrees\n\n",
                             s->gait->name, w->file);
  exact(s, "time: {duration: ", s->part * s->time, ", grid: events, ");
  ambulo__text_append_format(s->text,
                             "intervals: %d}\n"
                             "trajectory: {basis: bspline, degree: 4, intervals: %d, knots: "
                             "events}\n\n",
                             (int)(s->part * INTERVALS), (int)(s->part * PIECES));
}

/* the part of a stance that is in what is written */
static void print_contact(const stride *s, int foot, double from, double to) {
  double middle = 0.5 * (from + to), begin = fmax(from, 0.0), end = fmin(to, s->part);
  const double *at = s->w->at[foot];
  if (end - begin < 1e-9) return;
  ambulo__text_append_format(s->text, "  - {foot: %s, mode: flat, from: ",
                             ambulo_model_foot(s->w->model, s->w->foot[foot])->name);
  exact(s, "", begin * s->time, ", to: ");
  exact(s, "", end * s->time, ", place: [");
  exact(s, "", stepped(at[0], 1e-4) + s->travel * middle, ", ");
  exact(s, "", stepped(at[1], 1e-4), "]}\n");
}

static void print_contacts(const stride *s) {
  ambulo__text_append_format(s->text,
                             "# a foot is down for %g of a stride; places are along forward and "
                             "left\ncontacts:\n",
                             s->gait->share);
  for (int foot = 0; foot < FEET; foot++)
    for (int before = 1; before >= 0; before--) {
      double from = s->gait->strike[foot] - before;
      print_contact(s, foot, from, from + s->gait->share);
    }
}

static void print_rows(const stride *s) {
  const ambulo__walker *w = s->w;
  double l = w->leg;
  line(s, "\nground_reaction:\n  kind: shared\n  slant: 1 # feet stand wide\n  loading_rate: ",
       6.4 * sqrt(w->gravity / l), " # body weights per second\n  friction: 0.6\n\n");
  line(s, "constraints:\n  contact_tolerance: ", 0.01 * l, "\n  clearance: {height: ");
  line(s, "", 0.12 * l, ", ceiling: ");
  line(s, "", 0.7 * l, ", outward: ");
  line(s, "", 0.2 * l, ", inward: ");
  line(s, "", 0.1 * l, "}\n  joint_limits: nodes\n");
  if (w->has_speed_limits) ambulo__text_append(s->text, "  speed_limits: true\n");
  if (w->has_torque_limits) ambulo__text_append(s->text, "  torque_limits: true\n");
  ambulo__text_append_format(s->text, "\nends: {kind: %s, order: 2, ",
                             s->part < 1.0 ? "mirrored" : "periodic");
  exact(s, "travel: ", s->part * s->travel, "}\n\n");
}

static void print_objective(const stride *s) {
  const ambulo__walker *w = s->w;
  double torque = w->mass * w->gravity * w->leg, time_squared = w->leg / w->gravity;
  line(s, "objective:\n  # small torques\n  - term: torque_squared\n    weight: ",
       60.0 / (torque * torque), " # 60 / (weight times leg)^2\n");
  ambulo__walk_sliders(w, w->leg, 0, s->text);
  ambulo__walk_posture(w, AMBULO__PART_ROOT,
                       "  # a trunk that stays as in the start pose\n  - term: posture\n"
                       "    name: trunk\n    weight: 1\n",
                       s->text);
  ambulo__walk_posture(w, AMBULO__PART_LEG,
                       "  # legs that stay near it\n  - term: posture\n    name: legs\n"
                       "    weight: 0.05\n",
                       s->text);
  ambulo__walk_posture(w, AMBULO__PART_REST,
                       "  # and so does what else moves\n  - term: posture\n    name: rest\n"
                       "    weight: 1\n",
                       s->text);
  line(s, "  # smooth motions\n  - term: acceleration\n    weight: ",
       0.0015 * time_squared * time_squared, " # 0.0015 (leg / gravity)^2\n");
  ambulo__walk_sliders(w, 1.0 / w->leg, 1, s->text);
}

void ambulo__walk_of_quadruped(const ambulo__walker *walker, const char *gait,
                               ambulo__text_buffer *text) {
  stride s = {.w = walker, .gait = find(gait), .text = text};
  double usual = s.gait->stride * sqrt(walker->leg / walker->gravity);
  double speed = s.gait->speed * sqrt(walker->gravity * walker->leg);
  if (walker->speed > 0.0) speed = walker->speed;
  if (walker->speed == 0.0 && walker->step > 0.0) speed = walker->step / usual;
  s.travel = walker->step > 0.0 ? walker->step : speed * usual;
  s.travel = stepped(s.travel, 2e-4);
  s.time = stepped(s.travel / speed, 2e-3);
  s.part = s.gait->mirrors && walker->symmetric ? 0.5 : 1.0;
  print_head(&s);
  print_contacts(&s);
  print_rows(&s);
  print_objective(&s);
}
