/* show/summary_json.h - summary.json (docs/results.md) and its parts.*/
#ifndef AMBULO_SHOW_SUMMARY_JSON_H
#define AMBULO_SHOW_SUMMARY_JSON_H

#include "ambulo/sensitivity.h"
#include "ambulo/solve.h"
#include "ambulo/tools/report.h"
#include "base/text_buffer.h"
#include "formats/json_text.h"
#include "people/muscle_analysis.h"
#include "problem/nlp.h"

/* 16 digits of the SHA-256 of the engine's sources, which the build writes: two builds of one
 * version may be of two engines. */
extern const char ambulo__engine_digest[];
/* "versions" */
void ambulo__versions_json(ambulo__json *json);

/* "approaches"; nothing of a problem without. E_MEMORY. */
ambulo_status ambulo__approach_json(ambulo__json *json, const ambulo_problem *problem,
                                    const ambulo_result *result);

/* what devices do over the motion as it is shown. */

/* "devices": {name: {unit, peak, positive, negative}}; nothing without devices. E_MEMORY. */
ambulo_status ambulo__devices_json(ambulo__json *json, const ambulo_problem *problem,
                                   const ambulo_result *result);

/* "work" and "center_of_mass" of summary.json. */

/* The members; without ground reaction no work, whose torques are not those of joints. With
 * muscles, whose power is known, metabolic cost is not estimated. Errors: E_MEMORY. */
ambulo_status ambulo__economy_json(ambulo__json *json, const ambulo_problem *problem,
                                   const ambulo_result *result, int with_muscles);

/* the way of the solve in summary.json. */

/* "convergence": a list for each column, as tables of data want them; nothing where no solver
 * ran. */
void ambulo__history_json(ambulo__json *json, const ambulo_result *result);

/* "starts": the valleys that several starts ended in; nothing where there was one. */
void ambulo__starts_json(ambulo__json *json, const ambulo_result *result);

/* "resolution": the grids that were solved, and what finer ones would still bring. */
void ambulo__resolution_json(ambulo__json *json, const ambulo_result *result);

/* the part of summary.json about what hands hold. */

/* The member "held"; none where nothing is. E_MEMORY. */
ambulo_status ambulo__holds_json(ambulo__json *json, const ambulo_problem *problem,
                                 const ambulo_result *result);

/* "ground_reaction" of summary.json: what feet and patches got. */

/* The member, with one for each foot and each patch in contact; nothing without ground reaction.
 * Errors: E_MEMORY. */
ambulo_status ambulo__reaction_json(ambulo__json *json, const ambulo_problem *problem,
                                    const ambulo_result *result);

/* summary.json (docs/results.md). */

/* Appends the whole text, with the options' sensitivities and inputs, and what muscles do (NULL:
 * nothing is said). Failures stick to the buffer. */
void ambulo__summary_json(const ambulo_problem *problem, const ambulo_result *result,
                          const ambulo_report_options *options,
                          const ambulo_muscle_analysis *muscles, ambulo__text_buffer *text);

#endif
