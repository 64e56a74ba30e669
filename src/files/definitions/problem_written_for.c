/* definitions/problem_written_for.c - `written_for` of a problem file: the body its numbers are
 * for.
 *
 * Bodies of one shape walk alike at one speed number v / sqrt(g H) if all that a walk is made of
 * is alike in units of the body: length H, time sqrt(H / g), mass M. A file says its numbers for
 * one body, in SI; for a subject H' = longer H, M' = heavier M they become
 *
 *     lengths (tolerances, clearance, pressure, moment arm, free moment, step width)  longer
 *     loading rate, 1/s                                        1 / sqrt(longer)
 *     scale of a torque, 1 / N m                               1 / (heavier longer)
 *     scale of a force, 1 / N                                  1 / heavier
 *     torques and forces (offset, passive, strength)           their inverses
 *     rate of a torque, scale in s / N m                       sqrt(longer) / (heavier longer)
 *     turning acceleration, scale in s^2                       longer; of a translation as it is
 *     mechanical power, scale in kg / W                        1 / sqrt(longer)
 *     tendon, N m/rad; of a translation, N/m                   heavier longer; heavier / longer
 *     rate of a force, weight in s^2 by its square             longer
 *     rest of a translation, m; its scale, 1/m                 longer; 1 / longer
 *
 * Left as they are: angles, ratios, forces in body weights, prices (strength: limits), and the
 * task: speed, lengths and times of steps, contacts, ground, load, ends, tubes, references.
 * Integrals over time come out sqrt(longer) times as large, all alike.
 */
#include "definitions/problem_reader.h"
#include "problem/term.h"

#include <math.h>

void ambulo__read_written_for(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  ambulo__problem_keys *keys = &reader->keys;
  keys->longer = keys->heavier = 1.0;
  const ambulo__yaml_node *section = ambulo__reader_section(root, "written_for");
  if (!section) return;
  double mass = ambulo__yaml_number_in(ambulo__yaml_require(section, "mass"), 1.0, 1000.0, 0.0);
  double stature = ambulo__yaml_number_in(ambulo__yaml_require(section, "stature"), 0.3, 3.0, 0.0);
  ambulo__yaml_close(section);
  if (!reader->model || !(mass > 0.0) || !(stature > 0.0)) return;
  double subject_mass = reader->model->units.mass;
  double subject_stature = ambulo_model_stature(reader->model);
  if (!(subject_stature > 0.0) || subject_mass == 1.0 || !(subject_mass > 0.0)) {
    (void)ambulo__yaml_error(section, AMBULO_E_PROBLEM, NULL,
                             "'written_for' with a model that has its own size; expected one whose "
                             "units are those of a subject");
    return;
  }
  keys->written_for = 1;
  keys->longer = subject_stature / stature;
  keys->heavier = subject_mass / mass;
}

static void scale_gaps(ambulo_problem_definition *d, double longer) {
  ambulo_clearance *c = &d->clearance;
  ambulo_ground_reaction *r = &d->ground_reaction;
  double *lengths[] = {&d->contact_tolerance,
                       &d->support_margin,
                       &c->height,
                       &c->ceiling,
                       &c->outward,
                       &c->inward,
                       &c->feet,
                       &d->collision.margin,
                       &r->moment_arm,
                       &r->free_moment,
                       &r->heel_pressure[0],
                       &r->heel_pressure[1],
                       &r->heel_roll,
                       &r->flat_pressure[0],
                       &r->flat_pressure[1],
                       &r->toe_pressure[0],
                       &r->toe_pressure[1],
                       &r->pressure_width,
                       &r->arc_pressure};
  for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) *lengths[i] *= longer;
  r->loading_rate /= sqrt(longer); /* NaN, which says off, stays so */
}

/* what one coordinate's scale and offset are multiplied by */
typedef struct factors {
  double scale, offset;
} factors;

static factors factors_of(const ambulo_term *term, int turns, double longer, double heavier) {
  double force = turns ? heavier * longer : heavier, place = turns ? 1.0 : longer;
  int is_price = term->strength_is_limits || term->strength;
  switch (ambulo__term_info_of(term->kind)->subject) {
  case AMBULO__TERM_OF_TORQUE:
    return (factors){is_price ? 1.0 : 1.0 / force, force};
  case AMBULO__TERM_OF_TORQUE_RATE:
    return (factors){sqrt(longer) / force, 1.0};
  case AMBULO__TERM_OF_POWER:
    return (factors){1.0 / sqrt(longer), 1.0};
  case AMBULO__TERM_OF_ACCELERATION:
    return (factors){turns ? longer : 1.0, 1.0};
  case AMBULO__TERM_OF_POSITION:
    return (factors){1.0 / place, place};
  case AMBULO__TERM_OF_OTHERS: /* a device is what it is, whoever wears it */
    break;
  }
  return (factors){1.0, 1.0};
}

/* count blocks of `stride` numbers, of which the first is a torque */
static const double *scaled_peaks(ambulo__problem_reader *reader, const double *peaks, int count,
                                  int stride, double factor) {
  if (!peaks) return NULL;
  double *scaled = ambulo__reader_alloc(reader, (size_t)(count * stride), sizeof *scaled);
  for (int i = 0; scaled && i < count * stride; i++)
    scaled[i] = peaks[i] * (i % stride ? 1.0 : factor);
  return scaled;
}

static const double *scaled_tendons(ambulo__problem_reader *reader, const double *tendon) {
  if (!tendon) return NULL;
  double longer = reader->keys.longer, heavier = reader->keys.heavier;
  int count = ambulo_model_coordinate_count(reader->model);
  double *scaled = ambulo__reader_alloc(reader, (size_t)count, sizeof *scaled);
  for (int i = 0; scaled && i < count; i++) {
    int turns = ambulo_model_coordinate(reader->model, i)->type == AMBULO_REVOLUTE;
    scaled[i] = tendon[i] * (turns ? heavier * longer : heavier / longer);
  }
  return scaled;
}

static void scale_term(ambulo__problem_reader *reader, ambulo_term *term) {
  double longer = reader->keys.longer, heavier = reader->keys.heavier;
  int count = ambulo_model_coordinate_count(reader->model);
  double *scale = ambulo__reader_alloc(reader, (size_t)count, sizeof *scale);
  double *offset = ambulo__reader_alloc(reader, (size_t)count, sizeof *offset);
  if (!scale || !offset) return;
  for (int i = 0; i < count; i++) {
    int turns = ambulo_model_coordinate(reader->model, i)->type == AMBULO_REVOLUTE;
    factors by = factors_of(term, turns, longer, heavier);
    scale[i] = by.scale * (term->scale ? term->scale[i] : 1.0);
    if (term->offset) offset[i] = by.offset * term->offset[i];
  }
  if (term->scale) term->scale = scale;
  if (term->offset) term->offset = offset;
  term->passive = scaled_peaks(reader, term->passive, 2 * count, 2, heavier * longer);
  term->strength = scaled_peaks(reader, term->strength, 2 * count, 3, heavier * longer);
  term->tendon = scaled_tendons(reader, term->tendon);
  if (ambulo__term_info_of(term->kind)->weight_is_length) term->weight *= longer;
  if (ambulo__term_has(term, AMBULO__TERM_HEIGHT)) term->height *= longer;
}

void ambulo__scale_to_subject(ambulo__problem_reader *reader) {
  ambulo_problem_definition *d = &reader->definition;
  if (!reader->keys.written_for) return;
  scale_gaps(d, reader->keys.longer);
  ambulo_term *terms = ambulo__reader_alloc(reader, (size_t)d->term_count, sizeof *terms);
  if (!terms) return;
  for (int t = 0; t < d->term_count; t++) {
    terms[t] = d->terms[t];
    scale_term(reader, &terms[t]);
  }
  d->terms = terms;
}
