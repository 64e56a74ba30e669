/* people/plausibility.c - doubts about a motion and its forces (plausibility.h). */
#include "people/inverse.h"

#include "formats/motion_file.h"
#include "model/model.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

void ambulo__doubt(ambulo__doubts *doubts, const char *file, const char *hint, const char *format,
                   ...) {
  char text[1024] = "";
  ambulo__place place = {.file = file};
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  doubts->count++;
  if (doubts->strict) {
    (void)ambulo__error(doubts->diagnostics, AMBULO_E_SCHEMA, place, hint, "%s", text);
  } else {
    ambulo__warning(doubts->diagnostics, place, hint, "%s", text);
  }
}

void ambulo__doubt_header(ambulo__doubts *doubts, const char *file, const ambulo__motion *table) {
  if (table->declared_columns < 0 || table->declared_columns == table->columns + 1) return;
  ambulo__doubt(doubts, file, NULL, "%d columns; the header says %d (nColumns)", table->columns + 1,
                table->declared_columns);
}

ambulo_status ambulo__doubts_status(const ambulo__doubts *doubts) {
  return doubts->strict && doubts->count > 0 ? AMBULO_E_SCHEMA : AMBULO_OK;
}

/* what hardly can be meant: doubts about a motion and its forces
 * (inverse.h). Each names the option that mends it. */

static const double slow_rows = 0.5;          /* s: no motion is recorded at so few rows a second */
static const double fastest_angle = 200.0;    /* rad/s; a pitcher's shoulder reaches 160 */
static const double fastest_length = 50.0;    /* m/s */
static const double disagreement = 0.25;      /* of a rate, as a share of its size */
static const double rough_disagreement = 0.9; /* of an acceleration: few rows tell little of it */
static const double loaded = 0.1;             /* body weights: a foot whose point is looked at */
static const double far_away = 0.5;           /* m from the middle of the foot */
static const double lightest = 0.3, heaviest = 3.0; /* bodies that could be meant, of the model's */
static const double large_residual = 0.1;           /* body weights, body weights m */

static double cell(const ambulo__inverse *v, const double *values, int row, int i) {
  return values[(size_t)row * (size_t)v->model->coordinate_count + (size_t)i];
}

static int is_angle(const ambulo__inverse *v, int i) {
  return v->model->coordinates[i].type == AMBULO_REVOLUTE;
}

/* -------------------------------------------------------------------- units */

/* one of the two kinds of coordinates: the first value beyond what is plausible */
static void doubt_values(ambulo__inverse *v, int angles) {
  for (int i = 0; i < v->model->coordinate_count; i++) {
    const ambulo_coordinate *c = &v->model->coordinates[i];
    double bound = ambulo__largest_plausible(c);
    if (is_angle(v, i) != angles) continue;
    for (int k = 0; k < v->rows; k++) {
      double value = cell(v, v->q, k, i);
      if (fabs(value) <= bound) continue;
      const char *unit = angles ? "rad" : "m";
      ambulo__doubt(&v->doubts, v->file,
                    angles ? "angles in degrees: --angles degrees"
                           : "lengths in millimetres: --lengths mm",
                    "'%s' is at %g %s at t = %g s; its range is %g to %g %s", c->name, value, unit,
                    v->given->time[k], c->range[0], c->range[1], unit);
      return;
    }
  }
}

void ambulo__doubt_units(ambulo__inverse *v) {
  const double *time = v->given->time;
  double step = v->rows > 1 ? (time[v->rows - 1] - time[0]) / (double)(v->rows - 1) : 0.0;
  doubt_values(v, 1);
  doubt_values(v, 0);
  if (step >= slow_rows)
    ambulo__doubt(&v->doubts, v->file, "times in milliseconds: --time ms",
                  "the rows are %g s apart; rates and accelerations from so few are no motion's",
                  step);
}

static void doubt_speeds(ambulo__inverse *v, int angles) {
  double fastest = angles ? fastest_angle : fastest_length;
  for (int i = 0; i < v->model->coordinate_count; i++) {
    if (is_angle(v, i) != angles) continue;
    for (int k = 0; k < v->rows; k++) {
      double value = cell(v, v->qd, k, i);
      if (fabs(value) <= fastest) continue;
      ambulo__doubt(&v->doubts, v->file,
                    angles ? "angles in degrees: --angles degrees"
                           : "lengths in millimetres: --lengths mm",
                    "'%s' moves at %g %s at t = %g s", v->model->coordinates[i].name, value,
                    angles ? "rad/s" : "m/s", v->given->time[k]);
      return;
    }
  }
}

/* root mean square of a column, or of the difference to another one */
static double rms(const ambulo__inverse *v, const double *a, const double *b, int i) {
  double sum = 0.0;
  for (int k = 0; k < v->rows; k++) {
    double value = cell(v, a, k, i) - (b ? cell(v, b, k, i) : 0.0);
    sum += value * value;
  }
  return sqrt(sum / (double)v->rows);
}

typedef struct slopes {
  const double *given, *spline; /* [rows][d] */
  const unsigned char *has;     /* [d]: given by the file */
  double share;                 /* of its size that may differ */
  const char *what, *of, *unit; /* "rate", "values", "/s" */
} slopes;

/* what the file gives against the slopes of what it gives before */
static void doubt_slopes(ambulo__inverse *v, const slopes *s) {
  double largest[2] = {0.0, 0.0};
  for (int i = 0; i < v->model->coordinate_count; i++)
    largest[is_angle(v, i)] = fmax(largest[is_angle(v, i)], rms(v, s->spline, NULL, i));
  for (int i = 0; i < v->model->coordinate_count; i++) {
    if (!s->has[i]) continue;
    double size = fmax(rms(v, s->spline, NULL, i), disagreement * largest[is_angle(v, i)]);
    double off = rms(v, s->given, s->spline, i);
    if (off <= s->share * size) continue;
    ambulo__doubt(&v->doubts, v->file,
                  "--derivatives spline computes rates and accelerations from the values",
                  "the %s of '%s' differs from the slope of its %s by %g of %g %s%s (rms)", s->what,
                  v->model->coordinates[i].name, s->of, off, rms(v, s->spline, NULL, i),
                  is_angle(v, i) ? "rad" : "m", s->unit);
    return;
  }
}

void ambulo__doubt_rates(ambulo__inverse *v, const double *of_values, const double *of_rates) {
  slopes rates = {v->qd, of_values, v->has_rate, disagreement, "rate", "values", "/s"};
  slopes accelerations = {
      v->qdd, of_rates, v->has_acceleration, rough_disagreement, "acceleration", "rates", "/s^2"};
  /* ambulo's own are exact, however few the rows */
  if (of_values && !isfinite(v->given->body_mass)) {
    doubt_slopes(v, &rates);
    doubt_slopes(v, &accelerations);
  }
  doubt_speeds(v, 1);
  doubt_speeds(v, 0);
}

/* --------------------------------------------------------------------- body */

void ambulo__doubt_body(ambulo__doubts *doubts, const char *file, const ambulo__motion *m,
                        const ambulo_model *model) {
  if (!isfinite(m->body_mass)) return;
  if (fabs(m->body_mass - model->mass) > 1e-6 * model->mass)
    ambulo__doubt(doubts, file,
                  "name the problem it was solved from in place of the model, or --mass",
                  "it is the motion of a body of %g kg; '%s' has %g kg", m->body_mass, model->name,
                  model->mass);
  double off = 0.0, size = 0.0;
  for (int i = 0; i < 3; i++) {
    off = fmax(off, fabs(m->gravity[i] - model->gravity[i]));
    size = fmax(size, fabs(model->gravity[i]));
  }
  if (off > 1e-6 * size)
    ambulo__doubt(doubts, file,
                  "name the problem it was solved from in place of the model, or --slope",
                  "it is the motion of a body under gravity %g %g %g m/s^2; '%s' has %g %g %g",
                  m->gravity[0], m->gravity[1], m->gravity[2], model->name, model->gravity[0],
                  model->gravity[1], model->gravity[2]);
}

/* -------------------------------------------------------------------- loads */

/* mean distance of a foot's centre of pressure from the middle of another foot, weighted by force;
 * negative: it is never loaded */
static double distance(const ambulo__inverse *v, int foot, int other, double weight) {
  double sum = 0.0, total = 0.0;
  size_t feet = (size_t)v->load.feet;
  for (size_t k = 0; k < (size_t)v->rows; k++) {
    size_t own = 3 * (k * feet + (size_t)foot), its = 3 * (k * feet + (size_t)other);
    double normal = 0.0, apart = 0.0;
    for (size_t i = 0; i < 3; i++) normal += v->load.force[own + i] * v->model->up[i];
    if (normal < loaded * weight) continue;
    for (size_t i = 0; i < 3; i++) {
      double along = v->cop[own + i] - v->poses.foot[its + i];
      apart += along * along;
    }
    sum += normal * sqrt(apart);
    total += normal;
  }
  return total > 0.0 ? sum / total : -1.0;
}

static void doubt_places(ambulo__inverse *v, const char *forces, double weight) {
  for (int foot = 0; foot < v->load.feet; foot++) {
    const char *name = v->model->feet[foot].name;
    double own = distance(v, foot, foot, weight);
    if (v->load.is_loose[foot] || own <= far_away) continue;
    int nearest = foot;
    double least = own;
    for (int other = 0; other < v->load.feet; other++) {
      double there = distance(v, foot, other, weight);
      if (there >= least) continue;
      least = there;
      nearest = other;
    }
    if (least < 0.5 * own && least <= far_away) {
      ambulo__doubt(&v->doubts, forces, "--force-columns says which columns belong to which foot",
                    "the forces on foot '%s' act %.2f m from it and %.2f m from foot '%s' (mean)",
                    name, own, least, v->model->feet[nearest].name);
    } else {
      ambulo__doubt(&v->doubts, forces,
                    own > 20.0 ? "points in millimetres: --grf-lengths mm"
                               : "forces and motion need the same axes and origin",
                    "the forces on foot '%s' act %.2f m from it (mean)", name, own);
    }
    return;
  }
}

static void doubt_residual(ambulo__inverse *v, const char *forces,
                           const ambulo_ground_residual *r) {
  double force = sqrt(r->force_rms[0] * r->force_rms[0] + r->force_rms[1] * r->force_rms[1] +
                      r->force_rms[2] * r->force_rms[2]);
  double ratio = r->given_vertical_impulse / r->vertical_impulse;
  int heavy = fabs(ratio - 1.0) > 0.05 && ratio > lightest && ratio < heaviest;
  char hint[160];
  if (force <= large_residual && !(r->moment_rms > large_residual)) return;
  if (heavy) {
    (void)snprintf(hint, sizeof hint,
                   "a body of %.1f kg would need their vertical impulse: --mass, --grf-time",
                   v->model->mass * ratio);
  } else {
    (void)snprintf(
        hint, sizeof hint,
        ratio > lightest && ratio < heaviest
            ? "--force-columns, --grf-lengths, --grf-time, --slope; or the axes of the file"
            : "--force-columns, --grf-time; or the axes, signs and units (N) of the file");
  }
  if (isfinite(r->moment_rms)) {
    ambulo__doubt(&v->doubts, forces, hint,
                  "the forces leave over %.3f body weights and %.3f body weights m at the root "
                  "(rms); expected less than %g",
                  force, r->moment_rms, large_residual);
  } else {
    ambulo__doubt(
        &v->doubts, forces, hint,
        "the forces leave over %.3f body weights at the root (rms); expected less than %g", force,
        large_residual);
  }
}

void ambulo__doubt_loads(ambulo__inverse *v, const char *forces,
                         const ambulo_ground_residual *residual) {
  doubt_places(v, forces, ambulo__model_weight(v->model));
  if (!v->options.other_forces) doubt_residual(v, forces, residual);
}
