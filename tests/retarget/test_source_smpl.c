/* Poses of SMPL, written as numpy has them: the skeleton stands, turns and goes as they say. */
#include "retarget/source.h"

#include "exchange/export.h"
#include "model/model.h"
#include "support/given_motion.h"
#include "support/messages.h"
#include "support/scratch.h"

enum { FRAMES = 10, NUMBERS = 156 };

static double poses[FRAMES][NUMBERS], trans[FRAMES][3];

/* upright in a world whose z is up: the root turns by a right angle about x */
static void stand(void) {
  memset(poses, 0, sizeof poses);
  for (int k = 0; k < FRAMES; k++) {
    poses[k][0] = 0.5 * acos(-1.0);
    trans[k][0] = 0.3;
    trans[k][1] = -0.1 * k; /* the way that it faces */
    trans[k][2] = 1.0;
  }
}

static void write_npz(const char *path, const char *rate_name, int columns) {
  ambulo__text_buffer text;
  ambulo__npz npz;
  const double rate = 50.0;
  ambulo__text_init(&text, NULL);
  ambulo__npz_begin(&npz, &text);
  ambulo__npz_numbers(&npz, "poses", &poses[0][0], 2, (size_t[]){FRAMES, (size_t)columns});
  ambulo__npz_numbers(&npz, "trans", &trans[0][0], 2, (size_t[]){FRAMES, 3});
  ambulo__npz_numbers(&npz, rate_name, &rate, 1, (size_t[]){1});
  assert_int_equal(ambulo__npz_end(&npz), AMBULO_OK);
  FILE *file = fopen(path, "wb");
  assert_non_null(file);
  fwrite(ambulo__text_data(&text), 1, text.length, file);
  assert_int_equal(fclose(file), 0);
  ambulo__text_free(&text);
}

static ambulo_status read_it(const char *path, ambulo_diagnostics *messages, ambulo__given *given) {
  ambulo_retarget_options options = ambulo_retarget_options_default();
  return ambulo__given_read(path, &options, NULL, messages, given);
}

static void stands_and_goes(void **state) {
  const char *path = scratch_path(state, "a.npz");
  ambulo__given given;
  ambulo__segment_map map;
  ambulo__figure figure;
  ambulo__posture first, last;
  ambulo__rigid same = ambulo__rigid_identity();
  stand();
  poses[FRAMES - 1][3 * 4] = 0.6; /* the left knee bends about its left */
  write_npz(path, "mocap_framerate", NUMBERS);
  assert_int_equal(read_it(path, NULL, &given), AMBULO_OK);
  assert_int_equal(given.rows, FRAMES);
  assert_close(given.time[FRAMES - 1], (FRAMES - 1) / 50.0, 1e-12);
  ambulo__segments_find(given.body, NULL, &map);
  assert_int_equal(ambulo__figure_create(given.body, &map, "body", NULL, NULL, &figure), AMBULO_OK);
  ambulo__figure_at(&figure, given.q, &first);
  ambulo__figure_at(&figure, given.q + (FRAMES - 1) * given.body->coordinate_count, &last);
  assert_true(apart(&first.turn[AMBULO__PELVIS], &same) < 1e-9);
  assert_true(apart(&first.turn[AMBULO__SHANK], &same) < 0.15);
  /* arms out at rest: a right angle from hanging */
  assert_close(apart(&first.turn[AMBULO__UPPER_ARM], &same), 0.5 * acos(-1.0), 0.1);
  assert_close(last.pelvis[0] - first.pelvis[0], 0.1 * (FRAMES - 1), 1e-9);
  assert_close(last.pelvis[2] - first.pelvis[2], 0.0, 1e-9);
  assert_close(apart(&first.turn[AMBULO__SHANK + 1], &last.turn[AMBULO__SHANK + 1]), 0.6, 1e-9);
  assert_true(last.ankle[1][0] - last.pelvis[0] < first.ankle[1][0] - first.pelvis[0] - 0.1);
  ambulo__figure_free(&figure);
  ambulo__given_free(&given);
}

static void other_name_of_the_rate(void **state) {
  const char *path = scratch_path(state, "b.npz");
  ambulo__given given;
  stand();
  write_npz(path, "mocap_frame_rate", NUMBERS);
  assert_int_equal(read_it(path, NULL, &given), AMBULO_OK);
  ambulo__given_free(&given);
}

static void says_what_is_missing(void **state) {
  const char *path = scratch_path(state, "c.npz");
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  ambulo__given given;
  stand();
  write_npz(path, "fps", NUMBERS);
  assert_int_equal(read_it(path, messages, &given), AMBULO_E_SCHEMA);
  assert_message(messages, 0, "no array 'mocap_framerate'");
  write_npz(path, "mocap_framerate", 12);
  assert_int_equal(read_it(path, messages, &given), AMBULO_E_SCHEMA);
  assert_message(messages, 1, "poses are 10 x 12");
  ambulo_diagnostics_free(messages);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(stands_and_goes),
                                     cmocka_unit_test(other_name_of_the_rate),
                                     cmocka_unit_test(says_what_is_missing)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
