/* show/svg_fit.c - labels of any length in the room there is (svg.h).
 *
 * The width of a text is not known before a program has its font: a letter counts as wide as the
 * mean of a bold sans-serif font, a sign of Chinese, Japanese or Korean as a square. UTF-8 is
 * counted, and cut, by whole signs.
 */
#include "show/svg.h"

#include <string.h>

static const double letter = 0.58, square = 1.0; /* of the font's size */
static const double smallest = 0.7;              /* of the size of the style */
static const char dots[] = "\xe2\x80\xa6";

/* of the sign at `c`; combining marks (U+0300 to U+036F) stand on the one before */
static double width_of(const char *c, size_t *bytes) {
  unsigned char first = (unsigned char)c[0], next = (unsigned char)c[1];
  size_t length = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  *bytes = 1;
  while (*bytes < length && ((unsigned char)c[*bytes] & 0xc0) == 0x80) (*bytes)++;
  if (first == 0xcc || (first == 0xcd && next < 0xb0)) return 0.0;
  int wide = first > 0xe2 || (first == 0xe2 && next >= 0xba) || /* from U+2E80 on */
             (first == 0xe1 && next >= 0x84 && next < 0x88);    /* U+1100 to U+11FF */
  return wide ? square : letter;
}

static double width_of_text(const char *label) {
  double width = 0.0;
  for (size_t bytes; *label; label += bytes) width += width_of(label, &bytes);
  return width;
}

void ambulo__svg_label_within(ambulo__text_buffer *text, const char *style, double x, double y,
                              double room, double font_size, const char *label) {
  double width = font_size * width_of_text(label);
  if (width <= room) {
    ambulo__svg_label(text, style, x, y, label);
    return;
  }
  double share = room / width;
  if (share >= smallest) {
    ambulo__svg_label_sized(text, style, x, y, share * font_size, label);
    return;
  }
  ambulo__text_buffer part;
  ambulo__text_init_part(&part, text);
  double left = room / (smallest * font_size) - square, used = 0.0;
  for (size_t bytes; *label; label += bytes) {
    used += width_of(label, &bytes);
    if (used > left) break;
    ambulo__text_append_bytes(&part, label, bytes);
  }
  ambulo__text_append(&part, dots);
  ambulo__svg_label_sized(text, style, x, y, smallest * font_size, ambulo__text_data(&part));
  ambulo__text_free(&part);
}
