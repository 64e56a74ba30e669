/* model/mirror_image.h - is the body its own mirror image, left for right?
 *
 * The mirror plane contains up and forward and passes through the world's origin. The body is
 * symmetric when every motion q(t) of it, mirrored in space, is the motion q_m = s q_i of its
 * mirror coordinates, with the same torques times s. */
#ifndef AMBULO_MODEL_MIRROR_IMAGE_H
#define AMBULO_MODEL_MIRROR_IMAGE_H

#include "base/diagnostics.h"
#include "model/model.h"

/* What differences are reported as. `before` begins each message, `hint` may be NULL. */
typedef struct ambulo__mirror_words {
  ambulo_status status;
  const char *before, *hint;
} ambulo__mirror_words;

/* Relative tolerance of every comparison of two partners: masses, inertias, torques of their own
 * size, lengths of the size of the body (its furthest point from the origin at q = 0), directions
 * in rad. */
#define AMBULO__MIRROR_TOLERANCE 1e-6

/* Every difference is reported with the names of both and both numbers; of a chain of joints the
 * first place that differs. words->status if there is one; E_MEMORY. */
ambulo_status ambulo__mirror_image_check(const ambulo_model *model,
                                         const ambulo__mirror_words *words,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics);

#endif
