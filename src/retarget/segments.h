/* retarget/segments.h - which coordinates of a body turn which of its segments.
 *
 * A retargeted motion is that of twelve segments, which every walking body has more or less of.
 * Each is turned against the one before it by a group of coordinates, found by their names or named
 * by a table (docs/guide-retarget.md). The pelvis is what hangs on the world; its coordinates are
 * those on the way to the first link with a mass.
 *
 * Reading order: segments.h, figure.h, source.h, imitate.h, contacts.h, retargeting.h; retarget.c.
 */
#ifndef AMBULO_RETARGET_SEGMENTS_H
#define AMBULO_RETARGET_SEGMENTS_H

#include "base/diagnostics.h"
#include "base/text_buffer.h"
#include "formats/yaml_node.h"
#include "model/model.h"

/* A segment stands behind the one that it hangs on; right before left. */
typedef enum ambulo__segment {
  AMBULO__PELVIS,
  AMBULO__TORSO,
  AMBULO__THIGH,     /* of the right side; + 1: of the left */
  AMBULO__SHANK = 4, /* likewise */
  AMBULO__FOOT = 6,
  AMBULO__UPPER_ARM = 8,
  AMBULO__FOREARM = 10,
  AMBULO__SEGMENTS = 12
} ambulo__segment;

enum { AMBULO__SEGMENT_COORDINATES = 24 };

typedef struct ambulo__segment_map {
  int count[AMBULO__SEGMENTS];
  /* in the order of the tree; those of the pelvis: its turns */
  int coordinate[AMBULO__SEGMENTS][AMBULO__SEGMENT_COORDINATES];
  int slide[3], slides; /* of the pelvis */
} ambulo__segment_map;

/* The segment that this one hangs on; -1 for the pelvis. */
int ambulo__segment_above(int segment);
/* "thigh_r". */
const char *ambulo__segment_word(int segment);

/* The segment that the built-in table has for a name; -1: none. */
int ambulo__segment_of(const char *name);

/* By the built-in table, then by `table` (a mapping segment: list of names; NULL: none), whose
 * segments replace those of the built-in one. A name may be a pattern with * and ?. A name that is
 * no coordinate's is an error of the table's document. */
void ambulo__segments_find(const ambulo_model *model, const ambulo__yaml_node *table,
                           ambulo__segment_map *map);
/* E_MODEL without a turning pelvis, thighs and feet: `what` is the body, for the message. */
ambulo_status ambulo__segments_check(const ambulo_model *model, const ambulo__segment_map *map,
                                     const char *what, ambulo_diagnostics *diagnostics);
/* Appends the table, each segment a line. */
void ambulo__segments_print(const ambulo_model *model, const ambulo__segment_map *map,
                            ambulo__text_buffer *text);

#endif
