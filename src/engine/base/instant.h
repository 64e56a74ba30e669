/* base/instant.h - when two times are one. Contacts, nodes and events come from decimal numbers and
 * from divisions of the duration, which agree to rounding only. */
#ifndef AMBULO_BASE_INSTANT_H
#define AMBULO_BASE_INSTANT_H

/* s; times that are no further apart are the same. No step of a motion is near it. */
#define AMBULO__INSTANT 1e-9

#endif
