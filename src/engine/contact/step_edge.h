/* contact/step_edge.h - where the edges of steps are that a foot in the air has to pass.
 *
 * A step is what lies between two footholds of unlike height on horizontal surfaces. Its riser is
 * not said by the contacts: it stands midway between the tip of the flat foot behind and the heel
 * of the one ahead, the edge on top of it. */
#ifndef AMBULO_CONTACT_STEP_EDGE_H
#define AMBULO_CONTACT_STEP_EDGE_H

#include "contact/loading.h"

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

#endif
