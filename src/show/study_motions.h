/* show/study_motions.h - motions of a study, as many as its page has room for.
 *
 *     [{"count", "packed"}, ...]
 *
 * Blocks of at most a thousand cases (case_block.h), which bounds the memory that a study takes
 * here and where it is read. Each has its share of the room: it has all samples, or else every
 * second, or every fourth, or else, of its cases, the first that fit. */
#ifndef AMBULO_SHOW_STUDY_MOTIONS_H
#define AMBULO_SHOW_STUDY_MOTIONS_H

#include "show/page.h"

/* Appends the list for result folders [count] in at most `room` bytes; stands[i] = 1: that of
 * folder i is in it. Errors: as of ambulo__page_result_read, E_INTERNAL. */
ambulo_status ambulo__study_motions(ambulo__text_buffer *out, char *const *folders, int count,
                                    double room, ambulo_diagnostics *diagnostics, char *stands);

#endif
