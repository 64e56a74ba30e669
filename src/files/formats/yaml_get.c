/* formats/yaml_get.c - keys and typed values, with what was got and what was expected. */
#include "formats/yaml_tree.h"

#include "base/numtext.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_GOT = 80, MAX_LIST = 300 };

/* what stands at a node: "'1,5'", "the quoted text '1.5'", "a sequence of 3", "nothing" */
static const char *got(const ambulo__yaml_node *node, char buffer[MAX_GOT]) {
  if (node->kind == AMBULO__YAML_SEQUENCE) {
    (void)snprintf(buffer, MAX_GOT, "a sequence of %d", node->count);
  } else if (node->kind == AMBULO__YAML_MAPPING) {
    (void)snprintf(buffer, MAX_GOT, "a mapping");
  } else if (!node->quoted && node->text[0] == '\0') {
    (void)snprintf(buffer, MAX_GOT, "nothing");
  } else {
    int cut = strlen(node->text) > 40;
    (void)snprintf(buffer, MAX_GOT, "%s'%.40s%s'", node->quoted ? "the quoted text " : "",
                   node->text, cut ? "..." : "");
  }
  return buffer;
}

static void mismatch(const ambulo__yaml_node *node, const char *hint, const char *expected) {
  char text[MAX_GOT];
  ambulo__yaml_error(node, AMBULO_E_SCHEMA, hint, "got %s; expected %s", got(node, text), expected);
}

/* 0 when it is of another kind, with an error, once for a node; 0 for NULL, silently */
static int expect_kind(const ambulo__yaml_node *node, ambulo__yaml_kind kind) {
  if (!node || node->kind == kind) return node != NULL;
  if (node->document->wrong_kind != node)
    mismatch(node, NULL, kind == AMBULO__YAML_MAPPING ? "a mapping" : "a list");
  node->document->wrong_kind = node;
  return 0;
}

int ambulo__yaml_items(const ambulo__yaml_node *sequence) {
  return expect_kind(sequence, AMBULO__YAML_SEQUENCE) ? sequence->count : 0;
}

int ambulo__yaml_pairs(const ambulo__yaml_node *mapping) {
  return expect_kind(mapping, AMBULO__YAML_MAPPING) ? mapping->count : 0;
}

/* ------------------------------------------------------------------------ keys */

/* remembers that `key` may stand in `mapping`; without memory only a hint is lost */
static void mark(const ambulo__yaml_node *mapping, const char *key) {
  ambulo__yaml_marks *marks = mapping->marks;
  for (size_t i = 0; i < marks->count; i++)
    if (strcmp(marks->names[i], key) == 0) return;
  if (marks->count == marks->capacity) {
    size_t capacity = marks->capacity ? 2 * marks->capacity : 8;
    const char **names = ambulo__arena_take(&mapping->document->arena, capacity, sizeof *names);
    if (!names) return;
    if (marks->count > 0) memcpy(names, marks->names, marks->count * sizeof *names);
    marks->names = names;
    marks->capacity = capacity;
  }
  const char *copy = ambulo__arena_copy(&mapping->document->arena, key, strlen(key));
  if (copy) marks->names[marks->count++] = copy;
}

const ambulo__yaml_node *ambulo__yaml_get(const ambulo__yaml_node *mapping, const char *key) {
  if (!expect_kind(mapping, AMBULO__YAML_MAPPING)) return NULL;
  mark(mapping, key);
  ambulo__yaml_node *value = ambulo__yaml_find(mapping, key);
  if (value) value->key->known = 1;
  return value;
}

void ambulo__yaml_expect(const ambulo__yaml_node *mapping, const char *key) {
  (void)ambulo__yaml_get(mapping, key);
}

/* the name of what encloses a mapping: its own, or that of the item of a list it is part of */
static const ambulo__yaml_node *name_of(const ambulo__yaml_node *mapping) {
  for (const ambulo__yaml_node *node = mapping; node; node = node->parent) {
    const ambulo__yaml_node *name = ambulo__yaml_find(node, "name");
    if (name && name->kind == AMBULO__YAML_SCALAR && (node == mapping || node->parent)) return name;
  }
  return NULL;
}

/* "in links[2] ('shank')", "at the top level": how a message names a mapping */
static const char *describe(const ambulo__yaml_node *mapping, char *buffer, size_t size) {
  ambulo__place place = ambulo__yaml_place(mapping);
  const ambulo__yaml_node *name = name_of(mapping);
  const char *lead = place.path ? "in " : "at the top level";
  const char *path = place.path ? place.path : "";
  if (name) {
    (void)snprintf(buffer, size, "%s%s ('%.60s')", lead, path, name->text);
  } else {
    (void)snprintf(buffer, size, "%s%s", lead, path);
  }
  return buffer;
}

const ambulo__yaml_node *ambulo__yaml_require(const ambulo__yaml_node *mapping, const char *key) {
  const ambulo__yaml_node *value = ambulo__yaml_get(mapping, key);
  if (!value && expect_kind(mapping, AMBULO__YAML_MAPPING)) {
    char where[MAX_LIST];
    ambulo__yaml_error(mapping, AMBULO_E_SCHEMA, NULL, "missing required key '%s' %s", key,
                       describe(mapping, where, sizeof where));
  }
  return value;
}

/* "a, b, c", cut with "..." when too long */
static void join(char *buffer, size_t size, const char *const *words, size_t count) {
  size_t used = 0;
  buffer[0] = '\0';
  for (size_t i = 0; i < count; i++) {
    size_t length = strlen(words[i]);
    if (used + length + sizeof ", ..." >= size) {
      memcpy(buffer + used, "...", sizeof "...");
      return;
    }
    memcpy(buffer + used, words[i], length + 1);
    used += length;
    if (i + 1 < count) {
      memcpy(buffer + used, ", ", sizeof ", ");
      used += 2;
    }
  }
}

/* "did you mean 'mass'?", else the list of what is known; NULL when nothing is */
static const char *suggest(const char *word, const char *const *words, size_t count,
                           char buffer[MAX_LIST]) {
  if (count == 0) return NULL;
  const char *nearest = ambulo__nearest(word, words, count);
  if (nearest) {
    (void)snprintf(buffer, MAX_LIST, "did you mean '%s'?", nearest);
  } else {
    static const char lead[] = "known here: ";
    memcpy(buffer, lead, sizeof lead);
    join(buffer + sizeof lead - 1, MAX_LIST - sizeof lead, words, count);
  }
  return buffer;
}

void ambulo__yaml_close(const ambulo__yaml_node *mapping) {
  if (!expect_kind(mapping, AMBULO__YAML_MAPPING)) return;
  for (int i = 0; i < mapping->count; i++) {
    const ambulo__yaml_node *value = mapping->items[i];
    if (value->key->known) continue;
    char where[MAX_LIST], hint[MAX_LIST];
    ambulo__yaml_node at = *value;
    at.line = value->key->line;
    at.column = value->key->column;
    ambulo__yaml_error(
        &at, AMBULO_E_SCHEMA,
        suggest(value->key->text, mapping->marks->names, mapping->marks->count, hint),
        "unknown key '%.60s' %s", value->key->text, describe(mapping, where, sizeof where));
  }
}

/* ---------------------------------------------------------------------- values */

const char *ambulo__yaml_text(const ambulo__yaml_node *node) {
  if (!node) return "";
  if (node->kind == AMBULO__YAML_SCALAR && (node->quoted || node->text[0])) return node->text;
  mismatch(node, NULL, "a text");
  return "";
}

static int is_plain(const ambulo__yaml_node *node) {
  return node->kind == AMBULO__YAML_SCALAR && !node->quoted;
}

/* the words of YAML and of C for what is no finite number */
static int is_not_finite(const char *text) {
  static const char *const words[] = {"nan", "inf", "infinity", "NaN", "NAN", "Inf", "INF"};
  if (*text == '+' || *text == '-') text++;
  if (*text == '.') text++;
  for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
    if (strcmp(text, words[i]) == 0) return 1;
  return 0;
}

/* how to write what was probably meant; NULL: no idea */
static const char *number_hint(const ambulo__yaml_node *node) {
  double value;
  if (node->kind != AMBULO__YAML_SCALAR) return NULL;
  if (node->quoted)
    return ambulo__parse_double(node->text, strlen(node->text), &value)
               ? "numbers are written without quotes"
               : NULL;
  if (!strchr("+-.0123456789", node->text[0])) return NULL; /* a word */
  if (strchr(node->text, ',')) return "the decimal separator is a point";
  if (strchr(node->text, '_')) return "digits are not grouped";
  return NULL;
}

/* the plain number at a node, or an error that says what is wrong with it */
static int read_number(const ambulo__yaml_node *node, double *value) {
  if (is_plain(node)) {
    size_t length = strlen(node->text);
    if (ambulo__parse_double(node->text, length, value)) return 1;
    if (is_not_finite(node->text)) {
      mismatch(node, NULL, "a finite number");
      return 0;
    }
    if (ambulo__is_decimal(node->text, length)) {
      mismatch(node, NULL, "a finite number in the range of double precision");
      return 0;
    }
  }
  mismatch(node, number_hint(node), "a number");
  return 0;
}

double ambulo__yaml_number(const ambulo__yaml_node *node, double fallback) {
  double value;
  return node && read_number(node, &value) ? value : fallback;
}

double ambulo__yaml_number_in(const ambulo__yaml_node *node, double min, double max,
                              double fallback) {
  double value;
  if (!node || !read_number(node, &value)) return fallback;
  if (value >= min && value <= max) return value;
  const ambulo__number least = ambulo__number_text(min), most = ambulo__number_text(max);
  char expected[128];
  if (!isfinite(max)) {
    (void)snprintf(expected, sizeof expected, "a number of at least %s", least.text);
  } else if (!isfinite(min)) {
    (void)snprintf(expected, sizeof expected, "a number of at most %s", most.text);
  } else {
    (void)snprintf(expected, sizeof expected, "a number from %s to %s", least.text, most.text);
  }
  mismatch(node, NULL, expected);
  return fallback;
}

int ambulo__yaml_integer(const ambulo__yaml_node *node, int min, int max, int fallback) {
  if (!node) return fallback;
  long long value;
  if (is_plain(node) && ambulo__parse_integer(node->text, strlen(node->text), min, max, &value))
    return (int)value;
  char expected[MAX_GOT];
  (void)snprintf(expected, sizeof expected, "a whole number from %d to %d", min, max);
  mismatch(node, number_hint(node), expected);
  return fallback;
}

int ambulo__yaml_boolean(const ambulo__yaml_node *node, int fallback) {
  if (!node) return fallback;
  if (is_plain(node)) {
    if (strcmp(node->text, "true") == 0) return 1;
    if (strcmp(node->text, "false") == 0) return 0;
  }
  mismatch(node, NULL, "true or false");
  return fallback;
}

int ambulo__yaml_choice(const ambulo__yaml_node *node, const char *const *words, int count,
                        int fallback) {
  if (!node) return fallback;
  char list[MAX_LIST], expected[MAX_LIST + 16], hint[MAX_LIST];
  join(list, sizeof list, words, (size_t)count);
  (void)snprintf(expected, sizeof expected, "one of: %s", list);
  if (node->kind != AMBULO__YAML_SCALAR) {
    mismatch(node, NULL, expected);
    return fallback;
  }
  for (int i = 0; i < count; i++)
    if (strcmp(node->text, words[i]) == 0) return i;
  const char *nearest = ambulo__nearest(node->text, words, (size_t)count);
  mismatch(node, nearest ? suggest(node->text, words, (size_t)count, hint) : NULL, expected);
  return fallback;
}

const char *ambulo__yaml_name(const ambulo__yaml_node *node) {
  static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  if (!node) return "";
  if (node->kind == AMBULO__YAML_SCALAR) {
    size_t length = strlen(node->text);
    if (length >= 1 && length <= 64 && strspn(node->text, letters) == length) return node->text;
  }
  mismatch(node, NULL, "a name of 1 to 64 letters, digits, '_', '-' or '.'");
  return "";
}

const char *ambulo__yaml_file_name(const ambulo__yaml_node *node) {
  if (!node) return "";
  if (node->kind == AMBULO__YAML_SCALAR && node->text[0]) return node->text;
  mismatch(node, NULL, "the name of a file");
  return "";
}

/* `keeps`: items that a path left out keep their values */
static int read_numbers(const ambulo__yaml_node *node, int count, int keeps, double *values) {
  if (!node) return 0;
  if (node->kind != AMBULO__YAML_SEQUENCE || (keeps ? node->count > count : node->count != count)) {
    char expected[MAX_GOT];
    (void)snprintf(expected, sizeof expected, "a sequence of %d numbers", count);
    mismatch(node, NULL, expected);
    return 0;
  }
  int good = 1;
  double value;
  for (int pass = 0; pass < 2 && good; pass++) {
    for (int i = 0; i < node->count; i++) {
      const ambulo__yaml_node *item = node->items[i];
      if (keeps && is_plain(item) && strcmp(item->text, "~") == 0) continue;
      good &= read_number(item, &value);
      if (pass) values[i] = value;
    }
  }
  return good;
}

int ambulo__yaml_numbers(const ambulo__yaml_node *node, int count, double *values) {
  return read_numbers(node, count, 0, values);
}

int ambulo__yaml_numbers_over(const ambulo__yaml_node *node, int count, double *values) {
  return read_numbers(node, count, node && node->grown, values);
}
