/* page/thin.c - see thin.h.
 *
 * Series are the only lists of as many whole numbers as there are samples; they are read off the
 * text, added up, and written again as scene/series.c writes them.
 */
#include "page/thin.h"

#include <stdlib.h>
#include <string.h>

enum { EVERY = 4, COARSER = 10 };

static const char samples_key[] = "\"samples\":";

static const char *skip_blanks(const char *c, const char *end) {
  while (c < end && (*c == ' ' || *c == '\n' || *c == '\r' || *c == '\t')) c++;
  return c;
}

/* the number of samples that the scene says it has, and where that number ends; 0: none */
static int find_samples(const char *scene, const char *end, const char **from, const char **to) {
  const char *key = strstr(scene, samples_key);
  if (!key || key >= end) return 0;
  char *behind;
  *from = key;
  long samples = strtol(key + sizeof samples_key - 1, &behind, 10);
  *to = behind;
  return samples > EVERY && samples < 1000000 && samples % EVERY == 1 ? (int)samples : 0;
}

/* the end of the list of `samples` whole numbers that begins behind a '[', or NULL */
static const char *series_end(const char *c, const char *end, int samples) {
  int count = 0;
  while (c < end) {
    c = skip_blanks(c, end);
    if (c < end && *c == '-') c++;
    const char *digits = c;
    while (c < end && *c >= '0' && *c <= '9') c++;
    if (c == digits) return NULL;
    count++;
    c = skip_blanks(c, end);
    if (c == end || (*c != ',' && *c != ']')) return NULL;
    if (*c++ == ']') return count == samples ? c : NULL;
  }
  return NULL;
}

/* half a unit away from zero, whatever the sign */
static long long coarser(long long value) {
  long long half = COARSER / 2;
  return (value + (value < 0 ? -half : half)) / COARSER;
}

static void write_thin(ambulo__text_buffer *out, const char *c, int samples) {
  long long value = 0, slope = 0, last = 0, change = 0;
  ambulo__text_append_char(out, '[');
  for (int k = 0; k < samples; k++) {
    char *behind;
    long long number = strtoll(c, &behind, 10);
    c = behind;
    while (*c != ',' && *c != ']') c++;
    c++;
    slope = k < 2 ? number : slope + number;
    value += slope;
    if (k == 0) slope = 0;
    if (k % EVERY != 0) continue;
    long long now = coarser(value), step = now - last;
    ambulo__text_append_format(out, k ? ",%lld" : "%lld", k <= EVERY ? step : step - change);
    change = step;
    last = now;
  }
  ambulo__text_append_char(out, ']');
}

void ambulo__scene_thin(ambulo__text_buffer *out, const char *scene, size_t length) {
  const char *end = scene + length, *from = end, *to = end;
  int samples = find_samples(scene, end, &from, &to), inside = 0;
  for (const char *c = scene; c < end;) {
    if (samples && c == from) {
      ambulo__text_append_format(out, "\"coarse\": %d, %s %d", COARSER, samples_key,
                                 (samples - 1) / EVERY + 1);
      c = to;
      continue;
    }
    const char *list = samples && !inside && *c == '[' ? series_end(c + 1, end, samples) : NULL;
    if (list) {
      write_thin(out, c + 1, samples);
      c = list;
      continue;
    }
    if (inside && *c == '\\' && end - c > 1)
      ambulo__text_append_char(out, *c++);
    else if (*c == '"')
      inside = !inside;
    ambulo__text_append_char(out, *c++);
  }
}
