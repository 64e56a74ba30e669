/* study/gather.c - see gather.h. */
#include "base/diagnostics.h"
#include "study/gather.h"

#include <string.h>

typedef struct gatherer {
  const char *directory;
  const ambulo__listing *listing;
  ambulo__gather_depth depth;
  ambulo_diagnostics *reasons; /* why a file could not be read */
  ambulo__output *value;
  ambulo_batch_census census;
  ambulo__record record;
  ambulo__damage damage;
} gatherer;

static const char summary[] = "/summary.json";

/* outputs of an intact case; a file that cannot be read after all makes it a damaged one */
static ambulo_status take_outputs(gatherer *g, const char *id, ambulo__finding *finding) {
  const ambulo__listing *l = g->listing;
  if (*finding != AMBULO__FOUND_INTACT || l->outputs == 0) return AMBULO_OK;
  if (!ambulo__case_files_have(&g->record.files, summary)) return AMBULO_OK;
  ambulo__diagnostics_clear(g->reasons);
  ambulo_status status = ambulo__outputs_of(g->directory, id, l->output, l->outputs, &l->allocator,
                                            g->reasons, g->value);
  if (!status) return AMBULO_OK;
  *finding = AMBULO__FOUND_DAMAGED;
  const ambulo_diagnostic *reason = ambulo_diagnostics_get(g->reasons, 0);
  const char *file = reason && reason->file ? strrchr(reason->file, '/') : NULL;
  return ambulo__damage_of(status, file ? file : "/", g->reasons, &g->damage);
}

static const char *count(gatherer *g, ambulo__finding finding) {
  ambulo_batch_census *census = &g->census;
  switch (finding) {
  case AMBULO__FOUND_NOTHING:
    census->missing++;
    return "missing";
  case AMBULO__FOUND_STALE:
    census->stale++;
    return "stale";
  case AMBULO__FOUND_DAMAGED:
    census->corrupt++;
    return "corrupt";
  case AMBULO__FOUND_INTACT:
    break;
  }
  census->done++;
  census->failed += !g->record.valid;
  census->seconds += g->record.seconds;
  return g->record.state;
}

static ambulo_status look(gatherer *g, int k, ambulo__gathered *one) {
  const ambulo__listing *l = g->listing;
  const char *id = ambulo__listing_cell(l, k, AMBULO__LISTING_ID);
  ambulo__finding finding;
  unsigned long long key = ambulo__listing_key(l, k);
  int files = g->depth != AMBULO__GATHER_RECORDS;
  memset(g->value, 0, (size_t)l->outputs * sizeof *g->value);
  ambulo_status status = ambulo__record_find(g->directory, id, key, files, &l->allocator, &finding,
                                             &g->record, &g->damage);
  if (!status && g->depth == AMBULO__GATHER_OUTPUTS) status = take_outputs(g, id, &finding);
  if (status) return status;
  int intact = finding == AMBULO__FOUND_INTACT;
  *one = (ambulo__gathered){.index = k,
                            .state = count(g, finding),
                            .valid = intact && g->record.valid,
                            .value = g->value,
                            .damage = finding == AMBULO__FOUND_DAMAGED ? &g->damage : NULL};
  return AMBULO_OK;
}

ambulo_status ambulo__gather(const char *directory, const ambulo__listing *l,
                             ambulo__gather_depth depth,
                             ambulo_status (*take)(void *user, const ambulo__gathered *gathered),
                             void *user, ambulo_batch_census *census) {
  gatherer g = {.directory = directory, .listing = l, .depth = depth};
  g.census.cases = l->cases;
  g.reasons = ambulo_diagnostics_create(&l->allocator);
  g.value = ambulo__alloc(&l->allocator, (size_t)l->outputs, sizeof *g.value);
  ambulo_status status = g.reasons && g.value ? AMBULO_OK : AMBULO_E_MEMORY;
  for (int k = 0; k < l->cases && !status; k++) {
    ambulo__gathered one;
    status = look(&g, k, &one);
    if (!status && take) status = take(user, &one);
  }
  ambulo_diagnostics_free(g.reasons);
  ambulo__free(&l->allocator, g.value);
  if (!status && census) *census = g.census;
  return status;
}
