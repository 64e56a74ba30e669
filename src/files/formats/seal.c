/* formats/seal.c - see seal.h. */
#include "formats/seal.h"
#include "formats/sha256.h"

#include <string.h>

static const char lead[] = "  \"sha256\": \"", tail[] = "\"\n}\n";
enum { LEAD = sizeof lead - 1, TAIL = sizeof tail - 1, DIGITS = AMBULO__SHA256_TEXT - 1 };

void ambulo__seal(ambulo__text_buffer *text) {
  char digest[AMBULO__SHA256_TEXT];
  ambulo__text_append(text, ",\n");
  ambulo__sha256_of(ambulo__text_data(text), text->length, digest);
  ambulo__text_append(text, lead);
  ambulo__text_append(text, digest);
  ambulo__text_append(text, tail);
}

int ambulo__seal_holds(const char *text, size_t length) {
  char digest[AMBULO__SHA256_TEXT];
  if (length < LEAD + DIGITS + TAIL) return 0;
  size_t sealed = length - TAIL - DIGITS - LEAD;
  ambulo__sha256_of(text, sealed, digest);
  return memcmp(text + sealed, lead, LEAD) == 0 &&
         memcmp(text + sealed + LEAD, digest, DIGITS) == 0 &&
         memcmp(text + length - TAIL, tail, TAIL) == 0;
}
