/* solver/advice.c - see advice.h */
#include "solver/advice.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

double ambulo__outward(double value, int up) {
  if (value == 0.0 || !isfinite(value)) return value;
  double scale = pow(10.0, 3.0 - floor(log10(fabs(value))));
  double steps = value * scale;
  return (up ? ceil(steps - 1e-6) : floor(steps + 1e-6)) / scale;
}

void ambulo__advice_say(const ambulo__advice *a, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(a->out->suggestion, AMBULO__LINE_SIZE, format, arguments);
  va_end(arguments);
}

void ambulo__advice_set(const ambulo__advice *a, const char *format, ...) {
  ambulo__explanation *out = a->out;
  int i = out->view.setting_count;
  if (!a->problem->keys.file || i >= AMBULO__MOST_SETTINGS) return;
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(out->setting[i], AMBULO__LINE_SIZE, format, arguments);
  va_end(arguments);
  out->settings[i] = out->setting[i];
  out->view.setting_count++;
}

void ambulo__advice_set_step(const ambulo__advice *a, double length) {
  const ambulo__problem_keys *keys = &a->problem->keys;
  double travel = length * (double)keys->steps;
  if (!keys->gait || keys->unlike_steps) return;
  ambulo__advice_set(a, "gait.step_length=%.7g", length);
  if (keys->speed)
    ambulo__advice_set(a, "gait.speed=%.9g", fabs(travel) / a->problem->definition.duration);
  if (keys->travel) ambulo__advice_set(a, "ends.travel=%.7g", travel);
}
