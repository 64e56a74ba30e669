/* cli/program.c - see program.h. */
#define _GNU_SOURCE /* readlink, MAP_ANONYMOUS, prctl */
#include "cli/program.h"

#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#ifdef __APPLE__
#include <mach-o/dyld.h>
#endif

#include "cli/output.h"

/* ------------------------------------------------------------------- its own path */

/* Linux has a link in /proc, macOS a function of the loader (untested), others may have the link
 * under another name. */
#ifdef __APPLE__
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

/* ------------------------------------------------------------------- as a worker */

/* No worker outlives a killed supervisor: the system is asked to send SIGKILL when the parent ends
 * (Linux), and one that is late finds another parent. */
int ambulo__cli_become_worker(void) {
  const char *variable = getenv("AMBULO_WORKER");
  if (!variable) return 1;
  char *end = NULL, *last = NULL;
  long parent = strtol(variable, &end, 10), megabytes = strtol(end, &last, 10);
  if (end == variable || last == end) return 1;
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

int ambulo__cli_worker_fits(void) {
  const char *variable = getenv("AMBULO_WORKER"), *engine = variable ? strchr(variable, ' ') : NULL;
  engine = engine ? strchr(engine + 1, ' ') : NULL;
  if (!engine) return 1;
  ambulo_versions own;
  ambulo_versions_get(&own);
  if (strcmp(engine + 1, own.engine) == 0) return 1;
  ambulo__cli_error("E_IO", "name the program of the same build",
                    "this program has the engine %s; expected that of the batch, %.16s", own.engine,
                    engine + 1);
  return 0;
}

/* ---------------------------------------------------------------------- OpenBLAS */

/* OpenBLAS starts a thread per core when it is loaded; the matrices here are too small to gain
 * from more than one. Its buffers, one a thread, are mapped at the first call, and when that fails
 * it tries again for ever. So where the address space is limited the program starts itself anew
 * with the variable that OpenBLAS reads at load time, and claims the one buffer early.
 *
 * Only OpenBLAS has this function; with another BLAS the symbol stays undefined and its address
 * NULL. */
extern void openblas_set_num_threads(int threads) __attribute__((weak));
extern void dpotrf_(const char *uplo, const int *n, double *a, const int *lda, int *info);

/* of the builds for x86-64 with run-time dispatch, and some room for everything else */
static const size_t buffer_bytes = (size_t)(128 + 8) << 20;

/* megabytes that the address space may have; 0: no limit */
static unsigned long address_limit(void) {
  struct rlimit limit;
  if (getrlimit(RLIMIT_AS, &limit) || limit.rlim_cur == RLIM_INFINITY) return 0;
  return (unsigned long)((limit.rlim_cur - 1) >> 20) + 1;
}

void ambulo__cli_single_threaded_blas(char **argv) {
  if (!openblas_set_num_threads || getenv("OPENBLAS_NUM_THREADS")) return;
  if (address_limit() && !setenv("OPENBLAS_NUM_THREADS", "1", 1)) execv("/proc/self/exe", argv);
  /* no limit, or no /proc */
  openblas_set_num_threads(1);
}

int ambulo__cli_blas_fits(void) {
  unsigned long limit = openblas_set_num_threads ? address_limit() : 0;
  if (!limit) return 1;
  void *room = mmap(NULL, buffer_bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) {
    ambulo__cli_error("E_MEMORY", "raise 'ulimit -v', or --case-memory",
                      "the address space is limited to %lu MB (of which OpenBLAS takes 128 MB); "
                      "expected at least 220 MB",
                      limit);
    return 0;
  }
  (void)munmap(room, buffer_bytes);
  double one = 1.0;
  int size = 1, info = 0;
  dpotrf_("L", &size, &one, &size, &info);
  return 1;
}
