/* study/outputs.c - outputs of one case: paths into its summary, reductions of its motion
 * (results.h). */
#include "study/results.h"

#include "base/numtext.h"
#include "formats/read_file.h"
#include "formats/sheet.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_MOTION_BYTES = 1 << 30, PART = 160 };

static void set_number(ambulo__output *value, double number) {
  value->kind = AMBULO__OUTPUT_NUMBER;
  value->number = number;
  (void)snprintf(value->text, sizeof value->text, "%s", ambulo__number_text(number).text);
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

static source open_source(const char *directory, const char *id, const ambulo_allocator *a,
                          ambulo_diagnostics *diagnostics) {
  source s = {.allocator = a, .diagnostics = diagnostics};
  s.summary = ambulo__case_path(a, directory, id, "/summary.json");
  s.file = ambulo__case_path(a, directory, id, "/motion.csv");
  return s;
}

static void close_source(source *s) {
  ambulo__yaml_free(s->document);
  ambulo__free(s->allocator, s->text);
  ambulo__free(s->allocator, s->summary);
  ambulo__free(s->allocator, s->file);
}

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

ambulo_status ambulo__outputs_of(const char *directory, const char *id, const char *const *output,
                                 int count, const ambulo_allocator *a,
                                 ambulo_diagnostics *diagnostics, ambulo__output *value) {
  source s = open_source(directory, id, a, diagnostics);
  ambulo__output *found = ambulo__alloc(a, (size_t)count, sizeof *found);
  ambulo_status status = s.summary && s.file && found ? AMBULO_OK : AMBULO_E_MEMORY;
  for (int i = 0; i < count && !status; i++) status = take(&s, output[i], &found[i]);
  if (!status && count > 0) memcpy(value, found, (size_t)count * sizeof *found);
  close_source(&s);
  ambulo__free(a, found);
  return status;
}

/* ------------------------------------------------------------- nearest names */

/* the nearest of names that come one at a time: ambulo__nearest takes the nearer of two */
typedef struct search {
  const char *word;
  char *near; /* [size]; "": none yet */
  size_t size;
} search;

static void offer(search *s, const char *name) {
  const char *both[] = {s->near[0] ? s->near : name, name};
  const char *winner = ambulo__nearest(s->word, both, 2);
  if (winner == name || (winner && !s->near[0])) (void)snprintf(s->near, s->size, "%s", name);
}

/* keys beside the first part of the path that is not there */
static void search_summary(const ambulo__yaml_node *node, const char *path, search *s) {
  char word[PART];
  for (const ambulo__yaml_node *next = node; next; node = next) {
    (void)snprintf(word, sizeof word, "%.*s", (int)strcspn(path, ".[]"), path);
    next = *path ? step(node, &path) : NULL;
    if (!next) break;
  }
  s->word = word;
  for (int i = 0; ambulo__yaml_is(node, AMBULO__YAML_MAPPING) && i < ambulo__yaml_pairs(node); i++)
    offer(s, ambulo__yaml_key(node, i));
  s->word = NULL;
}

static void search_motion(const motion *m, search *s) {
  ambulo__table_cell cell;
  size_t position = 0;
  while (ambulo__table_next_cell(&m->header, AMBULO__CELLS_COMMA, &position, &cell)) {
    char name[PART];
    if (cell.length >= sizeof name) continue;
    (void)snprintf(name, sizeof name, "%.*s", (int)cell.length, cell.start);
    offer(s, name);
  }
}

int ambulo__output_nearest(const char *directory, const char *id, const char *output,
                           const ambulo_allocator *a, char *near, size_t size) {
  char column[PART];
  source s = open_source(directory, id, a, NULL);
  search all = {column, near, size};
  int whole = s.summary && s.file;
  near[0] = '\0';
  if (parse(output, column) != PATH) {
    if (whole && !load_motion(&s)) search_motion(&s.motion, &all);
  } else if (whole && !load_summary(&s)) {
    search_summary(ambulo__yaml_root(s.document), output, &all);
  }
  close_source(&s);
  return near[0] != '\0';
}

/* ----------------------------------------------------------- points of a front */

/* The objective of a case is sum_i w_i J_i + R, and its summary names each term with its weight, so
 * J_i is what is written by w_i. Where free parameters are chosen by the objective per metre, it is
 * that which is minimized: total and terms are divided by the distance. */
enum { TOTAL, PER, DISTANCE, TERMS, OUTPUTS = TERMS + AMBULO__FRONT_TERMS };

ambulo_status ambulo__front_read_point(const char *directory, const char *id,
                                       const ambulo__front *f, const ambulo_allocator *a,
                                       ambulo_diagnostics *diagnostics,
                                       ambulo__front_point *point) {
  char text[OUTPUTS][PART] = {"objective.total", "free.per", "free.distance"};
  const char *path[OUTPUTS];
  int terms = f->terms;
  ambulo__output value[OUTPUTS];
  memset(value, 0, sizeof value);
  for (int i = 0; i < terms; i++)
    (void)snprintf(text[TERMS + i], PART, "objective.terms.%.140s", f->name[i]);
  for (int i = 0; i < TERMS + terms; i++) path[i] = text[i];
  ambulo_status status =
      ambulo__outputs_of(directory, id, path, TERMS + terms, a, diagnostics, value);
  if (status) return status;
  double by = strcmp(value[PER].text, "distance") == 0 ? value[DISTANCE].number : 1.0;
  int solved = value[TOTAL].kind == AMBULO__OUTPUT_NUMBER && by > 0.0;
  point->total = value[TOTAL].number / by;
  for (int i = 0; i < terms; i++) {
    solved &= value[TERMS + i].kind == AMBULO__OUTPUT_NUMBER;
    point->value[i] = value[TERMS + i].number / by / point->weight[i];
    solved &= isfinite(point->value[i]);
  }
  point->solved = solved;
  return AMBULO_OK;
}
