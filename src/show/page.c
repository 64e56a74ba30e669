/* show/page.c - the page of `ambulo report`: the viewer with data in it (page.h). */
#include "show/page.h"

#include "base/numtext.h"
#include "base/sized.h"
#include "formats/atomic_file.h"
#include "formats/deflate.h"
#include "formats/paths.h"

#include <math.h>
#include <string.h>
#include <sys/stat.h>

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

/* the page: the viewer with data in it (ambulo/tools/page.h). Its own program is in viewer/, from
 * main.js on; data of a study: study/study_page.c. */

enum { START_BYTES = 1024 };

/* how a page is known for one of ours; and where the data go */
static const char own_mark[] = "<meta name=\"generator\" content=\"ambulo report\">";
static const char data_mark[] = "/*DATA*/";

static int options_are_valid(const ambulo_page_options *o) {
  if (!isfinite(o->ground_height)) return 0;
  if (!(o->megabytes >= 0.0 && o->megabytes <= 1e6)) return 0;
  return !o->motion || (o->body && o->from < o->to);
}

/* what stands at `output` is kept unless it is a page of ours */
static ambulo_status check_output(const char *output, int overwrite,
                                  ambulo_diagnostics *diagnostics) {
  struct stat there;
  ambulo__place place = {.file = output};
  if (overwrite || stat(output, &there) != 0 || !S_ISREG(there.st_mode) || there.st_size == 0)
    return AMBULO_OK;
  if (ambulo__file_says(output, own_mark, START_BYTES)) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_IO, place,
                       "give another name, or --force (in C: overwrite)",
                       "the file exists, and is no page by ambulo; it is not written over");
}

ambulo_status ambulo__page_begin(const ambulo_page_options *options, const char *output,
                                 ambulo_diagnostics *diagnostics, ambulo_page_options *own) {
  if (!AMBULO__OWN(ambulo_page_options, own, options)) return AMBULO_E_ARGUMENT;
  if (!output || !options_are_valid(own)) return AMBULO_E_ARGUMENT;
  return check_output(output, own->overwrite, diagnostics);
}

static int is_batch(const char *directory, const ambulo_allocator *a) {
  struct stat entry;
  char *path = ambulo__join_paths(a, directory, "batch.json", NULL);
  int there = path && stat(path, &entry) == 0;
  ambulo__free(a, path);
  return there;
}

static ambulo_status results(const char *const *directories, int count,
                             const ambulo_page_options *o, ambulo__text_buffer *data,
                             ambulo_diagnostics *diagnostics) {
  ambulo_status status = AMBULO_OK;
  ambulo__text_append(data, "\"results\":[");
  for (int i = 0; i < count && !status; i++) {
    ambulo__place place = {.file = directories[i]};
    if (i) ambulo__text_append_char(data, ',');
    if (is_batch(directories[i], &data->allocator))
      return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place,
                           "in C ambulo_batch_page writes the page of a batch",
                           "a batch folder beside others; expected it alone, or result folders");
    status = ambulo__page_add_result(directories[i], i == 0, data, diagnostics);
  }
  if (!status && o->motion) {
    ambulo__text_append_char(data, ',');
    status = ambulo__page_add_motion(o, data, diagnostics);
  }
  ambulo__text_append_char(data, ']');
  return status ? status : ambulo__text_status(data);
}

ambulo_status ambulo__page_save(const char *output, const ambulo__text_buffer *data,
                                ambulo_diagnostics *diagnostics) {
  const char *viewer = (const char *)ambulo__viewer;
  const char *mark = strstr(viewer, data_mark);
  if (!mark) return AMBULO_E_INTERNAL;
  size_t before = (size_t)(mark - viewer), behind = before + sizeof data_mark - 1;
  ambulo__text_buffer page;
  ambulo__text_init(&page, &data->allocator);
  ambulo__text_append_bytes(&page, viewer, before);
  ambulo__text_append_bytes(&page, ambulo__text_data(data), data->length);
  ambulo__text_append_bytes(&page, viewer + behind, ambulo__viewer_size - behind);
  ambulo_status status = ambulo__text_status(&page);
  if (!status)
    status = ambulo__write_file(output, ambulo__text_data(&page), page.length, 1, &data->allocator,
                                diagnostics);
  ambulo__text_free(&page);
  return status;
}

ambulo_status ambulo_page_write(const char *const *directories, int count, const char *output,
                                const ambulo_page_options *options,
                                const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics) {
  ambulo_page_options own;
  if (!directories || count < 1) return AMBULO_E_ARGUMENT;
  for (int i = 0; i < count; i++)
    if (!directories[i]) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = ambulo__page_begin(options, output, diagnostics, &own);
  if (status == AMBULO_E_ARGUMENT) return status;
  ambulo__text_buffer data;
  ambulo__text_init(&data, allocator);
  ambulo__text_append_char(&data, '{');
  if (!status) status = results(directories, count, &own, &data, diagnostics);
  ambulo__text_append_char(&data, '}');
  if (!status) status = ambulo__page_save(output, &data, diagnostics);
  ambulo__text_free(&data);
  return ambulo__conclude(diagnostics, errors, status, output);
}
