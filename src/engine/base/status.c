/* base/status.c - names, texts and exit codes of statuses, from the one list.
 *
 * Reading order: status.c, alloc.h, diagnostics.h, worst.h (how maxima treat what is not finite),
 * lanes.h (the layout of all node arrays), clock.h; then, where files are written, atomic_file.h,
 * file_steps.h, seal.h; the rest as it is called.
 */
#include "ambulo/ambulo.h"

const char *ambulo_status_name(ambulo_status status) {
  switch (status) {
#define NAME_CASE(id, name, exit_status, text)                                                     \
  case id:                                                                                         \
    return name;
    AMBULO_STATUS_LIST(NAME_CASE)
#undef NAME_CASE
  }
  return "E_UNKNOWN";
}

const char *ambulo_status_text(ambulo_status status) {
  switch (status) {
#define TEXT_CASE(id, name, exit_status, text)                                                     \
  case id:                                                                                         \
    return text;
    AMBULO_STATUS_LIST(TEXT_CASE)
#undef TEXT_CASE
  }
  return "not a status of this library";
}

int ambulo_status_exit_code(ambulo_status status) {
  switch (status) {
#define EXIT_CASE(id, name, exit_status, text)                                                     \
  case id:                                                                                         \
    return exit_status;
    AMBULO_STATUS_LIST(EXIT_CASE)
#undef EXIT_CASE
  }
  return 6;
}

const char *ambulo_version(void) {
  return AMBULO_VERSION_STRING;
}
