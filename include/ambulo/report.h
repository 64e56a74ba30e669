/* ambulo/report.h - results and motions on disk (docs/results.md).
 *
 * Writers produce whole files or nothing: temporary name, fsync, rename.
 */
#ifndef AMBULO_REPORT_H
#define AMBULO_REPORT_H

#include "ambulo/inverse.h"
#include "ambulo/solve.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ambulo_report_options {
  size_t size;       /* set by ambulo_report_options_default() */
  int samples;       /* times in motion.csv; 0: the nodes */
  int overwrite;     /* 1: replace an existing result folder */
  const char *norms; /* folder of the shipped curves of people (models/norms), drawn behind those of
                        a walk in gait.svg; NULL: none */
} ambulo_report_options;
AMBULO_DEFAULT(ambulo_report_options);

/* E_IO now if ambulo_report_write could not write `directory` later (it exists
 * and overwrite is 0; its parent is missing or not writable). `options` and `diagnostics`
 * may be NULL: the defaults, no messages; here and below. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_report_check(const char *directory,
                                                              const ambulo_report_options *options,
                                                              ambulo_diagnostics *diagnostics);

/* Writes summary.json, motion.csv, motion.sto, solution.yaml and gait.svg into
 * `directory`, all or nothing. Errors: E_ARGUMENT, E_IO, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_report_write(const ambulo_problem *problem,
                                                              const ambulo_result *result,
                                                              const char *directory,
                                                              const ambulo_report_options *options,
                                                              const ambulo_allocator *allocator,
                                                              ambulo_diagnostics *diagnostics);

/* The text of summary.json; free with ambulo_text_free. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_report_summary(const ambulo_problem *problem,
                                                                const ambulo_result *result,
                                                                const ambulo_allocator *allocator,
                                                                char **text);
AMBULO_API void ambulo_text_free(char *text, const ambulo_allocator *allocator);

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

/* ------------------------------------------------ comparison with people */

/* How a result folder is scored against normative curves (docs/compare.md). */
typedef struct ambulo_compare_options {
  size_t size;        /* set by ambulo_compare_options_default() */
  const char *map;    /* column map file; NULL: the built-in one of the layout */
  const char *curves; /* names separated by commas: only these; NULL: all */
  const char *foot;   /* "left" or "right": this one alone; NULL: the mean of both where
                         they are alike */
  double pelvic_tilt; /* rad, added to hip flexion and anterior tilt where the reference's
                         pelvis is tilted; 11.4 degrees */
  double strike;      /* s, heel strike of `foot` (left when NULL); AMBULO_OFF: from the folder */
  double mass;        /* kg; AMBULO_OFF: from the folder */

  /* Of a person's own motion, a file in place of the folder: its ground forces (NULL: none), whose
   * columns are on which foot ("left=NAME,right=NAME"; NULL: by their names), and when heels strike
   * ("left=0.1,1.2;right=0.6,1.7"; NULL, or a side left out: found). */
  const char *forces, *force_columns, *strikes;
  /* File for the curves over the cycle, mean and deviation of the strides, in a layout of
   * references; NULL: none. Of files that are there only ambulo's own are replaced, with
   * `overwrite` all. */
  const char *cycles;
  int overwrite;
} ambulo_compare_options;
AMBULO_DEFAULT(ambulo_compare_options);

/* One curve over the cycle. Strings belong to the comparison. */
typedef struct ambulo_curve_score {
  const char *name;       /* "knee_flexion" */
  const char *unit;       /* "deg", "N m/kg", "N/kg", "W/kg" */
  int points;             /* of the reference */
  double rmse;            /* in the unit */
  double r;               /* Pearson's; NaN for a constant curve */
  double within_2sd;      /* share of the points, 0 to 1; NaN: the reference has no deviation */
  double peak, peak_time; /* largest value where the reference is, and percent of the cycle */
  double reference_peak, reference_peak_time;
  const char *source; /* the people, as the reference's line "# source: ..." names them; or NULL */
} ambulo_curve_score;

/* A number that gait tables quote: "knee swing peak", "vertical force valley". */
typedef struct ambulo_landmark {
  const char *name, *unit;
  double value;
  double time; /* percent of the cycle; NaN: not tied to one */
} ambulo_landmark;

typedef struct ambulo_comparison ambulo_comparison;

/* Scores motion.csv of a result folder, or (`directory` is a file) a person's own motion, CSV, STO
 * or MOT with columns of OpenSim or Plug-in Gait, against a CSV of normative curves. `options`
 * (NULL: the defaults), `allocator` and `diagnostics` may be NULL. Curves that only one of the two
 * has are left out. Errors: E_ARGUMENT, E_IO, E_PARSE, E_SCHEMA (with file, line and column; also
 * when no curve is left), E_LIMIT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_compare(const char *directory,
                                                         const char *reference,
                                                         const ambulo_compare_options *options,
                                                         const ambulo_allocator *allocator,
                                                         ambulo_diagnostics *diagnostics,
                                                         ambulo_comparison **comparison);
/* The same against the shipped curves of people in the folder `norms` (models/norms): angles of its
 * young_adults.csv, moments and forces of its normal_cadence.csv. The motion has to be a walk:
 * E_SCHEMA for one in which no foot strikes. E_ARGUMENT with a map of the options. */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_compare_norms(const char *directory, const char *norms,
                     const ambulo_compare_options *options, const ambulo_allocator *allocator,
                     ambulo_diagnostics *diagnostics, ambulo_comparison **comparison);
AMBULO_API void ambulo_comparison_free(ambulo_comparison *comparison); /* accepts NULL */
AMBULO_API int ambulo_comparison_curve_count(const ambulo_comparison *comparison);
AMBULO_API const ambulo_curve_score *ambulo_comparison_curve(const ambulo_comparison *comparison,
                                                             int index); /* NULL: out of range */
AMBULO_API int ambulo_comparison_landmark_count(const ambulo_comparison *comparison);
AMBULO_API const ambulo_landmark *ambulo_comparison_landmark(const ambulo_comparison *comparison,
                                                             int index);
/* {"curves": {name: {"rmse", "r", "within_2sd", "peak", "peak_time", "source"}}}, the last where
 * there is one; free with ambulo_text_free. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_comparison_json(
    const ambulo_comparison *comparison, const ambulo_allocator *allocator, char **text);

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

/* The versions of what is running, as text. */
typedef struct ambulo_versions {
  char ambulo[24], nlopt[24], libyaml[24], blas[64], instruction_set[24];
} ambulo_versions;
AMBULO_API void ambulo_versions_get(ambulo_versions *versions);

#ifdef __cplusplus
}
#endif
#endif
