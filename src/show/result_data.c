/* show/result_data.c - a result folder as data of a page (page.h). */
#include "show/page.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "formats/file_steps.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "show/packed_text.h"
#include "show/script_text.h"

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
