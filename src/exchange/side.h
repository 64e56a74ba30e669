/* exchange/side.h - left and right in names: hip_l, LeftFoot, l_knee, L_ANKLE, RHipPitch. */
#ifndef AMBULO_EXCHANGE_SIDE_H
#define AMBULO_EXCHANGE_SIDE_H

#include <stddef.h>

/* 'l', 'r', or 0 where a name says neither. */
char ambulo__side_of(const char *name);
/* The name with the side that it says exchanged, all of them, into text[0..size); 0 where it says
 * none, or does not fit. */
int ambulo__other_side(const char *name, char *text, size_t size);
/* The name with the letter l or r at one place exchanged; 0 where there is another. */
int ambulo__flip_letter(const char *name, size_t at, char *text, size_t size);

#endif
