/* exchange/xml_tree.c - what is asked of an XML tree: children, attributes, numbers (xml_tree.h).
 */
#include "exchange/xml_tree.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/numtext.h"

int ambulo__xml_is(const ambulo__xml_node *node, const char *name) {
  return node && strcmp(node->name, name) == 0;
}

static ambulo__xml_node *first_of(ambulo__xml_node *node, const char *name) {
  while (node && strcmp(node->name, name) != 0) node = node->next;
  return node;
}

ambulo__xml_node *ambulo__xml_child(const ambulo__xml_node *node, const char *name) {
  return node ? first_of(node->first, name) : NULL;
}

ambulo__xml_node *ambulo__xml_next(const ambulo__xml_node *node, const char *name) {
  return node ? first_of(node->next, name) : NULL;
}

const char *ambulo__xml_attribute(const ambulo__xml_node *node, const char *name) {
  for (const char **a = node ? node->attributes : NULL; a && a[0]; a += 2) {
    if (strcmp(a[0], name) == 0) return a[1];
  }
  return NULL;
}

ambulo__place ambulo__xml_place(const ambulo__xml_node *node) {
  if (!node) return ambulo__nowhere;
  return (ambulo__place){.file = node->file, .line = node->line, .column = node->column};
}

void ambulo__xml_error(ambulo__xml *xml, const ambulo__xml_node *node, ambulo_status status,
                       const char *hint, const char *format, ...) {
  char message[600];
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(message, sizeof message, format, arguments);
  va_end(arguments);
  (void)ambulo__error(xml->diagnostics, status, ambulo__xml_place(node), hint, "%s", message);
  if (!xml->status) xml->status = status;
}

/* ------------------------------------------------------------------- numbers */

/* "inf", "+Infinity", "-INF" */
static int is_infinite(const char *word, size_t length, double *value) {
  int sign = word[0] == '-' ? -1 : 1;
  size_t skip = word[0] == '-' || word[0] == '+';
  static const char *const names[] = {"inf", "infinity"};
  for (int i = 0; i < 2; i++) {
    if (length - skip != strlen(names[i]) || strncasecmp(word + skip, names[i], length - skip) != 0)
      continue;
    *value = sign < 0 ? -INFINITY : INFINITY;
    return 1;
  }
  return 0;
}

/* Numbers of programs may lack the digits before the point, or behind it: ".5", "5." */
static int read_number(const char *word, size_t length, int infinite, double *value) {
  char full[96];
  size_t used = 0;
  if (length == 0 || length > 80) return 0;
  if (infinite && is_infinite(word, length, value)) return 1;
  for (size_t i = 0; i < length; i++) {
    int digit_before = i > 0 && word[i - 1] >= '0' && word[i - 1] <= '9';
    int digit_behind = i + 1 < length && word[i + 1] >= '0' && word[i + 1] <= '9';
    if (word[i] == '.' && !digit_before && !digit_behind) return 0;
    if (word[i] == '.' && !digit_before) full[used++] = '0';
    full[used++] = word[i];
    if (word[i] == '.' && !digit_behind) full[used++] = '0';
  }
  return ambulo__parse_double(full, used, value);
}

int ambulo__xml_numbers(ambulo__xml *xml, const ambulo__xml_node *node, const char *what,
                        const char *text, int most, int infinite, double *values) {
  static const char blanks[] = " \t\r\n,";
  int count = 0;
  for (text += strspn(text, blanks); *text; text += strspn(text, blanks)) {
    size_t length = strcspn(text, blanks);
    double value = 0.0;
    if (!read_number(text, length, infinite, &value)) {
      ambulo__xml_error(xml, node, AMBULO_E_SCHEMA, NULL,
                        "%s of <%s> is not a number (got '%.*s'); expected a finite number", what,
                        node->name, (int)(length > 40 ? 40 : length), text);
      return -1;
    }
    if (count < most) values[count] = value;
    count++;
    text += length;
  }
  return count;
}

static int exactly(ambulo__xml *xml, const ambulo__xml_node *node, const char *what,
                   const char *text, int count, int infinite, double *values) {
  enum { MOST = 16 };
  double read[MOST];
  int got = ambulo__xml_numbers(xml, node, what, text, MOST, infinite, read);
  if (got < 0) return 0;
  if (got != count) {
    ambulo__xml_error(xml, node, AMBULO_E_SCHEMA, NULL, "%s of <%s> has %d numbers; expected %d",
                      what, node->name, got, count);
    return 0;
  }
  memcpy(values, read, (size_t)count * sizeof *values);
  return 1;
}

int ambulo__xml_vector(ambulo__xml *xml, const ambulo__xml_node *node, const char *attribute,
                       int count, double *values) {
  const char *text = ambulo__xml_attribute(node, attribute);
  return text ? exactly(xml, node, attribute, text, count, 0, values) : 0;
}

int ambulo__xml_child_vector(ambulo__xml *xml, const ambulo__xml_node *node, const char *child,
                             int count, int infinite, double *values) {
  const ambulo__xml_node *item = ambulo__xml_child(node, child);
  if (!item || !item->text[0]) return 0;
  return exactly(xml, item, "the text", item->text, count, infinite, values);
}

int ambulo__xml_choice(ambulo__xml *xml, const ambulo__xml_node *node, const char *what,
                       const char *text, const char *const *words, int count) {
  for (int i = 0; i < count; i++) {
    if (strcmp(text, words[i]) == 0) return i;
  }
  char list[400] = "", hint[100];
  for (int i = 0; i < count; i++) {
    size_t used = strlen(list);
    (void)snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", words[i]);
  }
  const char *nearest = ambulo__nearest(text, words, (size_t)count);
  if (nearest) (void)snprintf(hint, sizeof hint, "did you mean '%s'?", nearest);
  ambulo__xml_error(xml, node, AMBULO_E_SCHEMA, nearest ? hint : NULL,
                    "unknown %s (got '%.60s'); expected one of %s", what, text, list);
  return -1;
}
