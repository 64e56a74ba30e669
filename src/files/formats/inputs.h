/* formats/inputs.h - which bytes something was made from.
 *
 * Inputs are a text as sha256sum writes and checks it, a line for each file in the order of
 * reading: "<SHA-256>  <path>\n". A file is what it was when it was first read: other bytes under a
 * known name are an error, since what is made of both would be of neither. */
#ifndef AMBULO_FORMATS_INPUTS_H
#define AMBULO_FORMATS_INPUTS_H

#include "base/text_buffer.h"
#include "formats/json_text.h"
#include "formats/read_file.h"

typedef struct ambulo__inputs {
  ambulo__text_buffer read;   /* what has been read */
  ambulo__text_buffer *known; /* of others before it, to which it adds; NULL: none */
  const char *expected;       /* all that may be read; NULL: whatever there is */
} ambulo__inputs;

/* ambulo__read_file, and takes the file in; inputs NULL: that alone. Errors: also E_IO (other bytes
 * than those known or expected, or a file that is not expected). */
ambulo_status ambulo__inputs_read(ambulo__inputs *inputs, const char *path, size_t limit,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, char **text, size_t *length);

/* The line of a path; NULL: it is not among them. `inputs` may be NULL. */
const char *ambulo__inputs_find(const char *inputs, const char *path);

/* The line at *inputs, in two parts, and *inputs moved behind it; 0: there is none left. The path
 * ends with a line end. */
int ambulo__inputs_next(const char **inputs, char digest[AMBULO__SHA256_TEXT], const char **path,
                        size_t *length);
/* The member "inputs": {path: SHA-256}; nothing without inputs. */
void ambulo__inputs_json(const char *inputs, ambulo__json *json);

#endif
