/* solver/step_rows.h - footholds in the rows of a foot that passes the edges of steps. */
#ifndef AMBULO_SOLVER_STEP_ROWS_H
#define AMBULO_SOLVER_STEP_ROWS_H

#include "solver/partials.h"

#include "contact/step_edge.h"

typedef struct ambulo__step_row {
  const ambulo__table_row *row;
  const ambulo_contact *from, *to; /* between which the foot is (contact/swing.h) */
  ambulo__step_edges edges;
  double first_edge; /* s: when it comes there */
  double point[3];   /* r, world, m */
  double pull;       /* -lambda */
} ambulo__step_row;

/* 1 if a row of clearance is about edges, or of a height on the way past them. */
int ambulo__is_step_row(const ambulo__table_row *row);
/* Footholds and height of the ground. Returns 1 if the row is one of a height to clear, -1 of one
 * not to exceed, 0 of neither. */
int ambulo__partials_of_step(const ambulo__stationary *s, const ambulo__step_row *step,
                             ambulo__partials *partials);
/* 1 if the row has no partials by places and heights. */
int ambulo__step_is_unclear(const ambulo__step_row *step);
/* Those that it depends on become NaN. */
void ambulo__step_unclear(const ambulo__stationary *s, const ambulo__step_row *step,
                          ambulo__partials *partials);

#endif
