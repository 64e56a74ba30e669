/* show/case_block.h - many cases of a study in one piece, as the page opens them.
 *
 * JSON, a zero, then the motions of each family one after another (motion_pack.h):
 *
 *     {"every", "steps": {"l": .002, ...}, "forms": [...],
 *      "families": [{"kinds", "samples", "count"}, ...], "cases": [[form, family], ...]}
 *
 * Cases of one family have series of the same kinds in the same order; in a family and in a form
 * (case_table.h) they stand in the order of `cases`. `samples` are those that are written: one in
 * `every`. viewer/cases.js reads it. */
#ifndef AMBULO_SHOW_CASE_BLOCK_H
#define AMBULO_SHOW_CASE_BLOCK_H

#include "show/case_data.h"

/* How well motions are kept: one sample in `every` (families whose samples less one are no multiple
 * keep all of them), steps (case_data.h) so many times finer. */
typedef struct ambulo__case_quality {
  int every;
  double finer;
} ambulo__case_quality;

/* Appends a JSON string of the first `count` cases (packed_text.h). Errors: E_MEMORY, E_INTERNAL.
 */
ambulo_status ambulo__case_block(ambulo__text_buffer *out, const ambulo__case_data *cases,
                                 int count, const ambulo__case_quality *quality);

#endif
