/* show/viewer.h - the page without its data, as `make viewer` built it: src/page/viewer.html.
 *
 * The Makefile turns the file into an array of bytes, so that the program needs no file beside it
 * and nobody who builds it needs what the page was made with. */
#ifndef AMBULO_SHOW_VIEWER_H
#define AMBULO_SHOW_VIEWER_H

#include <stddef.h>

extern const unsigned char ambulo__viewer[];
extern const size_t ambulo__viewer_size;

#endif
