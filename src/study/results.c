/* study/results.c - the rows of a batch folder; its table; its state (results.h). */
#include "study/results.h"

#include "base/numtext.h"
#include "base/text_buffer.h"
#include "formats/atomic_file.h"
#include "formats/json_text.h"
#include "formats/paths.h"

#include <stdio.h>
#include <string.h>

typedef struct reader {
  const ambulo__table *table;
  ambulo__depth depth;
  ambulo_diagnostics *reasons;                /* why a file could not be read */
  ambulo__output *value;                      /* [outputs] */
  const char **path;                          /* [outputs] */
  const char **cell;                          /* [columns] */
  ambulo__number number[AMBULO__FRONT_TERMS]; /* cells of a front */
  char place[16];
  ambulo_batch_census census;
  ambulo__record record;
  ambulo__damage damage;
} reader;

static void fill_cells(reader *r, int index) {
  static const char *const standings[] = {"", "yes", "valley", "dominated", "repeats", "outside"};
  const ambulo__table *t = r->table;
  const char **cell = r->cell;
  for (int i = 0; i < t->study->axes; i++) *cell++ = ambulo_sweep_value(t->study, index, i);
  if (t->front.points > 0) {
    const ambulo__front_point *p = &t->front.point[index];
    for (int i = 0; i < t->front.terms && i < AMBULO__FRONT_TERMS; i++) {
      if (p->solved) r->number[i] = ambulo__number_text(p->value[i]);
      *cell++ = p->solved ? r->number[i].text : "";
    }
    r->place[0] = '\0';
    if (p->place >= 0) (void)snprintf(r->place, sizeof r->place, "%d", p->place + 1);
    *cell++ = standings[p->standing];
    *cell++ = r->place;
    *cell++ = p->better < 0 ? "" : t->study->cases[p->better].name;
  }
  for (int i = 0; i < t->outputs; i++) *cell++ = r->value[i].text;
}

/* ambulo__damage_of of a result folder's file: that of the first reason */
static ambulo_status damage_of_reading(ambulo_status status, const ambulo_diagnostics *reasons,
                                       ambulo__damage *damage) {
  const ambulo_diagnostic *reason = ambulo_diagnostics_get(reasons, 0);
  const char *file = reason && reason->file ? strrchr(reason->file, '/') : NULL;
  return ambulo__damage_of(status, file ? file : "/", reasons, damage);
}

/* outputs of an intact case; a file that cannot be read after all makes it a damaged one */
static ambulo_status read_outputs(reader *r, const char *id, ambulo__finding *finding) {
  const ambulo__table *t = r->table;
  memset(r->value, 0, (size_t)t->outputs * sizeof *r->value);
  if (*finding != AMBULO__FOUND_INTACT || t->outputs == 0) return AMBULO_OK;
  if (!ambulo__case_files_have(&r->record.files, "/summary.json")) return AMBULO_OK;
  ambulo__diagnostics_clear(r->reasons);
  ambulo_status status = ambulo__outputs_of(t->directory, id, r->path, t->outputs,
                                            &t->study->allocator, r->reasons, r->value);
  if (!status) return AMBULO_OK;
  *finding = AMBULO__FOUND_DAMAGED;
  return damage_of_reading(status, r->reasons, &r->damage);
}

/* the state of a row */
static const char *count(reader *r, ambulo__finding finding) {
  ambulo_batch_census *census = &r->census;
  census->missing += finding == AMBULO__FOUND_NOTHING;
  census->stale += finding == AMBULO__FOUND_STALE;
  census->corrupt += finding == AMBULO__FOUND_DAMAGED;
  if (finding == AMBULO__FOUND_NOTHING) return "missing";
  if (finding == AMBULO__FOUND_STALE) return "stale";
  if (finding == AMBULO__FOUND_DAMAGED) return "corrupt";
  census->done++;
  census->failed += !r->record.valid;
  census->no_result += !ambulo__record_has_result(&r->record);
  census->seconds += r->record.seconds;
  return r->record.state;
}

static ambulo_status read_row(reader *r, int k, ambulo__row *row) {
  const ambulo__table *t = r->table;
  const ambulo__sweep_case *one = &t->study->cases[k];
  ambulo__finding finding;
  ambulo_status status =
      ambulo__record_find(t->directory, one->id, one->key, r->depth != AMBULO__RECORDS,
                          &t->study->allocator, &finding, &r->record, &r->damage);
  /* a point that the front lacks is none that a later look finds intact */
  if (!status && r->depth == AMBULO__CELLS && t->damage && t->damage[k].what[0]) {
    finding = AMBULO__FOUND_DAMAGED;
    r->damage = t->damage[k];
  }
  if (!status && r->depth == AMBULO__CELLS) status = read_outputs(r, one->id, &finding);
  if (status) return status;
  if (r->depth == AMBULO__CELLS) fill_cells(r, k);
  *row = (ambulo__row){.index = k,
                       .id = one->id,
                       .name = one->name,
                       .state = count(r, finding),
                       .valid = finding == AMBULO__FOUND_INTACT && r->record.valid,
                       .cell = r->cell,
                       .damage = finding == AMBULO__FOUND_DAMAGED ? &r->damage : NULL};
  return AMBULO_OK;
}

ambulo_status ambulo__table_rows(const ambulo__table *t, ambulo__depth depth,
                                 ambulo_status (*take)(void *user, const ambulo__row *row),
                                 void *user, ambulo_batch_census *census) {
  const ambulo_allocator *a = &t->study->allocator;
  reader r = {.table = t, .depth = depth};
  r.census.cases = t->study->case_count;
  r.reasons = ambulo_diagnostics_create(a);
  r.value = ambulo__alloc(a, (size_t)t->outputs, sizeof *r.value);
  r.path = ambulo__alloc(a, (size_t)t->outputs, sizeof *r.path);
  r.cell = ambulo__alloc(a, (size_t)t->columns, sizeof *r.cell);
  ambulo_status status = r.reasons && r.value && r.path && r.cell ? AMBULO_OK : AMBULO_E_MEMORY;
  for (int i = 0; i < t->outputs && !status; i++) r.path[i] = t->study->output[i].path;
  for (int k = 0; k < r.census.cases && !status; k++) {
    ambulo__row row;
    status = read_row(&r, k, &row);
    if (!status) status = take(user, &row);
  }
  ambulo_diagnostics_free(r.reasons);
  ambulo__free(a, r.value);
  ambulo__free(a, (void *)r.path);
  ambulo__free(a, (void *)r.cell);
  if (!status && census) *census = r.census;
  return status;
}

/* ----------------------------------------------------------------- opening */

static ambulo_status take_point(void *user, const ambulo__row *row) {
  ambulo__table *t = user;
  ambulo__front_point *p = &t->front.point[row->index];
  *p = (ambulo__front_point){.from = -1, .parent = {-1, -1}}; /* known to the run alone */
  for (int i = 0; i < t->front.terms; i++) {
    const char *cell = ambulo_sweep_value(t->study, row->index, i);
    if (!ambulo__parse_double(cell, strlen(cell), &p->weight[i])) return AMBULO_OK;
  }
  ambulo__damage *damage = &t->damage[row->index];
  if (row->damage) *damage = *row->damage;
  if (!row->valid) return AMBULO_OK;
  const ambulo_allocator *a = &t->study->allocator;
  ambulo_diagnostics *reasons = ambulo_diagnostics_create(a);
  if (!reasons) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__front_read_point(t->directory, row->id, &t->front, a, reasons, p);
  if (status) status = damage_of_reading(status, reasons, damage);
  ambulo_diagnostics_free(reasons);
  return status;
}

static ambulo_status read_front(ambulo__table *t) {
  int count = t->study->case_count;
  t->front = t->study->front;
  t->front.point = ambulo__alloc(&t->study->allocator, (size_t)count, sizeof *t->front.point);
  t->damage = ambulo__alloc(&t->study->allocator, (size_t)count, sizeof *t->damage);
  if (!t->front.point || !t->damage) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__table_rows(t, AMBULO__FILES, take_point, t, NULL);
  t->front.points = count;
  if (!status) ambulo__front_judge(&t->front, &t->report);
  return status;
}

static ambulo_status name_columns(ambulo__table *t) {
  static const char *const words[] = {"front", "place", "better"};
  const ambulo_sweep *s = t->study;
  int terms = s->front.terms;
  t->outputs = s->outputs;
  t->columns = s->axes + s->outputs + (terms > 0 ? terms + 3 : 0);
  t->title = ambulo__alloc(&s->allocator, (size_t)t->columns, sizeof *t->title);
  const char **title = t->title;
  if (!title) return AMBULO_E_MEMORY;
  for (int i = 0; i < s->axes; i++) *title++ = s->axis[i].name;
  for (int i = 0; i < terms; i++) *title++ = s->front.name[i];
  for (int i = 0; i < 3 && terms > 0; i++) *title++ = words[i];
  for (int i = 0; i < s->outputs; i++) *title++ = s->output[i].label;
  return AMBULO_OK;
}

ambulo_status ambulo__table_open(const char *directory, ambulo__depth depth,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo__table *table) {
  ambulo__table t = {.directory = directory};
  ambulo_status status = ambulo__study_load(directory, allocator, diagnostics, &t.study);
  if (!status) status = name_columns(&t);
  if (!status && depth == AMBULO__CELLS && t.study->front.terms > 0) status = read_front(&t);
  if (status) {
    ambulo__table_close(&t);
  } else {
    *table = t;
  }
  return status;
}

void ambulo__table_close(ambulo__table *t) {
  if (!t->study) return;
  ambulo__free(&t->study->allocator, t->front.point);
  ambulo__free(&t->study->allocator, t->damage);
  ambulo__free(&t->study->allocator, (void *)t->title);
  ambulo_sweep_free(t->study);
  t->study = NULL;
}

/* -------------------------------------------------------------- collecting */

typedef struct collector {
  const ambulo__table *table;
  ambulo_diagnostics *diagnostics;
  int *found; /* [outputs] cases that have a value */
  int solved; /* a case with a valid solution; -1: none */
  ambulo__text_buffer csv, lines;
} collector;

/* RFC 4180: quoted where it holds a comma, a quote or a line end */
static void csv_cell(ambulo__text_buffer *text, const char *cell) {
  ambulo__text_append_char(text, ',');
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

/* typed: a number where the text reads as one, null where it is empty */
static void json_cell(ambulo__text_buffer *lines, const char *key, const char *text, int typed) {
  double number;
  ambulo__json json = {lines, 0, 1};
  ambulo__text_append(lines, ", ");
  if (typed && text[0] && ambulo__parse_double(text, strlen(text), &number))
    ambulo__json_number(&json, key, number);
  else
    ambulo__json_text(&json, key, typed && !text[0] ? NULL : text);
}

void ambulo__row_warn(const ambulo__table *t, const ambulo__row *row,
                      ambulo_diagnostics *diagnostics) {
  const ambulo_allocator *a = &t->study->allocator;
  if (!row->damage) return;
  char *path = ambulo__case_path(a, t->directory, row->id, row->damage->ending);
  ambulo__place place = {path ? path : t->directory, 0, 0, NULL};
  ambulo__warning(diagnostics, place, NULL, "damaged: %s; case '%s' is left out", row->damage->what,
                  row->name);
  ambulo__free(a, path);
}

static ambulo_status add_row(void *user, const ambulo__row *row) {
  collector *c = user;
  const ambulo__table *t = c->table;
  ambulo__row_warn(t, row, c->diagnostics);
  if (row->valid) c->solved = row->index;
  ambulo__text_append(&c->csv, row->id);
  csv_cell(&c->csv, row->name);
  csv_cell(&c->csv, row->state);
  ambulo__text_append_char(&c->lines, '{');
  ambulo__json_text(&(ambulo__json){&c->lines, 0, 1}, "id", row->id);
  json_cell(&c->lines, "name", row->name, 0);
  json_cell(&c->lines, "state", row->state, 0);
  for (int i = 0; i < t->columns; i++) {
    int output = i - (t->columns - t->outputs);
    csv_cell(&c->csv, row->cell[i]);
    json_cell(&c->lines, t->title[i], row->cell[i], 1);
    if (output >= 0) c->found[output] += row->cell[i][0] != '\0';
  }
  ambulo__text_append_char(&c->csv, '\n');
  ambulo__text_append(&c->lines, "}\n");
  return c->csv.failed || c->lines.failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* an output that no case has is probably misspelt */
static void warn_of_unknown_outputs(const collector *c) {
  const ambulo__table *t = c->table;
  for (int i = 0; i < t->outputs && c->solved >= 0; i++) {
    if (c->found[i] > 0) continue;
    char near[128], hint[160] = "outputs are keys of summary.json or columns of motion.csv";
    const char *path = t->study->output[i].path;
    if (ambulo__output_nearest(t->directory, t->study->cases[c->solved].id, path,
                               &t->study->allocator, near, sizeof near))
      (void)snprintf(hint, sizeof hint, "did you mean '%s'?", near);
    ambulo__place place = {t->directory, 0, 0, NULL};
    ambulo__warning(c->diagnostics, place, hint, "no case has the output '%s'", path);
  }
}

static ambulo_status write_text(const collector *c, const char *name,
                                const ambulo__text_buffer *text) {
  const ambulo_allocator *a = &c->table->study->allocator;
  char *path = ambulo__join_paths(a, c->table->directory, name, NULL);
  ambulo_status status = path ? ambulo__text_status(text) : AMBULO_E_MEMORY;
  if (!status)
    status = ambulo__write_file(path, ambulo__text_data(text), text->length, 1, a, c->diagnostics);
  ambulo__free(a, path);
  return status;
}

static ambulo_status collect(const ambulo__table *t, ambulo_diagnostics *diagnostics,
                             ambulo_batch_census *census) {
  const ambulo_allocator *a = &t->study->allocator;
  collector c = {.table = t, .diagnostics = diagnostics, .solved = -1};
  c.found = ambulo__alloc(a, (size_t)t->outputs, sizeof *c.found);
  ambulo__text_init(&c.csv, a);
  ambulo__text_init(&c.lines, a);
  ambulo__text_append(&c.csv, "id,name,state");
  for (int i = 0; i < t->columns; i++) csv_cell(&c.csv, t->title[i]);
  ambulo__text_append_char(&c.csv, '\n');
  ambulo_status status = c.found ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__table_rows(t, AMBULO__CELLS, add_row, &c, census);
  if (!status) status = ambulo__lock_holder(t->directory, a, diagnostics, census->holder);
  if (!status) status = write_text(&c, "results.csv", &c.csv);
  if (!status) status = write_text(&c, "results.jsonl", &c.lines);
  if (!status) warn_of_unknown_outputs(&c);
  if (!status && t->study->front.terms > 0)
    status = ambulo__front_census(t, diagnostics, &census->front);
  ambulo__free(a, c.found);
  ambulo__text_free(&c.csv);
  ambulo__text_free(&c.lines);
  return status;
}

/* --------------------------------------------------------------- the state */

typedef struct verification {
  const ambulo__table *table;
  void (*damaged)(void *user, const ambulo_batch_damage *damage);
  void *user;
} verification;

static ambulo_status report_damage(void *user, const ambulo__row *row) {
  const verification *v = user;
  const ambulo_allocator *a = &v->table->study->allocator;
  if (!row->damage || !v->damaged) return AMBULO_OK;
  char *path = ambulo__case_path(a, v->table->directory, row->id, row->damage->ending);
  if (!path) return AMBULO_E_MEMORY;
  v->damaged(v->user, &(ambulo_batch_damage){row->id, row->name, path, row->damage->what});
  ambulo__free(a, path);
  return AMBULO_OK;
}

static ambulo_status inspect(const char *directory, ambulo__depth depth, verification *v,
                             const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                             ambulo_batch_census *census) {
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__table table = {.study = NULL};
  ambulo_batch_census counted;
  if (!directory) return AMBULO_E_ARGUMENT;
  v->table = &table;
  ambulo_status status = ambulo__table_open(directory, depth, allocator, diagnostics, &table);
  if (!status && depth == AMBULO__CELLS) {
    status = collect(&table, diagnostics, &counted);
  } else if (!status) {
    status = ambulo__table_rows(&table, depth, report_damage, v, &counted);
    if (!status)
      status = ambulo__lock_holder(directory, &table.study->allocator, diagnostics, counted.holder);
  }
  ambulo__table_close(&table);
  v->table = NULL;
  if (!status && census) *census = counted;
  return ambulo__conclude(diagnostics, errors, status, directory);
}

ambulo_status ambulo_batch_status(const char *directory, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_batch_census *census) {
  verification v = {.damaged = NULL};
  if (!census) return AMBULO_E_ARGUMENT;
  return inspect(directory, AMBULO__RECORDS, &v, allocator, diagnostics, census);
}

ambulo_status ambulo_batch_verify(const char *directory,
                                  void (*damaged)(void *user, const ambulo_batch_damage *damage),
                                  void *user, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_batch_census *census) {
  verification v = {.damaged = damaged, .user = user};
  return inspect(directory, AMBULO__FILES, &v, allocator, diagnostics, census);
}

ambulo_status ambulo_batch_collect(const char *directory, const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo_batch_census *census) {
  verification v = {.damaged = NULL};
  return inspect(directory, AMBULO__CELLS, &v, allocator, diagnostics, census);
}
