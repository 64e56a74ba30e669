/* Vertices of COLLADA files: where their scene puts them, in metres, and files that are none. */
#include "support/import_case.h"

#define ROBOT                                                                                      \
  "<robot name='r'><link name='base'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' " \
  "ixy='0' ixz='0' iyz='0'/></inertial></link><link name='foot_r'><inertial><mass value='1'/>"     \
  "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial><collision><geometry>"     \
  "<mesh filename='foot.dae'/></geometry></collision></link><joint name='hip' type='continuous'>"  \
  "<parent link='base'/><child link='foot_r'/><axis xyz='1 0 0'/></joint></robot>"
/* a sole of 0.2 by 0.1 at z = -0.05; normals are no vertices */
#define GEOMETRY                                                                                   \
  "<library_geometries><geometry id='g'><mesh><source id='n'><float_array>9 9 -9</float_array>"    \
  "</source><source id='p'><float_array count='12'>-.05 -.05 -.05 .15 -.05 -.05 .15 .05 -.05 "     \
  "-.05 .05 -.05</float_array></source><vertices id='v'><input semantic='NORMAL' source='#n'/>"    \
  "<input semantic='POSITION' source='#p'/></vertices></mesh></geometry></library_geometries>"
#define DOCUMENT(unit, nodes)                                                                      \
  "<COLLADA><asset><unit meter='" unit "'/></asset>" GEOMETRY "<library_visual_scenes>"            \
  "<visual_scene>" nodes "</visual_scene></library_visual_scenes></COLLADA>"
#define SHOWN "<instance_geometry url='#g'/>"

static import_case with(void **state, const char *document) {
  scratch_write(scratch_path(state, "foot.dae"), document);
  return import_good(state, ROBOT);
}

static void is_at(const import_case *c, const char *name, double x, double y, double z) {
  const ambulo_point *p = ambulo_model_point(c->model, ambulo_model_find_point(c->model, name));
  if (!p) import_print(c);
  assert_non_null(p);
  assert_close(p->position[0], x, 1e-12);
  assert_close(p->position[1], y, 1e-12);
  assert_close(p->position[2], z, 1e-12);
}

static void placed_by_its_scene(void **state) {
  static const struct {
    const char *document;
    double heel[3], toe[3];
  } cases[] = {
      {DOCUMENT("1", "<node>" SHOWN "</node>"), {-.05, 0, -.05}, {.15, 0, -.05}},
      {DOCUMENT(".1", "<node><scale>10 5 20</scale>" SHOWN "</node>"),
       {-.05, 0, -.1},
       {.15, 0, -.1}},
      {DOCUMENT("1", "<node><translate>.1 0 -.2</translate><node>" SHOWN "</node></node>"),
       {.05, 0, -.25},
       {.25, 0, -.25}},
      {DOCUMENT("1",
                "<node><rotate>0 0 2 180</rotate><translate>.1 0 0</translate>" SHOWN "</node>"),
       {-.05, 0, -.05}, /* no name says left, and toes reach further: forward is -x */
       {-.25, 0, -.05}},
      {DOCUMENT("1", "<node><matrix>0 -1 0 .1 1 0 0 .2 0 0 1 .3 0 0 0 1</matrix>" SHOWN "</node>"),
       {.05, .25, .25},
       {.15, .25, .25}},
      {"<COLLADA><asset><up_axis>Y_UP</up_axis></asset>" GEOMETRY "<library_visual_scenes>"
       "<visual_scene><node><matrix>1 0 0 0 0 0 1 0 0 -1 0 0 0 0 0 1</matrix>" SHOWN
       "</node></visual_scene></library_visual_scenes></COLLADA>",
       {-.05, 0, -.05},
       {.15, 0, -.05}},
      {DOCUMENT("1", "<node>" SHOWN "</node><node><translate>.3 0 0</translate>" SHOWN "</node>"),
       {-.05, 0, -.05},
       {.45, 0, -.05}},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    import_case c = with(state, cases[i].document);
    is_at(&c, "right_heel", cases[i].heel[0], cases[i].heel[1], cases[i].heel[2]);
    is_at(&c, "right_toe", cases[i].toe[0], cases[i].toe[1], cases[i].toe[2]);
    import_shut(&c);
  }
}

/* no XML, no scene, a name that nothing has, a text that is no number: as if there were no mesh */
static void unreadable(void **state) {
  static const char *const documents[] = {
      "",
      "<COLLADA",
      "<COLLADA/>",
      DOCUMENT("1", ""),
      DOCUMENT("1", "<node/>"),
      DOCUMENT("1", "<node><instance_geometry url='#h'/><instance_geometry/></node>"),
      "<COLLADA><library_geometries><geometry id='g'><mesh><source id='p'><float_array>a b c"
      "</float_array></source><vertices><input semantic='POSITION' source='#p'/></vertices></mesh>"
      "</geometry></library_geometries><library_visual_scenes><visual_scene><node>" SHOWN
      "</node></visual_scene></library_visual_scenes></COLLADA>"};
  for (size_t i = 0; i < sizeof documents / sizeof *documents; i++) {
    import_case c = with(state, documents[i]);
    assert_int_equal(ambulo_model_foot_count(c.model), 0);
    assert_told(&c, "foot_r: its geometry is a mesh that could not be read");
    import_shut(&c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(placed_by_its_scene),
                                     cmocka_unit_test(unreadable)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
