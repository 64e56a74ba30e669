/* people/compare_expression.c - results of a column map: expressions over columns of motion.csv and
 * muscles.csv (compare.h). */
#include "people/compare.h"

#include "formats/yaml_node.h"

#include <math.h>
#include <stdio.h>
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
  const ambulo__sheet *sheet = &c->sheet;
  ambulo_status status = ambulo__sheet_find_one(sheet, 0, name, c->diagnostics, &column);
  if (!status && column < 0 && c->muscles.line_count > 0) {
    sheet = &c->muscles;
    status = ambulo__sheet_find_one(sheet, 0, name, c->diagnostics, &column);
  }
  if (status) return status;
  *found = column >= 0;
  for (int k = 0; *found && k < c->rows; k++) {
    double value;
    status = ambulo__sheet_number(sheet, k + 1, column, name, c->diagnostics, &value);
    if (status) return status;
    values[k] = product ? values[k] * value : values[k] + factor * value;
  }
  return AMBULO_OK;
}

/* grf.FOOT.up, grf.FOOT.forward, grf.FOOT.right: name ends with `direction` */
static ambulo_status take_component(ambulo__cycle *c, char *name, const char *direction,
                                    double *values, int *found) {
  const double *f = c->forward, *u = c->up;
  const double right[3] = {f[1] * u[2] - f[2] * u[1], f[2] * u[0] - f[0] * u[2],
                           f[0] * u[1] - f[1] * u[0]};
  const double *axis = direction[0] == 'u' ? u : direction[0] == 'f' ? f : right;
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

/* size.NAME: of NAME.x, NAME.y, NAME.z; scratch [rows], and a row before it */
static ambulo_status take_size(ambulo__cycle *c, const char *name, double *scratch, double *values,
                               int *found) {
  char column[NAME_SIZE + 2];
  double *size = scratch - c->rows;
  ambulo_status status = AMBULO_OK;
  *found = 1;
  memset(size, 0, (size_t)c->rows * sizeof *size);
  for (int i = 0; i < 3 && !status && *found; i++) {
    (void)snprintf(column, sizeof column, "%s.%c", name + strlen("size."), "xyz"[i]);
    memset(scratch, 0, (size_t)c->rows * sizeof *scratch);
    status = take_column(c, column, 1.0, 0, scratch, found);
    for (int k = 0; k < c->rows; k++) size[k] = hypot(size[k], scratch[k]);
  }
  for (int k = 0; !status && *found && k < c->rows; k++) values[k] += size[k];
  return status;
}

/* of a force along an axis of the body; NULL: another column */
static const char *direction_of(const char *name) {
  static const char *const directions[] = {"up", "forward", "right"};
  const char *dot = strrchr(name, '.');
  for (int i = 0; strncmp(name, "grf.", 4) == 0 && i < 3; i++)
    if (strcmp(dot + 1, directions[i]) == 0) return directions[i];
  return NULL;
}

/* joints that the body calls or counts otherwise than people do */
void ambulo__cycle_take_joints(ambulo__cycle *c, const ambulo__yaml_node *joints) {
  int count = joints ? ambulo__yaml_pairs(joints) : 0;
  for (int i = 0; i < count && c->joint_count < AMBULO__BODY_JOINTS; i++) {
    const ambulo__yaml_node *node = ambulo__yaml_value(joints, i);
    ambulo__cycle_joint *joint = &c->joint[c->joint_count++];
    (void)snprintf(joint->name, sizeof joint->name, "%.*s", AMBULO__JOINT_NAME - 1,
                   ambulo__yaml_key(joints, i));
    (void)snprintf(joint->coordinate, sizeof joint->coordinate, "%.*s", AMBULO__MOTION_MAX_NAME,
                   ambulo__yaml_text(ambulo__yaml_get(node, "coordinate")));
    joint->sign = ambulo__yaml_number(ambulo__yaml_get(node, "sign"), 1.0) < 0.0 ? -1 : 1;
  }
}

/* q.JOINT, tau.JOINT, power.JOINT of a person become those of the body; returns the sign */
static double translate(const ambulo__cycle *c, char name[NAME_SIZE]) {
  const char *dot = strchr(name, '.');
  for (int i = 0; dot && i < c->joint_count; i++) {
    const ambulo__cycle_joint *joint = &c->joint[i];
    if (strcmp(dot + 1, joint->name) != 0) continue;
    char own[NAME_SIZE];
    int power = strncmp(name, "power.", 6) == 0;
    int length = snprintf(own, sizeof own, "%.*s.%s", (int)(dot - name), name, joint->coordinate);
    if (length < NAME_SIZE) memcpy(name, own, (size_t)length + 1);
    return power ? 1.0 : joint->sign;
  }
  return 1.0;
}

ambulo_status ambulo__cycle_samples(ambulo__cycle *c, const char *expression, int by_body,
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
      double sign = by_body ? translate(c, name) : 1.0;
      const char *direction = direction_of(name);
      if (direction) {
        status = take_component(c, name, direction, values, &has);
      } else if (strncmp(name, "power.", 6) == 0) {
        status = take_power(c, name, scratch, values, &has);
      } else if (strncmp(name, "size.", 5) == 0) {
        status = take_size(c, name, scratch, values, &has);
      } else {
        status = take_column(c, name, sign, 0, values, &has);
      }
    }
    if (status) return status;
    any |= has;
    at = plus ? plus + 1 : NULL;
  }
  *found = any;
  return AMBULO_OK;
}
