/* problem/force_terms.h - terms of the forces of the ground: laws of the table of kinds (term.h).
 */
#ifndef AMBULO_PROBLEM_FORCE_TERMS_H
#define AMBULO_PROBLEM_FORCE_TERMS_H

#include "problem/term.h"

/* What a problem without ground reaction lacks; NULL: nothing. */
const char *ambulo__lacks_forces(const ambulo_problem_definition *definition);

int ambulo__ground_force_forms(const ambulo_term *term, const ambulo__term_context *context);
void ambulo__ground_force_form(const ambulo_term *term, const ambulo__term_context *context,
                               int node, int axis, ambulo__form *form);
int ambulo__force_rate_forms(const ambulo_term *term, const ambulo__term_context *context);
void ambulo__force_rate_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                             int j, ambulo__form *form);
int ambulo__force_tracking_forms(const ambulo_term *term, const ambulo__term_context *context);
void ambulo__force_tracking_form(const ambulo_term *term, const ambulo__term_context *context,
                                 int node, int j, ambulo__form *form);
int ambulo__pressure_tracking_forms(const ambulo_term *term, const ambulo__term_context *context);
void ambulo__pressure_tracking_form(const ambulo_term *term, const ambulo__term_context *context,
                                    int node, int j, ambulo__form *form);

#endif
