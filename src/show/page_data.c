/* show/page_data.c - texts in a <script> element, and a result folder as data of a page (page.h).
 */
#include "ambulo/tools/inverse.h"
#include "ambulo/tools/load.h"
#include "ambulo/tools/report.h"
#include "base/numtext.h"
#include "formats/atomic_file.h"
#include "formats/deflate.h"
#include "formats/motion_file.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "model/model.h"
#include "show/page.h"
#include "show/scene.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* 1 if the line ends of JavaScript stand at `at`; their last byte is 0xa8 or 0xa9 */
static int is_line_end(const char *at, const char *end) {
  return end - at >= 3 && memcmp(at, "\xe2\x80", 2) == 0 && (at[2] == '\xa8' || at[2] == '\xa9');
}

/* appends what stands at `at`, made harmless; returns how many bytes that was */
static size_t append_safe(ambulo__text_buffer *out, const char *at, const char *end) {
  if (is_line_end(at, end)) {
    ambulo__text_append(out, at[2] == '\xa8' ? "\\u2028" : "\\u2029");
    return 3;
  }
  if (*at == '<') {
    ambulo__text_append(out, "\\u003c");
  } else {
    ambulo__text_append_char(out, *at);
  }
  return 1;
}

void ambulo__script_json(ambulo__text_buffer *out, const char *json, size_t length) {
  const char *end = json + length;
  int inside = 0; /* of a text */
  for (const char *c = json; c < end;) {
    if (!inside && (*c == ' ' || *c == '\n' || *c == '\r' || *c == '\t')) {
      c++;
      continue;
    }
    if (inside && *c == '\\' && end - c > 1) {
      ambulo__text_append_bytes(out, c, 2);
      c += 2;
      continue;
    }
    if (*c == '"') inside = !inside;
    c += append_safe(out, c, end);
  }
}

/* length of the UTF-8 character at `at`; 0: it is none (overlong, a surrogate, cut off) */
static size_t character(const unsigned char *at) {
  unsigned char low = 0x80, high = 0xbf;
  size_t length = at[0] < 0x80   ? 1
                  : at[0] < 0xc2 ? 0
                  : at[0] < 0xe0 ? 2
                  : at[0] < 0xf0 ? 3
                  : at[0] < 0xf5 ? 4
                                 : 0;
  if (at[0] == 0xe0) low = 0xa0;
  if (at[0] == 0xed) high = 0x9f;
  if (at[0] == 0xf0) low = 0x90;
  if (at[0] == 0xf4) high = 0x8f;
  for (size_t i = 1; i < length; i++, low = 0x80, high = 0xbf)
    if (at[i] < low || at[i] > high) return 0;
  return length;
}

void ambulo__script_text(ambulo__text_buffer *out, const char *text) {
  const char *end = text + strlen(text);
  ambulo__text_append_char(out, '"');
  for (const char *c = text; c < end;) {
    unsigned char byte = (unsigned char)*c;
    size_t length = character((const unsigned char *)c);
    if (length == 0) {
      ambulo__text_append(out, "\\ufffd");
      c++;
    } else if (byte < 0x20 || byte == 0x7f) {
      ambulo__text_append_format(out, "\\u%04x", byte);
      c++;
    } else if (byte == '"' || byte == '\\') {
      ambulo__text_append_char(out, '\\');
      ambulo__text_append_char(out, *c++);
    } else if (length == 1 || is_line_end(c, end)) {
      c += append_safe(out, c, end);
    } else {
      ambulo__text_append_bytes(out, c, length);
      c += length;
    }
  }
  ambulo__text_append_char(out, '"');
}

/* with the divisor, or the factor, a power of ten without an error, the result is the double that
 * is nearest to six digits */
static double six_digits(double value) {
  if (value == 0.0 || (fabs(value) < 1e15 && value == rint(value))) return value;
  int below = 5 - (int)floor(log10(fabs(value)));
  double scale = pow(10.0, fabs((double)below));
  if (!isfinite(scale)) return value;
  return below >= 0 ? rint(value * scale) / scale : rint(value / scale) * scale;
}

void ambulo__script_value(ambulo__text_buffer *out, const char *text) {
  double number;
  if (!text[0] || strcmp(text, "null") == 0)
    ambulo__text_append(out, "null");
  else if (ambulo__parse_double(text, strlen(text), &number) && isfinite(number))
    ambulo__text_append_number(out, six_digits(number));
  else
    ambulo__script_text(out, text);
}

static void append_base64(ambulo__text_buffer *out, const char *bytes, size_t length) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t at = 0; at < length; at += 3) {
    unsigned value = 0;
    for (size_t i = at; i < at + 3; i++)
      value = value << 8 | (i < length ? (unsigned)(unsigned char)bytes[i] : 0u);
    for (size_t i = 0; i < 4; i++)
      ambulo__text_append_char(out, at + i > length ? '=' : digits[(value >> (18 - 6 * i)) & 63]);
  }
}

void ambulo__packed_text(ambulo__text_buffer *out, const char *text, size_t length) {
  ambulo__text_buffer packed;
  ambulo__text_init_part(&packed, out);
  ambulo__deflate(&packed, text, length);
  ambulo__text_append_char(out, '"');
  append_base64(out, ambulo__text_data(&packed), packed.length);
  ambulo__text_append_char(out, '"');
  ambulo__text_free(&packed);
}

static const char folder_hint[] = "'ambulo solve PROBLEM.yaml -o DIR' fills one";
static const char newer_hint[] = "'ambulo solve' of this version writes one; solve it again";

ambulo_status ambulo__page_file_read(const char *directory, const char *name, const char *schema,
                                     const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics, ambulo__page_file *file) {
  ambulo__page_file f = {.allocator = ambulo__allocator_or_default(allocator)};
  f.path = ambulo__join_paths(&f.allocator, directory, name, NULL);
  ambulo_status status = f.path ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status)
    status = ambulo__read_file(f.path, AMBULO__YAML_MAX_BYTES, &f.allocator, diagnostics, &f.text,
                               &f.length);
  if (!status)
    status =
        ambulo__yaml_load_text(f.text, f.length, f.path, &f.allocator, diagnostics, &f.document);
  if (!status) {
    const ambulo__yaml_node *root = ambulo__yaml_root(f.document);
    const ambulo__yaml_node *given = ambulo__yaml_require(root, "schema");
    if (given && strncmp(ambulo__yaml_text(given), schema, strlen(schema)) != 0)
      (void)ambulo__yaml_error(given, AMBULO_E_SCHEMA, NULL, "schema is '%.60s'; expected %s",
                               ambulo__yaml_text(given), schema);
    status = ambulo__yaml_finish(f.document);
  }
  *file = f;
  if (status) ambulo__page_file_free(file);
  return status;
}

void ambulo__page_file_free(ambulo__page_file *file) {
  ambulo__yaml_free(file->document);
  ambulo__free(&file->allocator, file->text);
  ambulo__free(&file->allocator, file->path);
  memset(file, 0, sizeof *file);
}

/* files of two solves do not belong together */
static ambulo_status check_same(const ambulo__page_result *r) {
  const ambulo__yaml_node *hash[2] = {
      ambulo__yaml_require(ambulo__yaml_root(r->summary.document), "input_hash"),
      ambulo__yaml_require(ambulo__yaml_root(r->scene.document), "input_hash")};
  if (hash[0] && hash[1] && strcmp(ambulo__yaml_text(hash[0]), ambulo__yaml_text(hash[1])) != 0)
    (void)ambulo__yaml_error(hash[1], AMBULO_E_SCHEMA, "the files of a folder are of one solve",
                             "input_hash is '%.20s', in summary.json '%.20s'",
                             ambulo__yaml_text(hash[1]), ambulo__yaml_text(hash[0]));
  ambulo__page_check_scene(ambulo__yaml_root(r->scene.document));
  ambulo_status status = ambulo__yaml_finish(r->summary.document);
  return status ? status : ambulo__yaml_finish(r->scene.document);
}

/* a message that says more than that a file is not there */
static ambulo_status check_there(const char *directory, const char *name, const char *hint,
                                 const ambulo_allocator *a, ambulo_diagnostics *diagnostics) {
  struct stat entry;
  ambulo__place place = {.file = directory};
  if (stat(directory, &entry) != 0) return ambulo__io_error(diagnostics, directory, "open");
  if (!S_ISDIR(entry.st_mode))
    return ambulo__error(diagnostics, AMBULO_E_IO, place, NULL,
                         "a file; expected a result folder, or a batch folder");
  char *path = ambulo__join_paths(a, directory, name, NULL);
  if (!path) return AMBULO_E_MEMORY;
  int missing = stat(path, &entry) != 0 && errno == ENOENT;
  ambulo__free(a, path);
  if (!missing) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_IO, place, hint,
                       "the folder has no %s; expected a result folder, or a batch folder", name);
}

ambulo_status ambulo__page_result_read(const char *directory, const ambulo_allocator *allocator,
                                       ambulo_diagnostics *diagnostics,
                                       ambulo__page_result *result) {
  ambulo__page_result r = {.summary = {.text = NULL}};
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo_status status = check_there(directory, "summary.json", folder_hint, &a, diagnostics);
  if (!status) status = check_there(directory, "scene.json", newer_hint, &a, diagnostics);
  if (!status)
    status = ambulo__page_file_read(directory, "summary.json", "ambulo-summary/", &a, diagnostics,
                                    &r.summary);
  if (!status)
    status = ambulo__page_file_read(directory, "scene.json", "ambulo-scene/1", &a, diagnostics,
                                    &r.scene);
  if (!status) status = check_same(&r);
  *result = r;
  if (status) ambulo__page_result_free(result);
  return status;
}

void ambulo__page_result_free(ambulo__page_result *result) {
  ambulo__page_file_free(&result->summary);
  ambulo__page_file_free(&result->scene);
}

/* the picture, where there is one */
static ambulo_status strip(const char *directory, ambulo__text_buffer *out,
                           ambulo_diagnostics *diagnostics) {
  const ambulo_allocator *a = &out->allocator;
  char *path = ambulo__join_paths(a, directory, "gait.svg", NULL), *text = NULL;
  size_t length;
  ambulo_status status = path ? AMBULO_OK : AMBULO_E_MEMORY;
  int there = path && (access(path, F_OK) == 0 || errno != ENOENT);
  if (there)
    status = ambulo__read_file(path, AMBULO__YAML_MAX_BYTES, a, diagnostics, &text, &length);
  if (there && !status) {
    ambulo__text_append(out, ",\"strip\":");
    ambulo__script_text(out, text);
  }
  ambulo__free(a, text);
  ambulo__free(a, path);
  return status;
}

/* the last part of a path; "." and ".." say nothing: the whole of it */
static void folder_name(const char *directory, ambulo__text_buffer *out) {
  ambulo__text_buffer name;
  ambulo__text_init_part(&name, out);
  size_t length = strlen(directory);
  while (length > 1 && directory[length - 1] == '/') length--;
  size_t from = length;
  while (from > 0 && directory[from - 1] != '/') from--;
  if (from == length || directory[from] == '.') from = 0;
  ambulo__text_append_bytes(&name, directory + from, length - from);
  ambulo__script_text(out, ambulo__text_data(&name));
  ambulo__text_free(&name);
}

ambulo_status ambulo__page_add_result(const char *directory, int with_strip,
                                      ambulo__text_buffer *out, ambulo_diagnostics *diagnostics) {
  ambulo__page_result r;
  ambulo_status status = ambulo__page_result_read(directory, &out->allocator, diagnostics, &r);
  if (status) return status;
  ambulo__text_buffer data;
  ambulo__text_init_part(&data, out);
  ambulo__text_append(&data, "{\"summary\":");
  ambulo__script_json(&data, r.summary.text, r.summary.length);
  ambulo__text_append(&data, ",\"scene\":");
  ambulo__script_json(&data, r.scene.text, r.scene.length);
  if (with_strip) status = strip(directory, &data, diagnostics);
  ambulo__text_append_char(&data, '}');
  ambulo__text_append(out, "{\"name\":");
  folder_name(directory, out);
  ambulo__text_append(out, ",\"packed\":");
  ambulo__packed_text(out, ambulo__text_data(&data), data.length);
  ambulo__text_append_char(out, '}');
  ambulo__text_free(&data);
  ambulo__page_result_free(&r);
  return status ? status : ambulo__text_status(out);
}

/* a person's own motion as data of a page (page.h).
 *
 * Columns, units and doubts are those of inverse dynamics of a file (ambulo/tools/inverse.h), whose
 * table is read; between its rows values go linearly.
 */

/* q [AMBULO__SCENE_SAMPLES][coordinates] evenly spaced from..to */
static void sample(const ambulo_model *model, const ambulo__motion *table, double from, double to,
                   double *q) {
  int count = model->coordinate_count, row = 0, last = table->rows - 1;
  for (int k = 0; k < AMBULO__SCENE_SAMPLES; k++) {
    double t = from + (to - from) * k / (AMBULO__SCENE_SAMPLES - 1);
    while (row < last - 1 && table->time[row + 1] < t) row++;
    double share = (t - table->time[row]) / (table->time[row + 1] - table->time[row]);
    for (int i = 0; i < count; i++) {
      char name[AMBULO__MOTION_MAX_NAME + 3];
      (void)snprintf(name, sizeof name, "q.%s", model->coordinates[i].name);
      int column = ambulo__motion_column(table, name);
      const double *at = table->values + (size_t)row * (size_t)table->columns + column;
      q[k * count + i] = column < 0 ? 0.0 : at[0] + share * (at[table->columns] - at[0]);
    }
  }
}

static ambulo_status check_span(const ambulo_page_options *o, const ambulo__motion *table,
                                double span[2], ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = o->motion};
  double first = table->time[0], last = table->time[table->rows - 1];
  span[0] = fmax(o->from, first);
  span[1] = fmin(o->to, last);
  if (table->rows >= 2 && span[1] - span[0] > 1e-6) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, NULL,
                       "no motion from %g to %g s; the file has %g to %g s", o->from, o->to, first,
                       last);
}

static ambulo_status append(const ambulo_page_options *o, const ambulo__motion *table,
                            const double span[2], ambulo__text_buffer *out) {
  const ambulo_model *model = o->body;
  size_t count = (size_t)model->coordinate_count * AMBULO__SCENE_SAMPLES;
  double *q = ambulo__alloc(&out->allocator, count, sizeof *q);
  if (!q) return AMBULO_E_MEMORY;
  const char *slash = strrchr(o->motion, '/');
  const char *name = slash ? slash + 1 : o->motion;
  ambulo__text_buffer scene, data;
  ambulo__text_init(&scene, &out->allocator);
  sample(model, table, span[0], span[1], q);
  ambulo_status status = ambulo__scene_of_motion(model, "measured", q, AMBULO__SCENE_SAMPLES,
                                                 span[1] - span[0], o->ground_height, &scene);
  ambulo__text_init_part(&data, out);
  ambulo__text_append(&data, "{\"summary\":{},\"scene\":");
  ambulo__script_json(&data, ambulo__text_data(&scene), scene.length);
  ambulo__text_append_char(&data, '}');
  ambulo__text_append(out, "{\"name\":");
  ambulo__script_text(out, name);
  ambulo__text_append(out, ",\"packed\":");
  ambulo__packed_text(out, ambulo__text_data(&data), data.length);
  ambulo__text_append_char(out, '}');
  ambulo__text_free(&data);
  ambulo__text_free(&scene);
  ambulo__free(&out->allocator, q);
  return status ? status : ambulo__text_status(out);
}

ambulo_status ambulo__page_add_motion(const ambulo_page_options *o, ambulo__text_buffer *out,
                                      ambulo_diagnostics *diagnostics) {
  ambulo_inverse_options options = ambulo_inverse_options_default();
  options.without_forces = 1;
  options.ground_height = o->ground_height;
  char *text = NULL;
  double span[2];
  ambulo__motion *table = NULL;
  const ambulo_allocator *a = &out->allocator;
  ambulo_status status = ambulo_inverse_dynamics_motion(
      o->body, o->motion, NULL, &options, a, diagnostics,
      &(ambulo_inverse_outputs){.size = sizeof(ambulo_inverse_outputs), .text = &text});
  if (!status)
    status = ambulo__table_read(text, strlen(text), o->motion, AMBULO__MOTION_CSV, 1, a,
                                diagnostics, &table);
  if (!status) status = check_span(o, table, span, diagnostics);
  if (!status) status = append(o, table, span, out);
  ambulo__motion_free(table);
  ambulo_text_free(text, a);
  return status;
}
