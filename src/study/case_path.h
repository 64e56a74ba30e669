/* study/case_path.h - where the files of a case are. */
#ifndef AMBULO_STUDY_CASE_PATH_H
#define AMBULO_STUDY_CASE_PATH_H

#include "base/alloc.h"

/* DIR/cases/<last two digits of the id>/<id><ending>: at most 256 neighbours of a million cases
 * share a folder's fan-out, and a listing stays short. */
char *ambulo__case_path(const ambulo_allocator *allocator, const char *directory, const char *id,
                        const char *ending);

#endif
