/* ambulo/tools/compare.h - motions scored against those of people (docs/compare.md).
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_COMPARE_H
#define AMBULO_TOOLS_COMPARE_H

#include "ambulo/tools/load.h"

#ifdef __cplusplus
extern "C" {
#endif

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
AMBULO_TOOL_DEFAULT(ambulo_compare_options);

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

#ifdef __cplusplus
}
#endif
#endif
