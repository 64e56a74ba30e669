/* definitions/problem_at.c - a problem file read again with its free parameters elsewhere.
 *
 * It is the text as it was when the problem was read, with the same overrides and one more for each
 * parameter: what a user would have by `--set`; then extended as the problem was.
 */
#include "problem/nlp.h"
#include "ambulo/tools/load.h"
#include "base/sized.h"
#include "definitions/problem_free.h"

#include <stdio.h>
#include <string.h>

enum { NUMBER = 40 };

/* The items are the library's own, of its size: the caller reads the beginning of each. */
void ambulo_problem_parameters_fill(const ambulo_problem *problem, ambulo_parameters *filled) {
  const ambulo__free_section *s = ambulo__problem_root(problem)->free;
  if (!s) return;
  ambulo_parameters usual = s->parameters;
  usual.size = filled->size;
  ambulo__sized_fill(filled, filled->size, &usual, sizeof usual);
}

/* names in "a, b" */
static int count_names(const char *names) {
  int count = names[0] != '\0';
  for (; *names; names++) count += *names == ',';
  return count;
}

static size_t room_for(const ambulo__free_section *s) {
  size_t room = 0;
  for (int i = 0; i < s->parameters.count; i++) {
    size_t names = 1 + (size_t)count_names(s->key[i].with);
    room += strlen(s->item[i].name) + strlen(s->key[i].with) + names * (NUMBER + 2);
  }
  return room;
}

/* of each of the names in "a, b" */
static char *write_all(char *at, const char *names, double value, const char **override,
                       int *count) {
  while (*names) {
    size_t length = strcspn(names, ",");
    override[(*count)++] = at;
    at += sprintf(at, "%.*s=%.17g", (int)length, names, value) + 1;
    names += length;
    names += strspn(names, ", ");
  }
  return at;
}

/* fills override[], writes texts at `at`, "key=value" in the file's unit, one behind the other;
 * returns how many there are */
static int fill(const ambulo__free_section *s, const double *values, char *at,
                const char **override) {
  int count = 0;
  for (; count < s->overrides; count++) override[count] = s->override[count];
  for (int i = 0; i < s->parameters.count; i++) {
    double value = values[i] / s->key[i].unit;
    at = write_all(at, s->item[i].name, value, override, &count);
    at = write_all(at, s->key[i].with, s->key[i].with_sign * value, override, &count);
  }
  override[count++] = "free=null";
  return count;
}

ambulo_status ambulo__problem_at(ambulo__text_loader *load, const ambulo_problem *problem,
                                 const double *values, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo_problem **at) {
  const ambulo__free_section *s = ambulo__problem_root(problem)->free;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  size_t most = (size_t)s->overrides + (size_t)s->parameters.count + 1;
  for (int i = 0; i < s->parameters.count; i++) most += (size_t)count_names(s->key[i].with);
  const char **override = ambulo__alloc(&own, most, sizeof *override);
  char *text = ambulo__alloc(&own, room_for(s), 1);
  ambulo_problem *read = NULL;
  ambulo_status status = AMBULO_E_MEMORY;
  if (override && text) {
    ambulo_problem_text file = ambulo_problem_text_default();
    file.text = s->text;
    file.length = s->length;
    file.name = s->name;
    file.directory = s->directory;
    file.overrides = override;
    file.override_count = fill(s, values, text, override);
    status = load(&file, &own, diagnostics, &read);
  }
  if (!status) status = ambulo__extend_alike(problem, read, &own, diagnostics, at);
  ambulo__free(&own, override);
  ambulo__free(&own, text);
  return status;
}
