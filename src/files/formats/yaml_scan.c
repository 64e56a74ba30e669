/* formats/yaml_scan.c - bytes that are refused before parsing.
 *
 * libyaml would refuse most of these as well, but with a byte offset instead of a line. */
#include "formats/yaml_tree.h"

#include <string.h>

/* Length of the UTF-8 sequence at the start of bytes[0..left), 0 if it is not valid: too
 * short, overlong, a surrogate, or beyond U+10FFFF. *code is the character. */
static size_t decode(const unsigned char *bytes, size_t left, uint32_t *code) {
  static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  unsigned char lead = bytes[0];
  if (lead < 0x80) {
    *code = lead;
    return 1;
  }
  size_t width = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 0;
  if (width == 0 || width > left || lead >= 0xf8) return 0;
  uint32_t value = lead & (0x7fU >> width);
  for (size_t i = 1; i < width; i++) {
    if ((bytes[i] & 0xc0) != 0x80) return 0;
    value = value << 6 | (bytes[i] & 0x3fU);
  }
  if (value < least[width] || value > 0x10ffff || (value >= 0xd800 && value < 0xe000)) return 0;
  *code = value;
  return width;
}

static int is_control(uint32_t code) {
  if (code < 0x20) return code != '\t' && code != '\n' && code != '\r';
  return code == 0x7f || (code >= 0x80 && code < 0xa0 && code != 0x85) || code == 0xfeff ||
         code == 0xfffe || code == 0xffff;
}

ambulo_status ambulo__yaml_scan(ambulo_diagnostics *diagnostics, const char *text, size_t length,
                                const char *file) {
  const unsigned char *bytes = (const unsigned char *)text;
  ambulo__place place = {file, 1, 1, NULL};
  for (size_t at = 0; at < length;) {
    uint32_t code = 0;
    size_t width = decode(bytes + at, length - at, &code);
    if (width == 0) {
      return ambulo__error(diagnostics, AMBULO_E_PARSE, place, "save the file as UTF-8",
                           "invalid UTF-8 (got byte 0x%02x); expected UTF-8 text", bytes[at]);
    }
    if (code == 0) {
      return ambulo__error(diagnostics, AMBULO_E_PARSE, place, NULL,
                           "got a NUL byte; expected text");
    }
    if (is_control(code)) {
      return ambulo__error(diagnostics, AMBULO_E_PARSE, place, NULL,
                           "got the control character U+%04X; expected text", (unsigned)code);
    }
    /* libyaml compares each %TAG with all others: a file of them would never end */
    if (code == '%' && place.column == 1 && strncmp(text + at, "%YAML ", 6) != 0) {
      return ambulo__error(diagnostics, AMBULO_E_PARSE, place, NULL,
                           "got a line that starts with '%%'; directives are not allowed");
    }
    at += width;
    int carriage = code == '\r' && !(at < length && bytes[at] == '\n');
    if (code == '\n' || carriage) {
      place.line++;
      place.column = 1;
    } else {
      place.column++;
    }
  }
  return AMBULO_OK;
}

/* offset of a line */
static size_t start_of_line(const char *text, size_t length, int line) {
  size_t at = 0;
  for (; line > 1 && at < length; at++)
    if (text[at] == '\n') line--;
  return at;
}

char ambulo__yaml_byte_at(const char *text, size_t length, int line, int column) {
  size_t at = start_of_line(text, length, line);
  for (; at < length && text[at] != '\n'; at++) {
    int is_first = ((unsigned char)text[at] & 0xc0) != 0x80; /* of a character */
    if (is_first && column-- == 1) return text[at];
  }
  return '\0';
}

int ambulo__yaml_tab_indent(const char *text, size_t length, int line) {
  size_t at = start_of_line(text, length, line);
  for (; at < length && (text[at] == ' ' || text[at] == '\t'); at++)
    if (text[at] == '\t') return 1;
  return 0;
}
