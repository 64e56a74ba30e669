/* study/front_points.h - the points of a front as its folder has them (study/front.h). */
#ifndef AMBULO_STUDY_FRONT_POINTS_H
#define AMBULO_STUDY_FRONT_POINTS_H

#include "study/gather.h"
#include "study/front.h"

/* Fills value, total and solved of a case whose files are intact from its summary.json; weight is
 * set. What cannot be read is not solved. E_MEMORY. */
ambulo_status ambulo__front_read_point(const char *directory, const char *id, char *const *term,
                                       int terms, const ambulo_allocator *allocator,
                                       ambulo__front_point *point);

/* All points of a listing, judged. free accepts a zero-filled front. Errors: as ambulo__gather. */
ambulo_status ambulo__front_gather(const char *directory, const ambulo__listing *listing,
                                   ambulo__front *front, ambulo__front_report *report);
void ambulo__front_free(const ambulo_allocator *allocator, ambulo__front *front);

/* "yes", "beaten", ...: the column `front` of the table. */
const char *ambulo__front_word(ambulo__front_standing standing);

/* front_tell.c: fills the census, and warns of what a reader of the front has to know: gaps that
 * refuse to close, terms that are not at odds, anchors without a solution. E_MEMORY. */
ambulo_status ambulo__front_tell(const char *directory, const ambulo__listing *listing,
                                 const ambulo__front *front, const ambulo__front_report *report,
                                 ambulo_diagnostics *diagnostics, ambulo_front_census *census);

#endif
