/* formats/seal.h - a JSON object whose last key is the checksum of all that stands before it.
 *
 * So a file tells by itself whether it is still what was written: cut short, edited or damaged, it
 * does not. By hand: head -n -2 FILE | sha256sum. */
#ifndef AMBULO_FORMATS_SEAL_H
#define AMBULO_FORMATS_SEAL_H

#include "base/text_buffer.h"

/* Ends an object that is still open: appends the key "sha256", the bracket and a line end. */
void ambulo__seal(ambulo__text_buffer *text);
/* 1: the text ends with a seal, and is what was sealed. */
int ambulo__seal_holds(const char *text, size_t length);

#endif
