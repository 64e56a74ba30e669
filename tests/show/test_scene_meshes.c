/* Meshes of a scene: their frames against the mechanics' own, and files that are none. */
#include "ambulo/tools/tools.h"
#include "people/stride.h"
#include "show/page.h"
#include "show/scene.h"
#include "solver/result.h"
#include "support/fail_alloc.h"
#include "support/scene_reading.h"
#include "support/scratch.h"

#define MODEL                                                                                      \
  "ambulo: 1\nkind: model\nname: rods\nunits: {angle: degrees}\nlinks:\n"                          \
  "  - {name: rod, parent: none, joint: revolute, dh: [-90, 0, 1, 0],\n"                           \
  "     body: {mass: 3, com: [-0.5, 0, 0], inertia: [0, 0.25, 0.25, 0, 0, 0]}}\n"                  \
  "  - {name: end, parent: rod, joint: revolute, origin: {xyz: [.1, .2, .3], rpy: [10, 20, "       \
  "30]},\n"                                                                                        \
  "     axis: [0, 1, 0], body: {mass: 3, com: [-0.5, 0, 0], inertia: [.1, .25, .25, 0, 0, 0]}}\n"  \
  "points:\n  - {name: o, link: end, position: [0, 0, 0]}\n"                                       \
  "  - {name: x, link: end, position: [.3, 0, 0]}\n  - {name: y, link: end, position: [0, .3, "    \
  "0]}\n"
#define PROBLEM                                                                                    \
  "ambulo: 1\nkind: problem\nname: swing\nmodel: rods.yaml\ntime: {duration: 1, intervals: 6}\n"   \
  "objective: [{term: acceleration, weight: 1}]\n"
#define MESH(link)                                                                                 \
  "{\"link\": \"" link "\", \"vertices\": \"0 0 0 10 0 0 -10 10 0\", "                             \
  "\"triangles\": \"0 1 1\"}"
#define MESHES(list) "{\"schema\": \"ambulo-meshes/1\", \"meshes\": [" list "]}"

typedef struct scene {
  ambulo_problem *problem;
  ambulo_result *result;
  ambulo__text_buffer text;
} scene;

/* `meshes`: what stands beside the model; NULL: nothing */
static scene open_scene(void **state, const char *meshes) {
  scene s = {.problem = NULL};
  scratch_write(scratch_path(state, "rods.yaml"), MODEL);
  if (meshes) scratch_write(scratch_path(state, "rods.meshes"), meshes);
  const char *path = scratch_path(state, "swing.yaml");
  scratch_write(path, PROBLEM);
  assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &s.problem), AMBULO_OK);
  assert_int_equal(ambulo__result_create(s.problem, NULL, &s.result), AMBULO_OK);
  for (int j = 0; j < s.problem->variables; j++) s.result->x[j] = 0.1 + 0.8 * sin(1.7 * j);
  ambulo__text_init(&s.text, NULL);
  return s;
}

static yaml_case read_scene(scene *s, const char *inputs) {
  assert_int_equal(ambulo__scene_json(s->problem, s->result, NULL, NULL, inputs, &s->text), 0);
  yaml_case c = yaml_open(ambulo__text_data(&s->text));
  assert_int_equal(c.status, AMBULO_OK);
  return c;
}

static void shut_scene(scene *s) {
  ambulo__text_free(&s->text);
  ambulo_result_free(s->result);
  ambulo_problem_free(s->problem);
}

static double dot(const double *a, const double *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void frames_are_where_the_mechanics_has_them(void **state) {
  scene s = open_scene(state, MESHES(MESH("nobody") ", 7, {\"link\": \"rod\"}, " MESH("end")));
  yaml_case c = read_scene(&s, NULL);
  ambulo__page_check_scene(c.root);
  const ambulo__yaml_node *list = ambulo__yaml_get(c.root, "meshes");
  assert_int_equal(ambulo__yaml_items(list),
                   1); /* the one whose link is there, with all its parts */
  const ambulo__yaml_node *mesh = ambulo__yaml_item(list, 0);
  assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(mesh, "link")), "end");
  assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(mesh, "vertices")),
                      "0 0 0 10 0 0 -10 10 0");
  assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(mesh, "triangles")), "0 1 1");
  ambulo__stride stride;
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(
      ambulo__stride_create(s.problem, s.result->x, AMBULO__SCENE_SAMPLES, NULL, &stride), 0);
  double *place = calloc((size_t)stride.samples * 9, sizeof *place);
  assert_int_equal(ambulo_mechanics_create(stride.model, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, stride.samples, stride.q, stride.qd, stride.qdd,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .points = place}),
                   AMBULO_OK);
  const ambulo__yaml_node *frame = ambulo__yaml_get(mesh, "frame");
  const double *axes[3] = {stride.model->forward, stride.model->left, stride.model->up};
  double moves = 0.0;
  for (int e = 0; e < 3; e++)
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < stride.samples; k += 13) {
        double got = scene_value(ambulo__yaml_item(ambulo__yaml_item(frame, e), i), k, 1e-4);
        assert_close(got, dot(axes[i], place + 9 * k + 3 * e), 0.51e-4);
        moves =
            fmax(moves, fabs(dot(axes[i], place + 9 * k + 3 * e) - dot(axes[i], place + 3 * e)));
      }
  assert_true(moves > 0.1);
  free(place);
  ambulo_mechanics_free(mechanics);
  ambulo__stride_free(&stride);
  yaml_shut(&c);
  shut_scene(&s);
}

/* a scene is one without meshes, too; other inputs than the problem's have other ones */
static void without_them(void **state) {
  static const char *const files[] = {
      NULL, "", "{", "[1, 2]", "{\"schema\": \"other\"}", "{\"meshes\": []}"};
  for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
    scene s = open_scene(state, files[i]);
    yaml_case c = read_scene(&s, NULL);
    assert_null(ambulo__yaml_get(c.root, "meshes"));
    yaml_shut(&c);
    shut_scene(&s);
  }
  scene s = open_scene(state, MESHES(MESH("end")));
  yaml_case c = read_scene(&s, "");
  assert_null(ambulo__yaml_get(c.root, "meshes"));
  yaml_shut(&c);
  shut_scene(&s);
}

static void without_memory(void **state) {
  scene s = open_scene(state, MESHES(MESH("rod") ", " MESH("end")));
  yaml_case c = read_scene(&s, NULL);
  long k = 0;
  for (;; k += 1 + k / 40) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__text_buffer text;
    ambulo__text_init(&text, &allocator);
    ambulo_status status = ambulo__scene_json(s.problem, s.result, NULL, NULL, NULL, &text);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    if (!status) assert_string_equal(ambulo__text_data(&text), ambulo__text_data(&s.text));
    ambulo__text_free(&text);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  assert_true(k > 10);
  yaml_shut(&c);
  shut_scene(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(frames_are_where_the_mechanics_has_them, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(without_them, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(without_memory, scratch_open, scratch_close),
  };
  return cmocka_run_group_tests_name("scene/meshes", tests, NULL, NULL);
}
