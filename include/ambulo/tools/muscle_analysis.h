/* ambulo/tools/muscle_analysis.h - activations, contact forces and metabolic power of a motion
 * (docs/guide-muscles.md).
 *
 * The motion is a table of `ambulo solve` (motion.csv) or of `ambulo inverse`: columns q.*, qd.*,
 * qdd.* and tau.* of every coordinate, and grf.FOOT.x|y|z where the ground pushes. At each row the
 * torques are shared among the muscles (ambulo/muscles.h). Rates of torques, which stretch elastic
 * tendons, are differences over at least 20 ms.
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_MUSCLE_ANALYSIS_H
#define AMBULO_TOOLS_MUSCLE_ANALYSIS_H

#include "ambulo/muscles.h"
#include "ambulo/solve.h"
#include "ambulo/tools/common.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ambulo_muscle_options {
  size_t size;          /* set by ambulo_muscle_options_default() */
  double activation;    /* prices of the sharing: ambulo_sharing */
  double metabolic;     /* 0 */
  double reserve;       /* 0.2 */
  int by_volume;        /* 1 */
  double resting_power; /* of what no muscle of the model uses, W per kg of the body; 1.2 */
} ambulo_muscle_options;
AMBULO_TOOL_DEFAULT(ambulo_muscle_options);

typedef struct ambulo_muscle_analysis ambulo_muscle_analysis;

/* n rows, m muscles, d coordinates of the model, j joints that muscles pull across. */
typedef struct ambulo_muscle_values {
  size_t size;
  int rows, joints;
  const double *times;         /* [n] s */
  const double *activation;    /* [n][m] */
  const double *force;         /* [n][m] along the tendon, N */
  const double *fiber_length;  /* [n][m] l_o */
  const double *fiber_speed;   /* [n][m] l_o/s */
  const double *metabolic;     /* [n][m] W, by Bhargava et al. (2004) */
  const double *reserve;       /* [n][d] torque that no muscle supplies, N m */
  const char *const *joint;    /* [j] names */
  const double *contact;       /* [n][j][3] force on what lies below, axes of the link above, N */
  const double *between_links; /* [n][j][3] the same without muscles: intersegmental force, N */
  double body_weight;          /* N, without what is carried */
  double distance;             /* of the centre of mass along forward, m */
  /* gross, W per kg of the body: means over time */
  double bhargava, umberger;
} ambulo_muscle_values;

/* `motion`: the table. `options` (NULL: the defaults), `allocator` and `diagnostics` may be NULL.
 * `muscles` must outlive the analysis. A coordinate beyond the range of a muscle's path, and a
 * reserve of more than 5 % of a coordinate's largest torque, are warned of. Errors: E_ARGUMENT,
 * E_IO, E_PARSE, E_SCHEMA, E_LIMIT, E_NUMERIC, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_muscle_analysis_create(
    const ambulo_muscles *muscles, const char *motion, const ambulo_muscle_options *options,
    const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
    ambulo_muscle_analysis **analysis);
/* Of a result: what the above finds in its motion.csv of so many `samples` (0: the nodes) with the
 * default options. `muscles` are of a body with the problem's coordinates; NULL: those of the
 * problem. *analysis is NULL where there are none, and, after a warning, where the motion is not
 * finite. Errors: E_ARGUMENT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_muscle_analysis_of_result(
    const ambulo_problem *problem, const ambulo_result *result, const ambulo_muscles *muscles,
    int samples, const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
    ambulo_muscle_analysis **analysis);
AMBULO_API void ambulo_muscle_analysis_free(ambulo_muscle_analysis *analysis); /* accepts NULL */
/* Belongs to the analysis. */
AMBULO_API const ambulo_muscle_values *
ambulo_muscle_analysis_values(const ambulo_muscle_analysis *analysis);

/* Writes the table: time, activation.M, force.M, fiber_length.M, fiber_speed.M, metabolic.M of each
 * muscle, reserve.C of each coordinate that muscles span, contact.J.x|y|z of each joint; CSV, or in
 * OpenSim's form where the name ends in .sto. Whole or not at all; overwrite = 0 refuses a file
 * that ambulo did not write, and the motion even if it did. E_ARGUMENT, E_IO, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_muscle_analysis_write(const ambulo_muscle_analysis *analysis, const char *output,
                             int overwrite, ambulo_diagnostics *diagnostics);
/* The summary as JSON, to be freed with ambulo_text_free. E_ARGUMENT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_muscle_analysis_json(
    const ambulo_muscle_analysis *analysis, const ambulo_allocator *allocator, char **text);

#ifdef __cplusplus
}
#endif
#endif
