/* people/compare_cycles.h - the curves over the cycle as a table, in the layout of references with
 * a column a curve (AMBULO__LAYOUT_WIDE): percent 0 to 100, then NAME and, of more than one stride,
 * "NAME sd". Names are those of the curves; hip flexion and pelvic tilt stand as they are compared,
 * in a marker frame of the pelvis. */
#ifndef AMBULO_PEOPLE_COMPARE_CYCLES_H
#define AMBULO_PEOPLE_COMPARE_CYCLES_H

#include "people/compare_curve.h"
#include "ambulo/tools/compare.h"

/* Before any work: whether the file of the options may be written. E_IO. */
ambulo_status ambulo__cycles_check(const char *motion, const char *people,
                                   const ambulo_compare_options *options,
                                   ambulo_diagnostics *diagnostics);
/* Writes it, whole or not at all. Errors: E_IO, E_MEMORY, and of ambulo__sample_curve. */
ambulo_status ambulo__cycles_write(ambulo__sampler *sampler);

#endif
