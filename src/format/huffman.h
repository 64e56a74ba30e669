/* format/huffman.h - prefix codes of least length for given counts, as deflate has them (RFC 1951,
 * 3.2.2). */
#ifndef AMBULO_FORMAT_HUFFMAN_H
#define AMBULO_FORMAT_HUFFMAN_H

enum { AMBULO__HUFFMAN_MOST = 286 /* symbols */, AMBULO__HUFFMAN_LONGEST = 15 /* bits */ };

typedef struct ambulo__huffman {
  int symbols;
  unsigned char length[AMBULO__HUFFMAN_MOST]; /* bits; 0: the symbol does not occur */
  unsigned short code[AMBULO__HUFFMAN_MOST];  /* its first bit is the lowest */
} ambulo__huffman;

/* Of `symbols` >= 2 symbols, each counted; no code is longer than `longest` bits. At least two
 * symbols get one, so that the code is a whole one. */
void ambulo__huffman_make(const unsigned *count, int symbols, int longest,
                          ambulo__huffman *huffman);

#endif
