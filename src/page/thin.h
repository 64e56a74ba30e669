/* page/thin.h - a scene with fewer samples, for pages that hold many. */
#ifndef AMBULO_PAGE_THIN_H
#define AMBULO_PAGE_THIN_H

#include "base/text_buffer.h"

/* Appends the text of a scene.json in which series (scene/scene.h) have every fourth sample, in
 * units ten times as coarse: `samples` is the number that is left, `coarse` 10. Everything else
 * stays. A scene whose number of samples is not a multiple of four and one more is copied. */
void ambulo__scene_thin(ambulo__text_buffer *out, const char *scene, size_t length);

#endif
