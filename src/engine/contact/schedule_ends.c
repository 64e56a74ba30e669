/* contact/schedule_ends.c - footholds at the end of a motion that repeats against those at its
 * beginning.
 *
 * A foot or patch that is down at T stands where it, or its mirror image when the ends are
 * mirrored, stands at 0, moved on by the travel:
 *
 *     place(T) = (place_f(0) + travel, +-place_l(0), place_n(0) + rise),   m;   - when mirrored
 *     heading(T) = +-heading(0),   normal(T) = (normal_f(0), +-normal_l(0), normal_n(0))
 *
 * It need not be down at both: at T it may strike, or leave the ground. Rows at the last node are
 * left out where they repeat those of the first (contact/bounded.h), so a disagreement would be a
 * foot that slides in the last interval. It is what the wrong number of steps comes to, too: after
 * two steps the same foot strikes again, after one the other one does.
 */
#include "base/arithmetic.h"
#include "contact/contact_frame.h"
#include "contact/effector.h"
#include "contact/gait.h"

#include <math.h>

static const double tolerance = 1e-6; /* m, rad */

/* do places enter the rows at all? */
static int uses_places(const ambulo_problem_definition *d) {
  return d->foot_strike || d->contact_tolerance > 0.0 || d->support != AMBULO_SUPPORT_OFF ||
         d->ground_reaction.kind != AMBULO_REACTION_NONE;
}

/* the next contact's surface is that of the first one, moved on */
static int leans_alike(const ambulo_problem_definition *d, const ambulo_contact *first,
                       const ambulo_contact *last) {
  ambulo_contact image = *first;
  double apart = 0.0;
  if (d->ends == AMBULO_ENDS_MIRRORED) image.normal[1] = -image.normal[1];
  image.heading = last->heading;
  ambulo__contact_frame one = ambulo__contact_frame_of(d, &image);
  ambulo__contact_frame other = ambulo__contact_frame_of(d, last);
  for (int i = 0; i < 3; i++) apart = fmax(apart, fabs(one.up[i] - other.up[i]));
  return apart <= tolerance;
}

/* at the same place of the plane: height, heading and slope */
static ambulo_status check_turned(const ambulo_problem_definition *d, const ambulo_contact *first,
                                  const ambulo_contact *last, double up, ambulo_diagnostics *list) {
  double side = d->ends == AMBULO_ENDS_MIRRORED ? -1.0 : 1.0, heading = side * first->heading;
  int effector = ambulo__effector_of(d->model, last);
  const char *kind = ambulo__effector_kind(d->model, effector);
  const char *name = ambulo__effector_name(d->model, effector);
  if (fabs(last->place[2] - up) > tolerance)
    return ambulo__error(list, AMBULO_E_PROBLEM, ambulo__nowhere, "change ends.rise",
                         "ends.rise: %s '%s' stands %.6g m high at t = %.6g s, but ends with a "
                         "rise of %.6g m put it at %.6g m; expected the same height",
                         kind, name, last->place[2], d->duration, d->rise, up);
  if (fabs(last->heading - heading) > tolerance)
    return ambulo__error(list, AMBULO_E_PROBLEM, ambulo__nowhere,
                         "a motion that turns does not repeat itself: leave 'ends.kind' out",
                         "contacts: %s '%s' is turned by %.6g rad at t = %.6g s, and by %.6g rad "
                         "where the motion begins again; expected the same",
                         kind, name, last->heading, d->duration, heading);
  if (!leans_alike(d, first, last))
    return ambulo__error(
        list, AMBULO_E_PROBLEM, ambulo__nowhere, NULL,
        "contacts: %s '%s' stands on the normal (%.6g, %.6g, %.6g) at t = %.6g s, and on (%.6g, "
        "%.6g, %.6g) where the motion begins again; expected the same direction",
        kind, name, last->normal[0], last->normal[1], last->normal[2], d->duration,
        first->normal[0], side * first->normal[1] + 0.0, first->normal[2]); /* no -0 */
  return AMBULO_OK;
}

static ambulo_status check_pair(const ambulo_problem_definition *d, const ambulo_contact *first,
                                const ambulo_contact *last, ambulo_diagnostics *list) {
  int mirrored = d->ends == AMBULO_ENDS_MIRRORED;
  double ahead = first->place[0] + d->travel;
  double left = mirrored ? -first->place[1] : first->place[1];
  double up = first->place[2] + d->rise;
  if (fabs(last->place[0] - ahead) <= tolerance && fabs(last->place[1] - left) <= tolerance)
    return check_turned(d, first, last, up, list);
  int one = ambulo__effector_of(d->model, first), other = ambulo__effector_of(d->model, last);
  const char *ends = mirrored ? "mirrored" : "periodic";
  return ambulo__error(
      list, AMBULO_E_PROBLEM, ambulo__nowhere,
      "mirrored ends go with an odd number of equal steps, periodic ends with an even number; or "
      "change the travel",
      "ends.travel: %s '%s' stands at (%.6g, %.6g) m at t = %.6g s, but %s ends with a travel of "
      "%.6g m put it at (%.6g, %.6g) m, from %s '%s' at (%.6g, %.6g) m at t = 0; expected the "
      "same place",
      ambulo__effector_kind(d->model, other), ambulo__effector_name(d->model, other),
      last->place[0], last->place[1], d->duration, ends, d->travel, ahead, left,
      ambulo__effector_kind(d->model, one), ambulo__effector_name(d->model, one), first->place[0],
      first->place[1]);
}

ambulo_status ambulo__schedule_check_ends(const ambulo_problem_definition *d,
                                          ambulo_diagnostics *list) {
  if (d->ends == AMBULO_ENDS_FREE || !uses_places(d)) return AMBULO_OK;
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *last = &d->contacts[i];
    if (last->to < d->duration - AMBULO__INSTANT) continue;
    int effector = ambulo__effector_of(d->model, last);
    if (d->ends == AMBULO_ENDS_MIRRORED) effector = ambulo__effector_mirror(d->model, effector);
    for (int k = 0; k < d->contact_count; k++) {
      const ambulo_contact *first = &d->contacts[k];
      if (ambulo__effector_of(d->model, first) != effector || first->from > AMBULO__INSTANT)
        continue;
      ambulo_status status = check_pair(d, first, last, list);
      if (status) return status; /* one is enough: the others follow */
    }
  }
  return AMBULO_OK;
}
