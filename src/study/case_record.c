/* study/case_record.c - see record.h. */
#include "study/case_record.h"
#include "ambulo/solve.h"
#include "formats/atomic_file.h"
#include "base/numtext.h"
#include "formats/read_file.h"
#include "formats/seal.h"
#include "study/case_path.h"
#include "formats/json_text.h"
#include "formats/yaml_node.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { MOST_RECORD_BYTES = 1 << 20, MOST_SUMMARY_BYTES = 16 << 20, HEX_TEXT = 20 };

static const char schema[] = "ambulo-case/2", schema_without_checksums[] = "ambulo-case/1";
static const char summary_file[] = "/summary.json", record_file[] = ".json";

/* ------------------------------------------------------------------- reading */

static int parse_hex(const char *text, unsigned long long *value) {
  unsigned long long word = 0;
  if (strlen(text) != 16) return 0;
  for (; *text; text++) {
    const char *digits = "0123456789abcdef", *at = strchr(digits, *text);
    if (!at) return 0;
    word = word << 4 | (unsigned long long)(at - digits);
  }
  *value = word;
  return 1;
}

static const char *text_at(const ambulo__yaml_node *root, const char *key) {
  return ambulo__yaml_text(ambulo__yaml_require(root, key));
}

static int is_valid_state(const char *state) {
  return strcmp(state, ambulo_verdict_name(AMBULO_OPTIMAL)) == 0 ||
         strcmp(state, ambulo_verdict_name(AMBULO_FEASIBLE)) == 0;
}

static int is_verdict(const char *name) {
  static const char *const names[] = {
#define VERDICT_NAME(id, name, text) name,
      AMBULO_VERDICT_LIST(VERDICT_NAME)
#undef VERDICT_NAME
  };
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (strcmp(names[i], name) == 0) return 1;
  return 0;
}

static int is_state(const char *name) {
  static const char *const others[] = {"timeout", "memory", "crashed", "invalid", "error"};
  for (size_t i = 0; i < sizeof others / sizeof *others; i++)
    if (strcmp(others[i], name) == 0) return 1;
  return is_verdict(name);
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
  if (!parse_hex(text_at(root, "key"), &r->key)) return 0;
  if (!parse_hex(text_at(root, "origin"), &r->origin)) return 0;
  r->valid = ambulo__yaml_boolean(ambulo__yaml_require(root, "valid"), 0);
  r->exit_code = ambulo__yaml_integer(ambulo__yaml_require(root, "exit_code"), -1, 255, -1);
  r->signal = ambulo__yaml_integer(ambulo__yaml_require(root, "signal"), 0, 255, 0);
  r->seconds = ambulo__yaml_number(ambulo__yaml_require(root, "seconds"), 0.0);
  r->limit_seconds = ambulo__yaml_number(ambulo__yaml_require(root, "limit_seconds"), 0.0);
  r->limit_megabytes =
      ambulo__yaml_integer(ambulo__yaml_require(root, "limit_megabytes"), 0, 2000000000, 0);
  r->violation = ambulo__yaml_number(ambulo__yaml_require(root, "violation"), -1.0);
  if (!read_files(ambulo__yaml_require(root, "files"), id, &r->files)) return 0;
  int result = ambulo__case_files_have(&r->files, summary_file);
  return is_state(r->state) && r->valid == is_valid_state(r->state) && (result || !r->valid);
}

static ambulo_status damaged(ambulo__damage *damage, const char *what, ambulo__finding *finding) {
  (void)snprintf(damage->ending, sizeof damage->ending, "%s", record_file);
  (void)snprintf(damage->what, sizeof damage->what, "%s", what);
  *finding = AMBULO__FOUND_DAMAGED;
  return AMBULO_OK;
}

/* the text of a record, judged; *finding is what it is by itself */
static ambulo_status judge_text(const char *text, size_t length, const char *id,
                                const ambulo_allocator *a, ambulo__finding *finding,
                                ambulo__record *record, ambulo__damage *damage) {
  ambulo__yaml *document = NULL;
  ambulo_status status = ambulo__yaml_load_text(text, length, "record", a, NULL, &document);
  if (status == AMBULO_E_MEMORY) return status;
  if (status) return damaged(damage, "is not what was written", finding);
  const ambulo__yaml_node *root = ambulo__yaml_root(document);
  const char *own = text_at(root, "schema");
  ambulo__record read;
  memset(&read, 0, sizeof read);
  *finding = AMBULO__FOUND_STALE;
  if (strcmp(own, schema_without_checksums) == 0) {
    status = AMBULO_OK;
  } else if (strcmp(own, schema) != 0 || !ambulo__seal_holds(text, length)) {
    status = damaged(damage, "is not what was written", finding);
  } else if (!read_fields(root, id, &read) || ambulo__yaml_finish(document)) {
    status = damaged(damage, "contradicts itself, or is the record of another case", finding);
  } else {
    *finding = AMBULO__FOUND_INTACT;
    *record = read;
  }
  ambulo__yaml_free(document);
  return status;
}

static ambulo_status read_record(const char *path, const char *id, const ambulo_allocator *a,
                                 ambulo__finding *finding, ambulo__record *record,
                                 ambulo__damage *damage) {
  struct stat entry;
  char *text = NULL;
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
    status = judge_text(text, length, id, a, finding, record, damage);
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
    status = ambulo__case_files_check(directory, id, &read.files, a, &intact, damage);
  if (status) return status;
  *finding = intact ? found : AMBULO__FOUND_DAMAGED;
  if (*finding == AMBULO__FOUND_INTACT) *record = read;
  return AMBULO_OK;
}

/* ------------------------------------------------------------------- writing */

static void json_hex(ambulo__json *json, const char *key, unsigned long long word) {
  char hex[HEX_TEXT];
  (void)snprintf(hex, sizeof hex, "%016llx", word);
  ambulo__json_text(json, key, hex);
}

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
                                   const ambulo_allocator *a, ambulo_diagnostics *diagnostics) {
  ambulo__text_buffer text;
  ambulo__text_init(&text, a);
  ambulo__json json = {&text, 0, 1};
  ambulo__json_open(&json, NULL, '{');
  ambulo__json_text(&json, "schema", schema);
  ambulo__json_text(&json, "id", id);
  json_hex(&json, "key", r->key);
  ambulo__json_text(&json, "state", r->state);
  ambulo__json_text(&json, "start", r->start);
  json_hex(&json, "origin", r->origin);
  ambulo__text_append_format(&text, ",\n  \"valid\": %s", r->valid ? "true" : "false");
  ambulo__json_integer(&json, "exit_code", r->exit_code);
  ambulo__json_integer(&json, "signal", r->signal);
  ambulo__json_number(&json, "seconds", r->seconds);
  ambulo__json_number(&json, "limit_seconds", r->limit_seconds);
  ambulo__json_integer(&json, "limit_megabytes", r->limit_megabytes);
  ambulo__json_number(&json, "violation", r->violation);
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
  if (!is_verdict(verdict) || strlen(verdict) >= sizeof r->state) return 0;
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
  ambulo_status status =
      ambulo__case_files_list(directory, id, a, diagnostics, &record->files, &result);
  if (status || !ambulo__case_files_have(&record->files, summary_file)) return status;
  char *path = ambulo__case_path(a, directory, id, summary_file);
  status = path ? take_summary(path, a, diagnostics, record, taken) : AMBULO_E_MEMORY;
  ambulo__free(a, path);
  return status;
}

int ambulo__record_was_cut(const ambulo__record *r, double seconds, int megabytes) {
  if (strcmp(r->state, "timeout") == 0) return seconds == 0.0 || seconds > r->limit_seconds;
  if (strcmp(r->state, "memory") == 0 && r->limit_megabytes > 0)
    return megabytes == 0 || megabytes > r->limit_megabytes;
  return 0;
}
