/* study/gather.h - every case of a batch folder with what is on disk about it. */
#ifndef AMBULO_STUDY_GATHER_H
#define AMBULO_STUDY_GATHER_H

#include "study/batch_listing.h"
#include "study/case_record.h"
#include "study/outputs.h"

/* How much of a case is looked at. */
typedef enum ambulo__gather_depth {
  AMBULO__GATHER_RECORDS, /* its record alone */
  AMBULO__GATHER_FILES,   /* every file that the record names: whether it is what was written */
  AMBULO__GATHER_OUTPUTS  /* and the outputs that the sweep asks for */
} ambulo__gather_depth;

typedef struct ambulo__gathered {
  int index;
  const char *state;            /* of the record, or missing, stale, corrupt */
  int valid;                    /* it has a valid solution */
  const ambulo__output *value;  /* [outputs]: NONE where there are none */
  const ambulo__damage *damage; /* of a corrupt case, else NULL */
} ambulo__gathered;

/* Calls `take` for each case in order. Stops at the first failure of `take`, or where memory runs
 * out (E_MEMORY): no case is called missing or corrupt for want of it. census (may be NULL) is
 * counted. */
ambulo_status ambulo__gather(const char *directory, const ambulo__listing *listing,
                             ambulo__gather_depth depth,
                             ambulo_status (*take)(void *user, const ambulo__gathered *gathered),
                             void *user, ambulo_batch_census *census);

#endif
