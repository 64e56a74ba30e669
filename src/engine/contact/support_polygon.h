/* contact/support_polygon.h - where the zero-moment point may lie.
 *
 * In the ground plane, coordinates [along forward, along left], m. Seen from above
 * (+n) the pair is right-handed, so "counter-clockwise" has its usual meaning. */
#ifndef AMBULO_CONTACT_SUPPORT_POLYGON_H
#define AMBULO_CONTACT_SUPPORT_POLYGON_H

#include "contact/gait.h"
#include "model/model.h"

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

#endif
