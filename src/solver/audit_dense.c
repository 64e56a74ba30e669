/* solver/audit_dense.c - what happens between the time nodes.
 *
 * The same definition with `samples` times as many nodes and the trajectory's own grid has
 * the same unknowns and more rows. Contact equalities hold at the nodes only: between
 * them they show how far a foot slides. Rows on the ends are the same on every grid and
 * left out. User rows and terms may count nodes; they are not asked off the nodes.
 */
#include "solver/audit.h"

#include <math.h>
#include <string.h>

static int is_border(const ambulo__table_row *row) {
  return row->node < 0;
}

static ambulo_violation worst_of(const ambulo_problem *dense, const ambulo_problem *p,
                                 const double *rows) {
  ambulo_violation worst = {.family = "", .subject = "", .detail = "", .unit = "", .size = 1.0};
  int at = -1;
  for (int r = 0; r < dense->rows; r++) {
    if (is_border(&dense->table.rows[r])) continue;
    ambulo_violation v = ambulo__violation_of(dense, r, rows[r]);
    if (at >= 0 && ambulo__relative(&v) <= ambulo__relative(&worst)) continue;
    at = r;
    worst.worst = v.worst;
    worst.size = v.size;
  }
  if (at < 0) return worst;
  const ambulo__table_row *row = &dense->table.rows[at];
  worst.time = row->time;
  /* the names must outlive the dense problem: the same row exists at some node of p */
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *own = &p->table.rows[r];
    if (strcmp(own->family, row->family) != 0) continue;
    int same = strcmp(own->subject, row->subject) == 0 && strcmp(own->detail, row->detail) == 0;
    if (!same && worst.family[0]) continue;
    worst.family = own->family;
    worst.subject = own->subject;
    worst.detail = own->detail;
    worst.unit = own->unit;
    if (same) break;
  }
  return worst;
}

ambulo_status ambulo__audit_dense(const ambulo_problem *p, const double *x, int samples,
                                  const ambulo_allocator *allocator, ambulo_violation *worst) {
  ambulo_violation none = {"", "", "", "", 0.0, NAN, 1.0};
  ambulo_problem_definition d = p->definition;
  ambulo_problem *dense = NULL;
  ambulo_workspace *workspace = NULL;
  *worst = none;
  d.spline_intervals = ambulo__basis_intervals(p->basis);
  d.intervals = p->definition.intervals * samples;
  d.terms = NULL;
  d.term_count = 0;
  d.user_rows = NULL;
  d.user_row_count = 0;
  ambulo_status status = ambulo_problem_create(&d, allocator, NULL, &dense);
  if (status) return status == AMBULO_E_MEMORY ? status : AMBULO_OK;
  status = ambulo__workspace_create_for_values(dense, allocator, &workspace);
  if (!status && dense->variables == p->variables && ambulo__evaluate(workspace, x) == AMBULO_OK)
    *worst = worst_of(dense, p, workspace->row_value);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(dense);
  return status;
}
