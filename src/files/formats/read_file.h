/* formats/read_file.h - a whole regular file into memory; checksums and hashes. */
#ifndef AMBULO_FORMATS_READ_FILE_H
#define AMBULO_FORMATS_READ_FILE_H

#include "base/alloc.h"
#include "base/diagnostics.h"
#include "base/text_buffer.h"

/* *text: the bytes and a NUL, free with ambulo__free. Directories, FIFOs, sockets and
 * devices are refused without blocking. Errors: E_ARGUMENT (an empty name), E_IO (with strerror),
 * E_LIMIT (larger than `limit` bytes), E_MEMORY. */
ambulo_status ambulo__read_file(const char *path, size_t limit, const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics, char **text, size_t *length);

/* SHA-256 (FIPS 180-4) in 64 hexadecimal digits and a NUL: it finds damage. sha256sum computes the
 * same. */
enum { AMBULO__SHA256_TEXT = 65 };
void ambulo__sha256_of(const void *bytes, size_t length, char text[AMBULO__SHA256_TEXT]);
/* Of a regular file, whatever its size; needs no memory. Errors: E_IO. */
ambulo_status ambulo__digest_file(const char *path, ambulo_diagnostics *diagnostics,
                                  char text[AMBULO__SHA256_TEXT]);

/* A seal ends a JSON object: its last key is the checksum of all that stands before it. So a file
 * that was cut short, edited or damaged is recognized. By hand: head -n -2 FILE | sha256sum.
 *
 * Ends an object that is still open: appends the key "sha256", the bracket and a line end. */
void ambulo__seal(ambulo__text_buffer *text);
/* 1: the text ends with a seal, and is what was sealed. */
int ambulo__seal_holds(const char *text, size_t length);

/* FNV-1a, 64 bit; start with AMBULO__HASH_START. */
#define AMBULO__HASH_START 14695981039346656037ULL
unsigned long long ambulo__hash_text(unsigned long long hash, const char *text);
unsigned long long ambulo__hash_word(unsigned long long hash, unsigned long long word);

#endif
