/* study/collect.c - the table of a batch folder.
 *
 * Of a front (study/front.h) each line also has the values of its terms without their weights,
 * where it stands, and which case is better.
 *
 * Reading order: gather.h, collect.c, outputs.h, verify.c; front_points.h, front_run.c.
 */
#include "formats/atomic_file.h"
#include "base/numtext.h"
#include "formats/paths.h"
#include "base/text_buffer.h"
#include "study/case_path.h"
#include "study/batch_lock.h"
#include "study/front_points.h"
#include "study/gather.h"
#include "formats/json_text.h"

#include <stdio.h>
#include <string.h>

/* -------------------------------------------------------------------- table */

typedef struct table {
  const char *directory;
  const ambulo__listing *listing;
  ambulo_diagnostics *diagnostics;
  int *found;                 /* [outputs] cases that have a value */
  int solved;                 /* a case with a valid solution; -1: none */
  const ambulo__front *front; /* NULL: none */
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
  for (int i = 0; t->front && i < l->front.terms; i++) {
    ambulo__text_append_char(&t->csv, ',');
    csv_cell(&t->csv, l->front.name[i]);
  }
  if (t->front) ambulo__text_append(&t->csv, ",front,place,better");
  for (int i = 0; i < l->outputs; i++) {
    ambulo__text_append_char(&t->csv, ',');
    csv_cell(&t->csv, l->output_label[i]);
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

/* the row is written all the same, without outputs */
static void tell_damage(const table *t, const ambulo__gathered *one) {
  const ambulo__listing *l = t->listing;
  char *path = ambulo__case_path(&l->allocator, t->directory,
                                 ambulo__listing_cell(l, one->index, AMBULO__LISTING_ID),
                                 one->damage->ending);
  ambulo__place place = {path ? path : t->directory, 0, 0, NULL};
  ambulo__warning(t->diagnostics, place, NULL, "damaged: %s; case '%s' is left out",
                  one->damage->what, ambulo__listing_cell(l, one->index, AMBULO__LISTING_NAME));
  ambulo__free(&l->allocator, path);
}

/* the cell of a column in both tables */
static void add_cell(table *t, ambulo__json *json, const char *title, const char *text) {
  ambulo__text_append_char(&t->csv, ',');
  csv_cell(&t->csv, text);
  json_pair(json, title, text);
}

/* values of the terms; where the point stands, its place from 1, and the name of what is better */
static void add_point(table *t, ambulo__json *json, int index) {
  const ambulo__listing *l = t->listing;
  const ambulo__front_point *p = &t->front->point[index];
  char text[AMBULO__NUMTEXT_SIZE];
  for (int i = 0; i < l->front.terms; i++) {
    text[0] = '\0';
    if (p->solved) (void)ambulo__print_double(text, p->value[i]);
    add_cell(t, json, l->front.name[i], text);
  }
  add_cell(t, json, "front", ambulo__front_word(p->standing));
  text[0] = '\0';
  if (p->place >= 0) (void)snprintf(text, sizeof text, "%d", p->place + 1);
  add_cell(t, json, "place", text);
  add_cell(t, json, "better",
           p->better < 0 ? "" : ambulo__listing_cell(l, p->better, AMBULO__LISTING_NAME));
}

static ambulo_status add_row(void *user, const ambulo__gathered *one) {
  table *t = user;
  const ambulo__listing *l = t->listing;
  if (one->damage) tell_damage(t, one);
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
  if (t->front) add_point(t, &json, one->index);
  if (one->valid) t->solved = one->index;
  for (int i = 0; i < l->outputs; i++) {
    t->found[i] += one->value[i].kind != AMBULO__OUTPUT_NONE;
    ambulo__text_append_char(&t->csv, ',');
    csv_cell(&t->csv, one->value[i].text);
    json_pair(&json, l->output_label[i], one->value[i].text);
  }
  ambulo__text_append_char(&t->csv, '\n');
  ambulo__text_append(&t->lines, "}\n");
  return t->csv.failed || t->lines.failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* an output that no case has is most likely misspelt */
static void warn_of_strangers(const table *t) {
  const ambulo__listing *l = t->listing;
  for (int i = 0; i < l->outputs && t->solved >= 0; i++) {
    if (t->found[i] > 0) continue;
    char near[128], hint[160] = "outputs are keys of summary.json or columns of motion.csv";
    const char *id = ambulo__listing_cell(l, t->solved, AMBULO__LISTING_ID);
    if (ambulo__output_nearest(t->directory, id, l->output[i], &l->allocator, near, sizeof near))
      (void)snprintf(hint, sizeof hint, "did you mean '%s'?", near);
    ambulo__place place = {t->directory, 0, 0, NULL};
    ambulo__warning(t->diagnostics, place, hint, "no case has the output '%s'", l->output[i]);
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

static ambulo_status write_tables(const table *t) {
  const ambulo_allocator *a = &t->listing->allocator;
  ambulo_status status = write_table(t->directory, "results.csv", &t->csv, a, t->diagnostics);
  if (!status) status = write_table(t->directory, "results.jsonl", &t->lines, a, t->diagnostics);
  return status;
}

static ambulo_status write_all(const char *directory, const ambulo__listing *listing,
                               const ambulo__front *front, ambulo_diagnostics *diagnostics,
                               ambulo_batch_census *census) {
  const ambulo_allocator *a = &listing->allocator;
  table t = {.directory = directory,
             .listing = listing,
             .diagnostics = diagnostics,
             .solved = -1,
             .front = front};
  t.found = ambulo__alloc(a, (size_t)listing->outputs, sizeof *t.found);
  ambulo__text_init(&t.csv, a);
  ambulo__text_init(&t.lines, a);
  csv_titles(&t);
  ambulo_status status = t.found ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status)
    status = ambulo__gather(directory, listing, AMBULO__GATHER_OUTPUTS, add_row, &t, census);
  if (!status) status = ambulo__lock_holder(directory, a, diagnostics, census->holder);
  if (!status) status = write_tables(&t);
  if (!status) warn_of_strangers(&t);
  ambulo__free(a, t.found);
  ambulo__text_free(&t.csv);
  ambulo__text_free(&t.lines);
  return status;
}

static ambulo_status collect(const char *directory, const ambulo__listing *listing,
                             ambulo_diagnostics *diagnostics, ambulo_batch_census *census) {
  const ambulo_allocator *a = &listing->allocator;
  ambulo__front front;
  ambulo__front_report report;
  ambulo_front_census found;
  memset(&found, 0, sizeof found);
  if (listing->front.terms == 0) {
    ambulo_status status = write_all(directory, listing, NULL, diagnostics, census);
    census->front = found;
    return status;
  }
  ambulo_status status = ambulo__front_gather(directory, listing, &front, &report);
  if (!status) status = write_all(directory, listing, &front, diagnostics, census);
  if (!status)
    status = ambulo__front_tell(directory, listing, &front, &report, diagnostics, &found);
  census->front = found;
  ambulo__front_free(a, &front);
  return status;
}

ambulo_status ambulo_batch_collect(const char *directory, const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo_batch_census *census) {
  if (!directory) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__listing listing;
  ambulo_batch_census counted;
  ambulo_status status = ambulo__listing_load(directory, allocator, diagnostics, &listing);
  if (!status) {
    status = collect(directory, &listing, diagnostics, &counted);
    ambulo__listing_free(&listing);
  }
  if (!status && census) *census = counted;
  return ambulo__conclude(diagnostics, errors, status, directory);
}
