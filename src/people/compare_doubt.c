/* people/compare_doubt.c - see compare_doubt.h. */
#include "people/compare_doubt.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "people/compare_score.h"

static const double whole = 90.0;       /* percent that a reference of a cycle covers */
static const double most_radians = 3.2; /* no joint of a walk turns further */
static const double least_ratio = 57.3 / 3.0, most_ratio = 57.3 * 3.0;

int ambulo__curve_is_listed(const char *list, const char *curve) {
  size_t length = strlen(curve);
  if (!list) return 1;
  for (const char *at = list; at;) {
    const char *comma = strchr(at, ',');
    size_t size = comma ? (size_t)(comma - at) : strlen(at);
    if (size == length && memcmp(at, curve, length) == 0) return 1;
    at = comma ? comma + 1 : NULL;
  }
  return 0;
}

/* the curves of all files, one after the other; NULL at the end */
static const char *curve_at(const ambulo__people *people, int index) {
  for (int f = 0; f < people->count; f++) {
    const ambulo__reference *reference = &people->files[f].reference;
    if (index < reference->count) return reference->curves[index].entry->curve;
    index -= reference->count;
  }
  return NULL;
}

static int is_known(const ambulo__people *people, const char *name, size_t size) {
  const char *curve;
  for (int i = 0; (curve = curve_at(people, i)) != NULL; i++) {
    if (strlen(curve) == size && memcmp(curve, name, size) == 0) return 1;
  }
  return 0;
}

ambulo_status ambulo__curves_check(const char *list, const ambulo__people *people,
                                   ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = people->files[0].path};
  for (const char *at = list; at;) {
    char known[400] = "";
    const char *curve;
    size_t used = 0, size = strcspn(at, ",");
    if (is_known(people, at, size)) {
      at = at[size] ? at + size + 1 : NULL;
      continue;
    }
    for (int i = 0; used < sizeof known && (curve = curve_at(people, i)) != NULL; i++)
      used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", curve);
    return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "--columns: the reference has no curve '%.*s'; expected some of %s",
                         (int)(size < 100 ? size : 100), at, known);
  }
  return AMBULO_OK;
}

static double largest(const double *y, int count) {
  double most = 0.0;
  for (int i = 0; i < count; i++) most = fmax(most, fabs(y[i]));
  return most;
}

int ambulo__curve_doubt(const ambulo__reference_curve *curve, const double *fine, const char *file,
                        ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = file};
  double from = curve->percent[0], to = curve->percent[curve->points - 1];
  double theirs = largest(curve->mean, curve->points), ours = largest(fine, AMBULO__FINE);
  if (to - from < whole) {
    ambulo__warning(diagnostics, place,
                    to <= 1.0 ? "a cycle is 0 to 100 percent, not 0 to 1" : NULL,
                    "'%s' covers %g to %g percent of the cycle; it is compared there",
                    curve->entry->curve, from, to);
    return 1;
  }
  if (curve->entry->unit != AMBULO__UNIT_ANGLE || theirs > most_radians) return 0;
  if (ours < least_ratio * theirs || ours > most_ratio * theirs) return 0;
  ambulo__warning(diagnostics, place, "references are in degrees",
                  "'%s' reaches %.3g degrees, the prediction %.3g: they look like radians",
                  curve->entry->curve, theirs, ours);
  return 1;
}
