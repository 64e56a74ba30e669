/* show/page_data.c - a result folder as data of a page (page.h). */
#include "ambulo/tools/inverse.h"
#include "ambulo/tools/load.h"
#include "ambulo/tools/report.h"
#include "formats/atomic_file.h"
#include "formats/motion_file.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "model/model.h"
#include "show/page.h"
#include "show/scene.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static const char folder_hint[] = "'ambulo solve PROBLEM.yaml -o DIR' fills one";
static const char newer_hint[] = "'ambulo solve' of this version writes one; solve it again";

ambulo_status ambulo__page_file_read(const char *directory, const char *name, const char *schema,
                                     const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics, ambulo__page_file *file) {
  ambulo__page_file f = {.allocator = ambulo__allocator_or_default(allocator)};
  f.path = ambulo__join_paths(&f.allocator, directory, name, NULL);
  ambulo_status status = f.path ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status)
    status = ambulo__read_file(f.path, AMBULO__YAML_MAX_BYTES, &f.allocator, diagnostics, &f.text,
                               &f.length);
  if (!status)
    status =
        ambulo__yaml_load_text(f.text, f.length, f.path, &f.allocator, diagnostics, &f.document);
  if (!status) {
    const ambulo__yaml_node *root = ambulo__yaml_root(f.document);
    const ambulo__yaml_node *given = ambulo__yaml_require(root, "schema");
    if (given && strncmp(ambulo__yaml_text(given), schema, strlen(schema)) != 0)
      (void)ambulo__yaml_error(given, AMBULO_E_SCHEMA, NULL, "schema is '%.60s'; expected %s",
                               ambulo__yaml_text(given), schema);
    status = ambulo__yaml_finish(f.document);
  }
  *file = f;
  if (status) ambulo__page_file_free(file);
  return status;
}

void ambulo__page_file_free(ambulo__page_file *file) {
  ambulo__yaml_free(file->document);
  ambulo__free(&file->allocator, file->text);
  ambulo__free(&file->allocator, file->path);
  memset(file, 0, sizeof *file);
}

/* files of two solves do not belong together */
static ambulo_status check_same(const ambulo__page_result *r) {
  const ambulo__yaml_node *hash[2] = {
      ambulo__yaml_require(ambulo__yaml_root(r->summary.document), "input_hash"),
      ambulo__yaml_require(ambulo__yaml_root(r->scene.document), "input_hash")};
  if (hash[0] && hash[1] && strcmp(ambulo__yaml_text(hash[0]), ambulo__yaml_text(hash[1])) != 0)
    (void)ambulo__yaml_error(hash[1], AMBULO_E_SCHEMA, "the files of a folder are of one solve",
                             "input_hash is '%.20s', in summary.json '%.20s'",
                             ambulo__yaml_text(hash[1]), ambulo__yaml_text(hash[0]));
  ambulo_status status = ambulo__yaml_finish(r->summary.document);
  return status ? status : ambulo__yaml_finish(r->scene.document);
}

/* a message that says more than that a file is not there */
static ambulo_status check_there(const char *directory, const char *name, const char *hint,
                                 const ambulo_allocator *a, ambulo_diagnostics *diagnostics) {
  struct stat entry;
  ambulo__place place = {.file = directory};
  if (stat(directory, &entry) != 0) return ambulo__io_error(diagnostics, directory, "open");
  if (!S_ISDIR(entry.st_mode))
    return ambulo__error(diagnostics, AMBULO_E_IO, place, NULL,
                         "a file; expected a result folder, or a batch folder");
  char *path = ambulo__join_paths(a, directory, name, NULL);
  if (!path) return AMBULO_E_MEMORY;
  int missing = stat(path, &entry) != 0 && errno == ENOENT;
  ambulo__free(a, path);
  if (!missing) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_IO, place, hint,
                       "the folder has no %s; expected a result folder, or a batch folder", name);
}

ambulo_status ambulo__page_result_read(const char *directory, const ambulo_allocator *allocator,
                                       ambulo_diagnostics *diagnostics,
                                       ambulo__page_result *result) {
  ambulo__page_result r = {.summary = {.text = NULL}};
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo_status status = check_there(directory, "summary.json", folder_hint, &a, diagnostics);
  if (!status) status = check_there(directory, "scene.json", newer_hint, &a, diagnostics);
  if (!status)
    status = ambulo__page_file_read(directory, "summary.json", "ambulo-summary/", &a, diagnostics,
                                    &r.summary);
  if (!status)
    status = ambulo__page_file_read(directory, "scene.json", "ambulo-scene/1", &a, diagnostics,
                                    &r.scene);
  if (!status) status = check_same(&r);
  *result = r;
  if (status) ambulo__page_result_free(result);
  return status;
}

void ambulo__page_result_free(ambulo__page_result *result) {
  ambulo__page_file_free(&result->summary);
  ambulo__page_file_free(&result->scene);
}

/* the picture, which is left out where it cannot be read */
static ambulo_status strip(const char *directory, ambulo__text_buffer *out) {
  const ambulo_allocator *a = &out->allocator;
  char *path = ambulo__join_paths(a, directory, "gait.svg", NULL), *text = NULL;
  size_t length;
  ambulo_status status = path ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__read_file(path, AMBULO__YAML_MAX_BYTES, a, NULL, &text, &length);
  if (!status) {
    ambulo__text_append(out, ",\"strip\":");
    ambulo__script_text(out, text);
  }
  ambulo__free(a, text);
  ambulo__free(a, path);
  return status == AMBULO_E_MEMORY ? status : AMBULO_OK;
}

/* the last part of a path; "." and ".." say nothing: the whole of it */
static void folder_name(const char *directory, ambulo__text_buffer *out) {
  ambulo__text_buffer name;
  ambulo__text_init_part(&name, out);
  size_t length = strlen(directory);
  while (length > 1 && directory[length - 1] == '/') length--;
  size_t from = length;
  while (from > 0 && directory[from - 1] != '/') from--;
  if (from == length || directory[from] == '.') from = 0;
  ambulo__text_append_bytes(&name, directory + from, length - from);
  ambulo__script_text(out, ambulo__text_data(&name));
  ambulo__text_free(&name);
}

ambulo_status ambulo__page_add_result(const char *directory, int with_strip,
                                      ambulo__text_buffer *out, ambulo_diagnostics *diagnostics) {
  ambulo__page_result r;
  ambulo_status status = ambulo__page_result_read(directory, &out->allocator, diagnostics, &r);
  if (status) return status;
  ambulo__text_buffer data;
  ambulo__text_init_part(&data, out);
  ambulo__text_append(&data, "{\"summary\":");
  ambulo__script_json(&data, r.summary.text, r.summary.length);
  ambulo__text_append(&data, ",\"scene\":");
  ambulo__script_json(&data, r.scene.text, r.scene.length);
  if (with_strip) status = strip(directory, &data);
  ambulo__text_append_char(&data, '}');
  ambulo__text_append(out, "{\"name\":");
  folder_name(directory, out);
  ambulo__text_append(out, ",\"packed\":");
  ambulo__packed_text(out, ambulo__text_data(&data), data.length);
  ambulo__text_append_char(out, '}');
  ambulo__text_free(&data);
  ambulo__page_result_free(&r);
  return status ? status : ambulo__text_status(out);
}

/* a person's own motion as data of a page (page.h).
 *
 * Columns, units and doubts are those of inverse dynamics of a file (ambulo/tools/inverse.h), whose
 * table is read; between its rows values go linearly.
 */

/* q [AMBULO__SCENE_SAMPLES][coordinates] evenly spaced from..to */
static void sample(const ambulo_model *model, const ambulo__motion *table, double from, double to,
                   double *q) {
  int count = model->coordinate_count, row = 0, last = table->rows - 1;
  for (int k = 0; k < AMBULO__SCENE_SAMPLES; k++) {
    double t = from + (to - from) * k / (AMBULO__SCENE_SAMPLES - 1);
    while (row < last - 1 && table->time[row + 1] < t) row++;
    double share = (t - table->time[row]) / (table->time[row + 1] - table->time[row]);
    for (int i = 0; i < count; i++) {
      char name[AMBULO__MOTION_MAX_NAME + 3];
      (void)snprintf(name, sizeof name, "q.%s", model->coordinates[i].name);
      int column = ambulo__motion_column(table, name);
      const double *at = table->values + (size_t)row * (size_t)table->columns + column;
      q[k * count + i] = column < 0 ? 0.0 : at[0] + share * (at[table->columns] - at[0]);
    }
  }
}

static ambulo_status check_span(const ambulo_page_options *o, const ambulo__motion *table,
                                double span[2], ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = o->motion};
  double first = table->time[0], last = table->time[table->rows - 1];
  span[0] = fmax(o->from, first);
  span[1] = fmin(o->to, last);
  if (table->rows >= 2 && span[1] - span[0] > 1e-6) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, NULL,
                       "no motion from %g to %g s; the file has %g to %g s", o->from, o->to, first,
                       last);
}

static ambulo_status append(const ambulo_page_options *o, const ambulo__motion *table,
                            const double span[2], ambulo__text_buffer *out) {
  const ambulo_model *model = o->body;
  size_t count = (size_t)model->coordinate_count * AMBULO__SCENE_SAMPLES;
  double *q = ambulo__alloc(&out->allocator, count, sizeof *q);
  if (!q) return AMBULO_E_MEMORY;
  const char *slash = strrchr(o->motion, '/');
  const char *name = slash ? slash + 1 : o->motion;
  ambulo__text_buffer scene, data;
  ambulo__text_init(&scene, &out->allocator);
  sample(model, table, span[0], span[1], q);
  ambulo_status status = ambulo__scene_of_motion(model, "measured", q, AMBULO__SCENE_SAMPLES,
                                                 span[1] - span[0], o->ground_height, &scene);
  ambulo__text_init_part(&data, out);
  ambulo__text_append(&data, "{\"summary\":{},\"scene\":");
  ambulo__script_json(&data, ambulo__text_data(&scene), scene.length);
  ambulo__text_append_char(&data, '}');
  ambulo__text_append(out, "{\"name\":");
  ambulo__script_text(out, name);
  ambulo__text_append(out, ",\"packed\":");
  ambulo__packed_text(out, ambulo__text_data(&data), data.length);
  ambulo__text_append_char(out, '}');
  ambulo__text_free(&data);
  ambulo__text_free(&scene);
  ambulo__free(&out->allocator, q);
  return status ? status : ambulo__text_status(out);
}

ambulo_status ambulo__page_add_motion(const ambulo_page_options *o, ambulo__text_buffer *out,
                                      ambulo_diagnostics *diagnostics) {
  ambulo_inverse_options options = ambulo_inverse_options_default();
  options.without_forces = 1;
  options.ground_height = o->ground_height;
  char *text = NULL;
  double span[2];
  ambulo__motion *table = NULL;
  const ambulo_allocator *a = &out->allocator;
  ambulo_status status = ambulo_inverse_dynamics_motion(
      o->body, o->motion, NULL, &options, a, diagnostics,
      &(ambulo_inverse_outputs){.size = sizeof(ambulo_inverse_outputs), .text = &text});
  if (!status)
    status = ambulo__table_read(text, strlen(text), o->motion, AMBULO__MOTION_CSV, 1, a,
                                diagnostics, &table);
  if (!status) status = check_span(o, table, span, diagnostics);
  if (!status) status = append(o, table, span, out);
  ambulo__motion_free(table);
  ambulo_text_free(text, a);
  return status;
}
