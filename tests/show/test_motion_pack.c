/* Packed motions: each value comes back within half a step, whatever the motions are; those that
 * differ in few ways take few bytes. */
#include "show/motion_pack.h"

#include "support/fail_alloc.h"
#include "support/packed_motions.h"

enum { SERIES = 12, SAMPLES = 41, VALUES = SERIES * SAMPLES, MOST = 64 };

static float motion[MOST][VALUES];
static const float *rows[MOST];

static ambulo__motions motions(int count) {
  for (int i = 0; i < count; i++) rows[i] = motion[i];
  return (ambulo__motions){.motion = rows,
                           .count = count,
                           .series = SERIES,
                           .samples = SAMPLES,
                           .every = 1,
                           .finer = 1.0};
}

static unsigned dice = 1;
static double random_number(void) { /* -1 to 1 */
  dice = dice * 1664525u + 1013904223u;
  return (double)(dice >> 8) / 8388608.0 - 1.0;
}

/* packs, reads again and compares; *length: bytes */
static packed_motions pack(const ambulo__motions *m, size_t *length) {
  ambulo__text_buffer out;
  ambulo__text_init(&out, NULL);
  assert_int_equal(ambulo__motion_pack(&out, m), AMBULO_OK);
  int samples = (m->samples - 1) / m->every + 1;
  packed_motions p = read_motions(out.data, out.length, m->count, m->series, samples);
  *length = out.length;
  assert_int_equal(p.length, out.length);
  size_t next = 0;
  for (int i = 0; i < m->count; i++)
    for (int s = 0; s < m->series; s++)
      for (int k = 0; k < m->samples; k += m->every, next++) {
        double want = m->finer * (double)motion[i][s * m->samples + k];
        if (fabs(p.values[next] - want) <= 0.5 + 1e-12 * fabs(want)) continue;
        print_error("motion %d, series %d, sample %d: %g, expected %g\n", i, s, k, p.values[next],
                    want);
        fail();
      }
  free(p.values);
  p.values = NULL;
  ambulo__text_free(&out);
  return p;
}

/* of each a sum of `ways` curves that all share, and noise that a step swallows */
static void fill_alike(int count, int ways, double noise) {
  dice = 7;
  for (int i = 0; i < count; i++) {
    for (int v = 0; v < VALUES; v++)
      motion[i][v] = (float)(400.0 * sin(0.1 * v) + noise * random_number());
    for (int w = 0; w < ways; w++) {
      double amount = 100.0 * random_number();
      for (int v = 0; v < VALUES; v++) motion[i][v] += (float)(amount * sin(0.013 * (w + 2) * v));
    }
  }
}

static void few_ways(void **state) {
  (void)state;
  size_t length;
  fill_alike(60, 3, 0.2);
  ambulo__motions m = motions(60);
  packed_motions p = pack(&m, &length);
  assert_true(p.components >= 3 && p.components <= 6);
  assert_int_equal(p.order, 0);
  assert_true(length < 60 * VALUES / 8); /* a bit a value */
}

static void any_number_of_motions(void **state) {
  (void)state;
  size_t length;
  fill_alike(4, 4, 3.0);
  for (int count = 1; count <= 4; count++) {
    ambulo__motions m = motions(count);
    packed_motions p = pack(&m, &length);
    assert_true(p.components < count || count == 1);
  }
}

static void nothing_in_common(void **state) {
  (void)state;
  size_t length;
  dice = 3;
  for (int i = 0; i < 30; i++)
    for (int s = 0; s < SERIES; s++) {
      double a = random_number(), b = random_number(), c = random_number();
      for (int k = 0; k < SAMPLES; k++)
        motion[i][s * SAMPLES + k] = (float)(900.0 * sin(0.2 * a * k + 3.0 * b) + 50.0 * c * k);
    }
  ambulo__motions m = motions(30);
  packed_motions p = pack(&m, &length);
  assert_int_equal(p.components, 0);
  assert_int_equal(p.order, 2);
}

static void jumps_and_large_values(void **state) {
  (void)state;
  size_t length;
  fill_alike(20, 2, 0.0);
  for (int i = 0; i < 20; i++)
    for (int k = 0; k < SAMPLES; k++) motion[i][k] = k == i ? 3000.0f : 0.0f;
  for (int v = 0; v < VALUES; v += 7) motion[11][v] = -4e9f * (float)v;
  ambulo__motions m = motions(20);
  (void)pack(&m, &length);
}

static void coarser_and_finer(void **state) {
  (void)state;
  size_t whole, fine, few;
  fill_alike(10, 2, 0.3);
  ambulo__motions m = motions(10);
  (void)pack(&m, &whole);
  m.finer = 4.0;
  (void)pack(&m, &fine);
  m.finer = 1.0;
  m.every = 4;
  (void)pack(&m, &few);
  assert_true(few < whole && whole < fine);
}

static void the_same_bytes(void **state) {
  (void)state;
  ambulo__text_buffer one, other;
  ambulo__text_init(&one, NULL);
  ambulo__text_init(&other, NULL);
  fill_alike(40, 5, 0.4);
  ambulo__motions m = motions(40);
  assert_int_equal(ambulo__motion_pack(&one, &m), AMBULO_OK);
  assert_int_equal(ambulo__motion_pack(&other, &m), AMBULO_OK);
  assert_int_equal(one.length, other.length);
  assert_memory_equal(one.data, other.data, one.length);
  ambulo__text_free(&one);
  ambulo__text_free(&other);
}

static void memory_may_run_out_anywhere(void **state) {
  (void)state;
  fill_alike(5, 2, 0.3);
  ambulo__motions m = motions(5);
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__text_buffer out;
    ambulo__text_init(&out, &allocator);
    ambulo_status status = ambulo__motion_pack(&out, &m);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__text_free(&out);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(few_ways),
      cmocka_unit_test(any_number_of_motions),
      cmocka_unit_test(nothing_in_common),
      cmocka_unit_test(jumps_and_large_values),
      cmocka_unit_test(coarser_and_finer),
      cmocka_unit_test(the_same_bytes),
      cmocka_unit_test(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests_name("page/motion_pack", tests, NULL, NULL);
}
