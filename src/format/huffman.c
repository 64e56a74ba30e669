/* format/huffman.c - see huffman.h.
 *
 * The two rarest nodes become one, again and again (Huffman 1952). Where a code comes out too long,
 * counts are halved, which brings them nearer to each other, and it is done again. Codes follow
 * from the lengths: shorter ones first, of one length in the order of the symbols.
 */
#include "format/huffman.h"

#include <string.h>

enum { NODES = 2 * AMBULO__HUFFMAN_MOST };

/* the rarest node that has no parent yet, but not `other`; -1: none */
static int rarest(const unsigned *weight, const int *parent, int nodes, int other) {
  int found = -1;
  for (int i = 0; i < nodes; i++)
    if (i != other && weight[i] > 0 && parent[i] < 0 && (found < 0 || weight[i] < weight[found]))
      found = i;
  return found;
}

/* lengths of the codes; the longest */
static int measure(const unsigned *count, int symbols, unsigned char *length) {
  unsigned weight[NODES];
  int parent[NODES], nodes = symbols, longest = 0;
  memcpy(weight, count, (size_t)symbols * sizeof *weight);
  for (int i = 0; i < NODES; i++) parent[i] = -1;
  for (;;) {
    int one = rarest(weight, parent, nodes, -1), other = rarest(weight, parent, nodes, one);
    if (other < 0) break;
    weight[nodes] = weight[one] + weight[other];
    parent[one] = parent[other] = nodes++;
  }
  for (int i = 0; i < symbols; i++) {
    int bits = 0;
    for (int at = i; parent[at] >= 0; at = parent[at]) bits++;
    length[i] = (unsigned char)bits;
    if (bits > longest) longest = bits;
  }
  return longest;
}

static unsigned short reversed(unsigned code, int bits) {
  unsigned out = 0;
  for (int i = 0; i < bits; i++) out |= ((code >> i) & 1u) << (bits - 1 - i);
  return (unsigned short)out;
}

static void number(ambulo__huffman *h) {
  unsigned next[AMBULO__HUFFMAN_LONGEST + 2] = {0}, of_length[AMBULO__HUFFMAN_LONGEST + 2] = {0};
  for (int i = 0; i < h->symbols; i++) of_length[h->length[i]] += h->length[i] > 0;
  for (int bits = 1; bits <= AMBULO__HUFFMAN_LONGEST; bits++)
    next[bits + 1] = (next[bits] + of_length[bits]) << 1;
  for (int i = 0; i < h->symbols; i++)
    if (h->length[i]) h->code[i] = reversed(next[h->length[i]]++, h->length[i]);
}

void ambulo__huffman_make(const unsigned *count, int symbols, int longest, ambulo__huffman *h) {
  unsigned own[AMBULO__HUFFMAN_MOST];
  int used = 0;
  memcpy(own, count, (size_t)symbols * sizeof *own);
  for (int i = 0; i < symbols; i++) used += own[i] > 0;
  for (int i = 0; i < symbols && used < 2; i++) {
    used += own[i] == 0;
    if (own[i] == 0) own[i] = 1;
  }
  memset(h, 0, sizeof *h);
  h->symbols = symbols;
  while (measure(own, symbols, h->length) > longest)
    for (int i = 0; i < symbols; i++) own[i] = (own[i] + 1) / 2;
  number(h);
}
