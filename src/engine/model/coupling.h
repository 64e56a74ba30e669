/* model/coupling.h - joints that are a function of another joint's coordinate.
 *
 * A link that is coupled (ambulo/model.h) has a joint, but no coordinate: theta = f(q), with q a
 * coordinate of the model. Every such f is a polynomial in each of some intervals, its pieces. */
#ifndef AMBULO_MODEL_COUPLING_H
#define AMBULO_MODEL_COUPLING_H

#include "ambulo/model.h"

enum {
  AMBULO__COUPLING_TERMS = 5,  /* of a polynomial: degree 4 */
  AMBULO__MOST_KNOTS = 1024,   /* points of a spline */
  AMBULO__COUPLING_SLOPES = 3, /* derivatives that the mechanics needs */
  AMBULO__COUPLING_LANES = 4   /* the value and these */
};

/* c0 + c1 t + c2 t^2 + ... with t = x - at, where x >= from */
typedef struct ambulo__piece {
  double from, at, c[AMBULO__COUPLING_TERMS];
} ambulo__piece;

typedef struct ambulo__coupling {
  int to;                      /* coordinate of the model; -1: the link is not coupled */
  int count;                   /* pieces */
  const ambulo__piece *pieces; /* ascending; the first one also for all x below */
} ambulo__coupling;

/* How many pieces the function of a link has. */
int ambulo__coupling_count(const ambulo_link *link);
/* Fills pieces[0 .. ambulo__coupling_count). */
void ambulo__coupling_fill(const ambulo_link *link, ambulo__piece *pieces);
/* The same of the spline through points[count][2], x ascending: count + 1 pieces. */
void ambulo__spline_fill(const double *points, int count, ambulo__piece *pieces);

/* The piece that holds at x. */
const ambulo__piece *ambulo__coupling_piece(const ambulo__coupling *coupling, double x);
/* f(x), and f', f'' and f''' where `slope` is not NULL. */
double ambulo__coupling_value(const ambulo__coupling *coupling, double x,
                              double slope[AMBULO__COUPLING_SLOPES]);

#endif
