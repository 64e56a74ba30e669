/* definitions/model_reader.h - a model file on its way to a definition (docs/model-format.md).
 *
 * The parts of the file are read in this order: subject and units, links, coordinates' mirror
 * images, points, feet, patches, capsules. Faults are recorded and reading goes on. Names in the
 * definition belong to the YAML document. */
#ifndef AMBULO_DEFINITIONS_MODEL_READER_H
#define AMBULO_DEFINITIONS_MODEL_READER_H

#include "formats/arena.h"
#include "formats/inputs.h"
#include "formats/yaml_node.h"
#include "ambulo/tools/load.h"
#include "model/model_check.h"

typedef struct ambulo__origin ambulo__origin; /* of a link (model_placement.c) */

/* What the file lists, under names that it refers to. */
typedef enum ambulo__model_list {
  AMBULO__LIST_LINKS,
  AMBULO__LIST_COORDINATES, /* of the links, as many at most */
  AMBULO__LIST_POINTS,
  AMBULO__LIST_FEET,
  AMBULO__LIST_PATCHES,
  AMBULO__LIST_CAPSULES,
  AMBULO__MODEL_LISTS
} ambulo__model_list;

typedef struct ambulo__reader {
  ambulo_allocator allocator;
  ambulo_diagnostics *diagnostics;
  ambulo__yaml *document;
  ambulo_status status; /* first fault that the document does not know of */
  ambulo__arena arena;  /* points of splines */

  ambulo_subject subject; /* the caller's, completed by the file's */
  /* factors from the units of the file to SI */
  double angle, dh_angle, length, mass, moment, force;
  int warned_of_degrees;

  ambulo_model_definition definition;
  ambulo_link *links;             /* [link_count] */
  ambulo_coordinate *coordinates; /* [link_count], coordinate_count in use */
  ambulo_point *points;           /* [point_count] */
  ambulo_foot *feet;              /* [foot_count] */
  ambulo_patch *patches;          /* [patch_count] */
  ambulo_capsule *capsules;       /* [capsule_count] */
  ambulo__model_places places;
  const char **names[AMBULO__MODEL_LISTS]; /* of the items, and where they stand */
  ambulo__place *place_of[AMBULO__MODEL_LISTS];
  ambulo__origin *origins; /* [links of the file + 1] */
  /* what links with an origin became, NULL where there is none: DH rows, of more links than the
   * file has */
  ambulo_link *rows;
  ambulo__place *row_places;
  char *row_names;
} ambulo__reader;

/* ambulo_model_load_with, and takes the file in (formats/inputs.h). */
ambulo_status ambulo__model_load_input(ambulo__inputs *inputs, const char *path,
                                       const char *const *overrides, int override_count,
                                       const ambulo_subject *subject,
                                       const ambulo_allocator *allocator,
                                       ambulo_diagnostics *diagnostics, ambulo_model **model);

/* ambulo_muscles_load, and takes the file in. `section`, `muscles` of a problem file or NULL, has
 * factors of force by groups and muscles, `strength`, and numbers by muscles. */
ambulo_status ambulo__muscles_load_input(ambulo__inputs *inputs, const char *path,
                                         const ambulo__yaml_node *section,
                                         const ambulo_model *model,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics, ambulo_muscles **muscles);

/* Items of an optional sequence, at most `limit`: *count and 1, or 0 after E_LIMIT or E_SCHEMA. */
int ambulo__read_count(const ambulo__yaml_node *list, const char *what, int limit, int *count);

/* The required name of item `index` of a list, noted with its place. */
const char *ambulo__read_item_name(ambulo__reader *reader, const ambulo__yaml_node *item,
                                   ambulo__model_list list, int index);

/* ------------------------------------------------------- numbers (model_numbers.c) */

/* The node meant for the subject's sex: a mapping {male: x, female: y} stands for one of
 * them, any other node for itself. */
const ambulo__yaml_node *ambulo__by_sex(ambulo__reader *reader, const ambulo__yaml_node *node);
double ambulo__read_scaled(ambulo__reader *reader, const ambulo__yaml_node *node, double factor,
                           double fallback);
/* Exactly `count` numbers times factor; 1 on success; values are untouched otherwise. */
int ambulo__read_vector(ambulo__reader *reader, const ambulo__yaml_node *node, int count,
                        double factor, double *values);
/* An angle in radians; warns once when the file says radians and means degrees. */
double ambulo__read_angle(ambulo__reader *reader, const ambulo__yaml_node *node, double unit);
/* [lower, upper], either of them `none`: without limit. NULL leaves the interval as it is. */
void ambulo__read_interval(ambulo__reader *reader, const ambulo__yaml_node *node, double factor,
                           int is_angle, double interval[2]);

/* Index of the name at `node` in a list, or -1 with E_MODEL and the nearest one. NULL gives -1
 * silently. */
int ambulo__read_reference(const ambulo__reader *reader, const ambulo__yaml_node *node,
                           ambulo__model_list list);

/* ------------------------------------------------------------------------- sections */

/* What a section `subject` says (NULL: nothing). */
ambulo_subject ambulo__subject_of(const ambulo__yaml_node *section);
/* Completes the caller's subject by the file's. */
void ambulo__read_subject(ambulo__reader *reader, const ambulo__yaml_node *root);
/* `asked`: the caller's subject, NULL for none; told when the file does not scale. */
void ambulo__read_units(ambulo__reader *reader, const ambulo__yaml_node *root,
                        const ambulo_subject *asked);
void ambulo__read_links(ambulo__reader *reader, const ambulo__yaml_node *list);
/* `coupled` of a link, once all coordinates are known. */
void ambulo__read_coupling(ambulo__reader *reader, const ambulo__yaml_node *node,
                           ambulo_link *link);
/* `origin` and `axis` of a link; 0 if it has neither. */
int ambulo__read_origin(ambulo__reader *reader, const ambulo__yaml_node *item, int index);
ambulo__origin *ambulo__origins_create(const ambulo_allocator *allocator, int links);
/* After all sections: links with an origin become DH rows, and references to links follow. */
void ambulo__expand_origins(ambulo__reader *reader);
/* Tells the model which link of the file describes a coordinate. */
void ambulo__name_written(const ambulo__reader *reader, ambulo_model *model);
void ambulo__read_body(ambulo__reader *reader, const ambulo__yaml_node *link_node,
                       ambulo_link *link);
void ambulo__read_points(ambulo__reader *reader, const ambulo__yaml_node *list);
void ambulo__read_feet(ambulo__reader *reader, const ambulo__yaml_node *list);
void ambulo__read_patches(ambulo__reader *reader, const ambulo__yaml_node *list);
void ambulo__read_capsules(ambulo__reader *reader, const ambulo__yaml_node *list);

#endif
