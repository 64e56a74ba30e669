/* study/units.c - see units.h. Motion files are in SI units and radians (docs/conventions.md). */
#include "study/units.h"

#include <stdio.h>
#include <string.h>

typedef struct pair {
  const char *name, *unit;
} pair;

/* "time" names itself and what begins with "time." */
static int begins(const char *text, const char *head) {
  size_t length = strlen(head);
  return strncmp(text, head, length) == 0 && (text[length] == '\0' || text[length] == '.');
}

static int ends(const char *text, const char *tail) {
  size_t length = strlen(text), size = strlen(tail);
  return length >= size && strcmp(text + length - size, tail) == 0;
}

/* kinds of columns that belong to a coordinate: unit of a length, of an angle */
static const char *unit_of_coordinate(const char *column, const ambulo_model *model) {
  static const char *const kinds[][3] = {{"q", "m", "rad"},
                                         {"qd", "m/s", "rad/s"},
                                         {"qdd", "m/s\xc2\xb2", "rad/s\xc2\xb2"},
                                         {"tau", "N", "N m"}};
  const char *point = strchr(column, '.');
  int i = point && model ? ambulo_model_find_coordinate(model, point + 1) : -1;
  const ambulo_coordinate *coordinate = i < 0 ? NULL : ambulo_model_coordinate(model, i);
  for (size_t k = 0; coordinate && k < sizeof kinds / sizeof *kinds; k++)
    if (begins(column, kinds[k][0])) return kinds[k][coordinate->type == AMBULO_REVOLUTE ? 2 : 1];
  return "";
}

static const char *unit_of_column(const char *column, const ambulo_model *model) {
  static const pair kinds[] = {{"time", "s"}, {"zmp", "m"},           {"cop", "m"},
                               {"grf", "N"},  {"free_moment", "N m"}, {"moment", "N m"}};
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
    if (begins(column, kinds[i].name)) return kinds[i].unit;
  return unit_of_coordinate(column, model);
}

const char *ambulo__unit_of_output(const char *output, const ambulo_model *model) {
  static const char *const reductions[] = {"max(", "min(", "mean(", "range("};
  static const pair tails[] = {{"duration", "s"},
                               {"body.mass", "kg"},
                               {"impulse_forward", "N s"},
                               {"impulse_up", "N s"},
                               {"impulse_left", "N s"},
                               {"peak", "body weights"},
                               {".time", "s"},
                               {"gait.step_time", "s"},
                               {"gait.step_length", "m"},
                               {"gait.step_width", "m"},
                               {"gait.speed", "m/s"},
                               {"gait.stride_frequency", "Hz"},
                               {"gait.contact_time", "s"},
                               {"gait.flight_time", "s"}};
  char column[128];
  for (size_t i = 0; i < sizeof reductions / sizeof *reductions; i++) {
    size_t head = strlen(reductions[i]), length = strlen(output);
    if (strncmp(output, reductions[i], head) != 0 || output[length - 1] != ')') continue;
    (void)snprintf(column, sizeof column, "%.*s", (int)(length - head - 1), output + head);
    return unit_of_column(column, model);
  }
  if (begins(output, "timing")) return "s";
  for (size_t i = 0; i < sizeof tails / sizeof *tails; i++)
    if (ends(output, tails[i].name)) return tails[i].unit;
  return "";
}

const char *ambulo__unit_of_key(const char *key) {
  static const pair tails[] = {
      {"duration", "s"},          {"step_time", "s"},  {"time_limit", "s"},      {".speed", "m/s"},
      {"step_length", "m"},       {"step_width", "m"}, {"stature", "m"},         {".mass", "kg"},
      {"contact_tolerance", "m"}, {"clearance", "m"},  {"clearance.height", "m"}};
  /* a model has units of its own */
  for (size_t i = 0; i < sizeof tails / sizeof *tails && !begins(key, "model"); i++)
    if (ends(key, tails[i].name)) return tails[i].unit;
  return "";
}
