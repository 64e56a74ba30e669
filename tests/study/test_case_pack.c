/* Motions of a study: as good as there is room for, and those of real results within half a step.
 */
#include "study/case_pack.h"

#include "ambulo/tools/tools.h"
#include "support/fail_alloc.h"
#include "support/inflate.h"
#include "support/messages.h"
#include "support/scene_reading.h"
#include "support/scratch.h"
#include "support/walker_result.h"

enum { COUNT = 4 };

static char folder[COUNT][SCRATCH_PATH + 256];
static char *folders[COUNT];

/* the same walk, a little faster each time */
static void results(void **state) {
  for (int i = 0; i < COUNT; i++) {
    walk w;
    char name[8];
    walk_open(&w, 12);
    for (int k = 0; k < ambulo_problem_variable_count(w.problem); k++)
      w.result->x[k] *= 1.0 + 0.01 * i;
    snprintf(name, sizeof name, "r%d", i);
    snprintf(folder[i], sizeof folder[i], "%s", scratch_path(state, name));
    folders[i] = folder[i];
    assert_int_equal(ambulo_report_write(w.problem, w.result, folder[i], NULL, NULL, NULL),
                     AMBULO_OK);
    walk_close(&w);
  }
}

/* the list; to be freed. stands as told */
static char *packed_in(double room, char *stands) {
  ambulo__text_buffer out;
  ambulo__text_init(&out, NULL);
  memset(stands, 0, COUNT);
  assert_int_equal(ambulo__case_pack(&out, folders, COUNT, room, NULL, stands), AMBULO_OK);
  assert_true((double)out.length <= fmax(room, 2.0));
  char *text = malloc(out.length + 1);
  memcpy(text, ambulo__text_data(&out), out.length + 1);
  ambulo__text_free(&out);
  return text;
}

/* the only block, unpacked; to be freed */
static char *block_of(const char *list, int count, size_t *size) {
  char *map = malloc(strlen(list) + 16);
  sprintf(map, "{\"motions\":%s}", list);
  yaml_case c = yaml_open(map);
  free(map);
  const ambulo__yaml_node *motions = ambulo__yaml_get(c.root, "motions");
  assert_int_equal(ambulo__yaml_items(motions), 1);
  const ambulo__yaml_node *one = ambulo__yaml_item(motions, 0);
  size_t bytes;
  assert_int_equal(ambulo__yaml_integer(ambulo__yaml_get(one, "count"), 0, 99, 0), count);
  char *packed = unbase64(ambulo__yaml_text(ambulo__yaml_get(one, "packed")), &bytes);
  char *block = (char *)unpacked(packed, bytes, size);
  free(packed);
  yaml_shut(&c);
  return block;
}

/* a case of a block, with its series as they were before they were packed */
typedef struct unpacked_case {
  const char *kinds;
  int samples, like;
  double *values; /* [series][samples], in steps; to be freed */
} unpacked_case;

static double next_whole(const char *bytes, size_t *at) {
  double value = 0.0, times = 1.0;
  unsigned byte;
  do {
    byte = (unsigned char)bytes[(*at)++];
    value += times * (byte & 127u);
    times *= 128.0;
  } while (byte > 127u);
  return fmod(value, 2.0) != 0.0 ? -(value + 1.0) / 2.0 : value / 2.0;
}

static unpacked_case read_case(const ambulo__yaml_node *one, const char *bytes,
                               const unpacked_case *before) {
  unpacked_case u = {.kinds = ambulo__yaml_text(ambulo__yaml_get(one, "kinds"))};
  u.samples = ambulo__yaml_integer(ambulo__yaml_get(one, "samples"), 0, 999, -1);
  u.like = ambulo__yaml_integer(ambulo__yaml_get(one, "like"), -1, COUNT, -2);
  size_t count = strlen(u.kinds) * (size_t)u.samples, at = 0;
  u.values = calloc(count, sizeof *u.values);
  double sum = 0.0;
  for (size_t k = 0; k < count; k++) {
    sum = (k % (size_t)u.samples ? sum : 0.0) + next_whole(bytes, &at);
    u.values[k] = sum + (u.like < 0 ? 0.0 : before[u.like].values[k]);
  }
  assert_int_equal(at, ambulo__yaml_integer(ambulo__yaml_get(one, "bytes"), 0, 1 << 30, -1));
  return u;
}

static void assert_like_scene(const unpacked_case *u, const char *path) {
  char *text = read_text(path);
  yaml_case c = yaml_open(text);
  int compared = 0;
  double step = 2e-3 / 4.0;
  const ambulo__yaml_node *points = ambulo__yaml_get(c.root, "points");
  for (int i = 0; i < ambulo__yaml_items(points); i++)
    for (int axis = 0; axis < 3; axis++, compared++)
      for (int k = 0; k < u->samples; k += 20)
        assert_true(fabs(u->values[(3 * i + axis) * u->samples + k] * step -
                         scene_point(c.root, i, axis, k)) <= 0.5001 * step);
  assert_true(compared >= 9);
  for (int i = 0; i < compared; i++) assert_int_equal(u->kinds[i], 'l');
  yaml_shut(&c);
  free(text);
}

/* r2 has fewer series than the others */
static void all_that_there_is(void **state) {
  results(state);
  char *scene = read_text(scratch_path(state, "r2/scene.json")), stands[COUNT];
  strstr(scene, "\"center_of_mass\"")[1] = 'k';
  scratch_write(scratch_path(state, "r2/scene.json"), scene);
  free(scene);
  size_t size;
  char *list = packed_in(1e9, stands), *block = block_of(list, COUNT, &size);
  assert_non_null(strstr(block, "{\"every\":1,\"steps\":{\"l\":0.0005,"));
  yaml_case c = yaml_open(block);
  const ambulo__yaml_node *cases = ambulo__yaml_get(c.root, "cases");
  unpacked_case u[COUNT];
  size_t at = strlen(block) + 1;
  for (int i = 0; i < COUNT; i++) {
    char name[16];
    snprintf(name, sizeof name, "r%d/scene.json", i);
    const ambulo__yaml_node *one = ambulo__yaml_item(cases, i);
    u[i] = read_case(one, block + at, u);
    at += (size_t)ambulo__yaml_integer(ambulo__yaml_get(one, "bytes"), 0, 1 << 30, -1);
    assert_int_equal(u[i].like, i == 0 || i == 2 ? -1 : 0);
    assert_int_equal(u[i].samples, 161);
    assert_like_scene(&u[i], scratch_path(state, name));
    const ambulo__yaml_node *points = ambulo__yaml_get(ambulo__yaml_get(one, "scene"), "points");
    const ambulo__yaml_node *up = ambulo__yaml_item(ambulo__yaml_item(points, 1), 1);
    assert_int_equal(ambulo__yaml_integer(ambulo__yaml_get(up, "series"), 0, 999, -1), 4);
    assert_int_equal(stands[i], 1);
  }
  assert_int_equal(at, size);
  assert_true(strlen(u[2].kinds) + 3 == strlen(u[0].kinds));
  for (int i = 0; i < COUNT; i++) free(u[i].values);
  yaml_shut(&c);
  free(block);
  free(list);
}

static void memory_may_run_out_anywhere(void **state) {
  results(state);
  for (long k = 0;; k += 1 + k / 20) {
    char stands[COUNT] = {0};
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__text_buffer out;
    ambulo__text_init(&out, &allocator);
    ambulo_status status = ambulo__case_pack(&out, folders, COUNT, 1e9, NULL, stands);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__text_free(&out);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
}

/* less and less room: coarser, then fewer samples, then fewer cases, then none */
static void less_room(void **state) {
  results(state);
  char stands[COUNT];
  size_t size;
  int before = COUNT, every = 1, cut = 0;
  char *list = packed_in(1e9, stands);
  double most = (double)strlen(list), step = 0.0;
  free(list);
  for (double room = most + 200.0; before > 0; room *= 0.85) {
    list = packed_in(room, stands);
    int count = 0;
    while (count < COUNT && stands[count]) count++;
    for (int i = count; i < COUNT; i++) assert_int_equal(stands[i], 0);
    assert_true(count <= before);
    before = count;
    if (count == 0) {
      assert_string_equal(list, "[]");
    } else {
      char *block = block_of(list, count, &size);
      int now = atoi(strstr(block, "every\":") + strlen("every\":"));
      double fine = atof(strstr(block, "\"l\":") + strlen("\"l\":"));
      assert_true(now >= every && fine >= step);
      assert_true(count == COUNT || now == 4);
      every = now;
      step = fine;
      cut |= count < COUNT;
      free(block);
    }
    free(list);
  }
  assert_int_equal(every, 4);
  assert_true(cut);
}

static void folders_that_are_none(void **state) {
  results(state);
  char stands[COUNT] = {0};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__text_buffer out;
  ambulo__text_init(&out, NULL);
  folders[2] = (char *)(uintptr_t)scratch_path(state, "nowhere");
  assert_int_equal(ambulo__case_pack(&out, folders, COUNT, 1e9, list, stands), AMBULO_E_IO);
  assert_message(list, 0, "nowhere");
  ambulo__text_clear(&out);
  assert_int_equal(ambulo__case_pack(&out, folders, 0, 1e9, list, stands), AMBULO_OK);
  assert_string_equal(ambulo__text_data(&out), "[]");
  ambulo__text_free(&out);
  ambulo_diagnostics_free(list);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(all_that_there_is),
      TEST(less_room),
      TEST(folders_that_are_none),
      TEST(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests_name("study/case_pack", tests, NULL, NULL);
}
