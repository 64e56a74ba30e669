/* batch/collect.c - the state of a batch folder, and its table. */
#include "base/atomic_file.h"
#include "base/numtext.h"
#include "base/text_buffer.h"
#include "batch/gather.h"
#include "batch/lock.h"
#include "batch/paths.h"
#include "batch/record.h"
#include "report/json_text.h"

#include <stdio.h>
#include <string.h>

/* ------------------------------------------------------------------- gather */

static const char *classify(const char *directory, const ambulo__listing *l, int k,
                            ambulo__record *record, ambulo_batch_census *census) {
  const char *id = ambulo__listing_cell(l, k, AMBULO__LISTING_ID);
  unsigned long long key = 0;
  ambulo__record_found found = ambulo__record_read(directory, id, &l->allocator, record);
  if (found == AMBULO__RECORD_ABSENT) {
    census->missing++;
    return "missing";
  }
  if (found == AMBULO__RECORD_READ && ambulo__listing_key(l, k, &key) && key != record->key) {
    census->stale++;
    return "stale";
  }
  if (found == AMBULO__RECORD_CORRUPT ||
      !ambulo__record_summary_intact(directory, id, record, &l->allocator)) {
    census->corrupt++;
    return "corrupt";
  }
  census->done++;
  census->failed += !record->valid;
  census->seconds += record->seconds;
  return record->state;
}

static int has_result(const char *state, const ambulo__record *record) {
  return state == record->state && record->summary != 0;
}

ambulo_status ambulo__gather(const char *directory, const ambulo__listing *l, int outputs,
                             ambulo_status (*take)(void *user, const ambulo__gathered *gathered),
                             void *user, ambulo_batch_census *census) {
  ambulo_batch_census counted;
  memset(&counted, 0, sizeof counted);
  counted.cases = l->cases;
  size_t room = (size_t)(outputs ? l->outputs : 0);
  ambulo__output *value = ambulo__alloc(&l->allocator, room, sizeof *value);
  ambulo_status status = value ? AMBULO_OK : AMBULO_E_MEMORY;
  for (int k = 0; k < l->cases && !status; k++) {
    ambulo__record record;
    memset(&record, 0, sizeof record);
    ambulo__gathered one = {k, classify(directory, l, k, &record, &counted), 0, value};
    one.valid = one.state == record.state && record.valid;
    if (room > 0) memset(value, 0, room * sizeof *value);
    if (room > 0 && has_result(one.state, &record))
      ambulo__outputs_of(directory, ambulo__listing_cell(l, k, AMBULO__LISTING_ID), l->output,
                         l->outputs, &l->allocator, value);
    if (take) status = take(user, &one);
  }
  ambulo__free(&l->allocator, value);
  if (census) *census = counted;
  return status;
}

ambulo_status ambulo_batch_status(const char *directory, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_batch_census *census) {
  if (!directory || !census) return AMBULO_E_ARGUMENT;
  ambulo__listing listing;
  ambulo_batch_census counted;
  ambulo_status status = ambulo__listing_load(directory, allocator, diagnostics, &listing);
  if (status) return status;
  status = ambulo__gather(directory, &listing, 0, NULL, NULL, &counted);
  ambulo__lock_holder(directory, &listing.allocator, counted.holder);
  ambulo__listing_free(&listing);
  if (!status) *census = counted;
  return status;
}

/* -------------------------------------------------------------------- table */

typedef struct table {
  const ambulo__listing *listing;
  int *found; /* [outputs] cases that have a value */
  int solved; /* a case with a valid solution; -1: none */
  ambulo__text_buffer csv, lines;
} table;

/* RFC 4180: quoted where it holds a comma, a quote or a line end */
static void csv_cell(ambulo__text_buffer *text, const char *cell) {
  if (!cell[strcspn(cell, ",\"\r\n")]) {
    ambulo__text_append(text, cell);
    return;
  }
  ambulo__text_append_char(text, '"');
  for (; *cell; cell++) {
    if (*cell == '"') ambulo__text_append_char(text, '"');
    ambulo__text_append_char(text, *cell);
  }
  ambulo__text_append_char(text, '"');
}

static void csv_titles(table *t) {
  const ambulo__listing *l = t->listing;
  ambulo__text_append(&t->csv, "id,name,state");
  for (int i = AMBULO__LISTING_AXES; i < l->columns; i++) {
    ambulo__text_append_char(&t->csv, ',');
    csv_cell(&t->csv, ambulo__listing_title(l, i));
  }
  for (int i = 0; i < l->outputs; i++) {
    ambulo__text_append_char(&t->csv, ',');
    csv_cell(&t->csv, l->output[i]);
  }
  ambulo__text_append_char(&t->csv, '\n');
}

static void json_pair(ambulo__json *json, const char *key, const char *text) {
  double number;
  ambulo__text_append(json->text, ", ");
  ambulo__json inner = {json->text, 0, 1};
  if (text[0] && ambulo__parse_double(text, strlen(text), &number)) {
    ambulo__json_number(&inner, key, number);
  } else {
    ambulo__json_text(&inner, key, text[0] ? text : NULL);
  }
}

/* a text, also when it looks like a number */
static void json_word(ambulo__json *json, const char *key, const char *text) {
  ambulo__json inner = {json->text, 0, 1};
  ambulo__text_append(json->text, ", ");
  ambulo__json_text(&inner, key, text);
}

static ambulo_status add_row(void *user, const ambulo__gathered *one) {
  table *t = user;
  const ambulo__listing *l = t->listing;
  ambulo__json json = {&t->lines, 0, 1};
  ambulo__text_append(&t->lines, "{");
  ambulo__json_text(&json, "id", ambulo__listing_cell(l, one->index, AMBULO__LISTING_ID));
  csv_cell(&t->csv, ambulo__listing_cell(l, one->index, AMBULO__LISTING_ID));
  ambulo__text_append_char(&t->csv, ',');
  csv_cell(&t->csv, ambulo__listing_cell(l, one->index, AMBULO__LISTING_NAME));
  json_word(&json, "name", ambulo__listing_cell(l, one->index, AMBULO__LISTING_NAME));
  ambulo__text_append_format(&t->csv, ",%s", one->state);
  json_word(&json, "state", one->state);
  for (int i = AMBULO__LISTING_AXES; i < l->columns; i++) {
    ambulo__text_append_char(&t->csv, ',');
    csv_cell(&t->csv, ambulo__listing_cell(l, one->index, i));
    json_pair(&json, ambulo__listing_title(l, i), ambulo__listing_cell(l, one->index, i));
  }
  if (one->valid) t->solved = one->index;
  for (int i = 0; i < l->outputs; i++) {
    t->found[i] += one->value[i].kind != AMBULO__OUTPUT_NONE;
    ambulo__text_append_char(&t->csv, ',');
    csv_cell(&t->csv, one->value[i].text);
    json_pair(&json, l->output[i], one->value[i].text);
  }
  ambulo__text_append_char(&t->csv, '\n');
  ambulo__text_append(&t->lines, "}\n");
  return ambulo__text_status(&t->csv);
}

/* an output that no case has is most likely misspelt */
static void warn_of_strangers(const char *directory, const table *t,
                              ambulo_diagnostics *diagnostics) {
  const ambulo__listing *l = t->listing;
  for (int i = 0; i < l->outputs && t->solved >= 0; i++) {
    if (t->found[i] > 0) continue;
    char near[128], hint[160] = "outputs are keys of summary.json or columns of motion.csv";
    const char *id = ambulo__listing_cell(l, t->solved, AMBULO__LISTING_ID);
    if (ambulo__output_nearest(directory, id, l->output[i], &l->allocator, near, sizeof near))
      (void)snprintf(hint, sizeof hint, "did you mean '%s'?", near);
    ambulo__place place = {directory, 0, 0, NULL};
    ambulo__warning(diagnostics, place, hint, "no case has the output '%s'", l->output[i]);
  }
}

static ambulo_status write_table(const char *directory, const char *name,
                                 const ambulo__text_buffer *text, const ambulo_allocator *a,
                                 ambulo_diagnostics *diagnostics) {
  char *path = ambulo__join_paths(a, directory, name, NULL);
  ambulo_status status = path ? ambulo__text_status(text) : AMBULO_E_MEMORY;
  if (!status)
    status = ambulo__write_file(path, ambulo__text_data(text), text->length, 1, a, diagnostics);
  ambulo__free(a, path);
  return status;
}

ambulo_status ambulo_batch_collect(const char *directory, const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo_batch_census *census) {
  if (!directory) return AMBULO_E_ARGUMENT;
  ambulo__listing listing;
  ambulo_batch_census counted;
  ambulo_status status = ambulo__listing_load(directory, allocator, diagnostics, &listing);
  if (status) return status;
  const ambulo_allocator *a = &listing.allocator;
  table t = {.listing = &listing, .solved = -1};
  t.found = ambulo__alloc(a, (size_t)listing.outputs, sizeof *t.found);
  ambulo__text_init(&t.csv, a);
  ambulo__text_init(&t.lines, a);
  csv_titles(&t);
  status =
      t.found ? ambulo__gather(directory, &listing, 1, add_row, &t, &counted) : AMBULO_E_MEMORY;
  if (!status) status = write_table(directory, "results.csv", &t.csv, a, diagnostics);
  if (!status) status = write_table(directory, "results.jsonl", &t.lines, a, diagnostics);
  ambulo__lock_holder(directory, a, counted.holder);
  if (!status) warn_of_strangers(directory, &t, diagnostics);
  ambulo__free(a, t.found);
  ambulo__text_free(&t.csv);
  ambulo__text_free(&t.lines);
  ambulo__listing_free(&listing);
  if (!status && census) *census = counted;
  return status;
}
