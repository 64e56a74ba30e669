/* ambulo/ground.h - the ground's force on the feet, and how far feet in the air stay off it.
 *
 * Parts of a problem definition (problem.h). Axes: up n, forward f, left l. */
#ifndef AMBULO_GROUND_H
#define AMBULO_GROUND_H

#include "ambulo/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ambulo_reaction_kind {
  AMBULO_REACTION_NONE = 0, /* torques as if the root were carried by its own six forces */
  AMBULO_REACTION_SHARED    /* the contacts that are down share the root wrench, which is then
                               subtracted along the limbs: real joint torques */
} ambulo_reaction_kind;

/* The force of the ground and of other surfaces, and the rows it makes possible. */
typedef struct ambulo_ground_reaction {
  ambulo_reaction_kind kind;
  double friction;         /* |F_forward|, |F_left| <= friction F_n of each contact; AMBULO_OFF: no
                              rows */
  double free_moment;      /* |T| <= free_moment m g, m; AMBULO_OFF: no rows */
  int pressure;            /* 1: rows on the centre of pressure of each loaded foot: */
  double heel_pressure[2]; /* on its heel: from the heel, along the foot, m; the front end moves
                              on by heel_roll until the foot is flat */
  double heel_roll;
  double flat_pressure[2]; /* flat: behind from the heel, ahead from the ball (toe centre), m */
  double toe_pressure[2];  /* on its toes: from the ball, m */
  double pressure_width;   /* to either side, m */
  double arc_pressure;     /* of a foot that rolls on an arc: how far from under the arc's
                              centre, ahead     and behind, m */

  /* The forces f_c and moments m_c of the contacts, about
   * their centres p_c, are those that carry the root wrench and minimize
   *   sum_c ( |f_c across e_c|^2 + slant^2 (f_c . e_c)^2 + |m_c|^2 / moment_arm^2 ) / w_c
   * with e_c the direction from p_c to the centre of mass and w_c(t) from 0 to 1 and back over the
   * times that a contact shares with its neighbours. */
  double moment_arm;   /* > 0, m: the shorter, the less moment a contact takes */
  double slant;        /* > 0; below 1, forces lean towards the centre of mass */
  double loading_rate; /* of a contact's normal force, body weights per s: at most this times the
                          time since it began and until it ends, setting in over 6.5 ms (of a body
                          of 1.75 m; as the root of the stature); AMBULO_OFF: no rows */
  double flight_tolerance; /* while nothing touches the body: force on it at most, body weights, and
                              moment about its centre of mass, body weights times 1 m (of a body of
                              1.75 m; as the stature); > 0 */
} ambulo_ground_reaction;

/* Rows on a foot in the air. s runs from 0 at its toe-off to 1 at its strike;
 * c(s) = height min(1, 4 s, 6 (1 - s)). */
typedef struct ambulo_clearance {
  double height;          /* ball >= c, heel >= c / 2, tip >= c, m; AMBULO_OFF: no rows at all */
  double tip_from;        /* the tip has to clear from this s on: toes bend at push-off */
  double ceiling;         /* none of them higher, m */
  double turn;            /* sine of yaw and roll of the foot, at most */
  double outward, inward; /* how far the heel may leave its track, m */
  double feet;            /* gap, seen from above, between it and every other foot, at least, m;
                             feet are the line from heel to toe centre and half their largest width
                             around it. AMBULO_OFF: no such rows; planar feet have none */
} ambulo_clearance;

/* Those of ambulo_problem_definition_default(): none, and no rows. */
AMBULO_PROBLEM_DEFAULT(ambulo_ground_reaction);
AMBULO_PROBLEM_DEFAULT(ambulo_clearance);

#ifdef __cplusplus
}
#endif
#endif
