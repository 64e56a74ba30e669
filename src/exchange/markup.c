/* exchange/markup.c - see markup.h. */
#include "exchange/markup.h"

#include <math.h>

void ambulo__markup_text(ambulo__text_buffer *text, const char *plain) {
  for (const char *c = plain; *c; c++) {
    switch (*c) {
    case '&':
      ambulo__text_append(text, "&amp;");
      break;
    case '<':
      ambulo__text_append(text, "&lt;");
      break;
    case '>':
      ambulo__text_append(text, "&gt;");
      break;
    case '"':
      ambulo__text_append(text, "&quot;");
      break;
    default:
      ambulo__text_append_char(text, *c);
    }
  }
}

void ambulo__markup_numbers(ambulo__text_buffer *text, const double *values, int count) {
  for (int i = 0; i < count; i++) {
    if (i) ambulo__text_append_char(text, ' ');
    ambulo__text_append_number(text, values[i] == 0.0 ? 0.0 : values[i]);
  }
}

void ambulo__markup_tabs(ambulo__text_buffer *text, int depth) {
  while (depth-- > 0) ambulo__text_append_char(text, '\t');
}

void ambulo__markup_element(ambulo__text_buffer *text, int depth, const char *tag,
                            const double *values, int count) {
  ambulo__markup_tabs(text, depth);
  ambulo__text_append_format(text, "<%s>", tag);
  ambulo__markup_numbers(text, values, count);
  ambulo__text_append_format(text, "</%s>\n", tag);
}

/* R[0] = (cb cc, -cb sc, sb), (R[1][2], R[2][2]) = cb (-sa, ca). The last angle is that of
 * Rot_y(b)' Rot_x(a)' R, so that where cb vanishes, and a is any, c makes up for it. */
void ambulo__xyz_of_rotation(const double r[3][3], double angles[3]) {
  double a = atan2(-r[1][2], r[2][2]);
  double b = atan2(r[0][2], hypot(r[0][0], r[0][1]));
  double ca = cos(a), sa = sin(a);
  double c = atan2(ca * r[1][0] + sa * r[2][0], ca * r[1][1] + sa * r[2][1]);
  angles[0] = a;
  angles[1] = b;
  angles[2] = c;
}
