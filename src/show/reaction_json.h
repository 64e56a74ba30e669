/* show/reaction_json.h - "ground_reaction" of summary.json: what feet and patches got. */
#ifndef AMBULO_SHOW_REACTION_JSON_H
#define AMBULO_SHOW_REACTION_JSON_H

#include "formats/json_text.h"
#include "problem/nlp.h"

/* The member, with one for each foot and each patch in contact; nothing without ground reaction.
 * Errors: E_MEMORY. */
ambulo_status ambulo__reaction_json(ambulo__json *json, const ambulo_problem *problem,
                                    const ambulo_result *result);

#endif
