/* cli/stop_signals.c - see stop_signals.h. */
#include "cli/stop_signals.h"

#include <signal.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { USUAL_LINE = 240 };

/* all that a signal handler touches */
static volatile sig_atomic_t signals_seen = 0, last_signal = 0;

static void note_signal(int number) {
  signals_seen = signals_seen + 1;
  last_signal = number;
}

void ambulo__cli_catch_stops(void) {
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = note_signal;
  sigemptyset(&action.sa_mask);
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
