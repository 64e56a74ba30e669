/* show/picture.h - SVG to PDF or PNG, by another program.
 *
 * rsvg-convert belongs to librsvg, which draws the icons of desktops: it is packaged everywhere and
 * needs no display. As a program of its own it adds nothing to what the library links, and a fault
 * in it is an error message here. Text in, bytes out, through unnamed temporary files: no pipe can
 * fill up, and nothing is left behind. */
#ifndef AMBULO_SHOW_PICTURE_H
#define AMBULO_SHOW_PICTURE_H

#include "base/diagnostics.h"
#include "base/text_buffer.h"

typedef enum ambulo__picture_format {
  AMBULO__PICTURE_SVG,
  AMBULO__PICTURE_PDF,
  AMBULO__PICTURE_PNG
} ambulo__picture_format;

/* By the ending of a name, in letters of any size. Errors: E_ARGUMENT. */
ambulo_status ambulo__picture_format_of(const char *output, ambulo_diagnostics *diagnostics,
                                        ambulo__picture_format *format);

/* Appends the picture in the other format (not SVG) to `bytes`. `output`: what messages are about.
 * Errors: E_IO, E_MEMORY. */
ambulo_status ambulo__picture_convert(const ambulo__text_buffer *svg, ambulo__picture_format format,
                                      double dots_per_inch, const char *output,
                                      ambulo_diagnostics *diagnostics, ambulo__text_buffer *bytes);

#endif
