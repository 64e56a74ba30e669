/* cli/worker.c - see worker.h. No worker outlives a killed supervisor: the system is asked to
 * send SIGKILL when the parent ends (Linux), and one that is late finds another parent. */
#ifdef __linux__
#define _GNU_SOURCE
#include <sys/prctl.h>
#endif
#include "cli/worker.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

int ambulo__cli_become_worker(void) {
  const char *told = getenv("AMBULO_WORKER");
  if (!told) return 1;
  char *end = NULL, *last = NULL;
  long parent = strtol(told, &end, 10), megabytes = strtol(end, &last, 10);
  if (end == told || last == end) return 1;
#ifdef __linux__
  (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (megabytes > 0) {
    rlim_t bytes = (rlim_t)megabytes << 20;
    struct rlimit limit = {bytes, bytes};
    (void)setrlimit(RLIMIT_AS, &limit);
  }
  return (long)getppid() == parent;
}

int ambulo__cli_is_worker(void) {
  return getenv("AMBULO_WORKER") != NULL;
}
