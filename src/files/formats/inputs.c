/* formats/inputs.c - see inputs.h. */
#include "formats/inputs.h"

#include <string.h>

enum { DIGITS = AMBULO__SHA256_TEXT - 1, GAP = 2 };

int ambulo__inputs_next(const char **inputs, char digest[AMBULO__SHA256_TEXT], const char **path,
                        size_t *length) {
  const char *line = *inputs, *end = strchr(line, '\n');
  if (!end || end - line < DIGITS + GAP) return 0;
  memcpy(digest, line, DIGITS);
  digest[DIGITS] = '\0';
  *path = line + DIGITS + GAP;
  *length = (size_t)(end - *path);
  *inputs = end + 1;
  return 1;
}

const char *ambulo__inputs_find(const char *inputs, const char *path) {
  size_t length = strlen(path);
  if (length == 0) return NULL;
  for (const char *at = inputs ? strstr(inputs, path) : NULL; at; at = strstr(at + 1, path)) {
    const char *line = at - inputs >= DIGITS + GAP ? at - DIGITS - GAP : NULL;
    if (line && (line == inputs || line[-1] == '\n') && at[length] == '\n') return line;
  }
  return NULL;
}

static ambulo_status refuse(const char *path, const char *line, ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = path};
  if (!line)
    return ambulo__error(diagnostics, AMBULO_E_IO, place, "run it again",
                         "the file was not there when the run began; expected the same files");
  return ambulo__error(diagnostics, AMBULO_E_IO, place,
                       "inputs stay as they are while a run reads them; run it again",
                       "the file changed since the run began; expected the bytes of SHA-256 "
                       "%.12s...",
                       line);
}

/* E_IO where a list knows the path with other bytes */
static ambulo_status compare(const char *list, const char *path, const char *digest,
                             ambulo_diagnostics *diagnostics) {
  const char *line = ambulo__inputs_find(list, path);
  return !line || strncmp(line, digest, DIGITS) == 0 ? AMBULO_OK : refuse(path, line, diagnostics);
}

static ambulo_status add(ambulo__text_buffer *list, const char *path, const char *digest) {
  if (ambulo__inputs_find(ambulo__text_data(list), path)) return AMBULO_OK;
  ambulo__text_append_format(list, "%s  %s\n", digest, path);
  return ambulo__text_status(list);
}

static ambulo_status take(ambulo__inputs *inputs, const char *path, const char *text, size_t length,
                          ambulo_diagnostics *diagnostics) {
  char digest[AMBULO__SHA256_TEXT];
  ambulo__sha256_of(text, length, digest);
  ambulo_status status = AMBULO_OK;
  if (inputs->expected && !ambulo__inputs_find(inputs->expected, path))
    status = refuse(path, NULL, diagnostics);
  if (!status) status = compare(inputs->expected, path, digest, diagnostics);
  if (!status && inputs->known)
    status = compare(ambulo__text_data(inputs->known), path, digest, diagnostics);
  if (!status) status = compare(ambulo__text_data(&inputs->read), path, digest, diagnostics);
  if (!status) status = add(&inputs->read, path, digest);
  if (!status && inputs->known) status = add(inputs->known, path, digest);
  return status;
}

ambulo_status ambulo__inputs_read(ambulo__inputs *inputs, const char *path, size_t limit,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, char **text, size_t *length) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  char *read = NULL;
  size_t size = 0;
  ambulo_status status = ambulo__read_file(path, limit, &own, diagnostics, &read, &size);
  if (!status && inputs) status = take(inputs, path, read, size, diagnostics);
  if (status) {
    ambulo__free(&own, read);
    return status;
  }
  *text = read;
  *length = size;
  return AMBULO_OK;
}

void ambulo__inputs_json(const char *inputs, ambulo__json *json) {
  char digest[AMBULO__SHA256_TEXT];
  const char *path;
  size_t length;
  if (!inputs[0]) return;
  ambulo__json_open(json, "inputs", '{');
  while (ambulo__inputs_next(&inputs, digest, &path, &length)) {
    ambulo__text_buffer name;
    ambulo__text_init_part(&name, json->text);
    ambulo__text_append_bytes(&name, path, length);
    ambulo__json_text(json, ambulo__text_data(&name), digest);
    ambulo__text_free(&name);
  }
  ambulo__json_close(json, '}');
}
