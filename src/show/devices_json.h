/* show/devices_json.h - what devices do over the motion as it is shown. */
#ifndef AMBULO_SHOW_DEVICES_JSON_H
#define AMBULO_SHOW_DEVICES_JSON_H

#include "ambulo/solve.h"
#include "formats/json_text.h"

/* "devices": {name: {unit, peak, positive, negative}}; nothing without devices. E_MEMORY. */
ambulo_status ambulo__devices_json(ambulo__json *json, const ambulo_problem *problem,
                                   const ambulo_result *result);

#endif
