/* solver/explain_task.c - says so when a gait without flight that failed asks for what is no walk
 * (contact/schedule.h). */
#include "solver/explain.h"

#include "contact/row_families.h"
#include "contact/schedule.h"

#include <math.h>

static void speed(const ambulo__task *t, ambulo__explanation *out) {
  double runs = sqrt(AMBULO__RUNNING_FROUDE * t->gravity * t->leg);
  if (t->froude <= AMBULO__RUNNING_FROUDE) return;
  if (t->froude > 1.0) {
    ambulo__explain_line(out,
                         "no walk: a walk at this speed would need a pull of %.3g body weights to "
                         "keep the body on its arc over a straight leg, and gravity gives 1",
                         t->froude);
  } else {
    ambulo__explain_line(out,
                         "hardly a walk: the arc over a straight leg takes %.2g of the body weight "
                         "at this speed",
                         t->froude);
  }
  ambulo__explain_line(out,
                       "  running is how people move so fast, from about %.2g m/s on legs of %.3g "
                       "m (Froude number 0.5); it has flight: gait.phases.toe_off below 0.5",
                       runs, t->leg);
}

static void step(const ambulo__task *t, ambulo__explanation *out) {
  if (t->step <= AMBULO__LONGEST_STEP * t->leg) return;
  ambulo__explain_line(out,
                       "no walk: a walk with these steps would need legs of %.3g m: people's "
                       "longest steps are about %.3g leg lengths, here %.3g m",
                       t->step / AMBULO__LONGEST_STEP, AMBULO__LONGEST_STEP,
                       AMBULO__LONGEST_STEP * t->leg);
}

static void grade(const ambulo_problem_definition *d, const ambulo__task *t,
                  ambulo__explanation *out) {
  const ambulo_ground_reaction *r = &d->ground_reaction;
  if (r->kind == AMBULO_REACTION_NONE || !(fabs(t->grade) > r->friction)) return;
  ambulo__explain_line(out,
                       "no walk: feet slip on a slope of %.3g deg unless friction is %.3g or more; "
                       "it is %.3g",
                       57.29577951308232 * atan(t->grade), fabs(t->grade), r->friction);
}

void ambulo__explain_task(const ambulo_problem *problem, ambulo__explanation *out) {
  const ambulo_problem_definition *d = &problem->definition;
  ambulo__task task = ambulo__task_of(d);
  int before = out->view.line_count;
  ambulo__span flight;
  if (!task.is_gait || ambulo__flight_span(d, &flight)) return;
  speed(&task, out);
  step(&task, out);
  grade(d, &task, out);
  if (out->view.line_count > before && task.speed > 0.0)
    ambulo__explain_line(out,
                         "  asked for: %.3g m/s in steps of %.3g m, %.3g a second, Froude number "
                         "v^2 / (g l) %.3g, step %.3g leg lengths",
                         task.speed, task.step, task.step_time > 0.0 ? 1.0 / task.step_time : 0.0,
                         task.froude, task.step / task.leg);
}
