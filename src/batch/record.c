/* batch/record.c - see record.h. */
#include "batch/record.h"
#include "ambulo/solve.h"
#include "base/atomic_file.h"
#include "base/numtext.h"
#include "base/read_file.h"
#include "base/yaml_node.h"
#include "batch/paths.h"
#include "report/json_text.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { MOST_SUMMARY_BYTES = 16 << 20, HEX_TEXT = 20 };

static int parse_hex(const char *text, unsigned long long *value) {
  unsigned long long word = 0;
  if (!text || strlen(text) != 16) return 0;
  for (; *text; text++) {
    const char *digits = "0123456789abcdef", *at = strchr(digits, *text);
    if (!at) return 0;
    word = word << 4 | (unsigned long long)(at - digits);
  }
  *value = word;
  return 1;
}

static const char *text_at(const ambulo__yaml_node *root, const char *key) {
  const ambulo__yaml_node *node = ambulo__yaml_get(root, key);
  return node ? ambulo__yaml_text(node) : NULL;
}

static int read_fields(const ambulo__yaml_node *root, const char *id, ambulo__record *r) {
  const char *state = text_at(root, "state"), *own = text_at(root, "id");
  if (!own || strcmp(own, id) != 0 || !state || strlen(state) >= sizeof r->state) return 0;
  if (!parse_hex(text_at(root, "key"), &r->key)) return 0;
  if (!parse_hex(text_at(root, "summary"), &r->summary)) return 0;
  (void)snprintf(r->state, sizeof r->state, "%s", state);
  const char *start = text_at(root, "start");
  if (!start || strlen(start) >= sizeof r->start) return 0;
  (void)snprintf(r->start, sizeof r->start, "%s", start);
  if (!parse_hex(text_at(root, "origin"), &r->origin)) return 0;
  r->valid = ambulo__yaml_boolean(ambulo__yaml_require(root, "valid"), 0);
  r->exit_code = ambulo__yaml_integer(ambulo__yaml_require(root, "exit_code"), -1, 255, -1);
  r->signal = ambulo__yaml_integer(ambulo__yaml_require(root, "signal"), 0, 255, 0);
  r->seconds = ambulo__yaml_number(ambulo__yaml_require(root, "seconds"), 0.0);
  r->limit_seconds = ambulo__yaml_number(ambulo__yaml_require(root, "limit_seconds"), 0.0);
  r->limit_megabytes =
      ambulo__yaml_integer(ambulo__yaml_require(root, "limit_megabytes"), 0, 2000000000, 0);
  r->violation = ambulo__yaml_number(ambulo__yaml_require(root, "violation"), -1.0);
  return 1;
}

ambulo__record_found ambulo__record_read(const char *directory, const char *id,
                                         const ambulo_allocator *a, ambulo__record *record) {
  char *path = ambulo__case_path(a, directory, id, ".json");
  struct stat entry;
  ambulo__record_found found = AMBULO__RECORD_CORRUPT;
  if (path && stat(path, &entry) != 0 && errno == ENOENT) found = AMBULO__RECORD_ABSENT;
  ambulo__yaml *document = NULL;
  ambulo__record read;
  memset(&read, 0, sizeof read);
  if (path && found == AMBULO__RECORD_CORRUPT && !ambulo__yaml_load(path, a, NULL, &document) &&
      read_fields(ambulo__yaml_root(document), id, &read) && !ambulo__yaml_finish(document)) {
    found = AMBULO__RECORD_READ;
    *record = read;
  }
  ambulo__yaml_free(document);
  ambulo__free(a, path);
  return found;
}

ambulo_status ambulo__record_write(const char *directory, const char *id, const ambulo__record *r,
                                   const ambulo_allocator *a, ambulo_diagnostics *diagnostics) {
  ambulo__text_buffer text;
  ambulo__text_init(&text, a);
  ambulo__json json = {&text, 0, 1};
  char hex[HEX_TEXT];
  ambulo__json_open(&json, NULL, '{');
  ambulo__json_text(&json, "schema", "ambulo-case/1");
  ambulo__json_text(&json, "id", id);
  (void)snprintf(hex, sizeof hex, "%016llx", r->key);
  ambulo__json_text(&json, "key", hex);
  ambulo__json_text(&json, "state", r->state);
  ambulo__json_text(&json, "start", r->start);
  (void)snprintf(hex, sizeof hex, "%016llx", r->origin);
  ambulo__json_text(&json, "origin", hex);
  ambulo__text_append_format(&text, ",\n  \"valid\": %s", r->valid ? "true" : "false");
  ambulo__json_integer(&json, "exit_code", r->exit_code);
  ambulo__json_integer(&json, "signal", r->signal);
  ambulo__json_number(&json, "seconds", r->seconds);
  ambulo__json_number(&json, "limit_seconds", r->limit_seconds);
  ambulo__json_integer(&json, "limit_megabytes", r->limit_megabytes);
  ambulo__json_number(&json, "violation", r->violation);
  (void)snprintf(hex, sizeof hex, "%016llx", r->summary);
  ambulo__json_text(&json, "summary", hex);
  ambulo__json_close(&json, '}');
  char *path = ambulo__case_path(a, directory, id, ".json");
  ambulo_status status = path ? ambulo__text_status(&text) : AMBULO_E_MEMORY;
  if (!status)
    status = ambulo__write_file(path, ambulo__text_data(&text), text.length, 1, a, diagnostics);
  ambulo__free(a, path);
  ambulo__text_free(&text);
  return status;
}

/* text of summary.json, and its hash; NULL: cannot be read */
static char *load_summary(const char *directory, const char *id, const ambulo_allocator *a,
                          unsigned long long *hash, size_t *length) {
  char *path = ambulo__case_path(a, directory, id, "/summary.json"), *text = NULL;
  if (path && ambulo__read_file(path, MOST_SUMMARY_BYTES, a, NULL, &text, length)) text = NULL;
  ambulo__free(a, path);
  if (text) *hash = ambulo__hash_text(AMBULO__HASH_START, text);
  return text;
}

static int known_verdict(const char *name) {
  static const char *const names[] = {
#define VERDICT_NAME(id, name, text) name,
      AMBULO_VERDICT_LIST(VERDICT_NAME)
#undef VERDICT_NAME
  };
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (strcmp(names[i], name) == 0) return 1;
  return 0;
}

static int take_fields(const ambulo__yaml_node *root, ambulo__record *r) {
  const char *verdict = text_at(root, "verdict");
  if (!verdict || !known_verdict(verdict) || strlen(verdict) >= sizeof r->state) return 0;
  const ambulo__yaml_node *worst =
      ambulo__yaml_get(ambulo__yaml_get(ambulo__yaml_get(root, "audit"), "violation"), "worst");
  const char *number = worst ? ambulo__yaml_text(worst) : NULL;
  r->violation = -1.0;
  if (number) (void)ambulo__parse_double(number, strlen(number), &r->violation);
  (void)snprintf(r->state, sizeof r->state, "%s", verdict);
  r->valid = strcmp(verdict, ambulo_verdict_name(AMBULO_OPTIMAL)) == 0 ||
             strcmp(verdict, ambulo_verdict_name(AMBULO_FEASIBLE)) == 0;
  return 1;
}

int ambulo__record_take_summary(const char *directory, const char *id, const ambulo_allocator *a,
                                ambulo__record *record) {
  unsigned long long hash = 0;
  size_t length = 0;
  char *text = load_summary(directory, id, a, &hash, &length);
  ambulo__yaml *document = NULL;
  int taken = text && !ambulo__yaml_load_text(text, length, "summary.json", a, NULL, &document) &&
              take_fields(ambulo__yaml_root(document), record);
  if (taken) record->summary = hash;
  ambulo__yaml_free(document);
  ambulo__free(a, text);
  return taken;
}

int ambulo__record_summary_intact(const char *directory, const char *id,
                                  const ambulo__record *record, const ambulo_allocator *a) {
  if (!record->summary) return 1;
  unsigned long long hash = 0;
  size_t length = 0;
  char *text = load_summary(directory, id, a, &hash, &length);
  int intact = text && hash == record->summary;
  ambulo__free(a, text);
  return intact;
}

int ambulo__record_was_cut(const ambulo__record *r, double seconds, int megabytes) {
  if (strcmp(r->state, "timeout") == 0) return seconds == 0.0 || seconds > r->limit_seconds;
  if (strcmp(r->state, "memory") == 0 && r->limit_megabytes > 0)
    return megabytes == 0 || megabytes > r->limit_megabytes;
  return 0;
}
