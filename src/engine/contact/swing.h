/* contact/swing.h - between which contacts a foot in the air is, and over what. */
#ifndef AMBULO_CONTACT_SWING_H
#define AMBULO_CONTACT_SWING_H

#include "ambulo/problem.h"
#include "contact/contacts.h"
#include "contact/foot.h"

/* The last contact of `foot` that ended by `time`, and the next that begins from it on, as they
 * are in the time of the motion: of one that repeats also those of its other periods, moved on by
 * the travel and, with mirrored ends, to the other side. Returns 1 if it has both; of one alone
 * both become that; 0 if it has none. */
int ambulo__swing_contacts(const ambulo_problem_definition *definition, int foot, double time,
                           ambulo_contact *from, ambulo_contact *to);

/* Which of the definition's contacts one of those is, and in *period how many periods later; -1:
 * none. */
int ambulo__swing_source(const ambulo_problem_definition *definition, const ambulo_contact *image,
                         int *period);

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

#endif
