/* contact/patch_rows.h - rows that hold patches in place. */
#ifndef AMBULO_CONTACT_PATCH_ROWS_H
#define AMBULO_CONTACT_PATCH_ROWS_H

#include "contact/gait.h"

/* "contact" of each patch while it is in contact; m. */
void ambulo__patch_rows(const ambulo__gait_context *context, ambulo__row_table *table);

#endif
