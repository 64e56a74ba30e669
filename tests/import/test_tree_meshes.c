/* The file of meshes beside a model: what of a robot is shown, where, and which files are replaced.
 */
#include "import/meshes.h"
#include "support/fail_alloc.h"
#include "support/import_case.h"
#include "support/yaml.h"

#define BODY(name, more)                                                                           \
  "<link name='" name "'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "     \
  "ixz='0' iyz='0'/></inertial>" more "</link>"
#define SHAPE(kind, place, shape)                                                                  \
  "<" kind "><origin " place "/><geometry>" shape "</geometry></" kind ">"
#define ROBOT(base, arm)                                                                           \
  "<robot name='r'>" BODY("base", base) BODY(                                                      \
      "arm", arm) "<joint name='hinge' type='continuous'>"                                         \
                  "<parent link='base'/><child link='arm'/><axis xyz='1 0 0'/></joint></robot>"
#define BOX SHAPE("visual", "xyz='0 0 1'", "<box size='.2 .4 .6'/>")
#define FAR SHAPE("collision", "xyz='5 0 0'", "<box size='1 1 1'/>")
#define OF_FILE(name)                                                                              \
  SHAPE("visual", "xyz='0 0 1' rpy='0 0 1.57079632679489662'",                                     \
        "<mesh filename='" name "' scale='1 2 3'/>")

typedef struct meshes {
  ambulo_status status;
  ambulo_diagnostics *list;
  yaml_case file; /* read where it is there */
  int is_there;
} meshes;

static const char *text_of(const char *path) {
  static char text[2 << 20];
  FILE *file = fopen(path, "rb");
  if (!file) return NULL;
  size_t length = fread(text, 1, sizeof text - 1, file);
  assert_int_equal(fclose(file), 0);
  text[length] = '\0';
  return text;
}

static meshes import(void **state, const char *robot, int overwrite) {
  char source[600], output[600];
  skip_without_expat();
  (void)snprintf(source, sizeof source, "%s", scratch_path(state, "r.urdf"));
  (void)snprintf(output, sizeof output, "%s", scratch_path(state, "r.yaml"));
  scratch_write(source, robot);
  ambulo_import_options options = ambulo_import_options_default();
  options.overwrite = overwrite;
  meshes m = {.list = ambulo_diagnostics_create(NULL)};
  m.status = ambulo_import_model(source, output, &options, NULL, m.list, NULL);
  const char *text = text_of(scratch_path(state, "r.meshes"));
  m.is_there = text && text[0] == '{' && m.status == AMBULO_OK;
  if (m.is_there) {
    m.file = yaml_open(text);
    assert_int_equal(m.file.status, AMBULO_OK);
    assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(m.file.root, "schema")),
                        "ambulo-meshes/1");
  }
  return m;
}

static void shut(meshes *m) {
  if (m->is_there) yaml_shut(&m->file);
  ambulo_diagnostics_free(m->list);
}

/* the sides of the box around a link's mesh, m; returns the number of triangles, 0: it has none */
static int box_of(const meshes *m, const char *link, double low[3], double high[3]) {
  const ambulo__yaml_node *list = ambulo__yaml_get(m->file.root, "meshes");
  for (int i = 0; i < ambulo__yaml_items(list); i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    if (strcmp(ambulo__yaml_text(ambulo__yaml_get(item, "link")), link) != 0) continue;
    long sum[3] = {0, 0, 0}, corner = 0, number;
    int count = 0, read, corners = 0;
    const char *at = ambulo__yaml_text(ambulo__yaml_get(item, "vertices"));
    for (int k = 0; k < 3; k++) low[k] = 1e9, high[k] = -1e9;
    for (; sscanf(at, "%ld%n", &number, &read) == 1; at += read, count++) {
      sum[count % 3] += number;
      low[count % 3] = fmin(low[count % 3], 1e-4 * (double)sum[count % 3]);
      high[count % 3] = fmax(high[count % 3], 1e-4 * (double)sum[count % 3]);
    }
    at = ambulo__yaml_text(ambulo__yaml_get(item, "triangles"));
    for (; sscanf(at, "%ld%n", &number, &read) == 1; at += read, corners++) {
      corner += number;
      assert_true(corner >= 0 && 3 * corner < count);
    }
    assert_int_equal(corners % 3, 0);
    return corners / 3;
  }
  return 0;
}

static void is_box(const meshes *m, const char *link, const double low[3], const double high[3],
                   double within) {
  double found[2][3];
  assert_true(m->is_there);
  assert_true(box_of(m, link, found[0], found[1]) > 0);
  for (int i = 0; i < 3; i++) {
    assert_close(found[0][i], low[i], within);
    assert_close(found[1][i], high[i], within);
  }
}

static void simple_solids(void **state) {
  static const struct {
    const char *shape;
    double half[3], within;
  } cases[] = {
      {"<box size='.2 .4 .6'/>", {.1, .2, .3}, 1e-4},
      {"<sphere radius='.1'/>", {.1, .1, .1}, 3e-3},
      {"<cylinder radius='.1' length='.5'/>", {.1, .1, .25}, 3e-3},
      {"<capsule radius='.1' length='.5'/>", {.1, .1, .35}, 3e-3},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char robot[2000];
    (void)snprintf(robot, sizeof robot, ROBOT(BOX FAR, SHAPE("visual", "xyz='1 2 3'", "%s")),
                   cases[i].shape);
    meshes m = import(state, robot, 1);
    const double *h = cases[i].half;
    is_box(&m, "arm", (const double[3]){1 - h[0], 2 - h[1], 3 - h[2]},
           (const double[3]){1 + h[0], 2 + h[1], 3 + h[2]}, cases[i].within);
    /* what only touches is not shown */
    is_box(&m, "base", (const double[3]){-.1, -.2, .7}, (const double[3]){.1, .2, 1.3}, 1e-4);
    shut(&m);
  }
}

/* a slope of .1 by .2 by .3, as each kind of file, turned by a quarter and stretched */
static void kinds_of_files(void **state) {
  static const struct {
    const char *name, *text;
  } files[] = {
      {"m.obj", "v 0 0 0\nv .1 0 0\nv .1 .2 .3\nv 0 .2 .3\nf 1/1/1 2//2 -2 4\nf 1 2 9\n"},
      {"m.stl", "solid m\n facet normal 0 0 1\n  outer loop\n vertex 0 0 0\n vertex .1 0 0\n"
                "vertex .1 .2 .3\n endloop\n endfacet\n vertex 0 0 0\n vertex .1 .2 .3\n"
                "vertex 0 .2 .3\n"},
#define DAE(faces)                                                                                 \
  "<COLLADA><library_geometries><geometry id='g'><mesh><source id='p'><float_array>0 0 0 .1 0 0 "  \
  ".1 .2 .3 0 .2 .3</float_array></source><vertices id='v'><input semantic='POSITION' "            \
  "source='#p'/></vertices>" faces "</mesh></geometry></library_geometries>"                       \
  "<library_visual_scenes><visual_scene><node><instance_geometry url='#g'/></node></visual_scene>" \
  "</library_visual_scenes></COLLADA>"
#define INPUTS                                                                                     \
  "<input semantic='NORMAL' source='#n' offset='0'/><input semantic='VERTEX' source='#v' "         \
  "offset='1'/>"
      {"m.dae", DAE("<triangles>" INPUTS "<p>9 0 9 1 9 2 9 0 9 2 9 3</p></triangles>")},
      {"m.dae", DAE("<polylist>" INPUTS "<vcount>4</vcount><p>9 0 9 1 9 2 9 3</p></polylist>")},
      {"m.dae", DAE("<polygons>" INPUTS "<p>9 0 9 1 9 2 9 3</p></polygons>")},
  };
  for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
    char robot[2000];
    scratch_write(scratch_path(state, files[i].name), files[i].text);
    (void)snprintf(robot, sizeof robot, ROBOT(BOX, OF_FILE("%s")), files[i].name);
    meshes m = import(state, robot, 1);
    double low[3], high[3];
    is_box(&m, "arm", (const double[3]){-.4, 0, 1}, (const double[3]){0, .1, 1.9}, 1e-4);
    assert_int_equal(box_of(&m, "arm", low, high), 2);
    shut(&m);
  }
}

/* a surface of 180 000 triangles */
static void few_triangles(void **state) {
  enum { SIDE = 300 };
  FILE *file = fopen(scratch_path(state, "m.obj"), "w");
  assert_non_null(file);
  for (int i = 0; i <= SIDE; i++)
    for (int k = 0; k <= SIDE; k++)
      (void)fprintf(file, "v %d.%03d %d.%03d 0\n", i / 1000, i % 1000, k / 1000, k % 1000);
  for (int i = 0; i < SIDE; i++)
    for (int k = 0; k < SIDE; k++) {
      int at = i * (SIDE + 1) + k + 1;
      (void)fprintf(file, "f %d %d %d %d\n", at, at + 1, at + SIDE + 2, at + SIDE + 1);
    }
  assert_int_equal(fclose(file), 0);
  meshes m = import(state, ROBOT(OF_FILE("m.obj"), OF_FILE("m.obj")), 1);
  double low[3], high[3];
  int count = box_of(&m, "arm", low, high);
  assert_in_range(count, 5000, 15000);
  is_box(&m, "arm", (const double[3]){-.6, 0, 1}, (const double[3]){0, .3, 1}, .01);
  shut(&m);
}

/* what is left where most files are missing is no body; nor are solids of contacts alone */
static void too_little(void **state) {
  meshes m = import(state, ROBOT(BOX, OF_FILE("none.obj")), 1);
  assert_int_equal(m.status, AMBULO_OK);
  assert_false(m.is_there);
  assert_message(m.list, ambulo_diagnostics_count(m.list) - 1, "show 50 % of the mass");
  shut(&m);
  m = import(state, ROBOT(OF_FILE("none.obj"), OF_FILE("none.obj")), 1);
  assert_false(m.is_there);
  shut(&m);
  m = import(state, ROBOT(FAR, ""), 1);
  assert_false(m.is_there);
  shut(&m);
}

static void whose_files_are_replaced(void **state) {
  char beside[600], model[600];
  (void)snprintf(beside, sizeof beside, "%s", scratch_path(state, "r.meshes"));
  (void)snprintf(model, sizeof model, "%s", scratch_path(state, "r.yaml"));
  scratch_write(beside, "mine");
  meshes m = import(state, ROBOT(BOX, BOX), 0);
  assert_int_equal(m.status, AMBULO_E_IO);
  assert_string_equal(text_of(beside), "mine");
  assert_null(text_of(model));
  shut(&m);
  m = import(state, ROBOT(BOX, BOX), 1);
  assert_true(m.is_there);
  shut(&m);
  m = import(state, ROBOT("", ""), 1); /* those of the model that was there go with it */
  assert_int_equal(m.status, AMBULO_OK);
  assert_null(text_of(beside));
  shut(&m);
  scratch_write(beside, "mine");
  m = import(state, ROBOT("", ""), 1);
  assert_string_equal(text_of(beside), "mine");
  shut(&m);
}

static void paths(void **state) {
  (void)state;
  static const char *const names[][2] = {{"a/r.yaml", "a/r.meshes"},
                                         {"r.yml", "r.meshes"},
                                         {"r.txt", NULL},
                                         {".yaml", NULL},
                                         {"/dev/stdout", NULL}};
  const ambulo_allocator heap = ambulo__allocator_or_default(NULL);
  for (int i = 0; i < 5; i++) {
    char *path = NULL;
    assert_int_equal(ambulo__meshes_path(&heap, names[i][0], &path), AMBULO_OK);
    if (names[i][1]) assert_string_equal(path, names[i][1]);
    if (!names[i][1]) assert_null(path);
    free(path);
  }
}

static void without_memory(void **state) {
  skip_without_expat();
  char source[600], output[600];
  (void)snprintf(source, sizeof source, "%s", scratch_path(state, "r.urdf"));
  (void)snprintf(output, sizeof output, "%s", scratch_path(state, "r.yaml"));
  scratch_write(scratch_path(state, "m.obj"), "v 0 0 0\nv .1 0 0\nv .1 .2 .3\nf 1 2 3\n");
  scratch_write(source, ROBOT(BOX, OF_FILE("m.obj")));
  ambulo_import_options options = ambulo_import_options_default();
  options.overwrite = 1;
  long k = 0;
  for (;; k += 1 + k / 40) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_status status = ambulo_import_model(source, output, &options, &allocator, NULL, NULL);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(text_of(scratch_path(state, "r.meshes")) != NULL, !memory.failed);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  assert_true(k > 10);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(simple_solids, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(kinds_of_files, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(few_triangles, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(too_little, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(whose_files_are_replaced, scratch_open, scratch_close),
      cmocka_unit_test(paths),
      cmocka_unit_test_setup_teardown(without_memory, scratch_open, scratch_close),
  };
  return cmocka_run_group_tests_name("exchange/tree_meshes", tests, NULL, NULL);
}
