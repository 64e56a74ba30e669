/* problem/mirror_terms.h - does the objective weigh left and right alike? */
#ifndef AMBULO_PROBLEM_MIRROR_TERMS_H
#define AMBULO_PROBLEM_MIRROR_TERMS_H

#include "ambulo/problem.h"
#include "base/diagnostics.h"
#include "model/segments.h"

/* With mirrored ends: what a term asks of a coordinate or a line, it or another term asks of the
 * mirror partner. Left alone are references of tracking terms and what a reference lacks on one
 * side (they are about one step), and user terms. E_PROBLEM, each difference with both names and
 * numbers; E_MEMORY. */
ambulo_status ambulo__mirror_terms_check(const ambulo_problem_definition *definition,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics);

/* That of one term, by its kind (term_kinds.c): coordinates, a line of the body, scales of devices.
 */
ambulo_status ambulo__mirror_coordinates(const ambulo_problem_definition *definition,
                                         const ambulo__segments *segments, int term,
                                         ambulo_diagnostics *diagnostics);
ambulo_status ambulo__mirror_line(const ambulo_problem_definition *definition,
                                  const ambulo__segments *segments, int term,
                                  ambulo_diagnostics *diagnostics);
ambulo_status ambulo__mirror_device_scales(const ambulo_problem_definition *definition,
                                           const ambulo__segments *segments, int term,
                                           ambulo_diagnostics *diagnostics);

#endif
