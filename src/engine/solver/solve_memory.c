/* solver/solve_memory.c - what a solve takes, before it begins.
 *
 * With n unknowns, k diagonals below the main one, m rows, q border rows and J entries in the rows'
 * gradients, what an engine takes (engine.c), in bytes:
 *
 *     8 n (k + 28)       each of three band matrices: metric, whitener, KKT factor
 *     21 J               gradients: value, column, run; slopes by the motion, 3/5 as many
 *     8 n (16 + 12)      vectors, and the mixing of five iterates
 *     8 * 14 m           values, multipliers and marks of rows
 *     8 n (q + 32)       columns of the border, and of rows that come and go (border.h)
 *
 * Meanwhile a coarser grid may be solved (half as much again at the most); afterwards an audit on a
 * finer grid or an explanation (two more bands, all gradients) may follow. The largest counts.
 */

#include "base/machine.h"
#include "method/metric.h"
#include "solver/dense.h"
#include "solver/session.h"

#include <math.h>

static const double gigabyte = 1073741824.0;
static const double coarse_share = 0.5;
static const double margin = 1.15; /* what is not counted: names, lists, rounding to tiles */

/* columns that a channel depends on at one node, times the control points of the node */
static double columns_of(const ambulo_problem *p, int channel) {
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(p->plan);
  ambulo__row_part part[AMBULO__MOST_PARTS];
  int output = channel - ambulo__channel_outputs(&p->channels), most = 1;
  if (output < 0) return ambulo__basis_span(p->basis);
  int parts = ambulo__plan_parts(p->plan, output, part);
  for (int k = 0; k < parts; k++) {
    int count = pattern.start[part[k].row + 1] - pattern.start[part[k].row];
    if (count > most) most = count;
  }
  return (double)most * ambulo__basis_span(p->basis);
}

/* entries of the gradients of all rows: of each the widest channel that it looks at */
static double entries_of(const ambulo_problem *p) {
  double sum = 0.0;
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    const ambulo__row_term *term = p->table.terms + row->first_term;
    double widest = row->user >= 0 ? ambulo__basis_span(p->basis) * p->coordinates : 1.0;
    for (int t = 0; t < row->term_count; t++) {
      double columns = term[t].node < 0 ? 1.0 : columns_of(p, term[t].channel);
      if (columns > widest) widest = columns;
    }
    sum += row->node < 0 ? 2.0 * widest : widest;
  }
  return sum;
}

ambulo_memory ambulo_problem_memory(const ambulo_problem *p) {
  double n = p->variables, k = ambulo__metric_diagonals(p) + 28.0, word = sizeof(double);
  double entries = 21.0 * entries_of(p), borders = 2.0 * p->coordinates * 3.0;
  double bands = 3.0 * word * n * k, vectors = word * (28.0 * n + 14.0 * p->rows);
  double columns = word * n * (borders + 32.0);
  ambulo_memory memory;
  memory.problem = ambulo__row_bytes(p, p->rows) + 400.0 * p->nodes;
  memory.evaluation = ambulo__workspace_bytes(p, 1);
  double engine = memory.evaluation + bands + entries + vectors + columns;
  double coarse = coarse_share * (engine + memory.problem);
  int samples = ambulo__dense_samples(p, ambulo_options_default().dense_samples);
  double values = ambulo__workspace_bytes(p, 0) - ambulo__slope_bytes(p);
  double dense = samples < 2 ? 0.0 : samples * (memory.problem + values);
  double explanation = 2.0 / 3.0 * bands + entries + columns;
  double after = dense > explanation ? dense : explanation;
  memory.solve = margin * (memory.problem + engine + (coarse > after ? coarse : after));
  return memory;
}

ambulo_status ambulo__solve_check_memory(const ambulo_problem *p, const ambulo_options *o,
                                         ambulo_diagnostics *diagnostics) {
  double most = o->maximum_memory, bytes = ambulo_problem_memory(p).solve;
  const char *what = "solver.maximum_memory";
  if (isnan(most)) {
    most = 1048576.0 * ambulo__free_megabytes();
    what = "free";
  }
  if (most == 0.0 || bytes <= most) return AMBULO_OK;
  return ambulo__error(
      diagnostics, AMBULO_E_LIMIT, ambulo__nowhere,
      "lower trajectory.intervals or time.intervals, or raise solver.maximum_memory",
      "the solve takes about %.3g GB (%d unknowns, %d diagonals, %d rows); expected "
      "at most %.3g GB (%s)",
      bytes / gigabyte, p->variables, ambulo__metric_diagonals(p) + 1, p->rows, most / gigabyte,
      what);
}
