/* problem/definition_parts.c - see definition_parts.h. */
#include "problem/definition_parts.h"
#include "base/sized.h"

#include <stddef.h>
#include <string.h>

typedef ambulo_problem_definition definition;

enum { PARTS = AMBULO__DEFINITION_RUNS / 2 };
static const struct {
  size_t at, full;
} parts[PARTS] = {
    {offsetof(definition, clearance), sizeof(ambulo_clearance)},
    {offsetof(definition, ground_reaction), sizeof(ambulo_ground_reaction)},
    {offsetof(definition, collision), sizeof(ambulo_collision)},
};

int ambulo__definition_runs(const ambulo_problem_definition *theirs,
                            ambulo__definition_run runs[AMBULO__DEFINITION_RUNS]) {
  const size_t part_size[PARTS] = {theirs->clearance_size, theirs->ground_reaction_size,
                                   theirs->collision_size};
  size_t ours = 0, given = 0;
  int known = 1;
  for (int i = 0; i < PARTS; i++) {
    size_t size = part_size[i], full = parts[i].full;
    known &= ambulo__sized_item(size, full) && size % sizeof(double) == 0;
    runs[2 * i] = (ambulo__definition_run){ours, given, parts[i].at - ours};
    given += parts[i].at - ours;
    runs[2 * i + 1] = (ambulo__definition_run){parts[i].at, given, size < full ? size : full};
    given += size;
    ours = parts[i].at + full;
  }
  size_t behind = sizeof(definition) - ours, left = theirs->size - given;
  known &= theirs->size >= given && left <= behind;
  runs[2 * PARTS] = (ambulo__definition_run){ours, given, left < behind ? left : behind};
  return known;
}

void ambulo__definition_give(const ambulo_problem_definition *usual,
                             ambulo_problem_definition *given) {
  ambulo__definition_run runs[AMBULO__DEFINITION_RUNS];
  definition all = *usual;
  memcpy(&all, given, offsetof(definition, name)); /* the sizes */
  (void)ambulo__definition_runs(&all, runs);
  memset(given, 0, all.size); /* what a newer header has besides */
  for (int i = 0; i < AMBULO__DEFINITION_RUNS; i++)
    memcpy((char *)given + runs[i].theirs, (const char *)&all + runs[i].ours, runs[i].length);
}
