/* import/meshes.h - what a body looks like: a file of meshes beside its model.
 *
 * Of robot.yaml it is robot.meshes, JSON:
 *
 *     {"schema": "ambulo-meshes/1", "meshes": [{"link", "vertices", "triangles"}, ...]}
 *
 * Both texts are whole numbers between blanks, each the difference from the one before: vertices x,
 * y, z in the link's frame, in units of .1 mm, from the vertex before; triangles three numbers of
 * vertices. Nothing but the page asks for it (show/scene_meshes.c): motions do not depend on it. */
#ifndef AMBULO_IMPORT_MESHES_H
#define AMBULO_IMPORT_MESHES_H

#include "base/alloc.h"
#include "base/text_buffer.h"

#define AMBULO__MESHES_SCHEMA "ambulo-meshes/1"
#define AMBULO__MESHES_UNIT 1e-4 /* m */

typedef struct ambulo__tree ambulo__tree;

/* *path: of the meshes of a model file, to be freed; NULL: its name does not end in .yaml or .yml.
 * Errors: E_MEMORY. */
ambulo_status ambulo__meshes_path(const ambulo_allocator *allocator, const char *model,
                                  char **path);

/* The file of a tree's meshes; nothing is appended where there are none that can be read. */
ambulo_status ambulo__tree_meshes(ambulo__tree *tree, ambulo__text_buffer *text);

/* Triangles of one link. */
typedef struct ambulo__shell {
  double *points; /* [point_count][3], m */
  int *corners;   /* [count][3], numbers of points */
  int point_count, count;
} ambulo__shell;

/* A coarser one: points within the same cell, a cube whose edges are `cell` long, become one at
 * their mean; triangles without an area and those twice there go. Errors: E_MEMORY; *out, to be
 * freed, is then untouched. */
ambulo_status ambulo__shell_coarsen(const ambulo__shell *shell, double cell,
                                    const ambulo_allocator *allocator, ambulo__shell *out);
void ambulo__shell_free(const ambulo_allocator *allocator, ambulo__shell *shell);

#endif
