/* formats/text_hash.h - hashes of texts and numbers. */
#ifndef AMBULO_FORMATS_TEXT_HASH_H
#define AMBULO_FORMATS_TEXT_HASH_H

/* FNV-1a, 64 bit; start with AMBULO__HASH_START. */
#define AMBULO__HASH_START 14695981039346656037ULL
unsigned long long ambulo__hash_text(unsigned long long hash, const char *text);
unsigned long long ambulo__hash_word(unsigned long long hash, unsigned long long word);

#endif
