/* cli/summary.h - a result in words, on stdout. */
#ifndef AMBULO_CLI_SUMMARY_H
#define AMBULO_CLI_SUMMARY_H

#include "ambulo/tools/tools.h"

/* Verdict, objective by term, audit by family, effort. */
void ambulo__cli_print_result(const ambulo_problem *problem, const ambulo_result *result);

/* What fails between the nodes and what helps, in one sentence; nothing where nothing fails. */
/* What finer grids would still bring, or that it is not known; nothing without a solution. */
void ambulo__cli_print_resolution(const ambulo_result *result);
void ambulo__cli_print_last(const ambulo_result *result);

/* What each number of the problem costs, one in a line, or why that is not known. */
void ambulo__cli_print_sensitivities(const ambulo_sensitivity_list *list);

/* Metabolic power of muscles, gross: two lines, one where the body does not move on. */
void ambulo__cli_print_metabolic(const ambulo_muscle_values *values);

/* The same of a result, with the muscles and samples of its report; nothing without muscles. */
ambulo_status ambulo__cli_print_muscles(const ambulo_problem *problem, const ambulo_result *result,
                                        const ambulo_report_options *report);

/* Every row: index, family, subject, detail, time, value, unit, multiplier. */
void ambulo__cli_print_rows(const ambulo_problem *problem, const ambulo_result *result);

#endif
