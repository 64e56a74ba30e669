/* show/history_json.c - see history_json.h. */
#include "show/history_json.h"

#include <math.h>

typedef double column(const ambulo_iteration *iteration);

static double number_of(const ambulo_iteration *i) {
  return i->iteration;
}
static double evaluations_of(const ambulo_iteration *i) {
  return i->evaluations;
}
static double intervals_of(const ambulo_iteration *i) {
  return i->intervals;
}
static double objective_of(const ambulo_iteration *i) {
  return i->objective;
}
static double violation_of(const ambulo_iteration *i) {
  return i->violation;
}
static double gradient_of(const ambulo_iteration *i) {
  return i->gradient;
}
/* to the microsecond: more says nothing */
static double seconds_of(const ambulo_iteration *i) {
  return round(i->seconds * 1e6) / 1e6;
}

/* on one line */
static void list(ambulo__json *json, const char *key, const ambulo_history *history, column *of) {
  ambulo__text_buffer line;
  ambulo__text_init_part(&line, json->text);
  ambulo__text_append_char(&line, '[');
  for (int i = 0; i < history->count; i++) {
    double value = of(&history->items[i]);
    if (i) ambulo__text_append(&line, ", ");
    if (isfinite(value)) {
      ambulo__text_append_number(&line, value);
    } else {
      ambulo__text_append(&line, "null");
    }
  }
  ambulo__text_append_char(&line, ']');
  ambulo__json_raw(json, key, ambulo__text_data(&line));
  ambulo__text_free(&line);
}

void ambulo__history_json(ambulo__json *json, const ambulo_result *result) {
  const ambulo_history *history = ambulo_result_history(result);
  if (history->count == 0) return;
  ambulo__json_open(json, "convergence", '{');
  ambulo__json_integer(json, "every", history->every);
  ambulo__json_number(json, "tolerance", history->tolerance);
  list(json, "iteration", history, number_of);
  list(json, "evaluations", history, evaluations_of);
  list(json, "intervals", history, intervals_of);
  list(json, "objective", history, objective_of);
  list(json, "violation", history, violation_of);
  list(json, "gradient", history, gradient_of);
  list(json, "seconds", history, seconds_of);
  ambulo__json_close(json, '}');
}
