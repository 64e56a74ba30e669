/* reader/problem_at.c - a problem file read again with its free parameters elsewhere.
 *
 * It is the text as it was when the problem was read, with the same overrides and one more for each
 * parameter: what a user would have by `--set`.
 */
#include "reader/problem_free.h"

#include <stdio.h>
#include <string.h>

enum { COOKIE = 0x616d6266, MOST_SOLVES = 60, NUMBER = 40 };

ambulo_parameters ambulo_parameters_default(void) {
  return (ambulo_parameters){.cookie = COOKIE, .maximum_solves = MOST_SOLVES};
}

ambulo_parameters ambulo_problem_parameters(const ambulo_problem *problem) {
  return problem->free ? problem->free->parameters : ambulo_parameters_default();
}

/* "key=value" in the file's unit; the texts of a run stand one behind the other */
static char *write_override(char *at, const char *key, double value) {
  int length = sprintf(at, "%s=%.17g", key, value);
  return at + length + 1;
}

static size_t room_for(const ambulo__free_section *s) {
  size_t room = 0;
  for (int i = 0; i < s->parameters.count; i++)
    room += strlen(s->item[i].name) + strlen(s->key[i].with) + 2 * (NUMBER + 2);
  return room;
}

/* fills override[], writes texts at `at`; returns how many there are */
static int fill(const ambulo__free_section *s, const double *values, char *at,
                const char **override) {
  int count = 0;
  for (; count < s->overrides; count++) override[count] = s->override[count];
  for (int i = 0; i < s->parameters.count; i++) {
    double value = values[i] / s->key[i].unit;
    override[count++] = at;
    at = write_override(at, s->item[i].name, value);
    if (!s->key[i].with[0]) continue;
    override[count++] = at;
    at = write_override(at, s->key[i].with, s->key[i].with_sign * value);
  }
  override[count++] = "free=null";
  return count;
}

ambulo_status ambulo__problem_at(ambulo__text_loader *load, const ambulo_problem *problem,
                                 const double *values, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo_problem **at) {
  const ambulo__free_section *s = problem->free;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  size_t most = (size_t)s->overrides + 2 * (size_t)s->parameters.count + 1;
  const char **override = ambulo__alloc(&own, most, sizeof *override);
  char *text = ambulo__alloc(&own, room_for(s), 1);
  ambulo_status status = AMBULO_E_MEMORY;
  if (override && text) {
    int count = fill(s, values, text, override);
    status =
        load(s->text, s->length, s->name, s->directory, override, count, &own, diagnostics, at);
  }
  ambulo__free(&own, override);
  ambulo__free(&own, text);
  return status;
}
