/* contact/schedule.h - the events of a motion, grids on them, swings, and what a gait asks. */
#ifndef AMBULO_CONTACT_SCHEDULE_H
#define AMBULO_CONTACT_SCHEDULE_H

#include "base/alloc.h"
#include "base/diagnostics.h"
#include "contact/contacts.h"

/* the times at which contacts change, and grids that have a node at each of
 * them.
 *
 * A phase is what lies between two neighbouring events. A grid on events has nodes at all events
 * and equally spaced ones within each phase, so that no row appears or vanishes when an event
 * moves: it moves with its node. */

/* Inside (0, T), rising and apart by more than 1e-9 s. */
typedef struct ambulo__events {
  int count;
  double *time; /* [count] */
} ambulo__events;

typedef enum ambulo__event_kind {
  AMBULO__EVENTS_OF_CONTACTS, /* starts and ends of contacts */
  AMBULO__EVENTS_OF_ROWS      /* and where in a swing the foot's tip has to clear the ground, and
                                 where the foot comes to edges of steps and is past them; and
                                 when points have to be at places */
} ambulo__event_kind;

/* Freed with ambulo__free(allocator, events->time). Contacts need not be legal. E_MEMORY. */
ambulo_status ambulo__events_create(const ambulo_problem_definition *definition,
                                    ambulo__event_kind kind, const ambulo_allocator *allocator,
                                    ambulo__events *events);

/* In the swing of `foot` beside `time` its tip has to clear the ground from air->from + tip_from
 * (air->to - air->from) on, which this returns. */
double ambulo__tip_time(const ambulo_problem_definition *definition, int foot, double time,
                        ambulo__span *air);
/* When it comes to the first edge of a step on its way, and when it is past the last one, fixed
 * shares of the time in the air. Returns 2; 0 if there is no step. */
int ambulo__edge_times(const ambulo_problem_definition *definition, int foot, ambulo__span air,
                       double time[2]);
/* 1 if the definition has rows on the tips of feet. Contacts need not be legal. */
int ambulo__has_tip_rows(const ambulo_problem_definition *definition);

/* Fewest intervals of a phase: of the time nodes, and of the trajectory. */
enum {
  AMBULO__LEAST_NODE_INTERVALS = 2,
  AMBULO__WANTED_NODE_INTERVALS = 4, /* of contacts that share the load, where there are enough */
  AMBULO__LEAST_KNOT_INTERVALS = 1
};

/* Fewest intervals of the trajectory that a definition's knots have room for; 1 where they are
 * uniform. E_MEMORY. */
ambulo_status ambulo__knots_least(const ambulo_problem_definition *definition,
                                  const ambulo_allocator *allocator, int *intervals);

/* Distributes `intervals` over the phases of [0, duration], at least `least` to each, the others in
 * proportion to duration (largest remainder): times[intervals + 1]. In each phase they stand at
 * s - grade sin(2 pi s) / 2 pi of its length, s = 0, 1/n ... 1: 0 equally spaced; near 1 dense
 * beside the events, where forces that begin and end bend most. E_LIMIT: fewer than least *
 * (events->count + 1); E_MEMORY. */
#define AMBULO__NODE_GRADE 0.8
ambulo_status ambulo__phase_grid(const ambulo__events *events, double duration, int intervals,
                                 int least, double grade, const ambulo_allocator *allocator,
                                 double *times);

/* The time nodes of a definition, times[intervals + 1], s. Errors: E_PROBLEM, named in
 * `diagnostics`: more phases than there are intervals for; E_MEMORY. */
ambulo_status ambulo__node_times(const ambulo_problem_definition *definition,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 double *times);
/* The breakpoints of a trajectory of `intervals` with knots on events, times[intervals + 1]. Of
 * events that are closer to one another, to 0 or to T than a fifth of the mean knot interval, T /
 * intervals, the first has the knot: between knots that nearly coincide accelerations could be
 * anything. */
ambulo_status ambulo__knot_times(const ambulo_problem_definition *definition, int intervals,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 double *times);

/* between which contacts a foot in the air is, and over what. */

/* The last contact of `foot` that ended by `time`, and the next that begins from it on, as they
 * are in the time of the motion: of one that repeats also those of its other periods, moved on by
 * the travel and, with mirrored ends, to the other side. Returns 1 if it has both; of one alone
 * both become that; 0 if it has none. */
int ambulo__swing_contacts(const ambulo_problem_definition *definition, int foot, double time,
                           ambulo_contact *from, ambulo_contact *to);

/* The plane that a foot's corners stay above: of the contact at `time`, else of the lower one of
 * those between which it swings, else the level ground. */
ambulo__contact_frame ambulo__surface_below(const ambulo_problem_definition *definition, int foot,
                                            double time);

/* where the edges of steps are that a foot in the air has to pass.
 *
 * A step is what lies between two footholds of unlike height on horizontal surfaces. Its riser is
 * not said by the contacts: it stands midway between the tip of the flat foot behind and the heel
 * of the one ahead, the edge on top of it. */

/* Footholds on the way: 0 that which the foot leaves, 1 its next, 2 that of the other foot. */
typedef struct ambulo__step_edge {
  double x, z;        /* along `ahead`, and its height: m */
  int behind, beyond; /* the footholds between which it is */
  int on;             /* whose height it has */
  int unsure;         /* 1: it is between others just as well, which stand beside them */
} ambulo__step_edge;

typedef struct ambulo__step_edges {
  int count;       /* 1, or 2 past the other foot's step; 0: no step, or none that lies ahead */
  double ahead[3]; /* unit, horizontal: from the foothold that the foot leaves to its next one */
  double riser;    /* ahead . r of the riser beside the lower one of the two, m */
  double above[3]; /* unit normal of the plane over all edges, parallel to the way up or down */
  double height;   /* above . r of it, m */
  ambulo__step_edge edge[2];   /* the lower one first; its x is the riser's */
  int highest;                 /* the edge that the plane lies on */
  int even;                    /* 1: it lies on both */
  const ambulo_contact *other; /* of the other foot's step; NULL: it has no part in this */
} ambulo__step_edges;

/* Where the riser is between the footholds of a foot of this length and of one ahead of it. */
static inline double ambulo__riser_between(double behind, double length, double ahead) {
  return 0.5 * (behind + length + ahead);
}

/* A foot goes up beside the riser, over the edges, and on above the upper step; down the same way
 * back. When it comes to the first edge (`last` 0), and when it is past the last one (1), s. */
double ambulo__step_edge_time(ambulo__span air, const ambulo_contact *from,
                              const ambulo_contact *to, int last);

/* On the way of `foot`, in the air at `time`, between two contacts (contact/swing.h). */
ambulo__step_edges ambulo__step_edges_between(const ambulo_problem_definition *definition, int foot,
                                              double time, const ambulo_contact *from,
                                              const ambulo_contact *to);

/* how fast, how far a step, how steep: what a gait asks of legs as long as these.
 *
 * With v the speed, l the length of the leg and g gravity, a body that vaults over a straight leg
 * moves on an arc: v^2 / l has to come from gravity. The Froude number
 *
 *     F = v^2 / (g l)
 *
 * is the share of the body weight that the arc needs: walking ends at 1 (Alexander, The gaits of
 * bipedal and quadrupedal animals, 1984), and people change to running at 0.5, at any gravity
 * (Kram, Domingo & Ferris, J Exp Biol 200:821, 1997). The longest steps that people walk with
 * are 1.17 legs long (Schmitt, J Exp Biol 206:1437, 2003: strides of 2.1 m, statures of 1.7 m, legs
 * 0.53 statures). A body that moves steadily is carried by a force that is vertical on average: on
 * a slope its share along the ground is the slope's tangent, and friction has to hold that.
 */

#define AMBULO__RUNNING_FROUDE 0.5
#define AMBULO__LONGEST_STEP 1.17 /* leg lengths */

typedef struct ambulo__task {
  int is_gait;      /* two feet or more, with contacts, on legs of some length; else all is 0 */
  double leg;       /* m: the longest leg, from its first joint to the heel, straight */
  double speed;     /* m/s along forward, of a motion that repeats; 0 otherwise */
  double step;      /* m: the longest, along forward */
  double step_time; /* s, on average */
  double froude;    /* F */
  double gravity;   /* m/s^2 */
  double grade;     /* tangent of the slope, of a motion that repeats */
} ambulo__task;

ambulo__task ambulo__task_of(const ambulo_problem_definition *definition);

/* When step `step` of a regular walk strikes (s), and how far its foothold is from that of step 0
 * (m). */
double ambulo__gait_strike(const ambulo_gait *gait, int step);
double ambulo__gait_place(const ambulo_gait *gait, int step);

/* a regular walk as it is asked for: what is given, and what follows from it.
 *
 * Lengths, times and speed of the steps say the same thing twice: what is given decides, the rest
 * follows. With the stature H, g = |gravity|, the speed v and its number u = v / sqrt(g H):
 *
 *     length   given; H (comfortable + slope (u - 0.31)); v times the time of a step; or that
 *              which people choose, who keep the walk ratio of step length and cadence (Sekiya et
 *              al. 1996; down to about 1 m/s: Murakami & Otaka 2017), W = 0.0035 of the stature per
 *              step a minute at H = 1.75 m, as H^1.5, so that bodies of one speed number make alike
 *              steps: v = L C / 60, L = W C, L = sqrt(60 v W)
 *     time     given; the duration over the steps; or length / v
 *     phase    a share of the stride, or comfortable + slope (u - 0.31)
 *     width    given, or the distance of the heels in the neutral pose
 *
 * 0.31 is 1.28 m/s for 1.75 m.
 */

#define AMBULO__COMFORTABLE_NUMBER 0.31
enum { AMBULO__PHASES = 4 }; /* heel_strike, foot_flat, heel_off, toe_off of a gait */

typedef enum ambulo__phase_kind {
  AMBULO__PHASE_SHARE,    /* of the stride, at any speed */
  AMBULO__PHASE_FUNCTION, /* of the speed, as the file has it */
  AMBULO__PHASE_OF_PEOPLE /* of the speed, the program's own */
} ambulo__phase_kind;

typedef enum ambulo__length_kind {
  AMBULO__LENGTH_GIVEN,
  AMBULO__LENGTH_FUNCTION, /* of the speed */
  AMBULO__LENGTH_OF_TIME,  /* speed times time */
  AMBULO__LENGTH_OF_PEOPLE /* by the walk ratio */
} ambulo__length_kind;

typedef enum ambulo__time_kind {
  AMBULO__TIME_OF_SPEED,
  AMBULO__TIME_OF_DURATION,
  AMBULO__TIME_GIVEN
} ambulo__time_kind;

typedef struct ambulo__gait_rule {
  ambulo_gait fixed; /* steps, feet, landing and start; the rest follows */
  ambulo__length_kind length_kind;
  ambulo__time_kind time_kind;
  double length[2];                        /* m: of odd and of even steps; NaN: of all alike */
  double length_comfortable, length_slope; /* statures */
  double time[2], duration;                /* s; time as length */
  double speed;                            /* m/s; NaN: not given */
  double width;                            /* m; NaN: of the neutral pose */
  ambulo__phase_kind phase_kind[AMBULO__PHASES];
  double phase[AMBULO__PHASES], phase_slope[AMBULO__PHASES];
} ambulo__gait_rule;

/* The walk that follows. */
void ambulo__gait_follow(const ambulo__gait_rule *rule, const ambulo_model *model,
                         ambulo_gait *gait);
/* sqrt(g H), m/s; 0: the model has no stature, or no gravity. */
double ambulo__speed_unit(const ambulo_model *model);
/* Mean speed of a walk, m/s, and its number; a comfortable one where there is none. */
double ambulo__gait_speed(const ambulo_gait *gait);
double ambulo__speed_number(const ambulo_model *model, double speed);

#endif
