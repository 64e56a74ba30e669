/* cli/output.c - messages on stderr, the certainty that stdout was written, Ctrl-C. */
#include "cli/output.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

enum { USUAL_LINE = 240 };

void ambulo__cli_format(char *buffer, size_t size, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  int length = vsnprintf(buffer, size, format, arguments);
  va_end(arguments);
  if (length < 0 && size > 0) buffer[0] = '\0';
}

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

int ambulo__cli_diagnostics_but(const ambulo_diagnostics *diagnostics, ambulo_status status,
                                const char *subject, const char *known) {
  if (!diagnostics && !status) status = AMBULO_E_MEMORY; /* warnings, if any, are lost */
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

int ambulo__cli_diagnostics(const ambulo_diagnostics *diagnostics, ambulo_status status,
                            const char *subject) {
  return ambulo__cli_diagnostics_but(diagnostics, status, subject, NULL);
}

/* ----------------------------------------------------------------- long commands */

/* all that a signal handler touches */
static volatile sig_atomic_t signals_seen = 0, last_signal = 0, fatal_signal = 0;
static struct timespec first_signal;

/* One key press can arrive twice (as `timeout` sends it, to the process and to its group): where
 * the next signal is fatal, repeats within half a second count as one. */
static void note_signal(int number) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (signals_seen == 0) first_signal = now;
  signals_seen = signals_seen + 1;
  last_signal = number;
  if (!fatal_signal || signals_seen == 1) return;
  double seconds = (double)(now.tv_sec - first_signal.tv_sec) +
                   1e-9 * (double)(now.tv_nsec - first_signal.tv_nsec);
  if (seconds < 0.5) return;
  signal(number, SIG_DFL);
  raise(number);
}

void ambulo__cli_catch_stops(int fatal) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  fatal_signal = fatal;
  action.sa_handler = note_signal;
  sigemptyset(&action.sa_mask);
  sigaddset(&action.sa_mask, SIGINT);
  sigaddset(&action.sa_mask, SIGTERM);
  sigaction(SIGINT, &action, NULL);
  sigaction(SIGTERM, &action, NULL);
}

int ambulo__cli_stops(void) {
  return (int)signals_seen;
}

int ambulo__cli_stop_signal(void) {
  return (int)last_signal;
}

int ambulo__cli_line_room(void) {
#ifdef TIOCGWINSZ
  struct winsize size;
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1) return size.ws_col - 1;
#endif
  return USUAL_LINE;
}
