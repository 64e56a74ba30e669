/* study/listing_changes.c - see listing_changes.h. */
#include "study/listing_changes.h"
#include "ambulo/tools/report.h"

#include <stdio.h>
#include <string.h>

typedef struct changes {
  int same, changed, added, gone;
  const char *first; /* name of the first case that is not the same; NULL: none */
} changes;

/* both lists are sorted by id */
static changes compare(const ambulo_sweep *s, const ambulo__listing *old) {
  changes c = {0, 0, 0, 0, NULL};
  int i = 0, j = 0;
  while (i < s->case_count || j < old->cases) {
    int order;
    if (i == s->case_count) {
      order = 1;
    } else if (j == old->cases) {
      order = -1;
    } else {
      order = strcmp(s->cases[i].id, ambulo__listing_cell(old, j, AMBULO__LISTING_ID));
    }
    if (order == 0) {
      int same = ambulo__listing_key(old, j) == s->cases[i].key;
      c.same += same;
      c.changed += !same;
    }
    c.added += order < 0;
    c.gone += order > 0;
    if (!c.first && order > 0) c.first = ambulo__listing_cell(old, j, AMBULO__LISTING_NAME);
    if (!c.first && c.changed + c.added > 0) c.first = s->cases[i].name;
    i += order <= 0;
    j += order >= 0;
  }
  return c;
}

static int is_same_problem(const ambulo_sweep *s, const ambulo__listing *old) {
  ambulo_versions versions;
  ambulo_versions_get(&versions);
  char hash[20], version[64];
  (void)snprintf(hash, sizeof hash, "%016llx", s->problem_hash);
  (void)snprintf(version, sizeof version, "ambulo %s, NLopt %s", versions.ambulo, versions.nlopt);
  return strcmp(hash, old->problem_hash) == 0 && strcmp(version, old->version) == 0;
}

/* which input is another one: only what the folder has written down can be told apart */
static void name_cause(const ambulo_sweep *s, const ambulo__listing *old, changes c, char *cause,
                       size_t size) {
  ambulo_versions versions;
  ambulo_versions_get(&versions);
  char hash[20], version[64];
  (void)snprintf(hash, sizeof hash, "%016llx", s->problem_hash);
  (void)snprintf(version, sizeof version, "ambulo %s, NLopt %s", versions.ambulo, versions.nlopt);
  int problem = strcmp(hash, old->problem_hash) != 0;
  (void)snprintf(hash, sizeof hash, "%016llx", s->text_hash);
  if (strcmp(version, old->version) != 0)
    (void)snprintf(cause, size, "the version changed (was %s)", old->version);
  else if (problem && strcmp(hash, old->text_hash) != 0)
    (void)snprintf(cause, size, "the base problem changed");
  else if (problem)
    (void)snprintf(cause, size, "a file that the base problem names changed, its model or data");
  else if (c.added + c.gone > 0)
    (void)snprintf(cause, size, "the sweep changed");
  else
    (void)snprintf(cause, size, "a file that the sweep names, or what cases start from, changed");
}

/* The list of a front grows, so it is what makes the list that is compared. */
static ambulo_status compare_front(const ambulo_sweep *s, const char *directory,
                                   const ambulo__listing *old, ambulo_diagnostics *diagnostics) {
  ambulo__text_buffer text;
  char cause[128];
  int same = 1;
  ambulo__text_init(&text, &old->allocator);
  ambulo_status status = ambulo__listing_front_text(s, &text);
  if (!status) {
    changes none = {0, 0, 0, 0, NULL};
    const char *now = ambulo__text_data(&text);
    name_cause(s, old, none, cause, sizeof cause);
    same = old->front_text && strcmp(old->front_text, now) == 0;
    if (!same)
      (void)snprintf(cause, sizeof cause, "the front changed (was: %.90s)",
                     old->front_text ? old->front_text : "no front");
    same &= is_same_problem(s, old);
  }
  ambulo__text_free(&text);
  if (status || same) return status;
  ambulo__place place = {directory, 0, 0, NULL};
  return ambulo__error(
      diagnostics, AMBULO_E_PROBLEM, place,
      "--force keeps the cases that are the same and computes the others; or give another folder",
      "the folder was filled from other inputs: %s", cause);
}

static ambulo_status refuse(const ambulo_sweep *s, const char *directory,
                            const ambulo__listing *old, changes c,
                            ambulo_diagnostics *diagnostics) {
  char cause[128];
  name_cause(s, old, c, cause, sizeof cause);
  ambulo__place place = {directory, 0, 0, NULL};
  return ambulo__error(
      diagnostics, AMBULO_E_PROBLEM, place,
      "--force keeps the cases that are the same and computes the others; or give another folder",
      "the folder was filled from other inputs: %s; %d cases the same, %d with other inputs, "
      "%d new, %d gone (first: '%.60s')",
      cause, c.same, c.changed, c.added, c.gone, c.first ? c.first : "");
}

/* what the folder says it was filled from, against this sweep */
ambulo_status ambulo__listing_compare(const ambulo_sweep *sweep, const char *directory, int force,
                                      const ambulo_allocator *a, ambulo_diagnostics *diagnostics) {
  ambulo__listing old;
  ambulo__place place = {directory, 0, 0, NULL};
  int damaged = 0;
  ambulo_diagnostics *reasons = ambulo_diagnostics_create(a);
  if (!reasons) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__listing_try(directory, a, reasons, &old, &damaged);
  if (!status) {
    if (sweep->front.terms > 0 && !force) {
      status = compare_front(sweep, directory, &old, diagnostics);
    } else if (!force) {
      changes c = compare(sweep, &old);
      if (c.changed + c.added + c.gone > 0) status = refuse(sweep, directory, &old, c, diagnostics);
    }
    ambulo__listing_free(&old);
  } else if (damaged) {
    ambulo__warning(diagnostics, place, NULL,
                    "damaged: the list of cases is not what was written; it is written anew from "
                    "the sweep, and cases of other inputs are computed again");
    status = AMBULO_OK;
  } else if (status == AMBULO_E_PROBLEM && force) {
    status = AMBULO_OK;
  } else {
    const ambulo_diagnostic *reason = ambulo_diagnostics_get(reasons, 0);
    if (reason) {
      place.file = reason->file;
      (void)ambulo__error(diagnostics, status, place, reason->hint, "%s", reason->message);
    }
  }
  ambulo_diagnostics_free(reasons);
  return status;
}
