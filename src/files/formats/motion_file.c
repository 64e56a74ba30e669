/* formats/motion_file.c - the table of motion_file.h: memory, names, units. */
#include "formats/motion_file.h"

#include <math.h>
#include <string.h>
#include <strings.h>

ambulo_status ambulo__motion_create(int rows, int columns, const char *const *names,
                                    const ambulo_allocator *allocator, ambulo__motion **motion) {
  if (rows < 0 || columns < 0 || (columns > 0 && !names) || !motion) return AMBULO_E_ARGUMENT;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__motion *m = ambulo__alloc(&own, 1, sizeof *m);
  if (!m) return AMBULO_E_MEMORY;
  m->allocator = own;
  m->rows = rows;
  m->columns = columns;
  m->declared_columns = -1;
  m->body_mass = (double)NAN;
  m->time = ambulo__alloc(&own, (size_t)rows, sizeof *m->time);
  m->values = ambulo__alloc(&own, (size_t)rows * (size_t)columns, sizeof *m->values);
  m->names = ambulo__alloc(&own, (size_t)columns, sizeof *m->names);
  int complete = m->time && m->values && m->names;
  for (int c = 0; complete && c < columns; c++) {
    m->names[c] = ambulo__strdup(&own, names[c]);
    complete = m->names[c] != NULL;
  }
  if (!complete) {
    ambulo__motion_free(m);
    return AMBULO_E_MEMORY;
  }
  *motion = m;
  return AMBULO_OK;
}

void ambulo__motion_free(ambulo__motion *motion) {
  if (!motion) return;
  ambulo_allocator allocator = motion->allocator;
  for (int c = 0; motion->names && c < motion->columns; c++) {
    ambulo__free(&allocator, motion->names[c]);
  }
  ambulo__free(&allocator, motion->names);
  ambulo__free(&allocator, motion->time);
  ambulo__free(&allocator, motion->values);
  ambulo__free(&allocator, motion);
}

ambulo__motion_format ambulo__motion_format_of(const char *name) {
  const char *dot = strrchr(name, '.');
  if (!dot) return AMBULO__MOTION_AUTO;
  if (strcasecmp(dot, ".csv") == 0) return AMBULO__MOTION_CSV;
  if (strcasecmp(dot, ".sto") == 0 || strcasecmp(dot, ".mot") == 0) return AMBULO__MOTION_STO;
  return AMBULO__MOTION_AUTO;
}

int ambulo__motion_column(const ambulo__motion *motion, const char *name) {
  for (int c = 0; c < motion->columns; c++) {
    if (strcmp(motion->names[c], name) == 0) return c;
  }
  return -1;
}

void ambulo__motion_to_radians(ambulo__motion *motion, const unsigned char *is_angle) {
  if (!motion->in_degrees) return;
  const double radian = 3.14159265358979323846 / 180.0;
  for (int r = 0; r < motion->rows; r++) {
    double *row = motion->values + (size_t)r * (size_t)motion->columns;
    for (int c = 0; c < motion->columns; c++) {
      if (is_angle[c]) row[c] *= radian;
    }
  }
  motion->in_degrees = 0;
}
