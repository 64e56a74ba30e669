/* solver/explain_lines.c - an explanation in words: one fact a line, with name, time and unit. */
#include "solver/explain.h"

#include <stdio.h>
#include <string.h>

/* "knee_angle_r lower" */
static const char *name_of(const char *subject, const char *detail, char buffer[96]) {
  const char *space = subject[0] && detail[0] ? " " : "";
  (void)snprintf(buffer, 96, "%s%s%s", subject, space, detail);
  return buffer;
}

static void place(const ambulo_violation *v, char *text, size_t size) {
  char name[96];
  (void)snprintf(text, size, "%.4g %s at %s, t = %.4g s", v->worst, v->unit,
                 name_of(v->subject, v->detail, name), v->time);
}

static void contradictions(ambulo__explanation *out) {
  char where[200];
  for (int i = 0; i < out->view.contradictory_count; i++) {
    const ambulo_violation *v = &out->contradictory[i];
    place(v, where, sizeof where);
    ambulo__explain_line(
        out,
        "contradictory equality: %s (%s) cannot hold together with the equalities before "
        "it",
        v->family, where);
  }
}

/* in conflict: at a minimum of all violations. A search that was cut short shows none. */
static void conflicts(ambulo__explanation *out) {
  char where[200];
  if (out->view.conflict_count == 0) return;
  ambulo__explain_line(out, out->view.complete
                                ? "in conflict, where every row gives way a little:"
                                : "still violated, where every row gives way a little:");
  for (int i = 0; i < out->view.conflict_count; i++) {
    place(&out->conflict[i].shared, where, sizeof where);
    ambulo__explain_line(out, "  %s: %s", out->conflict[i].shared.family, where);
  }
}

static void relaxations(ambulo__explanation *out) {
  char where[200];
  int alone = 0;
  for (int i = 0; i < out->view.conflict_count; i++) {
    const ambulo_conflict *c = &out->conflict[i];
    if (c->alone == 0)
      ambulo__explain_line(out, "dropping %s alone did not make the problem feasible",
                           c->shared.family);
    if (c->alone != 1) continue;
    alone++;
    place(&c->relaxation, where, sizeof where);
    ambulo__explain_line(out, "relaxing %s alone is enough: by %s", c->shared.family, where);
    for (int k = 0; k < c->other_count; k++) {
      place(&c->others[k], where, sizeof where);
      ambulo__explain_line(out, "  and %s", where);
    }
  }
  if (out->view.complete && alone == 0 && out->view.conflict_count > 0)
    ambulo__explain_line(out, "no single family of rows is to blame: several have to give way");
}

static void limits(ambulo__explanation *out) {
  char name[96];
  for (int i = 0; i < out->view.on_limit_count; i++) {
    const ambulo_on_limit *l = &out->on_limit[i];
    (void)name_of(l->subject, l->detail, name);
    if (l->from < l->to) {
      ambulo__explain_line(out, "on its limit: %s %s, %.4g %s, t = %.4g to %.4g s (%d nodes)",
                           l->family, name, l->bound, l->unit, l->from, l->to, l->nodes);
    } else {
      ambulo__explain_line(out, "on its limit: %s %s, %.4g %s, t = %.4g s", l->family, name,
                           l->bound, l->unit, l->from);
    }
  }
}

void ambulo__explain_lines(const ambulo_problem *problem, const ambulo_result *result,
                           ambulo__explanation *out) {
  char where[200];
  const ambulo_violation *worst = &result->audit.violation;
  place(worst, where, sizeof where);
  ambulo__explain_line(out, "worst row of the point returned: %s, %s", worst->family, where);
  ambulo__explain_task(problem, out);
  contradictions(out);
  if (out->view.feasible_point) {
    ambulo__explain_line(
        out, "a motion that satisfies every row at the nodes exists near the point returned: "
             "the solver missed it; allow more time or evaluations, or start from another motion");
    return;
  }
  conflicts(out);
  relaxations(out);
  limits(out);
  if (!out->view.complete)
    ambulo__explain_line(out, "cut short by the time limit: not every family could be tried");
  if (!out->suggestion[0]) return;
  ambulo__explain_line(out, "suggestion: %s", out->suggestion);
  for (int i = 0; i < out->view.setting_count; i++)
    ambulo__explain_line(out, "  --set '%s'", out->settings[i]);
}
