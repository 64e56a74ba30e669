/* batch/gather.h - every case of a batch folder with what is on disk about it. */
#ifndef AMBULO_BATCH_GATHER_H
#define AMBULO_BATCH_GATHER_H

#include "batch/listing.h"
#include "batch/outputs.h"

typedef struct ambulo__gathered {
  int index;
  const char *state;           /* of the record, or missing, stale, corrupt */
  int valid;                   /* it has a valid solution */
  const ambulo__output *value; /* [outputs]; NULL: none were asked for */
} ambulo__gathered;

/* Calls `take` for each case in order. outputs = 0: records alone are read. Stops at the first
 * failure of `take`. census (may be NULL) is counted. */
ambulo_status ambulo__gather(const char *directory, const ambulo__listing *listing, int outputs,
                             ambulo_status (*take)(void *user, const ambulo__gathered *gathered),
                             void *user, ambulo_batch_census *census);

#endif
