/* batch/plot.h - the drawing of a study: its points, and the kinds of drawing.
 *
 * plot.c chooses and sorts, plot_axes.c places, plot_frame.c draws what all kinds share,
 * plot_curves.c curves over one axis, plot_map.c a heat map (or, where nearly every case has
 * values of its own, a cloud of coloured points) over two. */
#ifndef AMBULO_BATCH_PLOT_H
#define AMBULO_BATCH_PLOT_H

#include "base/text_buffer.h"
#include "batch/gather.h"

enum { AMBULO__PLOT_COLOURS = 8, AMBULO__PLOT_STATE = 24 };

/* A case, in the order of the list. */
typedef struct ambulo__plot_point {
  int index;                      /* of the case */
  int place[2];                   /* in the axes' lists of values */
  int has_value, valid;           /* a number was collected; the solution is valid */
  double value;                   /* in the drawing's unit */
  char state[AMBULO__PLOT_STATE]; /* of its record */
} ambulo__plot_point;

/* The distinct values of a column: numbers in their order, words as the list has them. */
typedef struct ambulo__plot_axis {
  int column, numeric, count;
  const char **text; /* [count] */
  double *at;        /* [count] where they stand: numbers, or 0, 1, 2, ... */
} ambulo__plot_axis;

typedef struct ambulo__plot {
  const ambulo__listing *listing;
  ambulo__plot_axis axis[2]; /* axis[1].column < 0: curves */
  int output;
  ambulo__plot_point *point; /* [points] */
  int points, values;        /* all cases; those with a value */
  double low, high;          /* of the valid values, or of all where none is valid */
  int exponent;              /* values are divided by 10 to this power */
} ambulo__plot;

/* plot_axes.c. E_MEMORY only; free accepts a zero-filled axis. */
ambulo_status ambulo__plot_axis_make(const ambulo__listing *listing, int column,
                                     ambulo__plot_axis *axis);
void ambulo__plot_axis_free(const ambulo__listing *listing, ambulo__plot_axis *axis);
int ambulo__plot_axis_place(const ambulo__plot_axis *axis, const char *text);
/* Share (0 to 1) of the way from the first to the last value; inset leaves room at both ends. */
double ambulo__plot_axis_share(const ambulo__plot_axis *axis, int place, double inset);

/* plot_curves.c */
ambulo_status ambulo__plot_curves(const ambulo__plot *plot, ambulo__text_buffer *svg);
/* plot_map.c */
ambulo_status ambulo__plot_map(const ambulo__plot *plot, ambulo__text_buffer *svg);

/* plot_frame.c. The panel, in pixels. */
extern const double ambulo__plot_left, ambulo__plot_top, ambulo__plot_width, ambulo__plot_height,
    ambulo__plot_legend;
void ambulo__plot_begin(const ambulo__plot *plot, ambulo__text_buffer *svg, const char *remark);
/* Values along an axis; cells: they stand side by side, whatever they are. */
void ambulo__plot_labels(const ambulo__plot *plot, ambulo__text_buffer *svg, int which,
                         double inset, int cells);
void ambulo__plot_grid(const ambulo__plot *plot, ambulo__text_buffer *svg);
double ambulo__plot_share(const ambulo__plot *plot, double value);
/* A link to the case's drawing (its record where it has none) with a tooltip; what is drawn
 * until the end belongs to it. */
void ambulo__plot_case_begin(const ambulo__plot *plot, ambulo__text_buffer *svg,
                             const ambulo__plot_point *point);
void ambulo__plot_case_end(ambulo__text_buffer *svg);
/* fill = NULL: the hollow mark of a case without a valid solution. */
void ambulo__plot_mark(ambulo__text_buffer *svg, double x, double y, double radius,
                       const char *fill, const char *edge);
/* A case without a value: a small cross. */
void ambulo__plot_cross(ambulo__text_buffer *svg, double x, double y);
void ambulo__plot_number(ambulo__text_buffer *svg, const char *style, double x, double y,
                         double value, int decimals);
/* Light to dark blue, in steps of lightness that look even. */
void ambulo__plot_shade(double share, char colour[8]);
/* What marks mean, below the legend at height y. */
void ambulo__plot_remarks(const ambulo__plot *plot, ambulo__text_buffer *svg, double y);

#endif
