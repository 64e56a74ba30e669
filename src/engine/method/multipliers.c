/* method/multipliers.c - see multipliers.h. */
#include "method/multipliers.h"

#include "problem/nlp.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---------------------------------------------------------------------- series */

enum { LABELS = 3, LABEL = 128 };

/* FNV-1a 64 of a label with its end */
static unsigned long long hash_label(unsigned long long hash, const char *label) {
  for (const char *c = label;; c++) {
    hash = (hash ^ (unsigned char)*c) * 1099511628211ULL;
    if (!*c) return hash;
  }
}

unsigned long long ambulo__multiplier_series(const char *family, const char *subject,
                                             const char *detail) {
  unsigned long long hash = 14695981039346656037ULL;
  return hash_label(hash_label(hash_label(hash, family), subject), detail);
}

/* words of labels that change places in the mirror; those of coordinates that turn over */
static const char *const sides[][2] = {{"left", "right"}, {"l", "r"}};
static const char *const bounds[][2] = {{"lower", "upper"}};

static const char *partner_of(const char *word, size_t length, const char *const (*pairs)[2],
                              int count) {
  for (int i = 0; i < count; i++) {
    for (int k = 0; k < 2; k++) {
      const char *one = pairs[i][k];
      if (strlen(one) == length && memcmp(one, word, length) == 0) return pairs[i][1 - k];
    }
  }
  return NULL;
}

/* the label with each word, between blanks and underscores, replaced by its partner */
static void replace_words(const char *label, const char *const (*pairs)[2], int count,
                          char out[LABEL]) {
  size_t used = 0;
  for (const char *c = label; *c && used + 1 < LABEL;) {
    size_t length = strcspn(c, " _");
    const char *partner = partner_of(c, length, pairs, count);
    const char *text = partner ? partner : c;
    size_t taken = partner ? strlen(partner) : length;
    for (size_t i = 0; i < taken && used + 1 < LABEL; i++) out[used++] = text[i];
    c += length;
    if (*c && used + 1 < LABEL) out[used++] = *c++;
  }
  out[used] = '\0';
}

/* the series of the row that is this one in the mirror: partners of coordinates are the model's,
 * with bounds changed where they turn over; names of feet, points and sides have it in their words
 */
static unsigned long long mirrored_series(const ambulo_model *model, const ambulo__table_row *row) {
  char subject[LABEL], detail[LABEL];
  int i = ambulo_model_find_coordinate(model, row->subject);
  const ambulo_coordinate *c = i >= 0 ? &model->coordinates[i] : NULL;
  if (c && c->mirror >= 0) {
    const char *const(*pairs)[2] = c->mirror_sign < 0.0 ? bounds : NULL;
    replace_words(row->detail, pairs, pairs ? 1 : 0, detail);
    return ambulo__multiplier_series(row->family, model->coordinates[c->mirror].name, detail);
  }
  int count = (int)(sizeof sides / sizeof *sides);
  replace_words(row->subject, sides, count, subject);
  replace_words(row->detail, sides, count, detail);
  return ambulo__multiplier_series(row->family, subject, detail);
}

/* ---------------------------------------------------------------------- memory */

ambulo_status ambulo__multipliers_allocate(int count, const ambulo_allocator *allocator,
                                           ambulo_multipliers **multipliers) {
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo_multipliers *m = ambulo__alloc(&a, 1, sizeof *m);
  if (!m) return AMBULO_E_MEMORY;
  m->allocator = a;
  m->periods = 1;
  m->row = ambulo__alloc(&a, count > 0 ? (size_t)count : 1, sizeof *m->row);
  if (!m->row) {
    ambulo_multipliers_free(m);
    return AMBULO_E_MEMORY;
  }
  m->count = count;
  *multipliers = m;
  return AMBULO_OK;
}

void ambulo_multipliers_free(ambulo_multipliers *m) {
  if (!m) return;
  ambulo_allocator a = m->allocator;
  ambulo__free(&a, m->row);
  ambulo__free(&a, m);
}

static int by_series_and_time(const void *a, const void *b) {
  const ambulo__multiplier *one = a, *other = b;
  if (one->series != other->series) return one->series < other->series ? -1 : 1;
  return (one->time > other->time) - (one->time < other->time);
}

void ambulo__multipliers_sort(ambulo_multipliers *m) {
  qsort(m->row, (size_t)m->count, sizeof *m->row, by_series_and_time);
}

/* ------------------------------------------------------------------ from a solve */

/* time that a row stands for, s */
static double time_of(const ambulo_problem *p, const ambulo__table_row *row) {
  return row->node < 0 ? 1.0 : p->quadrature[row->node];
}

void ambulo__multipliers_keep(const ambulo__engine *e, double *by_row) {
  const ambulo__sparse_rows *rows = &e->setup->rows->inequality;
  memset(by_row, 0, (size_t)e->setup->problem->rows * sizeof *by_row);
  for (int i = 0; i < rows->count; i++)
    by_row[rows->row[i]] = -rows->scale[i] * e->iterate.lambda[i] / e->setup->objective_scale;
}

void ambulo__multipliers_take(ambulo__engine *e, const double *by_row) {
  const ambulo__sparse_rows *rows = &e->setup->rows->inequality;
  for (int i = 0; i < rows->count; i++)
    e->iterate.lambda[i] = by_row[rows->row[i]] * e->setup->objective_scale / -rows->scale[i];
}

ambulo_status ambulo__multipliers_create(const ambulo_problem *p, const double *by_row,
                                         double objective, const ambulo_allocator *allocator,
                                         ambulo_multipliers **multipliers) {
  int count = 0;
  for (int r = 0; r < p->rows; r++) count += p->table.rows[r].relation == AMBULO_NOT_NEGATIVE;
  ambulo_multipliers *m = NULL;
  ambulo_status status = ambulo__multipliers_allocate(count, allocator, &m);
  if (status) return status;
  double duration = p->definition.duration;
  m->objective = objective;
  for (int k = 0; k + 1 < p->nodes; k++)
    m->interval = fmax(m->interval, (p->times[k + 1] - p->times[k]) / duration);
  for (int r = 0, i = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    if (row->relation != AMBULO_NOT_NEGATIVE) continue;
    m->row[i++] =
        (ambulo__multiplier){ambulo__multiplier_series(row->family, row->subject, row->detail),
                             row->time / duration, by_row[r] / time_of(p, row)};
  }
  ambulo__multipliers_sort(m);
  *multipliers = m;
  return AMBULO_OK;
}

ambulo_status ambulo__multipliers_save(const ambulo__engine *e, const ambulo_allocator *allocator,
                                       ambulo_multipliers **multipliers) {
  const ambulo_problem *p = e->setup->problem;
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  double *by_row = ambulo__alloc(&a, (size_t)p->rows, sizeof *by_row);
  if (!by_row) return AMBULO_E_MEMORY;
  ambulo__multipliers_keep(e, by_row);
  double objective = e->reached.objective / e->setup->objective_scale;
  ambulo_status status = ambulo__multipliers_create(p, by_row, objective, allocator, multipliers);
  ambulo__free(&a, by_row);
  return status;
}

void ambulo__multipliers_shift(ambulo_multipliers *m, double share) {
  for (int i = 0; i < m->count; i++) m->row[i].time -= share;
}

/* ------------------------------------------------------------------ to a solve */

/* the first row that is not before this one */
static int find(const ambulo_multipliers *m, const ambulo__multiplier *wanted) {
  int low = 0, high = m->count;
  while (low < high) {
    int middle = low + (high - low) / 2;
    if (by_series_and_time(&m->row[middle], wanted) < 0) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

/* of rows next to each other: linear between them; of one alone: constant for half an interval */
static double density_at(const ambulo_multipliers *m, unsigned long long series, double time) {
  const ambulo__multiplier wanted = {series, time, 0.0};
  int after = find(m, &wanted), before = after - 1;
  int has_after = after < m->count && m->row[after].series == series;
  int has_before = before >= 0 && m->row[before].series == series;
  const ambulo__multiplier *b = has_before ? &m->row[before] : NULL;
  const ambulo__multiplier *a = has_after ? &m->row[after] : NULL;
  if (a && b && a->time - b->time < 1.5 * m->interval)
    return b->density + (a->density - b->density) * (time - b->time) / (a->time - b->time);
  double reach = 0.5 * m->interval * (1.0 + 1e-9);
  if (a && a->time - time <= reach) return a->density;
  return b && time - b->time <= reach ? b->density : 0.0;
}

/* the row in the period that its time is in */
static double density_of(const ambulo_multipliers *m, const ambulo_problem *p,
                         const ambulo__table_row *row) {
  double time = row->time / p->definition.duration * m->periods;
  double period = fmin(floor(time), m->periods - 1.0);
  int turned = m->mirrored && fmod(period, 2.0) == 1.0;
  unsigned long long series =
      turned ? mirrored_series(p->model, row)
             : ambulo__multiplier_series(row->family, row->subject, row->detail);
  return density_at(m, series, time - period);
}

/* (P.13) densities times w_k of this grid */
void ambulo__multipliers_transfer(const ambulo_multipliers *m, ambulo__engine *e) {
  if (!m) return;
  const ambulo_problem *p = e->setup->problem;
  const ambulo__sparse_rows *rows = &e->setup->rows->inequality;
  for (int i = 0; i < rows->count; i++) {
    const ambulo__table_row *row = &p->table.rows[rows->row[i]];
    double multiplier = time_of(p, row) * density_of(m, p, row);
    e->iterate.lambda[i] = fmax(0.0, e->setup->objective_scale * multiplier / -rows->scale[i]);
  }
  e->iterate.carried_objective = fabs(m->objective) * m->periods;
}
