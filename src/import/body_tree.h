/* import/body_tree.h - a body on its way from another format to a model file.
 *
 * Links as in a model file: each hangs on its parent by a placement at q = 0 and one joint, which
 * turns about or slides along an axis of the link's own frame. Readers of formats fill the tree in,
 * through chains for joints of several coordinates; points of feet and mirror images are found on
 * it; a writer prints it. SI units and radians. All texts and lists are the arena's.
 *
 * What could not be carried over is a note: it is reported to the caller and stands in the file. */
#ifndef AMBULO_IMPORT_BODY_TREE_H
#define AMBULO_IMPORT_BODY_TREE_H

#include "ambulo/tools/import.h"
#include "base/numtext.h"
#include "base/text_buffer.h"
#include "import/rigid.h"
#include "import/xml.h"
#include "model/coupling.h"
#include "model/model_check.h"

#include <stddef.h>

/* What a geometry says of its mesh, STL (both kinds), OBJ or COLLADA; read when it is asked for (a
 * robot has many, and feet few). */
typedef struct ambulo__mesh {
  const char *file; /* as the model names it: a path, package://PACKAGE/PATH, model:// or file:// */
  int tried;
  double *points; /* [count][3]; NULL: not read, or nothing to read */
  int count;
  int whole;    /* 1: triangles are asked for */
  int *corners; /* [triangle_count][3], numbers of points; NULL: not known */
  int triangle_count;
} ambulo__mesh;

/* A function of a coordinate: the spline through points, or without any the polynomial. */
typedef struct ambulo__tree_function {
  int count;
  const double *points; /* [count][2] */
  double polynomial[AMBULO__COUPLING_TERMS];
} ambulo__tree_function;

typedef struct ambulo__tree_link {
  const char *name;
  int parent; /* -1: the world */
  ambulo_joint_type type;
  ambulo__rigid origin;
  double axis[3];               /* unit, link's frame */
  ambulo_coordinate coordinate; /* names and limits; `mirror` is a link of the tree, -1: none */
  int has_mirror;
  /* A joint that is a function of the coordinate of another: its own has no name. `was`: the name
   * that it has in the source; NULL: none. */
  const char *follows, *was;
  ambulo__tree_function function;
  double reference;  /* of a joint of MuJoCo: where functions count its coordinate from, rad or m */
  double stiffness;  /* of a spring in the joint, N m/rad or N/m; 0: none */
  int driven;        /* 1: a motor drives it; known where loops are closed */
  ambulo__part body; /* mass 0: none */
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
  int seen;           /* it touches nothing: only seen, counts where nothing else does */
  int hidden;         /* the format's own program does not show it */
  ambulo__mesh *mesh; /* of a mesh, shared by all that name the file; NULL: no file is named */
  double scale[3];    /* of the mesh's points */
} ambulo__tree_solid;

typedef struct ambulo__tree_point {
  const char *name;
  int link;
  double position[3];
} ambulo__tree_point;

/* Corners are points of the tree; the second -1 in a planar foot. */
typedef struct ambulo__tree_foot {
  const char *name;
  int link; /* that it is, with all that is fixed to it */
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
  ambulo__mesh **meshes;
  int mesh_count, mesh_capacity;
  size_t mesh_points; /* of those that were read */
  ambulo__tree_point *points;
  int point_count, point_capacity;
  ambulo__tree_point *markers; /* of motion capture: they only tell of feet */
  int marker_count, marker_capacity;
  ambulo__tree_foot *feet;
  int foot_count, foot_capacity;
  const char **notes;
  int note_count, note_capacity;
  int repair_inertia; /* the format's own program takes impossible inertias: they are raised */
  int trunk;          /* of ambulo__tree_trunk, once the links are read; -1: none */
  int root_free;      /* the importer put the whole body on six coordinates of its own */
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
/* x >= 0 to three digits, for notes. */
ambulo__number ambulo__three_digits(double x);
void ambulo__tree_add_solid(ambulo__tree *tree, const ambulo__tree_solid *solid);
void ambulo__tree_add_marker(ambulo__tree *tree, const char *name, int link, const double at[3]);
int ambulo__tree_add_point(ambulo__tree *tree, const char *name, int link, const double at[3]);
/* Once gravity is known and before there are links: where there is none there is some, and it is
 * not along forward. */
void ambulo__tree_gravity(ambulo__tree *tree);
/* Numbers that no model may have, each an error where the link stands in the source; limits that
 * are as good as none go. */
void ambulo__tree_check(ambulo__tree *tree);
/* Limits of a link's coordinate, `scale` times those of the file; an error at the node where they
 * contradict each other. */
void ambulo__tree_range(ambulo__tree *tree, int link, const double range[2], double scale,
                        const ambulo__xml_node *node);
/* Makes the axis of a joint a unit vector; 0 after an error at the node: it has no direction. */
int ambulo__tree_axis(ambulo__tree *tree, double axis[3], const char *joint,
                      const ambulo__xml_node *node);
/* Index of a link by name, -1: none. */
int ambulo__tree_find(const ambulo__tree *tree, const char *name);
/* Index of the link that has a coordinate, by the coordinate's name; -1: none. */
int ambulo__tree_find_coordinate(const ambulo__tree *tree, const char *name);
/* Placement of a link in the world at q = 0, and with all coordinates at their defaults. */
ambulo__rigid ambulo__tree_place(const ambulo__tree *tree, int link);
ambulo__rigid ambulo__tree_start_place(const ambulo__tree *tree, int link);
/* With the joint of each link at its value [link_count], rad or m; those of fixed links are not
 * read. */
ambulo__rigid ambulo__tree_place_at(const ambulo__tree *tree, int link, const double *values);
/* Unit vectors along forward, left and up. */
void ambulo__tree_axes(const ambulo__tree *tree, double axes[3][3]);
/* The value that an option or the source gives to a coordinate that is held: `fallback` without. */
double ambulo__tree_pose(const ambulo__tree *tree, const char *coordinate, double fallback);

/* ---------------------------- joints that follow others (tree_functions.c) */

ambulo__tree_function ambulo__tree_line(double slope, double offset);
int ambulo__function_is_line(const ambulo__tree_function *function);
double ambulo__function_value(const ambulo__tree *tree, const ambulo__tree_function *function,
                              double x);
/* *out = g(f(x)); 0 where that is no spline and no polynomial of degree 4, or without memory. */
int ambulo__function_of_function(ambulo__tree *tree, const ambulo__tree_function *g,
                                 const ambulo__tree_function *f, ambulo__tree_function *out);
/* The joint of a link becomes a function of a coordinate, named as in the source. */
void ambulo__tree_couple(ambulo__tree *tree, int link, const char *to,
                         const ambulo__tree_function *function);
/* Where the joint of a link stands at q = 0, or (start = 1) with all coordinates at their defaults.
 */
double ambulo__tree_stands(const ambulo__tree *tree, int link, int start);
/* A point of one link stays on a point of another. Points are in the links' frames, m. */
typedef struct ambulo__closure {
  int link[2];
  double point[2][3];
  const ambulo__xml_node *node;
} ambulo__closure;
/* Joints of closed loops with one motor become functions of its coordinate; notes of the others
 * (loops.c). */
void ambulo__close_loops(ambulo__tree *tree, const ambulo__closure *closures, int count);
/* Once all links are there: joints that follow one that follows another follow that one; what
 * cannot follow is held. */
void ambulo__tree_resolve(ambulo__tree *tree);

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

/* ---------------------------------------------- links that move (tree_links.c) */

/* The link that a link is fixed to, itself where it moves or is the first. */
int ambulo__tree_leader(const ambulo__tree *tree, int link);
/* Whether no joint hangs on a link or on what is fixed to it. */
int ambulo__tree_is_end(const ambulo__tree *tree, int link);
/* Whether a link is another, or hangs on it. */
int ambulo__tree_hangs_on(const ambulo__tree *tree, int link, int above);
/* Of the body that weighs most the first link that has a mass, or on which several joints hang:
 * before it are the coordinates of the whole body. -1: none */
int ambulo__tree_trunk(const ambulo__tree *tree);
/* Placement of a link in the world at q = 0, with `start` 1 in the start pose: defaults of all but
 * the coordinates of the whole body. */
ambulo__rigid ambulo__tree_pose_of(const ambulo__tree *tree, int link, int start);
/* Mass, centre of mass and inertia of a link and all that is fixed to it, in its frame. */
void ambulo__tree_whole(const ambulo__tree *tree, int leader, ambulo__part *body);

/* ------------ meshes, and solids of feet (foot_meshes.c, foot_collada.c, foot_solids.c) */

/* The mesh of a solid, at its own size. None without memory, or where `file` is NULL or empty. */
void ambulo__tree_mesh(ambulo__tree *tree, const char *file, ambulo__tree_solid *solid);
/* Reads the points of a mesh, once; it has none where that cannot be. */
void ambulo__mesh_read(ambulo__tree *tree, ambulo__mesh *mesh);

/* The vertices and triangles of a COLLADA file, in the arena; the mesh is untouched where there are
 * none, or more than `most`. Returns how many vertices it has. */
size_t ambulo__collada_read(ambulo__arena *arena, const char *path, size_t most,
                            ambulo__mesh *mesh);

/* Where the solids of a link touch the ground. */
typedef struct ambulo__sole {
  double along[2], across[2], height; /* m, along forward, left and up of the world */
  int meshes;                         /* it has some */
  int start, is_point;                /* measured in the start pose, not at q = 0; has no length */
} ambulo__sole;

/* The sole of a link and all that is fixed to it; axes: forward, left, up. What touches counts
 * before what is only seen, solids before meshes. 0, with `meshes`, if there is nothing to read. */
int ambulo__sole_of(ambulo__tree *tree, int link, const double axes[3][3], ambulo__sole *sole);
/* The sole of a foot without solids, from markers and toes (foot_markers.c), and a note that says
 * so. 0: nothing tells of it. */
int ambulo__sole_of_markers(ambulo__tree *tree, int link, const char *foot, const double axes[3][3],
                            ambulo__sole *sole);
/* Height of the lowest point of that in the start pose, toes on a joint of their own left out. */
int ambulo__height_of(ambulo__tree *tree, int leader, const double axes[3][3], double *height);
/* The lower side of a box that has its mass and inertia; 0 where that is longer than `longest`. */
int ambulo__sole_of_inertia(const ambulo__tree *tree, int link, const double axes[3][3],
                            double longest, ambulo__sole *sole);

/* ------------------------------------------------ legs, and where they go (legs.c) */

/* A limb that may be a leg: the foot at its end. */
typedef struct ambulo__leg {
  const char *name; /* of the foot */
  int link;
} ambulo__leg;

/* The links that are feet; how many, 0: none. *legless: the body's lowest link is no limb's. */
int ambulo__find_legs(ambulo__tree *tree, const double axes[3][3], ambulo__leg *legs, int most,
                      int *legless);
/* Forward by what names say of left and right, else by the feet: 1 if that changed tree->forward.
 */
int ambulo__find_forward(ambulo__tree *tree);
/* Warns of feet that are not the lowest link of their side. */
void ambulo__check_feet(ambulo__tree *tree, const double axes[3][3]);

/* ------------------------------------ left and right in names (mirror_pairs.c) */

/* 'l', 'r', or 0 where a name says neither: hip_l, LeftFoot, l_knee, L_ANKLE, RHipPitch. */
char ambulo__side_of(const char *name);
/* The name with the side that it says exchanged, all of them, into text[0..size); 0 where it says
 * none, or does not fit. */
int ambulo__other_side(const char *name, char *text, size_t size);
/* The name with the letter l or r at one place exchanged; 0 where there is another. */
int ambulo__flip_letter(const char *name, size_t at, char *text, size_t size);

/* The link whose coordinate has the other side's name, and moves alike; itself where there is none.
 */
int ambulo__partner_coordinate(const ambulo__tree *tree, int link);
/* The link whose name is the other side's; -1: none. */
int ambulo__partner_link(const ambulo__tree *tree, int link);
/* 'l', 'r' or 0: what the name of a link says; of lfoot only if there is an rfoot. */
char ambulo__side_of_link(const ambulo__tree *tree, int link);
/* The foot that takes the place of another in the mirror image, by name; -1: none. */
int ambulo__tree_mirror_foot(const ambulo__tree *tree, int foot);

/* -------------------------------------------------------------- steps of an import */

/* One reader for each format: from the root element to a tree. Faults are recorded in tree->xml,
 * and reading goes on where it can. */
void ambulo__read_urdf(ambulo__tree *tree, const ambulo__xml_node *root);
void ambulo__read_osim(ambulo__tree *tree, const ambulo__xml_node *root);
/* `path`: of the file, in whose folder included ones are looked for. */
void ambulo__read_mjcf(ambulo__tree *tree, ambulo__xml_node *root, const char *path);

/* Heels and toes by options and from solids (feet.c). */
void ambulo__find_feet(ambulo__tree *tree);
/* Defaults within their ranges, the feet on the ground (start_pose.c). */
void ambulo__find_start(ambulo__tree *tree);
/* trunk_points.c: `lumbar` and `head_top`, of a model of a person. */
void ambulo__find_trunk_points(ambulo__tree *tree);
/* Partners of coordinates, left for right (mirror_pairs.c). */
void ambulo__find_mirrors(ambulo__tree *tree);
/* Moves a planar body into the world's mirror plane, with a note (lateral_shift.c). */
void ambulo__tree_center(ambulo__tree *tree);
/* Left and right made exact images of each other; an error where they differ by too much
 * (symmetrize.c). */
void ambulo__symmetrize(ambulo__tree *tree);
/* The model file as text (tree_yaml.c). `source`: name of the file it came from. */
void ambulo__tree_print(const ambulo__tree *tree, const char *source, ambulo__text_buffer *text);

#endif
