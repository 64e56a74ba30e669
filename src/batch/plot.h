/* batch/plot.h - the points of a drawing, and its two kinds. */
#ifndef AMBULO_BATCH_PLOT_H
#define AMBULO_BATCH_PLOT_H

#include "base/text_buffer.h"
#include "batch/gather.h"

typedef struct ambulo__plot_point {
  int index;          /* of the case */
  double x, y, value; /* y: of a heat map */
} ambulo__plot_point;

typedef struct ambulo__plot {
  const ambulo__listing *listing;
  int x_column, y_column; /* y_column < 0: curves */
  int output;
  ambulo__plot_point *point; /* [points] */
  int points;
  const char **seen[2]; /* distinct texts of the x and y columns, in the order of the list; NULL:
                           numbers, placed by value */
  int seen_count[2];
} ambulo__plot;

/* plot_draw.c: the whole drawing. Links lead from the batch folder to cases. */
ambulo_status ambulo__plot_draw(const ambulo__plot *plot, ambulo__text_buffer *svg);

#endif
