/* people/force_columns.h - columns of forces, and the feet they belong to.
 *
 * Programs name the columns of a force on a body in many ways; those of one body form a group:
 *
 *   ambulo                 grf.right.x      cop.right.x       free_moment.right, moment.right.x
 *   OpenSim, gait models   ground_force_vx  ground_force_px   ground_torque_x
 *                          1_ground_force_vx, l_ground_force_vx, R_ground_force_vx
 *   force plates           ground_force_1_vx  ..._px          ground_torque_1_x, ground_moment_1_mx
 *   Moco, OpenCap          ground_force_r_vx, ground_force_right_vx
 *   AddBiomechanics        ground_force_calcn_r_vx  ..._px    ..._mx
 *
 * The name of a group is that of its columns up to the component: "grf.right", "1_ground_force",
 * "ground_force_calcn_r"; its tag is what that says besides ground_force: "right", "1", "calcn_r".
 * Letter case does not matter. */
#ifndef AMBULO_PEOPLE_FORCE_COLUMNS_H
#define AMBULO_PEOPLE_FORCE_COLUMNS_H

#include "ambulo/model.h"
#include "formats/motion_file.h"
#include "people/plausibility.h"

typedef struct ambulo__force_group {
  char name[AMBULO__MOTION_MAX_NAME + 16], tag[AMBULO__MOTION_MAX_NAME + 1];
  int force[3], point[3], torque[3]; /* columns of x, y, z; -1: not in the file */
  int free_moment;                   /* column about the normal; -1 */
  int moment[3];                     /* all of it, about the world's origin */
  int foot;                          /* of the model; -1: none */
} ambulo__force_group;

typedef struct ambulo__force_columns {
  ambulo_allocator allocator;
  const ambulo__motion *table; /* borrowed */
  const char *file;            /* borrowed */
  ambulo__force_group *groups;
  int count;
} ambulo__force_columns;

/* The groups of a table, no feet yet. Errors: E_SCHEMA (two columns for one component), E_MEMORY.
 * Fills *columns, which ambulo__force_columns_free releases. */
ambulo_status ambulo__force_columns_find(const ambulo__motion *table, const char *file,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics,
                                         ambulo__force_columns *columns);
void ambulo__force_columns_free(ambulo__force_columns *columns); /* accepts a zero-filled one */

/* Group of a name (or, if only one has it, of a tag), or -1. */
int ambulo__force_group_named(const ambulo__force_columns *columns, const char *name,
                              size_t length);
/* Adds a group whose columns begin with three texts, "F:P:T" as an OpenSim file of external loads
 * names them, and sets *index. P and T may be empty. Errors: E_SCHEMA (no such columns), E_MEMORY.
 */
ambulo_status ambulo__force_group_add(ambulo__force_columns *columns, const char *text,
                                      size_t length, ambulo_diagnostics *diagnostics, int *index);

/* ------------------------------------------------------- feet (force_match.c) */

/* Sets the foot of every group: as `map` says (ambulo/tools/inverse.h; NULL: nothing), else by
 * names. A tag fits a foot of the same name, or one of the same side (l, left, r, right) unless it
 * speaks of another part of the body. What fits two, or none while there are feet without columns,
 * is an error that lists the names of the file; a foot without columns and a group without foot are
 * doubts. Errors: E_ARGUMENT (map), E_SCHEMA, E_MEMORY. */
ambulo_status ambulo__force_columns_match(ambulo__force_columns *columns, const ambulo_model *model,
                                          const char *map, ambulo__doubts *doubts);
/* ---------------------------------------------- completeness (force_complete.c) */

/* Says which components the groups with a foot lack, as far as they matter to the model: all of
 * them, but for a planar model those in its plane. A force without any is an error, a missing
 * component of force or point a doubt; the height of points and torques are noted: they are taken
 * as the ground's and as 0. Errors: E_SCHEMA, E_MEMORY. */
ambulo_status ambulo__force_columns_complete(const ambulo__force_columns *columns,
                                             const ambulo_model *model, ambulo__doubts *doubts);
/* The axis (0, 1, 2) along which nothing matters to the model's coordinates; -1: none. *axis is
 * untouched after E_MEMORY. */
ambulo_status ambulo__idle_axis(const ambulo_model *model, const ambulo_allocator *allocator,
                                int *axis);

#endif
