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
  long parent = 0;
  int megabytes = 0;
  if (!told || sscanf(told, "%ld %d", &parent, &megabytes) != 2) return 1;
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
