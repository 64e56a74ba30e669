/* contact/row_families.h - from a problem definition to constraint rows: one function a family.
 *
 * Each appends its rows for all nodes in node order. All take the same context. Axes: up n,
 * forward f, left l = n x f; ground plane n . r = h.
 *
 * Reading order: rows.h, rows.c, contacts.h, contacts.c, foot.c, contact_load.c; schedule.h,
 * schedule.c, footholds.c, phases.c, gait.c, ends.c, mirror_check.c; then a family of rows each:
 * place_rows.c, contact_tube.c, clearance.c, zmp.c, force_rows.c, flight.c, limits.c, curved.h,
 * curved.c, capsules.c, collision_pairs.c, collision_rows.c, hold_rows.c, collision_check.c;
 * devices.h, devices.c, load_motion.c, load_profile.c, holds.c, load_check.c. */
#ifndef AMBULO_CONTACT_ROW_FAMILIES_H
#define AMBULO_CONTACT_ROW_FAMILIES_H

#include "base/diagnostics.h"
#include "contact/contacts.h"
#include "contact/rows.h"

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
/* 1: nothing drives the coordinate, and nothing that touches the body supplies its force. */
int ambulo__is_passive(const ambulo_problem_definition *definition, int coordinate);
/* "passive": no torque of coordinates that nothing drives. */
void ambulo__passive_rows(const ambulo__gait_context *context, ambulo__row_table *table);
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

/* the limits of a coordinate as they hold in a problem.
 *
 * Mirrored ends predict one step of a stride; the other step is its mirror image, in which m takes
 * the place of i:
 *
 *     q_m(T + t) = s q_i(t) + shift_m,   and so for speed and torque, without the shift
 *
 * A limit has to hold in both: y_i keeps within its own interval and within the one that m's limits
 * leave it, (lo_m - shift_m) .. (hi_m - shift_m) times s. A coordinate that is its own image with
 * s = -1 keeps within [lo, hi] and [-hi, -lo]. Every reader of a limit that acts on a problem reads
 * it here; other ends leave the model's limits as they are. */

/* One end of such an interval, and the limit of the model that it comes from. */
typedef struct ambulo__bound {
  double value; /* on y_i; +-INFINITY without limit */
  int owner;    /* coordinate whose limit it is */
  int is_upper; /* of the owner's two limits the upper one */
  double given; /* what the model says: rad, m, per s, N m, N */
  double later; /* s by which the owner comes to it after i: 0 or T */
} ambulo__bound;

typedef struct ambulo__bounds {
  ambulo__bound low, high; /* low.value > high.value: the two halves leave nothing */
} ambulo__bounds;

ambulo__bounds ambulo__bounds_of(const ambulo_problem_definition *definition, int coordinate,
                                 ambulo_limited what);

/* range, speed or torque of a coordinate: [lower, upper] */
const double *ambulo__limits_of(const ambulo_coordinate *coordinate, ambulo_limited what);

/* What the model says about the limit that a row of ambulo__limit_rows holds. */
double ambulo__limit_given(const ambulo_model *model, const ambulo__table_row *row);

/* Which ends of the interval come from limits that hold in the mirrored half; "" if none does. */
enum { AMBULO__WHOSE_SIZE = 320 };
void ambulo__bounds_whose(const ambulo_model *model, const ambulo__bounds *bounds,
                          char text[AMBULO__WHOSE_SIZE]);

/* where the zero-moment point may lie.
 *
 * In the ground plane, coordinates [along forward, along left], m. Seen from above
 * (+n) the pair is right-handed, so "counter-clockwise" has its usual meaning. */

enum { AMBULO__POLYGON_CAPACITY = 64 };

/* Convex, counter-clockwise, no three vertices on a line. */
typedef struct ambulo__polygon {
  int count;
  double vertex[AMBULO__POLYGON_CAPACITY][2];
} ambulo__polygon;

/* One side: the ZMP z satisfies normal . z - offset >= 0. */
typedef struct ambulo__half_plane {
  double normal[2];   /* unit, inwards */
  double offset;      /* m; includes the margin */
  const char *detail; /* static: "back", "front", "right", "left", "edge" */
} ambulo__half_plane;

typedef struct ambulo__support_region {
  int count;
  ambulo__half_plane side[AMBULO__POLYGON_CAPACITY];
  double size; /* what is left inside the margin: m^2, or m for a planar model */
} ambulo__support_region;

/* Convex hull of `count` points (Andrew's monotone chain); `points` is sorted in place.
 * Fewer than three vertices remain when all points lie on a line. */
void ambulo__convex_hull(double (*points)[2], int count, ambulo__polygon *polygon);

/* m^2; positive for a counter-clockwise polygon. */
double ambulo__polygon_area(const ambulo__polygon *polygon);

/* The part of `polygon` whose distance from every side is at least `margin`. */
void ambulo__polygon_inset(const ambulo__polygon *polygon, double margin, ambulo__polygon *inset);

/* The region of the feet loaded at one node: active[feet] are contact indices or -1.
 * The box is the bounding box of the whole outlines of the loaded feet; the hull that of
 * the corners in contact. `planar`: only the forward extent counts (two sides).
 * Errors: E_LIMIT (more corners than a polygon holds); an empty region has size 0. */
ambulo_status ambulo__support_region_of(const ambulo_problem_definition *definition,
                                        const int *active, int planar,
                                        ambulo__support_region *region);

/* times at which nothing touches the body. */

/* 1 if no contact holds at a node, or just before it where that counts too: there no force acts on
 * the body, and contacts that begin or end there have no rows on theirs. With ends that match the
 * first node has what is just before the last. */
int ambulo__in_flight(const ambulo__gait_context *context, int node);

/* 1 if the node is nearest to one of as many times between nodes `first` and `last` as the
 * accelerations' spline has coefficients there; of trajectories that are no B-splines always. */
int ambulo__is_collocated(const ambulo__gait_context *context, int first, int last, int node);

/* "flight": no force, no moment about the centre of mass, within ground_reaction.flight_tolerance.
 */
void ambulo__flight_rows(const ambulo__gait_context *context, ambulo__row_table *table);

/* How much less such a row leaves than it would at a node without collocation, in its unit. */
double ambulo__flight_room(const ambulo_problem_definition *definition,
                           const ambulo__row_table *table, const ambulo__table_row *row);

/* The first time in [0, T] from which on no contact holds, until `to`; 0 if there is none. */
int ambulo__flight_span(const ambulo_problem_definition *definition, ambulo__span *span);
/* How long the bound on moments is made per body weight of that on forces, m. */
double ambulo__flight_arm(const ambulo_model *model);

/* rows of contacts that share the load by themselves. */

/* Weight up to which a contact has no rows: it carries that part of the load at most. */
#define AMBULO__LEAST_WEIGHT 1e-6

/* "normal_force", "friction", "pressure", "free_moment" of each loaded contact. */
void ambulo__sharing_rows(const ambulo__gait_context *context, ambulo__row_table *table);

/* "contact" of each patch while it is in contact; m. */
void ambulo__patch_rows(const ambulo__gait_context *context, ambulo__row_table *table);

/* capsules that keep clear: which, of what, and their rows. */

/* What a definition's collision comes to. Arrays are freed by ambulo__pairs_free. */
typedef struct ambulo__pairs {
  ambulo_capsule_pair *kept; /* [kept_count], one < other */
  int kept_count;
  ambulo_capsule_pair *left; /* [left_count] they overlap in the rest pose (automatic) */
  int left_count;
  int too_far; /* too far apart to meet (automatic) */
} ambulo__pairs;

/* E_MEMORY. */
ambulo_status ambulo__pairs_create(const ambulo_problem_definition *definition,
                                   const ambulo_allocator *allocator, ambulo__pairs *pairs);
void ambulo__pairs_free(const ambulo_allocator *allocator, ambulo__pairs *pairs);

/* How far two capsules are apart in a pose, m; negative: they overlap. */
struct ambulo__pose;
double ambulo__capsules_gap(const struct ambulo__pose *pose, ambulo_capsule_pair pair);

/* 1: what hands hold has a size: it is a box that keeps clear. */
int ambulo__hold_is_box(const ambulo_problem_definition *definition, int hold);
/* 1: the capsule keeps clear of it: it is not of an arm that holds it. */
int ambulo__hold_meets(const ambulo_problem_definition *definition, int hold, int capsule);
/* The box without channels and distance; ends[0]: its middle from that of the hands, world, m. */
ambulo__solid ambulo__solid_of_hold(const ambulo_problem_definition *definition, int hold);
/* A box fixed in the world, grown by the one that is carried, which keeps `distance` from it. */
ambulo__solid ambulo__solid_carried(const ambulo__solid *box, const ambulo__solid *fixed,
                                    double distance);
/* "collision" of boxes in hands and capsules, boxes of obstacles, the ground. */
void ambulo__hold_rows(const ambulo__gait_context *context, ambulo__row_table *table);
/* 1: all footholds are on one plane, which nothing is below: the ground, as a deep box. */
int ambulo__ground_is_level(const ambulo_problem_definition *definition);
ambulo__solid ambulo__solid_of_ground(const ambulo_problem_definition *definition);

/* How far two capsules are apart in the rest pose: every coordinate 0, or as near as its range lets
 * it; m, negative: they overlap. E_MEMORY. */
ambulo_status ambulo__rest_gap(const ambulo_model *model, ambulo_capsule_pair pair,
                               const ambulo_allocator *allocator, double *gap);
/* What two capsules may overlap by because they do so in the rest pose: the least whole number of
 * millimetres, so that it does not move with every number of the body; m, 0: nothing. E_MEMORY. */
ambulo_status ambulo__rest_overlap(const ambulo_model *model, ambulo_capsule_pair pair,
                                   const ambulo_allocator *allocator, double *overlap);

/* 1: rows of the definition stand on capsule i, whose ends then are points of the model
 * (model/model_query.h). The pairs are those listed, not AMBULO_COLLISION_AUTOMATIC. */
int ambulo__capsule_is_used(const ambulo_problem_definition *definition, int capsule);
/* Capsules, obstacles, places and times: every number and name in its range; reaches without a
 * node are found with the rows. E_PROBLEM. */
ambulo_status ambulo__collision_check(const ambulo_problem_definition *definition,
                                      ambulo_diagnostics *diagnostics);
/* With mirrored ends: no obstacles, no places in the world to reach, capsules of rows are mirror
 * images. E_PROBLEM. */
ambulo_status ambulo__collision_mirror_check(const ambulo_problem_definition *definition,
                                             ambulo_diagnostics *diagnostics);

/* "collision": of each pair that is listed (m). */
ambulo_status ambulo__collision_rows(const ambulo__gait_context *context,
                                     const ambulo_allocator *allocator, ambulo__row_table *table);
/* "obstacle": of each capsule and obstacle (m). */
void ambulo__obstacle_rows(const ambulo__gait_context *context, ambulo__row_table *table);
/* "reach": points at places (m). E_PROBLEM: a reach without a node. */
ambulo_status ambulo__reach_rows(const ambulo__gait_context *context, ambulo__row_table *table,
                                 ambulo_diagnostics *diagnostics);
/* A place along forward, left and up above the ground's height, in the world, m. */
void ambulo__world_place(const ambulo_problem_definition *definition, const double place[3],
                         double world[3]);
/* w_i of contact/curved.h, m^2. */
double ambulo__capsule_weight(const ambulo_capsule *capsule);
/* What rows keep clear of, in the world, as contact/curved.h has it; where channels begin is left
 * 0. Of two capsules; of an obstacle by itself, without a capsule's radius, distance and weights;
 * of a capsule and an obstacle. */
ambulo__solid ambulo__solid_of_pair(const ambulo_problem_definition *definition,
                                    ambulo_capsule_pair pair);
ambulo__solid ambulo__solid_of_obstacle(const ambulo_problem_definition *definition, int obstacle);
ambulo__solid ambulo__solid_near_obstacle(const ambulo_problem_definition *definition, int obstacle,
                                          int capsule);
/* How many capsules keep clear of an obstacle, and the i-th of them. */
int ambulo__obstacle_capsules(const ambulo_problem_definition *definition, int obstacle);
int ambulo__obstacle_capsule(const ambulo_problem_definition *definition, int obstacle, int i);

/* how a foot is turned, as linear forms of its points.
 *
 * x points from the heel centre to the toe centre, y from the right to the left heel corner;
 * with the axes left l and up n of the surface on which it stands or over which it swings
 *
 *     yaw   = l . x        (turned to the left)
 *     pitch = n . x        (toes up)
 *     roll  = n . y        (left side up)
 *
 * sines of the angles, of a foot whose heel and toe centre are a constant distance apart. */

ambulo__linear ambulo__foot_yaw(const ambulo__gait_context *context, int foot,
                                const double left[3]);
ambulo__linear ambulo__foot_pitch(const ambulo__gait_context *context, int foot,
                                  const double up[3]);
/* No terms for a foot with a single heel corner. */
ambulo__linear ambulo__foot_roll(const ambulo__gait_context *context, int foot, const double up[3]);

#endif
