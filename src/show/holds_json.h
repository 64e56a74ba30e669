/* show/holds_json.h - the part of summary.json about what hands hold. */
#ifndef AMBULO_SHOW_HOLDS_JSON_H
#define AMBULO_SHOW_HOLDS_JSON_H

#include "ambulo/solve.h"
#include "formats/json_text.h"

/* The member "held"; none where nothing is. E_MEMORY. */
ambulo_status ambulo__holds_json(ambulo__json *json, const ambulo_problem *problem,
                                 const ambulo_result *result);

#endif
