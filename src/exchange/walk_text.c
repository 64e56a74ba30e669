/* exchange/walk_text.c - numbers and mappings of problem files that are written for a body. */
#include "exchange/walker.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/numtext.h"

enum { WIDTH = 100 };

double ambulo__significant(double x, int digits) {
  if (x == 0.0 || !isfinite(x)) return x;
  int exponent = digits - 1 - (int)floor(log10(fabs(x)));
  double power = pow(10.0, abs(exponent));
  return exponent >= 0 ? round(x * power) / power : round(x / power) * power;
}

void ambulo__walk_number(ambulo__text_buffer *text, double value) {
  ambulo__text_append_number(text, ambulo__significant(value, 4));
}

void ambulo__walk_model(ambulo__text_buffer *text, const char *file) {
  static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./";
  int quoted = 0;
  for (const char *c = file; *c; c++) quoted |= !strchr(plain, *c) && *c != '-';
  ambulo__text_append(text, quoted ? "model: '" : "model: ");
  for (const char *c = file; *c; c++) {
    ambulo__text_append_char(text, *c);
    if (quoted && *c == '\'') ambulo__text_append_char(text, *c);
  }
  ambulo__text_append(text, quoted ? "'\n" : "\n");
}

ambulo__walk_map ambulo__walk_map_begin(ambulo__text_buffer *text, int indent, const char *key) {
  ambulo__text_append_format(text, "%*s%s: {", indent, "", key);
  return (ambulo__walk_map){
      .text = text, .indent = indent, .column = indent + (int)strlen(key) + 3};
}

void ambulo__walk_map_item(ambulo__walk_map *map, const char *name, const double *values,
                           int count) {
  char item[256] = "";
  size_t length = 0;
  for (int i = 0; i < count && length < sizeof item - AMBULO__NUMTEXT_SIZE - 4; i++) {
    ambulo__number number = ambulo__number_text(ambulo__significant(values[i], 4));
    const char *before = i ? ", " : count > 1 ? "[" : "";
    for (const char *c = before; *c; c++) item[length++] = *c;
    for (const char *c = number.text; *c; c++) item[length++] = *c;
  }
  if (count > 1) item[length++] = ']';
  item[length] = '\0';
  int columns = (int)(strlen(name) + length) + 4;
  if (map->items) ambulo__text_append(map->text, ",");
  if (map->column + columns > WIDTH) {
    ambulo__text_append_format(map->text, "\n%*s", map->indent + 2, "");
    map->column = map->indent + 2;
  } else if (map->items)
    ambulo__text_append(map->text, " ");
  ambulo__text_append_format(map->text, "%s: %s", name, item);
  map->column += columns;
  map->items++;
}

void ambulo__walk_map_end(ambulo__walk_map *map) {
  ambulo__text_append(map->text, "}\n");
}
