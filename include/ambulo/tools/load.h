/* ambulo/tools/load.h - models, problems and solutions from files (docs/problem-format.md,
 * docs/model-format.md).
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_LOAD_H
#define AMBULO_TOOLS_LOAD_H

#include "ambulo/again.h"
#include "ambulo/muscles.h"
#include "ambulo/parameters.h"
#include "ambulo/tools/common.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------- models */

/* The person a model is scaled to. */
typedef enum ambulo_sex {
  AMBULO_SEX_NOT_SET = 0, /* as in the file */
  AMBULO_FEMALE,
  AMBULO_MALE
} ambulo_sex;
typedef struct ambulo_subject {
  size_t size;    /* set by ambulo_subject_default() */
  double mass;    /* kg; AMBULO_OFF: as in the file */
  double stature; /* m; AMBULO_OFF: as in the file */
  ambulo_sex sex;
} ambulo_subject;
AMBULO_TOOL_DEFAULT(ambulo_subject); /* all as in the file */

/* Loads a model file, or text that is already in memory (`name` then stands for
 * the file in messages). `subject`, `allocator`, `diagnostics` may be NULL.
 * Errors: E_IO, E_PARSE, E_SCHEMA, E_MODEL, E_LIMIT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_model_load(const char *path,
                                                            const ambulo_subject *subject,
                                                            const ambulo_allocator *allocator,
                                                            ambulo_diagnostics *diagnostics,
                                                            ambulo_model **model);
/* ambulo_model_load with values of the file replaced before it is read: overrides[i] is
 * "path=value" ("links[shank_r].body.mass=4.1"; as in a problem's overrides the path may begin with
 * "model."). Errors: also E_ARGUMENT (an override that is none). */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_model_load_with(const char *path, const char *const *overrides, int override_count,
                       const ambulo_subject *subject, const ambulo_allocator *allocator,
                       ambulo_diagnostics *diagnostics, ambulo_model **model);
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_model_load_text(
    const char *text, size_t length, const char *name, const ambulo_subject *subject,
    const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics, ambulo_model **model);

/* ------------------------------------------------------------------ muscles */

/* Muscles of a file, on a model that has their coordinates and links under the same names; lengths
 * are scaled with its legs, forces with its mass (docs/muscles-format.md). `model` must outlive
 * them; `allocator` and `diagnostics` may be NULL. Errors: as ambulo_model_load and
 * ambulo_muscles_create. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_muscles_load(const char *path,
                                                              const ambulo_model *model,
                                                              const ambulo_allocator *allocator,
                                                              ambulo_diagnostics *diagnostics,
                                                              ambulo_muscles **muscles);

/* ----------------------------------------------------------------- problems */

/* From a file; the model it names is loaded with it and owned by the problem. A name of a model or
 * a reference that is not beside the file is looked for below the folder that the environment calls
 * AMBULO_MODELS, if it is set, which a note says.
 * overrides[i] is "path=value" ("time.intervals=36"), applied before anything is
 * read. Errors: as ambulo_model_load and ambulo_problem_create. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_load(
    const char *path, const char *const *overrides, int override_count,
    const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics, ambulo_problem **problem);
/* The files that a problem was read from, with their SHA-256, as sha256sum writes and checks them:
 * a line "<64 digits>  <path>" each. "" of a problem made without files; lives as long as the
 * problem.
 */
AMBULO_API const char *ambulo_problem_inputs(const ambulo_problem *problem);
/* The text of a problem file that is in memory already. */
typedef struct ambulo_problem_text {
  size_t size; /* set by ambulo_problem_text_default() */
  const char *text;
  size_t length;
  const char *name;      /* stands for the file in messages */
  const char *directory; /* where relative file names in the text start; NULL: the current one */
  const char *const *overrides; /* [override_count] "path=value" */
  int override_count;
} ambulo_problem_text;
AMBULO_TOOL_DEFAULT(ambulo_problem_text); /* empty */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_problem_load_text(const ambulo_problem_text *text, const ambulo_allocator *allocator,
                         ambulo_diagnostics *diagnostics, ambulo_problem **problem);

/* ---------------------------------------------------------------- solutions */

/* Reads a solution.yaml into x [variable_count of problem]. A solution on another
 * grid or basis of the same model and duration is carried over. Errors: E_IO,
 * E_PARSE, E_SCHEMA, E_PROBLEM (other coordinates), E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solution_load(const char *path,
                                                               const ambulo_problem *problem,
                                                               const ambulo_allocator *allocator,
                                                               ambulo_diagnostics *diagnostics,
                                                               double *x);

/* The same as a start for the solver: a solution of another duration is stretched in time. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solution_start(const char *path,
                                                                const ambulo_problem *problem,
                                                                const ambulo_allocator *allocator,
                                                                ambulo_diagnostics *diagnostics,
                                                                double *x);

/* The same from one period of the motion, repeated as often as its duration goes into the
 * problem's (rounded; then stretched): a step is followed by its mirror image
 * (AMBULO_ENDS_MIRRORED), a stride by itself (AMBULO_ENDS_PERIODIC), each carried on by what the
 * period carries the root. E_ARGUMENT for other ends. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solution_repeat(
    const char *path, const ambulo_problem *problem, ambulo_ends ends,
    const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics, double *x);

/* The multipliers in a solution.yaml (ambulo_options.multipliers), for a problem that starts from
 * its motion by ambulo_solution_start, or by ambulo_solution_repeat where `ends` are not free.
 * *multipliers becomes NULL where the file has none. Errors: E_IO, E_PARSE, E_SCHEMA, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_solution_multipliers(const char *path, const ambulo_problem *problem, ambulo_ends ends,
                            const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                            ambulo_multipliers **multipliers);

/* The start of a gait of several steps from one of them (of unlike steps: from two), which is
 * solved with these options (NULL: the defaults) and repeated. It takes half of a time limit at
 * most; its progress has the stage "one step". *multipliers becomes NULL, and x [variable_count] is
 * not touched, where there is no such start: no `gait` of several steps that repeats, references,
 * tubes, reaches, obstacles, loads or profiles over time, several starts, fewer than 8 intervals a
 * step, or a step without a solution. Errors: E_ARGUMENT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_start_from_step(const ambulo_problem *problem,
                                                                 const ambulo_options *options,
                                                                 const ambulo_allocator *allocator,
                                                                 double *x,
                                                                 ambulo_multipliers **multipliers);

/* --------------------------------------------------------------------- files */

/* What a YAML file is, by its key `kind`. */
typedef enum ambulo_file_kind {
  AMBULO_FILE_UNKNOWN = 0,
  AMBULO_FILE_MODEL,
  AMBULO_FILE_PROBLEM
} ambulo_file_kind;
/* Errors: E_IO, E_PARSE, E_SCHEMA (another kind, or none), E_LIMIT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_file_kind_of(const char *path,
                                                              const ambulo_allocator *allocator,
                                                              ambulo_diagnostics *diagnostics,
                                                              ambulo_file_kind *kind);

#ifdef __cplusplus
}
#endif
#endif
