/* study/sweep_append.c - a case list that grows while it is computed (sweep.h).
 *
 * Who chooses the next cases by the results of the last ones has no list beforehand, and so no
 * places in it: an id is the hash of what is asked for. A list that grows in another order, or that
 * is asked for the same twice, finds what has been computed. */
#include "formats/text_hash.h"
#include "study/sweep.h"

#include <stdio.h>
#include <string.h>

static ambulo_status make_room(ambulo_sweep *s, ambulo_diagnostics *diagnostics) {
  if (s->case_count < s->case_capacity) return AMBULO_OK;
  if (s->case_count >= AMBULO__SWEEP_CASES) {
    ambulo__place place = {s->path, 0, 0, NULL};
    return ambulo__error(diagnostics, AMBULO_E_LIMIT, place, NULL,
                         "more than %d cases; expected at most %d", AMBULO__SWEEP_CASES,
                         AMBULO__SWEEP_CASES);
  }
  int capacity = s->case_capacity ? 2 * s->case_capacity : 64;
  ambulo__sweep_case *cases =
      ambulo__realloc(&s->allocator, s->cases, (size_t)capacity, sizeof *cases);
  if (!cases) return AMBULO_E_MEMORY;
  s->cases = cases;
  s->case_capacity = capacity;
  return AMBULO_OK;
}

/* pointers and their texts in one block, since no axis owns the latter */
static const char **pack(const ambulo_sweep *s, const char *const *overrides, int count) {
  size_t head = (size_t)count * sizeof *overrides, size = head;
  for (int i = 0; i < count; i++) size += strlen(overrides[i]) + 1;
  char *block = ambulo__alloc(&s->allocator, size, 1);
  const char **packed = (const char **)(void *)block;
  char *at = block ? block + head : NULL;
  for (int i = 0; block && i < count; i++) {
    size_t length = strlen(overrides[i]) + 1;
    memcpy(at, overrides[i], length);
    packed[i] = at;
    at += length;
  }
  return packed;
}

/* *id: hash of overrides and start; *key: with the base problem and the files that values name */
static ambulo_status hash_request(const ambulo_sweep *s, const char *const *overrides, int count,
                                  int previous, unsigned long long *id, unsigned long long *key) {
  unsigned long long hash = AMBULO__HASH_START, files = s->base_hash;
  for (int i = 0; i < count; i++) {
    const char *value = strchr(overrides[i], '=');
    unsigned long long file = 0;
    hash = ambulo__hash_text(hash, overrides[i]);
    ambulo_status status = value ? ambulo__sweep_hash_value(s, value + 1, &file) : AMBULO_OK;
    if (status) return status;
    if (file) files = ambulo__hash_word(files, file);
  }
  if (previous >= 0) {
    hash = ambulo__hash_text(hash, s->cases[previous].id);
    files = ambulo__hash_word(files, s->cases[previous].key);
  }
  *id = hash;
  *key = ambulo__hash_word(hash, files);
  return AMBULO_OK;
}

ambulo_status ambulo__sweep_append(ambulo_sweep *s, const char *name, const char *const *overrides,
                                   int count, int previous, ambulo_diagnostics *diagnostics,
                                   int *index) {
  unsigned long long hash = 0, key = 0;
  char id[24];
  s->diagnostics = diagnostics;
  ambulo_status status = hash_request(s, overrides, count, previous, &hash, &key);
  s->diagnostics = NULL;
  if (status) return status;
  (void)snprintf(id, sizeof id, "%016llx", hash);
  for (int k = 0; k < s->case_count; k++) {
    if (strcmp(s->cases[k].id, id) != 0) continue;
    *index = k;
    return AMBULO_OK;
  }
  status = make_room(s, diagnostics);
  if (status) return status;
  ambulo__sweep_case *one = &s->cases[s->case_count];
  memset(one, 0, sizeof *one);
  *index = s->case_count++;
  one->id = ambulo__strdup(&s->allocator, id);
  one->name = ambulo__strdup(&s->allocator, name);
  one->override = pack(s, overrides, count);
  one->overrides = count;
  one->previous = previous;
  one->key = key;
  return one->id && one->name && one->override ? AMBULO_OK : AMBULO_E_MEMORY;
}
