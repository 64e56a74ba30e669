/* study/verify.c - the state of a batch folder: quickly by its records, or file by file. */
#include "study/gather.h"
#include "study/case_path.h"
#include "study/batch_lock.h"

#include <string.h>

typedef struct verification {
  const char *directory;
  const ambulo__listing *listing;
  void (*damaged)(void *user, const ambulo_batch_damage *damage);
  void *user;
} verification;

static ambulo_status look(void *user, const ambulo__gathered *one) {
  const verification *v = user;
  const ambulo__listing *l = v->listing;
  if (!one->damage || !v->damaged) return AMBULO_OK;
  const char *id = ambulo__listing_cell(l, one->index, AMBULO__LISTING_ID);
  char *path = ambulo__case_path(&l->allocator, v->directory, id, one->damage->ending);
  if (!path) return AMBULO_E_MEMORY;
  ambulo_batch_damage damage = {id, ambulo__listing_cell(l, one->index, AMBULO__LISTING_NAME), path,
                                one->damage->what};
  v->damaged(v->user, &damage);
  ambulo__free(&l->allocator, path);
  return AMBULO_OK;
}

static ambulo_status inspect(const char *directory, ambulo__gather_depth depth, verification *v,
                             const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                             ambulo_batch_census *census) {
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__listing listing;
  ambulo_batch_census counted;
  ambulo_status status = ambulo__listing_load(directory, allocator, diagnostics, &listing);
  if (!status) {
    v->directory = directory;
    v->listing = &listing;
    status = ambulo__gather(directory, &listing, depth, look, v, &counted);
    if (!status)
      status = ambulo__lock_holder(directory, &listing.allocator, diagnostics, counted.holder);
    ambulo__listing_free(&listing);
  }
  if (!status && census) *census = counted;
  return ambulo__conclude(diagnostics, errors, status, directory);
}

ambulo_status ambulo_batch_status(const char *directory, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_batch_census *census) {
  verification v = {.damaged = NULL};
  if (!directory || !census) return AMBULO_E_ARGUMENT;
  return inspect(directory, AMBULO__GATHER_RECORDS, &v, allocator, diagnostics, census);
}

ambulo_status ambulo_batch_verify(const char *directory,
                                  void (*damaged)(void *user, const ambulo_batch_damage *damage),
                                  void *user, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_batch_census *census) {
  verification v = {.damaged = damaged, .user = user};
  if (!directory) return AMBULO_E_ARGUMENT;
  return inspect(directory, AMBULO__GATHER_FILES, &v, allocator, diagnostics, census);
}
