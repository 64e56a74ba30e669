/* definitions/solution_multipliers.c - the multipliers in a solution.yaml.
 *
 *     multipliers:
 *       objective: 0.6509877              where they are from
 *       interval: 0.0104                  longest between two of its nodes, share of the duration
 *       rows:
 *         - name: [friction, right, slips]           family, subject, detail
 *           times: [0.0104, 0.0208]                  shares of the duration
 *           densities: [1.2, 0.7]                    multiplier over the time of the node, 1/s
 *
 * Rows without a force are left out. */
#include "ambulo/tools/load.h"
#include "formats/yaml_node.h"
#include "method/multipliers.h"
#include "problem/nlp.h"

#include <math.h>
#include <string.h>

enum { MAX_PERIODS = 100000 };

typedef struct reader {
  ambulo__yaml *document;
  ambulo_multipliers *multipliers;
  double *number; /* [count]: of one row */
  int count;
} reader;

static unsigned long long read_series(const ambulo__yaml_node *name) {
  const char *label[3] = {"", "", ""};
  if (ambulo__yaml_items(name) != 3) {
    (void)ambulo__yaml_error(name, AMBULO_E_SCHEMA, NULL,
                             "got %d texts; expected family, subject and detail",
                             ambulo__yaml_items(name));
    return 0;
  }
  for (int i = 0; i < 3; i++) label[i] = ambulo__yaml_text(ambulo__yaml_item(name, i));
  return ambulo__multiplier_series(label[0], label[1], label[2]);
}

/* `into` is the first of the row's places */
static void read_row(const reader *r, const ambulo__yaml_node *item, ambulo__multiplier *into) {
  const ambulo__yaml_node *times = ambulo__yaml_require(item, "times");
  const ambulo__yaml_node *densities = ambulo__yaml_require(item, "densities");
  const ambulo__yaml_node *name = ambulo__yaml_require(item, "name");
  ambulo__yaml_close(item);
  if (ambulo__yaml_finish(r->document)) return;
  int count = ambulo__yaml_items(times);
  unsigned long long series = read_series(name);
  if (!ambulo__yaml_numbers(times, count, r->number)) return;
  for (int i = 0; i < count; i++) into[i] = (ambulo__multiplier){series, r->number[i], 0.0};
  if (!ambulo__yaml_numbers(densities, count, r->number)) return;
  for (int i = 0; i < count; i++) into[i].density = r->number[i];
}

static ambulo_status read_rows(reader *r, const ambulo__yaml_node *node,
                               const ambulo_allocator *a) {
  double objective = ambulo__yaml_number(ambulo__yaml_require(node, "objective"), 0.0);
  double interval = ambulo__yaml_number_in(ambulo__yaml_require(node, "interval"), 0.0, 1.0, 0.0);
  const ambulo__yaml_node *rows = ambulo__yaml_require(node, "rows");
  ambulo__yaml_close(node);
  ambulo_status status = ambulo__yaml_finish(r->document);
  if (status) return status;
  int items = ambulo__yaml_items(rows), used = 0;
  for (int i = 0; i < items; i++)
    r->count += ambulo__yaml_items(ambulo__yaml_require(ambulo__yaml_item(rows, i), "times"));
  status = ambulo__yaml_finish(r->document);
  if (!status) status = ambulo__multipliers_allocate(r->count, a, &r->multipliers);
  if (status) return status;
  r->number = ambulo__alloc(a, (size_t)r->count + 1, sizeof *r->number);
  if (!r->number) return AMBULO_E_MEMORY;
  r->multipliers->objective = objective;
  r->multipliers->interval = interval;
  for (int i = 0; i < items; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(rows, i);
    read_row(r, item, r->multipliers->row + used);
    used += ambulo__yaml_items(ambulo__yaml_get(item, "times"));
  }
  ambulo__multipliers_sort(r->multipliers);
  return ambulo__yaml_finish(r->document);
}

static ambulo_status read_document(reader *r, const ambulo_problem *problem, ambulo_ends ends,
                                   const ambulo_allocator *a) {
  static const char *const kinds[] = {"solution"};
  const ambulo__yaml_node *root = ambulo__yaml_root(r->document);
  if (ambulo__yaml_file_kind(root, kinds, 1) < 0) return ambulo__yaml_finish(r->document);
  double duration = ambulo__yaml_number_in(ambulo__yaml_require(root, "duration"), 1e-9, 1e9, 1.0);
  const ambulo__yaml_node *node = ambulo__yaml_get(root, "multipliers");
  ambulo_status status = ambulo__yaml_finish(r->document);
  if (status || !node) return status;
  status = read_rows(r, node, a);
  if (status || ends == AMBULO_ENDS_FREE) return status;
  double periods = round(ambulo_problem_duration(problem) / duration);
  r->multipliers->periods = (int)fmin(MAX_PERIODS, fmax(1.0, periods));
  r->multipliers->mirrored = ends == AMBULO_ENDS_MIRRORED;
  return AMBULO_OK;
}

ambulo_status ambulo_solution_multipliers(const char *path, const ambulo_problem *problem,
                                          ambulo_ends ends, const ambulo_allocator *allocator,
                                          ambulo_diagnostics *diagnostics,
                                          ambulo_multipliers **multipliers) {
  if (!path || !problem || !multipliers) return AMBULO_E_ARGUMENT;
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  reader r = {.count = 0};
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = ambulo__yaml_load(path, &a, diagnostics, &r.document);
  if (status) return status;
  status = read_document(&r, problem, ends, &a);
  ambulo__free(&a, r.number);
  ambulo__yaml_free(r.document);
  if (status) {
    ambulo_multipliers_free(r.multipliers);
    return ambulo__conclude(diagnostics, errors, status, path);
  }
  *multipliers = r.multipliers;
  return AMBULO_OK;
}
