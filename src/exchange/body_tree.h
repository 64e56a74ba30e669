/* exchange/body_tree.h - a body on its way from another format to a model file.
 *
 * Links as in a model file: each hangs on its parent by a placement at q = 0 and one joint, which
 * turns about or slides along an axis of the link's own frame. Readers of formats fill the tree in,
 * through chains for joints of several coordinates; points of feet and mirror images are found on
 * it; a writer prints it. SI units and radians. All texts and lists are the arena's.
 *
 * What could not be carried over is a note: it is told to the caller and stands in the file. */
#ifndef AMBULO_EXCHANGE_BODY_TREE_H
#define AMBULO_EXCHANGE_BODY_TREE_H

#include "ambulo/tools/import.h"
#include "base/numtext.h"
#include "exchange/arena.h"
#include "exchange/mesh.h"
#include "exchange/rigid.h"
#include "exchange/xml_tree.h"
#include "model/composite.h"

typedef struct ambulo__tree_link {
  const char *name;
  int parent; /* -1: the world */
  ambulo_joint_type type;
  ambulo__rigid origin;
  double axis[3];               /* unit, link's frame */
  ambulo_coordinate coordinate; /* names and limits; `mirror` is a link of the tree, -1: none */
  int has_mirror;
  ambulo__part body;   /* mass 0: none */
  const char *comment; /* one line, NULL: none */
  const ambulo__xml_node *node;
} ambulo__tree_link;

typedef enum ambulo__shape {
  AMBULO__SPHERE,    /* size: radius */
  AMBULO__CAPSULE,   /* radius, half of the cylinder's length along z */
  AMBULO__CYLINDER,  /* radius, half of the length along z */
  AMBULO__ELLIPSOID, /* half axes */
  AMBULO__BOX,       /* half edges */
  AMBULO__MESH       /* of a file */
} ambulo__shape;

/* What touches other things. */
typedef struct ambulo__tree_solid {
  int link;
  ambulo__shape shape;
  ambulo__rigid at; /* in the link's frame */
  double size[3];
  ambulo__mesh *mesh; /* of a mesh; NULL: no file is named */
} ambulo__tree_solid;

typedef struct ambulo__tree_point {
  const char *name;
  int link;
  double position[3];
} ambulo__tree_point;

/* Corners are points of the tree; the second -1 in a planar foot. */
typedef struct ambulo__tree_foot {
  const char *name;
  int heel[2], toe[2], heel_center, toe_center;
} ambulo__tree_foot;

typedef struct ambulo__tree {
  ambulo__arena *arena;
  ambulo__xml *xml;
  const ambulo_import_options *options;
  const char *name, *format;
  const char *path; /* of the file */
  double gravity[3], forward[3];
  char up; /* axis of the format that is: 'y', 'z' */
  ambulo__tree_link *links;
  int link_count, link_capacity;
  ambulo__tree_solid *solids;
  int solid_count, solid_capacity;
  ambulo__tree_point *points;
  int point_count, point_capacity;
  ambulo__tree_foot *feet;
  int foot_count, foot_capacity;
  const char **notes;
  int note_count, note_capacity;
  int root_free; /* the importer put the whole body on six coordinates of its own */
} ambulo__tree;

/* "what was done": kept for the file, and a warning to the caller. */
void ambulo__tree_note(ambulo__tree *tree, const ambulo__xml_node *node, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Appends a link without body; its index, or -1 (out of memory, or more links than a model may
 * have, which is an error). Names are made such that a model file takes them. */
int ambulo__tree_add(ambulo__tree *tree, const char *name, int parent, ambulo_joint_type type,
                     const ambulo__rigid *origin, const double axis[3],
                     const ambulo__xml_node *node);
/* Checks mass and inertia, which stand at these nodes, and adds the body to a link's. */
void ambulo__tree_body(ambulo__tree *tree, int link, const ambulo__part *part,
                       const ambulo__xml_node *mass, const ambulo__xml_node *inertia);
/* x >= 0 to three digits, for what is told. */
ambulo__number ambulo__three_digits(double x);
void ambulo__tree_add_solid(ambulo__tree *tree, const ambulo__tree_solid *solid);
int ambulo__tree_add_point(ambulo__tree *tree, const char *name, int link, const double at[3]);
/* Once gravity is known and before there are links: where there is none there is some, and it is
 * not along forward. */
void ambulo__tree_gravity(ambulo__tree *tree);
/* Numbers that no model may have, each an error where the link stands in the source; limits that
 * are as good as none go. */
void ambulo__tree_check(ambulo__tree *tree);
/* Index of a link by name, -1: none. */
int ambulo__tree_find(const ambulo__tree *tree, const char *name);
/* Index of the link that has a coordinate, by the coordinate's name; -1: none. */
int ambulo__tree_find_coordinate(const ambulo__tree *tree, const char *name);
/* Placement of a link in the world at q = 0; and in the start pose. */
ambulo__rigid ambulo__tree_place(const ambulo__tree *tree, int link);
ambulo__rigid ambulo__tree_start_place(const ambulo__tree *tree, int link);
/* The value that an option or the source gives to a coordinate that is held: `fallback` without. */
double ambulo__tree_pose(const ambulo__tree *tree, const char *coordinate, double fallback);

/* A chain of joints between a parent and a body: every joint becomes a link of its own, placements
 * in between are put together. */
typedef struct ambulo__chain {
  ambulo__tree *tree;
  const ambulo__xml_node *node;
  int parent, own;       /* last link of the chain; how many are its own */
  ambulo__rigid pending; /* after that link */
} ambulo__chain;

ambulo__chain ambulo__chain_begin(ambulo__tree *tree, int parent, const ambulo__xml_node *node);
void ambulo__chain_place(ambulo__chain *chain, const ambulo__rigid *placement);
/* A joint with a coordinate; the link that has it, or -1. */
int ambulo__chain_joint(ambulo__chain *chain, ambulo_joint_type type, const double axis[3],
                        const char *coordinate);
/* The body's link: the last joint's, or a fixed one. Returns its index, or -1. */
int ambulo__chain_end(ambulo__chain *chain, const char *name);

/* Three sliders along the world's axes and three hinges: about left, forward and up, in this order
 * as of the shipped bodies, named PREFIX_tx, _ty, _tz, _tilt, _list, _rotation. */
void ambulo__chain_free(ambulo__chain *chain, const char *prefix);
/* Three hinges through one point about x, y and z of what was before: NAME_x, NAME_y, NAME_z. */
void ambulo__chain_ball(ambulo__chain *chain, const char *name, int *first);

#endif
