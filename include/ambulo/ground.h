/* ambulo/ground.h - the ground's force on the feet, and the clearance of feet in the air.
 *
 * Parts of a problem definition (problem.h). Axes: up n, forward f, left l. */
#ifndef AMBULO_GROUND_H
#define AMBULO_GROUND_H

#include "ambulo/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ambulo_reaction_kind {
  AMBULO_REACTION_NONE = 0, /* torques as if six forces at the root carried the body */
  AMBULO_REACTION_SHARED    /* the active contacts share the root wrench, and their forces are taken
                               off along the limbs: true joint torques */
} ambulo_reaction_kind;

/* The force of the ground and other surfaces, and rows on it. */
typedef struct ambulo_ground_reaction {
  ambulo_reaction_kind kind;
  double friction;         /* |F_forward|, |F_left| <= friction F_n at each contact; AMBULO_OFF: no
                              rows */
  double free_moment;      /* |T| <= free_moment m g, m; AMBULO_OFF: no rows */
  int pressure;            /* 1: rows on the centre of pressure of each loaded foot, within: */
  double heel_pressure[2]; /* on the heel: [from, to] from the heel centre, along the foot, m */
  double heel_roll;        /* on the heel: the front end moves forward by this until the foot is
                              flat, m */
  double flat_pressure[2]; /* flat: behind the heel centre, ahead of the ball (toe centre), m */
  double toe_pressure[2];  /* on the toes: [from, to] from the ball, along the foot, m */
  double pressure_width;   /* to either side, m */
  double arc_pressure;     /* rolling on an arc: distance from below the arc's centre, ahead and
                              behind, m */

  /* The contacts' forces f_c, and moments m_c about their centres p_c, carry the root wrench and
   * minimize
   *   sum_c ( |f_c across e_c|^2 + slant^2 (f_c . e_c)^2 + |m_c|^2 / moment_arm^2 ) / w_c
   * where e_c is the direction from p_c to the centre of mass. The weight w_c(t) rises from 0 to 1
   * and falls back while a contact overlaps with its neighbours in time. */
  double moment_arm;       /* > 0, m: the shorter, the less moment a contact takes */
  double slant;            /* > 0; below 1, forces lean towards the centre of mass */
  double loading_rate;     /* body weights per s: a contact's normal force is at most this times the
                              time since it began, and times the time until it ends. It sets in over
                              6.5 ms at a stature of 1.75 m, scaled by its root. AMBULO_OFF: no rows */
  double flight_tolerance; /* > 0. While nothing touches the body, the force on it is at most this,
                              body weights, and so is the moment about its centre of mass, body
                              weights times 1 m at a stature of 1.75 m, scaled by it. At the nodes
                              of a flight that its spline can hold, 1/50 of it */
  double heel_pad; /* m: how far a heel sinks under the body weight, like a spring that gives
                      back what it takes; 0: rigid. Needs a contact_tolerance */
} ambulo_ground_reaction;

/* Rows on a foot in the air. s runs from 0 at toe-off to 1 at strike;
 * c(s) = height min(1, 4 s, 6 (1 - s)). */
typedef struct ambulo_clearance {
  double height;          /* ball >= c, heel >= c / 2, tip >= c, m; AMBULO_OFF: no rows at all */
  double tip_from;        /* the tip must clear from this s on: toes bend at push-off */
  double ceiling;         /* greatest height of ball, heel and tip, m */
  double turn;            /* greatest sine of the foot's yaw and roll */
  double outward, inward; /* greatest distance of the heel from its track to either side, m */
  double feet;            /* least gap to every other foot, seen from above, m. A foot is the line
                             from heel to toe centre, thickened by half its largest width.
                             AMBULO_OFF: no such rows; planar feet have none */
} ambulo_clearance;

/* As in ambulo_problem_definition_default(): no reaction, no rows. */
AMBULO_PROBLEM_DEFAULT(ambulo_ground_reaction);
AMBULO_PROBLEM_DEFAULT(ambulo_clearance);

#ifdef __cplusplus
}
#endif
#endif
