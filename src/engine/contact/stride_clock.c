/* contact/stride_clock.c - see stride_clock.h.
 *
 *     share = (t - b) / (b' - b),   b, b' the beginnings of the stances around t
 */
#include "contact/stride_clock.h"

#include "base/arithmetic.h"
#include "contact/contact_image.h"

#include <math.h>

int ambulo__stride_at(const ambulo_problem_definition *d, int foot, double time,
                      ambulo__stride_now *now) {
  int last = ambulo__image_periods(d) + 1; /* the stride that begins at T ends 3 T after 0 */
  *now = (ambulo__stride_now){{-INFINITY, INFINITY}, {-1, -1}, 0.0};
  if (d->ends == AMBULO_ENDS_FREE) return 0;
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last; period <= last; period++) {
      if (ambulo__image_effector(d, i, period) != foot) continue;
      ambulo__span image = ambulo__image_span(d, i, period);
      ambulo__span span = ambulo__uninterrupted(d, foot, AMBULO__ANY_MODE, image);
      int side = span.from > time + AMBULO__INSTANT;
      if (side ? span.from >= now->begin[1] : span.from <= now->begin[0]) continue;
      now->begin[side] = span.from;
      now->contact[side] = span.begins;
    }
  }
  if (now->contact[0] < 0 || now->contact[1] < 0) return 0;
  double share = (time - now->begin[0]) / (now->begin[1] - now->begin[0]);
  now->share = share > 0.0 ? share : 0.0;
  return 1;
}
