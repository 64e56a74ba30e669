/* contact/contact_frame.c - see contact_frame.h.
 *
 * Under a foot in the air, s its share of the way, S(s) = s^2 (3 - 2 s):
 *
 *     p_f, p_l, psi, u   x = (1 - S(s)) x_from + S(s) x_to
 *     p_n                the same with s' = min(1, 2 s) up, max(0, 2 s - 1) down
 */
#include "contact/contact_frame.h"
#include "base/arithmetic.h"
#include "model/model.h"

#include <math.h>

static const double facing = 0.90630778703664997; /* cosine of 25 degrees */

int ambulo__contact_normal_is_legal(const double normal[3]) {
  double size = sqrt(ambulo__dot(normal, normal));
  return size == 0.0 || (isfinite(size) && normal[2] >= 0.5 * size);
}

int ambulo__contact_is_level(const ambulo_contact *c) {
  return c->heading == 0.0 && c->place[2] == 0.0 && c->normal[0] == 0.0 && c->normal[1] == 0.0;
}

int ambulo__contacts_same_place(const ambulo_contact *one, const ambulo_contact *other) {
  for (int i = 0; i < 3; i++)
    if (one->place[i] != other->place[i] || one->normal[i] != other->normal[i]) return 0;
  return one->heading == other->heading;
}

int ambulo__contacts_are_level(const ambulo_problem_definition *d) {
  for (int i = 0; i < d->contact_count; i++)
    if (d->contacts[i].foot >= 0 && !ambulo__contact_is_level(&d->contacts[i])) return 0;
  return 1;
}

ambulo__contact_frame ambulo__contact_frame_of(const ambulo_problem_definition *d,
                                               const ambulo_contact *c) {
  const ambulo_model *m = d->model;
  ambulo__contact_frame frame;
  double height = d->ground_height + c->place[2], ahead[3], length = 0.0;
  for (int i = 0; i < 3; i++) {
    frame.origin[i] = c->place[0] * m->forward[i] + c->place[1] * m->left[i] + height * m->up[i];
    frame.forward[i] = m->forward[i];
    frame.left[i] = m->left[i];
    frame.up[i] = m->up[i];
  }
  if (c->heading == 0.0 && c->normal[0] == 0.0 && c->normal[1] == 0.0 && c->normal[2] >= 0.0)
    return frame;
  double size = sqrt(ambulo__dot(c->normal, c->normal));
  for (int i = 0; i < 3; i++) {
    ahead[i] = cos(c->heading) * m->forward[i] + sin(c->heading) * m->left[i];
    if (size > 0.0)
      frame.up[i] =
          (c->normal[0] * m->forward[i] + c->normal[1] * m->left[i] + c->normal[2] * m->up[i]) /
          size;
  }
  if (fabs(ambulo__dot(frame.up, ahead)) > facing)
    for (int i = 0; i < 3; i++) ahead[i] = m->up[i];
  ambulo__cross(frame.up, ahead, frame.left);
  length = sqrt(ambulo__dot(frame.left, frame.left));
  for (int i = 0; i < 3; i++) frame.left[i] /= length;
  ambulo__cross(frame.left, frame.up, frame.forward);
  return frame;
}

ambulo_contact ambulo__contact_between(const ambulo_contact *from, const ambulo_contact *to,
                                       double share) {
  ambulo_contact there = *to;
  double along = ambulo__smooth_step(share), rise = to->place[2] - from->place[2];
  double climb = ambulo__smooth_step(rise > 0.0 ? 2.0 * share : 2.0 * share - 1.0);
  for (int i = 0; i < 2; i++)
    there.place[i] = from->place[i] + along * (to->place[i] - from->place[i]);
  there.place[2] = from->place[2] + climb * rise;
  there.heading = from->heading + along * (to->heading - from->heading);
  for (int i = 0; i < 3; i++) {
    double up = i == 2 ? 1.0 : 0.0; /* a normal of zero is up */
    double a = from->normal[2] > 0.0 ? from->normal[i] : up,
           b = to->normal[2] > 0.0 ? to->normal[i] : up;
    there.normal[i] = a + along * (b - a);
  }
  return there;
}

ambulo__contact_frame ambulo__contact_frame_between(const ambulo_problem_definition *d,
                                                    const ambulo_contact *from,
                                                    const ambulo_contact *to, double share) {
  ambulo_contact there = ambulo__contact_between(from, to, share);
  return ambulo__contact_frame_of(d, &there);
}

double ambulo__contact_frame_along(const ambulo__contact_frame *frame, const double direction[3],
                                   const double point[3]) {
  double sum = 0.0;
  for (int i = 0; i < 3; i++) sum += direction[i] * (point[i] - frame->origin[i]);
  return sum;
}
