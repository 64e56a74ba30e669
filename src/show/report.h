/* show/report.h - solution.yaml: the unknowns with the basis they belong to. */
#ifndef AMBULO_SHOW_REPORT_H
#define AMBULO_SHOW_REPORT_H

#include "ambulo/tools/report.h"
#include "base/text_buffer.h"

/* Appends the whole text; ambulo_solution_load() reads it back to the same bits. */
void ambulo__solution_yaml(const ambulo_problem *problem, const ambulo_result *result,
                           ambulo__text_buffer *text);

#endif
