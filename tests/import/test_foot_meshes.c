/* Feet whose geometry is a mesh: STL, both kinds, and OBJ, found beside the model and in packages.
 */
#include "support/import_case.h"

#include <sys/stat.h>

#define ROBOT(name, scale)                                                                         \
  "<robot name='r'><link name='base'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' " \
  "ixy='0' ixz='0' iyz='0'/></inertial></link><link name='foot_r'><inertial><mass value='1'/>"     \
  "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial><collision>"               \
  "<origin xyz='0 0 -0.5'/><geometry><mesh filename='" name "' " scale "/></geometry></collision>" \
  "</link><joint name='hip' type='continuous'><parent link='base'/><child link='foot_r'/>"         \
  "<axis xyz='1 0 0'/></joint></robot>"

/* a sole of 0.2 m by 0.1 m at z = -0.05, and an ankle above it */
static const double corners[6][3] = {{-0.05, -0.05, -0.05}, {0.15, -0.05, -0.05},
                                     {0.15, 0.05, -0.05},   {-0.05, 0.05, -0.05},
                                     {0, 0, 0.3},           {0.4, 0, 0.1}};
static const int triangles[3][3] = {{0, 1, 2}, {0, 2, 3}, {3, 4, 5}};

static void write_obj(const char *path) {
  char text[600] = "# a foot\r\nvn 0 0 9\r\n";
  for (int k = 0; k < 6; k++)
    (void)snprintf(text + strlen(text), sizeof text - strlen(text), "v %g %g %g\r\n", corners[k][0],
                   corners[k][1], corners[k][2]);
  scratch_write(path, text);
}

static void write_text(const char *path) {
  char text[1200] = "solid foot\n facet normal 0 0 1\n  outer loop\n";
  for (int t = 0; t < 3; t++)
    for (int v = 0; v < 3; v++) {
      const double *p = corners[triangles[t][v]];
      (void)snprintf(text + strlen(text), sizeof text - strlen(text), "   vertex %e %e %e\n", p[0],
                     p[1], p[2]);
    }
  scratch_write(path, text);
}

/* begins with "solid", as many binary ones do */
static void write_binary(const char *path) {
  unsigned char bytes[84 + 50 * 3] = "solid";
  bytes[80] = 3;
  for (int t = 0; t < 3; t++)
    for (int v = -1; v < 3; v++) /* the normal, which is no vertex, first */
      for (int i = 0; i < 3; i++) {
        float x = v < 0 ? -9.0F : (float)corners[triangles[t][v]][i];
        uint32_t bits;
        memcpy(&bits, &x, sizeof bits);
        for (int b = 0; b < 4; b++)
          bytes[84 + 50 * t + 12 * (v + 1) + 4 * i + b] = (unsigned char)(bits >> (8 * b));
      }
  FILE *file = fopen(path, "wb");
  assert_non_null(file);
  assert_int_equal(fwrite(bytes, 1, sizeof bytes, file), sizeof bytes);
  assert_int_equal(fclose(file), 0);
}

static void has_sole(const import_case *c, double length, double width) {
  assert_int_equal(ambulo_model_foot_count(c->model), 1);
  const ambulo_foot *foot = ambulo_model_foot(c->model, 0);
  const double *heel = ambulo_model_point(c->model, foot->heel_center)->position;
  const double *toe = ambulo_model_point(c->model, foot->toe_center)->position;
  const double *outer = ambulo_model_point(c->model, foot->toe[0])->position;
  assert_close(toe[0] - heel[0], length, 1e-7);
  assert_close(fabs(outer[1] - toe[1]), 0.5 * width, 1e-7);
  assert_close(heel[2], toe[2], 1e-12);
}

static void each_kind(void **state) {
  static void (*const writers[])(const char *) = {write_obj, write_text, write_binary};
  for (int kind = 0; kind < 3; kind++) {
    writers[kind](scratch_path(state, "foot.mesh"));
    import_case c = import_good(state, ROBOT("foot.mesh", ""));
    has_sole(&c, 0.2, 0.1);
    import_shut(&c);
  }
}

static const char *inside(void **state, const char *name) {
  static char path[700];
  (void)snprintf(path, sizeof path, "%s/%s", scratch_path(state, "robot"), name);
  return path;
}

/* a package beside the model's, and the model's own under another name than its folder's */
static void packages(void **state) {
  static const char *const folders[] = {"", "urdf", "meshes", "../skin", "../skin/meshes"};
  static const char *const files[] = {"meshes/own.obj", "../skin/meshes/foot.obj"};
  static const char *const texts[] = {ROBOT("package://r_description/meshes/own.obj", ""),
                                      ROBOT("package://skin/meshes/foot.obj", "scale='1 2 1'")};
  for (int i = 0; i < 5; i++) assert_int_equal(mkdir(inside(state, folders[i]), 0777), 0);
  for (int i = 0; i < 2; i++) {
    write_obj(inside(state, files[i]));
    scratch_write(inside(state, "urdf/r.urdf"), texts[i]);
    import_case c = import_file(inside(state, "urdf/r.urdf"), NULL);
    assert_int_equal(c.status, AMBULO_OK);
    has_sole(&c, 0.2, i ? 0.2 : 0.1);
    import_shut(&c);
  }
}

static void mujoco(void **state) {
  write_text(scratch_path(state, "sole.stl"));
  import_case c = import_good(
      state, "<mujoco><asset><mesh file='sole.stl'/></asset><worldbody><body name='b'>"
             "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/><joint name='hip' axis='1 0 0'/>"
             "<body name='foot_r'><geom type='mesh' mesh='sole' mass='0' pos='0 0 -0.5'/></body>"
             "</body></worldbody></mujoco>");
  has_sole(&c, 0.2, 0.1);
  import_shut(&c);
}

/* no link is named foot: the lowest one with solids, and not the shank whose mesh hangs above it */
static void shank_above_a_foot(void **state) {
  write_text(scratch_path(state, "shank.stl"));
  import_case c = import_good(
      state, "<mujoco><asset><mesh file='shank.stl'/></asset><worldbody><body name='b'>"
             "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/><joint name='hip' axis='1 0 0'/>"
             "<body name='knee_r'><geom type='mesh' mesh='shank' mass='0'/>"
             "<body name='ankle_r' pos='0 0 -0.5'><joint name='ankle' axis='0 1 0'/>"
             "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>"
             "<geom type='box' size='0.1 0.05 0.05' mass='0'/></body></body></body></worldbody>"
             "</mujoco>");
  has_sole(&c, 0.2, 0.1);
  const ambulo_foot *foot = ambulo_model_foot(c.model, 0);
  int link = ambulo_model_point(c.model, foot->heel_center)->link;
  assert_string_equal(ambulo_model_link(c.model, link)->name, "ankle_r");
  import_shut(&c);
}

/* not there, of another kind, cut off: as if there were none */
static void unreadable(void **state) {
  static const char *const texts[] = {"", "<COLLADA/>", "v 1 2\nv 1 2 x\n", "solid\nvertex 1\n"};
  import_case c = import_good(state, ROBOT("nowhere.stl", ""));
  assert_told(&c, "foot_r: its geometry is a mesh that could not be read");
  import_shut(&c);
  for (int i = 0; i < 4; i++) {
    scratch_write(scratch_path(state, "foot.mesh"), texts[i]);
    c = import_good(state, ROBOT("foot.mesh", ""));
    assert_told(&c, "foot_r: its geometry is a mesh that could not be read");
    import_shut(&c);
  }
}

/* --------------------------------------------------------- what large meshes take */

typedef struct meter {
  size_t live, most;
} meter;

/* the size of a block stands before it */
static void *measured(void *user, void *pointer, size_t size) {
  enum { HEAD = 64 };
  meter *m = user;
  char *block = pointer ? (char *)pointer - HEAD : NULL;
  if (block) m->live -= *(size_t *)(void *)block;
  if (size == 0) {
    free(block);
    return NULL;
  }
  block = realloc(block, size + HEAD);
  if (!block) return NULL;
  *(size_t *)(void *)block = size;
  m->live += size;
  if (m->live > m->most) m->most = m->live;
  return block + HEAD;
}

/* binary, of so many triangles in one point: a hole */
static void write_large(const char *path, uint32_t count) {
  FILE *file = fopen(path, "wb");
  assert_non_null(file);
  assert_int_equal(fseek(file, 80, SEEK_SET), 0);
  for (int b = 0; b < 4; b++) assert_true(fputc((int)(count >> (8 * b) & 255), file) >= 0);
  assert_int_equal(fseek(file, 83 + 50 * (long)count, SEEK_SET), 0);
  assert_int_equal(fputc(0, file), 0);
  assert_int_equal(fclose(file), 0);
}

static void write_feet(const char *path, int count, int files) {
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  (void)fputs("<mujoco><asset>", file);
  for (int i = 0; i < files; i++) (void)fprintf(file, "<mesh name='m%d' file='m%d.stl'/>", i, i);
  (void)fputs(
      "</asset><worldbody><body name='b'><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>"
      "<joint name='hip' axis='1 0 0'/><body name='foot_r'>",
      file);
  for (int i = 0; i < count; i++)
    (void)fprintf(file, "<geom type='mesh' mesh='m%d' mass='0' pos='.%d 0 -.5'/>", i % files, i);
  (void)fputs("</body></body></worldbody></mujoco>", file);
  assert_int_equal(fclose(file), 0);
}

/* sixteen geoms of one file take as much as one */
static void meshes_are_shared(void **state) {
  enum { TRIANGLES = 20000 };
  size_t most[2];
  write_large(scratch_path(state, "m0.stl"), TRIANGLES);
  for (int k = 0; k < 2; k++) {
    const char *path = scratch_path(state, "feet.xml");
    meter m = {0, 0};
    ambulo_allocator memory = {measured, &m};
    char *text = NULL;
    write_feet(path, k ? 16 : 2, 1);
    skip_without_expat();
    assert_int_equal(ambulo_import_model(path, NULL, NULL, &memory, NULL, &text), AMBULO_OK);
    ambulo_text_free(text, &memory);
    assert_int_equal(m.live, 0);
    most[k] = m.most;
  }
  assert_true(most[1] < most[0] + 200000);
  assert_true(most[0] < (size_t)TRIANGLES * (50 + 3 * 24) + 200000);
}

static void large_ones_are_left_out(void **state) {
  enum { MOST = 1398100 }; /* triangles: of 4194304 vertices, nearly */
  write_large(scratch_path(state, "m0.stl"), 1000);
  write_large(scratch_path(state, "m1.stl"), MOST);
  write_large(scratch_path(state, "m2.stl"), MOST - 100000);
  write_feet(scratch_path(state, "feet.xml"), 3, 3);
  import_case c = import_file(scratch_path(state, "feet.xml"), NULL);
  assert_int_equal(c.status, AMBULO_OK);
  assert_told(&c, "mesh 'm1.stl' is left out: it has more than 64 MB");
  import_shut(&c);
  write_large(scratch_path(state, "m1.stl"), MOST - 100000);
  c = import_file(scratch_path(state, "feet.xml"), NULL);
  assert_int_equal(c.status, AMBULO_OK);
  assert_told(&c, "mesh 'm2.stl' is left out: the meshes of feet have more than 4194304 vertices");
  import_shut(&c);
}

/* lengths of a URDF are whole: a cylinder and a capsule that lie along x */
static void lengths_of_a_urdf(void **state) {
#define FOOT(shape)                                                                                \
  "<robot name='r'><link name='base'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' " \
  "ixy='0' ixz='0' iyz='0'/></inertial></link><link name='foot_r'><inertial><mass value='1'/>"     \
  "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial><collision>"               \
  "<origin rpy='0 1.5707963267948966 0'/><geometry><" shape " radius='0.03' length='0.2'/>"        \
  "</geometry></collision></link><joint name='hip' type='continuous'><parent link='base'/>"        \
  "<child link='foot_r'/><axis xyz='1 0 0'/></joint></robot>"
  static const char *const texts[] = {FOOT("cylinder"), FOOT("capsule")};
  for (int i = 0; i < 2; i++) {
    import_case c = import_good(state, texts[i]);
    int heel = ambulo_model_find_point(c.model, "right_heel"),
        toe = ambulo_model_find_point(c.model, "right_toe");
    assert_true(heel >= 0 && toe >= 0);
    const double *from = ambulo_model_point(c.model, heel)->position,
                 *to = ambulo_model_point(c.model, toe)->position;
    assert_close(fabs(to[0] - from[0]) + fabs(to[2] - from[2]), 0.2, 1e-9);
    import_shut(&c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(each_kind, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(packages, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(lengths_of_a_urdf, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(mujoco, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(shank_above_a_foot, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(meshes_are_shared, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(large_ones_are_left_out, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(unreadable, scratch_open, scratch_close)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
