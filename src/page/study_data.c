/* page/study_data.c - a batch folder as data of a page (page.h).
 *
 * Motions of cases are thinned (thin.h), their summaries cut down to what is shown. A page holds so
 * many of them; further cases lead to the picture in their folder.
 */
#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "base/numtext.h"
#include "base/paths.h"
#include "batch/case_path.h"
#include "collect/gather.h"
#include "page/packed_text.h"
#include "page/page.h"
#include "page/script_text.h"
#include "page/thin.h"

typedef struct study {
  const char *directory;
  char *way; /* from the page's folder to that of the batch: "", "../study/"; NULL: unknown */
  const ambulo__listing *listing;
  ambulo__text_buffer *out;
  ambulo_diagnostics *diagnostics;
  double megabytes; /* of motions at most */
  size_t motions;   /* bytes of them so far */
  int left_out;     /* cases whose motion had no room */
} study;

int ambulo__page_is_batch(const char *directory) {
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  struct stat entry;
  char *path = ambulo__join_paths(&a, directory, "batch.json", NULL);
  int there = path && stat(path, &entry) == 0;
  ambulo__free(&a, path);
  return there;
}

/* ------------------------------------------------------------------- one case */

/* a cell of the table: a number where it reads as one */
static void cell(ambulo__text_buffer *out, const char *text) {
  double number;
  if (!text[0]) {
    ambulo__text_append(out, "null");
  } else if (ambulo__parse_double(text, strlen(text), &number) && isfinite(number)) {
    ambulo__text_append_number(out, number);
  } else {
    ambulo__script_text(out, text);
  }
}

static void node(ambulo__text_buffer *out, const ambulo__yaml_node *value);

static void pairs(ambulo__text_buffer *out, const ambulo__yaml_node *map, const char *const *left) {
  int written = 0;
  ambulo__text_append_char(out, '{');
  for (int i = 0; i < ambulo__yaml_pairs(map); i++) {
    const char *key = ambulo__yaml_key(map, i);
    int skipped = 0;
    for (const char *const *l = left; l && *l; l++) skipped |= strcmp(*l, key) == 0;
    if (skipped) continue;
    if (written++) ambulo__text_append_char(out, ',');
    ambulo__script_text(out, key);
    ambulo__text_append_char(out, ':');
    node(out, ambulo__yaml_value(map, i));
  }
  ambulo__text_append_char(out, '}');
}

/* JSON that was read as YAML, as JSON again; a text that reads as a number becomes one */
static void node(ambulo__text_buffer *out, const ambulo__yaml_node *value) {
  if (ambulo__yaml_is(value, AMBULO__YAML_MAPPING)) {
    pairs(out, value, NULL);
  } else if (ambulo__yaml_is(value, AMBULO__YAML_SEQUENCE)) {
    ambulo__text_append_char(out, '[');
    for (int i = 0; i < ambulo__yaml_items(value); i++) {
      if (i) ambulo__text_append_char(out, ',');
      node(out, ambulo__yaml_item(value, i));
    }
    ambulo__text_append_char(out, ']');
  } else {
    const char *text = ambulo__yaml_text(value);
    cell(out, strcmp(text, "null") == 0 ? "" : text);
  }
}

/* *stands: its motion is in the page */
static ambulo_status add_motion(study *s, const char *folder, int *stands) {
  static const char *const left[] = {
      "families",         "between_nodes", "sensitivities", "approaches",
      "no_sensitivities", "versions",      "convergence",   NULL};
  const ambulo_allocator *a = &s->out->allocator;
  ambulo__page_result result;
  ambulo__text_buffer thin, data, packed;
  ambulo_status status = ambulo__page_result_read(folder, a, s->diagnostics, &result);
  if (status) return status;
  ambulo__text_init(&thin, a);
  ambulo__text_init_part(&data, &thin);
  ambulo__text_init_part(&packed, &thin);
  ambulo__scene_thin(&thin, result.scene.text, result.scene.length);
  ambulo__text_append(&data, "{\"summary\":");
  pairs(&data, ambulo__yaml_root(result.summary.document), left);
  ambulo__text_append(&data, ",\"scene\":");
  ambulo__script_json(&data, ambulo__text_data(&thin), thin.length);
  ambulo__text_append_char(&data, '}');
  ambulo__packed_text(&packed, ambulo__text_data(&data), data.length);
  *stands = (double)(s->motions + packed.length) <= 1e6 * s->megabytes;
  if (*stands) {
    s->motions += packed.length;
    ambulo__text_append(s->out, ",\"packed\":");
    ambulo__text_append(s->out, ambulo__text_data(&packed));
  }
  ambulo__text_free(&packed);
  ambulo__text_free(&data);
  status = ambulo__text_status(&thin);
  ambulo__text_free(&thin);
  ambulo__page_result_free(&result);
  return status;
}

/* where the page stands in the folder itself the way is "", and is said to be "." */
static void add_picture(study *s, const char *id) {
  size_t length = strlen(s->way);
  if (length > 1 && s->way[length - 1] == '/') s->way[length - 1] = '\0';
  char *picture = ambulo__case_path(&s->out->allocator, length ? s->way : ".", id, "/gait.svg");
  if (!picture) s->out->failed = 1;
  if (!picture) return;
  ambulo__text_append(s->out, ",\"picture\":");
  ambulo__script_text(s->out, picture);
  ambulo__free(&s->out->allocator, picture);
}

static int is_folder(const char *path) {
  struct stat entry;
  return stat(path, &entry) == 0 && S_ISDIR(entry.st_mode);
}

static ambulo_status add_case(void *user, const ambulo__gathered *one) {
  study *s = user;
  const ambulo__listing *l = s->listing;
  const char *id = ambulo__listing_cell(l, one->index, AMBULO__LISTING_ID);
  ambulo__text_append(s->out, one->index ? ",{\"id\":" : "{\"id\":");
  ambulo__script_text(s->out, id);
  ambulo__text_append(s->out, ",\"name\":");
  ambulo__script_text(s->out, ambulo__listing_cell(l, one->index, AMBULO__LISTING_NAME));
  ambulo__text_append(s->out, ",\"state\":");
  ambulo__script_text(s->out, one->state);
  ambulo__text_append(s->out, ",\"values\":[");
  for (int i = AMBULO__LISTING_AXES; i < l->columns; i++) {
    if (i > AMBULO__LISTING_AXES) ambulo__text_append_char(s->out, ',');
    cell(s->out, ambulo__listing_cell(l, one->index, i));
  }
  for (int i = 0; i < l->outputs; i++) {
    if (i || l->axes) ambulo__text_append_char(s->out, ',');
    cell(s->out, one->value[i].kind == AMBULO__OUTPUT_NONE ? "" : one->value[i].text);
  }
  ambulo__text_append_char(s->out, ']');
  char *folder = ambulo__case_path(&s->out->allocator, s->directory, id, "");
  ambulo_status status = folder ? AMBULO_OK : AMBULO_E_MEMORY;
  int known = strcmp(one->state, "missing") != 0 && strcmp(one->state, "stale") != 0 &&
              strcmp(one->state, "corrupt") != 0;
  if (!status && known && is_folder(folder)) {
    int stands = 0;
    status = add_motion(s, folder, &stands);
    if (!status && !stands && s->way) add_picture(s, id);
    s->left_out += !status && !stands;
  }
  ambulo__free(&s->out->allocator, folder);
  ambulo__text_append_char(s->out, '}');
  return status ? status : ambulo__text_status(s->out);
}

/* ---------------------------------------------------------------- the study */

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

static void columns(const study *s) {
  const ambulo__listing *l = s->listing;
  ambulo__text_append(s->out, ",\"columns\":[");
  for (int i = 0; i < l->axes + l->outputs; i++) {
    int o = i - l->axes;
    if (i) ambulo__text_append_char(s->out, ',');
    if (o < 0)
      title(s->out, ambulo__listing_title(l, AMBULO__LISTING_AXES + i), l->axis_label[i],
            l->axis_unit[i]);
    else
      title(s->out, l->output[o], l->output_label[o], l->output_unit[o]);
  }
  ambulo__text_append_char(s->out, ']');
}

static void tell_left_out(const study *s) {
  ambulo__place place = {.file = s->directory};
  if (s->left_out > 0)
    ambulo__warning(s->diagnostics, place, "--size takes more (in C: megabytes)",
                    "%d case%s in the table without motion: %g MB of motions are the most",
                    s->left_out, s->left_out == 1 ? " is" : "s are", s->megabytes);
}

ambulo_status ambulo__page_add_study(const char *directory, const char *folder, double megabytes,
                                     ambulo__text_buffer *out, ambulo_diagnostics *diagnostics) {
  const ambulo_allocator *a = &out->allocator;
  ambulo__listing listing;
  ambulo_status status = ambulo__listing_load(directory, a, diagnostics, &listing);
  if (status) return status;
  study s = {.directory = directory,
             .way = ambulo__path_between(a, folder, directory),
             .listing = &listing,
             .out = out,
             .diagnostics = diagnostics,
             .megabytes = megabytes};
  ambulo__text_append(out, "\"study\":{\"name\":");
  ambulo__script_text(out, listing.name);
  columns(&s);
  ambulo__text_append(out, ",\"cases\":[");
  status = ambulo__gather(directory, &listing, AMBULO__GATHER_OUTPUTS, add_case, &s, NULL);
  ambulo__text_append(out, "]}");
  if (!status) tell_left_out(&s);
  ambulo__free(a, s.way);
  ambulo__listing_free(&listing);
  return status ? status : ambulo__text_status(out);
}
