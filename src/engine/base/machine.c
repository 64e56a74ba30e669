/* base/machine.c - see machine.h. Linux tells the free memory in files; elsewhere only a limit on
 * the address space is known. */
#include "base/machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

double ambulo__seconds_now(void) {
  struct timespec now = {0, 0};
  (void)clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int ambulo__read_numbers(const char *path, double *first, double *second) {
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

static double available(void) {
  double megabytes = 0.0;
  FILE *file = fopen("/proc/meminfo", "re");
  char line[160];
  while (file && fgets(line, sizeof line, file)) {
    static const char name[] = "MemAvailable:";
    if (strncmp(line, name, sizeof name - 1) == 0)
      megabytes = strtod(line + sizeof name - 1, NULL) / 1024.0;
  }
  if (file) (void)fclose(file);
  return megabytes;
}

/* the smaller of what is known and what a limit leaves, at least 1 */
static double least(double known, double left) {
  if (left < 1.0) left = 1.0;
  return known == 0.0 || left < known ? left : known;
}

double ambulo__free_megabytes(void) {
  double megabytes = available(), limit = 0.0, used = 0.0, pages = 0.0, none = 0.0;
  if (ambulo__read_numbers("/sys/fs/cgroup/memory.max", &limit, &none) >= 1 &&
      ambulo__read_numbers("/sys/fs/cgroup/memory.current", &used, &none) >= 1)
    megabytes = least(megabytes, (limit - used) / 1048576.0);
  struct rlimit space;
  if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY) {
    (void)ambulo__read_numbers("/proc/self/statm", &pages, &none);
    double taken = pages * (double)sysconf(_SC_PAGESIZE);
    megabytes = least(megabytes, ((double)space.rlim_cur - taken) / 1048576.0);
  }
  return megabytes;
}
