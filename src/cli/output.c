/* cli/output.c - messages on stderr, and the certainty that stdout was written. */
#include "cli/output.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/shipped.h"

/* what a user typed may hold control characters: they are shown, never sent */
static void print_escaped(FILE *stream, const char *text) {
  for (; *text; text++) {
    unsigned char c = (unsigned char)*text;
    if (c < 0x20 || c == 0x7f) {
      fprintf(stream, "\\x%02x", c);
    } else {
      fputc(c, stream);
    }
  }
}

static void message(const char *code, const char *hint, const char *format, va_list arguments) {
  char text[6000];
  int length = vsnprintf(text, sizeof text, format, arguments);
  if (length < 0) text[0] = '\0';
  fprintf(stderr, "ambulo: error[%s]: ", code);
  print_escaped(stderr, text);
  fputc('\n', stderr);
  if (hint) {
    fputs("  hint: ", stderr);
    print_escaped(stderr, hint);
    fputc('\n', stderr);
  }
}

void ambulo__cli_error(const char *code, const char *hint, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  message(code, hint, format, arguments);
  va_end(arguments);
}

int ambulo__cli_usage_error(const char *command, const char *hint, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  message("E_ARGUMENT", hint, format, arguments);
  va_end(arguments);
  if (command) {
    fprintf(stderr, "  see 'ambulo %s --help'\n", command);
  } else {
    fputs("  see 'ambulo --help'\n", stderr);
  }
  return ambulo_status_exit_code(AMBULO_E_ARGUMENT);
}

/* without memory, which may be what the message is about */
static void print_diagnostic(const ambulo_diagnostics *list, size_t index) {
  char text[16384];
  (void)ambulo_diagnostics_format(list, index, text, sizeof text);
  fprintf(stderr, "%s\n", text);
}

int ambulo__cli_diagnostics(const ambulo_diagnostics *diagnostics, ambulo_status status,
                            const char *subject) {
  return ambulo__cli_diagnostics_but(diagnostics, status, subject, NULL);
}

int ambulo__cli_diagnostics_but(const ambulo_diagnostics *diagnostics, ambulo_status status,
                                const char *subject, const char *known) {
  size_t count = ambulo_diagnostics_count(diagnostics);
  size_t errors = ambulo_diagnostics_error_count(diagnostics), shown = 0;
  for (size_t i = 0; i < count; i++) {
    const ambulo_diagnostic *d = ambulo_diagnostics_get(diagnostics, i);
    shown += d->severity == AMBULO_ERROR;
    if (!known || strcmp(d->message, known) != 0) print_diagnostic(diagnostics, i);
  }
  if (errors > shown) fprintf(stderr, "ambulo: ... and %zu more errors\n", errors - shown);
  if (status && errors == 0)
    ambulo__cli_error(ambulo_status_name(status), NULL, "%s: %s", subject,
                      ambulo_status_text(status));
  if (status == AMBULO_E_IO) ambulo__cli_shipped_hint(subject);
  return ambulo_status_exit_code(status);
}

/* a pipe whose reader has gone away, as `head` does when it has seen enough */
static int reader_is_gone(void) {
  struct pollfd out = {.fd = STDOUT_FILENO, .events = POLLOUT};
  return poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

int ambulo__cli_finish(int code) {
  errno = 0;
  int failed = ferror(stdout);
  failed |= fflush(stdout) != 0;
  if (failed && reader_is_gone()) return ambulo_status_exit_code(AMBULO_E_IO);
  failed |= close(STDOUT_FILENO) != 0;
  if (!failed) return code;
  ambulo__cli_error("E_IO", NULL, "standard output could not be written: %s",
                    errno ? strerror(errno) : "write failed earlier");
  return ambulo_status_exit_code(AMBULO_E_IO);
}

void ambulo__cli_guard_streams(void) {
  for (int descriptor = 0; descriptor <= 2; descriptor++) {
    if (fcntl(descriptor, F_GETFD) != -1) continue;
    /* open() takes the lowest free number: this one */
    int opened = open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    if (opened < 0) return;
  }
}
