/* show/economy_json.h - "work" and "center_of_mass" of summary.json. */
#ifndef AMBULO_SHOW_ECONOMY_JSON_H
#define AMBULO_SHOW_ECONOMY_JSON_H

#include "formats/json_text.h"
#include "problem/nlp.h"

/* The members; without ground reaction no work, whose torques are not those of joints. Errors:
 * E_MEMORY. */
ambulo_status ambulo__economy_json(ambulo__json *json, const ambulo_problem *problem,
                                   const ambulo_result *result);

#endif
