/* study/plot.h - the drawing of a study: its points, and the kinds of drawing.
 *
 * plot.c chooses and sorts, plot_where.c takes cases away, plot_axes.c places, plot_layout.c makes
 * room for texts, plot_frame.c draws what all kinds share, plot_marks.c marks and links,
 * plot_spread.c keeps marks apart, plot_curves.c draws curves over one axis, plot_map.c a heat map
 * (or, where nearly every case has values of its own, a cloud of coloured points) over two. */
#ifndef AMBULO_STUDY_PLOT_H
#define AMBULO_STUDY_PLOT_H

#include "base/text_buffer.h"
#include "study/gather.h"

enum { AMBULO__PLOT_COLOURS = 8, AMBULO__PLOT_STATE = 24 };

/* A case that is drawn, in the order of the list. */
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

/* The panel and the page, in pixels. */
typedef struct ambulo__plot_layout {
  double left, top, width, height; /* of the panel */
  double legend;                   /* its left edge */
  double name;                     /* middle of the name of the second axis */
  double page_width, page_height;
  int slanted; /* the values of the first axis do not fit side by side */
} ambulo__plot_layout;

typedef struct ambulo__plot {
  const char *directory;
  const ambulo__listing *listing;
  ambulo_diagnostics *diagnostics;
  ambulo_plot_options options;
  ambulo__plot_axis axis[2]; /* axis[1].column < 0: curves */
  int output;
  ambulo__plot_point *point; /* [points] */
  int points, values;        /* cases that are drawn; those of them with a value */
  double low, high;          /* of the valid values, or of all where none is valid */
  int exponent;              /* values are divided by 10 to this power */
  ambulo__plot_layout layout;
} ambulo__plot;

/* plot_where.c. Every condition names a column of the table, and is a comparison: E_ARGUMENT. */
ambulo_status ambulo__plot_check_where(const ambulo__plot *plot);
/* *holds: whether the case passes all conditions. E_ARGUMENT where one compares words by size. */
ambulo_status ambulo__plot_passes(const ambulo__plot *plot, const ambulo__gathered *one,
                                  int *holds);

/* plot_axes.c: of the cases that are drawn. E_MEMORY only; free accepts a zero-filled axis. */
ambulo_status ambulo__plot_axis_make(const ambulo__listing *listing,
                                     const ambulo__plot_point *point, int points, int column,
                                     ambulo__plot_axis *axis);
void ambulo__plot_axis_free(const ambulo__listing *listing, ambulo__plot_axis *axis);
int ambulo__plot_axis_place(const ambulo__plot_axis *axis, const char *text);
/* Share (0 to 1) of the way from the first to the last value; inset leaves room at both ends. */
double ambulo__plot_axis_share(const ambulo__plot_axis *axis, int place, double inset);

/* plot_layout.c. Estimated width of a text in letters of `size` pixels. */
double ambulo__plot_text_width(const char *text, double size, int bold);
/* Room for the values along both axes (cells: they stand side by side), a legend of this width and
 * the lines above, with this remark (may be ""). */
void ambulo__plot_arrange(ambulo__plot *plot, int cells, double legend, const char *remark,
                          ambulo__text_buffer *svg);
/* The lines above the panel: how many cases of which state; the conditions. */
void ambulo__plot_append_states(const ambulo__plot *plot, const char *remark,
                                ambulo__text_buffer *out);
void ambulo__plot_append_where(const ambulo__plot *plot, ambulo__text_buffer *out);
/* At most `most` letters of a text, with "..." in place of others. */
void ambulo__plot_append_cut(ambulo__text_buffer *out, const char *text, int most);
/* "body mass in kg" of a column of axes; "objective", "torque in 10^3 N m" of the output. */
void ambulo__plot_append_axis(const ambulo__plot *plot, int column, ambulo__text_buffer *out);
void ambulo__plot_append_output(const ambulo__plot *plot, ambulo__text_buffer *out);
void ambulo__plot_append_unit(const ambulo__plot *plot, ambulo__text_buffer *out);
/* Width of the heading and the entries of a legend that names a column, in pixels. */
double ambulo__plot_legend_width(const ambulo__plot *plot, const ambulo__plot_axis *axis,
                                 ambulo__text_buffer *svg);

/* plot_curves.c, plot_map.c */
ambulo_status ambulo__plot_curves(const ambulo__plot *plot, ambulo__text_buffer *svg);
ambulo_status ambulo__plot_map(const ambulo__plot *plot, ambulo__text_buffer *svg);

/* plot_spread.c. A mark, and the value of an axis that it stands at. */
typedef struct ambulo__plot_spot {
  double x, y;
  int place;
} ambulo__plot_spot;

/* Marks of one place that would hide each other step aside, by at most room[place] pixels; those
 * that find no room stay, and are counted. Sorts `spot`. */
int ambulo__plot_spread(ambulo__plot_spot **spot, int count, double radius, const double *room);

/* plot_frame.c. Begins the page with title, states and the names of the axes. */
void ambulo__plot_begin(const ambulo__plot *plot, ambulo__text_buffer *svg, const char *remark);
/* Values along an axis; cells: they stand side by side, whatever they are. */
void ambulo__plot_labels(const ambulo__plot *plot, ambulo__text_buffer *svg, int which,
                         double inset, int cells);
void ambulo__plot_grid(const ambulo__plot *plot, ambulo__text_buffer *svg);
double ambulo__plot_share(const ambulo__plot *plot, double value);
void ambulo__plot_number(ambulo__text_buffer *svg, const char *style, double x, double y,
                         double value, int decimals);

/* plot_marks.c. A link to the case's drawing (its record where it has none) with a tooltip; what
 * is drawn until the end belongs to it. */
void ambulo__plot_case_begin(const ambulo__plot *plot, ambulo__text_buffer *svg,
                             const ambulo__plot_point *point);
void ambulo__plot_case_end(ambulo__text_buffer *svg);
/* fill = NULL: the hollow mark of a case without a valid solution. */
void ambulo__plot_mark(ambulo__text_buffer *svg, double x, double y, double radius,
                       const char *fill, const char *edge);
/* A case without a value: a cross as large as a mark. */
void ambulo__plot_cross(ambulo__text_buffer *svg, double x, double y, double radius);
/* Light to dark blue, in steps of lightness that look even. */
void ambulo__plot_shade(double share, char colour[8]);
/* What marks mean, below the legend at height y. */
void ambulo__plot_remarks(const ambulo__plot *plot, ambulo__text_buffer *svg, double y);

#endif
