/* Names of a MuJoCo model: the table says what a walk over all default classes says. */
#include "import/mjcf.h"
#include "support/import_case.h"

/* ------------------------------------------------------------ the walk, to compare */

/* in the first of a class that has the attribute; *found: the last of the class that was seen */
static const char *below(const ambulo__xml_node *set, const char *name, const char *tag,
                         const char *attribute, int top, const ambulo__xml_node **found) {
  const char *own = ambulo__xml_attribute(set, "class");
  if (top && !own) own = "main";
  if (name ? own && strcmp(own, name) == 0 : top) {
    *found = set;
    AMBULO__XML_EACH (n, set, tag) {
      const char *text = ambulo__xml_attribute(n, attribute);
      if (text) return text;
    }
  }
  AMBULO__XML_EACH (n, set, "default") {
    const char *text = below(n, name, tag, attribute, 0, found);
    if (text) return text;
  }
  return NULL;
}

static const char *walk(const ambulo__xml_node *root, const char *name, const char *tag,
                        const char *attribute) {
  const ambulo__xml_node *found = NULL;
  const char *text = NULL;
  AMBULO__XML_EACH (n, root, "default") {
    text = below(n, name, tag, attribute, 1, &found);
    if (text) return text;
  }
  for (const ambulo__xml_node *n = found ? found->parent : NULL;
       n && !text && ambulo__xml_is(n, "default"); n = n->parent) {
    AMBULO__XML_EACH (e, n, tag) {
      if (!text) text = ambulo__xml_attribute(e, attribute);
    }
  }
  return text;
}

/* -------------------------------------------------------------------- random files */

static unsigned draw(unsigned *state, unsigned most) {
  *state = *state * 1664525U + 1013904223U;
  return (*state >> 16) % most;
}

static const char *const classes[] = {"main", "a", "b", "", "c"};
static const char *const tags[] = {"geom", "joint"};
static const char *const attributes[] = {"size", "type", "pos"};

static void write_default(FILE *file, unsigned *state, int depth, int *number) {
  unsigned name = draw(state, 7);
  if (name < 5)
    (void)fprintf(file, "<default class='%s'>", classes[name]);
  else
    (void)fputs("<default>", file);
  for (unsigned i = draw(state, 4); i > 0; i--) {
    (void)fprintf(file, "<%s", tags[draw(state, 2)]);
    for (int k = 0; k < 3; k++)
      if (draw(state, 3) == 0) (void)fprintf(file, " %s='%d'", attributes[k], ++*number);
    (void)fputs("/>", file);
  }
  for (unsigned i = depth < 4 ? draw(state, 3) : 0; i > 0; i--)
    write_default(file, state, depth + 1, number);
  (void)fputs("</default>", file);
}

typedef struct indexed {
  ambulo__arena arena;
  ambulo__xml xml;
  ambulo__tree tree;
  ambulo__mjcf m;
} indexed;

static void open_index(indexed *x, const char *path) {
  memset(x, 0, sizeof *x);
  x->arena.allocator = ambulo__allocator_or_default(NULL);
  x->xml.arena = &x->arena;
  x->tree = (ambulo__tree){.arena = &x->arena, .xml = &x->xml, .path = path};
  x->m = (ambulo__mjcf){.tree = &x->tree, .xml = &x->xml};
  x->m.root = ambulo__xml_load(&x->xml, path);
  assert_non_null(x->m.root);
  ambulo__mjcf_index(&x->m);
}

static int compare_with_walk(const indexed *x) {
  int found = 0;
  for (int c = -1; c < 5; c++) {
    for (int t = 0; t < 2; t++) {
      for (int a = 0; a < 3; a++) {
        const char *name = c < 0 ? NULL : classes[c];
        const char *text = ambulo__mjcf_default(&x->m, name, tags[t], attributes[a]);
        const char *want = walk(x->m.root, name, tags[t], attributes[a]);
        found += want != NULL;
        if (want)
          assert_string_equal(text ? text : "nothing", want);
        else
          assert_null(text);
      }
    }
  }
  return found;
}

static void classes_are_those_of_the_walk(void **state) {
  skip_without_expat();
  const char *path = scratch_path(state, "d.xml");
  int found = 0;
  for (unsigned seed = 1; seed <= 200; seed++) {
    unsigned random = seed;
    int number = 0;
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    (void)fputs("<mujoco>", file);
    for (unsigned i = draw(&random, 4); i > 0; i--) write_default(file, &random, 0, &number);
    (void)fputs("</mujoco>", file);
    assert_int_equal(fclose(file), 0);
    indexed x;
    open_index(&x, path);
    found += compare_with_walk(&x);
    ambulo__arena_free(&x.arena);
  }
  assert_true(found > 1000);
}

static void meshes_and_joints(void **state) {
  skip_without_expat();
  const char *path = scratch_path(state, "n.xml");
  scratch_write(
      path, "<mujoco><default><default class='d'><mesh file='of_class.stl'/></default></default>"
            "<asset><mesh name='foot' file='a.stl'/><mesh file='dir/hand.v2.obj'/>"
            "<mesh name='none'/><mesh name='by_class' class='d'/></asset>"
            "<asset><mesh name='foot' file='second.stl'/></asset>"
            "<actuator><motor joint='knee'/><position tendon='t'/></actuator></mujoco>");
  indexed x;
  open_index(&x, path);
  const ambulo__xml_node *foot = ambulo__mjcf_mesh(&x.m, "foot");
  assert_string_equal(ambulo__xml_attribute(foot, "file"), "a.stl"); /* the first */
  assert_non_null(ambulo__mjcf_mesh(&x.m, "hand.v2"));
  assert_non_null(ambulo__mjcf_mesh(&x.m, "by_class"));
  assert_null(ambulo__mjcf_mesh(&x.m, "none")); /* has no file */
  assert_null(ambulo__mjcf_mesh(&x.m, "hand"));
  assert_true(ambulo__mjcf_is_driven(&x.m, "knee"));
  assert_false(ambulo__mjcf_is_driven(&x.m, "t"));
  ambulo__arena_free(&x.arena);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(classes_are_those_of_the_walk),
                                     cmocka_unit_test(meshes_and_joints)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
