/* study/study_page.c - a batch folder as a page (ambulo/tools/batch.h).
 *
 *     {"study": {"name", "motions": [...], "table"}}
 *
 * "motions": case_pack.h. "table", compressed, has the columns of results.csv (results.h), and a
 * row for each case:
 *
 *     {"columns": [titles], "axes", "zipped", "front": {"terms", "order", "refused"},
 *      "cases": [{"id", "name", "state", "values": [...]}, ...], "shown": [case of each motion]}
 *
 * The first `axes` columns are the axes, of which the first `zipped` advance together. A front has
 * the columns of its terms, the cases along it, and the places behind which no weights lead to the
 * next one (front.h). */
#include "formats/atomic_file.h"
#include "show/page.h"
#include "study/case_pack.h"
#include "study/results.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

typedef struct page {
  ambulo__table table;
  ambulo__text_buffer rows;
  int count;     /* cases that have a result folder */
  int *number;   /* [cases]: which they are */
  char **folder; /* [cases]: where */
  char *shown;   /* [cases]: its motion is in the page */
  ambulo_diagnostics *diagnostics;
} page;

/* the folder of a case, where it has one */
static ambulo_status find_folder(page *p, const ambulo__row *row) {
  static const char *const without[] = {"missing", "stale", "corrupt"};
  const ambulo_allocator *a = &p->rows.allocator;
  struct stat entry;
  for (size_t i = 0; i < sizeof without / sizeof *without; i++)
    if (strcmp(row->state, without[i]) == 0) return AMBULO_OK;
  char *folder = ambulo__case_path(a, p->table.directory, row->id, "");
  if (!folder) return AMBULO_E_MEMORY;
  int there = stat(folder, &entry) == 0;
  if (!there || !S_ISDIR(entry.st_mode)) {
    ambulo_status status =
        there || errno == ENOENT ? AMBULO_OK : ambulo__io_error(p->diagnostics, folder, "inspect");
    ambulo__free(a, folder);
    return status;
  }
  p->number[p->count] = row->index;
  p->folder[p->count++] = folder;
  return AMBULO_OK;
}

static ambulo_status add_row(void *user, const ambulo__row *row) {
  page *p = user;
  ambulo__row_warn(&p->table, row, p->diagnostics);
  ambulo__text_append(&p->rows, row->index ? ",{\"id\":" : "{\"id\":");
  ambulo__script_text(&p->rows, row->id);
  ambulo__text_append(&p->rows, ",\"name\":");
  ambulo__script_text(&p->rows, row->name);
  ambulo__text_append(&p->rows, ",\"state\":");
  ambulo__script_text(&p->rows, row->state);
  ambulo__text_append(&p->rows, ",\"values\":[");
  for (int i = 0; i < p->table.columns; i++) {
    if (i) ambulo__text_append_char(&p->rows, ',');
    ambulo__script_value(&p->rows, row->cell[i]);
  }
  ambulo__text_append(&p->rows, "]}");
  ambulo_status status = find_folder(p, row);
  return status ? status : ambulo__text_status(&p->rows);
}

/* "knee torque, N m" */
static void add_titles(const ambulo__table *t, ambulo__text_buffer *out) {
  const ambulo_sweep *s = t->study;
  ambulo__text_buffer title;
  ambulo__text_init_part(&title, out);
  for (int i = 0; i < t->columns; i++) {
    int o = i - (t->columns - t->outputs);
    const char *unit = i < s->axes ? s->axis[i].unit : o >= 0 ? s->output[o].unit : "";
    ambulo__text_clear(&title);
    ambulo__text_append(&title, i < s->axes ? s->axis[i].label : t->title[i]);
    if (unit[0]) ambulo__text_append(&title, ", ");
    ambulo__text_append(&title, unit);
    if (i) ambulo__text_append_char(out, ',');
    ambulo__script_text(out, ambulo__text_data(&title));
  }
  ambulo__text_free(&title);
}

/* `order` of both kinds of fronts, the gaps of two terms */
static ambulo_status add_front(const ambulo__table *t, ambulo__text_buffer *out) {
  const ambulo__front *f = &t->front;
  const ambulo_allocator *a = &out->allocator;
  ambulo__front_gap *gap = ambulo__alloc(a, (size_t)f->points + 1, sizeof *gap);
  int *order = ambulo__alloc(a, (size_t)f->points, sizeof *order), gaps = 0;
  ambulo_status status = gap && order ? AMBULO_OK : AMBULO_E_MEMORY;
  for (int k = 0; k < f->points && !status; k++)
    if (f->point[k].place >= 0) order[f->point[k].place] = k;
  if (!status && f->terms == 2) ambulo__front_gaps(f, gap, &gaps);
  ambulo__text_append(out, "\"front\":{\"terms\":[");
  for (int i = 0; i < f->terms; i++)
    ambulo__text_append_format(out, i ? ",%d" : "%d", t->study->axes + i);
  ambulo__text_append(out, "],\"order\":[");
  for (int i = 0; i < t->report.on && !status; i++)
    ambulo__text_append_format(out, i ? ",%d" : "%d", order[i]);
  ambulo__text_append(out, "],\"refused\":[");
  for (int i = 0, written = 0; i < gaps; i++)
    if (gap[i].refused) ambulo__text_append_format(out, written++ ? ",%d" : "%d", i);
  ambulo__text_append(out, "]},");
  ambulo__free(a, gap);
  ambulo__free(a, order);
  return status;
}

static ambulo_status add_table(const page *p, ambulo__text_buffer *out) {
  const ambulo__table *t = &p->table;
  ambulo__text_buffer text;
  ambulo_status status = AMBULO_OK;
  ambulo__text_init_part(&text, out);
  ambulo__text_append(&text, "{\"columns\":[");
  add_titles(t, &text);
  ambulo__text_append_format(&text, "],\"axes\":%d,\"zipped\":%d,", t->study->axes,
                             t->study->zipped);
  if (t->front.points > 0) status = add_front(t, &text);
  ambulo__text_append(&text, "\"cases\":[");
  ambulo__text_append(&text, ambulo__text_data(&p->rows));
  ambulo__text_append(&text, "],\"shown\":[");
  for (int i = 0, written = 0; i < p->count; i++)
    if (p->shown[i]) ambulo__text_append_format(&text, written++ ? ",%d" : "%d", p->number[i]);
  ambulo__text_append(&text, "]}");
  ambulo__packed_text(out, ambulo__text_data(&text), text.length);
  ambulo__text_free(&text);
  return status;
}

/* in `room` bytes; what the table leaves is for motions: with all of them it is the longest */
static ambulo_status add_study(page *p, double room, ambulo__text_buffer *out) {
  ambulo__text_buffer table;
  ambulo__text_init_part(&table, out);
  ambulo__text_append(out, "\"study\":{\"name\":");
  ambulo__script_text(out, p->table.study->name);
  ambulo__text_append(out, ",\"motions\":");
  memset(p->shown, 1, (size_t)p->count);
  ambulo_status status = add_table(p, &table);
  memset(p->shown, 0, (size_t)p->count);
  room -= (double)(table.length + out->length);
  ambulo__text_clear(&table);
  if (!status) status = ambulo__case_pack(out, p->folder, p->count, room, p->diagnostics, p->shown);
  if (!status) status = add_table(p, &table);
  ambulo__text_append(out, ",\"table\":");
  ambulo__text_append(out, ambulo__text_data(&table));
  ambulo__text_append_char(out, '}');
  ambulo__text_free(&table);
  return status ? status : ambulo__text_status(out);
}

static void warn_of_left_out(const page *p, double megabytes) {
  ambulo__place place = {.file = p->table.directory};
  int left_out = p->count;
  for (int i = 0; i < p->count; i++) left_out -= p->shown[i];
  if (left_out > 0)
    ambulo__warning(p->diagnostics, place, "--size takes more (in C: megabytes)",
                    "%d case%s in the table without motion: %g MB are the most that the page takes",
                    left_out, left_out == 1 ? " is" : "s are", megabytes);
}

static ambulo_status fill(page *p, double megabytes, ambulo__text_buffer *out,
                          ambulo_batch_census *census) {
  const ambulo_allocator *a = &out->allocator;
  size_t cases = (size_t)p->table.study->case_count;
  double room = 1e6 * megabytes - (double)ambulo__viewer_size;
  ambulo__text_init_part(&p->rows, out);
  p->number = ambulo__alloc(a, cases, sizeof *p->number);
  p->folder = ambulo__alloc(a, cases, sizeof *p->folder);
  p->shown = ambulo__alloc(a, cases, 1);
  ambulo_status status = p->number && p->folder && p->shown ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__table_rows(&p->table, AMBULO__CELLS, add_row, p, census);
  if (!status) status = add_study(p, room, out);
  if (!status) warn_of_left_out(p, megabytes);
  for (int i = 0; p->folder && i < p->count; i++) ambulo__free(a, p->folder[i]);
  ambulo__free(a, p->number);
  ambulo__free(a, (void *)p->folder);
  ambulo__free(a, p->shown);
  ambulo__text_free(&p->rows);
  return status;
}

ambulo_status ambulo_batch_page(const char *directory, const char *output,
                                const ambulo_page_options *options,
                                const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                ambulo_batch_census *census) {
  ambulo_page_options own;
  ambulo_batch_census counted;
  if (!directory) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = ambulo__page_begin(options, output, diagnostics, &own);
  if (status == AMBULO_E_ARGUMENT) return status;
  page p = {.diagnostics = diagnostics};
  ambulo__text_buffer data;
  ambulo__text_init(&data, allocator);
  ambulo__text_append_char(&data, '{');
  if (!status)
    status = ambulo__table_open(directory, AMBULO__CELLS, allocator, diagnostics, &p.table);
  if (!status) status = fill(&p, own.megabytes, &data, &counted);
  ambulo__text_append_char(&data, '}');
  if (!status) status = ambulo__page_save(output, &data, diagnostics);
  if (!status && census) *census = counted;
  ambulo__table_close(&p.table);
  ambulo__text_free(&data);
  return ambulo__conclude(diagnostics, errors, status, output);
}
