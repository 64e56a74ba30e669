/* definitions/problem_reader.h - reading a problem file, section by section
 * (docs/problem-format.md).
 *
 * Every section function reads its keys into reader->definition or reader->options and
 * records faults in the document; none stops at the first. Arrays of the definition are
 * blocks of the reader and live until the problem has copied them. */
#ifndef AMBULO_DEFINITIONS_PROBLEM_READER_H
#define AMBULO_DEFINITIONS_PROBLEM_READER_H

#include "ambulo/solve.h"
#include "ambulo/tools/load.h"
#include "formats/motion_file.h"
#include "formats/yaml_node.h"
#include "problem/members.h"
#include "problem/nlp.h"
#include "definitions/model_reader.h"

typedef struct ambulo__reader_block ambulo__reader_block;

typedef struct ambulo__problem_reader {
  ambulo_allocator allocator;
  ambulo_diagnostics *diagnostics;
  ambulo__yaml *document;  /* NULL before it is loaded */
  const char *directory;   /* where relative names start; "" for the current one */
  const char *text, *name; /* of the document, and what it is called */
  size_t length;
  ambulo__inputs inputs;       /* files that it is read from */
  const char *const *override; /* [override_count], which it is read with */
  int override_count;
  ambulo__reader_block *blocks;  /* freed with the reader */
  ambulo_status failure;         /* E_MEMORY, or what a referenced file failed with */
  double radians;                /* per unit of angle in the file; 0: not stated */
  int asked_for_unit;            /* the missing unit has been reported */
  ambulo_model *model;           /* NULL if it could not be loaded */
  ambulo_muscles *muscles;       /* NULL: the file names none */
  const ambulo__yaml_node *gait; /* the section, or NULL */
  const ambulo__yaml_node *grid; /* time.grid, or NULL */
  int has_duration;              /* time.duration is in the file */
  const char **model_override;   /* [model_overrides], of the model file's keys */
  int model_overrides;
  ambulo__problem_keys keys; /* of the file */
  ambulo_problem_definition definition;
  ambulo_options options;
} ambulo__problem_reader;

/* Zero-filled memory that lives as long as the reader; NULL sets reader->failure, and later faults
 * of the document, which may come of it, are not told. */
void *ambulo__reader_alloc(ambulo__problem_reader *reader, size_t count, size_t size);
/* `name`, which stands at `node`, seen from the reader's directory; or the shipped file. */
const char *ambulo__reader_path(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                const char *name);
/* Frees blocks and model. */
void ambulo__reader_clear(ambulo__problem_reader *reader);

/* The mapping under a key of the root; NULL (reported unless absent) for anything else. */
const ambulo__yaml_node *ambulo__reader_section(const ambulo__yaml_node *root, const char *key);

/* ---------------------------------------------------------------- by the tables of members */

/* Reads what the mapping `node` has of the members of `item` whose keys begin with `prefix` ("",
 * "constraints.") and have no further point; what it lacks stays as it is. Members that are read
 * apart, parts and arrays are the caller's, and closing the mapping. */
void ambulo__read_members(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                          const ambulo__structure *structure, const char *prefix, void *item);

/* Reads one of them, also one that is read apart, from where its value stands. */
void ambulo__read_member(ambulo__problem_reader *reader, const ambulo__yaml_node *value,
                         const ambulo__structure *structure, const char *key, void *item);

typedef void ambulo__item_reader(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                 void *item);
/* The items of a list, each set to its defaults and read by `read`, their number in *count. NULL
 * without a list, or after an error: something else, more than `most` or less than `least`. */
void *ambulo__read_items(ambulo__problem_reader *reader, const ambulo__yaml_node *list,
                         const ambulo__structure *structure, int least, int most,
                         ambulo__item_reader *read, int *count);

/* What has names in a model. */
typedef enum ambulo__named {
  AMBULO__NAMED_LINK,
  AMBULO__NAMED_COORDINATE,
  AMBULO__NAMED_POINT,
  AMBULO__NAMED_FOOT,
  AMBULO__NAMED_CAPSULE
} ambulo__named;
/* The index of what a node names; -1 without a node, or after an error with the nearest name. */
int ambulo__read_name_of(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                         ambulo__named kind);
/* The same of a name that stands at a node, such as a key beside its value. */
int ambulo__find_name_of(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                         const char *name, ambulo__named kind);

/* A value of coordinate i or of its rates in SI units and radians; the file's unit of angle
 * applies to revolute coordinates. */
double ambulo__read_coordinate_value(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                     int i);

/* Called with the model loaded: */
void ambulo__read_time(ambulo__problem_reader *reader, const ambulo__yaml_node *root);
/* The foot that a node names; -1 after an error, and without a node. */
int ambulo__read_foot(const ambulo__problem_reader *reader, const ambulo__yaml_node *node);
/* `contacts:`, a list. */
void ambulo__read_contacts(ambulo__problem_reader *reader, const ambulo__yaml_node *list);
/* `gait:` or `contacts:`; after the time, which it may complete. */
void ambulo__read_schedule(ambulo__problem_reader *reader, const ambulo__yaml_node *root);
void ambulo__read_trajectory(ambulo__problem_reader *reader, const ambulo__yaml_node *root);
void ambulo__read_constraints(ambulo__problem_reader *reader, const ambulo__yaml_node *section);
/* `ground`, `load`, `ground_reaction`; changes the model. After the constraints. */
void ambulo__read_ground(ambulo__problem_reader *reader, const ambulo__yaml_node *root);
/* An item of `load` that hands hold, at the end of definition.holds, of which there are at most
 * AMBULO__MOST_LOADS. */
void ambulo__read_hold(ambulo__problem_reader *reader, const ambulo__yaml_node *section);
/* An angle that belongs to no coordinate, in the file's unit. */
double ambulo__read_plain_angle(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                double fallback);
/* After the schedule. */
void ambulo__read_ends(ambulo__problem_reader *reader, const ambulo__yaml_node *section);
void ambulo__read_objective(ambulo__problem_reader *reader, const ambulo__yaml_node *node);
void ambulo__read_solver(ambulo__problem_reader *reader, const ambulo__yaml_node *section);
/* A tracking reference: the file's motion at the nodes, [intervals + 1][d], and the scale of
 * the coordinates it lacks set to 0. After all that events depend on: schedule, constraints, ends.
 * NULL when something was wrong. */
const double *ambulo__read_tracked_motion(ambulo__problem_reader *reader,
                                          const ambulo__yaml_node *node, double *scale);
/* The same at `samples` equally spaced times from 0 to the duration. */
const double *ambulo__read_sampled_motion(ambulo__problem_reader *reader,
                                          const ambulo__yaml_node *node, int samples,
                                          double *scale);
/* The table of a reference, which lasts as long as the problem; the caller frees it. `gaps`: cells
 * may be "nan", and markers of a TRC file are taken. NULL when something was wrong. */
ambulo__motion *ambulo__open_reference(ambulo__problem_reader *reader,
                                       const ambulo__yaml_node *node, int gaps);
/* Where terms look at it: the time nodes, [intervals + 1]. After all that events depend on. */
const double *ambulo__reference_times(ambulo__problem_reader *reader);
/* A column of it, `time` after its first row, linear between rows; next to a gap there is a gap. */
double ambulo__reference_at(const ambulo__motion *motion, int column, double time);
/* Members of terms that follow points, or forces and centres of pressure of feet. */
void ambulo__read_marks(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                        ambulo_term *term);
void ambulo__read_foot_loads(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                             ambulo_term *term);
/* `constraints.collision`, `constraints.reach`, `obstacles`. */
void ambulo__read_bodies(ambulo__problem_reader *reader, const ambulo__yaml_node *root);
/* `devices`: springs, dampers and actuators that the body wears. */
void ambulo__read_devices(ambulo__problem_reader *reader, const ambulo__yaml_node *list);
/* `muscles`: a file of them, and how strong they are; on the body as it is by now. */
void ambulo__read_problem_muscles(ambulo__problem_reader *reader, const ambulo__yaml_node *node);
/* `constraints.tubes`; after the time and the schedule. */
void ambulo__read_tubes(ambulo__problem_reader *reader, const ambulo__yaml_node *root);

#endif
