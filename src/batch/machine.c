/* batch/machine.c - see machine.h. Linux tells all of it in files; elsewhere only the number of
 * processors is known. */
#ifdef __linux__
#define _GNU_SOURCE /* sched_getaffinity */
#endif
#include "batch/machine.h"
#include "ambulo/batch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#ifdef __linux__
#include <sched.h>
#endif

enum { TYPICAL_MEGABYTES = 150 };

/* the first numbers of a small file; number of them */
static int read_numbers(const char *path, double *first, double *second) {
  FILE *file = fopen(path, "re");
  if (!file) return 0;
  char line[160] = "", *end = line, *last = line;
  char *read = fgets(line, sizeof line, file);
  (void)fclose(file);
  if (!read) return 0;
  *first = strtod(line, &end);
  if (end == line) return 0;
  *second = strtod(end, &last);
  return last == end ? 1 : 2;
}

int ambulo__usable_processors(void) {
  long online = sysconf(_SC_NPROCESSORS_ONLN);
  int count = online > 0 ? (int)online : 1;
#ifdef __linux__
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) > 0) count = CPU_COUNT(&set);
#endif
  double quota = 0.0, period = 0.0;
  if (read_numbers("/sys/fs/cgroup/cpu.max", &quota, &period) == 2 && period > 0.0) {
    int granted = (int)(quota / period + 0.5);
    if (granted < 1) granted = 1;
    if (granted < count) count = granted;
  }
  return count;
}

double ambulo__free_megabytes(void) {
  double free_now = 0.0, limit = 0.0, used = 0.0, none = 0.0;
  FILE *file = fopen("/proc/meminfo", "re");
  char line[160];
  while (file && fgets(line, sizeof line, file)) {
    static const char name[] = "MemAvailable:";
    if (strncmp(line, name, sizeof name - 1) == 0)
      free_now = strtod(line + sizeof name - 1, NULL) / 1024.0;
  }
  if (file) (void)fclose(file);
  if (read_numbers("/sys/fs/cgroup/memory.max", &limit, &none) >= 1 &&
      read_numbers("/sys/fs/cgroup/memory.current", &used, &none) >= 1) {
    double left = (limit - used) / 1048576.0;
    if (left < free_now) free_now = left > 1.0 ? left : 1.0;
  }
  return free_now;
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
