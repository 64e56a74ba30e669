/* formats/text_hash.c - see text_hash.h. */
#include "formats/text_hash.h"

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
