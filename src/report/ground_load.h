/* report/ground_load.h - measured forces on the feet, applied to an inverse dynamics.
 *
 * A foot's load is a force f at a point p of the ground and a free torque m, world axes. It
 * changes the generalized force of each coordinate between the foot and the world by
 *
 *     revolute   - z . (m + (p - o) x f)        prismatic   - z . f
 *
 * with z and o the joint's axis and a point on it: the z axis and the origin of the parent's
 * frame (the DH transform begins with the joint's own motion). What is left at the root is the
 * residual: zero when motion, masses and forces agree. */
#ifndef AMBULO_REPORT_GROUND_LOAD_H
#define AMBULO_REPORT_GROUND_LOAD_H

#include "ambulo/report.h"
#include "base/alloc.h"
#include "base/diagnostics.h"

typedef struct ambulo__ground_load {
  ambulo_allocator allocator;
  int rows, feet;
  int has_points;                 /* 0: every point and torque in the file is zero */
  double *force, *point, *torque; /* [rows][feet][3], N, m, N m */
} ambulo__ground_load;

/* The file's forces at times[rows], linearly between its own. Columns of a foot whose name
 * begins with s (l or r): ground_force_s_vx|vy|vz, ground_force_s_px|py|pz,
 * ground_torque_s_x|y|z, or grf.NAME.x|y|z, cop.NAME.x|y|z, free_moment.NAME; points and torques
 * that are missing count as zero. Errors: those of ambulo__motion_read, E_SCHEMA (no force column,
 * times not covered), E_MEMORY. Fills *load, which ambulo__ground_load_free releases. */
ambulo_status ambulo__ground_load_read(const ambulo_model *model, const char *path,
                                       const double *times, int rows,
                                       const ambulo_allocator *allocator,
                                       ambulo_diagnostics *diagnostics, ambulo__ground_load *load);
void ambulo__ground_load_free(ambulo__ground_load *load); /* accepts a zero-filled one */

/* Puts every foot's force at points[rows][3] (the zero-moment points) when the file has none;
 * rows without a finite one keep zero. */
void ambulo__ground_load_place(ambulo__ground_load *load, const double *points);

/* tau [rows][d] changes as above; q [rows][d]. E_MEMORY. */
ambulo_status ambulo__ground_load_apply(const ambulo__ground_load *load, const ambulo_model *model,
                                        const double *q, double *tau);

/* wrench [rows][6] and zmp [rows][3] of the inverse dynamics without the load. */
void ambulo__ground_load_residual(const ambulo__ground_load *load, const ambulo_model *model,
                                  const double *times, const double *wrench, const double *zmp,
                                  ambulo_ground_residual *residual);

#endif
