/* cli/summary.h - a result in words, on stdout. */
#ifndef AMBULO_CLI_SUMMARY_H
#define AMBULO_CLI_SUMMARY_H

#include "ambulo/ambulo.h"

/* Verdict, objective by term, audit by family, effort. */
void ambulo__cli_print_result(const ambulo_problem *problem, const ambulo_result *result);

/* What fails between the nodes and what helps, in one sentence; nothing where nothing fails. */
/* What finer grids would still bring, or that it is not known; nothing without a solution. */
void ambulo__cli_print_resolution(const ambulo_result *result);
void ambulo__cli_print_last(const ambulo_result *result);

/* What each number of the problem costs, one in a line, or why that is not known. */
void ambulo__cli_print_sensitivities(const ambulo_sensitivity_list *list);

/* Every row: index, family, subject, detail, time, value, unit, multiplier. */
void ambulo__cli_print_rows(const ambulo_problem *problem, const ambulo_result *result);

#endif
