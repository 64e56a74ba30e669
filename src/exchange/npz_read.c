/* exchange/npz_read.c - see npz_read.h. */
#include "exchange/npz_read.h"

#include "formats/deflate.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { END = 0x06054b50, CENTRAL = 0x02014b50, LOCAL = 0x04034b50 };
enum { END_SIZE = 22, CENTRAL_SIZE = 46, LOCAL_SIZE = 30, STORED = 0, DEFLATED = 8 };
static const size_t most_bytes = (size_t)1 << 30;

typedef struct archive {
  const unsigned char *at;
  size_t length;
  const char *file;
  ambulo_diagnostics *diagnostics;
} archive;

static uint64_t number(const archive *a, size_t at, size_t bytes) {
  uint64_t value = 0;
  for (size_t i = bytes; i-- > 0;) value = value << 8 | a->at[at + i];
  return value;
}

static ambulo_status damaged(const archive *a, const char *what) {
  return ambulo__error(a->diagnostics, AMBULO_E_PARSE, (ambulo__place){.file = a->file}, NULL,
                       "%s; expected a .npz that numpy.savez wrote", what);
}

/* where the directory's end is; 0: nowhere */
static size_t find_end(const archive *a) {
  for (size_t at = a->length < END_SIZE ? 0 : a->length - END_SIZE; at > 0; at--)
    if (number(a, at, 4) == END) return at;
  return 0;
}

/* the entry `name`.npy: its bytes in the archive */
typedef struct entry {
  size_t at, packed, size;
  uint64_t method;
} entry;

static ambulo_status find_entry(const archive *a, const char *name, entry *e, int *found) {
  size_t end = find_end(a), wanted = strlen(name);
  *found = 0;
  if (!end) return damaged(a, "no directory of a zip archive");
  size_t count = number(a, end + 10, 2), at = number(a, end + 16, 4);
  for (size_t i = 0; i < count; i++) {
    if (at + CENTRAL_SIZE > a->length || number(a, at, 4) != CENTRAL)
      return damaged(a, "the directory of the archive is damaged");
    size_t length = number(a, at + 28, 2), local = number(a, at + 42, 4);
    if (at + CENTRAL_SIZE + length > a->length) return damaged(a, "a name is cut off");
    const char *text = (const char *)a->at + at + CENTRAL_SIZE;
    if (length == wanted + 4 && memcmp(text, name, wanted) == 0 &&
        memcmp(text + wanted, ".npy", 4) == 0) {
      *e = (entry){.method = number(a, at + 10, 2),
                   .packed = number(a, at + 20, 4),
                   .size = number(a, at + 24, 4)};
      if (local + LOCAL_SIZE > a->length || number(a, local, 4) != LOCAL)
        return damaged(a, "an entry of the archive is damaged");
      e->at = local + LOCAL_SIZE + number(a, local + 26, 2) + number(a, local + 28, 2);
      if (e->at > a->length || e->packed > a->length - e->at)
        return damaged(a, "an entry of the archive is cut off");
      *found = 1;
      return AMBULO_OK;
    }
    at += CENTRAL_SIZE + length + number(a, at + 30, 2) + number(a, at + 32, 2);
  }
  return AMBULO_OK;
}

/* --------------------------------------------------------------------------- .npy */

/* shape "(12, 156), " to rows and columns, dimensions behind the first put together */
static int read_shape(const char *text, ambulo__npz_array *array) {
  const char *at = strstr(text, "'shape'");
  at = at ? strchr(at, '(') : NULL;
  if (!at) return 0;
  array->rows = array->columns = 1;
  for (int dimension = 0; *at && *at != ')'; at++) {
    char *end = NULL;
    unsigned long long size = strtoull(at + 1, &end, 10);
    if (end == at + 1) break;
    if (size > most_bytes || (size && array->columns > most_bytes / size)) return 0;
    if (dimension++ == 0)
      array->rows = (size_t)size;
    else
      array->columns *= (size_t)size;
    at = strpbrk(end, ",)");
    if (!at || *at == ')') break;
  }
  return array->rows == 0 || array->columns <= most_bytes / array->rows;
}

static double value_at(const char *data, size_t index, char kind, size_t bytes) {
  const char *at = data + index * bytes;
  if (kind == 'f' && bytes == 8) {
    double value;
    memcpy(&value, at, sizeof value);
    return value;
  }
  if (kind == 'f') {
    float value;
    memcpy(&value, at, sizeof value);
    return (double)value;
  }
  int64_t wide = 0;
  int32_t narrow = 0;
  memcpy(bytes == 8 ? (void *)&wide : (void *)&narrow, at, bytes);
  return bytes == 8 ? (double)wide : (double)narrow;
}

static ambulo_status read_array(const archive *a, const char *name, const char *data, size_t length,
                                const ambulo_allocator *allocator, ambulo__npz_array *array) {
  enum { MAGIC = 10, MOST = 4096 };
  archive npy = {.at = (const unsigned char *)data, .length = length};
  char said[MOST];
  if (length < MAGIC + 2 || memcmp(data, "\x93NUMPY", 6) != 0)
    return damaged(a, "an entry is no array");
  size_t wide = data[6] == 1 ? 2 : 4, size = number(&npy, 8, wide), start = 8 + wide + size;
  if (size >= MOST || start > length) return damaged(a, "the head of an array is damaged");
  memcpy(said, data + 8 + wide, size);
  said[size] = '\0';
  const char *type = strstr(said, "'descr': '");
  char kind = type ? type[11] : '?', digit = type ? type[12] : '?';
  size_t bytes = digit == '4' ? 4 : 8;
  if (!type || type[10] != '<' || (kind != 'f' && kind != 'i') || (digit != '4' && digit != '8'))
    return ambulo__error(a->diagnostics, AMBULO_E_SCHEMA, (ambulo__place){.file = a->file}, NULL,
                         "array '%s' is of another kind; expected floats or integers of 4 or 8 "
                         "bytes",
                         name);
  if (!read_shape(said, array) || array->rows * array->columns > (length - start) / bytes)
    return damaged(a, "an array is shorter than its shape");
  size_t count = array->rows * array->columns;
  array->values = ambulo__alloc(allocator, count, sizeof *array->values);
  if (!array->values) return AMBULO_E_MEMORY;
  int by_columns = strstr(said, "'fortran_order': True") != NULL; /* of two dimensions */
  for (size_t i = 0; i < count; i++) {
    size_t row = i / array->columns, column = i % array->columns;
    array->values[i] =
        value_at(data + start, by_columns ? column * array->rows + row : i, kind, bytes);
  }
  return AMBULO_OK;
}

ambulo_status ambulo__npz_read(const char *bytes, size_t length, const char *name, const char *file,
                               const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                               ambulo__npz_array *array, int *found) {
  archive a = {(const unsigned char *)bytes, length, file, diagnostics};
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  entry e = {.at = 0};
  *array = (ambulo__npz_array){.values = NULL};
  ambulo_status status = find_entry(&a, name, &e, found);
  if (status || !*found) return status;
  if (e.method == STORED) return read_array(&a, name, bytes + e.at, e.packed, &own, array);
  if (e.method != DEFLATED || e.size > most_bytes)
    return damaged(&a, "an entry is packed in another way");
  ambulo__text_buffer out;
  ambulo__text_init(&out, &own);
  status = ambulo__inflate(&out, bytes + e.at, e.packed, e.size);
  if (status == AMBULO_E_IO)
    (void)ambulo__error(diagnostics, status, (ambulo__place){.file = file},
                        "save it by numpy.savez",
                        "it is deflated, and ambulo was built without "
                        "zlib");
  if (status == AMBULO_E_PARSE) (void)damaged(&a, "a deflated entry is damaged");
  if (!status) status = read_array(&a, name, ambulo__text_data(&out), out.length, &own, array);
  ambulo__text_free(&out);
  return status;
}
