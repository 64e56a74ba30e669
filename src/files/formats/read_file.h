/* formats/read_file.h - a whole regular file into memory, or its checksum. */
#ifndef AMBULO_FORMATS_READ_FILE_H
#define AMBULO_FORMATS_READ_FILE_H

#include "base/alloc.h"
#include "base/diagnostics.h"
#include "formats/sha256.h"

/* *text: the bytes and a NUL, free with ambulo__free. Directories, FIFOs, sockets and
 * devices are refused without blocking. Errors: E_ARGUMENT (an empty name), E_IO (with strerror),
 * E_LIMIT (larger than `limit` bytes), E_MEMORY. */
ambulo_status ambulo__read_file(const char *path, size_t limit, const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics, char **text, size_t *length);

/* SHA-256 of a regular file, whatever its size; needs no memory. Errors: E_IO. */
ambulo_status ambulo__digest_file(const char *path, ambulo_diagnostics *diagnostics,
                                  char text[AMBULO__SHA256_TEXT]);

#endif
