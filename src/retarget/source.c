/* retarget/source.c - see source.h; tables of angles. */
#include "retarget/source.h"

#include "formats/motion_file.h"
#include "model/model.h"

#include <math.h>
#include <string.h>

void ambulo__given_free(ambulo__given *given) {
  ambulo__free(&given->allocator, given->time);
  ambulo__free(&given->allocator, given->q);
  ambulo_model_free(given->own);
  ambulo__text_free(&given->text);
}

ambulo_status ambulo__given_rows(ambulo__given *given, int rows) {
  given->rows = rows;
  given->time = ambulo__alloc(&given->allocator, (size_t)rows, sizeof *given->time);
  given->q = ambulo__alloc(&given->allocator,
                           (size_t)rows * (size_t)given->body->coordinate_count, sizeof *given->q);
  return given->time && given->q ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* --------------------------------------------------------------- tables of angles */

/* fills the column of a coordinate; *found counts those that have one */
static ambulo_status take_coordinate(const ambulo__motion *table, const char *path, int c,
                                     ambulo_diagnostics *diagnostics, ambulo__given *given,
                                     int *found) {
  const ambulo_coordinate *about = &given->body->coordinates[c];
  int column = -1, d = given->body->coordinate_count;
  ambulo_status status = ambulo__motion_find(table, path, about->name, AMBULO__ORDER_VALUE,
                                             diagnostics, &column);
  if (status || column < 0) return status;
  double unit = table->in_degrees && about->type == AMBULO_REVOLUTE ? acos(-1.0) / 180.0 : 1.0;
  for (int k = 0; k < table->rows; k++)
    given->q[(size_t)k * (size_t)d + (size_t)c] =
        unit * table->values[(size_t)k * (size_t)table->columns + (size_t)column];
  ++*found;
  return AMBULO_OK;
}

static ambulo_status read_table(const char *path, ambulo_diagnostics *diagnostics,
                                ambulo__given *given) {
  ambulo__motion *table = NULL;
  int found = 0;
  ambulo_status status =
      ambulo__motion_read(path, 1, &given->allocator, diagnostics, &table);
  if (!status) status = ambulo__given_rows(given, table->rows);
  for (int k = 0; !status && k < table->rows; k++) given->time[k] = table->time[k];
  for (int c = 0; !status && c < given->body->coordinate_count; c++)
    status = take_coordinate(table, path, c, diagnostics, given, &found);
  if (!status && found == 0)
    status = ambulo__error(diagnostics, AMBULO_E_SCHEMA, (ambulo__place){.file = path},
                           "--body MODEL.yaml is the body that it moves",
                           "no column is named after a coordinate of model '%s'; expected for "
                           "example '%s'",
                           given->body->name, given->body->coordinates[0].name);
  ambulo__motion_free(table);
  return status;
}

/* ---------------------------------------------------------------------------- part */

/* rows in [from, to], from time 0 on; a belt that runs backward adds to the way */
static ambulo_status cut(const char *path, const ambulo_retarget_options *o,
                         ambulo_diagnostics *diagnostics, ambulo__given *given) {
  enum { FEWEST = 8 };
  size_t d = (size_t)given->body->coordinate_count, first = 0, last = (size_t)given->rows;
  while (first < last && given->time[first] < o->from - 1e-9) first++;
  while (last > first && given->time[last - 1] > o->to + 1e-9) last--;
  if (last - first < FEWEST)
    return ambulo__error(diagnostics, AMBULO_E_SCHEMA, (ambulo__place){.file = path},
                         "--from and --to choose a part",
                         "%zu rows are left of the motion; expected at least %d", last - first,
                         FEWEST);
  double start = given->time[first];
  for (size_t k = first; k < last; k++) given->time[k - first] = given->time[k] - start;
  memmove(given->q, given->q + first * d, (last - first) * d * sizeof *given->q);
  given->rows = (int)(last - first);
  if (!isfinite(given->time[given->rows - 1])) return AMBULO_E_SCHEMA;
  for (size_t at = 0; at < (size_t)given->rows * d; at++)
    if (!isfinite(given->q[at]))
      return ambulo__error(diagnostics, AMBULO_E_SCHEMA, (ambulo__place){.file = path},
                           "--from and --to choose a part without gaps",
                           "'%s' has no value at %g s", given->body->coordinates[at % d].name,
                           given->time[at / d] + start);
  return AMBULO_OK;
}

ambulo_status ambulo__given_read(const char *path, const ambulo_retarget_options *options,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo__given *given) {
  ambulo__given g = {.allocator = ambulo__allocator_or_default(allocator), .body = options->body};
  ambulo__text_init(&g.text, &g.allocator);
  ambulo_status status = g.body ? read_table(path, diagnostics, &g)
                                : ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere,
                                                NULL, "a table of angles needs the body it moves");
  if (!status) status = cut(path, options, diagnostics, &g);
  if (status)
    ambulo__given_free(&g);
  else
    *given = g;
  return status;
}
