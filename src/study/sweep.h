/* study/sweep.h - the inside of a sweep: axes, groups, cases.
 *
 * An axis is one key of the problem and the texts it takes. A group is a set of axes that
 * advance together (a table's columns, the dimensions of a sample, `combine: zip`). The case
 * list is the product of the groups, the last one fastest, less what the filters take away,
 * then the explicit cases. */
#ifndef AMBULO_STUDY_SWEEP_H
#define AMBULO_STUDY_SWEEP_H

#include "ambulo/tools/batch.h"
#include "base/alloc.h"
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

/* A value of an axis. */
typedef struct ambulo__axis_value {
  char *override;          /* "key=value"; cases share these texts */
  unsigned long long file; /* hash of the file that the value names; 0: none */
  ambulo__spot spot;
} ambulo__axis_value;

typedef struct ambulo__axis {
  char *name, *key;
  char *label, *unit; /* in drawings; NULL: the name, what is known of the key */
  ambulo__spot spot;  /* of the key */
  ambulo__axis_value *value;
  int count, capacity;
} ambulo__axis;

typedef struct ambulo__axis_group {
  int first, axes; /* axes [first, first + axes) */
  int count;       /* values they have, all the same number */
} ambulo__axis_group;

typedef struct ambulo__sweep_case {
  char *id, *name;
  const char **override; /* [overrides], texts of the axes */
  int overrides;
  int previous;
  unsigned long long key;
} ambulo__sweep_case;

/* A column of the table. */
typedef struct ambulo__sweep_output {
  char *path; /* "objective", "max(tau.knee_angle_r)" */
  char *label,
      *unit; /* title of the column, in drawings too; NULL: the path, what is known of it */
  const char *known_unit;
} ambulo__sweep_output;

/* The key `front`. Its axes are the weights, axis i that of term i. */
typedef struct ambulo__sweep_front {
  int terms, points;               /* terms 0: no front */
  int neighbour;                   /* start_from: neighbour */
  double least;                    /* share of the other terms at an anchor */
  char *name[AMBULO__FRONT_TERMS]; /* of the terms */
  double own[AMBULO__FRONT_TERMS]; /* their weights in the base problem's file */
} ambulo__sweep_front;

struct ambulo_sweep {
  ambulo_allocator allocator;
  ambulo_diagnostics *diagnostics;              /* while loading */
  char *name, *path, *base, *case_name, *table; /* table: path of the CSV file, or NULL */
  ambulo__spot case_name_spot;
  ambulo__axis axis[AMBULO__SWEEP_AXES];
  int axes;
  ambulo__axis_group group[AMBULO__SWEEP_AXES];
  int groups;
  int zipped;                   /* the first so many axes advance together; 0: none */
  char **filter;                /* [filters] */
  ambulo__sweep_output *output; /* [outputs] */
  int filters, outputs;
  int chain_axis;      /* neighbours along it start from each other; -1: none */
  double case_seconds; /* 0: no limit */
  int case_megabytes;  /* 0: no limit */
  ambulo__sweep_case *cases;
  int *value; /* [cases][stride]: index into the axis's values; -1: not set */
  int stride; /* axes, those of explicit cases included */
  int case_count, case_capacity;
  ambulo__sweep_front front;
  int trusted; /* cases before it were run or verified by this process: their files are believed */
  /* of the base problem as understood; of its file's text; of the former with the versions */
  unsigned long long problem_hash, text_hash, base_hash;
};

/* Each reports its own faults; E_MEMORY or what the reader found. */
ambulo_status ambulo__sweep_read(ambulo_sweep *sweep, const ambulo__yaml *document);
ambulo_status ambulo__sweep_build_cases(ambulo_sweep *sweep,
                                        const ambulo__yaml_node *explicit_cases);
ambulo_status ambulo__sweep_read_table(ambulo_sweep *sweep, const ambulo__yaml_node *node);
/* Fills axes of a sampled group: samples values each, uniform in the axis's range. */
ambulo_status ambulo__sweep_read_samples(ambulo_sweep *sweep, const ambulo__yaml_node *node,
                                         int latin);
/* sweep_outputs.c: `outputs`, and the names and units that drawings use. */
ambulo_status ambulo__sweep_read_outputs(ambulo_sweep *sweep, const ambulo__yaml_node *node);
ambulo_status ambulo__sweep_read_label(ambulo_sweep *sweep, ambulo__axis *axis,
                                       const ambulo__yaml_node *node);
/* *copy of the text at a node, where there is one. */
ambulo_status ambulo__sweep_copy(ambulo_sweep *sweep, const ambulo__yaml_node *node, char **copy);
ambulo_status ambulo__sweep_read_values(ambulo_sweep *sweep, ambulo__axis *axis,
                                        const ambulo__yaml_node *node);

/* A fresh axis; a name of "" defaults to the key. Errors: E_SCHEMA (no key that can be set),
 * E_LIMIT (too many), E_MEMORY. */
ambulo_status ambulo__sweep_add_axis(ambulo_sweep *sweep, const char *name, const char *key,
                                     ambulo__spot spot, ambulo__axis **axis);
/* Errors: E_IO (a file that the value names cannot be read), E_LIMIT (too many), E_MEMORY. */
ambulo_status ambulo__axis_add_text(ambulo_sweep *sweep, ambulo__axis *axis, const char *text,
                                    size_t length, ambulo__spot spot);
ambulo_status ambulo__axis_add_node(ambulo_sweep *sweep, ambulo__axis *axis,
                                    const ambulo__yaml_node *node);
ambulo_status ambulo__axis_add_number(ambulo_sweep *sweep, ambulo__axis *axis, double value,
                                      ambulo__spot spot);
/* *hash of the regular file that a value names, seen from the base problem; 0: no such file.
 * Errors: E_IO, E_MEMORY. */
ambulo_status ambulo__sweep_hash_value(const ambulo_sweep *sweep, const char *name,
                                       unsigned long long *hash);
const char *ambulo__axis_text(const ambulo__axis *axis, int value);
int ambulo__sweep_find_axis(const ambulo_sweep *sweep, const char *name);
ambulo__spot ambulo__spot_of(const ambulo__yaml_node *node);
/* Its place in the sweep file or the table. */
ambulo__place ambulo__spot_place(const ambulo_sweep *sweep, ambulo__spot spot);

/* sweep.c: a sweep without cases, to which others add them one by one: its axes are none, so that
 * nothing is a product. `path` is the file that asks for it, `base` its problem, which is loaded
 * once. Errors as of ambulo_sweep_load. */
ambulo_status ambulo__sweep_begin(const char *name, const char *path, const char *base,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_sweep **sweep);
/* sweep_append.c: a case whose id is the hash of its overrides and of its start, so that the same
 * request is the same case whenever it comes: *index is that of the one that is there already, or
 * of a new one. previous: the case that it starts from; -1: zero. Errors: E_IO (a file that a value
 * names), E_LIMIT, E_MEMORY. */
ambulo_status ambulo__sweep_append(ambulo_sweep *sweep, const char *name,
                                   const char *const *overrides, int count, int previous,
                                   ambulo_diagnostics *diagnostics, int *index);

/* sweep_front.c: `front`, before and after the base problem was loaded: its terms become axes, its
 * first anchors cases. The document knows the faults; E_MEMORY. */
ambulo_status ambulo__sweep_read_front(ambulo_sweep *sweep, const ambulo__yaml_node *root);
ambulo_status ambulo__sweep_build_front(ambulo_sweep *sweep, const ambulo__yaml_node *root);
/* sweep_front_clone.c: a sweep of the same front without cases, which may grow; free with
 * ambulo_sweep_free. E_MEMORY. */
ambulo_status ambulo__sweep_clone_front(const ambulo_sweep *sweep, ambulo_sweep **clone);
/* sweep_front_cases.c: adds the case of a request, whose points have the places of the cases;
 * *index as of ambulo__sweep_append, as are errors. */
ambulo_status ambulo__sweep_append_point(ambulo_sweep *sweep, const ambulo__front_request *request,
                                         ambulo_diagnostics *diagnostics, int *index);

/* ambulo__yaml_close at the end of a section that was read, as `status` says; without memory what
 * was not read any more is no stranger. Returns `status`. */
static inline ambulo_status ambulo__sweep_close(const ambulo__yaml_node *section,
                                                ambulo_status status) {
  if (status != AMBULO_E_MEMORY) ambulo__yaml_close(section);
  return status;
}

/* sweep_check.c: what makes a case list wrong before anything is computed. Axes: two of one
 * name or key. Filters: neither side names an axis. Name: a {word} in
 * it is no axis, or a brace has no other half. Cases: two of
 * one name; and each value of each axis is read once together with the base problem, so that a
 * key that does not exist or a value of the wrong kind is told now and not by every case. */
ambulo_status ambulo__sweep_check_axes(ambulo_sweep *sweep);
ambulo_status ambulo__sweep_check_filters(ambulo_sweep *sweep, const ambulo__yaml_node *filters);
ambulo_status ambulo__sweep_check_name(ambulo_sweep *sweep, const char *pattern, ambulo__spot spot);
ambulo_status ambulo__sweep_check_cases(ambulo_sweep *sweep);

/* sweep_chains.c: sets `previous` of every case, and lets keys depend on it. */
ambulo_status ambulo__sweep_link_chains(ambulo_sweep *sweep);

/* 1 if "a OP b" holds, 0 if not, -1 if the text is no comparison of axis names, numbers and
 * words. OP: < <= > >= == !=. `text_of` gives the text of an axis name (NULL: no axis). */
int ambulo__filter_holds(const char *filter, const char *(*text_of)(void *user, const char *name),
                         void *user);
/* Both sides, trimmed. Returns the length of the operator; 0: the text is no comparison. */
size_t ambulo__filter_sides(const char *filter, char left[AMBULO__SWEEP_TEXT],
                            char right[AMBULO__SWEEP_TEXT]);

#endif
