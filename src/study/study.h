/* study/study.h - a study: many variants of one problem.
 *
 * A study is read from a sweep file (sweep_file.c), or from the folder that a run has described
 * (batch_listing.c); either way it is the same structure: axes, columns of outputs, cases with the
 * texts that their axes take, a front.
 *
 * An axis is one key of the problem and the texts it takes. A group is a set of axes that
 * advance together (a table's columns, the dimensions of a sample, `combine: zip`). The case
 * list is the product of the groups, the last one fastest, less what the filters take away,
 * then the explicit cases.
 *
 * Reading order: study.h, sweep_file.c, sweep_axes.c, study_inputs.c, case_list.c, sweep_check.c;
 * batch_listing.c; batch.h, batch_folder.c, case_record.c, batch_run.c, batch_worker.c; results.h,
 * outputs.c, results.c; front.h and what it leads to; case_pack.h, study_page.c. */
#ifndef AMBULO_STUDY_STUDY_H
#define AMBULO_STUDY_STUDY_H

#include "ambulo/problem.h"
#include "ambulo/tools/batch.h"
#include "base/alloc.h"
#include "base/text_buffer.h"
#include "formats/yaml_node.h"
#include "study/front.h"

enum {
  AMBULO__SWEEP_AXES = 64,
  AMBULO__SWEEP_CASES = 1000000,
  AMBULO__AXIS_VALUES = 1000000, /* of one axis */
  AMBULO__SWEEP_TEXT = 256
};

/* Where something stands in the sweep file, or in its table. */
typedef struct ambulo__spot {
  int line, column;
  int in_table;
} ambulo__spot;

/* A value of an axis in a sweep file. */
typedef struct ambulo__axis_value {
  char *override;          /* "key=value"; cases share these texts */
  unsigned long long file; /* hash of the file that the value names; 0: none */
  ambulo__spot spot;
  int used; /* by a case */
} ambulo__axis_value;

typedef struct ambulo__axis {
  char *name, *key;
  char *label, *unit; /* on the page: what the file says, else the name, what is known of the key */
  ambulo__spot spot;  /* of the key */
  ambulo__axis_value *value;
  int count, capacity;
} ambulo__axis;

/* A column of the table. */
typedef struct ambulo__sweep_output {
  char *path; /* "objective", "max(tau.knee_angle_r)" */
  char *label,
      *unit; /* title, unit on the page: what the file says, else the path, what is known */
} ambulo__sweep_output;

typedef struct ambulo__axis_group {
  int first, axes; /* axes [first, first + axes) */
  int count;       /* values they have, all the same number */
} ambulo__axis_group;

typedef struct ambulo__sweep_case {
  char *id, *name;
  unsigned long long key; /* of all that its result depends on */
  /* of a sweep file */
  const char **override; /* [overrides] */
  int overrides;
  int previous;    /* the case that it starts from; -1: zero */
  long long place; /* in the list before filters */
} ambulo__sweep_case;

struct ambulo_sweep {
  ambulo_allocator allocator;
  char *name, *path, *base;
  ambulo__axis axis[AMBULO__SWEEP_AXES];
  int axes;
  int zipped; /* the first so many axes advance together; 0: none */
  ambulo__sweep_output *output;
  int outputs;
  ambulo__sweep_case *cases;
  const char **cell; /* [cases][axes]: texts of the axes; "" where a case does not set one */
  int case_count, case_capacity;
  ambulo__front
      front; /* the key `front`, without points; its axes are the weights; terms 0: none */
  /* what it was made from: hashes of the base problem as understood and of its file's text;
   * versions of Ambulo and NLopt */
  char problem_hash[20], text_hash[20], version[96];
  char *list; /* of a folder: cases.tsv, in which ids, names and texts of cases stand; NULL: none */

  /* of a sweep file alone */
  ambulo_diagnostics *diagnostics; /* while loading */
  char *case_name, *table;         /* table: path of the CSV file, or NULL */
  ambulo__spot case_name_spot;
  ambulo__axis_group group[AMBULO__SWEEP_AXES];
  int groups;
  char **filter; /* [filters] */
  int filters;
  int chain_axis;               /* neighbours along it start from each other; -1: none */
  double case_seconds;          /* 0: no limit */
  int case_megabytes;           /* 0: no limit */
  unsigned long long base_hash; /* of the problem and the versions */
  char *base_inputs;            /* files that the base problem was read from (formats/inputs.h) */
  ambulo__text_buffer *known;   /* all files that cases are read from */
  int trusted; /* cases before it were run or verified by this process: their files are not read
                  again */
};

/* ---------------------------------------------------------------- sweep_file.c */

/* A study without cases, to which others add them one by one: its axes are none, so that nothing is
 * a product. `path` is the file that asks for it, `base` its problem, which is loaded once, `known`
 * the files that were read before (formats/inputs.h). Errors as of ambulo_sweep_load. */
ambulo_status ambulo__sweep_begin(const char *name, const char *path, const char *base,
                                  const char *known, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_sweep **sweep);
/* *copy of the text at a node, where there is one. */
static inline ambulo_status ambulo__sweep_copy(const ambulo_sweep *sweep,
                                               const ambulo__yaml_node *node, char **copy) {
  if (!node) return AMBULO_OK;
  char *text = ambulo__strdup(&sweep->allocator, ambulo__yaml_text(node));
  if (!text) return AMBULO_E_MEMORY;
  *copy = text;
  return AMBULO_OK;
}
/* ambulo__yaml_close at the end of a section that was read, as `status` says; without memory the
 * keys that were not read are not unknown. Returns `status`. */
static inline ambulo_status ambulo__sweep_close(const ambulo__yaml_node *section,
                                                ambulo_status status) {
  if (status != AMBULO_E_MEMORY) ambulo__yaml_close(section);
  return status;
}

/* ---------------------------------------------------------------- sweep_axes.c
 * Each reports its own faults; E_MEMORY or what the reader found. */

/* `axes`, `combine`, `table`, `latin_hypercube`, `random`. */
ambulo_status ambulo__sweep_read_axes(ambulo_sweep *sweep, const ambulo__yaml_node *root);
/* A fresh axis; a name of "" defaults to the key. Errors: E_SCHEMA (no key that can be set),
 * E_LIMIT (too many), E_MEMORY. */
ambulo_status ambulo__sweep_add_axis(ambulo_sweep *sweep, const char *name, const char *key,
                                     ambulo__spot spot, ambulo__axis **axis);
ambulo_status ambulo__axis_add_node(ambulo_sweep *sweep, ambulo__axis *axis,
                                    const ambulo__yaml_node *node);
const char *ambulo__axis_text(const ambulo__axis *axis, int value);
int ambulo__sweep_find_axis(const ambulo_sweep *sweep, const char *name);
/* The axis whose numbers only rise or only fall, with most values, of as many the last one, which
 * varies fastest; -1: none. */
int ambulo__sweep_find_chain(const ambulo_sweep *sweep);
ambulo__spot ambulo__spot_of(const ambulo__yaml_node *node);
/* Its place in the sweep file or the table. */
ambulo__place ambulo__spot_place(const ambulo_sweep *sweep, ambulo__spot spot);

/* -------------------------------------------------------------- study_inputs.c */

/* *hash of the regular files that a value names, seen from the base problem; 0: none. They become
 * known. Errors: E_IO, E_MEMORY. */
ambulo_status ambulo__sweep_hash_value(const ambulo_sweep *sweep, const char *value,
                                       unsigned long long *hash);
/* Appends all that the case may be read from (formats/inputs.h). Errors: E_MEMORY. */
ambulo_status ambulo__sweep_case_inputs(const ambulo_sweep *sweep, int index,
                                        ambulo__text_buffer *lines);

/* ----------------------------------------------------------------- case_list.c */

ambulo_status ambulo__sweep_build_cases(ambulo_sweep *sweep,
                                        const ambulo__yaml_node *explicit_cases);
/* A case whose id is the hash of its overrides and of its start, so that the same request is the
 * same case whenever it comes: *index is that of the one that is there already, or of a new one.
 * The overrides set the axes in their order, if there are axes. previous: the case that it starts
 * from; -1: zero. Errors: E_IO (a file that a value names), E_LIMIT, E_MEMORY. */
ambulo_status ambulo__sweep_append(ambulo_sweep *sweep, const char *name,
                                   const char *const *overrides, int count, int previous,
                                   ambulo_diagnostics *diagnostics, int *index);
/* The same study without cases, which may grow while the other stays as it is: all but the cases
 * belongs to the latter. free_cases frees what has grown. */
ambulo_sweep ambulo__sweep_without_cases(const ambulo_sweep *sweep);
void ambulo__sweep_free_cases(ambulo_sweep *sweep);

/* --------------------------------------------------------------- sweep_check.c
 * What makes a case list wrong before anything is computed. Axes: two of one name or key. Filters:
 * neither side names an axis. Name: a {word} in it is no axis, or a brace has no other half. Cases:
 * two of one name; and `probes` are read together with the base problem, among them each value of
 * each axis once, so that an unknown key or a value of the wrong kind is reported now, not once per
 * case. */
enum { AMBULO__SWEEP_PROBES = 200 };
ambulo_status ambulo__sweep_check_axes(ambulo_sweep *sweep);
ambulo_status ambulo__sweep_check_filters(ambulo_sweep *sweep, const ambulo__yaml_node *filters);
ambulo_status ambulo__sweep_check_name(ambulo_sweep *sweep, const char *pattern, ambulo__spot spot);
ambulo_status ambulo__sweep_check_cases(ambulo_sweep *sweep, const int *probe, int probes);
/* 1 if "a OP b" holds, 0 if not, -1 if the text is no comparison of axis names, numbers and
 * words. OP: < <= > >= == !=. `text_of` gives the text of an axis name (NULL: no axis). */
int ambulo__filter_holds(const char *filter, const char *(*text_of)(void *user, const char *name),
                         void *user);

/* ------------------------------------------------------------- batch_listing.c
 * DIR/cases.tsv: one line a case: id, key (16 hexadecimal digits), name, one column an axis.
 * DIR/batch.json: name, versions, base problem and its hash, checksum of the list, axes, outputs;
 * sealed (formats/seal.h). Both are written when a run begins. */

/* Describes the sweep in the folder. Errors: E_IO, E_MEMORY. */
ambulo_status ambulo__study_describe(const ambulo_sweep *sweep, const char *directory,
                                     const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics);
/* The study of a folder. Errors: E_IO (no such folder, no batch in it, either file damaged),
 * E_PROBLEM (of another version), E_MEMORY. */
ambulo_status ambulo__study_load(const char *directory, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo_sweep **study);
/* The same, and *damaged = 1 where a file is there, and is not what was written. */
ambulo_status ambulo__study_try(const char *directory, const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics, ambulo_sweep **study,
                                int *damaged);

/* *key of 16 hexadecimal digits; 0: the text is none. */
int ambulo__read_key(const char *text, unsigned long long *key);

/* --------------------------------------------------------------- front_cases.c */

/* `front`, before and after the base problem was loaded: its terms become axes, its first ends
 * cases. The document knows the faults; E_MEMORY. */
ambulo_status ambulo__sweep_read_front(ambulo_sweep *sweep, const ambulo__yaml_node *root);
ambulo_status ambulo__sweep_build_front(ambulo_sweep *sweep, const ambulo__yaml_node *node,
                                        const ambulo_problem *base);
/* Adds the case of a request, whose points have the places of the cases; *index as of
 * ambulo__sweep_append, as are errors. */
ambulo_status ambulo__sweep_append_point(ambulo_sweep *sweep, const ambulo__front_request *request,
                                         ambulo_diagnostics *diagnostics, int *index);

#endif
