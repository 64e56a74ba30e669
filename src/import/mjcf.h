/* import/mjcf.h - what the mjcf_*.c files share: the settings of a MuJoCo model. */
#ifndef AMBULO_IMPORT_MJCF_H
#define AMBULO_IMPORT_MJCF_H

#include "import/body_tree.h"

typedef enum ambulo__mjcf_inertia {
  AMBULO__FROM_INERTIAL, /* inertiafromgeom="false" */
  AMBULO__FROM_GEOMS,    /* "true" */
  AMBULO__FROM_EITHER    /* "auto": of geoms where there is no <inertial> */
} ambulo__mjcf_inertia;

typedef struct ambulo__mjcf {
  ambulo__tree *tree;
  ambulo__xml *xml;
  const ambulo__xml_node *root;
  /* <compiler> */
  double angle; /* rad of the file's unit */
  char sequence[4];
  int automatic_limits, groups[2];
  ambulo__mjcf_inertia inertia;
  double least_mass, least_inertia, total_mass;
  const char *mesh_folder;          /* NULL: that of the model */
  struct ambulo__mjcf_names *names; /* mjcf_index.c */
  /* what is left out, counted */
  int springs, bent, driven_balls, driven_roots;
  int unnamed;
  double *key; /* qpos of the start pose [key_count]; NULL: none */
  int key_count, key_used;
} ambulo__mjcf;

/* ------------------------------------------ what has a name (mjcf_index.c) */

/* Once the included files are in. NULL in m->names: no memory. */
void ambulo__mjcf_index(ambulo__mjcf *m);
/* What a default class, NULL: the top one, and the classes around it say; NULL: nothing. */
const char *ambulo__mjcf_default(const ambulo__mjcf *m, const char *name, const char *tag,
                                 const char *attribute);
/* <asset><mesh> of that name, which is by default that of its file; NULL: none. */
const ambulo__xml_node *ambulo__mjcf_mesh(const ambulo__mjcf *m, const char *name);
/* Whether an actuator names the joint. */
int ambulo__mjcf_is_driven(const ambulo__mjcf *m, const char *joint);

/* ------------------------------------------------ attributes (mjcf_geoms.c) */

/* An attribute of an element: its own, else that of its default class, `around` for an element
 * that names none (NULL: the top one), and of the classes around that. NULL without. */
const char *ambulo__mjcf_text(const ambulo__mjcf *m, const ambulo__xml_node *node,
                              const char *around, const char *attribute);
/* Numbers of it, `least` to `most`; how many, 0 without it or after an error. */
int ambulo__mjcf_numbers(const ambulo__mjcf *m, const ambulo__xml_node *node, const char *around,
                         const char *attribute, int least, int most, double *values);
/* true, false or (-1) auto; `otherwise` without */
int ambulo__mjcf_flag(const ambulo__mjcf *m, const ambulo__xml_node *node, const char *around,
                      const char *attribute, int otherwise);
/* pos, and quat, axisangle, euler, xyaxes or zaxis */
ambulo__rigid ambulo__mjcf_place(const ambulo__mjcf *m, const ambulo__xml_node *node,
                                 const char *around);

/* --------------------------------------------------------- bodies (mjcf_bodies.c) */

void ambulo__mjcf_bodies(ambulo__mjcf *m);

/* ----------------------------------------------------------- geoms (mjcf_geoms.c) */

/* Adds mass and inertia of a geom, in the frame of its body, if `massive`, and its solid. */
void ambulo__mjcf_geom(ambulo__mjcf *m, const ambulo__xml_node *geom, const char *around,
                       const ambulo__rigid *frame, int massive, ambulo__part *body,
                       ambulo__tree_solid *solid, int *has_solid);

#endif
