/* study/study_page.c - a batch folder as a page (ambulo/tools/batch.h).
 *
 *     {"name", "motions": [...], "table"}
 *
 * "motions": case_pack.h. "table", compressed, has a row for each case:
 *
 *     {"columns": [titles], "axes", "zipped", "front": {"terms", "order", "refused"},
 *      "cases": [{"id", "name", "state", "values": [...]}, ...],
 *      "shown": [case of each motion], "pictures": [[case, path of its gait.svg], ...]}
 *
 * The first `axes` columns are the axes, of which the first `zipped` advance together. A front has
 * the columns of its terms, the cases along it, and the places behind which no weights lead to the
 * next one (front.h). Cases without room for their motion lead to the picture in their folder.
 */
#include "ambulo/tools/batch.h"

#include <string.h>
#include <sys/stat.h>

#include "base/numtext.h"
#include "formats/paths.h"
#include "show/page.h"
#include "study/case_pack.h"
#include "study/case_path.h"
#include "study/front_points.h"

typedef struct study {
  const char *directory;
  char *way; /* from the page's folder to that of the batch: "", "../study/"; NULL: unknown */
  const ambulo__listing *listing;
  ambulo__front front; /* of no points where there is none */
  ambulo__text_buffer *rows;
  int count;     /* cases that have a result folder */
  int *number;   /* [cases]: which they are */
  char **folder; /* [cases]: where */
  char *stands;  /* [cases]: its motion is in the page */
} study;

/* ------------------------------------------------------------------ one case */

static int is_folder(const char *path) {
  struct stat entry;
  return stat(path, &entry) == 0 && S_ISDIR(entry.st_mode);
}

/* its folder, where it has one */
static ambulo_status find_folder(study *s, const ambulo__gathered *one, const char *id) {
  static const char *const without[] = {"missing", "stale", "corrupt"};
  for (size_t i = 0; i < sizeof without / sizeof without[0]; i++)
    if (strcmp(one->state, without[i]) == 0) return AMBULO_OK;
  char *folder = ambulo__case_path(&s->rows->allocator, s->directory, id, "");
  if (!folder) return AMBULO_E_MEMORY;
  if (!is_folder(folder)) {
    ambulo__free(&s->rows->allocator, folder);
    return AMBULO_OK;
  }
  s->number[s->count] = one->index;
  s->folder[s->count++] = folder;
  return AMBULO_OK;
}

/* values of the terms; where the point stands, and its place */
static void add_point(study *s, int index) {
  const ambulo__front_point *p = &s->front.point[index];
  char text[AMBULO__NUMTEXT_SIZE];
  for (int i = 0; i < s->front.terms; i++) {
    text[0] = '\0';
    if (p->solved) (void)ambulo__print_double(text, p->value[i]);
    ambulo__text_append_char(s->rows, ',');
    ambulo__script_value(s->rows, text);
  }
  ambulo__text_append_char(s->rows, ',');
  ambulo__script_value(s->rows, ambulo__front_word(p->standing));
  ambulo__text_append_char(s->rows, ',');
  if (p->place < 0)
    ambulo__text_append(s->rows, "null");
  else
    ambulo__text_append_format(s->rows, "%d", p->place + 1);
}

static ambulo_status add_case(void *user, const ambulo__gathered *one) {
  study *s = user;
  const ambulo__listing *l = s->listing;
  const char *id = ambulo__listing_cell(l, one->index, AMBULO__LISTING_ID);
  ambulo__text_append(s->rows, one->index ? ",{\"id\":" : "{\"id\":");
  ambulo__script_text(s->rows, id);
  ambulo__text_append(s->rows, ",\"name\":");
  ambulo__script_text(s->rows, ambulo__listing_cell(l, one->index, AMBULO__LISTING_NAME));
  ambulo__text_append(s->rows, ",\"state\":");
  ambulo__script_text(s->rows, one->state);
  ambulo__text_append(s->rows, ",\"values\":[");
  for (int i = AMBULO__LISTING_AXES; i < l->columns; i++) {
    if (i > AMBULO__LISTING_AXES) ambulo__text_append_char(s->rows, ',');
    ambulo__script_value(s->rows, ambulo__listing_cell(l, one->index, i));
  }
  if (s->front.points > 0) add_point(s, one->index);
  for (int i = 0; i < l->outputs; i++) {
    if (i || l->axes) ambulo__text_append_char(s->rows, ',');
    ambulo__script_value(s->rows,
                         one->value[i].kind == AMBULO__OUTPUT_NONE ? "" : one->value[i].text);
  }
  ambulo__text_append(s->rows, "]}");
  ambulo_status status = find_folder(s, one, id);
  return status ? status : ambulo__text_status(s->rows);
}

/* ----------------------------------------------------------------- the study */

/* "knee torque, N m", or the title of the column itself */
static void title(ambulo__text_buffer *out, const char *name, const char *label, const char *unit) {
  ambulo__text_buffer text;
  ambulo__text_init_part(&text, out);
  ambulo__text_append(&text, label && label[0] ? label : name);
  if (unit && unit[0]) {
    ambulo__text_append(&text, ", ");
    ambulo__text_append(&text, unit);
  }
  ambulo__script_text(out, ambulo__text_data(&text));
  ambulo__text_free(&text);
}

static void columns(const study *s, ambulo__text_buffer *out) {
  const ambulo__listing *l = s->listing;
  for (int i = 0; i < l->axes; i++) {
    if (i) ambulo__text_append_char(out, ',');
    title(out, ambulo__listing_title(l, AMBULO__LISTING_AXES + i), l->axis_label[i],
          l->axis_unit[i]);
  }
  for (int i = 0; i < l->front.terms; i++) {
    ambulo__text_append_char(out, ',');
    ambulo__script_text(out, l->front.name[i]);
  }
  if (l->front.terms > 0) ambulo__text_append(out, ",\"front\",\"place\"");
  for (int i = 0; i < l->outputs; i++) {
    if (i || l->axes) ambulo__text_append_char(out, ',');
    title(out, l->output[i], l->output_label[i], l->output_unit[i]);
  }
}

/* `order` of both kinds of fronts, the gaps of two terms */
static ambulo_status add_front(const study *s, ambulo__text_buffer *out) {
  const ambulo__front *f = &s->front;
  const ambulo_allocator *a = &out->allocator;
  ambulo__front_gap *gap = ambulo__alloc(a, (size_t)f->points + 1, sizeof *gap);
  int gaps = 0, *order = ambulo__alloc(a, (size_t)f->points, sizeof *order), on = 0;
  for (int k = 0; k < f->points && gap && order; k++) {
    if (f->point[k].place >= 0) order[f->point[k].place] = k;
    on += f->point[k].place >= 0;
  }
  if (gap && f->terms == 2) ambulo__front_gaps(f, gap, &gaps);
  ambulo__text_append(out, "\"front\":{\"terms\":[");
  for (int i = 0; i < f->terms; i++)
    ambulo__text_append_format(out, i ? ",%d" : "%d", s->listing->axes + i);
  ambulo__text_append(out, "],\"order\":[");
  for (int i = 0; i < on; i++) ambulo__text_append_format(out, i ? ",%d" : "%d", order[i]);
  ambulo__text_append(out, "],\"refused\":[");
  for (int i = 0, written = 0; i < gaps; i++)
    if (gap[i].refused) ambulo__text_append_format(out, written++ ? ",%d" : "%d", i);
  ambulo__text_append(out, "]},");
  ambulo_status status = gap && order ? AMBULO_OK : AMBULO_E_MEMORY;
  ambulo__free(a, gap);
  ambulo__free(a, order);
  return status;
}

/* where the page stands in the folder itself the way is "", and is said to be "." */
static void add_picture(const study *s, int number, ambulo__text_buffer *out) {
  const char *id = ambulo__listing_cell(s->listing, number, AMBULO__LISTING_ID);
  char *picture = ambulo__case_path(&out->allocator, s->way[0] ? s->way : ".", id, "/gait.svg");
  if (!picture) out->failed = 1;
  if (!picture) return;
  ambulo__text_append_format(out, "[%d,", number);
  ambulo__script_text(out, picture);
  ambulo__text_append_char(out, ']');
  ambulo__free(&out->allocator, picture);
}

static ambulo_status table(const study *s, ambulo__text_buffer *out) {
  ambulo__text_buffer text;
  ambulo_status status = AMBULO_OK;
  int written = 0;
  ambulo__text_init_part(&text, out);
  ambulo__text_append(&text, "{\"columns\":[");
  columns(s, &text);
  ambulo__text_append_format(&text, "],\"axes\":%d,\"zipped\":%d,", s->listing->axes,
                             s->listing->zipped);
  if (s->front.points > 0) status = add_front(s, &text);
  ambulo__text_append(&text, "\"cases\":[");
  ambulo__text_append(&text, ambulo__text_data(s->rows));
  ambulo__text_append(&text, "],\"shown\":[");
  for (int i = 0; i < s->count; i++)
    if (s->stands[i]) ambulo__text_append_format(&text, written++ ? ",%d" : "%d", s->number[i]);
  ambulo__text_append(&text, "],\"pictures\":[");
  for (int i = 0, pictures = 0; i < s->count && s->way; i++) {
    if (s->stands[i]) continue;
    if (pictures++) ambulo__text_append_char(&text, ',');
    add_picture(s, s->number[i], &text);
  }
  ambulo__text_append(&text, "]}");
  ambulo__packed_text(out, ambulo__text_data(&text), text.length);
  ambulo__text_free(&text);
  return status;
}

static void tell_left_out(const study *s, double megabytes, ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = s->directory};
  int left_out = s->count;
  for (int i = 0; i < s->count; i++) left_out -= s->stands[i];
  if (left_out > 0)
    ambulo__warning(diagnostics, place, "--size takes more (in C: megabytes)",
                    "%d case%s in the table without motion: %g MB are the most that the page takes",
                    left_out, left_out == 1 ? " is" : "s are", megabytes);
}

/* tables without any motion are the longest: what they leave is for motions */
static ambulo_status append(study *s, double room, ambulo__text_buffer *out,
                            ambulo_diagnostics *diagnostics) {
  ambulo__text_buffer longest;
  ambulo__text_init_part(&longest, out);
  ambulo__text_append(out, "\"study\":{\"name\":");
  ambulo__script_text(out, s->listing->name);
  ambulo__text_append(out, ",\"motions\":");
  ambulo_status status = table(s, &longest);
  room -= (double)longest.length;
  ambulo__text_free(&longest);
  if (!status) status = ambulo__case_pack(out, s->folder, s->count, room, diagnostics, s->stands);
  ambulo__text_append(out, ",\"table\":");
  if (!status) status = table(s, out);
  ambulo__text_append_char(out, '}');
  return status;
}

/* the folder of a file, to be freed; NULL: no memory */
static char *folder_of(const ambulo_allocator *a, const char *path) {
  const char *slash = strrchr(path, '/');
  size_t length = !slash ? 0 : slash == path ? 1 : (size_t)(slash - path);
  char *folder = ambulo__alloc(a, length + 2, 1);
  if (!folder) return NULL;
  memcpy(folder, slash ? path : ".", slash ? length : 1);
  folder[slash ? length : 1] = '\0';
  return folder;
}

static ambulo_status prepare(study *s, const char *output, const ambulo_allocator *a) {
  size_t cases = (size_t)s->listing->cases;
  char *folder = folder_of(a, output);
  if (folder) s->way = ambulo__path_between(a, folder, s->directory);
  s->number = ambulo__alloc(a, cases, sizeof *s->number);
  s->folder = ambulo__alloc(a, cases, sizeof *s->folder);
  s->stands = ambulo__alloc(a, cases, 1);
  size_t length = s->way ? strlen(s->way) : 0;
  if (length > 1 && s->way[length - 1] == '/') s->way[length - 1] = '\0';
  ambulo_status status =
      folder && s->number && s->folder && s->stands ? AMBULO_OK : AMBULO_E_MEMORY;
  ambulo__free(a, folder);
  ambulo__front_report report;
  if (!status && s->listing->front.terms > 0)
    status = ambulo__front_gather(s->directory, s->listing, &s->front, &report);
  return status;
}

/* appends "study" */
static ambulo_status add_study(const char *directory, const char *output, double megabytes,
                               ambulo__text_buffer *out, ambulo_diagnostics *diagnostics) {
  const ambulo_allocator *a = &out->allocator;
  ambulo__listing listing;
  ambulo_status status = ambulo__listing_load(directory, a, diagnostics, &listing);
  if (status) return status;
  ambulo__text_buffer rows;
  ambulo__text_init_part(&rows, out);
  study s = {.directory = directory, .listing = &listing, .rows = &rows};
  status = prepare(&s, output, a);
  if (!status)
    status = ambulo__gather(directory, &listing, AMBULO__GATHER_OUTPUTS, add_case, &s, NULL);
  double room = 1e6 * megabytes - (double)ambulo__viewer_size - (double)out->length;
  if (!status) status = append(&s, room, out, diagnostics);
  if (!status) tell_left_out(&s, megabytes, diagnostics);
  for (int i = 0; i < s.count; i++) ambulo__free(a, s.folder[i]);
  ambulo__free(a, s.way);
  ambulo__free(a, s.number);
  ambulo__free(a, (void *)s.folder);
  ambulo__free(a, s.stands);
  ambulo__front_free(a, &s.front);
  ambulo__text_free(&rows);
  ambulo__listing_free(&listing);
  return status ? status : ambulo__text_status(out);
}

ambulo_status ambulo_batch_page(const char *directory, const char *output,
                                const ambulo_page_options *options,
                                const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics) {
  ambulo_page_options own;
  if (!directory) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = ambulo__page_begin(options, output, diagnostics, &own);
  if (status == AMBULO_E_ARGUMENT) return status;
  ambulo__text_buffer data;
  ambulo__text_init(&data, allocator);
  ambulo__text_append_char(&data, '{');
  if (!status) status = add_study(directory, output, own.megabytes, &data, diagnostics);
  ambulo__text_append_char(&data, '}');
  if (!status) status = ambulo__page_save(output, &data, diagnostics);
  ambulo__text_free(&data);
  return ambulo__conclude(diagnostics, errors, status, output);
}
