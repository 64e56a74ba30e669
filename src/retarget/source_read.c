/* retarget/source_read.c - a motion of any format, and the part of it that is wanted (source.h). */
#include "retarget/source.h"

#include "model/model.h"

#include <math.h>
#include <string.h>
#include <strings.h>

/* ---------------------------------------------------------------------------- part */

/* rows in [from, to], from time 0 on; a belt that runs backward adds to the way */
static ambulo_status cut(const char *path, const ambulo_retarget_options *o,
                         ambulo_diagnostics *diagnostics, ambulo__given *given) {
  enum { FEWEST = 8 };
  size_t d = (size_t)given->body->coordinate_count, first = 0, last = (size_t)given->rows;
  while (first < last && given->time[first] < o->from - 1e-9) first++;
  while (last > first && given->time[last - 1] > o->to + 1e-9) last--;
  if (last - first < FEWEST)
    return ambulo__error(diagnostics, AMBULO_E_SCHEMA, (ambulo__place){.file = path},
                         "--from and --to choose a part",
                         "%zu rows are left of the motion; expected at least %d", last - first,
                         FEWEST);
  double start = given->time[first];
  for (size_t k = first; k < last; k++) given->time[k - first] = given->time[k] - start;
  memmove(given->q, given->q + first * d, (last - first) * d * sizeof *given->q);
  given->rows = (int)(last - first);
  if (!isfinite(given->time[given->rows - 1])) return AMBULO_E_SCHEMA;
  for (size_t at = 0; at < (size_t)given->rows * d; at++)
    if (!isfinite(given->q[at]))
      return ambulo__error(diagnostics, AMBULO_E_SCHEMA, (ambulo__place){.file = path},
                           "--from and --to choose a part without gaps",
                           "'%s' has no value at %g s", given->body->coordinates[at % d].name,
                           given->time[at / d] + start);
  return AMBULO_OK;
}

static int ends_with(const char *path, const char *ending) {
  size_t length = strlen(path), tail = strlen(ending);
  return length >= tail && strcasecmp(path + length - tail, ending) == 0;
}

static ambulo_status read_file(const char *path, ambulo_diagnostics *diagnostics,
                               ambulo__given *given) {
  if (ends_with(path, ".npz")) return ambulo__given_smpl(path, diagnostics, given);
  if (ends_with(path, ".bvh")) return ambulo__given_bvh(path, diagnostics, given);
  if (given->body) return ambulo__given_table(path, diagnostics, given);
  return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                       "a table of angles needs the body that it moves");
}

ambulo_status ambulo__given_read(const char *path, const ambulo_retarget_options *options,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo__given *given) {
  ambulo__given g = {.allocator = ambulo__allocator_or_default(allocator), .body = options->body};
  ambulo__text_init(&g.text, &g.allocator);
  ambulo_status status = read_file(path, diagnostics, &g);
  if (!status) status = cut(path, options, diagnostics, &g);
  if (status)
    ambulo__given_free(&g);
  else
    *given = g;
  return status;
}
