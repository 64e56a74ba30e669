/* formats/yaml_node.h - a YAML document as a tree that remembers line and column.
 *
 * A strict subset, read from libyaml's events: one document, a mapping at the
 * top, depth <= 32, <= 16 MiB, UTF-8, no anchors, aliases, tags or merge keys, no
 * duplicate keys. Scalars keep their text; what they mean is decided by the
 * typed getters, which report what they got and what they expected.
 *
 * The getters never stop at the first fault: they record an error in the
 * reader's diagnostics, return a neutral value, and the caller goes on to find
 * the next one; ambulo__yaml_finish() tells whether anything was wrong. So each
 * of them takes a node of any kind, NULL among them, and none hands out what is
 * not there: a caller need not know what stands in a file to be safe from it.
 * Each key that is asked for is marked as known; ambulo__yaml_close() reports
 * the others with the nearest known name.
 *
 * Reading order: read_file.h, atomic_file.h, atomic_folder.c, paths.h, arena.h; yaml_node.h,
 * yaml_tree.h, yaml_load.c, yaml_parse.c, yaml_get.c, yaml_set.c; tables: sheet.h; motions:
 * motion_file.h, motion_read.c, motion_write.h; JSON: json_text.h.
 */
#ifndef AMBULO_FORMATS_YAML_NODE_H
#define AMBULO_FORMATS_YAML_NODE_H

#include "ambulo/status.h"
#include "base/diagnostics.h"
#include "base/text_buffer.h"

enum { AMBULO__YAML_MAX_BYTES = 16 << 20 }; /* of a document */

typedef struct ambulo__yaml ambulo__yaml;           /* a document */
typedef struct ambulo__yaml_node ambulo__yaml_node; /* a node of it */

typedef enum ambulo__yaml_kind {
  AMBULO__YAML_SCALAR,
  AMBULO__YAML_SEQUENCE,
  AMBULO__YAML_MAPPING
} ambulo__yaml_kind;

/* Reads a regular file (never a directory, FIFO or device) or text in memory.
 * Errors: E_IO, E_PARSE, E_SCHEMA (root is not a mapping, duplicate keys),
 * E_LIMIT, E_MEMORY. */
ambulo_status ambulo__yaml_load(const char *path, const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics, ambulo__yaml **document);
ambulo_status ambulo__yaml_load_text(const char *text, size_t length, const char *name,
                                     const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics, ambulo__yaml **document);
void ambulo__yaml_free(ambulo__yaml *document); /* accepts NULL */

/* Replaces or adds the scalar at a dotted path ("time.intervals",
 * "objective[0].weight", "links[shank_r].body.mass": items by number, `name` or `term`) by a
 * YAML flow text ("36", "[1, 2]", "off"): what `--set path=value` does. The texts null and ~ take a
 * key or an item away; what follows it moves up. Below the first key, mappings and rows of numbers
 * that are missing on the way are made (yaml_set.c). Errors: E_SCHEMA (no such parent, nothing to
 * take away), E_PARSE, E_MEMORY. */
ambulo_status ambulo__yaml_set(ambulo__yaml *document, const char *path, const char *value);
/* The same for a document that another one names under `above` ("model."), which messages put
 * before the path. */
ambulo_status ambulo__yaml_set_below(ambulo__yaml *document, const char *above, const char *path,
                                     const char *value);

/* The node at such a path, and NULL after an error (of no place in a file) where there is none. */
const ambulo__yaml_node *ambulo__yaml_at(ambulo__yaml *document, const char *path);

const ambulo__yaml_node *ambulo__yaml_root(const ambulo__yaml *document);
const char *ambulo__yaml_file(const ambulo__yaml *document);
/* E_SCHEMA (or the first other error) if any getter complained, else AMBULO_OK. */
ambulo_status ambulo__yaml_finish(const ambulo__yaml *document);

/* Where several kinds are legal; NULL is of none. */
int ambulo__yaml_is(const ambulo__yaml_node *node, ambulo__yaml_kind kind);
/* Items of a sequence, pairs of a mapping, in file order. A node of another kind is an error and
 * counts 0; so does NULL, silently. Out of range: NULL, "". */
int ambulo__yaml_items(const ambulo__yaml_node *sequence);
const ambulo__yaml_node *ambulo__yaml_item(const ambulo__yaml_node *sequence, int index);
int ambulo__yaml_pairs(const ambulo__yaml_node *mapping);
const char *ambulo__yaml_key(const ambulo__yaml_node *mapping, int index);
const ambulo__yaml_node *ambulo__yaml_value(const ambulo__yaml_node *mapping, int index);
/* Value of a key, NULL when absent; marks the key as known. A NULL mapping gives NULL; a node of
 * another kind is an error, once, and gives NULL. */
const ambulo__yaml_node *ambulo__yaml_get(const ambulo__yaml_node *mapping, const char *key);
/* The same; absence is an error ("missing required key 'mass' in links[2]"). */
const ambulo__yaml_node *ambulo__yaml_require(const ambulo__yaml_node *mapping, const char *key);
/* Marks a key as known without reading it. */
void ambulo__yaml_expect(const ambulo__yaml_node *mapping, const char *key);
/* Reports every key of `mapping` that nobody asked for. */
void ambulo__yaml_close(const ambulo__yaml_node *mapping);
/* file, line, column and key path of a node (path lives as long as the document); nowhere for
 * NULL. */
ambulo__place ambulo__yaml_place(const ambulo__yaml_node *node);
/* Records an error at a node and returns `status`; of NULL only the latter. */
ambulo_status ambulo__yaml_error(const ambulo__yaml_node *node, ambulo_status status,
                                 const char *hint, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* Records that a reader of the document found no memory; faults that are found afterwards may come
 * of it and are not recorded. */
void ambulo__yaml_out_of_memory(ambulo__yaml *document);
/* Records a warning at a node. */
void ambulo__yaml_warning(const ambulo__yaml_node *node, const char *hint, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Text of a plain or quoted scalar. "", never NULL, after an error when a list, a mapping or
 * nothing at all stands there; a NULL node gives "" silently. */
const char *ambulo__yaml_text(const ambulo__yaml_node *node);
/* Appends a node as YAML flow text, as --set takes it: 36, [1, 2], {a: "b"}. */
void ambulo__yaml_flow(const ambulo__yaml_node *node, ambulo__text_buffer *text);
/* Typed values. A NULL node gives `fallback` silently (so that
 * number(get(map, "k"), 1.0) reads an optional key). */
double ambulo__yaml_number(const ambulo__yaml_node *node, double fallback);
double ambulo__yaml_number_in(const ambulo__yaml_node *node, double min, double max,
                              double fallback);
int ambulo__yaml_integer(const ambulo__yaml_node *node, int min, int max, int fallback);
int ambulo__yaml_boolean(const ambulo__yaml_node *node, int fallback); /* true / false only */
/* Index of the scalar in words[0..count), error with the list (and nearest) otherwise. */
int ambulo__yaml_choice(const ambulo__yaml_node *node, const char *const *words, int count,
                        int fallback);
/* Which of kinds[0..count) a file is, by its key `kind`, else by the keys it has (a model need not
 * say its kind). Another format is one error that names it and who takes it, and -1: its other keys
 * would only be noise. 0 when nothing tells. */
int ambulo__yaml_file_kind(const ambulo__yaml_node *root, const char *const *kinds, int count);
/* A name: 1-64 characters of letters, digits, '_', '-', '.'. "", never NULL, with an error
 * otherwise; a NULL node gives "" silently. */
const char *ambulo__yaml_name(const ambulo__yaml_node *node);
/* The same for the name of a file: any text but an empty one. */
const char *ambulo__yaml_file_name(const ambulo__yaml_node *node);
/* A sequence of exactly `count` numbers into values[]; 1 on success. A NULL node
 * leaves values[] as they are and returns 0. */
int ambulo__yaml_numbers(const ambulo__yaml_node *node, int count, double *values);
/* The same where values[] has what stands by default: items that a path left out keep it. */
int ambulo__yaml_numbers_over(const ambulo__yaml_node *node, int count, double *values);

#endif
