/* study/listing_changes.h - a batch folder's list against a sweep; what it says of a front. */
#ifndef AMBULO_STUDY_LISTING_CHANGES_H
#define AMBULO_STUDY_LISTING_CHANGES_H

#include "base/text_buffer.h"
#include "study/batch_listing.h"
#include "formats/json_text.h"
#include "study/sweep.h"

/* What the folder says it was filled from, against this sweep: E_PROBLEM, with what changed, unless
 * force = 1. A damaged list is a warning. Errors else: E_IO, E_MEMORY. */
ambulo_status ambulo__listing_compare(const ambulo_sweep *sweep, const char *directory, int force,
                                      const ambulo_allocator *allocator,
                                      ambulo_diagnostics *diagnostics);

/* listing_front.c: "torque_power 1, force_rate 0.1; 12 points, least 0.01, from zero". E_MEMORY. */
ambulo_status ambulo__listing_front_text(const ambulo_sweep *sweep, ambulo__text_buffer *text);
/* The key `front` of batch.json. */
void ambulo__listing_describe_front(const ambulo_sweep *sweep, ambulo__json *json);

#endif
