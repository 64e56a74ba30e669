/* study/front_tell.c - what a reader of a front has to know (front_points.h). */
#include "study/front_points.h"

#include <string.h>

/* mean gaps; narrower ones are as even as points can be */
static const double wide = 1.5;

static const char *name_of(const ambulo__listing *l, int k) {
  return ambulo__listing_cell(l, k, AMBULO__LISTING_NAME);
}

static void tell_gap(const ambulo__listing *l, const ambulo__front *f,
                     const ambulo__front_report *report, const ambulo__front_gap *gap,
                     ambulo__place place, ambulo_diagnostics *diagnostics) {
  ambulo__warning(diagnostics, place,
                  "no sum of the terms has its least there: the front is not convex, or straight; "
                  "or its solves fail",
                  "no weights lead between the points '%s' and '%s' (gap of %.1f mean gaps; "
                  "%s %.4g to %.4g)",
                  name_of(l, gap->a), name_of(l, gap->b), gap->length / report->mean,
                  l->front.name[0], f->point[gap->a].value[0], f->point[gap->b].value[0]);
}

static ambulo_status tell_gaps(const ambulo__listing *l, const ambulo__front *f,
                               const ambulo__front_report *report, ambulo__place place,
                               ambulo_diagnostics *diagnostics, ambulo_front_census *census) {
  int gaps = 0;
  ambulo__front_gap *gap = ambulo__alloc(&l->allocator, (size_t)report->on + 1, sizeof *gap);
  if (!gap) return AMBULO_E_MEMORY;
  ambulo__front_gaps(f, gap, &gaps);
  for (int i = 0; i < gaps; i++) {
    if (!gap[i].refused || gap[i].length <= wide * report->mean) continue;
    census->refused++;
    tell_gap(l, f, report, &gap[i], place, diagnostics);
  }
  ambulo__free(&l->allocator, gap);
  return AMBULO_OK;
}

ambulo_status ambulo__front_tell(const char *directory, const ambulo__listing *l,
                                 const ambulo__front *f, const ambulo__front_report *report,
                                 ambulo_diagnostics *diagnostics, ambulo_front_census *census) {
  ambulo__place place = {directory, 0, 0, NULL};
  memset(census, 0, sizeof *census);
  census->terms = f->terms;
  census->wanted = f->wanted;
  census->points = report->on;
  census->left_out = report->beaten + report->dominated;
  census->largest_gap = report->largest;
  census->mean_gap = report->mean;
  for (int i = 0; i < f->terms && i < f->points; i++)
    if (!f->point[i].solved)
      ambulo__warning(diagnostics, place, "a front needs all its ends",
                      "no front: '%s' has no valid solution", name_of(l, i));
  if (report->complete && !report->conflict)
    ambulo__warning(diagnostics, place, NULL,
                    "no front: the terms are not at odds, one motion is best for all");
  if (f->terms == 2 && report->on > 1) return tell_gaps(l, f, report, place, diagnostics, census);
  return AMBULO_OK;
}
