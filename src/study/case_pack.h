/* study/case_pack.h - motions of a study inside of its page, as many as there is room for.
 *
 *     [{"count", "packed"}, ...]
 *
 * Blocks of at most a hundred cases, which the page opens one at a time. "packed" is compressed
 * (show/page.h): JSON, a zero, then the series of all cases as bytes.
 *
 *     {"every", "steps": {"l": .002, ...},
 *      "cases": [{"samples", "kinds", "like", "bytes", "summary", "scene"}, ...]}
 *
 * `summary` and `scene` are what a page of studies shows of the folder's files, numbers with six
 * digits; {"series": k} stands for series k of the case, of the k-th kind:
 *
 *     kind        step
 *     l  length   2 mm
 *     a  angle    .0034 rad (.195 degrees)
 *     t  torque   .01 N m a kg of the body's mass; forces of actuators .01 N a kg
 *     p  power    .01 W a kg
 *     f  force    .2 % of the body's weight
 *
 * Values are rounded to whole steps, so each is within half a step. The page keeps one sample in
 * `every`, or all where that leaves the last one out; `samples` are those that are kept. `steps`
 * are for a body of one kilogram and one newton of weight.
 *
 * `bytes` of the case hold its series one after another, in differences from sample to sample. A
 * case with kinds and samples of an earlier one is given by its differences from that case, number
 * `like` of the block; -1: by itself. A whole number x takes, from the lowest on, seven bits a byte
 * of 2 x or, below zero, -2 x - 1; the eighth bit says that more follow. viewer/cases.js reads it.
 */
#ifndef AMBULO_STUDY_CASE_PACK_H
#define AMBULO_STUDY_CASE_PACK_H

#include "base/diagnostics.h"
#include "base/text_buffer.h"

/* Appends the list for result folders [count] in at most `room` bytes; packed[i] = 1: that of
 * folder i is in it. Blocks share the room evenly: each has the finest steps and most samples that
 * fit, or else, of its cases, the first that fit. Errors: as of ambulo__page_result_read. */
ambulo_status ambulo__case_pack(ambulo__text_buffer *out, char *const *folders, int count,
                                double room, ambulo_diagnostics *diagnostics, char *packed);

#endif
