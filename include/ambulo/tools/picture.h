/* ambulo/tools/picture.h - pictures of a motion for a paper or a talk: SVG, PDF or PNG
 * (docs/guide-page.md).
 *
 * SVG is written by the library itself. PDF and PNG are made of it by rsvg-convert (librsvg), a
 * program that is looked for on PATH when one is asked for: the library is linked to nothing for
 * them. Files are written whole or not at all: temporary name, fsync, rename.
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_PICTURE_H
#define AMBULO_TOOLS_PICTURE_H

#include "ambulo/solve.h"
#include "ambulo/tools/common.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What is drawn of a motion. */
typedef enum ambulo_picture_parts {
  AMBULO_PICTURE_ALL = 0, /* as gait.svg of a result folder */
  AMBULO_PICTURE_STRIP,   /* figures, contacts and the axis of time */
  AMBULO_PICTURE_CURVES   /* coordinates, torques, forces */
} ambulo_picture_parts;

typedef struct ambulo_picture_options {
  size_t size;   /* set by ambulo_picture_options_default() */
  int overwrite; /* 1: write over a file that is there */
  ambulo_picture_parts parts;
  int powers;  /* 1: a third row of curves, torque times speed, W */
  int per_kg;  /* 1: N m/kg, W/kg and N/kg, of the body with what it carries, in place of N m, W and
                  body weights */
  int percent; /* 1: curves over percent: in a motion that repeats, of the cycle from strike to
                  strike of the foot on their side (of the foot that strikes first where they have
                  none); else of the motion */
  const char *norms; /* folder of the shipped curves of people (models/norms), drawn behind those
                        of a walk; NULL: none */
  const char *reference; /* a table of curves of people (docs/compare.md) in their place; NULL */
  double millimetres;    /* width on paper, at most 2000; AMBULO_OFF: 1200 px of 1/96 inch */
  double dots_per_inch;  /* of PNG; 300; 10 to 2400 */
} ambulo_picture_options;
AMBULO_TOOL_DEFAULT(ambulo_picture_options);

/* Draws a result of a problem into `output`, whose name ends with .svg, .pdf or .png. `options`
 * (NULL: the defaults), `allocator` and `diagnostics` may be NULL. Curves of people that were asked
 * for and are not drawn, because the motion is no walk on level ground or has none of them, are a
 * warning. Errors: E_ARGUMENT (another ending too); E_IO (an output that cannot be written, or is
 * there and overwrite is 0; no rsvg-convert on PATH, or it failed: the message holds its words);
 * E_PARSE, E_SCHEMA (of curves of people); E_LIMIT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_picture_write(const ambulo_problem *problem, const ambulo_result *result, const char *output,
                     const ambulo_picture_options *options, const ambulo_allocator *allocator,
                     ambulo_diagnostics *diagnostics);

/* The same of a picture that is there, as it is: an SVG file, or the gait.svg of a result folder.
 * Of the options only overwrite and dots_per_inch are read. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_picture_convert(
    const char *source, const char *output, const ambulo_picture_options *options,
    const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics);

#ifdef __cplusplus
}
#endif
#endif
