/* cli/blas.c - see blas.h.
 *
 * OpenBLAS starts a thread per core when it is loaded; the matrices here are too small to gain
 * from more than one. Its buffers, one a thread, are mapped at the first call, and when that fails
 * it tries again for ever. So where the address space is limited the program starts itself anew
 * with the variable that OpenBLAS reads at load time, and claims the one buffer early. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "cli/blas.h"

#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include "cli/output.h"

/* Only OpenBLAS has it; with another BLAS the symbol stays undefined and its address NULL. */
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
