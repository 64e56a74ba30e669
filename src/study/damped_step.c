/* study/damped_step.c - see damped_step.h.
 *
 * The sum of squares is written as one least-squares problem, J above two diagonal blocks, and
 * solved by QR: forming J'J would square its condition. */
#include "study/damped_step.h"
#include "base/lapack.h"

#include <math.h>
#include <string.h>

enum { BLOCK = 64 };

static double trace(const ambulo__damped_system *s) {
  double sum = 0.0;
  size_t count = (size_t)s->residuals * (size_t)s->parameters;
  for (size_t i = 0; i < count; i++) sum += s->jacobian[i] * s->jacobian[i];
  return sum;
}

/* fills a [rows][columns] and b [rows]: J, sqrt(ridge) I, sqrt(damping) I over the free ones */
static void fill(const ambulo__damped_system *s, double damping, int rows, double *a, double *b) {
  int m = s->residuals, column = 0, free_count = (rows - m) / 2;
  double ridge = sqrt(s->ridge), damp = sqrt(damping);
  for (int k = 0; k < m; k++) b[k] = -s->residual[k];
  for (int i = 0; i < s->parameters; i++) {
    if (!s->is_free[i]) continue;
    double *to = a + (size_t)column * (size_t)rows;
    memcpy(to, s->jacobian + (size_t)i * (size_t)m, (size_t)m * sizeof *to);
    to[m + column] = ridge;
    to[m + free_count + column] = damp;
    b[m + column] = -ridge * s->u[i];
    column++;
  }
}

ambulo_status ambulo__damped_step(const ambulo__damped_system *s, double damping,
                                  const ambulo_allocator *allocator, double *d) {
  int columns = 0, one = 1, info = 0;
  for (int i = 0; i < s->parameters; i++) columns += s->is_free[i] != 0;
  memset(d, 0, (size_t)s->parameters * sizeof *d);
  if (columns == 0) return AMBULO_OK;
  int rows = s->residuals + 2 * columns, work_size = columns * (BLOCK + 1);
  double *a = ambulo__alloc(allocator, (size_t)rows * (size_t)columns, sizeof *a);
  double *b = ambulo__alloc(allocator, (size_t)rows, sizeof *b);
  double *work = ambulo__alloc(allocator, (size_t)work_size, sizeof *work);
  ambulo_status status = a && b && work ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) {
    fill(s, damping * trace(s) / (double)s->parameters, rows, a, b);
    dgels_("N", &rows, &columns, &one, a, &rows, b, &rows, work, &work_size, &info);
    if (info != 0) status = AMBULO_E_NUMERIC;
    for (int i = 0; i < columns && !status; i++)
      if (!isfinite(b[i])) status = AMBULO_E_NUMERIC;
  }
  for (int i = 0, column = 0; i < s->parameters && !status; i++)
    if (s->is_free[i]) d[i] = b[column++];
  ambulo__free(allocator, a);
  ambulo__free(allocator, b);
  ambulo__free(allocator, work);
  return status;
}
