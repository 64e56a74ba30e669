/* people/ground_load.h - measured forces on the feet, applied to an inverse dynamics.
 *
 * The load of a foot is a force f and its moment m about the world's origin: p x f + t of a point p
 * and a free torque t, or what the file says of it ("moment.FOOT.x", as ambulo writes it: a force
 * without a normal part has no point, and may have a moment). Both are linear between the rows of
 * the file; points are not, for a foot in the air has none. A load changes the generalized force of
 * each coordinate between the foot and the world by
 *
 *     revolute   - z . (m - o x f)        prismatic   - z . f
 *
 * with z and o the joint's axis and a point on it: the z axis and the origin of the parent's
 * frame (the DH transform begins with the joint's own motion). What is left at the root is the
 * residual: zero when motion, masses and forces agree. */
#ifndef AMBULO_PEOPLE_GROUND_LOAD_H
#define AMBULO_PEOPLE_GROUND_LOAD_H

#include "ambulo/tools/inverse.h"
#include "people/plausibility.h"
#include "people/force_columns.h"

typedef struct ambulo__ground_load {
  ambulo_allocator allocator;
  int rows, feet;
  double *force, *moment;  /* [rows][feet][3], N, N m about the origin */
  double *loose;           /* [rows][feet][3], N: the part of `force` that has no points yet and no
                              part in `moment` but for its free torque */
  unsigned char *is_loose; /* [feet] */
} ambulo__ground_load;

/* Where the loads come from. */
typedef struct ambulo__load_source {
  const ambulo_model *model;
  const char *file;
  const ambulo__motion *table; /* what was read of it already; NULL: read it */
  const ambulo_inverse_options *options;
  const double *times; /* [rows], s: when they are wanted */
  int rows;
  ambulo__doubts *doubts;
} ambulo__load_source;

/* Loads at times[rows] from the columns that force_columns.h finds and matches. A row without a
 * point (nan, or 0 0 0 where others have one) takes the nearest in time that has one while the
 * force is less than a twentieth of the body weight; beyond that nan is an error, and zeros are
 * doubted. A foot whose points are all missing is `loose`. Errors: those of
 * ambulo__motion_read, E_SCHEMA, E_ARGUMENT (map), E_MEMORY. Fills *load, which
 * ambulo__ground_load_free releases. */
ambulo_status ambulo__ground_load_read(const ambulo__load_source *source,
                                       const ambulo_allocator *allocator,
                                       ambulo__ground_load *load);
void ambulo__ground_load_free(ambulo__ground_load *load); /* accepts a zero-filled one */

/* Whether the table covers the times; E_SCHEMA. Rows that are hardly that far apart are doubted. */
ambulo_status ambulo__load_times_check(const ambulo__load_source *source,
                                       const ambulo__motion *table);
/* values [table rows][width] at a time (s) that the table covers, linearly between its rows, whose
 * times are in units of `unit` seconds. */
void ambulo__load_between(const ambulo__motion *table, double unit, const double *values, int width,
                          double time, double *out);

/* ------------------------------------------------------ applying (load_apply.c) */

/* The poses of the rows, as far as loads need them. */
typedef struct ambulo__load_poses {
  double *center; /* [rows][3]: centre of mass, m */
  double *foot;   /* [rows][feet][3]: middle between heel and toe centre, m */
} ambulo__load_poses;

/* Gives the loose forces a place: points[rows][3], the zero-moment points, or the middle of the
 * foot in rows without a finite one. */
void ambulo__ground_load_place(ambulo__ground_load *load, const ambulo__load_poses *poses,
                               const double *points);
/* Fills poses from q [rows][d]. E_MEMORY. */
ambulo_status ambulo__load_poses_fill(const ambulo_model *model, const double *q, int rows,
                                      const ambulo_allocator *allocator, ambulo__load_poses *poses);
/* What a force and its moment about the origin have along or about the axis of the joint of `link`:
 * z . (m - o x f) or z . f; frames [links][12] of a pose. */
double ambulo__load_share(const ambulo_model *model, const double *frames, int link,
                          const double *force, const double *moment);
/* tau [rows][d] changes as above; q [rows][d]. E_MEMORY. */
ambulo_status ambulo__ground_load_apply(const ambulo__ground_load *load, const ambulo_model *model,
                                        const double *q, double *tau);

/* tau [d] of one pose q [d] loses what a force on `link` and its moment about the world's origin
 * come to; frames [links][12] (mechanics/pose.h). */
void ambulo__load_take(const ambulo_model *model, const double *frames, int link, const double *q,
                       const double force[3], const double moment[3], double *tau);

/* Centres of pressure cop [rows][feet][3] on the plane up . r = height (nan where the ground does
 * not push) and free moments [rows][feet] about the normal. */
void ambulo__ground_load_pressure(const ambulo__ground_load *load, const ambulo_model *model,
                                  double height, double *cop, double *free_moment);

/* What is left of wrench [rows][6] (M about the origin, F): residual [rows][6], F first, then M
 * about center[rows][3]; and its summary with zmp [rows][3]. */
void ambulo__ground_load_residual(const ambulo__ground_load *load, const ambulo_model *model,
                                  const double *times, const double *wrench, const double *zmp,
                                  const double *center, double *rows_residual,
                                  ambulo_ground_residual *residual);

#endif
