/* study/fit_folder.c - see folder.h. */
#include "study/fit_folder.h"

#include "formats/atomic_file.h"
#include "formats/file_steps.h"
#include "formats/output_check.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "base/text_buffer.h"
#include "formats/json_text.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { MOST_BYTES = 1 << 16, HEX = 20 };

static const char inputs_name[] = "fit_inputs.json", schema[] = "ambulo-fit-inputs/1";

/* ------------------------------------------------------------------- contents */

static int is_known(const char *name) {
  static const char *const names[] = {".", "..", "lock"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (strcmp(name, names[i]) == 0) return 1;
  return strncmp(name, "fit_inputs.json.tmp-", 20) == 0;
}

/* nothing but what a fit leaves that was stopped before it had written its inputs */
static ambulo_status look_into(const ambulo__fit_runner *r, const char *directory) {
  DIR *stream = opendir(directory);
  if (!stream) return ambulo__io_error(r->diagnostics, directory, "read the folder");
  ambulo_status status = AMBULO_OK;
  const struct dirent *entry;
  while (!status && (errno = 0, entry = readdir(stream))) {
    ambulo__place place = {directory, 0, 0, NULL};
    if (!is_known(entry->d_name))
      status = ambulo__error(r->diagnostics, AMBULO_E_IO, place, NULL,
                             "the folder holds other files ('%.80s'); expected a new, an empty or "
                             "a fit's folder",
                             entry->d_name);
  }
  if (!status && errno) status = ambulo__io_error(r->diagnostics, directory, "read the folder");
  (void)closedir(stream);
  return status;
}

static ambulo_status make_folder(const ambulo__fit_runner *r, const char *path) {
  struct stat entry;
  if (mkdir(path, 0777) == 0) return AMBULO_OK;
  if (errno == EEXIST && stat(path, &entry) == 0 && !S_ISDIR(entry.st_mode)) errno = ENOTDIR;
  return errno == EEXIST ? AMBULO_OK : ambulo__io_error(r->diagnostics, path, "create the folder");
}

/* --------------------------------------------------------------------- inputs */

static void hex_text(unsigned long long word, char text[HEX]) {
  (void)snprintf(text, HEX, "%016llx", word);
}

static ambulo_status write_inputs(const ambulo__fit_runner *r, const char *path) {
  ambulo__text_buffer text;
  char hex[HEX];
  ambulo__text_init(&text, r->allocator);
  ambulo__json json = {&text, 0, 1};
  ambulo__json_open(&json, NULL, '{');
  ambulo__json_text(&json, "schema", schema);
  ambulo__json_text(&json, "name", r->fit->name);
  ambulo__json_text(&json, "fit", r->fit->path);
  hex_text(r->fit->hash, hex);
  ambulo__json_text(&json, "texts_hash", hex);
  hex_text(r->sweep->base_hash, hex);
  ambulo__json_text(&json, "problem_hash", hex);
  ambulo__json_close(&json, '}');
  ambulo__text_append_char(&text, '\n');
  ambulo_status status = ambulo__text_status(&text);
  if (!status)
    status = ambulo__write_file(path, ambulo__text_data(&text), text.length, 1, r->allocator,
                                r->diagnostics);
  ambulo__text_free(&text);
  return status;
}

/* E_PROBLEM, saying what changed, where the folder is of other inputs */
static ambulo_status compare_inputs(const ambulo__fit_runner *r, const char *path) {
  ambulo__yaml *document = NULL;
  char texts[HEX], problem[HEX];
  hex_text(r->fit->hash, texts);
  hex_text(r->sweep->base_hash, problem);
  ambulo_status status = ambulo__yaml_load(path, r->allocator, NULL, &document);
  if (status == AMBULO_E_MEMORY) return status;
  const ambulo__yaml_node *root = status ? NULL : ambulo__yaml_root(document);
  int same_texts = strcmp(ambulo__yaml_text(ambulo__yaml_get(root, "texts_hash")), texts) == 0;
  int same_problem =
      strcmp(ambulo__yaml_text(ambulo__yaml_get(root, "problem_hash")), problem) == 0;
  ambulo__yaml_free(document);
  if (same_texts && same_problem) return AMBULO_OK;
  ambulo__place place = {path, 0, 0, NULL};
  return ambulo__error(r->diagnostics, AMBULO_E_PROBLEM, place,
                       "--force goes on in it and keeps the solves whose inputs are the same; or "
                       "give another folder",
                       "the folder was filled from other inputs: %s changed",
                       same_texts ? "the model, other data of the problem, or the version of ambulo"
                                  : "the fit file, its problem or a reference");
}

ambulo_status ambulo__fit_folder_prepare(const ambulo__fit_runner *r, const char *directory,
                                         ambulo__lock *lock) {
  ambulo_status status = ambulo__expect_path(directory, "folder", r->diagnostics);
  if (!status) status = make_folder(r, directory);
  if (status) return status;
  char *path = ambulo__join_paths(r->allocator, directory, inputs_name, NULL);
  if (!path) return AMBULO_E_MEMORY;
  int is_ours = ambulo__file_says(path, "\"ambulo-fit-inputs/", 64);
  if (!is_ours) status = look_into(r, directory);
  if (!status) status = ambulo__lock_take(directory, 1, 1, r->allocator, r->diagnostics, lock);
  if (!status && is_ours && !r->options->force) status = compare_inputs(r, path);
  if (!status) status = write_inputs(r, path);
  ambulo__free(r->allocator, path);
  return status;
}
