/* show/scene_series.c - see series.h.
 *
 * The numbers are rounded first and differences taken of what was rounded: adding up gives the
 * rounded ones back, however long the series is.
 */
#include "show/scene_series.h"

#include <math.h>

static const double largest = 1099511627776.0; /* 2^40: differences of differences fit */

void ambulo__series(ambulo__json *json, const char *key, const double *values, int step, int count,
                    double unit) {
  ambulo__text_buffer line;
  ambulo__text_init_part(&line, json->text);
  long long last = 0, slope = 0;
  ambulo__text_append_char(&line, '[');
  for (int k = 0; k < count; k++) {
    double scaled = round(values[(size_t)k * (size_t)step] / unit);
    long long now = fabs(scaled) <= largest ? (long long)scaled : last;
    long long change = now - last;
    if (k > 0) ambulo__text_append_char(&line, ',');
    ambulo__text_append_number(&line, (double)(k < 2 ? change : change - slope));
    slope = change;
    last = now;
  }
  ambulo__text_append_char(&line, ']');
  ambulo__json_raw(json, key, ambulo__text_data(&line));
  ambulo__text_free(&line);
}
