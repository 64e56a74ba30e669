/* import/osim.h - what the osim_*.c files share.
 *
 * Version 3 writes a body's joint into the body, version 4 lists joints apart, with frames that are
 * offset from bodies. Both become the same lists of bodies and joints here. */
#ifndef AMBULO_IMPORT_OSIM_H
#define AMBULO_IMPORT_OSIM_H

#include "import/body_tree.h"

typedef struct ambulo__osim_body {
  const char *name; /* body 0 is the ground */
  const ambulo__xml_node *node;
  int joint;   /* that it is the child of; -1: none */
  int link;    /* of the tree, once reached; -1 of the ground: the world */
  int reached; /* it is in the tree */
} ambulo__osim_body;

/* X_parent_child = in_parent X(q) in_child' */
typedef struct ambulo__osim_joint {
  const char *name;
  const ambulo__xml_node *node;
  int parent, child;
  ambulo__rigid in_parent, in_child;
} ambulo__osim_joint;

typedef struct ambulo__osim {
  ambulo__tree *tree;
  ambulo__xml *xml;
  const ambulo__xml_node *model;
  ambulo__osim_body *bodies;
  int body_count, body_capacity;
  ambulo__osim_joint *joints;
  int joint_count, joint_capacity;
} ambulo__osim;

/* ------------------------------------------------ bodies and frames (osim_bodies.c) */

/* Both lists; an error for what is no tree of bodies. */
void ambulo__osim_collect(ambulo__osim *o);
/* Mass and inertia of a body that is in the tree, added to its link's. */
void ambulo__osim_read_body(ambulo__osim *o, const ambulo__osim_body *body);
/* Body and placement of a frame that `text` names ("pelvis", "/bodyset/pelvis", "../hip_offset"),
 * looked for among the frames of `scope` first; the body, or -1 after an error at `node`. */
int ambulo__osim_frame(ambulo__osim *o, const ambulo__xml_node *scope, const ambulo__xml_node *node,
                       const char *text, ambulo__rigid *placement);
/* The text of the first of two children that is there; "" without. */
const char *ambulo__osim_text(const ambulo__xml_node *node, const char *name, const char *other);
/* The objects of a set ("BodySet"), one after the other: the first, and NULL without. */
ambulo__xml_node *ambulo__osim_objects(const ambulo__xml_node *node, const char *set);
/* true, false, or `otherwise` without */
int ambulo__osim_flag(const ambulo__xml_node *node, const char *name, int otherwise);

/* ------------------------------------------------- coordinates (osim_coordinates.c) */

/* A coordinate of a joint as the file has it. */
typedef struct ambulo__osim_coordinate {
  const char *name;
  const ambulo__xml_node *node;
  int held;           /* 1: it does not move: locked, prescribed, or follows one that does not */
  double value;       /* where it stands when something is frozen, rad or m */
  const char *leader; /* the coordinate that it is a function of; NULL: it is its own */
  ambulo__tree_function function;
} ambulo__osim_coordinate;
/* Fills list[0..most); how many the joint has. Says what is held. */
int ambulo__osim_coordinates(ambulo__osim *o, const ambulo__osim_joint *joint, int most,
                             ambulo__osim_coordinate *list);
/* Limits of the coordinate, times `scale`, for the link that got it. */
void ambulo__osim_limits(ambulo__osim *o, const ambulo__osim_coordinate *coordinate, double scale,
                         int link);
/* Actuators, muscles, constraints: what becomes torque limits, and what is left out. */
void ambulo__osim_forces(ambulo__osim *o);
/* Spheres that touch the ground. */
void ambulo__osim_contacts(ambulo__osim *o);
void ambulo__osim_markers(ambulo__osim *o); /* those on bodies */

/* ----------------------------------------------------- functions (osim_functions.c) */

/* A function of one coordinate: its element among the children of `holder`; NULL without. */
const ambulo__xml_node *ambulo__osim_function(const ambulo__xml_node *holder);
/* Value at x; 0 and an error at functions that are not known. */
double ambulo__osim_value(ambulo__osim *o, const ambulo__xml_node *function, double x);
/* How far scale times the function goes from `from` over the range of a <Coordinate> (NULL: at x).
 */
double ambulo__osim_travel(ambulo__osim *o, const ambulo__xml_node *function, double scale,
                           const ambulo__xml_node *coordinate, double x, double from);
/* The function as joints can have it; 0: it has corners, or is a polynomial of a degree above 4. */
int ambulo__osim_read_function(ambulo__osim *o, const ambulo__xml_node *function,
                               ambulo__tree_function *f);
/* 1 and slope x + offset, if the function is a straight line: constants, linear functions, splines
 * through points on a line. */
int ambulo__osim_is_linear(ambulo__osim *o, const ambulo__xml_node *function, double *slope,
                           double *offset);

#endif
