/* ambulo/tools/batch.h - many problems: a sweep file, worker processes, one table.
 *
 * A sweep is a base problem and values for some of its keys; its case list is a pure
 * function of the file. Each case is solved by a process of its own and leaves a result
 * folder and a record, both whole or absent, so that a run may be killed at any time and
 * resumed. Formats: docs/batch-format.md.
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_BATCH_H
#define AMBULO_TOOLS_BATCH_H

#include "ambulo/tools/page.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ambulo_sweep ambulo_sweep; /* immutable */

/* One case. Strings belong to the sweep. */
typedef struct ambulo_case {
  const char *id;               /* "000000012-1f3a9c04": place in the list, hash of the overrides */
  const char *name;             /* from `case_name`, or the id */
  const char *const *overrides; /* [override_count] "path=value", as `--set` takes them */
  int override_count;
  int previous;           /* case whose solution starts this one; -1: zero */
  unsigned long long key; /* of everything its result depends on */
} ambulo_case;

/* Loads a sweep file and its base problem, and builds the case list.
 * Errors: as ambulo_problem_load; E_LIMIT (more than a million cases). */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_sweep_load(const char *path,
                                                            const ambulo_allocator *allocator,
                                                            ambulo_diagnostics *diagnostics,
                                                            ambulo_sweep **sweep);
AMBULO_API void ambulo_sweep_free(ambulo_sweep *sweep); /* accepts NULL */

/* Points that a front is asked for (the key `front`); 0: the sweep is none. The list of a front has
 * its first ends only; ambulo_batch_run finds the others. */
AMBULO_API int ambulo_sweep_front_points(const ambulo_sweep *sweep);
AMBULO_API const char *ambulo_sweep_name(const ambulo_sweep *sweep);
AMBULO_API const char *ambulo_sweep_base(const ambulo_sweep *sweep); /* path of the base problem */
AMBULO_API int ambulo_sweep_case_count(const ambulo_sweep *sweep);
/* E_ARGUMENT when out of range. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_sweep_case(const ambulo_sweep *sweep, int index,
                                                            ambulo_case *one);
AMBULO_API int ambulo_sweep_axis_count(const ambulo_sweep *sweep);
AMBULO_API const char *ambulo_sweep_axis_name(const ambulo_sweep *sweep, int axis);
/* Text of axis `axis` in case `index`; "" where the case does not set it. */
AMBULO_API const char *ambulo_sweep_value(const ambulo_sweep *sweep, int index, int axis);

/* ----------------------------------------------------------------------- run */

/* Cases that ended in one state: a verdict's name, or that of an end without a result. */
typedef struct ambulo_batch_tally {
  char state[24]; /* "optimal", "infeasible", "invalid", "crashed", "timeout", ...; "": unused */
  int cases;
} ambulo_batch_tally;
enum { AMBULO_BATCH_STATES = 16 };

/* State of a run, for progress. */
typedef struct ambulo_batch_progress {
  int cases;        /* of this shard */
  int done, failed; /* cases with a record; failed: those without a valid solution */
  int no_result; /* of failed: ended without a result (invalid, error, crashed, timeout, memory) */
  int running;
  int resumed;            /* of done: found finished at the start */
  double seconds;         /* since the start */
  double seconds_left;    /* AMBULO_OFF: unknown */
  double worst_violation; /* over the cases solved in this run; AMBULO_OFF: none yet */
  const char *worst;      /* name of that case; NULL: none yet */
  const char *last;       /* name of the case that ended last; NULL: none yet */
  char last_state[24];    /* "optimal", "infeasible", "crashed", "timeout", ... */
  ambulo_batch_tally tally[AMBULO_BATCH_STATES]; /* done, by state, in the order of their first */
  char refusal[480]; /* the first case without a result, its state and first error; "": none */
} ambulo_batch_progress;

typedef struct ambulo_batch_options {
  size_t size;         /* set by ambulo_batch_options_default() */
  const char *program; /* the ambulo program; NULL: /proc/self/exe */
  int workers;         /* processes at once; 0: usable processors, limited by memory */
  int shard, shards;   /* this is shard 1 .. shards */
  double case_seconds; /* kill a case after this; AMBULO_OFF: as the sweep file says, or no limit */
  int case_megabytes;  /* address space of a case; 0: as the sweep file says, or no limit */
  double grace;        /* s that running cases get after a first stop; 30 */
  int force;           /* 1: recompute cases whose inputs changed */
  /* Called a few times a second. 0: go on; 1: start no new case; 2: stop now. NULL: none. */
  int (*progress)(void *user, const ambulo_batch_progress *progress);
  void *user;
} ambulo_batch_options;
AMBULO_TOOL_DEFAULT(ambulo_batch_options);

/* Solves every case of the shard that is not finished in `directory` yet: that has no record, one
 * of other inputs, or files that are not what was written (computed again, with a warning).
 * AMBULO_OK when every case has a record at the end or the caller stopped; *progress (may be NULL)
 * is the final state. A front is solved in rounds, until its points are even
 * (docs/batch-format.md); it has no shards (E_ARGUMENT). Errors: E_IO (folder not readable or not
 * writable, locked by another run: named), E_PROBLEM (the inputs changed since the folder was
 * filled, or a version without checksums filled it, and force is 0: what changed), E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_batch_run(const ambulo_sweep *sweep,
                                                           const char *directory,
                                                           const ambulo_batch_options *options,
                                                           const ambulo_allocator *allocator,
                                                           ambulo_diagnostics *diagnostics,
                                                           ambulo_batch_progress *progress);

/* What a front of terms has become; terms 0: the batch is none. */
typedef struct ambulo_front_census {
  int terms, wanted;
  int points;   /* on the front */
  int left_out; /* another motion is better for their own weights (a local valley), or
                   no worse in every term and better in one */
  int refused;  /* wide gaps of two terms between which no weights lead */
  double largest_gap, mean_gap; /* between neighbours; of three terms to the nearest point. Unit:
                                   the range of a term between the ends of the front */
} ambulo_front_census;

/* What stands in a folder, from its records alone. Errors: E_IO (cannot be read, or the list of
 * cases is damaged), E_PROBLEM (filled by a version without checksums), E_MEMORY. */
typedef struct ambulo_batch_census {
  int cases;
  int done, failed; /* with a record; failed: those of them without a valid solution */
  int no_result;    /* of failed: ended without a result */
  int missing;      /* not computed yet */
  int stale;        /* computed from other inputs */
  int corrupt;      /* finished, but damaged since: not what was written, or cannot be read.
                       ambulo_batch_status sees this of records only */
  double seconds;   /* all cases with a record took together */
  char holder[96];  /* host:pid of the run that holds the folder; "": none */
  ambulo_front_census front; /* filled by ambulo_batch_collect alone */
} ambulo_batch_census;
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_batch_status(const char *directory,
                                                              const ambulo_allocator *allocator,
                                                              ambulo_diagnostics *diagnostics,
                                                              ambulo_batch_census *census);

/* One file of a finished case that is not what was written. Strings live during the call. */
typedef struct ambulo_batch_damage {
  const char *id, *name; /* of the case */
  const char *file;      /* path */
  const char *what;      /* "is not what was written", "cannot open: No such file or directory" */
} ambulo_batch_damage;

/* The same as ambulo_batch_status by reading every file of every finished case and comparing it
 * with the checksum (SHA-256) in the case's record. damaged (may be NULL) is called for the first
 * damaged file of each corrupt case; census may be NULL. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_batch_verify(
    const char *directory, void (*damaged)(void *user, const ambulo_batch_damage *damage),
    void *user, const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
    ambulo_batch_census *census);

/* Writes results.csv and results.jsonl into `directory`: one line per case, sorted by id, the
 * axes and the outputs the sweep file asks for. Idempotent; the same bytes whatever the order
 * in which cases were solved. Of a front, its points are judged, and the lines tell which are on
 * it; warnings tell of gaps that refuse to close. Every file is compared with
 * its checksum; a case of which one is damaged or cannot be read has the state "corrupt", no
 * outputs, a warning that names the file, and is counted in the census. Errors, which leave the
 * tables as they were: as ambulo_batch_status; and a table that cannot be written. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_batch_collect(const char *directory,
                                                               const ambulo_allocator *allocator,
                                                               ambulo_diagnostics *diagnostics,
                                                               ambulo_batch_census *census);

/* Writes the page of a batch folder: its table, plots and motions, also of a batch that still runs.
 * Of the options overwrite and megabytes count. What is damaged, as ambulo_batch_collect does;
 * census may be NULL. Errors: as ambulo_page_write and ambulo_batch_status. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_batch_page(const char *directory,
                                                            const char *output,
                                                            const ambulo_page_options *options,
                                                            const ambulo_allocator *allocator,
                                                            ambulo_diagnostics *diagnostics,
                                                            ambulo_batch_census *census);

/* Processes that ambulo_batch_run would use: workers where > 0, else the usable processors;
 * limited by the free memory with `megabytes` each (0: unknown). */
AMBULO_API int ambulo_batch_workers(int workers, int megabytes);

#ifdef __cplusplus
}
#endif
#endif
