/* people/compare_samples.c - expressions over the columns of motion.csv (compare_map.h). */
#include "people/compare_cycle.h"

#include <string.h>

enum { NAME_SIZE = 256 };

static const char *const feet[] = {"left", "right"};

/* copies from[0..length) and puts the side in place of {side} and {foot}; 0 if it is too long */
static int expand(const char *from, size_t length, ambulo__cycle_side side, char name[NAME_SIZE]) {
  size_t used = 0, i = 0;
  while (i < length) {
    char letter[2] = {from[i], '\0'};
    const char *piece = letter;
    size_t step = 1;
    if (length - i >= 6 && memcmp(from + i, "{side}", 6) == 0) {
      letter[0] = side == AMBULO__CYCLE_LEFT ? 'l' : 'r';
      step = 6;
    } else if (length - i >= 6 && memcmp(from + i, "{foot}", 6) == 0) {
      piece = feet[side];
      step = 6;
    }
    size_t size = strlen(piece);
    if (used + size >= NAME_SIZE) return 0;
    memcpy(name + used, piece, size);
    used += size;
    i += step;
  }
  name[used] = '\0';
  return 1;
}

/* the same of a person's own motion */
static void take_of_subject(const ambulo__motion *table, const char *name, double factor,
                            int product, double *values, int *found) {
  int column = ambulo__motion_column(table, name);
  *found = column >= 0;
  for (int k = 0; *found && k < table->rows; k++) {
    double value = table->values[(size_t)k * (size_t)table->columns + (size_t)column];
    values[k] = product ? values[k] * value : values[k] + factor * value;
  }
}

/* values += factor * column (or *= when product); 0 in *found if there is no such column */
static ambulo_status take_column(ambulo__cycle *c, const char *name, double factor, int product,
                                 double *values, int *found) {
  int column = -1;
  if (c->subject) {
    take_of_subject(c->subject->table, name, factor, product, values, found);
    return AMBULO_OK;
  }
  ambulo_status status = ambulo__sheet_find_one(&c->sheet, 0, name, c->diagnostics, &column);
  if (status) return status;
  *found = column >= 0;
  for (int k = 0; *found && k < c->rows; k++) {
    double value;
    status = ambulo__sheet_number(&c->sheet, k + 1, column, name, c->diagnostics, &value);
    if (status) return status;
    values[k] = product ? values[k] * value : values[k] + factor * value;
  }
  return AMBULO_OK;
}

/* grf.FOOT.up, grf.FOOT.forward: name ends with `direction` */
static ambulo_status take_component(ambulo__cycle *c, char *name, const char *direction,
                                    double *values, int *found) {
  const double *axis = strcmp(direction, "up") == 0 ? c->up : c->forward;
  char *end = name + strlen(name) - strlen(direction);
  for (int i = 0; i < 3; i++) {
    end[0] = "xyz"[i];
    end[1] = '\0';
    ambulo_status status = take_column(c, name, axis[i], 0, values, found);
    if (status || !*found) return status;
  }
  return AMBULO_OK;
}

/* power.NAME = tau.NAME qd.NAME; scratch [rows] */
static ambulo_status take_power(ambulo__cycle *c, const char *name, double *scratch, double *values,
                                int *found) {
  char column[NAME_SIZE + 8];
  const char *coordinate = name + strlen("power.");
  memset(scratch, 0, (size_t)c->rows * sizeof *scratch);
  memcpy(column, "tau.", 5);
  memcpy(column + 4, coordinate, strlen(coordinate) + 1);
  ambulo_status status = take_column(c, column, 1.0, 0, scratch, found);
  if (status || !*found) return status;
  memcpy(column, "qd.", 4);
  memcpy(column + 3, coordinate, strlen(coordinate) + 1);
  status = take_column(c, column, 1.0, 1, scratch, found);
  for (int k = 0; !status && *found && k < c->rows; k++) values[k] += scratch[k];
  return status;
}

static int ends_with(const char *text, const char *end) {
  size_t length = strlen(text), size = strlen(end);
  return length >= size && strcmp(text + length - size, end) == 0;
}

ambulo_status ambulo__cycle_samples(ambulo__cycle *c, const char *expression,
                                    ambulo__cycle_side side, double *values, int *found) {
  double *scratch = c->scratch + 3 * (size_t)c->rows;
  int any = 0;
  memset(values, 0, (size_t)c->rows * sizeof *values);
  for (const char *at = expression; at;) {
    const char *plus = strchr(at, '+');
    size_t length = plus ? (size_t)(plus - at) : strlen(at);
    char name[NAME_SIZE];
    int has = 0;
    ambulo_status status = AMBULO_OK;
    if (expand(at, length, side, name)) {
      int force = strncmp(name, "grf.", 4) == 0;
      if (force && ends_with(name, ".up")) {
        status = take_component(c, name, "up", values, &has);
      } else if (force && ends_with(name, ".forward")) {
        status = take_component(c, name, "forward", values, &has);
      } else if (strncmp(name, "power.", 6) == 0) {
        status = take_power(c, name, scratch, values, &has);
      } else {
        status = take_column(c, name, 1.0, 0, values, &has);
      }
    }
    if (status) return status;
    any |= has;
    at = plus ? plus + 1 : NULL;
  }
  *found = any;
  return AMBULO_OK;
}
