/* ambulo/tools/inverse.h - inverse dynamics of motions in files (docs/guide-inverse.md).
 *
 * A motion is a table (CSV, STO or MOT) with a column `time` and one for each coordinate of the
 * model. Its torques, its root wrench, its zero-moment point and the power of its joints are
 * written as another table. Units: SI and radians, whatever the file's; axes: the world's.
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_INVERSE_H
#define AMBULO_TOOLS_INVERSE_H

#include "ambulo/mechanics.h"
#include "ambulo/tools/common.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ambulo_angle_unit {
  AMBULO_ANGLES_OF_FILE = 0, /* as the file states ("inDegrees=yes"); radians when it does not */
  AMBULO_ANGLES_DEGREES,
  AMBULO_ANGLES_RADIANS
} ambulo_angle_unit;

/* How a motion and the forces on its feet are read. Strings are borrowed during the call. */
typedef struct ambulo_inverse_options {
  size_t size; /* set by ambulo_inverse_options_default() */

  const char *forces; /* file of forces on the feet; NULL: the columns grf.FOOT.* of the motion
                         itself, where it has some */
  int without_forces; /* 1: none at all, whatever the files have; those of hands neither */
  int other_forces;   /* 1: feet are not all that is pushed, and the caller knows: columns of forces
                         on other bodies and what is left over at the root are not doubted */
  /* Which columns belong to which foot, "left=ground_force_1,right=ground_force_2+ground_force_3",
   * "right=none", or, as an OpenSim file of external loads says it, the beginnings of the columns
   * of force, point and torque: "left=ground_force_1_v:ground_force_1_p:ground_torque_1_". Feet
   * that it leaves out are matched by names. NULL: all by names. */
  const char *force_columns;

  ambulo_angle_unit angles;      /* of the motion; rates and accelerations alike */
  double length_unit, time_unit; /* of the motion, in m and s: 0.001 for mm and ms; 1 */
  double force_length_unit;      /* of the forces' points, torques in N times it; 1 */
  double force_time_unit;        /* of the file `forces`; 1 */

  /* Low-pass filters, Hz; AMBULO_OFF: none. Zero-lag Butterworth, forward and backward in time, -3
   * dB at the cut-off after both (Winter 2009, with the correction for two passes); of the motion's
   * values (its rates and accelerations are then computed from them), and of the forces and their
   * moments. Rows must be equally spaced in time. */
  double cutoff, force_cutoff;
  int filter_order; /* of the whole filter: 2, 4, 6 or 8; 4 */

  int recompute_rates; /* 1: rates and accelerations from the values even where the file has them */
  double ground_height; /* of the plane of the zero-moment point, m along up; 0 */
  double from, to;      /* s: rows of the motion that are used; AMBULO_OFF: from its first, to its
                           last. Rates and filters are those of the whole motion */
  int strict;           /* 1: what is only doubted, a warning otherwise, is an error (E_SCHEMA) */
  int overwrite;        /* 1: write over an input, and over what ambulo did not write */
} ambulo_inverse_options;
AMBULO_TOOL_DEFAULT(ambulo_inverse_options);

/* What the forces leave over of the root wrench; axes: forward, up, left. */
typedef struct ambulo_ground_residual {
  double force_rms[3];           /* body weights */
  double moment_rms;             /* about horizontal axes through the zero-moment point, body
                                    weights m; NaN: some foot has neither points nor torques */
  double vertical_impulse;       /* that the motion needs, N s (trapezoidal over the rows) */
  double given_vertical_impulse; /* of the forces, N s (likewise) */
} ambulo_ground_residual;

/* Where results besides the table go; NULL: not asked for. */
typedef struct ambulo_inverse_outputs {
  size_t size;                      /* set by ambulo_inverse_outputs_default() */
  ambulo_ground_residual *residual; /* untouched without forces */
  char **text;                      /* the table, where there is no file for it */
} ambulo_inverse_outputs;
AMBULO_TOOL_DEFAULT(ambulo_inverse_outputs); /* NULL */

/* Inverse dynamics of the file `motion`. Coordinates go by name ("NAME", "q.NAME",
 * ".../NAME/value",
 * ".../NAME"), rates ("qd.NAME", "NAME_u", ".../NAME/speed") and accelerations ("qdd.NAME",
 * ".../NAME/accel") are used where the file has them; those it lacks come from an interpolating
 * spline of degree 5 (3 with fewer than 6 rows; at least 4 rows) through the rates or the values.
 * Coordinates it lacks are zero, with a warning. Forces on the feet, if any, are taken off the
 * torques, so that tau of the root is what they leave over; they are interpolated linearly as
 * force and moment about the origin, never as centres of pressure, and where their file is shorter
 * than the motion, the rows of the common time are used, with a warning; moment.FOOT.x|y|z, where a
 * file has all three, are those moments. Forces and moments of hands on what they hold or push
 * (held.LOAD.POINT.force.x|y|z, held.LOAD.POINT.moment.x|y|z; ambulo/hold.h), of the motion or else
 * of the file of forces, are added to the torques and to the root wrench.
 *
 * Writes a CSV to `output` (whole or not at all), or returns its text in *outputs->text, to be
 * freed with ambulo_text_free, when output is NULL. Columns, in this order:
 *   time
 *   q.*, qd.*, qdd.*, tau.*          per coordinate; N m or N
 *   zmp.x|y|z                        nan where the body does not press down
 *   grf.F.x|y|z, cop.F.x|y|z, free_moment.F, moment.F.x|y|z    per foot F, as applied, moments
 *                                              about the world origin; only with forces
 *   held.L.P.force.x|y|z, held.L.P.moment.x|y|z, held.L.power   per hand P of a load L, as applied;
 *                                              only where hands hold something
 *   wrench.force.x|y|z, wrench.moment.x|y|z    root wrench: what all the surroundings apply; moment
 *                                              about the world origin, N m
 *   residual.force.x|y|z, residual.moment.x|y|z   root wrench less the forces on the feet; moment
 *                                              about the centre of mass; only with forces
 *   power.*                          tau qd of each coordinate, W
 *
 * Units that hardly can be meant (angles, lengths, times), rates that contradict the values,
 * another body than the motion's, forces that act far from their foot and a residual of more than
 * a tenth of the body weight are warned of, with the option that mends it. `options` (NULL: the
 * defaults), `allocator`, `diagnostics` and, with an output, `outputs` may be NULL. Errors:
 * E_ARGUMENT, E_IO (also: output is an input, or a file that ambulo did not write, and overwrite is
 * 0), E_PARSE, E_SCHEMA, E_LIMIT, E_NUMERIC, E_MEMORY; outputs are then untouched. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_inverse_dynamics_motion(
    const ambulo_model *model, const char *motion, const char *output,
    const ambulo_inverse_options *options, const ambulo_allocator *allocator,
    ambulo_diagnostics *diagnostics, const ambulo_inverse_outputs *outputs);

#ifdef __cplusplus
}
#endif
#endif
