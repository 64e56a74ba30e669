/* study/batch_listing.c - what a batch folder says about itself: written, and read back (study.h).
 */
#include "base/text_buffer.h"
#include "formats/atomic_file.h"
#include "formats/json_text.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "study/study.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define MOST_LIST_BYTES ((size_t)2 << 30)
#define MOST_DESCRIPTION_BYTES ((size_t)16 << 20)

static const char schema[] = "ambulo-batch/2", unsealed_schema[] = "ambulo-batch/1";

enum { COLUMNS = 3, LISTS = 6 }; /* columns of cases.tsv before the axes: id, key, name */

/* a list of batch.json: texts, each so many bytes behind the one before */
typedef struct text_list {
  const char *key;
  char **first;
  size_t stride;
  int count;
} text_list;

static void lists_of(ambulo_sweep *s, text_list list[LISTS]) {
  const size_t output = sizeof *s->output, axis = sizeof *s->axis;
  const text_list lists[LISTS] = {{"outputs", &s->output->path, output, s->outputs},
                                  {"output_labels", &s->output->label, output, s->outputs},
                                  {"output_units", &s->output->unit, output, s->outputs},
                                  {"axes", &s->axis->key, axis, s->axes},
                                  {"axis_labels", &s->axis->label, axis, s->axes},
                                  {"axis_units", &s->axis->unit, axis, s->axes}};
  memcpy(list, lists, sizeof lists);
}

static char **text_of(const text_list *list, int i) {
  return (char **)(void *)((char *)(void *)list->first + (size_t)i * list->stride);
}

/* ------------------------------------------------------------------ writing */

/* tabs and line ends separate cells, so they become blanks inside */
static void append_cell(ambulo__text_buffer *text, const char *cell) {
  ambulo__text_append_char(text, '\t');
  for (; *cell; cell++) ambulo__text_append_char(text, strchr("\t\n\r", *cell) ? ' ' : *cell);
}

static void list_text(const ambulo_sweep *s, ambulo__text_buffer *text) {
  ambulo__text_append(text, "id\tkey\tname");
  for (int i = 0; i < s->axes; i++) append_cell(text, s->axis[i].name);
  for (int k = 0; k < s->case_count; k++) {
    ambulo__text_append_format(text, "\n%s\t%016llx", s->cases[k].id, s->cases[k].key);
    append_cell(text, s->cases[k].name);
    for (int i = 0; i < s->axes; i++) append_cell(text, ambulo_sweep_value(s, k, i));
  }
  ambulo__text_append_char(text, '\n');
}

static void describe_front(const ambulo__front *f, ambulo__json *json) {
  ambulo__json_open(json, "front", '{');
  ambulo__json_open(json, "terms", '[');
  for (int i = 0; i < f->terms; i++) ambulo__json_text(json, NULL, f->name[i]);
  ambulo__json_close(json, ']');
  ambulo__json_open(json, "weights", '[');
  for (int i = 0; i < f->terms; i++) ambulo__json_number(json, NULL, f->own[i]);
  ambulo__json_close(json, ']');
  ambulo__json_integer(json, "points", f->wanted);
  ambulo__json_number(json, "least", f->least);
  ambulo__json_integer(json, "neighbour", f->neighbour);
  ambulo__json_close(json, '}');
}

static void describe(const ambulo_sweep *s, const char *digest, ambulo__text_buffer *text) {
  ambulo__json json = {text, 0, 1};
  text_list list[LISTS];
  ambulo_sweep view = *s;
  lists_of(&view, list);
  ambulo__json_open(&json, NULL, '{');
  ambulo__json_text(&json, "schema", schema);
  ambulo__json_text(&json, "name", s->name);
  ambulo__json_text(&json, "version", s->version);
  ambulo__json_text(&json, "sweep", s->path);
  ambulo__json_text(&json, "base", s->base);
  ambulo__json_text(&json, "problem_hash", s->problem_hash);
  ambulo__json_text(&json, "text_hash", s->text_hash);
  ambulo__json_integer(&json, "cases", s->case_count);
  ambulo__json_text(&json, "cases_sha256", digest);
  for (int i = 0; i < LISTS; i++) {
    ambulo__json_open(&json, list[i].key, '[');
    for (int k = 0; k < list[i].count; k++) ambulo__json_text(&json, NULL, *text_of(&list[i], k));
    ambulo__json_close(&json, ']');
  }
  ambulo__json_integer(&json, "zipped_axes", s->zipped);
  if (s->front.terms > 0) describe_front(&s->front, &json);
  ambulo__seal(text);
}

static ambulo_status write_text(const char *directory, const char *name,
                                const ambulo__text_buffer *text, const ambulo_allocator *a,
                                ambulo_diagnostics *diagnostics) {
  char *path = ambulo__join_paths(a, directory, name, NULL);
  ambulo_status status = path ? ambulo__text_status(text) : AMBULO_E_MEMORY;
  if (!status)
    status = ambulo__write_file(path, ambulo__text_data(text), text->length, 1, a, diagnostics);
  ambulo__free(a, path);
  return status;
}

ambulo_status ambulo__study_describe(const ambulo_sweep *s, const char *directory,
                                     const ambulo_allocator *a, ambulo_diagnostics *diagnostics) {
  ambulo__text_buffer text;
  char digest[AMBULO__SHA256_TEXT];
  ambulo__text_init(&text, a);
  list_text(s, &text);
  ambulo__sha256_of(ambulo__text_data(&text), text.length, digest);
  ambulo_status status = write_text(directory, "cases.tsv", &text, a, diagnostics);
  ambulo__text_clear(&text);
  describe(s, digest, &text);
  if (!status) status = write_text(directory, "batch.json", &text, a, diagnostics);
  ambulo__text_free(&text);
  return status;
}

/* ------------------------------------------------------------------ reading */

/* inside this file; a caller gets E_IO */
static const ambulo_status DAMAGED = AMBULO_E_PARSE;

static ambulo_status corrupt(ambulo_diagnostics *diagnostics, const char *path, int line) {
  ambulo__place place = {path, line, 0, NULL};
  (void)ambulo__error(diagnostics, AMBULO_E_IO, place, "run the batch again to rewrite it",
                      "damaged: the list of cases is not what was written");
  return DAMAGED;
}

int ambulo__read_key(const char *text, unsigned long long *key) {
  *key = strtoull(text, NULL, 16);
  return strlen(text) == 16 && strspn(text, "0123456789abcdef") == 16;
}

/* the text of a cell that ends with `end`; NULL: it ends otherwise */
static char *read_cell(char **at, char end) {
  char *text = *at;
  *at += strcspn(text, "\t\n");
  if (**at != end) return NULL;
  *(*at)++ = '\0';
  return text;
}

/* 1: all columns of a line, of which the first three are `head` */
static int read_line(const ambulo_sweep *s, char **at, char *head[COLUMNS], const char **cell) {
  for (int i = 0; i < COLUMNS; i++) {
    head[i] = read_cell(at, i + 1 < COLUMNS + s->axes ? '\t' : '\n');
    if (!head[i]) return 0;
  }
  for (int i = 0; i < s->axes; i++) {
    cell[i] = read_cell(at, i + 1 < s->axes ? '\t' : '\n');
    if (!cell[i]) return 0;
  }
  return 1;
}

static ambulo_status read_lines(ambulo_sweep *s, size_t length, int cases, const char *path,
                                ambulo_diagnostics *diagnostics) {
  char *at = s->list, *head[COLUMNS] = {NULL};
  const char *title[AMBULO__SWEEP_AXES] = {NULL};
  if (!read_line(s, &at, head, title)) return corrupt(diagnostics, path, 1);
  for (int i = 0; i < s->axes; i++) {
    s->axis[i].name = ambulo__strdup(&s->allocator, title[i]);
    if (!s->axis[i].name) return AMBULO_E_MEMORY;
  }
  s->cases = ambulo__alloc(&s->allocator, (size_t)cases, sizeof *s->cases);
  s->cell = ambulo__alloc(&s->allocator, (size_t)cases * (size_t)s->axes, sizeof *s->cell);
  if (!s->cases || !s->cell) return AMBULO_E_MEMORY;
  for (int k = 0; k < cases; k++) {
    unsigned long long key = 0;
    if (!read_line(s, &at, head, s->cell + (size_t)k * (size_t)s->axes) ||
        !ambulo__read_key(head[1], &key))
      return corrupt(diagnostics, path, k + 2);
    s->cases[s->case_count++] =
        (ambulo__sweep_case){.id = head[0], .name = head[2], .key = key, .previous = -1};
  }
  return at == s->list + length ? AMBULO_OK : corrupt(diagnostics, path, cases + 2);
}

static ambulo_status read_list(ambulo_sweep *s, const char *path, int cases, const char *wanted,
                               ambulo_diagnostics *diagnostics) {
  char digest[AMBULO__SHA256_TEXT];
  size_t length = 0;
  struct stat entry;
  if (stat(path, &entry) != 0 && errno == ENOENT) return corrupt(diagnostics, path, 0);
  ambulo_status status =
      ambulo__read_file(path, MOST_LIST_BYTES, &s->allocator, diagnostics, &s->list, &length);
  if (status) return status;
  ambulo__sha256_of(s->list, length, digest);
  if (strcmp(digest, wanted) != 0) return corrupt(diagnostics, path, 0);
  return read_lines(s, length, cases, path, diagnostics);
}

static void copy_short(const ambulo__yaml_node *root, const char *key, char *text, size_t size) {
  (void)snprintf(text, size, "%s", ambulo__yaml_text(ambulo__yaml_require(root, key)));
}

/* *right = 0: not what this version writes */
static ambulo_status read_front(ambulo_sweep *s, const ambulo__yaml_node *node, int *right) {
  if (!node) return AMBULO_OK;
  ambulo__front *f = &s->front;
  const ambulo__yaml_node *terms = ambulo__yaml_require(node, "terms");
  const ambulo__yaml_node *own = ambulo__yaml_require(node, "weights");
  f->terms = ambulo__yaml_items(terms);
  *right &= f->terms == s->axes && f->terms >= 2 && f->terms <= AMBULO__FRONT_TERMS;
  if (!*right) f->terms = 0;
  f->wanted = ambulo__yaml_integer(ambulo__yaml_require(node, "points"), 2, INT_MAX, 2);
  f->least = ambulo__yaml_number(ambulo__yaml_require(node, "least"), 0.0);
  f->neighbour = ambulo__yaml_integer(ambulo__yaml_get(node, "neighbour"), 0, 1, 0);
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < f->terms && !status; i++) {
    f->own[i] = ambulo__yaml_number(ambulo__yaml_item(own, i), 0.0);
    status = ambulo__sweep_copy(s, ambulo__yaml_item(terms, i), &f->name[i]);
  }
  return status;
}

/* E_MEMORY, or AMBULO_OK, and then the document knows what was wrong, or *right is 0 */
static ambulo_status read_fields(ambulo_sweep *s, const ambulo__yaml_node *root, int *right) {
  copy_short(root, "version", s->version, sizeof s->version);
  copy_short(root, "problem_hash", s->problem_hash, sizeof s->problem_hash);
  copy_short(root, "text_hash", s->text_hash, sizeof s->text_hash);
  ambulo_status status = ambulo__sweep_copy(s, ambulo__yaml_require(root, "name"), &s->name);
  s->outputs = ambulo__yaml_items(ambulo__yaml_require(root, "outputs"));
  s->axes = ambulo__yaml_items(ambulo__yaml_require(root, "axes"));
  *right = s->axes <= AMBULO__SWEEP_AXES;
  if (!*right) s->axes = 0;
  s->zipped = ambulo__yaml_integer(ambulo__yaml_require(root, "zipped_axes"), 0, s->axes, 0);
  s->output = ambulo__alloc(&s->allocator, (size_t)s->outputs, sizeof *s->output);
  if (!s->output) return AMBULO_E_MEMORY;
  text_list list[LISTS];
  lists_of(s, list);
  for (int i = 0; i < LISTS; i++) {
    const ambulo__yaml_node *node = ambulo__yaml_require(root, list[i].key);
    *right &= ambulo__yaml_items(node) == list[i].count;
    for (int k = 0; k < list[i].count && *right && !status; k++)
      status = ambulo__sweep_copy(s, ambulo__yaml_item(node, k), text_of(&list[i], k));
  }
  return status ? status : read_front(s, ambulo__yaml_get(root, "front"), right);
}

static ambulo_status other_version(ambulo_diagnostics *diagnostics, const char *path,
                                   const char *own) {
  ambulo__place place = {path, 0, 0, NULL};
  return ambulo__error(
      diagnostics, AMBULO_E_PROBLEM, place,
      "'ambulo batch' with --force computes its cases again; or give another folder",
      "the folder was filled by another version of ambulo (%.40s); expected %s", own, schema);
}

/* *cases, `digest`: of the list, as batch.json says */
static ambulo_status read_description(ambulo_sweep *s, const char *path, int *cases,
                                      char digest[AMBULO__SHA256_TEXT],
                                      ambulo_diagnostics *diagnostics) {
  char *text = NULL;
  size_t length = 0;
  int right = 0;
  ambulo__yaml *document = NULL;
  ambulo_status status =
      ambulo__read_file(path, MOST_DESCRIPTION_BYTES, &s->allocator, diagnostics, &text, &length);
  if (status) return status;
  status = ambulo__yaml_load_text(text, length, path, &s->allocator, NULL, &document);
  if (!status) {
    const ambulo__yaml_node *root = ambulo__yaml_root(document);
    const char *own = ambulo__yaml_text(ambulo__yaml_require(root, "schema"));
    int ours = strcmp(own, schema) == 0, sealed = ambulo__seal_holds(text, length);
    *cases = ambulo__yaml_integer(ambulo__yaml_require(root, "cases"), 0, AMBULO__SWEEP_CASES, 0);
    copy_short(root, "cases_sha256", digest, AMBULO__SHA256_TEXT);
    if (!ours && (sealed || strcmp(own, unsealed_schema) == 0))
      status = other_version(diagnostics, path, own);
    else if (ours && sealed)
      status = read_fields(s, root, &right);
    right = right && !status && !ambulo__yaml_finish(document);
  }
  if (!right && status != AMBULO_E_MEMORY && status != AMBULO_E_PROBLEM)
    status = corrupt(diagnostics, path, 0);
  ambulo__yaml_free(document);
  ambulo__free(&s->allocator, text);
  return status;
}

ambulo_status ambulo__study_try(const char *directory, const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics, ambulo_sweep **study,
                                int *damaged) {
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  char digest[AMBULO__SHA256_TEXT] = "";
  int cases = 0;
  *damaged = 0;
  ambulo_sweep *s = ambulo__alloc(&a, 1, sizeof *s);
  if (!s) return AMBULO_E_MEMORY;
  s->allocator = a;
  s->path = ambulo__join_paths(&a, directory, "batch.json", NULL);
  char *list = ambulo__join_paths(&a, directory, "cases.tsv", NULL);
  ambulo_status status = list && s->path ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = read_description(s, s->path, &cases, digest, diagnostics);
  if (!status) status = read_list(s, list, cases, digest, diagnostics);
  ambulo__free(&a, list);
  *damaged = status == DAMAGED;
  if (status) {
    ambulo_sweep_free(s);
  } else {
    *study = s;
  }
  return *damaged ? AMBULO_E_IO : status;
}

ambulo_status ambulo__study_load(const char *directory, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo_sweep **study) {
  int damaged;
  ambulo_status status = ambulo__expect_path(directory, "batch folder", diagnostics);
  return status ? status : ambulo__study_try(directory, allocator, diagnostics, study, &damaged);
}
