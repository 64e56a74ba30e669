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
  ambulo__plot_point *point;        /* [points] */
  int points, x_is_text, y_is_text; /* text axes: places instead of values */
} ambulo__plot;

/* plot_draw.c: the whole drawing. Links lead from the batch folder to cases. */
ambulo_status ambulo__plot_draw(const ambulo__plot *plot, ambulo__text_buffer *svg);

#endif
