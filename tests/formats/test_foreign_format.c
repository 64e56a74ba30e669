/* Files of other programs: each is known by its bytes, whatever reader meets it. */
#include "formats/foreign_format.h"
#include "support/messages.h"
#include "support/test.h"

#include <string.h>

#define NO_NUL(text) text, sizeof(text) - 1

typedef struct sample {
  const char *bytes;
  size_t length;
  const char *says;
} sample;

static void refuse(const char *bytes, size_t length, ambulo__taken taken, const char *says) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo__refuse_foreign(bytes, length, taken, "f", list);
  if (says) {
    assert_true(status == AMBULO_E_SCHEMA || status == AMBULO_E_PARSE);
    assert_int_equal(ambulo_diagnostics_count(list), 1);
    assert_message(list, 0, says);
  } else {
    if (status) print_error("refused: %s\n", ambulo_diagnostics_get(list, 0)->message);
    assert_int_equal(status, AMBULO_OK);
  }
  assert_int_equal(ambulo_diagnostics_count(list), status ? 1 : 0);
  ambulo_diagnostics_free(list);
}

static const sample skeletons[] = {
    {NO_NUL("<?xml version=\"1.0\"?>\n<OpenSimDocument Version=\"40000\">\n\t<Model name=\"x\">"),
     "f: error[E_SCHEMA]: this is an OpenSim model (.osim); expected"},
    {NO_NUL("\xEF\xBB\xBF<?xml version=\"1.0\"?>\r\n<!-- <robot> -->\r\n<OpenSimDocument>"
            "<!-- c --><Model>"),
     "an OpenSim model"},
    {NO_NUL("<OpenSimDocument Version=\"1\"><ExternalLoads name=\"l\">"),
     "a settings file of OpenSim (XML)"},
    {NO_NUL("<robot name=\"atlas\" xmlns:xacro=\"http://x\">"), "a URDF robot"},
    {NO_NUL("<!-- > -->\n\n  <robot\n name=\"r\"/>"), "a URDF robot"},
    {NO_NUL("<mujoco model=\"humanoid\">\n"), "a MuJoCo model (MJCF)"},
    {NO_NUL("<mujocoinclude>"), "a part of a MuJoCo model"},
    {NO_NUL("<?xml version='1.0'?><sdf version='1.6'>"), "an SDFormat model"},
    {NO_NUL("<!DOCTYPE html>\n<HTML lang=en>"), "a web page"},
    {NO_NUL("<svg width=\"1\">"), "a drawing (SVG)"},
    {NO_NUL("<robots/>"), "an XML file"},
    {NO_NUL("<?xml version=\"1.0\"?><a/>"), "an XML file"},
};

static const sample others[] = {
    {NO_NUL("\x1f\x8b\x08"), "a gzip archive; expected"},
    {NO_NUL("BZh9"), "a bzip2 archive"},
    {NO_NUL("\xfd"
            "7zXZ\0"),
     "an xz archive"},
    {NO_NUL("\x28\xb5\x2f\xfd\0"), "a zstd archive"},
    {NO_NUL("7z\xbc\xaf\x27\x1c"), "a 7z archive"},
    {NO_NUL("PK\x03\x04\x14"), "a zip archive or a spreadsheet"},
    {NO_NUL("PK\x05\x06\0"), "an empty zip archive"},
    {NO_NUL("\xd0\xcf\x11\xe0\xa1"), "an office document"},
    {NO_NUL("%PDF-1.4\n"), "a PDF"},
    {NO_NUL("\x89PNG\r\n"), "a picture (PNG)"},
    {NO_NUL("\xff\xd8\xff\xe0"), "a picture (JPEG)"},
    {NO_NUL("\x89HDF\r\n"), "an HDF5 file"},
    {NO_NUL("MATLAB 5.0 MAT-file, Platform"), "a MAT-file"},
    {NO_NUL("\x93NUMPY\x01"), "a NumPy array"},
    {NO_NUL("\x7f"
            "ELF\x02"),
     "a program"},
    {NO_NUL("version https://git-lfs.github.com/spec/v1\n"), "a pointer of Git LFS"},
    {NO_NUL("PathFileType\t4\t(X/Y/Z)\n"), "a TRC file"},
    {NO_NUL("HIERARCHY\nROOT Hips\n"), "a BVH file"},
    {NO_NUL("\1\2\3\4\5\6"), "a binary file"},
    {NO_NUL("a\0m\0b\0"), "f: error[E_PARSE]: this is text in UTF-16; expected UTF-8"},
    {NO_NUL("\0a\0m\0b"), "text in UTF-16"},
    {NO_NUL("\xff\xfe"
            "a\0"),
     "text in UTF-16"},
    {NO_NUL("\xfe\xff\0a"), "text in UTF-16"},
};

static void strangers_to_every_reader(void **state) {
  (void)state;
  for (int taken = AMBULO__TAKES_YAML; taken <= AMBULO__TAKES_MOTION; taken++) {
    for (size_t i = 0; i < sizeof skeletons / sizeof *skeletons; i++)
      refuse(skeletons[i].bytes, skeletons[i].length, (ambulo__taken)taken, skeletons[i].says);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
      refuse(others[i].bytes, others[i].length, (ambulo__taken)taken, others[i].says);
  }
}

/* "\2P" and as many bytes as a header has */
static void c3d(void **state) {
  (void)state;
  char bytes[512] = {2, 0x50};
  refuse(bytes, sizeof bytes, AMBULO__TAKES_YAML, "a C3D file; expected YAML\n  hint: it holds");
  memset(bytes, 'P', sizeof bytes);
  bytes[0] = '\t';
  refuse(bytes, sizeof bytes, AMBULO__TAKES_YAML, NULL);
}

/* what one reader takes is foreign to another */
static void tables_and_texts(void **state) {
  (void)state;
  static const char sto[] = "Coordinates\nversion=1\n  endheader \ntime\tknee\n0\t1\n";
  static const char csv[] = "# ambulo motion: mass 75 kg\n\ntime,q.knee\n0,1\n";
  static const char yaml[] = "# a problem\nambulo: 1\nkind: problem\n", json[] = "{\"a\": 1}";
  refuse(NO_NUL(sto), AMBULO__TAKES_YAML, "a table of OpenSim (STO, MOT); expected YAML");
  refuse(NO_NUL(sto), AMBULO__TAKES_CSV, "a table of OpenSim (STO, MOT); expected a table (CSV)");
  refuse(NO_NUL(sto), AMBULO__TAKES_MOTION, NULL);
  refuse(NO_NUL(csv), AMBULO__TAKES_YAML, "a table (CSV); expected YAML");
  refuse(NO_NUL("a;b\r\n1;2\r\n"), AMBULO__TAKES_YAML, "a table (CSV)");
  refuse(NO_NUL("a\tb\n1\t2"), AMBULO__TAKES_YAML, "a table (CSV)");
  for (int taken = AMBULO__TAKES_CSV; taken <= AMBULO__TAKES_MOTION; taken++) {
    refuse(NO_NUL(csv), (ambulo__taken)taken, NULL);
    refuse(NO_NUL(yaml), (ambulo__taken)taken, "a YAML file of Ambulo; expected a");
    refuse(NO_NUL(json), (ambulo__taken)taken, "JSON; expected a");
  }
  refuse(NO_NUL(yaml), AMBULO__TAKES_YAML, NULL);
  refuse(NO_NUL(json), AMBULO__TAKES_YAML, NULL);
}

/* texts with a fault are left to the readers, who know the line */
static void doubtful_texts_pass(void **state) {
  (void)state;
  static const sample texts[] = {
      {NO_NUL(""), NULL},
      {NO_NUL("\n"), NULL},
      {NO_NUL("a"), NULL},
      {NO_NUL("<<: {a: 1}\n"), NULL},
      {NO_NUL("<"), NULL},
      {NO_NUL("# a, b\n# c, d\n"), NULL},
      {NO_NUL("a, b: 1\nc, d: 2\n"), NULL},
      {NO_NUL("name: a,b\nsource: c,d\n"), NULL},
      {NO_NUL("links:\n - a,b\n"), NULL},
      {NO_NUL("{a: 1,\nb: 2}\n"), NULL},
      {NO_NUL("- a, b\n- c, d\n"), NULL},
      {NO_NUL("a, b\nc\n"), NULL},
      {NO_NUL("\xEF\xBB\xBF"
              "ambulo: 1\r\n"),
       NULL},
      {NO_NUL("ambulo: 1 # \0\n"), NULL},
      {NO_NUL("%YAML 1.1\n---\na: 1\n"), NULL},
      {NO_NUL("just words\nand more of them\n"), NULL},
  };
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
    refuse(texts[i].bytes, texts[i].length, AMBULO__TAKES_YAML, NULL);
}

/* no byte behind the end is looked at: a text that is cut anywhere */
static void cut_texts(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof skeletons / sizeof *skeletons; i++) {
    for (size_t length = 0; length < skeletons[i].length; length++) {
      char *cut = malloc(length ? length : 1);
      assert_non_null(cut);
      memcpy(cut, skeletons[i].bytes, length);
      for (int taken = AMBULO__TAKES_YAML; taken <= AMBULO__TAKES_MOTION; taken++)
        (void)ambulo__refuse_foreign(cut, length, (ambulo__taken)taken, "f", NULL);
      free(cut);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(strangers_to_every_reader),
      cmocka_unit_test(c3d),
      cmocka_unit_test(tables_and_texts),
      cmocka_unit_test(doubtful_texts_pass),
      cmocka_unit_test(cut_texts),
  };
  return cmocka_run_group_tests_name("format/foreign_format", tests, NULL, NULL);
}
