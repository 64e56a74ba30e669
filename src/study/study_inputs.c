/* study/study_inputs.c - the files that cases are solved from (study.h).
 *
 * A value of an axis is a word, a number, a name of a file, or whatever else; names also stand
 * within lists and mappings. What the base problem reads and what values name is known, with its
 * bytes, from the first time on (formats/inputs.h): loads of the problem have to read the same, and
 * so do workers, which get the list of their case.
 */
#include "base/numtext.h"
#include "formats/atomic_file.h"
#include "formats/inputs.h"
#include "formats/paths.h"
#include "study/study.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

enum { MOST_FILE_BYTES = 16 << 20 };

/* *yes: a file of this name is there. That nobody can tell is an error: another key would be
 * computed. */
static ambulo_status is_file(const ambulo_sweep *s, const char *path, int *yes) {
  struct stat entry;
  *yes = 0;
  if (stat(path, &entry) == 0) {
    *yes = S_ISREG(entry.st_mode) && entry.st_size <= MOST_FILE_BYTES;
    return AMBULO_OK;
  }
  int none = errno == ENOENT || errno == ENOTDIR || errno == ENAMETOOLONG || errno == ELOOP;
  return none ? AMBULO_OK : ambulo__io_error(s->diagnostics, path, "inspect");
}

/* the line of a file that is not known yet, which is read; NULL: there is none */
static ambulo_status learn(const ambulo_sweep *s, const char *path, const char **line) {
  char digest[AMBULO__SHA256_TEXT];
  int yes = 0;
  ambulo_status status = is_file(s, path, &yes);
  if (status || !yes) return status;
  status = ambulo__digest_file(path, s->diagnostics, digest);
  if (status) return status;
  ambulo__text_append_format(s->known, "%s  %s\n", digest, path);
  *line = ambulo__inputs_find(ambulo__text_data(s->known), path);
  return ambulo__text_status(s->known);
}

/* *line of what a scalar names, as the reader of problems finds it, silently; NULL: no file. learns
 * 0: only what is known. */
static ambulo_status find(const ambulo_sweep *s, const char *name, int learns, const char **line) {
  const ambulo__place nowhere = {NULL, 0, 0, NULL};
  const ambulo_allocator *a = &s->allocator;
  const char *from = s->base ? s->base : s->path;
  double number;
  *line = NULL;
  if (!name[0] || ambulo__parse_double(name, strlen(name), &number)) return AMBULO_OK;
  char *path = ambulo__sibling_path(a, from, name);
  if (!path) return AMBULO_E_MEMORY;
  ambulo_status status = AMBULO_OK;
  *line = ambulo__inputs_find(ambulo__text_data(s->known), path);
  if (!*line) {
    ambulo__free(a, path);
    path = NULL;
    status = ambulo__named_file(a, from, name, nowhere, NULL, &path);
    if (!status) *line = ambulo__inputs_find(ambulo__text_data(s->known), path);
    if (!status && !*line && learns) status = learn(s, path, line);
  }
  ambulo__free(a, path);
  return status;
}

/* all that a value names, into `lines` (NULL: not wanted) and the hash */
typedef struct gatherer {
  const ambulo_sweep *sweep;
  int learns;
  ambulo__text_buffer *lines;
  unsigned long long hash; /* 0: nothing yet */
} gatherer;

/* once */
static ambulo_status add_line(ambulo__text_buffer *lines, const char *line) {
  size_t length = strcspn(line, "\n") + 1;
  for (const char *at = ambulo__text_data(lines); (at = strchr(at, line[0])) != NULL; at++)
    if (strncmp(at, line, length) == 0) return AMBULO_OK;
  ambulo__text_append_bytes(lines, line, length);
  return ambulo__text_status(lines);
}

static ambulo_status gather_name(gatherer *g, const char *name) {
  const char *line = NULL;
  ambulo_status status = find(g->sweep, name, g->learns, &line);
  if (status || !line) return status;
  char digest[AMBULO__SHA256_TEXT];
  memcpy(digest, line, sizeof digest - 1);
  digest[sizeof digest - 1] = '\0';
  g->hash = ambulo__hash_text(g->hash ? g->hash : AMBULO__HASH_START, digest);
  return g->lines ? add_line(g->lines, line) : AMBULO_OK;
}

static ambulo_status gather_node(gatherer *g, const ambulo__yaml_node *node) {
  ambulo_status status = AMBULO_OK;
  if (ambulo__yaml_is(node, AMBULO__YAML_SCALAR)) return gather_name(g, ambulo__yaml_text(node));
  int items = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) ? ambulo__yaml_items(node) : 0;
  int pairs = ambulo__yaml_is(node, AMBULO__YAML_MAPPING) ? ambulo__yaml_pairs(node) : 0;
  for (int i = 0; i < items && !status; i++) status = gather_node(g, ambulo__yaml_item(node, i));
  for (int i = 0; i < pairs && !status; i++) status = gather_node(g, ambulo__yaml_value(node, i));
  return status;
}

static ambulo_status gather(gatherer *g, const char *value) {
  ambulo__yaml *document = NULL;
  if (value[0] != '{' && value[0] != '[') return gather_name(g, value);
  /* what is no list or mapping after all names nothing, and is reported as a value */
  ambulo_status status =
      ambulo__yaml_load_text(value, strlen(value), "value", &g->sweep->allocator, NULL, &document);
  if (!status) status = gather_node(g, ambulo__yaml_root(document));
  ambulo__yaml_free(document);
  return document || status == AMBULO_E_MEMORY ? status : AMBULO_OK;
}

ambulo_status ambulo__sweep_hash_value(const ambulo_sweep *s, const char *value,
                                       unsigned long long *hash) {
  gatherer g = {.sweep = s, .learns = 1};
  ambulo_status status = gather(&g, value);
  if (!status) *hash = g.hash;
  return status;
}

ambulo_status ambulo__sweep_case_inputs(const ambulo_sweep *s, int index,
                                        ambulo__text_buffer *lines) {
  const ambulo__sweep_case *one = &s->cases[index];
  gatherer g = {.sweep = s, .lines = lines};
  ambulo_status status = AMBULO_OK;
  ambulo__text_append(lines, s->base_inputs ? s->base_inputs : "");
  for (int i = 0; i < one->overrides && !status; i++) {
    const char *value = strchr(one->override[i], '=');
    if (value) status = gather(&g, value + 1);
  }
  return status ? status : ambulo__text_status(lines);
}
