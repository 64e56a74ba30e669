/* Functions of functions, and joints that follow each other, where that can be. */
#include "import/body_tree.h"
#include "support/import_case.h"

static ambulo__arena arena;
static ambulo__xml xml;
static ambulo__tree tree;
static ambulo_import_options options;

static void tree_open(void) {
  options = ambulo_import_options_default();
  arena = (ambulo__arena){.allocator = ambulo__allocator_or_default(NULL)};
  xml = (ambulo__xml){.arena = &arena};
  tree = (ambulo__tree){.arena = &arena, .xml = &xml, .options = &options};
}

static int add(const char *name) {
  const ambulo__rigid none = ambulo__rigid_identity();
  const double axis[3] = {0, 0, 1};
  return ambulo__tree_add(&tree, name, tree.link_count - 1, AMBULO_REVOLUTE, &none, axis, NULL);
}

/* g(f(x)) by the result and by both in turn */
static void check_whole(const ambulo__tree_function *g, const ambulo__tree_function *f) {
  ambulo__tree_function whole;
  assert_true(ambulo__function_of_function(&tree, g, f, &whole));
  for (double x = -3; x <= 3; x += 0.25) {
    double inner = ambulo__function_value(&tree, f, x);
    assert_close(ambulo__function_value(&tree, &whole, x), ambulo__function_value(&tree, g, inner),
                 1e-12);
  }
}

static void functions_of_functions(void **state) {
  (void)state;
  static const double points[] = {-2, 0.1, -1, 0.5, 0.3, -0.2, 1, 0.4, 2.5, 0};
  tree_open();
  const ambulo__tree_function curve = {.polynomial = {0.2, -1, 0.5, 0.1, -0.05}};
  const ambulo__tree_function spline = {.count = 5, .points = points};
  const ambulo__tree_function lines[] = {ambulo__tree_line(2, 0.3), ambulo__tree_line(-0.5, 1),
                                         ambulo__tree_line(0, 0.7)};
  for (int i = 0; i < 3; i++) {
    check_whole(&lines[i], &curve);
    check_whole(&lines[i], &spline);
    check_whole(&curve, &lines[i]);
    check_whole(&spline, &lines[i]);
    check_whole(&lines[i], &lines[(i + 1) % 3]);
  }
  ambulo__tree_function none;
  assert_false(ambulo__function_of_function(&tree, &curve, &spline, &none));
  assert_false(ambulo__function_of_function(&tree, &spline, &curve, &none));
  ambulo__arena_free(&arena);
}

/* a chain ends at what moves; a curve of a curve, what is not there, and a circle are held */
static void what_follows_what_follows(void **state) {
  (void)state;
  tree_open();
  const ambulo__tree_function half = ambulo__tree_line(0.5, 0.1);
  const ambulo__tree_function square = {.polynomial = {0, 0, 1}};
  static const char *const names[] = {"q", "a", "b", "c", "d", "e", "f", "g"};
  for (int i = 0; i < 8; i++) (void)add(names[i]);
  ambulo__tree_couple(&tree, 1, "b", &half);
  ambulo__tree_couple(&tree, 2, "q", &square);
  ambulo__tree_couple(&tree, 3, "b", &square);
  ambulo__tree_couple(&tree, 4, "nobody", &half);
  ambulo__tree_couple(&tree, 5, "f", &half);
  ambulo__tree_couple(&tree, 6, "e", &half);
  ambulo__tree_resolve(&tree);
  assert_string_equal(tree.links[1].follows, "q");
  assert_close(tree.links[1].function.polynomial[2], 0.5, 0);
  assert_string_equal(tree.links[2].follows, "q");
  for (int i = 3; i < 7; i++) {
    if (i == 6) continue; /* what it follows is held */
    assert_null(tree.links[i].follows);
    assert_int_equal(tree.links[i].type, AMBULO_FIXED);
  }
  assert_null(tree.links[6].follows);
  assert_null(tree.links[7].follows);
  assert_int_equal(tree.links[7].type, AMBULO_REVOLUTE);
  tree.links[0].coordinate.default_value = 2;
  assert_close(ambulo__tree_stands(&tree, 2, 1), 4, 0);
  assert_close(ambulo__tree_stands(&tree, 1, 0), 0.1, 0);
  ambulo__rigid place = ambulo__tree_start_place(&tree, 0);
  assert_close(place.r[0][0], cos(2), 1e-15);
  ambulo__arena_free(&arena);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(functions_of_functions),
                                     cmocka_unit_test(what_follows_what_follows)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
