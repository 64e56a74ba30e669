/* study/listing_prepare.c - turning a folder into the batch folder of a sweep, and telling what
 * changed since it was one (listing.h). */
#include "ambulo/tools/report.h"
#include "formats/atomic_file.h"
#include "formats/file_steps.h"
#include "formats/output_check.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "formats/seal.h"
#include "base/text_buffer.h"
#include "study/batch_listing.h"
#include "study/listing_changes.h"
#include "formats/json_text.h"
#include "study/sweep.h"
#include "study/units.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* ------------------------------------------------------------------ writing */

/* tabs and line ends separate cells, so they become blanks inside */
static void append_cell(ambulo__text_buffer *text, const char *cell, char end) {
  for (; *cell; cell++) {
    char c = *cell == '\t' || *cell == '\n' || *cell == '\r' ? ' ' : *cell;
    ambulo__text_append_char(text, c);
  }
  ambulo__text_append_char(text, end);
}

static void list_text(const ambulo_sweep *s, ambulo__text_buffer *text) {
  char end = s->axes > 0 ? '\t' : '\n';
  ambulo__text_append(text, "id\tkey\tname");
  ambulo__text_append_char(text, end);
  for (int i = 0; i < s->axes; i++)
    append_cell(text, s->axis[i].name, i + 1 < s->axes ? '\t' : '\n');
  for (int k = 0; k < s->case_count; k++) {
    const ambulo__sweep_case *one = &s->cases[k];
    ambulo__text_append_format(text, "%s\t%016llx\t", one->id, one->key);
    append_cell(text, one->name, end);
    for (int i = 0; i < s->axes; i++)
      append_cell(text, ambulo_sweep_value(s, k, i), i + 1 < s->axes ? '\t' : '\n');
  }
}

static void open_list(ambulo__json *json, const char *key) {
  ambulo__json_open(json, key, '[');
}

static void close_list(ambulo__json *json) {
  ambulo__json_close(json, ']');
}

/* what stands in the columns of the table, and how drawings call it */
static void describe_columns(const ambulo_sweep *s, ambulo__json *json) {
  open_list(json, "outputs");
  for (int i = 0; i < s->outputs; i++) ambulo__json_text(json, NULL, s->output[i].path);
  close_list(json);
  open_list(json, "output_labels");
  for (int i = 0; i < s->outputs; i++) {
    const ambulo__sweep_output *o = &s->output[i];
    ambulo__json_text(json, NULL, o->label ? o->label : o->path);
  }
  close_list(json);
  open_list(json, "output_units");
  for (int i = 0; i < s->outputs; i++) {
    const ambulo__sweep_output *o = &s->output[i];
    ambulo__json_text(json, NULL, o->unit ? o->unit : o->known_unit);
  }
  close_list(json);
  open_list(json, "axes");
  for (int i = 0; i < s->axes; i++) ambulo__json_text(json, NULL, s->axis[i].key);
  close_list(json);
  ambulo__json_integer(json, "zipped_axes", s->zipped);
  open_list(json, "axis_labels");
  for (int i = 0; i < s->axes; i++) {
    const ambulo__axis *axis = &s->axis[i];
    ambulo__json_text(json, NULL, axis->label ? axis->label : axis->name);
  }
  close_list(json);
  open_list(json, "axis_units");
  for (int i = 0; i < s->axes; i++) {
    const ambulo__axis *axis = &s->axis[i];
    ambulo__json_text(json, NULL, axis->unit ? axis->unit : ambulo__unit_of_key(axis->key));
  }
  close_list(json);
}

static void describe(const ambulo_sweep *s, const char *digest, ambulo__text_buffer *text) {
  ambulo_versions versions;
  ambulo_versions_get(&versions);
  ambulo__json json = {text, 0, 1};
  char hash[20], version[64];
  (void)snprintf(hash, sizeof hash, "%016llx", s->problem_hash);
  (void)snprintf(version, sizeof version, "ambulo %s, NLopt %s", versions.ambulo, versions.nlopt);
  ambulo__json_open(&json, NULL, '{');
  ambulo__json_text(&json, "schema", AMBULO__LISTING_SCHEMA);
  ambulo__json_text(&json, "name", s->name);
  ambulo__json_text(&json, "version", version);
  ambulo__json_text(&json, "sweep", s->path);
  ambulo__json_text(&json, "base", s->base);
  ambulo__json_text(&json, "problem_hash", hash);
  (void)snprintf(hash, sizeof hash, "%016llx", s->text_hash);
  ambulo__json_text(&json, "text_hash", hash);
  ambulo__json_integer(&json, "cases", s->case_count);
  ambulo__json_text(&json, "cases_sha256", digest);
  describe_columns(s, &json);
  if (s->front.terms > 0) ambulo__listing_describe_front(s, &json);
  ambulo__seal(text);
}

/* The file holds this already, as it does whenever a shard or a resumed run begins. One that cannot
 * be read is written again. */
static int is_written(const char *path, const ambulo__text_buffer *text,
                      const ambulo_allocator *a) {
  char *old = NULL;
  size_t length = 0;
  if (ambulo__read_file(path, text->length, a, NULL, &old, &length)) return 0;
  int same = length == text->length && memcmp(old, ambulo__text_data(text), length) == 0;
  ambulo__free(a, old);
  return same;
}

static ambulo_status write_text(const char *directory, const char *name,
                                const ambulo__text_buffer *text, const ambulo_allocator *a,
                                ambulo_diagnostics *diagnostics) {
  char *path = ambulo__join_paths(a, directory, name, NULL);
  ambulo_status status = path ? ambulo__text_status(text) : AMBULO_E_MEMORY;
  if (!status && !is_written(path, text, a))
    status = ambulo__write_file(path, ambulo__text_data(text), text->length, 1, a, diagnostics);
  ambulo__free(a, path);
  return status;
}

static ambulo_status write_listing(const ambulo_sweep *s, const char *directory,
                                   const ambulo_allocator *a, ambulo_diagnostics *diagnostics) {
  ambulo__text_buffer text;
  char digest[AMBULO__SHA256_TEXT];
  ambulo__text_init(&text, a);
  list_text(s, &text);
  ambulo__sha256_of(ambulo__text_data(&text), text.length, digest);
  ambulo_status status = write_text(directory, "cases.tsv", &text, a, diagnostics);
  ambulo__text_clear(&text);
  describe(s, digest, &text);
  if (!status) status = write_text(directory, "batch.json", &text, a, diagnostics);
  ambulo__text_free(&text);
  return status;
}

/* ----------------------------------------------------------------- the folder */

static int begins_with(const char *name, const char *start) {
  return strncmp(name, start, strlen(start)) == 0;
}

/* names that only a batch gives to what it writes */
static int is_evidence(const char *name) {
  return strcmp(name, "lock") == 0 || begins_with(name, "lock.") ||
         begins_with(name, "cases.tsv.tmp-") || begins_with(name, "batch.json.tmp-");
}

/* names that a batch shares with others */
static int is_known(const char *name) {
  static const char *const names[] = {".",          "..",          "cases",        "cases.tsv",
                                      "batch.json", "results.csv", "results.jsonl"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (strcmp(name, names[i]) == 0) return 1;
  /* drawings are those of earlier versions */
  return begins_with(name, "results_") || begins_with(name, "front.svg") ||
         begins_with(name, "results.csv.tmp-") || begins_with(name, "results.jsonl.tmp-");
}

/* a file of the folder that begins as a batch writes it */
static int says(const char *directory, const char *name, const char *text,
                const ambulo_allocator *a) {
  char *path = ambulo__join_paths(a, directory, name, NULL);
  int found = path && ambulo__file_says(path, text, 64);
  ambulo__free(a, path);
  return found;
}

/* what the names in a folder say */
typedef struct contents {
  int strange;  /* a name that no batch gives */
  int evidence; /* a name that only a batch gives */
  int others;   /* any name but `cases` */
} contents;

static ambulo_status look_into(const char *directory, ambulo_diagnostics *diagnostics,
                               contents *c) {
  DIR *stream = opendir(directory);
  if (!stream) return ambulo__io_error(diagnostics, directory, "read the folder");
  const struct dirent *e;
  do {
    errno = 0;
    e = readdir(stream);
    const char *name = e ? e->d_name : "cases";
    c->evidence |= is_evidence(name);
    c->strange |= !is_evidence(name) && !is_known(name);
    c->others |= strcmp(name, "cases") != 0 && strcmp(name, ".") != 0 && strcmp(name, "..") != 0;
  } while (e);
  int fault = errno;
  closedir(stream);
  errno = fault;
  return fault ? ambulo__io_error(diagnostics, directory, "read the folder") : AMBULO_OK;
}

/* *may = 1: a batch's folder; or empty but for a folder `cases`; or what a batch leaves that was
 * stopped before it had written its description, or whose description is damaged */
static ambulo_status may_fill(const char *directory, const ambulo_allocator *a,
                              ambulo_diagnostics *diagnostics, int *may) {
  contents c = {0};
  *may = says(directory, "batch.json", "\"ambulo-batch/", a);
  if (*may) return AMBULO_OK;
  ambulo_status status = look_into(directory, diagnostics, &c);
  int evidence = c.evidence || says(directory, "cases.tsv", "id\tkey\tname", a);
  *may = !c.strange && (evidence || !c.others);
  return status;
}

static ambulo_status make_folder(const char *path, ambulo_diagnostics *diagnostics) {
  struct stat entry;
  if (mkdir(path, 0777) == 0) return AMBULO_OK;
  if (errno == EEXIST && stat(path, &entry) == 0 && !S_ISDIR(entry.st_mode)) errno = ENOTDIR;
  return errno == EEXIST ? AMBULO_OK : ambulo__io_error(diagnostics, path, "create the folder");
}

ambulo_status ambulo__batch_make_folders(const char *directory, const ambulo_allocator *a,
                                         ambulo_diagnostics *diagnostics) {
  int may = 0;
  ambulo_status status = make_folder(directory, diagnostics);
  if (!status) status = may_fill(directory, a, diagnostics, &may);
  if (!status && !may) {
    ambulo__place place = {directory, 0, 0, NULL};
    status = ambulo__error(diagnostics, AMBULO_E_IO, place, NULL,
                           "the folder holds other files; expected a new, an empty or a batch "
                           "folder");
  }
  char *cases = ambulo__join_paths(a, directory, "cases", NULL);
  if (!status) status = cases ? make_folder(cases, diagnostics) : AMBULO_E_MEMORY;
  ambulo__free(a, cases);
  return status;
}

/* *there: whether the folder has a batch.json */
static ambulo_status find_mark(const char *directory, const ambulo_allocator *a,
                               ambulo_diagnostics *diagnostics, int *there) {
  struct stat entry;
  char *mark = ambulo__join_paths(a, directory, "batch.json", NULL);
  if (!mark) return AMBULO_E_MEMORY;
  *there = stat(mark, &entry) == 0;
  ambulo_status status =
      *there || errno == ENOENT ? AMBULO_OK : ambulo__io_error(diagnostics, mark, "inspect");
  ambulo__free(a, mark);
  return status;
}

ambulo_status ambulo__listing_check(const ambulo_sweep *sweep, const char *directory, int force,
                                    const ambulo_allocator *a, ambulo_diagnostics *diagnostics) {
  struct stat entry;
  int there = 0;
  if (stat(directory, &entry) != 0) return AMBULO_OK; /* the run makes it, or says why not */
  ambulo_status status = find_mark(directory, a, diagnostics, &there);
  if (status || !there) return status;
  return ambulo__listing_compare(sweep, directory, force, a, diagnostics);
}

ambulo_status ambulo__listing_prepare(const ambulo_sweep *sweep, const char *directory, int force,
                                      const ambulo_allocator *a, ambulo_diagnostics *diagnostics) {
  int there = 0;
  ambulo_status status = find_mark(directory, a, diagnostics, &there);
  if (!status && there) status = ambulo__listing_compare(sweep, directory, force, a, diagnostics);
  return status ? status : write_listing(sweep, directory, a, diagnostics);
}
