/* retarget/source.c - see source.h: memory of a given motion; tables of angles. */
#include "retarget/source.h"

#include "formats/motion_file.h"
#include "model/model.h"

#include <math.h>

void ambulo__given_free(ambulo__given *given) {
  ambulo__free(&given->allocator, given->time);
  ambulo__free(&given->allocator, given->q);
  ambulo_model_free(given->own);
  ambulo__text_free(&given->text);
}

ambulo_status ambulo__given_rows(ambulo__given *given, int rows) {
  given->rows = rows;
  given->time = ambulo__alloc(&given->allocator, (size_t)rows, sizeof *given->time);
  given->q = ambulo__alloc(&given->allocator, (size_t)rows * (size_t)given->body->coordinate_count,
                           sizeof *given->q);
  return given->time && given->q ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* --------------------------------------------------------------- tables of angles */

/* fills the column of a coordinate; *found counts those that have one */
static ambulo_status take_coordinate(const ambulo__motion *table, const char *path, int c,
                                     ambulo_diagnostics *diagnostics, ambulo__given *given,
                                     int *found) {
  const ambulo_coordinate *about = &given->body->coordinates[c];
  int column = -1, d = given->body->coordinate_count;
  ambulo_status status =
      ambulo__motion_find(table, path, about->name, AMBULO__ORDER_VALUE, diagnostics, &column);
  if (status || column < 0) return status;
  double unit = table->in_degrees && about->type == AMBULO_REVOLUTE ? acos(-1.0) / 180.0 : 1.0;
  for (int k = 0; k < table->rows; k++)
    given->q[(size_t)k * (size_t)d + (size_t)c] =
        unit * table->values[(size_t)k * (size_t)table->columns + (size_t)column];
  ++*found;
  if (about->type == AMBULO_PRISMATIC) given->unplaced = 0;
  return AMBULO_OK;
}

ambulo_status ambulo__given_table(const char *path, ambulo_diagnostics *diagnostics,
                                  ambulo__given *given) {
  ambulo__motion *table = NULL;
  int found = 0;
  given->unplaced = 1;
  ambulo_status status = ambulo__motion_read(path, 1, &given->allocator, diagnostics, &table);
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
