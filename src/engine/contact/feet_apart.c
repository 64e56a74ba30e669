/* contact/feet_apart.c - a foot in the air passes beside the others ("clearance").
 *
 * Seen from above, a foot is what is within half its largest width w of the line from its heel
 * centre to its toe centre: about the sole, whose tip is narrower. While one of two feet is in the
 * air, they keep a gap,
 *
 *     heel and toe centre of either at least D = w_1 + w_2 + feet + m from the line of the other m
 *
 * (contact/apart.h). Lines that do not cross are nearest at an end of one of them: these four rows
 * are the whole distance, and each is smooth where the least of all is not, for feet that pass are
 * next to parallel. Seen from above, since over a foot there is its leg: also where feet are on
 * steps of unlike height they have to pass beside each other.
 *
 * Lines at an angle a that pass at the speed v come nearer between two nodes than at them, by
 * v h tan(a / 2) / 2 where a corner falls in the middle. That is m, with a = .2 rad, v = 5 m/s (a
 * walk's peaks, of 1.75 m; v goes with the root of the stature) and h = T / N; on a fine grid it
 * vanishes, and what is then missed it shows.
 */
#include "contact/bounded.h"
#include "contact/foot_outline.h"

#include <math.h>

static const double passing = 0.25; /* v tan(a / 2) / 2, m/s */

/* m */
static double half_width(const ambulo__foot_outline *outline) {
  double half = 0.0;
  for (int c = 0; c < outline->count; c++) half = fmax(half, fabs(outline->place[c][1]));
  return half;
}

double ambulo__passing_allowance(const ambulo_problem_definition *d) {
  return passing * sqrt(ambulo__model_size(d->model)) * d->duration / d->intervals;
}

/* D; 0 of feet that move in one plane */
static double distance(const ambulo__gait_context *context, int foot, int other) {
  ambulo__foot_outline one = ambulo__foot_outline_of(context->model, foot);
  ambulo__foot_outline two = ambulo__foot_outline_of(context->model, other);
  if (!one.moves_sideways || !two.moves_sideways) return 0.0;
  return half_width(&one) + half_width(&two) + context->definition->clearance.feet +
         ambulo__passing_allowance(context->definition);
}

/* 1 if a foot is in the air at a node, or comes there or leaves there; *before: until it */
static int is_in_the_air(const ambulo__gait_context *context, int node, int foot, int *before) {
  int found = 0;
  ambulo__phases_of_foot phases = ambulo__phases_at(context, AMBULO__OF_PLACES, node, foot);
  for (int i = 0; i < phases.count; i++) {
    if (phases.contact[i] >= 0) continue;
    *before = ambulo__phase_is_before(context, i);
    found = 1;
  }
  return found;
}

/* both ends of `foot` from the line of `other` */
static void end_rows(const ambulo__gait_context *context, int node, int foot, int other,
                     double apart, ambulo__row_table *table) {
  const ambulo_model *m = context->model;
  const ambulo_foot *line = &m->feet[other];
  int end[2] = {m->feet[foot].heel_center, m->feet[foot].toe_center};
  ambulo__apart row = {.distance = apart,
                       .from = ambulo__channel_point(&context->channels, line->heel_center, 0),
                       .to = ambulo__channel_point(&context->channels, line->toe_center, 0)};
  for (int i = 0; i < 3; i++) row.up[i] = m->up[i];
  for (int i = 0; i < 2; i++) {
    row.point = ambulo__channel_point(&context->channels, end[i], 0);
    ambulo__row_apart(table, AMBULO__KIND_CLEARANCE, m->points[end[i]].name, "near the other foot",
                      node, context->times[node], &row);
  }
}

static void pair_rows(const ambulo__gait_context *context, int foot, int other,
                      ambulo__row_table *table) {
  double apart = distance(context, foot, other);
  for (int node = 0; node < context->nodes && apart > 0.0; node++) {
    int before = 0;
    if (!is_in_the_air(context, node, foot, &before) &&
        !is_in_the_air(context, node, other, &before))
      continue;
    table->before = before;
    end_rows(context, node, foot, other, apart, table);
    end_rows(context, node, other, foot, apart, table);
  }
  table->before = 0;
}

/* (14.g) of every pair of feet */
void ambulo__feet_apart_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  if (isnan(context->definition->clearance.feet)) return;
  for (int foot = 0; foot < context->model->foot_count; foot++)
    for (int other = foot + 1; other < context->model->foot_count; other++)
      pair_rows(context, foot, other, table);
}
