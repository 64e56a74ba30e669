/* contact/sharing.h - rows of contacts that share the load by themselves. */
#ifndef AMBULO_CONTACT_SHARING_H
#define AMBULO_CONTACT_SHARING_H

#include "contact/gait.h"

/* Weight up to which a contact has no rows: it carries that part of the load at most. */
#define AMBULO__LEAST_WEIGHT 1e-6

/* "normal_force", "friction", "pressure", "free_moment" of each loaded contact. */
void ambulo__sharing_rows(const ambulo__gait_context *context, ambulo__row_table *table);

#endif
