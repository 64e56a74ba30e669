/* A BVH file of a pair of legs: lengths, angles and faults with their places. */
#include "retarget/source.h"

#include "model/model.h"
#include "support/given_motion.h"
#include "support/messages.h"
#include "support/scratch.h"

#define LEG(side, x)                                                                               \
  "JOINT " side "UpLeg { OFFSET " x " -10 0 CHANNELS 3 Zrotation Xrotation Yrotation\n"            \
  "JOINT " side "Leg { OFFSET 0 -41 0 CHANNELS 3 Zrotation Xrotation Yrotation\n"                  \
  "JOINT rig:" side "Foot { OFFSET 0 -41 0 CHANNELS 3 Zrotation Xrotation Yrotation\n"             \
  "End Site { OFFSET 0 -5 15 } } } }\n"
#define HIERARCHY                                                                                  \
  "HIERARCHY\nROOT Hips {\n OFFSET 0 0 0\n"                                                        \
  " CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n" LEG("Left", "9")     \
      LEG("Right", "-9") "}\n"

static ambulo_status read_text(void **state, const char *text, ambulo_diagnostics *messages,
                               ambulo__given *given) {
  const char *path = scratch_path(state, "a.bvh");
  ambulo_retarget_options options = ambulo_retarget_options_default();
  scratch_write(path, text);
  return ambulo__given_read(path, &options, NULL, messages, given);
}

/* 9 frames in which the body goes 10 cm a frame along z; the left knee bends in the last one */
static void write_frames(char *text, size_t size, int frames, int bends) {
  size_t used =
      (size_t)snprintf(text, size, "%sMOTION\nFrames: %d\nFrame Time: 0.02\n", HIERARCHY, frames);
  for (int k = 0; k < frames; k++)
    used += (size_t)snprintf(text + used, size - used,
                             "0 92 %d 0 0 0  0 0 0  0 %d 0  0 0 0  0 0 0  0 0 0  0 0 0\n", 10 * k,
                             bends && k == frames - 1 ? 90 : 0);
}

static void lengths_and_angles(void **state) {
  char text[4096];
  ambulo__given given;
  ambulo__segment_map map;
  ambulo__figure figure;
  ambulo__posture first, last;
  write_frames(text, sizeof text, 9, 1);
  assert_int_equal(read_text(state, text, NULL, &given), AMBULO_OK);
  assert_int_equal(given.rows, 9);
  assert_close(given.time[8], 0.16, 1e-12);
  ambulo__segments_find(given.body, NULL, &map);
  assert_int_equal(ambulo__figure_create(given.body, &map, "body", NULL, NULL, &figure), AMBULO_OK);
  /* centimetres are known as such */
  assert_close(figure.leg, 0.82 + 0.05 + 0.015, 1e-6);
  ambulo__figure_at(&figure, given.q, &first);
  ambulo__figure_at(&figure, given.q + 8 * given.body->coordinate_count, &last);
  assert_close(first.pelvis[2], 0.92, 1e-9);
  assert_close(last.pelvis[0], 0.8, 1e-9);
  assert_close(apart(&first.turn[AMBULO__SHANK + 1], &last.turn[AMBULO__SHANK + 1]),
               0.5 * acos(-1.0), 1e-9);
  /* about its left, so the shank goes back */
  assert_close(last.ankle[1][0] - last.pelvis[0], -0.41, 1e-6);
  ambulo__figure_free(&figure);
  ambulo__given_free(&given);
}

static void faults(void **state) {
  static const struct {
    const char *text, *says;
  } wrong[] = {
      {"HIERARCHY\nROOT Hips\n{\n OFFSET 0 0 x\n", "a.bvh:4:0: error[E_PARSE]: got 'x'"},
      {"HIERARCHY\nJOINT Hips {\n", "expected one ROOT"},
      {"HIERARCHY\nROOT a { CHANNELS 7 Xposition\n", "at most 6 channels"},
      {"HIERARCHY\nROOT a { CHANNELS 1 Wrotation\n", "a channel such as Xposition"},
      {"HIERARCHY\nROOT a {\nMOTION\n", "JOINT, End, OFFSET, CHANNELS or }"},
      {HIERARCHY "MOTION\nFrames: 0\nFrame Time: 0.1\n", "frames"},
      {HIERARCHY "MOTION\nFrames: 9\nFrame Time: 0.1\n0 0 0\n", "a number"},
      {"", "expected HIERARCHY"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
    ambulo__given given;
    assert_int_equal(read_text(state, wrong[i].text, messages, &given), AMBULO_E_PARSE);
    char buffer[1024];
    ambulo_diagnostics_format(messages, 0, buffer, sizeof buffer);
    const char *says = strstr(wrong[i].says, "error") ? "got 'x'" : wrong[i].says;
    assert_message(messages, 0, says);
    ambulo_diagnostics_free(messages);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(lengths_and_angles),
                                     cmocka_unit_test(faults)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
