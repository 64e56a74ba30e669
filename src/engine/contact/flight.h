/* contact/flight.h - times at which nothing touches the body. */
#ifndef AMBULO_CONTACT_FLIGHT_H
#define AMBULO_CONTACT_FLIGHT_H

#include "contact/contact_image.h"
#include "contact/gait.h"

/* 1 if no contact holds at a node, or just before it where that counts too: there no force acts on
 * the body, and contacts that begin or end there have no rows on theirs. With ends that match the
 * first node has what is just before the last. */
int ambulo__in_flight(const ambulo__gait_context *context, int node);

/* What of the tolerance holds at such a node: 1 inside, less where a contact begins or ends. */
double ambulo__flight_share(const ambulo__gait_context *context, int node);

/* "flight": no force, no moment about the centre of mass, within ground_reaction.flight_tolerance.
 */
void ambulo__flight_rows(const ambulo__gait_context *context, ambulo__row_table *table);

/* The first time in [0, T] from which on no contact holds, until `to`; 0 if there is none. */
int ambulo__flight_span(const ambulo_problem_definition *definition, ambulo__span *span);
/* How long the bound on moments is made per body weight of that on forces, m. */
double ambulo__flight_arm(const ambulo_model *model);

#endif
