/* solver/contact_pull.h - where contacts share the load (contact/contact_load.h): what the law
 * and the rows of a contact are told of it, and of which times that is made. */
#ifndef AMBULO_SOLVER_CONTACT_PULL_H
#define AMBULO_SOLVER_CONTACT_PULL_H

#include "solver/partials.h"

#include "contact/contact_load.h"

/* dL by the weight of a contact, by how far its centre and, under the heel, the front end of its
 * patch are ahead of the heel's foothold (m), and by its greatest normal force (body weights). */
typedef struct ambulo__load_pull {
  double weight, center, front, most;
} ambulo__load_pull;

/* One of the definition's contacts at a node, as a slot has it. */
typedef struct ambulo__timed_contact {
  int node, contact;
  ambulo__slot_part part;
  ambulo__contact_load load;
} ambulo__timed_contact;

/* Adds all that to the partials of times. */
void ambulo__partials_of_load(const ambulo__stationary *s, const ambulo__timed_contact *timed,
                              const ambulo__load_pull *by, ambulo__partials *partials);

#endif
