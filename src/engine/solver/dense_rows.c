/* solver/dense_rows.c - violations of rows between the nodes, as samples.
 *
 * Rows on unknowns and rows that join the two ends are the same on every grid and left out.
 */
#include "solver/audit.h"
#include "solver/dense.h"

#include <math.h>

/* names of obstacles belong to the problem that is judged, those of the finer one go with it */
static const char *detail_of(const ambulo__dense *dense, const ambulo__table_row *row) {
  const ambulo__solid *solid = ambulo__row_solid_of(&dense->fine->table, row);
  int about = solid ? solid->about : -1;
  return about < 0 ? row->detail : dense->problem->definition.obstacles[about].name;
}

static void visit_row(const ambulo__dense *dense, int r, int index, ambulo__dense_visitor visit,
                      void *user) {
  const ambulo_problem *fine = dense->fine;
  const ambulo__table_row *row = &fine->table.rows[r];
  const ambulo__dense_rule *rule = ambulo__dense_rule_at(index);
  ambulo__dense_sample sample = {.rule = index,
                                 .family = row->family,
                                 .subject = row->subject,
                                 .detail = detail_of(dense, row),
                                 .unit = row->unit,
                                 .time = row->time,
                                 .value = ambulo__row_violation(fine, r, dense->row_value[r]),
                                 .tolerance = rule->tolerance};
  if (rule->of_limit) sample.tolerance *= ambulo__dense_limit_size(fine, row);
  visit(user, &sample);
}

/* (A.2) the rows again on the finer grid */
void ambulo__dense_rows(const ambulo__dense *dense, ambulo__dense_visitor visit, void *user) {
  const ambulo__row_table *table = &dense->fine->table;
  for (int r = 0; r < table->row_count; r++) {
    int rule = table->rows[r].node < 0 ? -1 : ambulo__dense_rule_of_row(&table->rows[r]);
    if (rule >= 0) visit_row(dense, r, rule, visit, user);
  }
}
