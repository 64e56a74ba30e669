/* ambulo/tools/film.h - the motion of a result folder as a film: MP4 or GIF (docs/guide-page.md).
 *
 * Pictures are drawn by the library itself. They become a film by ffmpeg, a program that is looked
 * for on PATH when a film is asked for: the library is linked to nothing for it. The film is
 * written whole or not at all.
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_FILM_H
#define AMBULO_TOOLS_FILM_H

#include "ambulo/tools/common.h"

#ifdef __cplusplus
extern "C" {
#endif

/* From where the body is seen; the names of the page's buttons. */
typedef enum ambulo_film_view {
  AMBULO_FILM_FREE = 0,
  AMBULO_FILM_SIDE,
  AMBULO_FILM_FRONT,
  AMBULO_FILM_TOP
} ambulo_film_view;

typedef struct ambulo_film_options {
  size_t size;   /* set by ambulo_film_options_default() */
  int overwrite; /* 1: write over a file that is there */
  ambulo_film_view view;
  int width, height; /* pixels, even, 16 to 3840; 0: 1280 x 720, of a GIF 640 x 360 */
  double rate;       /* pictures a second, 1 to 120; AMBULO_OFF: 30, of a GIF 25 */
  double speed;      /* 1; 0.25: four times as slow as the motion; 0.01 to 100 */
  int times;         /* how often a motion that repeats is shown, 1 to 100; 2 */
  void (*progress)(void *user, int pictures, int of); /* after each picture; NULL: none */
  void *user;
} ambulo_film_options;
AMBULO_TOOL_DEFAULT(ambulo_film_options);

/* Makes a film of the motion in a result folder; `output` ends with .mp4 or .gif. `options` (NULL:
 * the defaults), `allocator` and `diagnostics` may be NULL. Errors: E_ARGUMENT (another ending
 * too); E_IO (no result folder; an output that cannot be written, or is there and overwrite is 0;
 * no ffmpeg on PATH, or it failed: the message holds its words); E_PARSE, E_SCHEMA (of the folder);
 * E_LIMIT (more than 20000 pictures), E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_film_write(const char *directory,
                                                            const char *output,
                                                            const ambulo_film_options *options,
                                                            const ambulo_allocator *allocator,
                                                            ambulo_diagnostics *diagnostics);

#ifdef __cplusplus
}
#endif
#endif
