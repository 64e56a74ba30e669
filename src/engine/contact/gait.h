/* contact/gait.h - from a problem definition to constraint rows.
 *
 * One function a family; each appends its rows for all nodes in node order. All take
 * the same frame. Axes: up n, forward f, left l = n x f; ground plane n . r = h.
 *
 * Reading order: channels.h, row_kind.h, row_table.h, gait.h, phases.h, schedule.c, expand.c,
 * ends.c; bounded.h; then a family of rows each: ground.c, foot_strike.c, contact_tube.c,
 * clearance.c, feet_apart.c, zmp.c, sharing.c, limits.c, tube.c; segments.h, segment_box.h,
 * solid.h, collision.h, collision_pairs.c, collision_rows.c.
 */
#ifndef AMBULO_CONTACT_GAIT_H
#define AMBULO_CONTACT_GAIT_H

#include "base/diagnostics.h"
#include "contact/channels.h"
#include "contact/row_table.h"
#include "model/model.h"
#include "trajectory/basis.h"

typedef struct ambulo__gait_context {
  const ambulo_problem_definition *definition;
  const ambulo_model *model;
  const ambulo__basis *basis;
  ambulo__channels channels;
  const double *times; /* [nodes] */
  int nodes;
  const int *active; /* [nodes][feet]: contact index or -1 */
  const int *before; /* [nodes][feet]: just before the node, where that counts too; NULL: nowhere */
} ambulo__gait_context;

/* When step `step` of a regular walk strikes (s), and how far its foothold is from that of step 0
 * (m). */
double ambulo__gait_strike(const ambulo_gait *gait, int step);
double ambulo__gait_place(const ambulo_gait *gait, int step);

/* Checks contacts (known feet, from < to, no overlap on one foot, inside [0, T]) and
 * fills active[nodes][feet]. Every node needs support when penetration, strike or ZMP
 * rows are asked for. Footholds further apart than the legs can span are refused.
 * Errors name foot, times and lengths. */
ambulo_status ambulo__schedule_fill(const ambulo_problem_definition *definition,
                                    const double *times, int nodes, int *active,
                                    ambulo_diagnostics *diagnostics);
/* On a grid on events: before[nodes][feet], the contact just before each node (the first: at it).
 */
void ambulo__schedule_before(const ambulo_problem_definition *definition, const double *times,
                             int nodes, const int *active, int *before);
ambulo_status ambulo__schedule_check_reach(const ambulo_problem_definition *definition,
                                           const double *times, int nodes, const int *active,
                                           ambulo_diagnostics *diagnostics);

/* End values against limits, against each other (periodic, mirrored) and against the ground;
 * speeds that the ends demand against speed limits. Errors: E_PROBLEM, E_MEMORY. */
ambulo_status ambulo__ends_check(const ambulo_problem_definition *definition, int nodes,
                                 const int *active, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics);

/* Footholds at the end of a repeating motion against those at its beginning. E_PROBLEM. */
ambulo_status ambulo__schedule_check_ends(const ambulo_problem_definition *definition,
                                          ambulo_diagnostics *diagnostics);

/* With mirrored ends: the body is its own mirror image, the limits of partners have something in
 * common, tubes are as wide on both sides. E_PROBLEM, each difference with both names and numbers;
 * E_MEMORY. */
ambulo_status ambulo__mirror_check(const ambulo_problem_definition *definition,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics);
/* The hint of what one step cannot predict. */
#define AMBULO__BOTH_SIDES "ends: {kind: periodic} predicts both sides; a gait then takes two steps"

/* With ground reaction and torque limits: a warning for each joint that could not carry the
 * body standing still. E_MEMORY. */
ambulo_status ambulo__strength_check(const ambulo_problem_definition *definition,
                                     const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics);

/* "ground_penetration": corner heights, = 0 in contact, >= 0 otherwise (m). */
void ambulo__ground_rows(const ambulo__gait_context *context, ambulo__row_table *table);
/* "foot_strike": horizontal place of the contact point, and the heading of a flat foot (m).
 * Lateral rows are left out for models in which no coordinate moves the point sideways. */
void ambulo__foot_strike_rows(const ambulo__gait_context *context, ambulo__row_table *table);
/* "zmp" (Eq. 17', m) and "normal_force" (n.F / mg - minimum_force, body weights).
 * E_PROBLEM with the time when a support polygon is empty. */
ambulo_status ambulo__zmp_rows(const ambulo__gait_context *context, ambulo__row_table *table,
                               ambulo_diagnostics *diagnostics);
/* "contact": a loaded foot within the tolerances of its place and direction (m, rad). */
void ambulo__contact_tube_rows(const ambulo__gait_context *context, ambulo__row_table *table);
/* 1 at the first node of a loaded foot's contact; of times[nodes], s. */
int ambulo__is_strike(const ambulo_problem_definition *definition, int foot, const double *times,
                      int nodes, int node);
/* 1 if strike_pitch is about a contact at that node: there it begins, on the heel, or on the toes
 * where strike_pitch is of toes that point down. */
int ambulo__is_pitched(const ambulo_problem_definition *definition, const ambulo_contact *contact,
                       const double *times, int nodes, int node);
/* "clearance": heights, directions and track of a foot in the air (m, rad). */
void ambulo__clearance_rows(const ambulo__gait_context *context, ambulo__row_table *table);
/* "clearance": gaps between a foot in the air and the others (m). */
void ambulo__feet_apart_rows(const ambulo__gait_context *context, ambulo__row_table *table);
/* How much further apart parts that pass each other are at the nodes, for what happens between
 * them, m. */
double ambulo__passing_allowance(const ambulo_problem_definition *definition);
/* What part of the clearance height is due at s of the swing, and its slope by s (may be NULL). */
double ambulo__clearance_part(double s, double *slope);
/* How far below its clearance the tip of a foot that comes down on its toes on level ground may be,
 * m; 0 of other swings, and before the clearance falls. */
double ambulo__tip_drop(const ambulo_problem_definition *definition, int foot, double time,
                        double s);
/* The contact beside which a foot in the air stays: its nearest, the next one first; -1 if it has
 * none. *is_left: its track is the left one of the two feet's. */
int ambulo__swing_track(const ambulo_problem_definition *definition, int foot, double time,
                        int *is_left);
/* "joint_limit", "speed_limit", "torque_limit". */
void ambulo__limit_rows(const ambulo__gait_context *context, ambulo__row_table *table);
/* Every tube has samples, a reference and widths >= 0; E_PROBLEM with its number otherwise. */
ambulo_status ambulo__tubes_check(const ambulo_problem_definition *definition,
                                  ambulo_diagnostics *diagnostics);
/* "tracking_tube": distance from reference motions. */
void ambulo__tube_rows(const ambulo__gait_context *context, ambulo__row_table *table);
/* How far the ends carry coordinate i from t = 0 to T, m: the travel along its axis, for a
 * translation of the root. */
double ambulo__end_shift(const ambulo_problem_definition *definition, int i);
/* "initial_state", "final_state", "periodic", "mirrored". */
void ambulo__end_rows(const ambulo__gait_context *context, ambulo__row_table *table);

#endif
