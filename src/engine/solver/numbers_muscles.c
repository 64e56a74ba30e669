/* solver/numbers_muscles.c - numbers of muscles by their keys, muscles.soleus_r.force, and the
 * muscles that a variant has.
 *
 * They are listed where the objective has the term muscle_effort, which alone depends on them: at
 * the same q, qd, tau and tau', another least cost of the sharing. With mirrored ends a muscle
 * moves together with its mirror image; without, each side has numbers of its own.
 *
 * Muscles grow with the body as those of a file do (definitions/muscle_file.c): with the masses m,
 * loads apart, forces are multiplied by (m / m)^(2/3), and lengths, paths among them, as lengths of
 * the model are. Numbers that have been moved, or that the problem's file gives, stay.
 */
#include "solver/sensitivity.h"

#include "model/conditions.h"
#include "muscle/muscles.h"
#include "problem/muscle_effort.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

static const struct {
  const char *key, *label;
  ambulo__quantity quantity;
  size_t at;
  double low, high; /* what a file may say */
  int fixed;
} numbers[] = {
    {"force", "isometric force", AMBULO__RATIO, offsetof(ambulo_muscle, force), 1e-6, 1e6,
     AMBULO__FIXED_FORCE},
    {"fiber", "optimal fibre length", AMBULO__SHORT_LENGTH, offsetof(ambulo_muscle, fiber), 1e-6,
     2.0, AMBULO__FIXED_FIBER},
    {"tendon", "slack length of the tendon", AMBULO__SHORT_LENGTH, offsetof(ambulo_muscle, tendon),
     0.0, 2.0, AMBULO__FIXED_TENDON},
};
enum { NUMBERS = sizeof numbers / sizeof *numbers };

static double *number_of(ambulo_muscle *m, int k) {
  return (double *)(void *)((char *)m + numbers[k].at);
}

/* -------------------------------------------------------------------- variant */

ambulo_status ambulo__variant_take_muscles(ambulo__variant *v) {
  const ambulo_muscles *own = v->origin->definition.muscles;
  if (!own) return AMBULO_OK;
  v->muscles = ambulo__alloc(&v->allocator, (size_t)own->count, sizeof *v->muscles);
  if (!v->muscles) return AMBULO_E_MEMORY;
  memcpy(v->muscles, own->muscles, (size_t)own->count * sizeof *v->muscles);
  return AMBULO_OK;
}

/* how much longer and stronger the muscles of another body are */
typedef struct growth {
  double length, force;
} growth;

static growth growth_of(const ambulo_model *before, const ambulo_model *now) {
  double mass = before->mass - ambulo__model_load_mass(before);
  growth g = {1.0, 1.0};
  if (now == before) return g;
  if (before->units.length > 0.0) g.length = now->units.length / before->units.length;
  if (mass > 0.0) g.force = pow((now->mass - ambulo__model_load_mass(now)) / mass, 2.0 / 3.0);
  return g;
}

/* *fixed: those that stay */
static void grow(const ambulo_muscle *own, const growth *g, ambulo_muscle *m,
                 unsigned char *fixed) {
  ambulo_muscle was = *own;
  for (int k = 0; k < NUMBERS; k++) {
    double *number = number_of(m, k);
    if (*number != *number_of(&was, k)) *fixed |= (unsigned char)numbers[k].fixed;
    if (!(*fixed & numbers[k].fixed)) *number *= k == 0 ? g->force : g->length;
  }
}

ambulo_status ambulo__variant_muscles(const ambulo__variant *v, const ambulo_model *model,
                                      ambulo_diagnostics *diagnostics, ambulo_muscles **muscles) {
  const ambulo_muscles *own = v->origin->definition.muscles;
  *muscles = NULL;
  if (!own) return AMBULO_OK;
  size_t count = (size_t)own->count, terms = 0;
  for (size_t i = 0; i < count; i++) terms += (size_t)own->muscles[i].term_count;
  ambulo_muscle *list = ambulo__alloc(&v->allocator, count, sizeof *list);
  double *lengths = ambulo__alloc(&v->allocator, terms, sizeof *lengths), *next = lengths;
  unsigned char *fixed = ambulo__alloc(&v->allocator, count, sizeof *fixed);
  ambulo_status status = list && lengths && fixed ? AMBULO_OK : AMBULO_E_MEMORY;
  growth g = growth_of(v->origin->model, model);
  for (size_t i = 0; i < count && !status; i++) {
    list[i] = v->muscles[i];
    fixed[i] = own->fixed[i];
    grow(&own->muscles[i], &g, &list[i], &fixed[i]);
    for (int t = 0; t < list[i].term_count; t++) next[t] = g.length * list[i].length[t];
    list[i].length = next;
    next += list[i].term_count;
  }
  ambulo_muscles_definition d = ambulo_muscles_definition_default();
  d.name = own->name;
  d.source = own->source;
  d.muscles = list;
  d.muscle_count = own->count;
  if (!status) status = ambulo__muscles_build(model, &d, NULL, &v->allocator, diagnostics, muscles);
  if (!status) memcpy((*muscles)->fixed, fixed, count * sizeof *fixed);
  ambulo__free(&v->allocator, list);
  ambulo__free(&v->allocator, lengths);
  ambulo__free(&v->allocator, fixed);
  return status;
}

ambulo_status ambulo__variant_term_value(const ambulo__variant *v, ambulo_workspace *w,
                                         const ambulo_term *term, double *value) {
  ambulo_muscles *muscles = NULL;
  ambulo__share *share = NULL;
  ambulo_status status = AMBULO_OK;
  *value = (double)NAN;
  if (term->kind == AMBULO_MUSCLE_EFFORT) {
    status = ambulo__variant_muscles(v, v->origin->model, NULL, &muscles);
    if (status) return status == AMBULO_E_MEMORY ? status : AMBULO_OK;
    share = w->muscles->share;
    share->muscles = muscles;
  }
  *value = term->weight * ambulo__term_value(w, term, 0.0, w->term_slope);
  if (share) share->muscles = v->origin->definition.muscles;
  ambulo_muscles_free(muscles);
  return AMBULO_OK;
}

/* ----------------------------------------------------------------------- list */

static void add_muscle(ambulo__parameters *p, int i, int image) {
  ambulo_muscle *m = &p->variant.muscles[i], *other = &p->variant.muscles[image];
  char label[AMBULO__PARAMETER_TEXT];
  for (int k = 0; k < NUMBERS; k++) {
    (void)snprintf(label, sizeof label, "%s of %s%s", numbers[k].label, m->name,
                   other != m ? AMBULO__BOTH_OF_A_PAIR : "");
    ambulo__parameter_add(p, numbers[k].quantity, number_of(m, k), label, "muscles.%s.%s", m->name,
                          numbers[k].key);
    ambulo__parameter_within(p, numbers[k].low, numbers[k].high);
    if (other != m)
      ambulo__parameter_with(p, 1.0, number_of(other, k), "muscles.%s.%s", other->name,
                             numbers[k].key);
  }
}

void ambulo__parameters_of_muscles(ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->problem->definition;
  int term = 0;
  while (term < d->term_count && d->terms[term].kind != AMBULO_MUSCLE_EFFORT) term++;
  if (term == d->term_count) return;
  p->next.enters = AMBULO__ENTERS_TERM;
  p->next.term = term;
  for (int i = 0; i < d->muscles->count; i++) {
    int image = d->ends == AMBULO_ENDS_MIRRORED ? d->muscles->muscles[i].mirror : i;
    if (image >= i) add_muscle(p, i, image); /* or said before */
  }
  p->next.enters = AMBULO__ENTERS_ALL;
}
