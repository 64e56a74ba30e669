/* study/batch_machine.c - see machine.h. Linux tells all of it in files; elsewhere only the number
 * of processors is known. */
#ifdef __linux__
#define _GNU_SOURCE /* sched_getaffinity */
#endif
#include "study/batch_machine.h"
#include "ambulo/tools/batch.h"
#include "base/machine.h"

#include <unistd.h>
#ifdef __linux__
#include <sched.h>
#endif

enum { TYPICAL_MEGABYTES = 150 };

int ambulo__usable_processors(void) {
  long online = sysconf(_SC_NPROCESSORS_ONLN);
  int count = online > 0 ? (int)online : 1;
#ifdef __linux__
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) > 0) count = CPU_COUNT(&set);
#endif
  double quota = 0.0, period = 0.0;
  if (ambulo__read_numbers("/sys/fs/cgroup/cpu.max", &quota, &period) == 2 && period > 0.0) {
    int granted = (int)(quota / period + 0.5);
    if (granted < 1) granted = 1;
    if (granted < count) count = granted;
  }
  return count;
}

int ambulo__worker_count(int wanted, int megabytes) {
  int count = wanted > 0 ? wanted : ambulo__usable_processors();
  double fit = ambulo__free_megabytes() / (megabytes > 0 ? megabytes : TYPICAL_MEGABYTES);
  if (fit > 0.0 && fit < count) count = fit < 1.0 ? 1 : (int)fit;
  return count;
}

int ambulo_batch_workers(int workers, int megabytes) {
  return ambulo__worker_count(workers, megabytes);
}
