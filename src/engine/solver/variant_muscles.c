/* solver/variant_muscles.c - the muscles that a variant of a problem has.
 *
 * Muscles grow with the body as those of a file do (definitions/muscle_file.c): with the masses m,
 * loads apart, forces are multiplied by (m' / m)^(2/3), and lengths, paths among them, as lengths
 * of the model are. Numbers that have been moved, or that the problem's file gives, stay.
 */
#include "solver/sensitivity.h"

#include "model/conditions.h"
#include "muscle/muscles.h"
#include "problem/muscle_effort.h"

#include <math.h>
#include <string.h>

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

static void grow(double was, double factor, int bit, double *number, unsigned char *fixed) {
  if (*number != was) *fixed |= (unsigned char)bit;
  if (!(*fixed & bit)) *number *= factor;
}

/* *fixed: numbers that stay */
static void grow_muscle(const ambulo_muscle *own, const growth *g, ambulo_muscle *m,
                        unsigned char *fixed) {
  grow(own->force, g->force, AMBULO__FIXED_FORCE, &m->force, fixed);
  grow(own->fiber, g->length, AMBULO__FIXED_FIBER, &m->fiber, fixed);
  grow(own->tendon, g->length, AMBULO__FIXED_TENDON, &m->tendon, fixed);
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
    grow_muscle(&own->muscles[i], &g, &list[i], &fixed[i]);
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
