/* definitions/model_numbers.c - numbers of a model file: by sex, in the file's units; references.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "definitions/model_reader.h"
#include "ambulo/tools/load.h"

static int is_none(const ambulo__yaml_node *node) {
  return ambulo__yaml_is(node, AMBULO__YAML_SCALAR) && strcmp(ambulo__yaml_text(node), "none") == 0;
}

/* The value for the other sex is read by nobody, and must be of the same shape all the same: a
 * fault in it would show only for another subject. */
static void check_other(const ambulo__yaml_node *chosen, const ambulo__yaml_node *other) {
  if (ambulo__yaml_is(other, AMBULO__YAML_MAPPING)) { /* by sex once more, as an item may be */
    check_other(chosen, ambulo__yaml_require(other, "female"));
    check_other(chosen, ambulo__yaml_require(other, "male"));
    ambulo__yaml_close(other);
    return;
  }
  if (!ambulo__yaml_is(chosen, AMBULO__YAML_SEQUENCE)) {
    if (!is_none(other)) (void)ambulo__yaml_number(other, 0.0);
    return;
  }
  int count = ambulo__yaml_items(chosen), others = ambulo__yaml_items(other);
  if (ambulo__yaml_is(other, AMBULO__YAML_SEQUENCE) && others != count)
    (void)ambulo__yaml_error(other, AMBULO_E_SCHEMA, NULL,
                             "got a sequence of %d; expected %d, as for the other sex", others,
                             count);
  for (int i = 0; i < count; i++)
    check_other(ambulo__yaml_item(chosen, i), ambulo__yaml_item(other, i));
}

const ambulo__yaml_node *ambulo__by_sex(ambulo__reader *reader, const ambulo__yaml_node *node) {
  if (!ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) return node;
  const ambulo__yaml_node *female = ambulo__yaml_require(node, "female");
  const ambulo__yaml_node *male = ambulo__yaml_require(node, "male");
  ambulo__yaml_close(node);
  if (reader->subject.sex == AMBULO_SEX_NOT_SET) {
    ambulo__yaml_error(node, AMBULO_E_SCHEMA, "add it to `subject`",
                       "a value differs by sex, but the subject has none; expected subject.sex");
    return NULL;
  }
  int is_female = reader->subject.sex == AMBULO_FEMALE;
  check_other(is_female ? female : male, is_female ? male : female);
  return is_female ? female : male;
}

double ambulo__read_scaled(ambulo__reader *reader, const ambulo__yaml_node *node, double factor,
                           double fallback) {
  double value = ambulo__yaml_number(ambulo__by_sex(reader, node), NAN);
  return isnan(value) ? fallback : value * factor;
}

static int is_sequence_of(const ambulo__yaml_node *node, int count) {
  if (ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) && ambulo__yaml_items(node) == count) {
    return 1;
  }
  double unused[8];
  (void)ambulo__yaml_numbers(node, count, unused); /* says what is wrong */
  return 0;
}

int ambulo__read_vector(ambulo__reader *reader, const ambulo__yaml_node *node, int count,
                        double factor, double *values) {
  enum { MOST = 8 };
  double read[MOST];
  int good = 1;
  const ambulo__yaml_node *list = ambulo__by_sex(reader, node);
  if (!list || count > MOST || !is_sequence_of(list, count)) return 0;
  for (int i = 0; i < count; i++) {
    read[i] = ambulo__read_scaled(reader, ambulo__yaml_item(list, i), factor, NAN);
    good &= !isnan(read[i]);
  }
  if (good) memcpy(values, read, (size_t)count * sizeof *values);
  return good;
}

/* 6.2832 is a full turn; anatomical angles beyond it are degrees */
static void warn_of_degrees(ambulo__reader *reader, const ambulo__yaml_node *node, double value,
                            double unit) {
  if (unit != 1 || reader->warned_of_degrees || fabs(value) <= 6.2832) return;
  reader->warned_of_degrees = 1;
  ambulo__yaml_warning(node, "degrees are declared by `units: {angle: degrees}`",
                       "an angle of more than a full turn (got %s radians)",
                       ambulo__number_text(value).text);
}

double ambulo__read_angle(ambulo__reader *reader, const ambulo__yaml_node *node, double unit) {
  double value = ambulo__read_scaled(reader, node, 1, 0);
  warn_of_degrees(reader, node, value, unit);
  return value * unit;
}

void ambulo__read_interval(ambulo__reader *reader, const ambulo__yaml_node *node, double factor,
                           int is_angle, double interval[2]) {
  const ambulo__yaml_node *list = ambulo__by_sex(reader, node);
  if (!list || !is_sequence_of(list, 2)) return;
  for (int i = 0; i < 2; i++) {
    const ambulo__yaml_node *item = ambulo__by_sex(reader, ambulo__yaml_item(list, i));
    if (is_none(item)) {
      interval[i] = i == 0 ? -INFINITY : INFINITY;
      continue;
    }
    double value = ambulo__yaml_number(item, 0);
    if (is_angle) warn_of_degrees(reader, node, value, factor);
    interval[i] = value * factor;
  }
}

int ambulo__read_reference(const ambulo__yaml_node *node, const char *kind,
                           const char *const *names, int count) {
  const char *name = ambulo__yaml_text(node);
  if (!name[0]) return -1;
  for (int i = 0; i < count; i++) {
    if (strcmp(names[i], name) == 0) return i;
  }
  char hint[128];
  const char *nearest = ambulo__nearest(name, names, (size_t)count);
  if (nearest) (void)snprintf(hint, sizeof hint, "did you mean '%.80s'?", nearest);
  (void)ambulo__yaml_error(node, AMBULO_E_MODEL, nearest ? hint : NULL,
                           "unknown %s (got '%.80s'); expected the name of a %s of this model",
                           kind, name, kind);
  return -1;
}

int ambulo__read_count(ambulo__reader *reader, const ambulo__yaml_node *list, const char *what,
                       int limit, int *count) {
  (void)reader;
  *count = 0;
  if (!list) return 1;
  if (!ambulo__yaml_is(list, AMBULO__YAML_SEQUENCE)) {
    (void)ambulo__yaml_error(list, AMBULO_E_SCHEMA, NULL, "`%s` is not a list; expected a list",
                             what);
    return 0;
  }
  int items = ambulo__yaml_items(list);
  if (items > limit) {
    (void)ambulo__yaml_error(list, AMBULO_E_LIMIT, NULL,
                             "too many %s (got %d); expected at most %d", what, items, limit);
    return 0;
  }
  *count = items;
  return 1;
}
