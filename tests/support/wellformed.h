/* tests/support/wellformed.h - is a text JSON, is it XML? Tiny recognizers, no content. */
#ifndef AMBULO_TESTS_WELLFORMED_H
#define AMBULO_TESTS_WELLFORMED_H

#include <ctype.h>
#include <stddef.h>
#include <string.h>

/* ---------------------------------------------------------------------- JSON */
/* Each reads one construct and returns where it ends, or NULL. */

static inline const char *json_blanks(const char *s) {
  return s ? s + strspn(s, " \t\r\n") : NULL;
}

static inline const char *json_string(const char *s) {
  if (*s != '"') return NULL;
  for (s++; *s && *s != '"'; s++) {
    if ((unsigned char)*s < 0x20) return NULL;
    if (*s != '\\') continue;
    s++;
    if (*s == 'u') {
      for (int i = 0; i < 4; i++)
        if (!isxdigit((unsigned char)*++s)) return NULL;
    } else if (!*s || !strchr("\"\\/bfnrt", *s)) {
      return NULL;
    }
  }
  return *s ? s + 1 : NULL;
}

static inline const char *json_digits(const char *s) {
  size_t count = s ? strspn(s, "0123456789") : 0;
  return count ? s + count : NULL;
}

static inline const char *json_number(const char *s) {
  if (*s == '-') s++;
  if (*s == '0' && isdigit((unsigned char)s[1])) return NULL;
  s = json_digits(s);
  if (s && *s == '.') s = json_digits(s + 1);
  if (s && (*s == 'e' || *s == 'E')) {
    s++;
    if (*s == '+' || *s == '-') s++;
    s = json_digits(s);
  }
  return s;
}

static inline const char *json_value(const char *s, int depth) {
  if (depth > 64) return NULL;
  s = json_blanks(s);
  if (*s == '"') return json_string(s);
  if (*s == '{' || *s == '[') {
    int object = *s == '{';
    char end = object ? '}' : ']';
    s = json_blanks(s + 1);
    if (*s == end) return s + 1;
    for (;;) {
      if (object) {
        s = json_string(json_blanks(s));
        s = json_blanks(s);
        if (!s || *s != ':') return NULL;
        s++;
      }
      s = json_value(s, depth + 1);
      s = json_blanks(s);
      if (!s || (*s != ',' && *s != end)) return NULL;
      if (*s++ == end) return s;
    }
  }
  static const char *const words[] = {"true", "false", "null"};
  for (int i = 0; i < 3; i++) {
    if (!strncmp(s, words[i], strlen(words[i]))) return s + strlen(words[i]);
  }
  return json_number(s);
}

static inline int is_json(const char *text) {
  const char *end = json_blanks(json_value(text, 0));
  return end && *end == '\0';
}

/* ----------------------------------------------------------------------- XML */

static inline int xml_is_name(char c) {
  return isalnum((unsigned char)c) || c == '-' || c == '_' || c == ':';
}

/* Elements nest, attributes are quoted, '<' and '&' appear only as markup. */
static inline int is_xml(const char *s) {
  const char *open[64];
  size_t length[64];
  int depth = 0, roots = 0;
  if (!strncmp(s, "<?xml", 5)) {
    s = strstr(s, "?>");
    if (!s) return 0;
    s += 2;
  }
  while (*s) {
    if (*s == '&') {
      size_t n = strcspn(s, ";");
      if (!s[n] || n < 2 || n > 8) return 0;
      s += n;
    }
    if (*s != '<') {
      if (depth == 0 && !isspace((unsigned char)*s)) return 0;
      s++;
      continue;
    }
    int closing = s[1] == '/';
    const char *name = s + 1 + closing;
    size_t n = 0;
    while (xml_is_name(name[n])) n++;
    if (n == 0) return 0;
    s = name + n;
    while (*s && *s != '>' && *s != '/') {
      if (*s == '<') return 0;
      if (*s == '"') {
        s++;
        s += strcspn(s, "\"<");
        if (*s != '"') return 0;
      }
      s++;
    }
    int empty = *s == '/';
    if (empty) s++;
    if (*s != '>') return 0;
    s++;
    if (closing) {
      if (depth == 0) return 0;
      depth--;
      if (length[depth] != n || strncmp(open[depth], name, n) != 0) return 0;
    } else if (!empty) {
      if (depth == 64) return 0;
      if (depth == 0) roots++;
      open[depth] = name;
      length[depth++] = n;
    }
  }
  return depth == 0 && roots == 1;
}

/* how often `what` occurs */
static inline int occurrences(const char *text, const char *what) {
  int count = 0;
  for (const char *at = strstr(text, what); at; at = strstr(at + 1, what)) count++;
  return count;
}

#endif
