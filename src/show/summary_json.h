/* show/summary_json.h - summary.json (docs/results.md). */
#ifndef AMBULO_SHOW_SUMMARY_JSON_H
#define AMBULO_SHOW_SUMMARY_JSON_H

#include "ambulo/tools/report.h"
#include "base/text_buffer.h"

/* Appends the whole text; failures stick to the buffer. */
void ambulo__summary_json(const ambulo_problem *problem, const ambulo_result *result,
                          ambulo__text_buffer *text);

#endif
