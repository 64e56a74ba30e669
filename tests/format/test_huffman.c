/* Codes of least length: a whole tree, none a beginning of another, as short as entropy allows. */
#include "format/huffman.h"

#include "support/test.h"

#include <math.h>

enum { MOST = AMBULO__HUFFMAN_MOST };

/* a whole code: sum 2^-length = 1; codes are unlike in their first bits */
static void is_whole(const ambulo__huffman *h, int longest) {
  double sum = 0.0;
  for (int i = 0; i < h->symbols; i++) {
    assert_true(h->length[i] <= longest);
    if (h->length[i]) sum += ldexp(1.0, -h->length[i]);
    for (int k = 0; k < i; k++) {
      int bits = h->length[i] < h->length[k] ? h->length[i] : h->length[k];
      if (bits > 0) assert_int_not_equal((h->code[i] ^ h->code[k]) & ((1 << bits) - 1), 0);
    }
  }
  assert_close(sum, 1.0, 0);
}

/* counts 8 4 2 1 1 have codes of 1 2 3 4 4 bits, numbered as RFC 1951 does it: 0 10 110 1110 1111
 */
static void halves_are_exact(void **state) {
  (void)state;
  static const unsigned count[] = {1, 8, 0, 2, 4, 1};
  static const int length[] = {4, 1, 0, 3, 2, 4}, code[] = {7, 0, 0, 3, 1, 15};
  ambulo__huffman h;
  ambulo__huffman_make(count, 6, 15, &h);
  is_whole(&h, 15);
  for (int i = 0; i < 6; i++) {
    assert_int_equal(h.length[i], length[i]);
    assert_int_equal(h.code[i], code[i]); /* its first bit is the lowest */
  }
}

static void near_the_entropy(void **state) {
  (void)state;
  unsigned count[MOST], all = 0;
  for (int i = 0; i < MOST; i++) all += count[i] = (unsigned)(1000.0 / (1.0 + i)) + 1;
  ambulo__huffman h;
  ambulo__huffman_make(count, MOST, 15, &h);
  is_whole(&h, 15);
  double bits = 0.0, entropy = 0.0;
  for (int i = 0; i < MOST; i++) {
    double share = (double)count[i] / all;
    bits += share * h.length[i];
    entropy -= share * log2(share);
  }
  assert_true(bits >= entropy && bits < entropy + 0.06);
}

/* Fibonacci's counts have a code of 39 bits where nothing bounds it */
static void none_is_too_long(void **state) {
  (void)state;
  unsigned count[40] = {1, 1};
  for (int i = 2; i < 40; i++) count[i] = count[i - 1] + count[i - 2];
  for (int longest = 6; longest <= 15; longest += 9) {
    ambulo__huffman h;
    ambulo__huffman_make(count, 40, longest, &h);
    is_whole(&h, longest);
    assert_true(h.length[39] <= (longest == 15 ? 2 : 4));
  }
}

static void at_least_two(void **state) {
  (void)state;
  unsigned count[30] = {0};
  ambulo__huffman h;
  ambulo__huffman_make(count, 30, 15, &h);
  is_whole(&h, 1);
  count[17] = 5;
  ambulo__huffman_make(count, 30, 15, &h);
  is_whole(&h, 1);
  assert_int_equal(h.length[17], 1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(halves_are_exact),
      cmocka_unit_test(near_the_entropy),
      cmocka_unit_test(none_is_too_long),
      cmocka_unit_test(at_least_two),
  };
  return cmocka_run_group_tests_name("format/huffman", tests, NULL, NULL);
}
