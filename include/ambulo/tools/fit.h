/* ambulo/tools/fit.h - inverse optimal control: numbers of a problem by which its predicted motions
 * come closest to curves of people.
 *
 * A fit file names a problem, parameters (weights, prices, phases: keys of the problem), conditions
 * (speeds, subjects, slopes: overrides, each with its reference curves) and a distance. Its inner
 * solves are run by processes as those of a batch (batch.h). Format: docs/guide-fit.md.
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_FIT_H
#define AMBULO_TOOLS_FIT_H

#include "ambulo/tools/common.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ambulo_fit ambulo_fit; /* immutable */

/* Loads a fit file, its problem and its references, and tries the bounds of each parameter.
 * Errors: E_IO, E_PARSE, E_SCHEMA, E_PROBLEM (with file, line and column), E_LIMIT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_fit_load(const char *path,
                                                          const ambulo_allocator *allocator,
                                                          ambulo_diagnostics *diagnostics,
                                                          ambulo_fit **fit);
AMBULO_API void ambulo_fit_free(ambulo_fit *fit); /* accepts NULL */

/* What was understood, as lines for people; free with ambulo_text_free. E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_fit_describe(const ambulo_fit *fit,
                                                              const ambulo_allocator *allocator,
                                                              char **text);

/* How a run ended. */
typedef enum ambulo_fit_ending {
  AMBULO_FIT_NOT_RUN = 0, /* of a state that nobody filled */
  AMBULO_FIT_CONVERGED,   /* further iterations change little */
  AMBULO_FIT_ITERATIONS,  /* as many as the fit file allows */
  AMBULO_FIT_INTERRUPTED, /* the caller stopped it; what is best so far was written */
  AMBULO_FIT_STUCK        /* all solves of a condition failed; what is best so far was written */
} ambulo_fit_ending;

/* State of a run, for progress. Distances: NaN while there is none. */
typedef struct ambulo_fit_progress {
  int iteration, iterations; /* 0: where the parameters stand in the file */
  int round, rounds;         /* solves of the present round that are done, and all of it */
  int solves, expected;      /* that are done, and about how many there will be */
  int failed;                /* of those done: without a valid solution */
  int resumed;               /* of those done: found in the folder */
  double first, best;        /* distance at the file's own values, and at the best ones */
  double seconds;            /* since the start */
  double seconds_left;       /* AMBULO_OFF: unknown */
  ambulo_fit_ending ending;  /* AMBULO_FIT_NOT_RUN until it has ended */
} ambulo_fit_progress;

typedef struct ambulo_fit_options {
  size_t size;         /* set by ambulo_fit_options_default() */
  const char *program; /* the ambulo program; NULL: /proc/self/exe */
  int workers;         /* processes at once; 0: usable processors, limited by memory */
  double case_seconds; /* kill a solve after this; AMBULO_OFF: as the fit file says */
  int case_megabytes;  /* address space of a solve; 0: as the fit file says, or no limit */
  double grace;        /* s that running solves get after a first stop; 30 */
  int force;           /* 1: go on in the folder of a fit with other inputs */
  /* Called a few times a second. 0: go on; 1: start no new solve; 2: stop now. NULL: none. */
  int (*progress)(void *user, const ambulo_fit_progress *progress);
  void *user;
} ambulo_fit_options;
AMBULO_TOOL_DEFAULT(ambulo_fit_options);

/* Runs the fit in `directory`, which is created, or continued where it holds the same fit: solves
 * that are finished there are not computed again. Writes fit.json and fitted.yaml into it, and
 * *report (may be NULL; free with ambulo_text_free), a table for people. *end (may be NULL) is the
 * final state. AMBULO_OK for every ending. Errors, which leave no fit.json of this run: E_IO (the
 * folder holds other things, is locked, or cannot be written), E_PROBLEM (it was filled from other
 * inputs and force is 0; the first solves all fail; a motion lacks a curve), E_LIMIT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_fit_run(const ambulo_fit *fit,
                                                         const char *directory,
                                                         const ambulo_fit_options *options,
                                                         const ambulo_allocator *allocator,
                                                         ambulo_diagnostics *diagnostics,
                                                         ambulo_fit_progress *end, char **report);

#ifdef __cplusplus
}
#endif
#endif
