/* model/capsule_check.c - capsules: links, sizes, mirror pairs. */
#include <math.h>

#include "model/check.h"

static const double LONGEST = 1e6;          /* m */
static const double LARGEST_CAPSULE = 10.0; /* m, of the radius */

static void check_ends(ambulo__checker *c, const ambulo_capsule *capsule, ambulo__place place) {
  for (int i = 0; i < 6; i++) {
    double number = i < 3 ? capsule->from[i] : capsule->to[i - 3];
    if (fabs(number) <= LONGEST) continue;
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "'%s' of capsule '%s' is out of range (got %s m); expected three "
                              "finite numbers up to 1e6 m",
                              i < 3 ? "from" : "to", capsule->name ? capsule->name : "",
                              ambulo__number_text(number).text);
    return;
  }
}

static void check_mirror(ambulo__checker *c, int index, ambulo__place place) {
  const ambulo_model_definition *d = c->definition;
  const ambulo_capsule *capsule = &d->capsules[index];
  const char *name = capsule->name ? capsule->name : "";
  int mirror = capsule->mirror < 0 ? index : capsule->mirror;
  if (mirror >= d->capsule_count) {
    c->status =
        ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                      "mirror image of capsule '%s' does not exist (got index %d)", name, mirror);
  } else if ((d->capsules[mirror].mirror < 0 ? mirror : d->capsules[mirror].mirror) != index) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "mirror image of capsule '%s' has another mirror image itself; "
                              "expected a pair",
                              name);
  }
}

static void check_capsule(ambulo__checker *c, int index) {
  const ambulo_model_definition *d = c->definition;
  const ambulo_capsule *capsule = &d->capsules[index];
  ambulo__place place = ambulo__place_in(c, c->places ? c->places->capsules : NULL, index);
  const char *name = capsule->name ? capsule->name : "";
  if (capsule->link < 0 || capsule->link >= d->link_count)
    c->status =
        ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                      "link of capsule '%s' does not exist (got index %d); expected 0 to %d", name,
                      capsule->link, d->link_count - 1);
  if (!(capsule->radius > 0.0 && capsule->radius <= LARGEST_CAPSULE))
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "radius of capsule '%s' is out of range (got %s m); expected more "
                              "than 0, at most %g m",
                              name, ambulo__number_text(capsule->radius).text, LARGEST_CAPSULE);
  check_ends(c, capsule, place);
  check_mirror(c, index, place);
}

void ambulo__check_capsules(ambulo__checker *c) {
  for (int i = 0; i < c->definition->capsule_count; i++) check_capsule(c, i);
}
