/* model/segments.h - the body at q = 0 as rigid segments, seen along forward, up and left.
 *
 * Segment 0 is what is fixed to the world, segment c + 1 what coordinate c carries: its link and
 * the fixed links that hang on it, as one body. All vectors and inertias are in the axes
 * (forward, up, left) about the world's origin; in them the mirror image of a vector has the third
 * component reversed. */
#ifndef AMBULO_MODEL_SEGMENTS_H
#define AMBULO_MODEL_SEGMENTS_H

#include "model/composite.h"
#include "model/model.h"

typedef struct ambulo__segment_frame {
  double axes[3][3]; /* column j: the frame's j-th axis */
  double origin[3];  /* m */
} ambulo__segment_frame;

typedef struct ambulo__segments {
  ambulo_allocator allocator;
  const ambulo_model *model;
  ambulo__segment_frame *frame; /* [links] */
  int *of_link;                 /* [links] */
  ambulo__part *body;           /* [coordinates + 1] */
  int *heaviest;                /* [coordinates + 1]: link with the largest part of it; that of the
                                   coordinate, or -1, where there is no mass */
} ambulo__segments;

/* E_MEMORY. Freed by ambulo__segments_free, which accepts a zero-filled one. */
ambulo_status ambulo__segments_create(const ambulo_model *model, const ambulo_allocator *allocator,
                                      ambulo__segments *segments);
void ambulo__segments_free(ambulo__segments *segments);

/* The segment that the joint of coordinate c hangs on. */
int ambulo__segment_parent(const ambulo__segments *segments, int coordinate);
/* The frame about whose z axis the joint of coordinate c turns, or along which it slides. */
ambulo__segment_frame ambulo__segment_joint(const ambulo__segments *segments, int coordinate);
/* Place of a point of the model, m. */
void ambulo__segment_point(const ambulo__segments *segments, int point, double place[3]);

#endif
