/* tests/fuzz/target.h - what the targets share: a folder of their own, memory that is counted, and
 * what must hold whatever is read.
 *
 * A target reads bytes as one kind of file. Whatever they are, the call ends with a status and, if
 * that is none of memory, an error message without control characters; nothing it took is left. */
#ifndef AMBULO_TESTS_FUZZ_TARGET_H
#define AMBULO_TESTS_FUZZ_TARGET_H

#include "ambulo/tools/tools.h"
#include "support/scratch.h"

#include <stdint.h>

typedef struct fuzz_target {
  const char *name;
  void (*open)(void); /* once, in a folder that is there; NULL: nothing to do */
  /* `choice`: the first byte, which picks what the rest is */
  void (*run)(unsigned choice, const char *bytes, size_t length);
} fuzz_target;

static void *fuzz_state; /* the folder, as scratch.h has it */

static const char *fuzz_last = "an input"; /* what is read, for messages */
static int fuzz_near;

static void fuzz_fault(const char *what, const char *about) {
  fprintf(stderr, "FAULT: %s: %s (%s, change %d)\n", what, about, fuzz_last, fuzz_near);
  abort();
}

/* ---------------------------------------------------------------------- memory */

enum { FUZZ_MOST_BYTES = 512 << 20, FUZZ_HEAD = 64 };
static size_t fuzz_live, fuzz_blocks;

static void *fuzz_resize(void *user, void *pointer, size_t size) {
  (void)user;
  char *block = pointer ? (char *)pointer - FUZZ_HEAD : NULL;
  size_t before = block ? *(size_t *)(void *)block : 0;
  if (size == 0) {
    fuzz_blocks -= block != NULL;
    fuzz_live -= before;
    free(block);
    return NULL;
  }
  if (size > FUZZ_MOST_BYTES || fuzz_live - before + size > FUZZ_MOST_BYTES) return NULL;
  char *larger = realloc(block, size + FUZZ_HEAD);
  if (!larger) return NULL;
  *(size_t *)(void *)larger = size;
  fuzz_blocks += block == NULL;
  fuzz_live += size - before;
  return larger + FUZZ_HEAD;
}

static const ambulo_allocator fuzz_memory = {fuzz_resize, NULL};

/* ---------------------------------------------------------------------- a call */

typedef struct fuzz_call {
  ambulo_diagnostics *list;
  size_t blocks;
} fuzz_call;

static fuzz_call fuzz_begin(void) {
  return (fuzz_call){ambulo_diagnostics_create(NULL), fuzz_blocks};
}

static void fuzz_check_messages(const ambulo_diagnostics *list) {
  for (size_t i = 0; i < ambulo_diagnostics_count(list); i++) {
    char text[4096];
    (void)ambulo_diagnostics_format(list, i, text, sizeof text);
    for (const char *c = text; *c; c++)
      if ((unsigned char)*c < ' ' && *c != '\n') fuzz_fault("control character in a message", text);
  }
}

/* of the call that has just returned */
static void fuzz_status(const fuzz_call *call, ambulo_status status) {
  if (getenv("FUZZ_SAY")) {
    char text[1000] = "";
    if (status) (void)ambulo_diagnostics_format(call->list, 0, text, sizeof text);
    fprintf(stderr, "%s: %s\n", ambulo_status_name(status), text);
  }
  if (status == AMBULO_E_INTERNAL) fuzz_fault("status", ambulo_status_name(status));
  if (status && status != AMBULO_E_MEMORY && ambulo_diagnostics_error_count(call->list) == 0)
    fuzz_fault("no message for", ambulo_status_name(status));
}

/* all that the calls took is given back */
static void fuzz_end(fuzz_call *call) {
  fuzz_check_messages(call->list);
  ambulo_diagnostics_free(call->list);
  if (fuzz_blocks != call->blocks) fuzz_fault("memory is left", "blocks");
}

/* ----------------------------------------------------------------------- files */

static const char *fuzz_path(const char *name) {
  return scratch_path(&fuzz_state, name);
}

static const char *fuzz_put(const char *name, const char *bytes, size_t length) {
  const char *path = fuzz_path(name);
  int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || write(file, bytes, length) != (ssize_t)length || close(file))
    fuzz_fault("cannot write", path);
  return path;
}

/* a copy of a file of the clone */
static void fuzz_copy(const char *from, const char *name) {
  char path[SCRATCH_PATH + 64];
  (void)snprintf(path, sizeof path, "%s", from);
  char *text = read_whole(path);
  (void)fuzz_put(name, text, strlen(text));
  free(text);
}

static void fuzz_free_text(char *text) {
  if (text) ambulo_text_free(text, &fuzz_memory);
}

#endif
