/* ambulo/tools/report.h - results and motions on disk (docs/results.md).
 *
 * Writers produce whole files or nothing: temporary name, fsync, rename.
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_REPORT_H
#define AMBULO_TOOLS_REPORT_H

#include "ambulo/muscles.h"
#include "ambulo/tools/inverse.h"
#include "ambulo/sensitivity.h"
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
  const ambulo_sensitivity_list *sensitivities; /* NULL: summary.json has none */
  const char *inputs; /* ambulo_problem_inputs of the problem that this one was made from; NULL: of
                         this one */
  const ambulo_muscles *muscles; /* who makes the motion: of a body with the problem's coordinates;
                                    NULL: those of the problem, if it has any */
} ambulo_report_options;
AMBULO_TOOL_DEFAULT(ambulo_report_options);

/* E_IO now if ambulo_report_write could not write `directory` later (it exists
 * and overwrite is 0; its parent is missing or not writable). `options` and `diagnostics`
 * may be NULL: the defaults, no messages; here and below. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_report_check(const char *directory,
                                                              const ambulo_report_options *options,
                                                              ambulo_diagnostics *diagnostics);

/* Writes summary.json, motion.csv, motion.sto, solution.yaml, gait.svg, scene.json and, with
 * muscles, muscles.csv into `directory`, all or nothing. Muscles of a motion that is not finite are
 * left out with a warning. Errors: E_ARGUMENT, E_IO, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_report_write(const ambulo_problem *problem,
                                                              const ambulo_result *result,
                                                              const char *directory,
                                                              const ambulo_report_options *options,
                                                              const ambulo_allocator *allocator,
                                                              ambulo_diagnostics *diagnostics);

/* The text of summary.json; free with ambulo_text_free. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_report_summary(
    const ambulo_problem *problem, const ambulo_result *result,
    const ambulo_report_options *options, const ambulo_allocator *allocator, char **text);

/* The versions of what is running, as text; engine: a checksum of its sources, which tells builds
 * of one version apart. */
typedef struct ambulo_versions {
  char ambulo[24], nlopt[24], libyaml[24], blas[64], instruction_set[24], engine[24];
} ambulo_versions;
AMBULO_API void ambulo_versions_get(ambulo_versions *versions);

/* The result of a solve of `problem` that its caller does not wait for: NLopt's SLSQP, say, is deep
 * in a dense matrix and asks nobody. `last` is a copy of its last progress, with a copy of its
 * point (NULL: the start pose). What a limit of time or a stop of the caller would have made of
 * that point: judged by its values alone, without derivatives. May be called in another thread
 * while the solve goes on. `ending`: AMBULO_ENDING_TIME or AMBULO_ENDING_CALLER. E_ARGUMENT,
 * E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_audit_progress(
    const ambulo_problem *problem, const ambulo_options *options, const ambulo_progress *last,
    ambulo_ending ending, const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
    ambulo_result **result);

#ifdef __cplusplus
}
#endif
#endif
