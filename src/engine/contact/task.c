/* contact/task.c - see task.h. */
#include "contact/task.h"
#include "base/arithmetic.h"

#include "model/model.h"

#include <math.h>

/* the links from the foot to the first one that another foot hangs on too, not included */
static int is_shared(const ambulo_model *model, int link) {
  int feet = 0;
  for (int f = 0; f < model->foot_count; f++) {
    int i = model->points[model->feet[f].heel_center].link;
    while (i >= 0 && i != link) i = model->links[i].parent;
    feet += i == link;
  }
  return feet > 1;
}

/* straight: sqrt(a^2 + d^2) of each link; d of the uppermost only moves the joint along its axis */
static double leg_length(const ambulo_model *model, int foot) {
  const ambulo_point *heel = &model->points[model->feet[foot].heel_center];
  const double *p = heel->position;
  double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  for (int i = heel->link; i >= 0 && !is_shared(model, i); i = model->links[i].parent) {
    const ambulo_link *link = &model->links[i];
    int first = link->parent < 0 || is_shared(model, link->parent);
    if (link->type == AMBULO_PRISMATIC) return 0.0; /* as long as it likes */
    length += first ? fabs(link->a) : hypot(link->a, link->d);
  }
  return length;
}

/* along forward, of feet that are down together or hand over */
static double longest_step(const ambulo_problem_definition *d) {
  double longest = 0.0;
  for (int i = 0; i < d->contact_count; i++) {
    for (int j = 0; j < i; j++) {
      const ambulo_contact *a = &d->contacts[i], *b = &d->contacts[j];
      if (a->foot < 0 || b->foot < 0 || a->foot == b->foot ||
          fmin(a->to, b->to) < fmax(a->from, b->from) - AMBULO__INSTANT)
        continue;
      longest = fmax(longest, fabs(a->place[0] - b->place[0]));
    }
  }
  return longest;
}

ambulo__task ambulo__task_of(const ambulo_problem_definition *d) {
  const ambulo_model *model = d->model;
  ambulo__task task = {0};
  double along = 0.0, against = 0.0;
  for (int f = 0; f < model->foot_count; f++) task.leg = fmax(task.leg, leg_length(model, f));
  if (model->foot_count < 2 || d->contact_count == 0 || !(task.leg > 0.0)) return (ambulo__task){0};
  for (int k = 0; k < 3; k++) {
    along -= model->gravity[k] * model->forward[k];
    against -= model->gravity[k] * model->up[k];
  }
  task.is_gait = 1;
  task.gravity = hypot(along, against);
  task.step = longest_step(d);
  if (d->ends == AMBULO_ENDS_FREE || !(task.gravity > 0.0)) return task;
  task.speed = fabs(d->travel) / d->duration;
  task.froude = task.speed * task.speed / (task.gravity * task.leg);
  task.grade = along / against;
  if (task.speed > 0.0) task.step_time = task.step / task.speed;
  return task;
}
