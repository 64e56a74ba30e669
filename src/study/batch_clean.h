/* study/batch_clean.h - removing what killed workers left half-written.
 *
 * Results are filled under "<name>.tmp-<process>-<k>" and old ones step aside as
 * "<name>.old-<process>-<k>" (formats/atomic_file.h). */
#ifndef AMBULO_STUDY_BATCH_CLEAN_H
#define AMBULO_STUDY_BATCH_CLEAN_H

#include "base/alloc.h"

/* What worker `process` left of a case. */
void ambulo__clean_case(const char *directory, const char *id, long process,
                        const ambulo_allocator *allocator);
/* The result folder of a case without a valid record, damaged or of other inputs. E_MEMORY. */
ambulo_status ambulo__clean_result(const char *directory, const char *id,
                                   const ambulo_allocator *allocator);
/* All of it; only where no other run writes into the folder. */
void ambulo__clean_all(const char *directory, const ambulo_allocator *allocator);

#endif
