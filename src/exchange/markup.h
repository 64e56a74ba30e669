/* exchange/markup.h - pieces of XML: names as attributes, vectors, angles of rotations. */
#ifndef AMBULO_EXCHANGE_MARKUP_H
#define AMBULO_EXCHANGE_MARKUP_H

#include "base/text_buffer.h"

/* Text in which & < > " are entities. */
void ambulo__markup_text(ambulo__text_buffer *text, const char *plain);
/* Numbers with blanks between them; -0 is 0. */
void ambulo__markup_numbers(ambulo__text_buffer *text, const double *values, int count);
/* "<tag>numbers</tag>\n" behind `depth` tabs. */
void ambulo__markup_element(ambulo__text_buffer *text, int depth, const char *tag,
                            const double *values, int count);
void ambulo__markup_tabs(ambulo__text_buffer *text, int depth);

/* Angles of R = Rot_x(a) Rot_y(b) Rot_z(c), rad: OpenSim's orientations. */
void ambulo__xyz_of_rotation(const double rotation[3][3], double angles[3]);

#endif
