/* show/svg.c - SVG elements, one function each, and the style sheet. */
#include "show/svg.h"

#include <math.h>
#include <string.h>

static const char style_sheet[] =
    "<style>\n"
    "text{font-family:'Helvetica Neue',Helvetica,Arial,'Liberation Sans',sans-serif;"
    "font-size:12px;fill:#5f6b78}\n"
    ".title{font-size:22px;font-weight:bold;fill:#1d2733}\n"
    ".subtitle{font-size:13px}\n"
    ".panel{font-size:13px;font-weight:bold;fill:#1d2733}\n"
    ".middle{text-anchor:middle}\n"
    ".end{text-anchor:end}\n"
    ".inbar{font-size:10px;fill:#fff;text-anchor:middle}\n"
    ".left-text{fill:#c8501c;font-weight:bold}\n"
    ".right-text{fill:#1c67a8;font-weight:bold}\n"
    ".background{fill:#fff}\n"
    ".grid{stroke:#e8ecf0;stroke-width:1}\n"
    ".zero{stroke:#b9c2cc;stroke-width:1}\n"
    ".axis{stroke:#8b96a2;stroke-width:1}\n"
    ".ground{stroke:#8b96a2;stroke-width:1.5}\n"
    ".edge{fill:none;stroke:#8b96a2;stroke-width:1.5;stroke-linejoin:round}\n"
    ".soil{fill:#f3f5f7}\n"
    ".place{fill:none;stroke:#1e8449;stroke-width:3}\n"
    ".obstacle{fill:#cfd6dd;stroke:#6b7682;stroke-width:1.2}\n"
    ".trunk,.left,.right{fill:none;stroke-linecap:round;stroke-linejoin:round;stroke-width:3.4}\n"
    ".trunk{stroke:#1d2733}\n"
    ".left{stroke:#e0662f}\n"
    ".right{stroke:#2377bd}\n"
    ".head{fill:#fff;stroke:#1d2733;stroke-width:2.4}\n"
    ".curve{stroke-width:2.2}\n"
    ".left-people{fill:#e0662f;fill-opacity:.17}\n"
    ".right-people{fill:#2377bd;fill-opacity:.17}\n"
    ".both-people{fill:#5f6b78;fill-opacity:.2}\n"
    ".trunk.people{stroke:#5f6b78}\n"
    ".people{stroke-width:1.3;stroke-dasharray:5 3;stroke-linecap:butt;stroke-opacity:.75}\n"
    ".device{fill:none;stroke:#2e8b57;stroke-width:2.6;stroke-linecap:round}\n"
    ".worn{stroke-width:2.2;stroke-dasharray:.5 4.5;stroke-linecap:round}\n"
    ".device-text{fill:#23704a;font-weight:bold}\n"
    ".brace{fill:none;stroke:#2e8b57;stroke-width:10;stroke-opacity:.45;stroke-linecap:round;"
    "stroke-linejoin:round}\n"
    ".motor{fill:#2e8b57}\n"
    ".idle{opacity:.35}\n"
    ".load{fill:#aab3bd;stroke:#3f4853;stroke-width:1.4;stroke-linejoin:round}\n"
    ".box{fill:#d9b382;stroke:#7a5526;stroke-width:1.4}\n"
    ".push{stroke:#b3261e;stroke-width:2.4;stroke-linecap:round}\n"
    ".left-mark{stroke:#e0662f;stroke-width:4;stroke-linecap:round}\n"
    ".right-mark{stroke:#2377bd;stroke-width:4;stroke-linecap:round}\n"
    ".trunk-mark{stroke:#1d2733;stroke-width:4;stroke-linecap:round}\n"
    ".left-print,.right-print,.trunk-print{fill-opacity:.3;stroke-width:1.4}\n"
    ".left-print{fill:#e0662f;stroke:#e0662f}\n"
    ".right-print{fill:#2377bd;stroke:#2377bd}\n"
    ".trunk-print{fill:#1d2733;stroke:#1d2733}\n"
    ".left-bar{fill:#e0662f}\n"
    ".right-bar{fill:#2377bd}\n"
    ".trunk-bar{fill:#1d2733}\n"
    ".partial{fill-opacity:.62}\n"
    ".lane{fill:#f3f5f7}\n"
    ".thin{stroke-width:1.2}\n"
    ".left-cross{stroke:#c8501c;stroke-width:2;stroke-linecap:round}\n"
    ".on-light{fill:#1d2733;text-anchor:middle}\n"
    ".on-dark{fill:#fff;text-anchor:middle}\n"
    "</style>\n";

static void escape(ambulo__text_buffer *text, const char *string) {
  for (const char *c = string; *c; c++) {
    unsigned char byte = (unsigned char)*c;
    if (*c == '&') {
      ambulo__text_append(text, "&amp;");
    } else if (*c == '<') {
      ambulo__text_append(text, "&lt;");
    } else if (*c == '>') {
      ambulo__text_append(text, "&gt;");
    } else if (*c == '"') {
      ambulo__text_append(text, "&quot;");
    } else if (byte >= 0x20) {
      ambulo__text_append_char(text, *c);
    }
  }
}

static void number(ambulo__text_buffer *text, double value) {
  double rounded = round(value * 100.0) / 100.0;
  ambulo__text_append_number(text, rounded == 0.0 ? 0.0 : rounded);
}

static void attribute(ambulo__text_buffer *text, const char *name, double value) {
  ambulo__text_append_format(text, " %s=\"", name);
  number(text, value);
  ambulo__text_append_char(text, '"');
}

static void open_element(ambulo__text_buffer *text, const char *name, const char *style) {
  ambulo__text_append_format(text, "<%s class=\"%s\"", name, style);
}

/* " width="180mm"" */
static void length_attribute(ambulo__text_buffer *text, const char *name, double value,
                             const char *unit) {
  ambulo__text_append_format(text, " %s=\"", name);
  number(text, value);
  ambulo__text_append_format(text, "%s\"", unit);
}

void ambulo__svg_begin(ambulo__text_buffer *text, double width, double height, double millimetres,
                       const char *title) {
  double scale = millimetres > 0.0 ? millimetres / width : 1.0;
  const char *unit = millimetres > 0.0 ? "mm" : "";
  ambulo__text_append(text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                            "<svg xmlns=\"http://www.w3.org/2000/svg\"");
  length_attribute(text, "width", scale * width, unit);
  length_attribute(text, "height", scale * height, unit);
  ambulo__text_append(text, " viewBox=\"0 0 ");
  number(text, width);
  ambulo__text_append_char(text, ' ');
  number(text, height);
  ambulo__text_append(text, "\">\n<title>");
  escape(text, title);
  ambulo__text_append(text, "</title>\n");
  ambulo__text_append(text, style_sheet);
  ambulo__svg_rectangle(text, "background", 0.0, 0.0, width, height);
}

void ambulo__svg_end(ambulo__text_buffer *text) {
  ambulo__text_append(text, "</svg>\n");
}

void ambulo__svg_line(ambulo__text_buffer *text, const char *style, double x1, double y1, double x2,
                      double y2) {
  open_element(text, "line", style);
  attribute(text, "x1", x1);
  attribute(text, "y1", y1);
  attribute(text, "x2", x2);
  attribute(text, "y2", y2);
  ambulo__text_append(text, "/>\n");
}

void ambulo__svg_rectangle(ambulo__text_buffer *text, const char *style, double x, double y,
                           double width, double height) {
  open_element(text, "rect", style);
  attribute(text, "x", x);
  attribute(text, "y", y);
  attribute(text, "width", width);
  attribute(text, "height", height);
  ambulo__text_append(text, "/>\n");
}

void ambulo__svg_circle(ambulo__text_buffer *text, const char *style, double x, double y,
                        double radius) {
  open_element(text, "circle", style);
  attribute(text, "cx", x);
  attribute(text, "cy", y);
  attribute(text, "r", radius);
  ambulo__text_append(text, "/>\n");
}

void ambulo__svg_label(ambulo__text_buffer *text, const char *style, double x, double y,
                       const char *label) {
  open_element(text, "text", style);
  attribute(text, "x", x);
  attribute(text, "y", y);
  ambulo__text_append_char(text, '>');
  escape(text, label);
  ambulo__text_append(text, "</text>\n");
}

void ambulo__svg_label_sized(ambulo__text_buffer *text, const char *style, double x, double y,
                             double font_size, const char *label) {
  open_element(text, "text", style);
  attribute(text, "x", x);
  attribute(text, "y", y);
  ambulo__text_append(text, " style=\"font-size:");
  number(text, font_size);
  ambulo__text_append(text, "px\"");
  ambulo__text_append_char(text, '>');
  escape(text, label);
  ambulo__text_append(text, "</text>\n");
}

void ambulo__svg_group_begin(ambulo__text_buffer *text, const char *style) {
  open_element(text, "g", style);
  ambulo__text_append(text, ">\n");
}

void ambulo__svg_group_turned(ambulo__text_buffer *text, const char *style, double degrees,
                              double x, double y) {
  open_element(text, "g", style);
  ambulo__text_append(text, " transform=\"rotate(");
  number(text, -degrees);
  ambulo__text_append_char(text, ' ');
  number(text, x);
  ambulo__text_append_char(text, ' ');
  number(text, y);
  ambulo__text_append(text, ")\">\n");
}

void ambulo__svg_group_end(ambulo__text_buffer *text) {
  ambulo__text_append(text, "</g>\n");
}

void ambulo__svg_path_begin(ambulo__text_buffer *text, const char *style) {
  open_element(text, "path", style);
  ambulo__text_append(text, " d=\"");
}

static void path_step(ambulo__text_buffer *text, char step, double x, double y) {
  ambulo__text_append_char(text, step);
  number(text, x);
  ambulo__text_append_char(text, ' ');
  number(text, y);
}

void ambulo__svg_path_move(ambulo__text_buffer *text, double x, double y) {
  path_step(text, 'M', x, y);
}

void ambulo__svg_path_line(ambulo__text_buffer *text, double x, double y) {
  path_step(text, 'L', x, y);
}

void ambulo__svg_path_end(ambulo__text_buffer *text) {
  ambulo__text_append(text, "\"/>\n");
}

void ambulo__label_number(ambulo__text_buffer *text, double value, int decimals) {
  double scale = pow(10.0, (double)decimals);
  double rounded = round(value * scale) / scale;
  if (rounded < 0.0) ambulo__text_append(text, "\xe2\x88\x92"); /* a minus sign, not a hyphen */
  ambulo__text_append_number(text, fabs(rounded));
}

double ambulo__nice_step(double range, int parts, int *decimals) {
  static const double steps[] = {1.0, 2.0, 2.5, 5.0, 10.0};
  double rough = range > 0.0 && isfinite(range) ? range / (double)parts : 1.0;
  double power = pow(10.0, floor(log10(rough)));
  double step = 10.0;
  for (int i = 4; i >= 0; i--) {
    if (steps[i] * power >= rough * 0.9999) step = steps[i];
  }
  int needed = (int)-floor(log10(power)) + (step == 2.5);
  if (step == 10.0) needed--;
  *decimals = needed < 0 ? 0 : needed > 6 ? 6 : needed;
  return step * power;
}

/* labels of any length in the room there is (svg.h).
 *
 * The width of a text is not known before a program has its font: a letter counts as wide as the
 * mean of a bold sans-serif font, a sign of Chinese, Japanese or Korean as a square. UTF-8 is
 * counted, and cut, by whole signs.
 */

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
