/* A scene read back: series, times between samples, what is none; and pictures of it. */
#include "show/film_scene.h"

#include "support/test.h"

/* a point that goes forward by 1 m from 2 m; another 1 m above it; a step; a box and a capsule */
static const char scene_text[] =
    "{\"schema\": \"ambulo-scene/1\", \"duration\": 2, \"samples\": 3, \"weight\": 100,\n"
    "\"units\": {\"length\": 0.5, \"force\": 10}, \"repeats\": 1, \"travel\": 1, \"rise\": 0,\n"
    "\"ground\": {\"is_there\": 1, \"slope\": 0, \"surfaces\": [%s]},\n"
    "\"points\": [[[4, 1, 0], [0, 0, 0], [0, 0, 0]], [[4, 1, 0], [0, 0, 0], [%s]]],\n"
    "\"center_of_mass\": [[4, 1, 0], [0, 0, 0], [1, 0, 0]],\n"
    "\"bones\": [{\"kind\": \"capsule\", \"side\": \"left\", \"points\": [0, %d], \"radius\": "
    "0.1}],\n"
    "\"forces\": [{\"force\": [[0, 0, 0], [0, 0, 0], [10, 0, 0]],\n"
    "  \"pressure\": [[4, 1, 0], [0, 0, 0], [0, 0, 0]]}],\n"
    "\"obstacles\": [{\"shape\": \"box\", \"center\": [9, 0, 0], \"half_size\": [1, 1, 1]},\n"
    "  {\"shape\": \"capsule\", \"from\": [9, 0, 0], \"to\": [9, 1, 0], \"radius\": 0.1}]}\n";
static const char step[] =
    "{\"from\": null, \"to\": 2.2, \"height\": 0, \"at\": 2, \"slope\": 0},\n"
    "{\"from\": 2.2, \"to\": null, \"height\": -0.3, \"at\": 3, \"slope\": 0}";

static ambulo_status read(const char *surfaces, const char *above, int end,
                          ambulo__film_scene *scene) {
  char text[2048];
  ambulo__yaml *document = NULL;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  int length = snprintf(text, sizeof text, scene_text, surfaces, above, end);
  assert_int_equal(ambulo__yaml_load_text(text, (size_t)length, "scene", &a, NULL, &document),
                   AMBULO_OK);
  ambulo_status status = ambulo__film_scene_read(document, &a, scene);
  ambulo__yaml_free(document);
  return status;
}

static void series_are_places_at_any_time(void **state) {
  (void)state;
  ambulo__film_scene s;
  double place[3];
  assert_int_equal(read("", "2, 0, 1", 1, &s), AMBULO_OK);
  static const double times[] = {0.0, 0.5, 1.0, 2.0, 3.0, -1.0};
  static const double forward[] = {2.0, 2.25, 2.5, 3.0, 3.0, 2.0};
  static const double up[] = {1.0, 1.0, 1.0, 1.5, 1.5, 1.0};
  for (int i = 0; i < 6; i++) {
    ambulo__film_point(&s, 1, ambulo__film_time_of(&s, times[i]), place);
    assert_close(place[0], forward[i], 1e-12);
    assert_close(place[1], 0.0, 1e-12);
    assert_close(place[2], up[i], 1e-12);
  }
  assert_close(s.force[0].force[2][1], 100.0, 1e-12);
  assert_int_equal(s.faces, 12);
  assert_int_equal(s.posts, 1);
  assert_close(s.floor, 0.0, 1e-12);
  ambulo__film_scene_free(&s);
}

static void steps_stand_on_the_floor_below_them(void **state) {
  (void)state;
  ambulo__film_scene s;
  assert_int_equal(read(step, "2, 0, 0", 1, &s), AMBULO_OK);
  assert_int_equal(s.faces, 36);
  assert_close(s.floor, -0.32, 1e-12);
  double high = -INFINITY, low = INFINITY;
  for (int f = 12; f < s.faces; f++) {
    for (int k = 0; k < 3; k++) {
      high = fmax(high, s.face[f].corner[k][2]);
      low = fmin(low, s.face[f].corner[k][2]);
    }
  }
  assert_close(high, 0.0, 1e-12);
  assert_close(low, s.floor, 1e-12);
  ambulo__film_scene_free(&s);
}

static void what_is_no_scene_is_refused(void **state) {
  (void)state;
  ambulo__film_scene s;
  assert_int_equal(read("", "2, 0", 1, &s), AMBULO_E_SCHEMA);
  assert_int_equal(read("", "2, 0, x", 1, &s), AMBULO_E_SCHEMA);
  assert_int_equal(read("", "2, 0, 0", 2, &s), AMBULO_E_SCHEMA);
  assert_int_equal(read("", "2, 0, 0", -1, &s), AMBULO_E_SCHEMA);
  ambulo__film_scene_free(&s);
}

enum { WIDTH = 64, HEIGHT = 48, BYTES = 3 * WIDTH * HEIGHT };

static void picture(const ambulo__film_scene *s, double time, int period, ambulo_film_view view,
                    unsigned char pixels[BYTES]) {
  ambulo__canvas canvas;
  assert_int_equal(ambulo__canvas_create(WIDTH, HEIGHT, &s->allocator, &canvas), AMBULO_OK);
  ambulo__film_draw(s, time, period, view, &canvas);
  ambulo__canvas_pixels(&canvas, pixels);
  ambulo__canvas_free(&canvas, &s->allocator);
}

/* a repetition is two squares of the floor further on, where all looks alike; a sixteenth of one is
 * not. The body is orange and in the middle, wherever it is seen from */
static void the_eye_goes_along(void **state) {
  (void)state;
  ambulo__film_scene s;
  unsigned char one[BYTES], other[BYTES];
  assert_int_equal(read("", "2, 0, 0", 1, &s), AMBULO_OK);
  s.faces = s.posts = 0; /* what comes only once */
  for (int view = AMBULO_FILM_FREE; view <= AMBULO_FILM_TOP; view++) {
    picture(&s, 0.0, 0, (ambulo_film_view)view, one);
    picture(&s, 0.0, 3, (ambulo_film_view)view, other);
    assert_memory_equal(one, other, BYTES);
    picture(&s, 0.125, 0, (ambulo_film_view)view, other);
    assert_int_not_equal(memcmp(one, other, BYTES), 0);
    int orange = 0, off = 0;
    for (int k = 0; k < WIDTH * HEIGHT; k++) {
      if (one[3 * k] < 150 || one[3 * k + 2] > 60) continue;
      orange++;
      off += k % WIDTH - WIDTH / 2;
    }
    assert_true(orange > 4);
    assert_true(abs(off) <= 2 * orange);
  }
  ambulo__film_scene_free(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(series_are_places_at_any_time),
      cmocka_unit_test(steps_stand_on_the_floor_below_them),
      cmocka_unit_test(what_is_no_scene_is_refused),
      cmocka_unit_test(the_eye_goes_along),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
