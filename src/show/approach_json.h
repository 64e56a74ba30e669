/* show/approach_json.h - how near capsules come to one another and to obstacles, in summary.json.
 */
#ifndef AMBULO_SHOW_APPROACH_JSON_H
#define AMBULO_SHOW_APPROACH_JSON_H

#include "ambulo/solve.h"
#include "formats/json_text.h"
#include "problem/nlp.h"

/* "approaches"; nothing of a problem without. E_MEMORY. */
ambulo_status ambulo__approach_json(ambulo__json *json, const ambulo_problem *problem,
                                    const ambulo_result *result);

#endif
