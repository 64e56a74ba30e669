/* study/batch_lock.h - one run, or one run per shard, in a folder at a time.
 *
 * POSIX record locks: the system releases them when the holder ends, however it ends, and they
 * work across the nodes of a cluster where the file system offers them. The file names the
 * holder as host:pid. A whole run holds DIR/lock exclusively; a shard holds it shared, and
 * DIR/lock.<shard>-of-<shards> exclusively. */
#ifndef AMBULO_STUDY_BATCH_LOCK_H
#define AMBULO_STUDY_BATCH_LOCK_H

#include "base/alloc.h"
#include "base/diagnostics.h"

enum { AMBULO__HOLDER_TEXT = 96 };

typedef struct ambulo__lock {
  int folder, shard; /* descriptors; -1: not held */
} ambulo__lock;

/* Errors: E_IO (cannot be written; held: the message names the holder), E_MEMORY. */
ambulo_status ambulo__lock_take(const char *directory, int shard, int shards,
                                const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                ambulo__lock *lock);
void ambulo__lock_release(ambulo__lock *lock);
/* Who holds DIR/lock, as far as another process can tell; "" if nobody does. Errors: E_IO,
 * E_MEMORY. */
ambulo_status ambulo__lock_holder(const char *directory, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics,
                                  char holder[AMBULO__HOLDER_TEXT]);

#endif
