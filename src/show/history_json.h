/* show/history_json.h - the way of the solve in summary.json. */
#ifndef AMBULO_SHOW_HISTORY_JSON_H
#define AMBULO_SHOW_HISTORY_JSON_H

#include "ambulo/solve.h"
#include "formats/json_text.h"

/* "convergence": a list for each column, as tables of data want them; nothing where no solver
 * ran. */
void ambulo__history_json(ambulo__json *json, const ambulo_result *result);

#endif
