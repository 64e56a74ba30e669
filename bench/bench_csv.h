/* bench/bench_csv.h - the common format of results, and the comparison with the last ones.
 *
 * One file per layer: bench/results/<machine>_<instruction set>/<layer>.csv with the columns
 * quantity, unit, median. The machine's name is made of what the processor says it is. Each row
 * is printed with its change since the file was last written. AMBULO_BENCH_RESULTS names
 * another folder than bench/results; committing the files is left to a person, who knows
 * whether the machine was quiet. */
#ifndef AMBULO_BENCH_CSV_H
#define AMBULO_BENCH_CSV_H

#include "bench.h"

#include <ctype.h>
#include <sys/stat.h>
#include <sys/utsname.h>

enum { bench_most_rows = 256, bench_key = 80 };

typedef struct bench_row {
  char quantity[bench_key];
  double value;
} bench_row;

typedef struct bench_table {
  char path[512];
  FILE *out;
  bench_row last[bench_most_rows]; /* what the file said before */
  int last_count;
} bench_table;

/* Lower-case letters and digits of the text, anything else as one underscore. */
static inline void bench_append_name(char *name, size_t size, const char *text) {
  size_t length = strlen(name);
  for (; *text && length + 2 < size; text++) {
    if (isalnum((unsigned char)*text)) {
      name[length++] = (char)tolower((unsigned char)*text);
    } else if (length && name[length - 1] != '_') {
      name[length++] = '_';
    }
  }
  while (length && name[length - 1] == '_') length--;
  name[length] = '\0';
}

/* Name, family and model number of the processor, as far as the system tells. */
static inline void bench_machine(char *name, size_t size) {
  static const char *const keys[] = {"model name", "cpu family", "model\t"};
  char line[256];
  name[0] = '\0';
  FILE *info = fopen("/proc/cpuinfo", "r");
  for (int key = 0; info && key < 3; key++) {
    rewind(info);
    while (fgets(line, sizeof line, info)) {
      const char *colon = strchr(line, ':');
      if (!colon || strncmp(line, keys[key], strlen(keys[key])) != 0) continue;
      if (name[0] && strlen(name) + 2 < size) strcat(name, "_");
      bench_append_name(name, size, colon + 1);
      break;
    }
  }
  if (info) fclose(info);
  struct utsname system;
  if (!name[0] && uname(&system) >= 0) {
    bench_append_name(name, size, system.sysname);
    if (strlen(name) + 2 < size) strcat(name, "_");
    bench_append_name(name, size, system.machine);
  }
}

static inline void bench_read_last(bench_table *table) {
  char line[256];
  FILE *file = fopen(table->path, "r");
  if (!file) return;
  while (table->last_count < bench_most_rows && fgets(line, sizeof line, file)) {
    bench_row *row = &table->last[table->last_count];
    char unit[32];
    if (sscanf(line, "%79[^,],%31[^,],%lf", row->quantity, unit, &row->value) == 3) {
      table->last_count++;
    }
  }
  fclose(file);
}

/* Without a file to write, rows are only printed. */
static inline void bench_open(bench_table *table, const char *instruction_set, const char *layer) {
  const char *root = getenv("AMBULO_BENCH_RESULTS");
  char machine[128], folder[400];
  if (!root) root = "bench/results";
  memset(table, 0, sizeof *table);
  bench_machine(machine, sizeof machine);
  (void)mkdir(root, 0777);
  (void)snprintf(folder, sizeof folder, "%.200s/%s_%.20s", root, machine, instruction_set);
  (void)mkdir(folder, 0777);
  (void)snprintf(table->path, sizeof table->path, "%s/%s.csv", folder, layer);
  bench_read_last(table);
  table->out = fopen(table->path, "w");
  if (table->out) {
    (void)fprintf(table->out, "quantity,unit,value\n");
  } else {
    (void)fprintf(stderr, "bench: cannot write %s; results are only printed\n", table->path);
  }
  printf("\n[%s] %s\n", layer, table->path);
}

static inline void bench_put(bench_table *table, const char *quantity, const char *unit,
                             double value) {
  char change[32] = "new";
  for (int i = 0; i < table->last_count; i++) {
    if (strcmp(table->last[i].quantity, quantity) != 0 || table->last[i].value == 0) continue;
    (void)snprintf(change, sizeof change, "%+.1f %%",
                   100 * (value - table->last[i].value) / fabs(table->last[i].value));
  }
  printf("%-60s %12.5g %-16s %10s\n", quantity, value, unit, change);
  if (table->out) (void)fprintf(table->out, "%s,%s,%.6g\n", quantity, unit, value);
}

static inline void bench_close(bench_table *table) {
  if (table->out) fclose(table->out);
  table->out = NULL;
}

#endif
