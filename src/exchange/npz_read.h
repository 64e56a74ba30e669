/* exchange/npz_read.h - arrays of numbers from NumPy's .npz: a zip archive of .npy files, stored or
 * deflated (PKWARE's APPNOTE; NEP 1, versions 1 and 2). */
#ifndef AMBULO_EXCHANGE_NPZ_READ_H
#define AMBULO_EXCHANGE_NPZ_READ_H

#include "base/diagnostics.h"
#include "base/text_buffer.h"

typedef struct ambulo__npz_array {
  double *values;       /* [rows][columns], the last index fastest */
  size_t rows, columns; /* of a scalar 1, of a vector its length and 1 */
} ambulo__npz_array;

/* The array `name` of an archive in memory; `file` is for messages. *found is 0, and the array is
 * empty, where there is none of that name. Free its values with ambulo__free. Integers and floats
 * of 4 and 8 bytes, little-endian, by rows or (of two dimensions) by columns. Errors: E_PARSE,
 * E_SCHEMA (another type), E_LIMIT, E_IO (deflated, and built without zlib), E_MEMORY. */
ambulo_status ambulo__npz_read(const char *bytes, size_t length, const char *name, const char *file,
                               const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                               ambulo__npz_array *array, int *found);

#endif
