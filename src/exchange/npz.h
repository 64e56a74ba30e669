/* exchange/npz.h - NumPy's .npz: a zip archive of .npy arrays, stored without compression.
 *
 *   ambulo__npz archive;
 *   ambulo__npz_begin(&archive, &text);
 *   ambulo__npz_numbers(&archive, "q", q, 2, (size_t[]){rows, columns});
 *   ambulo__npz_end(&archive);
 *
 * Formats: PKWARE's APPNOTE (local headers, central directory), NEP 1 (npy version 1.0). The bytes
 * do not depend on the machine or the clock. */
#ifndef AMBULO_EXCHANGE_NPZ_H
#define AMBULO_EXCHANGE_NPZ_H

#include <stdint.h>

#include "base/text_buffer.h"

enum { AMBULO__NPZ_ARRAYS = 32, AMBULO__NPZ_NAME = 32 };

typedef struct ambulo__npz_entry {
  char name[AMBULO__NPZ_NAME + 8];
  uint32_t crc;
  size_t at, size; /* of the local header; of the array */
} ambulo__npz_entry;

typedef struct ambulo__npz {
  ambulo__text_buffer *text; /* borrowed: the archive, all of it */
  ambulo__npz_entry entry[AMBULO__NPZ_ARRAYS];
  int count;
  int too_large; /* more than the format's 4 GiB, or too many arrays */
} ambulo__npz;

void ambulo__npz_begin(ambulo__npz *npz, ambulo__text_buffer *text);
/* Doubles of shape[dimensions <= 3], the last index fastest. */
void ambulo__npz_numbers(ambulo__npz *npz, const char *name, const double *values, int dimensions,
                         const size_t *shape);
/* Texts, as an array of str. Bytes beyond ASCII become '?'. */
void ambulo__npz_texts(ambulo__npz *npz, const char *name, const char *const *texts, size_t count);
/* The central directory. E_LIMIT or what the text has. */
ambulo_status ambulo__npz_end(ambulo__npz *npz);

/* CRC-32 of ISO 3309, as in zip; crc: 0, or that of the bytes before. */
uint32_t ambulo__crc32(uint32_t crc, const char *bytes, size_t length);

#endif
