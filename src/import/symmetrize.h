/* import/symmetrize.h - what the files that compare left and right, and make them images, share.
 */
#ifndef AMBULO_IMPORT_SYMMETRIZE_H
#define AMBULO_IMPORT_SYMMETRIZE_H

#include "import/body_tree.h"

enum {
  AMBULO__SIDE_PLACE,
  AMBULO__SIDE_MASS,
  AMBULO__SIDE_CENTER,
  AMBULO__SIDE_INERTIA,
  AMBULO__SIDE_AXIS,
  AMBULO__SIDE_KINDS
};

typedef struct ambulo__difference {
  double value;
  int link, other;
} ambulo__difference;

typedef struct ambulo__sides {
  ambulo__tree *tree;
  double axes[3][3], size, mass, near; /* m: places further apart are refused */
  int count, *partner;                 /* of links that move and of the first; -1: others */
  double *sign;
  ambulo__rigid *place, *old; /* in the world */
  double (*axis)[3];
  ambulo__part *body; /* in the world */
  ambulo__difference worst[AMBULO__SIDE_KINDS];
  int limits; /* that differed */
} ambulo__sides;

/* ----------------------------------------------- differences (side_differences.c) */

/* Whether a link has a coordinate. */
int ambulo__side_moves(const ambulo__sides *s, int link);
/* The images of a vector, and of an inertia, in the plane of forward and up. */
void ambulo__reflect(const ambulo__sides *s, const double v[3], double out[3]);
void ambulo__reflect_inertia(const ambulo__sides *s, const double inertia[6], double out[6]);
double ambulo__largest_entry(const double inertia[6]);
/* The image of j's axis as one of i's, with the sign that takes it nearer. */
void ambulo__image_of_axis(const ambulo__sides *s, int i, int j, double image[3], double *sign);
/* p_i - H p_j; of a hinge the part across `axis`, of a slider nothing. */
void ambulo__sides_away(const ambulo__sides *s, int i, int j, const double axis[3], double d[3]);
/* By how much i and the image of j differ; in the middle, how far it is off. */
void ambulo__sides_differ(const ambulo__sides *s, int i, int j, double d[AMBULO__SIDE_KINDS]);
/* Checks all pairs, an error each that is too far apart, and keeps the largest differences. */
void ambulo__sides_compare(ambulo__sides *s);

#endif
