/* retarget/contacts.h - when the feet of a motion stand, and on what part.
 *
 * A point of a foot, its heel or its ball, is down while it is low and slow: it comes down below
 * one height and speed and leaves above larger ones. Heights count from the lowest that the point
 * comes to in its neighbourhood in time, so stairs have floors of their own; speeds grow with that
 * of the body. A foot stands from where either is down to where both have left; that is a stance,
 * in phases on heel, whole sole and toes.
 */
#ifndef AMBULO_RETARGET_CONTACTS_H
#define AMBULO_RETARGET_CONTACTS_H

#include "retarget/figure.h"

typedef enum ambulo__tread { AMBULO__ON_HEEL, AMBULO__ON_SOLE, AMBULO__ON_TOE } ambulo__tread;

typedef struct ambulo__phase {
  ambulo__tread tread;
  int first, last; /* rows, last not included */
  double from, to; /* s */
} ambulo__phase;

enum { AMBULO__STANCE_PHASES = 8 };

typedef struct ambulo__standing {
  int side, first, last; /* rows */
  ambulo__phase phase[AMBULO__STANCE_PHASES];
  int phases;
  double ankle[3]; /* above it the ankle stands when the foot is flat; [2]: height of the floor */
  double heading;  /* of the foot, rad */
  double facing;   /* of the pelvis in the middle of it */
} ambulo__standing;

typedef struct ambulo__standings {
  ambulo_allocator allocator;
  ambulo__standing *stance;
  int count, capacity;
} ambulo__standings;

/* Of postures [rows] of the figure, in the order of time for each side. Errors: E_SCHEMA (feet
 * never stand), E_MEMORY. */
ambulo_status ambulo__standings_find(const ambulo__figure *figure, const double *time,
                                     const ambulo__posture *posture, int rows,
                                     const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics, ambulo__standings *footing);
void ambulo__standings_free(ambulo__standings *footing); /* accepts a zero-filled one */

#endif
