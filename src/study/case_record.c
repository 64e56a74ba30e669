/* study/case_record.c - the record of a finished case and the checksums of its files (batch.h). */
#include "ambulo/solve.h"
#include "base/numtext.h"
#include "formats/atomic_file.h"
#include "formats/json_text.h"
#include "formats/paths.h"
#include "formats/inputs.h"
#include "formats/read_file.h"
#include "study/batch.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

char *ambulo__case_path(const ambulo_allocator *a, const char *directory, const char *id,
                        const char *ending) {
  size_t length = strlen(id);
  char fan[3] = {'0', '0', '\0'};
  if (length >= 2) memcpy(fan, id + length - 2, 2);
  const char *part[] = {directory, "/cases/", fan, "/", id, ending};
  return ambulo__join_parts(a, part, 6);
}

/* --------------------------------------------------------------------- files */

static int by_ending(const void *left, const void *right) {
  const ambulo__case_file *a = left, *b = right;
  return strcmp(a->ending, b->ending);
}

int ambulo__case_files_have(const ambulo__case_files *files, const char *ending) {
  for (int i = 0; i < files->count; i++)
    if (strcmp(files->file[i].ending, ending) == 0) return 1;
  return 0;
}

/* ------------------------------------------------------------------- listing */

static ambulo_status add(ambulo__case_files *files, const char *lead, const char *name,
                         const char *path, ambulo_diagnostics *diagnostics) {
  ambulo__place place = {path, 0, 0, NULL};
  if (files->count == AMBULO__CASE_FILES ||
      strlen(lead) + strlen(name) >= sizeof files->file[0].ending)
    return ambulo__error(diagnostics, AMBULO_E_LIMIT, place, NULL,
                         "more or longer names than those of a result folder (got '%.80s')", name);
  ambulo__case_file *file = &files->file[files->count++];
  (void)snprintf(file->ending, sizeof file->ending, "%s%s", lead, name);
  return AMBULO_OK;
}

/* names of the files in the result folder */
static ambulo_status list_folder(const char *path, ambulo__case_files *files,
                                 ambulo_diagnostics *diagnostics, int *result) {
  DIR *stream = opendir(path);
  *result = stream != NULL;
  if (!stream)
    return errno == ENOENT ? AMBULO_OK : ambulo__io_error(diagnostics, path, "read the folder");
  ambulo_status status = AMBULO_OK;
  for (;;) {
    errno = 0;
    const struct dirent *entry = readdir(stream);
    if (!entry || status) break;
    if (entry->d_name[0] != '.') status = add(files, "/", entry->d_name, path, diagnostics);
  }
  if (!status && errno) status = ambulo__io_error(diagnostics, path, "read the folder");
  (void)closedir(stream);
  return status;
}

/* the log, where there is one */
static ambulo_status list_log(const char *path, ambulo__case_files *files,
                              ambulo_diagnostics *diagnostics) {
  struct stat entry;
  if (stat(path, &entry) == 0) return add(files, "", ".log", path, diagnostics);
  return errno == ENOENT ? AMBULO_OK : ambulo__io_error(diagnostics, path, "inspect");
}

/* checksums of what stands there now; *result = 1: there is a result folder */
static ambulo_status list_files(const char *directory, const char *id, const ambulo_allocator *a,
                                ambulo_diagnostics *diagnostics, ambulo__case_files *files,
                                int *result) {
  ambulo__case_files found = {.count = 0};
  char *folder = ambulo__case_path(a, directory, id, "");
  char *log = ambulo__case_path(a, directory, id, ".log");
  ambulo_status status = folder && log ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = list_folder(folder, &found, diagnostics, result);
  if (!status) status = list_log(log, &found, diagnostics);
  ambulo__free(a, folder);
  ambulo__free(a, log);
  for (int i = 0; i < found.count && !status; i++) {
    char *path = ambulo__case_path(a, directory, id, found.file[i].ending);
    status = path ? ambulo__digest_file(path, diagnostics, found.file[i].digest) : AMBULO_E_MEMORY;
    ambulo__free(a, path);
  }
  qsort(found.file, (size_t)found.count, sizeof found.file[0], by_ending);
  if (!status) *files = found;
  return status;
}

/* ------------------------------------------------------------------ checking */

static void set_damage(ambulo__damage *damage, const char *ending, const char *what) {
  (void)snprintf(damage->ending, sizeof damage->ending, "%s", ending);
  (void)snprintf(damage->what, sizeof damage->what, "%s", what);
}

ambulo_status ambulo__damage_of(ambulo_status status, const char *ending,
                                const ambulo_diagnostics *reasons, ambulo__damage *damage) {
  if (status == AMBULO_OK || status == AMBULO_E_MEMORY) return status;
  const ambulo_diagnostic *first = ambulo_diagnostics_get(reasons, 0);
  set_damage(damage, ending, first ? first->message : ambulo_status_text(status));
  return AMBULO_OK;
}

static ambulo_status check_one(const char *path, const ambulo__case_file *file,
                               ambulo_diagnostics *reasons, int *intact, ambulo__damage *damage) {
  char digest[AMBULO__SHA256_TEXT];
  ambulo_status status = ambulo__digest_file(path, reasons, digest);
  *intact = !status && strcmp(digest, file->digest) == 0;
  if (status) return ambulo__damage_of(status, file->ending, reasons, damage);
  if (!*intact) set_damage(damage, file->ending, "is not what was written");
  return AMBULO_OK;
}

/* *intact = 0 and *damage, when one of them is missing, cannot be read, or is another */
static ambulo_status check_files(const char *directory, const char *id,
                                 const ambulo__case_files *files, const ambulo_allocator *a,
                                 int *intact, ambulo__damage *damage) {
  ambulo_diagnostics *reasons = ambulo_diagnostics_create(a);
  ambulo_status status = reasons ? AMBULO_OK : AMBULO_E_MEMORY;
  int good = 1;
  for (int i = 0; i < files->count && good && !status; i++) {
    char *path = ambulo__case_path(a, directory, id, files->file[i].ending);
    status = path ? check_one(path, &files->file[i], reasons, &good, damage) : AMBULO_E_MEMORY;
    ambulo__free(a, path);
  }
  ambulo_diagnostics_free(reasons);
  if (!status) *intact = good;
  return status;
}

/* ------------------------------------------------------------------- records */

enum { MOST_RECORD_BYTES = 1 << 20, MOST_SUMMARY_BYTES = 16 << 20 };

static const char schema[] = "ambulo-case/3";
static const char *const earlier[] = {"ambulo-case/1", "ambulo-case/2"};
static const char summary_file[] = "/summary.json", record_file[] = ".json";

/* ------------------------------------------------------------------- reading */

static const char *text_at(const ambulo__yaml_node *root, const char *key) {
  return ambulo__yaml_text(ambulo__yaml_require(root, key));
}

static int is_valid_state(const char *state) {
  return strcmp(state, ambulo_verdict_name(AMBULO_OPTIMAL)) == 0 ||
         strcmp(state, ambulo_verdict_name(AMBULO_FEASIBLE)) == 0;
}

/* "<id>/motion.csv": checksum */
static int read_files(const ambulo__yaml_node *node, const char *id, ambulo__case_files *files) {
  size_t lead = strlen(id);
  int count = ambulo__yaml_pairs(node);
  if (count > AMBULO__CASE_FILES) return 0;
  for (int i = 0; i < count; i++) {
    const char *name = ambulo__yaml_key(node, i);
    const char *digest = ambulo__yaml_text(ambulo__yaml_get(node, name));
    ambulo__case_file *file = &files->file[files->count++];
    if (strncmp(name, id, lead) != 0 || strlen(name + lead) >= sizeof file->ending ||
        strlen(digest) >= sizeof file->digest)
      return 0;
    (void)snprintf(file->ending, sizeof file->ending, "%s", name + lead);
    (void)snprintf(file->digest, sizeof file->digest, "%s", digest);
  }
  return 1;
}

static int copy_text(char *to, size_t size, const char *text) {
  if (strlen(text) >= size) return 0;
  (void)snprintf(to, size, "%s", text);
  return 1;
}

/* 0: not what a record of this case says */
static int read_fields(const ambulo__yaml_node *root, const char *id, ambulo__record *r) {
  if (strcmp(text_at(root, "id"), id) != 0) return 0;
  if (!copy_text(r->state, sizeof r->state, text_at(root, "state"))) return 0;
  if (!copy_text(r->start, sizeof r->start, text_at(root, "start"))) return 0;
  if (!ambulo__read_key(text_at(root, "key"), &r->key)) return 0;
  if (!ambulo__read_key(text_at(root, "origin"), &r->origin)) return 0;
  r->valid = ambulo__yaml_boolean(ambulo__yaml_require(root, "valid"), 0);
  r->exit_code = ambulo__yaml_integer(ambulo__yaml_require(root, "exit_code"), -1, 255, -1);
  r->signal = ambulo__yaml_integer(ambulo__yaml_require(root, "signal"), 0, 255, 0);
  r->seconds = ambulo__yaml_number(ambulo__yaml_require(root, "seconds"), 0.0);
  r->limit_seconds = ambulo__yaml_number(ambulo__yaml_require(root, "limit_seconds"), 0.0);
  r->limit_megabytes =
      ambulo__yaml_integer(ambulo__yaml_require(root, "limit_megabytes"), 0, 2000000000, 0);
  r->violation = ambulo__yaml_number(ambulo__yaml_require(root, "violation"), -1.0);
  ambulo__yaml_expect(root, "inputs"); /* for people: the key stands for them */
  if (!read_files(ambulo__yaml_require(root, "files"), id, &r->files)) return 0;
  return r->valid == is_valid_state(r->state) && (ambulo__record_has_result(r) || !r->valid);
}

/* the text of a record, judged; *what: where it is damaged */
static ambulo_status judge_text(const char *text, size_t length, const char *id,
                                const ambulo_allocator *a, ambulo__finding *finding,
                                ambulo__record *record, const char **what) {
  ambulo__yaml *document = NULL;
  ambulo_status status = ambulo__yaml_load_text(text, length, "record", a, NULL, &document);
  if (status == AMBULO_E_MEMORY) return status;
  const ambulo__yaml_node *root = status ? NULL : ambulo__yaml_root(document);
  const char *own = status ? "" : text_at(root, "schema");
  int ours = strcmp(own, schema) == 0;
  *what = "is not what was written";
  *finding = AMBULO__FOUND_DAMAGED;
  memset(record, 0, sizeof *record);
  if (strcmp(own, earlier[0]) == 0 || strcmp(own, earlier[1]) == 0) {
    *finding = AMBULO__FOUND_STALE;
  } else if (ours && ambulo__seal_holds(text, length)) {
    *what = "contradicts itself, or is the record of another case";
    if (read_fields(root, id, record) && !ambulo__yaml_finish(document))
      *finding = AMBULO__FOUND_INTACT;
  }
  ambulo__yaml_free(document);
  return AMBULO_OK;
}

static ambulo_status read_record(const char *path, const char *id, const ambulo_allocator *a,
                                 ambulo__finding *finding, ambulo__record *record,
                                 ambulo__damage *damage) {
  struct stat entry;
  char *text = NULL;
  const char *what = "";
  size_t length = 0;
  *finding = AMBULO__FOUND_NOTHING;
  if (stat(path, &entry) != 0 && (errno == ENOENT || errno == ENOTDIR)) return AMBULO_OK;
  ambulo_diagnostics *reasons = ambulo_diagnostics_create(a);
  ambulo_status status = reasons ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__read_file(path, MOST_RECORD_BYTES, a, reasons, &text, &length);
  if (status) {
    *finding = AMBULO__FOUND_DAMAGED;
    status = ambulo__damage_of(status, record_file, reasons, damage);
  } else {
    status = judge_text(text, length, id, a, finding, record, &what);
    if (*finding == AMBULO__FOUND_DAMAGED) set_damage(damage, record_file, what);
  }
  ambulo__free(a, text);
  ambulo_diagnostics_free(reasons);
  return status;
}

ambulo_status ambulo__record_find(const char *directory, const char *id, unsigned long long key,
                                  int files, const ambulo_allocator *a, ambulo__finding *finding,
                                  ambulo__record *record, ambulo__damage *damage) {
  ambulo__finding found = AMBULO__FOUND_NOTHING;
  ambulo__record read;
  int intact = 1;
  char *path = ambulo__case_path(a, directory, id, record_file);
  ambulo_status status = path ? read_record(path, id, a, &found, &read, damage) : AMBULO_E_MEMORY;
  ambulo__free(a, path);
  if (!status && found == AMBULO__FOUND_INTACT && read.key != key) found = AMBULO__FOUND_STALE;
  if (!status && found == AMBULO__FOUND_INTACT && files)
    status = check_files(directory, id, &read.files, a, &intact, damage);
  if (status) return status;
  *finding = intact ? found : AMBULO__FOUND_DAMAGED;
  if (*finding == AMBULO__FOUND_INTACT) *record = read;
  return AMBULO_OK;
}

/* ------------------------------------------------------------------- writing */

static void write_files(ambulo__json *json, const char *id, const ambulo__case_files *files) {
  char name[2 * AMBULO__CASE_FILE_NAME];
  ambulo__json_open(json, "files", '{');
  for (int i = 0; i < files->count; i++) {
    (void)snprintf(name, sizeof name, "%s%s", id, files->file[i].ending);
    ambulo__json_text(json, name, files->file[i].digest);
  }
  ambulo__json_close(json, '}');
}

ambulo_status ambulo__record_write(const char *directory, const char *id, const ambulo__record *r,
                                   const char *inputs, const ambulo_allocator *a,
                                   ambulo_diagnostics *diagnostics) {
  ambulo__text_buffer text;
  ambulo__text_init(&text, a);
  ambulo__json json = {&text, 0, 1};
  ambulo__json_open(&json, NULL, '{');
  ambulo__json_text(&json, "schema", schema);
  ambulo__json_text(&json, "id", id);
  ambulo__json_hash(&json, "key", r->key);
  ambulo__json_text(&json, "state", r->state);
  ambulo__json_text(&json, "start", r->start);
  ambulo__json_hash(&json, "origin", r->origin);
  ambulo__text_append_format(&text, ",\n  \"valid\": %s", r->valid ? "true" : "false");
  ambulo__json_integer(&json, "exit_code", r->exit_code);
  ambulo__json_integer(&json, "signal", r->signal);
  ambulo__json_number(&json, "seconds", r->seconds);
  ambulo__json_number(&json, "limit_seconds", r->limit_seconds);
  ambulo__json_integer(&json, "limit_megabytes", r->limit_megabytes);
  ambulo__json_number(&json, "violation", r->violation);
  ambulo__inputs_json(inputs, &json);
  write_files(&json, id, &r->files);
  ambulo__seal(&text);
  char *path = ambulo__case_path(a, directory, id, record_file);
  ambulo_status status = path ? ambulo__text_status(&text) : AMBULO_E_MEMORY;
  if (!status)
    status = ambulo__write_file(path, ambulo__text_data(&text), text.length, 1, a, diagnostics);
  ambulo__free(a, path);
  ambulo__text_free(&text);
  return status;
}

/* ------------------------------------------------------------ of a fresh result */

static int take_fields(const ambulo__yaml_node *root, ambulo__record *r) {
  const char *verdict = text_at(root, "verdict");
  if (!verdict[0] || strlen(verdict) >= sizeof r->state) return 0;
  const ambulo__yaml_node *worst =
      ambulo__yaml_get(ambulo__yaml_get(ambulo__yaml_get(root, "audit"), "violation"), "worst");
  const char *number = ambulo__yaml_text(worst); /* null: not finite */
  r->violation = -1.0;
  (void)ambulo__parse_double(number, strlen(number), &r->violation);
  (void)snprintf(r->state, sizeof r->state, "%s", verdict);
  r->valid = is_valid_state(verdict);
  return 1;
}

static ambulo_status take_summary(const char *path, const ambulo_allocator *a,
                                  ambulo_diagnostics *diagnostics, ambulo__record *record,
                                  int *taken) {
  char *text = NULL;
  size_t length = 0;
  ambulo__yaml *document = NULL;
  ambulo_status status =
      ambulo__read_file(path, MOST_SUMMARY_BYTES, a, diagnostics, &text, &length);
  if (status) return status;
  status = ambulo__yaml_load_text(text, length, path, a, NULL, &document);
  if (!status) *taken = take_fields(ambulo__yaml_root(document), record);
  ambulo__yaml_free(document);
  ambulo__free(a, text);
  return status == AMBULO_E_MEMORY ? status : AMBULO_OK;
}

ambulo_status ambulo__record_take_result(const char *directory, const char *id,
                                         const ambulo_allocator *a, ambulo_diagnostics *diagnostics,
                                         ambulo__record *record, int *taken) {
  int result = 0;
  *taken = 0;
  ambulo_status status = list_files(directory, id, a, diagnostics, &record->files, &result);
  if (status || !ambulo__case_files_have(&record->files, summary_file)) return status;
  char *path = ambulo__case_path(a, directory, id, summary_file);
  status = path ? take_summary(path, a, diagnostics, record, taken) : AMBULO_E_MEMORY;
  ambulo__free(a, path);
  return status;
}

int ambulo__record_has_result(const ambulo__record *r) {
  return ambulo__case_files_have(&r->files, summary_file);
}

int ambulo__record_was_cut(const ambulo__record *r, double seconds, int megabytes) {
  if (strcmp(r->state, "timeout") == 0) return seconds == 0.0 || seconds > r->limit_seconds;
  /* without a limit of its own it was the machine that had none left */
  if (strcmp(r->state, "memory") == 0)
    return r->limit_megabytes == 0 || megabytes == 0 || megabytes > r->limit_megabytes;
  return 0;
}
