/* solver/foothold_parameters.c - places, heights, headings and normals of listed contacts.
 *
 * Contacts of a foot that follow each other on one foothold move together: one alone would put the
 * foot in two places at once. The key is that of the first in the list, with the others' beside it,
 * and has the sum of their partials.
 *
 * Where the motion repeats, a foothold at T is one at 0 that has travelled: neither is listed, nor
 * travel and rise, for none of them can move alone. Not listed as well are those without a partial
 * (surface.c, step_rows.c); on level ground all but places, because rows change in a jump as it is
 * left (contact/clearance.c).
 */
#include "solver/sensitivity_parameters.h"

#include "base/arithmetic.h"
#include "contact/contact_frame.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* contacts on a foothold, in the order of the list */
typedef struct foothold {
  ambulo__parameters *p;
  const ambulo_contact *first;
  double from, to;
} foothold;

static int is_there(const foothold *f, const ambulo_contact *c) {
  return c->foot == f->first->foot && ambulo__contacts_same_place(c, f->first) &&
         c->from <= f->to + AMBULO__INSTANT && c->to >= f->from - AMBULO__INSTANT;
}

/* as long as contacts touch it */
static foothold foothold_of(ambulo__parameters *p, int contact) {
  const ambulo_problem_definition *d = &p->problem->definition;
  foothold f = {p, &d->contacts[contact], d->contacts[contact].from, d->contacts[contact].to};
  for (int c = 0; c < d->contact_count; c++) {
    const ambulo_contact *other = &d->contacts[c];
    if (!is_there(&f, other) || (other->from >= f.from && other->to <= f.to)) continue;
    f.from = fmin(f.from, other->from);
    f.to = fmax(f.to, other->to);
    c = -1;
  }
  return f;
}

static int is_first(const foothold *f) {
  const ambulo_contact *contacts = f->p->problem->definition.contacts;
  for (const ambulo_contact *c = contacts; c < f->first; c++)
    if (is_there(f, c)) return 0;
  return 1;
}

/* 1 if contact `late` holds at T where `early`, at 0, has to be again */
static int meet(const ambulo_problem_definition *d, const ambulo_contact *late,
                const ambulo_contact *early) {
  int foot = early->foot;
  if (d->ends == AMBULO_ENDS_FREE || early->from > AMBULO__INSTANT ||
      late->to < d->duration - AMBULO__INSTANT)
    return 0;
  return late->foot == (d->ends == AMBULO_ENDS_MIRRORED ? d->model->feet[foot].mirror : foot);
}

int ambulo__footholds_meet(const ambulo_problem_definition *d) {
  for (int late = 0; late < d->contact_count; late++)
    for (int early = 0; early < d->contact_count; early++)
      if (meet(d, &d->contacts[late], &d->contacts[early])) return 1;
  return 0;
}

/* 1 if another foothold has to go along */
static int is_bound(const foothold *f) {
  const ambulo_problem_definition *d = &f->p->problem->definition;
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *own = &d->contacts[i];
    for (int k = 0; is_there(f, own) && k < d->contact_count; k++) {
      const ambulo_contact *other = &d->contacts[k];
      if (!is_there(f, other) && (meet(d, own, other) || meet(d, other, own))) return 1;
    }
  }
  return 0;
}

/* the part `i` of `stride` numbers of each contact, under a key with room for its index */
static void add(const foothold *f, ambulo__quantity quantity, double value, const double *by,
                int stride, int i, const char *what, const char *key) {
  const ambulo_problem_definition *d = &f->p->problem->definition;
  char label[AMBULO__PARAMETER_TEXT], name[64];
  double sum = 0.0;
  int own = (int)(f->first - d->contacts), count = f->p->count;
  for (int c = own; c < d->contact_count; c++)
    if (is_there(f, &d->contacts[c])) sum += by[stride * c + i];
  if (!isfinite(sum)) return;
  (void)snprintf(label, sizeof label, "%s contact %d", what, own);
  ambulo__parameter_add(f->p, quantity, value, sum, label, "contacts[%d].%s", own, key);
  for (int c = own + 1; c < d->contact_count && f->p->count > count; c++) {
    if (!is_there(f, &d->contacts[c])) continue;
    (void)snprintf(name, sizeof name, "contacts[%d].%s", c, key);
    ambulo__parameter_with(f->p, 1.0, "%s", name);
  }
}

static void add_surface(const foothold *f) {
  static const char *const keys[] = {"normal[0]", "normal[1]", "normal[2]"};
  static const char *const words[] = {"normal forward at", "normal to the left at",
                                      "normal upward at"};
  const ambulo__partials *by = f->p->partials;
  add(f, AMBULO__STEP_LENGTH, f->first->place[2], by->rise, 1, 0, "height of the foothold of",
      "place[2]");
  add(f, AMBULO__ANGLE, f->first->heading, by->heading, 1, 0, "heading of", "heading");
  for (int i = 0; f->first->normal[2] > 0.0 && i < 3; i++)
    add(f, AMBULO__RATIO, f->first->normal[i], by->normal, 3, i, words[i], keys[i]);
}

void ambulo__parameters_of_footholds(ambulo__parameters *p) {
  static const char *const keys[] = {"place[0]", "place[1]"};
  static const char *const words[] = {"foothold forward of", "foothold to the left of"};
  const ambulo_problem_definition *d = &p->problem->definition;
  int level = ambulo__contacts_are_level(d);
  for (int c = 0; c < d->contact_count; c++) {
    foothold f = foothold_of(p, c);
    if (!is_first(&f) || is_bound(&f)) continue;
    if (!level) add_surface(&f);
    for (int i = 0; i < 2; i++)
      add(&f, AMBULO__STEP_LENGTH, f.first->place[i], p->partials->place, 2, i, words[i], keys[i]);
  }
}
