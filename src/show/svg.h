/* show/svg.h - drawing primitives as SVG 1.1 text.
 *
 * Lengths in pixels, x to the right, y down, rounded to 0.01. How things look is decided by
 * classes in one style sheet (svg.c). Numbers are free of the locale. */
#ifndef AMBULO_SHOW_SVG_H
#define AMBULO_SHOW_SVG_H

#include "base/text_buffer.h"

/* The page is printed `millimetres` wide; 0: one pixel is 1/96 inch. */
void ambulo__svg_begin(ambulo__text_buffer *text, double width, double height, double millimetres,
                       const char *title);
void ambulo__svg_end(ambulo__text_buffer *text);

void ambulo__svg_line(ambulo__text_buffer *text, const char *style, double x1, double y1, double x2,
                      double y2);
void ambulo__svg_rectangle(ambulo__text_buffer *text, const char *style, double x, double y,
                           double width, double height);
void ambulo__svg_circle(ambulo__text_buffer *text, const char *style, double x, double y,
                        double radius);
void ambulo__svg_label(ambulo__text_buffer *text, const char *style, double x, double y,
                       const char *label);

/* A label that fits into `room` px in usual fonts; font_size: of the style, px. A longer label is
 * set smaller, down to seven tenths, and then cut off and ended by three dots. */
void ambulo__svg_label_within(ambulo__text_buffer *text, const char *style, double x, double y,
                              double room, double font_size, const char *label);
/* A label in a size of its own, px. */
void ambulo__svg_label_sized(ambulo__text_buffer *text, const char *style, double x, double y,
                             double font_size, const char *label);

void ambulo__svg_group_begin(ambulo__text_buffer *text, const char *style);
/* Turned about (x, y), to the left. */
void ambulo__svg_group_turned(ambulo__text_buffer *text, const char *style, double degrees,
                              double x, double y);
void ambulo__svg_group_end(ambulo__text_buffer *text);

/* A path: begin, then moves and lines, then end. */
void ambulo__svg_path_begin(ambulo__text_buffer *text, const char *style);
void ambulo__svg_path_move(ambulo__text_buffer *text, double x, double y);
void ambulo__svg_path_line(ambulo__text_buffer *text, double x, double y);
void ambulo__svg_path_end(ambulo__text_buffer *text);

/* A value rounded to `decimals` (0..6) places, as text for labels. */
void ambulo__label_number(ambulo__text_buffer *text, double value, int decimals);
/* The round step (1, 2, 2.5 or 5 times a power of ten) that divides `range` into about
 * `parts`, and the decimals its multiples need. */
double ambulo__nice_step(double range, int parts, int *decimals);

#endif
