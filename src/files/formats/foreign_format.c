/* formats/foreign_format.c - see foreign_format.h. Formats are recognized by what their
 * specifications put first: magic bytes, the first word, or the root element of an XML document. */
#include "formats/foreign_format.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

enum { LOOK = 4096, C3D_BLOCK = 512 };

/* A format: what people call it, and what to do with it in place of YAML, in place of a table. */
typedef struct format {
  const char *name, *yaml_hint, *table_hint;
} format;

/* the text that is looked at: its first bytes */
typedef struct look {
  const char *at, *end;
} look;

/* ------------------------------------------------------------------- first bytes */

#define BY_HAND "Ambulo has no importer for it: write the skeleton in YAML, docs/model-format.md"
#define IMPORT "import it first: ambulo import FILE -o model.yaml (docs/guide-import.md)"
#define UNPACK "unpack it first"
#define NO_MARKERS                                                                                 \
  "it holds markers: let OpenSim's inverse kinematics make joint angles of them (.mot), which "    \
  "'ambulo inverse' reads"
#define AS_TABLE "export the data as CSV"
#define NO_FILE_OF_OURS                                                                            \
  "models, problems and sweeps are texts in YAML: docs/model-format.md, docs/problem-format.md"

typedef struct prefix {
  const char *bytes;
  size_t length;
  format is;
} prefix;

#define BYTES(text) text, sizeof(text) - 1
static const prefix prefixes[] = {
    {BYTES("\x1f\x8b"), {"a gzip archive", UNPACK, UNPACK}},
    {BYTES("BZh"), {"a bzip2 archive", UNPACK, UNPACK}},
    {BYTES("\xfd"
           "7zXZ"),
     {"an xz archive", UNPACK, UNPACK}},
    {BYTES("\x28\xb5\x2f\xfd"), {"a zstd archive", UNPACK, UNPACK}},
    {BYTES("7z\xbc\xaf"), {"a 7z archive", UNPACK, UNPACK}},
    {BYTES("PK\x03\x04"),
     {"a zip archive or a spreadsheet", UNPACK, "unpack it first; save a spreadsheet as CSV"}},
    {BYTES("PK\x05\x06"), {"an empty zip archive", NULL, NULL}},
    {BYTES("\xd0\xcf\x11\xe0"), {"an office document", NO_FILE_OF_OURS, "save it as CSV"}},
    {BYTES("%PDF-"), {"a PDF", NO_FILE_OF_OURS, AS_TABLE}},
    {BYTES("\x89PNG"), {"a picture (PNG)", NO_FILE_OF_OURS, AS_TABLE}},
    {BYTES("\xff\xd8\xff"), {"a picture (JPEG)", NO_FILE_OF_OURS, AS_TABLE}},
    {BYTES("\x89HDF"), {"an HDF5 file (or a MAT-file of version 7.3)", AS_TABLE, AS_TABLE}},
    {BYTES("MATLAB 5.0 MAT-file"), {"a MAT-file", AS_TABLE, AS_TABLE}},
    {BYTES("\x93NUMPY"), {"a NumPy array", AS_TABLE, AS_TABLE}},
    {BYTES("\x7f"
           "ELF"),
     {"a program", NO_FILE_OF_OURS, NULL}},
    {BYTES("version https://git-lfs"),
     {"a pointer of Git LFS", "fetch the file itself: git lfs pull",
      "fetch the file itself: git lfs pull"}},
    {BYTES("PathFileType"), {"a TRC file", NO_MARKERS, NO_MARKERS}},
    {BYTES("HIERARCHY"),
     {"a BVH file", "it holds a motion and a skeleton of its own, neither of which is imported",
      "its angles are those of its own skeleton; expected are columns named after coordinates of "
      "the model"}},
};
enum { PREFIXES = sizeof prefixes / sizeof prefixes[0] };

static const format *of_prefix(look text) {
  size_t length = (size_t)(text.end - text.at);
  for (int i = 0; i < PREFIXES; i++) {
    const prefix *p = &prefixes[i];
    if (length >= p->length && memcmp(text.at, p->bytes, p->length) == 0) return &p->is;
  }
  return NULL;
}

/* The first byte of a C3D file is the block its parameters begin in, the second 0x50. */
static const format *of_c3d(look text, size_t length) {
  static const format is = {"a C3D file", NO_MARKERS, NO_MARKERS};
  unsigned char first = length > 0 ? (unsigned char)text.at[0] : 0;
  int control = first > 1 && first < ' ' && first != '\t' && first != '\n' && first != '\r';
  return length >= C3D_BLOCK && control && text.at[1] == 0x50 ? &is : NULL;
}

/* a byte-order mark of UTF-16, or a zero in every other byte as Latin letters have it there */
static int is_wide_text(const char *t, size_t length) {
  if (length < 4) return 0;
  if (memcmp(t, "\xff\xfe", 2) == 0 || memcmp(t, "\xfe\xff", 2) == 0) return 1;
  return (t[0] && !t[1] && t[2] && !t[3]) || (!t[0] && t[1] && !t[2] && t[3]);
}

/* one byte in ten is no text: a single one is left to the readers, who name its line */
static const format *of_bytes(look text) {
  static const format is = {"a binary file", NO_FILE_OF_OURS, AS_TABLE};
  ptrdiff_t strange = 0, length = text.end - text.at < 512 ? text.end - text.at : 512;
  for (ptrdiff_t i = 0; i < length; i++) {
    unsigned char c = (unsigned char)text.at[i];
    strange += c == 0x7f || (c < ' ' && c != '\t' && c != '\n' && c != '\r' && c != '\f');
  }
  return strange > 4 && 10 * strange > length ? &is : NULL;
}

/* --------------------------------------------------------------------------- XML */

static int begins(look text, const char *word) {
  size_t length = strlen(word);
  return (size_t)(text.end - text.at) >= length && strncasecmp(text.at, word, length) == 0;
}

static look skip_blanks(look text) {
  while (text.at < text.end && strchr(" \t\r\n\f", *text.at)) text.at++;
  return text;
}

/* behind the next `word`; the end when it does not come */
static look behind(look text, const char *word) {
  while (text.at < text.end && !begins(text, word)) text.at++;
  if (text.at < text.end) text.at += strlen(word);
  return text;
}

/* behind the '<' of the next element; comments, declarations and ends of elements are passed over
 */
static look next_element(look text) {
  for (text = skip_blanks(text); text.at < text.end; text = skip_blanks(text)) {
    if (begins(text, "<!--")) {
      text = behind(text, "-->");
    } else if (begins(text, "<?") || begins(text, "<!") || begins(text, "</")) {
      text = behind(text, ">");
    } else {
      return behind(text, "<");
    }
  }
  return text;
}

/* the word at the text is the name of an element */
static int is_element(look text, const char *name) {
  size_t length = strlen(name);
  if (!begins(text, name)) return 0;
  return text.at + length == text.end || strchr(" \t\r\n>/", text.at[length]) != NULL;
}

static const format *of_xml(look text) {
  static const format model = {"an OpenSim model (.osim)", IMPORT,
                               "a motion of OpenSim is its .sto or .mot"};
  static const format settings = {
      "a settings file of OpenSim (XML)", NO_FILE_OF_OURS,
      "name the .sto or .mot that it names; external loads go behind --grf, as FILE.xml"};
  static const struct {
    const char *root;
    format is;
  } roots[] = {
      {"robot", {"a URDF robot", IMPORT, NULL}},
      {"mujoco", {"a MuJoCo model (MJCF)", IMPORT, NULL}},
      {"mujocoinclude",
       {"a part of a MuJoCo model (MJCF)", "import the model that includes it: ambulo import",
        NULL}},
      {"sdf", {"an SDFormat model", BY_HAND, NULL}},
      {"svg", {"a drawing (SVG)", NO_FILE_OF_OURS, NULL}},
      {"html",
       {"a web page", "download the file itself, not the page that shows it",
        "download the file itself, not the page that shows it"}},
  };
  static const format other = {"an XML file", NO_FILE_OF_OURS, AS_TABLE};
  text = skip_blanks(text);
  if (text.end - text.at < 2 || *text.at != '<') return NULL;
  if (!isalpha((unsigned char)text.at[1]) && text.at[1] != '?' && text.at[1] != '!') return NULL;
  look root = next_element(text);
  if (is_element(root, "OpenSimDocument"))
    return is_element(next_element(behind(root, ">")), "Model") ? &model : &settings;
  for (size_t i = 0; i < sizeof roots / sizeof roots[0]; i++) {
    if (is_element(root, roots[i].root)) return &roots[i].is;
  }
  return root.at < root.end ? &other : NULL;
}

/* --------------------------------------------------------------- each other's files */

/* the line at the text, without its end; *next is behind it */
static look line_of(look text, look *next) {
  look line = text;
  const char *end = memchr(text.at, '\n', (size_t)(text.end - text.at));
  line.end = end ? end : text.end;
  next->at = end ? end + 1 : text.end;
  next->end = text.end;
  return line;
}

/* the first line that is neither blank nor a comment */
static look first_line(look text, look *next) {
  look line;
  do {
    line = line_of(text, next);
    line = skip_blanks(line);
    text = *next;
  } while (text.at < text.end && (line.at == line.end || *line.at == '#'));
  return line;
}

/* cells between separators; 0 for a line that YAML could begin with */
static int cells_of(look line, char separator) {
  int cells = 1;
  if (line.at == line.end || strchr("{[-%&!|>", *line.at)) return 0;
  for (const char *c = line.at; c < line.end; c++) {
    int ends = c + 1 == line.end || c[1] == ' ' || c[1] == '\r';
    if (*c == ':' && ends) return 0;
    cells += *c == separator;
  }
  return cells;
}

#define MOTIONS                                                                                    \
  "a motion goes to 'ambulo inverse MODEL.yaml MOTION', or below 'reference:' of a problem"

static const format *of_opensim_table(look text) {
  static const format is = {"a table of OpenSim (STO, MOT)", MOTIONS, "save it as CSV"};
  for (look rest = text; rest.at < rest.end;) {
    if (is_element(skip_blanks(line_of(rest, &rest)), "endheader")) return &is;
  }
  return NULL;
}

/* two lines with the same number of cells */
static const format *of_csv(look text) {
  static const format is = {"a table (CSV)", MOTIONS "; a sweep names its cases below 'table:'",
                            NULL};
  look next = text, names = first_line(text, &next);
  if (next.at == next.end) return NULL;
  look row = first_line(next, &next);
  for (const char *c = ",;\t"; *c; c++) {
    int cells = cells_of(names, *c);
    if (cells > 1 && cells_of(row, *c) == cells) return &is;
  }
  return NULL;
}

static const format *of_yaml(look text) {
  static const format own = {"a YAML file of Ambulo", NULL, "a result has its table in motion.csv"};
  static const format json = {"JSON", NULL, "a result has its table in motion.csv"};
  look next = text, line = first_line(text, &next);
  if (begins(line, "ambulo:") || begins(line, "kind:")) return &own;
  return line.at < line.end && *line.at == '{' ? &json : NULL;
}

/* ------------------------------------------------------------------------- refusal */

static const format *format_of(const char *text, size_t length, ambulo__taken taken) {
  look first = {text, text + (length < LOOK ? length : LOOK)};
  const format *is = of_prefix(first);
  if (!is) is = of_c3d(first, length);
  if (!is && length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) first.at += 3;
  if (!is) is = of_xml(first);
  if (!is) is = of_bytes(first);
  if (!is && taken != AMBULO__TAKES_MOTION) is = of_opensim_table(first);
  if (!is) is = taken == AMBULO__TAKES_YAML ? of_csv(first) : of_yaml(first);
  return is;
}

ambulo_status ambulo__refuse_foreign(const char *text, size_t length, ambulo__taken taken,
                                     const char *file, ambulo_diagnostics *diagnostics) {
  static const char *const expected[] = {"YAML", "a table (CSV)", "a motion (CSV, STO or MOT)"};
  ambulo__place place = {.file = file};
  if (is_wide_text(text, length))
    return ambulo__error(diagnostics, AMBULO_E_PARSE, place, "save the file as UTF-8",
                         "this is text in UTF-16; expected UTF-8");
  const format *is = format_of(text, length, taken);
  if (!is) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place,
                       taken == AMBULO__TAKES_YAML ? is->yaml_hint : is->table_hint,
                       "this is %s; expected %s", is->name, expected[taken]);
}
