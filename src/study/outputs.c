/* study/outputs.c - see outputs.h. */
#include "study/outputs.h"
#include "base/numtext.h"
#include "formats/read_file.h"
#include "study/case_path.h"
#include "formats/table_text.h"
#include "formats/yaml_node.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

enum { MOST_MOTION_BYTES = 1 << 30, PART = 128, MOST_NAMES = 256 };

static void set_number(ambulo__output *value, double number) {
  value->kind = AMBULO__OUTPUT_NUMBER;
  value->number = number;
  (void)ambulo__print_double(value->text, number);
}

/* ------------------------------------------------------------- summary.json */

/* the child that the first part of *path names; moves *path behind it */
static const ambulo__yaml_node *step(const ambulo__yaml_node *node, const char **path) {
  char part[PART];
  size_t item = **path == '[', length = strcspn(*path + item, ".[]");
  if (length >= sizeof part) return NULL;
  memcpy(part, *path + item, length);
  part[length] = '\0';
  *path += item + length;
  if (item && **path == ']') (*path)++;
  if (**path == '.') (*path)++;
  if (item) {
    long long index = -1;
    (void)ambulo__parse_integer(part, length, 0, INT_MAX, &index);
    return ambulo__yaml_item(node, (int)index);
  }
  return ambulo__yaml_is(node, AMBULO__YAML_MAPPING) ? ambulo__yaml_get(node, part) : NULL;
}

static void read_path(const ambulo__yaml_node *root, const char *path, ambulo__output *value) {
  const ambulo__yaml_node *node = root;
  while (node && *path) node = step(node, &path);
  if (ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) node = ambulo__yaml_get(node, "total");
  if (!ambulo__yaml_is(node, AMBULO__YAML_SCALAR)) return;
  const char *text = ambulo__yaml_text(node);
  double number;
  if (ambulo__parse_double(text, strlen(text), &number)) {
    set_number(value, number);
  } else if (strcmp(text, "null") != 0) {
    value->kind = AMBULO__OUTPUT_TEXT;
    (void)snprintf(value->text, sizeof value->text, "%s", text);
  }
}

/* --------------------------------------------------------------- motion.csv */

typedef enum reduction { MAX, MIN, MEAN, RANGE, PATH } reduction;

/* which reduction an output asks for; its column is copied */
static reduction parse(const char *output, char column[PART]) {
  static const char *const words[] = {"max(", "min(", "mean(", "range("};
  size_t length = strlen(output);
  for (int i = 0; i < PATH; i++) {
    size_t word = strlen(words[i]);
    if (strncmp(output, words[i], word) != 0 || output[length - 1] != ')') continue;
    if (length - word - 1 >= PART) continue;
    memcpy(column, output + word, length - word - 1);
    column[length - word - 1] = '\0';
    return (reduction)i;
  }
  return PATH;
}

typedef struct motion {
  const char *text;
  size_t length;
  ambulo__table_line header;
} motion;

static int column_of(const motion *m, const char *name) {
  ambulo__table_cell cell;
  size_t position = 0;
  for (int i = 0; ambulo__table_next_cell(&m->header, AMBULO__CELLS_COMMA, &position, &cell); i++)
    if (cell.length == strlen(name) && memcmp(cell.start, name, cell.length) == 0) return i;
  return -1;
}

static int number_at(const ambulo__table_line *line, int column, double *number) {
  ambulo__table_cell cell;
  size_t position = 0;
  for (int i = 0; ambulo__table_next_cell(line, AMBULO__CELLS_COMMA, &position, &cell); i++)
    if (i == column) return ambulo__parse_double(cell.start, cell.length, number);
  return 0;
}

static void reduce(const motion *m, reduction how, const char *name, ambulo__output *value) {
  int column = column_of(m, name), time = column_of(m, "time"), rows = 0;
  double least = 0.0, most = 0.0, area = 0.0, first = 0.0, t0 = 0.0, y0 = 0.0;
  ambulo__table_line line = m->header;
  while (column >= 0 && ambulo__table_next_line(m->text, m->length, &line)) {
    double y, t = 0.0;
    if (!number_at(&line, column, &y) || (time >= 0 && !number_at(&line, time, &t))) continue;
    if (rows == 0) {
      least = most = y;
      first = t;
    } else {
      area += 0.5 * (y + y0) * (t - t0);
    }
    if (y < least) least = y;
    if (y > most) most = y;
    t0 = t;
    y0 = y;
    rows++;
  }
  if (rows == 0) return;
  double mean = t0 > first ? area / (t0 - first) : y0;
  set_number(value, how == MAX ? most : how == MIN ? least : how == MEAN ? mean : most - least);
}

static int open_motion(motion *m) {
  memset(&m->header, 0, sizeof m->header);
  while (ambulo__table_next_line(m->text, m->length, &m->header))
    if (m->header.length > 0 && m->header.start[0] != '#') return 1;
  return 0;
}

/* what the outputs of a case are taken from; either is read when the first one asks for it */
typedef struct source {
  const ambulo_allocator *allocator;
  ambulo_diagnostics *diagnostics;
  char *summary, *file; /* paths */
  ambulo__yaml *document;
  char *text;
  motion motion;
} source;

static ambulo_status load_summary(source *s) {
  if (s->document) return AMBULO_OK;
  return ambulo__yaml_load(s->summary, s->allocator, s->diagnostics, &s->document);
}

static ambulo_status load_motion(source *s) {
  if (s->text) return AMBULO_OK;
  ambulo_status status = ambulo__read_file(s->file, MOST_MOTION_BYTES, s->allocator, s->diagnostics,
                                           &s->text, &s->motion.length);
  if (status) return status;
  s->motion.text = s->text;
  ambulo__place place = {s->file, 0, 0, NULL};
  return open_motion(&s->motion) ? AMBULO_OK
                                 : ambulo__error(s->diagnostics, AMBULO_E_PARSE, place, NULL,
                                                 "holds no line of names; expected a motion");
}

static ambulo_status take(source *s, const char *output, ambulo__output *value) {
  char column[PART];
  reduction how = parse(output, column);
  ambulo_status status = how == PATH ? load_summary(s) : load_motion(s);
  if (status) return status;
  if (how == PATH) {
    read_path(ambulo__yaml_root(s->document), output, value);
  } else {
    reduce(&s->motion, how, column, value);
  }
  return AMBULO_OK;
}

ambulo_status ambulo__outputs_of(const char *directory, const char *id, char *const *output,
                                 int count, const ambulo_allocator *a,
                                 ambulo_diagnostics *diagnostics, ambulo__output *value) {
  source s = {.allocator = a, .diagnostics = diagnostics};
  s.summary = ambulo__case_path(a, directory, id, "/summary.json");
  s.file = ambulo__case_path(a, directory, id, "/motion.csv");
  ambulo__output *found = ambulo__alloc(a, (size_t)count, sizeof *found);
  ambulo_status status = s.summary && s.file && found ? AMBULO_OK : AMBULO_E_MEMORY;
  for (int i = 0; i < count && !status; i++) status = take(&s, output[i], &found[i]);
  if (!status && count > 0) memcpy(value, found, (size_t)count * sizeof *found);
  ambulo__yaml_free(s.document);
  ambulo__free(a, s.text);
  ambulo__free(a, s.summary);
  ambulo__free(a, s.file);
  ambulo__free(a, found);
  return status;
}

/* -------------------------------------------------------------- nearest names */

static const char *nearest_key(const ambulo__yaml_node *node, const char *path, char *near,
                               size_t size) {
  char word[PART];
  const char *key[MOST_NAMES];
  for (;;) {
    const char *from = path;
    size_t length = strcspn(path, ".[]");
    const ambulo__yaml_node *next = node && *path ? step(node, &path) : NULL;
    if (next) {
      node = next;
      continue;
    }
    if (!ambulo__yaml_is(node, AMBULO__YAML_MAPPING) || length >= sizeof word) return NULL;
    memcpy(word, from, length);
    word[length] = '\0';
    int pairs = ambulo__yaml_pairs(node), count = pairs < MOST_NAMES ? pairs : MOST_NAMES;
    for (int i = 0; i < count; i++) key[i] = ambulo__yaml_key(node, i);
    const char *found = ambulo__nearest(word, key, (size_t)count);
    (void)snprintf(near, size, "%s", found ? found : "");
    return found ? near : NULL;
  }
}

static const char *nearest_column(const motion *m, const char *column, char *near, size_t size) {
  ambulo__table_cell cell;
  size_t position = 0;
  const char *found = NULL;
  /* one at a time against the best so far: ambulo__nearest takes the nearer of two */
  while (ambulo__table_next_cell(&m->header, AMBULO__CELLS_COMMA, &position, &cell)) {
    char name[PART];
    if (cell.length >= sizeof name) continue;
    memcpy(name, cell.start, cell.length);
    name[cell.length] = '\0';
    const char *both[] = {found ? near : name, name};
    const char *winner = ambulo__nearest(column, both, 2);
    if (winner == name || (winner && !found)) {
      (void)snprintf(near, size, "%s", name);
      found = near;
    }
  }
  return found;
}

int ambulo__output_nearest(const char *directory, const char *id, const char *output,
                           const ambulo_allocator *a, char *near, size_t size) {
  char *summary = ambulo__case_path(a, directory, id, "/summary.json");
  char *file = ambulo__case_path(a, directory, id, "/motion.csv"), *text = NULL;
  char column[PART];
  const char *found = NULL;
  ambulo__yaml *document = NULL;
  motion m = {NULL, 0, {NULL, 0, 0, 0}};
  if (parse(output, column) == PATH) {
    if (summary && !ambulo__yaml_load(summary, a, NULL, &document))
      found = nearest_key(ambulo__yaml_root(document), output, near, size);
  } else if (file && !ambulo__read_file(file, MOST_MOTION_BYTES, a, NULL, &text, &m.length)) {
    m.text = text;
    if (open_motion(&m)) found = nearest_column(&m, column, near, size);
  }
  ambulo__yaml_free(document);
  ambulo__free(a, text);
  ambulo__free(a, summary);
  ambulo__free(a, file);
  return found != NULL;
}
