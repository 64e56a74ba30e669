/* exchange/npz.c - see npz.h. */
#include "exchange/npz.h"

#include <stdio.h>
#include <string.h>

/* zip's signatures; 1980-01-01, the zero of its dates */
enum { LOCAL = 0x04034b50, CENTRAL = 0x02014b50, END = 0x06054b50, DATE = 0x0021, VERSION = 20 };
/* data of an array begin at a multiple of this in its .npy */
enum { ALIGN = 64, MAGIC = 10 };

uint32_t ambulo__crc32(uint32_t crc, const char *bytes, size_t length) {
  crc = ~crc;
  for (size_t i = 0; i < length; i++) {
    crc ^= (unsigned char)bytes[i];
    for (int bit = 0; bit < 8; bit++) crc = (crc >> 1) ^ (crc & 1U ? 0xedb88320U : 0U);
  }
  return ~crc;
}

static void put(ambulo__text_buffer *text, uint64_t value, int bytes) {
  for (int i = 0; i < bytes; i++)
    ambulo__text_append_char(text, (char)(unsigned char)(value >> (8 * i) & 0xffU));
}

/* what local headers and the directory say alike */
static void put_common(ambulo__text_buffer *text, const ambulo__npz_entry *e) {
  put(text, VERSION, 2);
  put(text, 0, 2); /* flags */
  put(text, 0, 2); /* stored */
  put(text, 0, 2); /* time */
  put(text, DATE, 2);
  put(text, e->crc, 4);
  put(text, e->size, 4);
  put(text, e->size, 4);
  put(text, strlen(e->name), 2);
  put(text, 0, 2); /* no extra field */
}

void ambulo__npz_begin(ambulo__npz *npz, ambulo__text_buffer *text) {
  *npz = (ambulo__npz){.text = text};
}

/* magic, version, length of the description, description: all of a multiple of ALIGN bytes */
static void put_description(ambulo__text_buffer *array, const char *type, int dimensions,
                            const size_t *shape) {
  char said[160];
  int length =
      snprintf(said, sizeof said, "{'descr': '%s', 'fortran_order': False, 'shape': (", type);
  for (int i = 0; i < dimensions; i++)
    length += snprintf(said + length, sizeof said - (size_t)length, "%zu, ", shape[i]);
  length += snprintf(said + length, sizeof said - (size_t)length, "), }");
  int blanks = ALIGN - 1 - (MAGIC + length) % ALIGN;
  ambulo__text_append_bytes(array, "\x93NUMPY\x01\x00", 8);
  put(array, (uint64_t)(length + blanks + 1), 2);
  ambulo__text_append(array, said);
  while (blanks-- > 0) ambulo__text_append_char(array, ' ');
  ambulo__text_append_char(array, '\n');
}

static void add(ambulo__npz *npz, const char *name, const ambulo__text_buffer *array) {
  if (npz->count == AMBULO__NPZ_ARRAYS || array->length > UINT32_MAX ||
      npz->text->length > UINT32_MAX - array->length) {
    npz->too_large = 1;
    return;
  }
  ambulo__npz_entry *e = &npz->entry[npz->count++];
  (void)snprintf(e->name, sizeof e->name, "%.*s.npy", (int)AMBULO__NPZ_NAME, name);
  e->at = npz->text->length;
  e->size = array->length;
  e->crc = ambulo__crc32(0, ambulo__text_data(array), array->length);
  put(npz->text, LOCAL, 4);
  put_common(npz->text, e);
  ambulo__text_append(npz->text, e->name);
  ambulo__text_append_bytes(npz->text, ambulo__text_data(array), array->length);
}

void ambulo__npz_numbers(ambulo__npz *npz, const char *name, const double *values, int dimensions,
                         const size_t *shape) {
  ambulo__text_buffer array;
  size_t count = 1;
  ambulo__text_init_part(&array, npz->text);
  put_description(&array, "<f8", dimensions, shape);
  for (int i = 0; i < dimensions; i++) count *= shape[i];
  for (size_t i = 0; i < count; i++) {
    uint64_t bits;
    memcpy(&bits, &values[i], sizeof bits);
    put(&array, bits, 8);
  }
  add(npz, name, &array);
  ambulo__text_free(&array);
}

void ambulo__npz_texts(ambulo__npz *npz, const char *name, const char *const *texts, size_t count) {
  ambulo__text_buffer array;
  char type[24];
  size_t longest = 1;
  for (size_t i = 0; i < count; i++)
    longest = strlen(texts[i]) > longest ? strlen(texts[i]) : longest;
  (void)snprintf(type, sizeof type, "<U%zu", longest);
  ambulo__text_init_part(&array, npz->text);
  put_description(&array, type, 1, &count);
  for (size_t i = 0; i < count; i++) {
    size_t length = strlen(texts[i]);
    for (size_t c = 0; c < longest; c++) {
      unsigned char letter = c < length ? (unsigned char)texts[i][c] : 0;
      put(&array, letter < 0x80 ? letter : '?', 4);
    }
  }
  add(npz, name, &array);
  ambulo__text_free(&array);
}

ambulo_status ambulo__npz_end(ambulo__npz *npz) {
  size_t at = npz->text->length;
  for (int i = 0; i < npz->count; i++) {
    const ambulo__npz_entry *e = &npz->entry[i];
    put(npz->text, CENTRAL, 4);
    put(npz->text, VERSION, 2);
    put_common(npz->text, e);
    put(npz->text, 0, 2); /* no comment */
    put(npz->text, 0, 2); /* disk */
    put(npz->text, 0, 2); /* attributes, inside and outside */
    put(npz->text, 0, 4);
    put(npz->text, e->at, 4);
    ambulo__text_append(npz->text, e->name);
  }
  size_t size = npz->text->length - at;
  put(npz->text, END, 4);
  put(npz->text, 0, 4); /* disks */
  put(npz->text, (uint64_t)npz->count, 2);
  put(npz->text, (uint64_t)npz->count, 2);
  put(npz->text, size, 4);
  put(npz->text, at, 4);
  put(npz->text, 0, 2);
  if (npz->too_large || npz->text->length > UINT32_MAX) return AMBULO_E_LIMIT;
  return ambulo__text_status(npz->text);
}
