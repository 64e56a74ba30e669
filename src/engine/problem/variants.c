/* problem/variants.c - problems made from another one, and motions carried over.
 *
 * With an extension: terms, rows at the nodes. The extended problem is built anew from the
 * definition that the first one came to (its nodes, its contacts, its pairs of capsules), with the
 * additions behind, and shares its model.
 *
 * On another grid: coarser ones start a continuation (knot insertion), finer ones audit what lies
 * between the nodes. */
#include "ambulo/extend.h"
#include "base/arithmetic.h"
#include "contact/schedule.h"
#include "muscle/muscles.h"
#include "problem/definition.h"
#include "problem/nlp.h"

#include <math.h>
#include <string.h>

static int is_there(const void *array, int count) {
  return count == 0 || (count > 0 && array);
}

/* copies `count` items behind the `own` ones; NULL without memory */
static void *joined(const ambulo_allocator *a, size_t size, const void *first, int own,
                    const void *second, int count) {
  char *both = ambulo__alloc(a, (size_t)own + (size_t)count, size);
  if (both && own > 0) memcpy(both, first, (size_t)own * size);
  if (both && count > 0) memcpy(both + (size_t)own * size, second, (size_t)count * size);
  return both;
}

static ambulo_status extend(const ambulo_problem *p, const ambulo_problem_definition *e,
                            const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                            ambulo_problem **extended) {
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo_problem_definition d = p->definition;
  ambulo_term *terms = joined(&a, sizeof *terms, d.terms, d.term_count, e->terms, e->term_count);
  ambulo_user_row *rows =
      joined(&a, sizeof *rows, d.user_rows, d.user_row_count, e->user_rows, e->user_row_count);
  ambulo_status status = AMBULO_E_MEMORY;
  if (terms && rows) {
    d.terms = terms;
    d.term_count += e->term_count;
    d.user_rows = rows;
    d.user_row_count += e->user_row_count;
    status = ambulo_problem_create(&d, allocator, diagnostics, extended);
  }
  ambulo__free(&a, terms);
  ambulo__free(&a, rows);
  if (status) return status;
  (*extended)->extends = p;
  (*extended)->file_options = p->file_options;
  (*extended)->keys = p->keys;
  return AMBULO_OK;
}

ambulo_status ambulo_problem_extend(const ambulo_problem *problem,
                                    const ambulo_extension *extension,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo_problem **extended) {
  if (!problem || !extension || !extended) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__taken_definition own;
  const ambulo_problem_definition *d = &own.definition;
  ambulo_status status = ambulo__extension_take(extension, allocator, &own);
  if (!status && (!is_there(d->terms, d->term_count) || !is_there(d->user_rows, d->user_row_count)))
    status = AMBULO_E_ARGUMENT;
  int is_legal = status != AMBULO_E_ARGUMENT;
  if (!status) status = extend(problem, d, allocator, diagnostics, extended);
  ambulo__definition_drop(&own);
  if (!is_legal) return status;
  return ambulo__conclude(diagnostics, errors, status, NULL);
}

/* ------------------------------------------------------------------ another grid */

/* reference [count][width] at given times from that at the problem's nodes, linear in between; next
 * to a gap there is a gap */
static void resample(const ambulo_problem *p, const double *source, size_t width,
                     const double *times, int count, double *target) {
  for (int k = 0; k < count; k++) {
    double part;
    size_t left = (size_t)ambulo__node_at(p, times[k], &part);
    for (size_t i = 0; i < width; i++) {
      double a = source[left * width + i], b = source[(left + 1) * width + i];
      target[(size_t)k * width + i] = part == 0.0 ? a : part == 1.0 ? b : a + part * (b - a);
    }
  }
}

static ambulo_status resample_terms(const ambulo_problem *p, int intervals, const double *times,
                                    ambulo_term *terms, double **references) {
  const ambulo_problem_definition *d = &p->definition;
  size_t nodes = (size_t)intervals + 1, size = 0, width = 0;
  for (int t = 0; t < d->term_count; t++) {
    terms[t] = d->terms[t];
    if (ambulo__term_reference(&terms[t], p->model, &width)) size += nodes * width;
  }
  *references = ambulo__alloc(&p->allocator, size, sizeof(double));
  if (!*references) return AMBULO_E_MEMORY;
  double *next = *references;
  for (int t = 0; t < d->term_count; t++) {
    const double **followed = ambulo__term_reference(&terms[t], p->model, &width);
    if (!followed) continue;
    resample(p, *followed, width, times, intervals + 1, next);
    *followed = next;
    next += nodes * width;
  }
  return AMBULO_OK;
}

ambulo_status ambulo__problem_with_grid(const ambulo_problem *p, int intervals,
                                        int spline_intervals, const ambulo_allocator *allocator,
                                        ambulo_problem **out) {
  ambulo_problem_definition d = p->definition;
  double *references = NULL, *times = NULL;
  int own =
      p->definition.spline_intervals ? p->definition.spline_intervals : p->definition.intervals;
  ambulo_term *terms = ambulo__alloc(&p->allocator, (size_t)d.term_count, sizeof *terms);
  times = ambulo__alloc(&p->allocator, (size_t)intervals + 1, sizeof *times);
  ambulo_status status = terms && times ? AMBULO_OK : AMBULO_E_MEMORY;
  if (intervals != d.intervals) d.node_times = NULL;
  d.intervals = intervals;
  if (!status) status = ambulo__node_times(&d, &p->allocator, NULL, times);
  if (!status) status = resample_terms(p, intervals, times, terms, &references);
  if (!status) {
    d.spline_intervals = spline_intervals;
    if (spline_intervals != own) d.breakpoints = NULL;
    d.terms = terms;
    status = ambulo_problem_create(&d, allocator, NULL, out);
    if (!status) (*out)->file_options = p->file_options;
  }
  ambulo__free(&p->allocator, references);
  ambulo__free(&p->allocator, times);
  ambulo__free(&p->allocator, terms);
  return status;
}

/* Muscles give way to squared torques: muscles that could push as well as pull, at q = 0, each
 * torque by itself. With weights w = F l_o / V a torque costs at the least
 *
 *     tau^2 / sum (r F)^2 / w = tau^2 / (V sum F r^2 / l_o)
 *
 * As half of the muscles can pull the one way, V counts half. The cost has one valley where that of
 * muscles has many. */
static void ease(const ambulo_problem_definition *d, double *scale, ambulo_term *term) {
  const ambulo_muscles *m = d->muscles;
  double price = term->activation + term->metabolic;
  for (int l = 0; l < m->limb_count; l++)
    for (int j = 0; j < m->limbs[l].coordinate_count; j++) {
      double leverage = 0.5 * m->volume * m->limbs[l].leverage[j];
      if (leverage > 0.0) scale[m->limbs[l].coordinates[j]] = sqrt(price / leverage);
    }
  ambulo_term eased = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  eased.name = term->name;
  eased.weight = term->weight;
  eased.scale = scale;
  *term = eased;
}

ambulo_status ambulo__problem_coarser(const ambulo_problem *p, int intervals, int spline_intervals,
                                      const ambulo_allocator *allocator, ambulo_problem **out) {
  const ambulo_problem_definition *d = &p->definition;
  ambulo_problem eased = *p;
  ambulo_term *terms = ambulo__alloc(&p->allocator, (size_t)d->term_count, sizeof *terms);
  double *scale = ambulo__alloc(&p->allocator, (size_t)p->coordinates, sizeof *scale);
  ambulo_status status = terms && scale ? AMBULO_OK : AMBULO_E_MEMORY;
  for (int t = 0; !status && t < d->term_count; t++) {
    terms[t] = d->terms[t];
    if (terms[t].kind == AMBULO_MUSCLE_EFFORT) ease(d, scale, &terms[t]);
  }
  eased.definition.terms = terms;
  if (!status)
    status = ambulo__problem_with_grid(&eased, intervals, spline_intervals, allocator, out);
  ambulo__free(&p->allocator, scale);
  ambulo__free(&p->allocator, terms);
  return status;
}

ambulo_status ambulo_problem_transfer(const ambulo_problem *from, const double *x_from,
                                      const ambulo_problem *to, double *x_to) {
  if (!from || !x_from || !to || !x_to) return AMBULO_E_ARGUMENT;
  if (from->coordinates != to->coordinates) return AMBULO_E_ARGUMENT;
  if (fabs(from->definition.duration - to->definition.duration) > AMBULO__INSTANT)
    return AMBULO_E_ARGUMENT;
  return ambulo__basis_transfer(from->basis, x_from, to->basis, x_to, to->coordinates,
                                &to->allocator);
}

/* ------------------------------------------------------------------------- start */

/* The motion that a solve begins at: at rest, all coordinates at their
 * defaults.
 *
 * Weights of values sum to one in every basis, so that control points which stand for values are
 * the pose itself, and those which stand for rates (Hermite) are zero.
 */

void ambulo__start_pose(const ambulo_problem *p, double *x) {
  for (int c = 0; c < p->control_points; c++) {
    int is_value;
    (void)ambulo__basis_abscissa(p->basis, c, &is_value);
    for (int i = 0; i < p->coordinates; i++)
      x[c * p->coordinates + i] = is_value ? p->model->coordinates[i].default_value : 0.0;
  }
}
