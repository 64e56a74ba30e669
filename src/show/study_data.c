/* show/study_data.c - a batch folder as data of a page (page.h).
 *
 * The table of cases, packed as one text, and their motions (study_motions.h), as many as there is
 * room for; further cases lead to the picture in their folder.
 */
#include <string.h>
#include <sys/stat.h>

#include "formats/paths.h"
#include "study/case_path.h"
#include "study/gather.h"
#include "show/page.h"
#include "show/study_motions.h"

typedef struct study {
  const char *directory;
  char *way; /* from the page's folder to that of the batch: "", "../study/"; NULL: unknown */
  const ambulo__listing *listing;
  ambulo__text_buffer *rows;
  int count;     /* cases that have a result folder */
  int *number;   /* [cases]: which they are */
  char **folder; /* [cases]: where */
  char *stands;  /* [cases]: its motion is in the page */
} study;

int ambulo__page_is_batch(const char *directory) {
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  struct stat entry;
  char *path = ambulo__join_paths(&a, directory, "batch.json", NULL);
  int there = path && stat(path, &entry) == 0;
  ambulo__free(&a, path);
  return there;
}

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
  for (int i = 0; i < l->axes + l->outputs; i++) {
    int o = i - l->axes;
    if (i) ambulo__text_append_char(out, ',');
    if (o < 0)
      title(out, ambulo__listing_title(l, AMBULO__LISTING_AXES + i), l->axis_label[i],
            l->axis_unit[i]);
    else
      title(out, l->output[o], l->output_label[o], l->output_unit[o]);
  }
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

/* {"columns", "cases", "shown": numbers of cases in the order of their motions, "pictures":
 * [[number, path], ...] of the others} as a text of the page */
static void table(const study *s, ambulo__text_buffer *out) {
  ambulo__text_buffer text;
  int written = 0;
  ambulo__text_init_part(&text, out);
  ambulo__text_append(&text, "{\"columns\":[");
  columns(s, &text);
  ambulo__text_append(&text, "],\"cases\":[");
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
  table(s, &longest);
  room -= (double)longest.length;
  ambulo__text_free(&longest);
  ambulo_status status =
      ambulo__study_motions(out, s->folder, s->count, room, diagnostics, s->stands);
  ambulo__text_append(out, ",\"table\":");
  table(s, out);
  ambulo__text_append_char(out, '}');
  return status;
}

static ambulo_status prepare(study *s, const char *folder, const ambulo_allocator *a) {
  size_t cases = (size_t)s->listing->cases;
  s->way = ambulo__path_between(a, folder, s->directory);
  s->number = ambulo__alloc(a, cases, sizeof *s->number);
  s->folder = ambulo__alloc(a, cases, sizeof *s->folder);
  s->stands = ambulo__alloc(a, cases, 1);
  size_t length = s->way ? strlen(s->way) : 0;
  if (length > 1 && s->way[length - 1] == '/') s->way[length - 1] = '\0';
  return s->number && s->folder && s->stands ? AMBULO_OK : AMBULO_E_MEMORY;
}

ambulo_status ambulo__page_add_study(const char *directory, const char *folder, double megabytes,
                                     double other, ambulo__text_buffer *out,
                                     ambulo_diagnostics *diagnostics) {
  const ambulo_allocator *a = &out->allocator;
  ambulo__listing listing;
  ambulo_status status = ambulo__listing_load(directory, a, diagnostics, &listing);
  if (status) return status;
  ambulo__text_buffer rows;
  ambulo__text_init_part(&rows, out);
  study s = {.directory = directory, .listing = &listing, .rows = &rows};
  status = prepare(&s, folder, a);
  if (!status)
    status = ambulo__gather(directory, &listing, AMBULO__GATHER_OUTPUTS, add_case, &s, NULL);
  if (!status) status = append(&s, 1e6 * megabytes - other - (double)out->length, out, diagnostics);
  if (!status) tell_left_out(&s, megabytes, diagnostics);
  for (int i = 0; i < s.count; i++) ambulo__free(a, s.folder[i]);
  ambulo__free(a, s.way);
  ambulo__free(a, s.number);
  ambulo__free(a, (void *)s.folder);
  ambulo__free(a, s.stands);
  ambulo__text_free(&rows);
  ambulo__listing_free(&listing);
  return status ? status : ambulo__text_status(out);
}
