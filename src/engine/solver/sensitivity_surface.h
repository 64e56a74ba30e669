/* solver/sensitivity_surface.h - how L changes when the surface of a contact is moved and turned,
 * and what that is by the numbers of contacts: place, heading, normal, travel and rise of their
 * images. */
#ifndef AMBULO_SOLVER_SENSITIVITY_SURFACE_H
#define AMBULO_SOLVER_SENSITIVITY_SURFACE_H

#include "solver/partials.h"

#include "contact/contact_frame.h"

/* dL by the surface's origin, m, and by a turn about it, rad; world axes. */
typedef struct ambulo__surface_pull {
  double origin[3], turn[3];
} ambulo__surface_pull;

/* The vectors that a row at one node stands on: sum coefficient_j . y_j, or of an arc its slopes;
 * points first of all, of slots forces and moments. */
enum { AMBULO__ROW_VECTORS = 4 };
typedef struct ambulo__row_vectors {
  int count;
  int first[AMBULO__ROW_VECTORS]; /* channels */
  double coefficient[AMBULO__ROW_VECTORS][3];
} ambulo__row_vectors;
ambulo__row_vectors ambulo__row_vectors_of(const ambulo__stationary *s,
                                           const ambulo__table_row *row);

/* Of a row that asks for its vectors relative to a surface at `origin`; times `pull`. */
ambulo__surface_pull ambulo__surface_pull_of(const ambulo__stationary *s,
                                             const ambulo__table_row *row, double pull,
                                             const double origin[3]);

/* The surface is that of the definition's contact. */
void ambulo__surface_of_contact(const ambulo__stationary *s, int contact,
                                const ambulo__surface_pull *by, ambulo__partials *partials);
/* The surface is that of a contact in its own or another period (contact/swing.h). */
void ambulo__surface_of_image(const ambulo__stationary *s, const ambulo_contact *image,
                              const ambulo__surface_pull *by, ambulo__partials *partials);
/* The height of an image has no partial: NaN. */
void ambulo__surface_unclear(const ambulo__stationary *s, const ambulo_contact *image,
                             ambulo__partials *partials);
/* The surface is `share` of the way between two images, whose heights have none if they are the
 * same. Returns dL/dshare. */
double ambulo__surface_between(const ambulo__stationary *s, const ambulo_contact *from,
                               const ambulo_contact *to, double share,
                               const ambulo__surface_pull *by, ambulo__partials *partials);

#endif
