/* show/gait_svg.h - gait.svg: the motion at a glance.
 *
 * A strip of stick figures seen from the right side (forward to the right), the contact
 * phases of feet and patches on the same time axis, and curves of joint angles and torques. */
#ifndef AMBULO_SHOW_GAIT_SVG_H
#define AMBULO_SHOW_GAIT_SVG_H

#include "ambulo/tools/report.h"
#include "base/text_buffer.h"
#include "people/stride.h"
#include "show/gait_people.h"
#include "show/skeleton.h"

/* Appends the whole picture; `people` (NULL: none) are drawn behind the curves of a walk
 * (show/gait_people.h). Errors: E_MEMORY. */
ambulo_status ambulo__gait_svg(const ambulo_problem *problem, const ambulo_result *result,
                               const ambulo__people *people, ambulo__text_buffer *text);

/* What is drawn of it, and how. Zero-filled: all of it, in N m and s, as gait.svg. */
typedef struct ambulo__gait_style {
  int without_strip, without_curves;
  int powers;         /* 1: a third row of curves */
  int per_kg;         /* 1: N m/kg, W/kg, N/kg in place of N m, W, body weights */
  int percent;        /* 1: curves over the cycle of their foot, or (no steps) over the motion */
  double millimetres; /* width on paper; 0: 1200 px */
} ambulo__gait_style;

/* *shown (may be NULL): how many curves of people were drawn. Errors: E_MEMORY. */
ambulo_status ambulo__gait_picture(const ambulo_problem *problem, const ambulo_result *result,
                                   const ambulo__people *people, const ambulo__gait_style *style,
                                   ambulo__text_buffer *text, int *shown);

/* ---------------------------------------------- its parts, each in its file */

/* A region of the picture, px; time runs from 0 to `duration` across its width. */
typedef struct ambulo__panel {
  double x, y, width, height, duration;
} ambulo__panel;

static inline double ambulo__panel_time(const ambulo__panel *panel, double t) {
  return panel->x + panel->width * t / panel->duration;
}

/* Stick figures standing on the lower edge of the panel. A figure of time t stands at t on
 * the time axis: the walking direction is stretched (or, for a motion that stays in place,
 * unrolled) uniformly; heights and lengths within a figure are true. */
ambulo_status ambulo__gait_strip(const ambulo_problem *problem, const double *x,
                                 const ambulo__panel *panel, ambulo__text_buffer *text);

/* Sets panel->height, which is the most there is room for, to what the figures need. */
ambulo_status ambulo__gait_strip_height(const ambulo_problem *problem, const double *x,
                                        const ambulo_allocator *allocator, ambulo__panel *panel);

/* 1: some foot stands with another heading than before. Such a motion is shown from above, too. */
int ambulo__gait_turns(const ambulo_problem *problem);
/* Sets panel->height; 0 where the motion does not turn. Errors: E_MEMORY. */
ambulo_status ambulo__gait_plan_height(const ambulo__stride *stride, ambulo__panel *panel);
/* Footprints and the way of the first body that weighs. Errors: E_MEMORY. */
ambulo_status ambulo__gait_plan(const ambulo__stride *stride, const ambulo__panel *panel,
                                ambulo__text_buffer *text);

/* 1 for feet, and for patches that are in contact at some time. */
int ambulo__gait_shows(const ambulo__stride *stride, int effector);
/* Of its middle at q = 0. */
ambulo__side ambulo__gait_patch_side(const ambulo_model *model, int patch);
/* One bar an effector that is shown; returns the height used, px (0 where there is none). */
double ambulo__gait_bars(const ambulo__stride *stride, const ambulo__panel *panel,
                         ambulo__text_buffer *text);
/* Ticks and numbers below y = panel->y. */
void ambulo__time_axis(const ambulo__panel *panel, int parts, const char *unit,
                       ambulo__text_buffer *text);

/* Curves of up to three coordinates (pairs left and right): angles above, torques below, then
 * powers. Errors: E_MEMORY. */
ambulo_status ambulo__gait_curves(const ambulo__stride *stride, const ambulo__panel *panel,
                                  const ambulo__gait_style *style, ambulo__gait_people *people,
                                  ambulo__text_buffer *text);

/* Forces on feet and patches, upward and forward, side by side; nothing without ground reaction.
 * Errors: E_MEMORY. */
ambulo_status ambulo__gait_forces(const ambulo__stride *stride, const ambulo__panel *panel,
                                  const ambulo__gait_style *style, ambulo__gait_people *people,
                                  ambulo__text_buffer *text);

/* Who the people are whose curves were drawn, a line each, from y = panel->y down. */
void ambulo__people_legend(const ambulo__gait_people *people, const ambulo__panel *panel,
                           const ambulo__gait_style *style, ambulo__text_buffer *text);

#endif
