/* formats/read_file.c - POSIX reading; see read_file.h for what is refused. */
#include "formats/read_file.h"

#include "formats/atomic_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* reads to the end or to `limit` + 1 bytes; -1 with errno on failure */
static ssize_t read_all(int file, char *buffer, size_t capacity) {
  size_t length = 0;
  while (length < capacity) {
    ssize_t count = read(file, buffer + length, capacity - length);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return -1;
    if (count == 0) break;
    length += (size_t)count;
  }
  return (ssize_t)length;
}

static const char *hint_about_folder(int folder) {
  struct stat info;
  if (fstatat(folder, "solution.yaml", &info, 0) == 0)
    return "a result folder: its solution.yaml, or its motion.csv, may be meant";
  if (fstatat(folder, "batch.json", &info, 0) == 0)
    return "a batch folder: 'ambulo collect' takes it, and 'ambulo batch --status'";
  return NULL;
}

/* *info of an open file that is a regular one */
static ambulo_status inspect(int file, const char *path, ambulo_diagnostics *diagnostics,
                             struct stat *info) {
  ambulo__place place = {.file = path};
  if (fstat(file, info) != 0) return ambulo__io_error(diagnostics, path, "inspect");
  if (S_ISREG(info->st_mode)) return AMBULO_OK;
  int folder = S_ISDIR(info->st_mode);
  return ambulo__error(diagnostics, AMBULO_E_IO, place, folder ? hint_about_folder(file) : NULL,
                       "not a regular file%s", folder ? " (it is a folder)" : "");
}

static ambulo_status read_open_file(int file, const char *path, size_t limit,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, char **text, size_t *length) {
  ambulo__place place = {.file = path};
  struct stat info;
  ambulo_status status = inspect(file, path, diagnostics, &info);
  if (status) return status;
  if ((unsigned long long)info.st_size > (unsigned long long)limit) {
    return ambulo__error(diagnostics, AMBULO_E_LIMIT, place, NULL,
                         "file too large (got %lld bytes); expected at most %zu",
                         (long long)info.st_size, limit);
  }
  size_t size = (size_t)info.st_size;
  char *data = ambulo__alloc(allocator, size + 1, 1);
  if (!data) {
    return ambulo__error(diagnostics, AMBULO_E_MEMORY, place, NULL, "cannot allocate %zu bytes",
                         size + 1);
  }
  ssize_t count = read_all(file, data, size);
  if (count < 0) {
    status = ambulo__io_error(diagnostics, path, "read");
    ambulo__free(allocator, data);
    return status;
  }
  if ((size_t)count < size) {
    ambulo__free(allocator, data);
    return ambulo__error(diagnostics, AMBULO_E_IO, place, NULL,
                         "ended after %zd of %zu bytes: it was cut short while it was read", count,
                         size);
  }
  data[count] = '\0';
  *text = data;
  *length = (size_t)count;
  return AMBULO_OK;
}

/* O_NONBLOCK: opening a FIFO without a writer would wait for one */
static int open_to_read(const char *path) {
  return open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
}

ambulo_status ambulo__read_file(const char *path, size_t limit, const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics, char **text, size_t *length) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_status status = ambulo__expect_path(path, "file", diagnostics);
  if (status) return status;
  int file = open_to_read(path);
  if (file < 0) return ambulo__io_error(diagnostics, path, "open");
  status = read_open_file(file, path, limit, &own, diagnostics, text, length);
  close(file);
  return status;
}

/* -------------------------------------------------------------------- SHA-256
 *
 * As FIPS 180-4 writes it down: names and section numbers are its own. */

enum { BLOCK = 64, WORDS = 64, LENGTH_AT = 56, PIECE = 1024 * BLOCK };

/* 4.2.2: the first 32 bits of the fractional parts of the cube roots of the first 64 primes */
static const uint32_t K[WORDS] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

static uint32_t rotate(uint32_t x, int n) {
  return x >> n | x << (32 - n);
}

/* 6.2.2, step 1: the message schedule */
static void schedule(uint32_t W[WORDS], const unsigned char *block) {
  for (int t = 0; t < 16; t++)
    W[t] = (uint32_t)block[4 * t] << 24 | (uint32_t)block[4 * t + 1] << 16 |
           (uint32_t)block[4 * t + 2] << 8 | (uint32_t)block[4 * t + 3];
  for (int t = 16; t < WORDS; t++) {
    uint32_t x = W[t - 15], y = W[t - 2];
    uint32_t sigma0 = rotate(x, 7) ^ rotate(x, 18) ^ x >> 3;
    uint32_t sigma1 = rotate(y, 17) ^ rotate(y, 19) ^ y >> 10;
    W[t] = sigma1 + W[t - 7] + sigma0 + W[t - 16];
  }
}

/* 6.2.2, steps 2 to 4 */
static void compress(uint32_t H[8], const unsigned char *block) {
  uint32_t W[WORDS];
  schedule(W, block);
  uint32_t a = H[0], b = H[1], c = H[2], d = H[3], e = H[4], f = H[5], g = H[6], h = H[7];
  for (int t = 0; t < WORDS; t++) {
    uint32_t sum1 = rotate(e, 6) ^ rotate(e, 11) ^ rotate(e, 25);
    uint32_t choice = (e & f) ^ (~e & g);
    uint32_t T1 = h + sum1 + choice + K[t] + W[t];
    uint32_t sum0 = rotate(a, 2) ^ rotate(a, 13) ^ rotate(a, 22);
    uint32_t majority = (a & b) ^ (a & c) ^ (b & c);
    h = g;
    g = f;
    f = e;
    e = d + T1;
    d = c;
    c = b;
    b = a;
    a = T1 + sum0 + majority;
  }
  const uint32_t working[8] = {a, b, c, d, e, f, g, h};
  for (int i = 0; i < 8; i++) H[i] += working[i];
}

/* 5.3.3: square roots of the first eight primes */
static const uint32_t first_state[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                        0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};

/* all whole blocks; what is left of `length` */
static size_t compress_blocks(uint32_t H[8], const unsigned char *bytes, size_t length) {
  for (; length >= BLOCK; bytes += BLOCK, length -= BLOCK) compress(H, bytes);
  return length;
}

/* The rest of a message of `length` bytes, less than a block. 5.1.1: a one bit, zeros, and the
 * length in bits in the last eight bytes of a block. */
static void finish(uint32_t H[8], const unsigned char *rest, uint64_t length,
                   char text[AMBULO__SHA256_TEXT]) {
  static const char digits[] = "0123456789abcdef";
  unsigned char last[2 * BLOCK] = {0};
  size_t count = (size_t)(length % BLOCK), size = count < LENGTH_AT ? BLOCK : 2 * BLOCK;
  memcpy(last, rest, count);
  last[count] = 0x80;
  for (int i = 0; i < 8; i++) last[size - 1 - (size_t)i] = (unsigned char)(8 * length >> 8 * i);
  (void)compress_blocks(H, last, size);
  for (int i = 0; i < 64; i++) text[i] = digits[H[i / 8] >> (28 - 4 * (i % 8)) & 15];
  text[64] = '\0';
}

void ambulo__sha256_of(const void *bytes, size_t length, char text[AMBULO__SHA256_TEXT]) {
  uint32_t H[8];
  memcpy(H, first_state, sizeof H);
  size_t rest = compress_blocks(H, bytes, length);
  finish(H, (const unsigned char *)bytes + (length - rest), length, text);
}

ambulo_status ambulo__digest_file(const char *path, ambulo_diagnostics *diagnostics,
                                  char text[AMBULO__SHA256_TEXT]) {
  unsigned char piece[PIECE];
  struct stat info;
  uint32_t H[8];
  uint64_t length = 0;
  int file = open_to_read(path);
  if (file < 0) return ambulo__io_error(diagnostics, path, "open");
  ambulo_status status = inspect(file, path, diagnostics, &info);
  ssize_t count = PIECE;
  memcpy(H, first_state, sizeof H);
  while (!status && count == PIECE) {
    count = read_all(file, (char *)piece, sizeof piece);
    if (count < 0) status = ambulo__io_error(diagnostics, path, "read");
    if (count <= 0) break;
    length += (uint64_t)count;
    (void)compress_blocks(H, piece, (size_t)count);
  }
  close(file);
  if (status) return status;
  finish(H, piece + (count > 0 ? count - count % BLOCK : 0), length, text);
  return AMBULO_OK;
}

/* ------------------------------------------------------------- seals and hashes */

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

unsigned long long ambulo__hash_text(unsigned long long hash, const char *text) {
  do {
    hash = (hash ^ (unsigned char)*text) * 1099511628211ULL;
  } while (*text++);
  return hash;
}

unsigned long long ambulo__hash_word(unsigned long long hash, unsigned long long word) {
  for (int i = 0; i < 8; i++) {
    hash = (hash ^ (word & 0xff)) * 1099511628211ULL;
    word >>= 8;
  }
  return hash;
}
