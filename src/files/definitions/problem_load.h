/* definitions/problem_load.h - several loads of one problem, which have to read the same bytes. */
#ifndef AMBULO_DEFINITIONS_PROBLEM_LOAD_H
#define AMBULO_DEFINITIONS_PROBLEM_LOAD_H

#include "ambulo/tools/load.h"
#include "formats/inputs.h"

/* ambulo_problem_load; every file that is read is one of `known`, or becomes one
 * (formats/inputs.h). Errors: also E_IO (other bytes than those known). */
ambulo_status ambulo__problem_load_known(const char *path, const char *const *overrides,
                                         int override_count, ambulo__text_buffer *known,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics, ambulo_problem **problem);

#endif
