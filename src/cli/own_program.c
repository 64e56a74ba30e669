/* cli/own_program.c - see own_program.h. Linux has a link in /proc, macOS a function of the loader
 * (untested), others may have the link under another name. */
#define _XOPEN_SOURCE 700 /* readlink */
#include "cli/own_program.h"

#include <stdint.h>
#include <string.h>
#include <unistd.h>

#ifdef __APPLE__
#include <mach-o/dyld.h>

static size_t ask(char *buffer, size_t size) {
  uint32_t room = size > UINT32_MAX ? UINT32_MAX : (uint32_t)size;
  return _NSGetExecutablePath(buffer, &room) == 0 ? strlen(buffer) : 0;
}
#else
static size_t ask(char *buffer, size_t size) {
  static const char *const links[] = {"/proc/self/exe", "/proc/curproc/file", "/proc/curproc/exe"};
  for (size_t i = 0; i < sizeof links / sizeof *links; i++) {
    ssize_t length = readlink(links[i], buffer, size - 1);
    if (length <= 0) continue;
    buffer[length] = '\0';
    return (size_t)length;
  }
  return 0;
}
#endif

int ambulo__cli_own_program(char *buffer, size_t size) {
  return size > 1 && ask(buffer, size) > 0;
}

const char *ambulo__cli_worker_program(void) {
  static char path[4096];
  if (access("/proc/self/exe", X_OK) == 0) return NULL;
  return ambulo__cli_own_program(path, sizeof path) ? path : NULL;
}
