/* show/script_text.c - see script_text.h. */
#include "show/script_text.h"

#include <math.h>
#include <string.h>

#include "base/numtext.h"

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
