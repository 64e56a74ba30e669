/* show/script_text.h - JSON that stands inside of a page's <script> element.
 *
 * JSON has '<' and the line ends of JavaScript, U+2028 and U+2029, only inside of texts, where they
 * may as well be written \u003c, \u2028 and \u2029: then no text, whatever it says, can end the
 * element or open a comment in it. Blanks outside of texts are left out. */
#ifndef AMBULO_SHOW_SCRIPT_TEXT_H
#define AMBULO_SHOW_SCRIPT_TEXT_H

#include "base/text_buffer.h"

/* Appends JSON so. */
void ambulo__script_json(ambulo__text_buffer *out, const char *json, size_t length);
/* Appends a text of any bytes as a JSON text; what is not UTF-8 becomes U+FFFD. */
void ambulo__script_text(ambulo__text_buffer *out, const char *text);
/* Appends a number to six digits, a whole one to all of its digits, where the text reads as one;
 * null for "null" and for nothing; else the text. */
void ambulo__script_value(ambulo__text_buffer *out, const char *text);

#endif
