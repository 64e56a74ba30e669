/* show/gait_chart.h - a small panel with curves over the stride. */
#ifndef AMBULO_SHOW_GAIT_CHART_H
#define AMBULO_SHOW_GAIT_CHART_H

#include "show/gait_people.h"
#include "show/gait_svg.h"
#include "show/skeleton.h"

typedef struct ambulo__gait_chart {
  ambulo__panel box;
  const ambulo__stride *stride;
  const double *values; /* [samples][columns] */
  int columns;
  double factor;    /* to the unit shown */
  double low, high; /* of the axis, in the unit shown */
  /* not NULL: the box is 100 wide, and curves are over the percent of the cycle of their side */
  const ambulo__gait_people *cycles;
} ambulo__gait_chart;

/* The axis of time, or of percent, under the box. */
void ambulo__chart_axis(const ambulo__gait_chart *chart, ambulo__text_buffer *text);

/* Sets low and high so that zero and the columns fit. */
void ambulo__chart_range(ambulo__gait_chart *chart, const int *columns, int count);
/* Widens them for a curve of people and its band. */
void ambulo__chart_widen(ambulo__gait_chart *chart, const ambulo__people_curve *people);
/* Horizontal grid with numbers; the range grows to whole steps. */
void ambulo__chart_grid(ambulo__gait_chart *chart, ambulo__text_buffer *text);
/* One column in the colour of a side; gaps where it is not finite. */
void ambulo__chart_curve(const ambulo__gait_chart *chart, int column, ambulo__side side,
                         ambulo__text_buffer *text);
/* The efforts of devices at a coordinate, in the unit shown: room for them, and their curves. */
void ambulo__chart_widen_devices(ambulo__gait_chart *chart, int coordinate);
void ambulo__chart_devices(const ambulo__gait_chart *chart, int coordinate,
                           ambulo__text_buffer *text);
/* Of a pair of curves of people: over the percent of the cycle both feet have the same. */
int ambulo__chart_alike(const ambulo__gait_chart *chart, const ambulo__people_curve *a,
                        const ambulo__people_curve *b);
/* A curve of people in the same colours (`both`: in grey): a pale band where there are deviations,
 * a dashed line elsewhere. */
void ambulo__chart_people(const ambulo__gait_chart *chart, const ambulo__people_curve *people,
                          int both, ambulo__text_buffer *text);

#endif
