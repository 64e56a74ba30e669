/* people/compare_cycle.c - strikes, body mass, and curves over percents (compare.h). */
#include "people/compare.h"

#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "formats/atomic_file.h"
#include "formats/yaml_node.h"

static const char *const feet[] = {"left", "right"};

/* ------------------------------------------------------------- what is read */

static char *join(const ambulo_allocator *a, const char *directory, const char *name) {
  size_t length = strlen(directory);
  char *path = ambulo__alloc(a, length + strlen(name) + 2, 1);
  if (!path) return NULL;
  memcpy(path, directory, length);
  if (length > 0 && directory[length - 1] != '/') path[length++] = '/';
  memcpy(path + length, name, strlen(name) + 1);
  return path;
}

static ambulo_status read_times(ambulo__cycle *c) {
  int column = ambulo__sheet_find(&c->sheet, 0, "time");
  c->rows = c->sheet.line_count - 1;
  if (column < 0)
    return ambulo__error(c->diagnostics, AMBULO_E_SCHEMA, ambulo__sheet_place(&c->sheet, 0, 0),
                         NULL, "no column 'time'; expected the motion of a result folder");
  if (c->rows < 5)
    return ambulo__error(c->diagnostics, AMBULO_E_SCHEMA, ambulo__sheet_place(&c->sheet, 0, 0),
                         NULL, "%d times; expected at least 5", c->rows);
  c->time = ambulo__alloc(&c->allocator, (size_t)c->rows, sizeof *c->time);
  c->scratch = ambulo__alloc(&c->allocator, 4 * (size_t)c->rows, sizeof *c->scratch);
  if (!c->time || !c->scratch) return AMBULO_E_MEMORY;
  for (int k = 0; k < c->rows; k++) {
    ambulo_status status =
        ambulo__sheet_number(&c->sheet, k + 1, column, "the time", c->diagnostics, &c->time[k]);
    if (status) return status;
    if (k > 0 && c->time[k] <= c->time[k - 1])
      return ambulo__error(c->diagnostics, AMBULO_E_SCHEMA,
                           ambulo__sheet_place(&c->sheet, k + 1, column), NULL,
                           "time %g after %g; expected rising times", c->time[k], c->time[k - 1]);
  }
  return AMBULO_OK;
}

static void read_body(ambulo__cycle *c, const ambulo__yaml_node *body) {
  ambulo__cycle_take_joints(c, ambulo__yaml_get(body, "joints"));
  c->mass = ambulo__yaml_number(ambulo__yaml_get(body, "mass"), 0.0);
  c->gravity = ambulo__yaml_number(ambulo__yaml_get(body, "gravity"), c->gravity);
  (void)ambulo__yaml_numbers(ambulo__yaml_get(body, "up"), 3, c->up);
  (void)ambulo__yaml_numbers(ambulo__yaml_get(body, "forward"), 3, c->forward);
}

/* 0, 1, or -1 for a foot of another name */
static int side_of(const ambulo__yaml_node *item) {
  const ambulo__yaml_node *foot = ambulo__yaml_get(item, "foot");
  const char *name = ambulo__yaml_text(foot);
  for (int side = 0; side < 2; side++) {
    if (strcmp(name, feet[side]) == 0) return side;
  }
  return -1;
}

static int is_within(const ambulo__cycle *c, double time) {
  double first = c->time[0], last = c->time[c->rows - 1], slack = 1e-6 * (last - first);
  return time >= first - slack && time <= last + slack;
}

/* s; of the motion beside the summary */
static double read_strike(const ambulo__cycle *c, const ambulo__yaml_node *node) {
  double time = ambulo__yaml_number(node, c->time[0]);
  if (!is_within(c, time))
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, "summary.json and motion.csv of one result",
                             "a strike at %g s; the motion lasts from %g to %g s", time, c->time[0],
                             c->time[c->rows - 1]);
  return time;
}

/* first strike of each side, and the way to its next one; have[side] counts strikes */
static void read_strikes(ambulo__cycle *c, const ambulo__yaml_node *strikes, int have[2]) {
  double first[2] = {INFINITY, INFINITY}, second[2] = {INFINITY, INFINITY};
  for (int i = 0; i < ambulo__yaml_items(strikes); i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(strikes, i);
    int side = side_of(item);
    if (side < 0) continue;
    const ambulo__yaml_node *when = ambulo__yaml_get(item, "time");
    if (!when) (void)ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL, "a strike without 'time'");
    double time = when ? read_strike(c, when) : c->time[0];
    second[side] = fmin(second[side], fmax(time, first[side]));
    first[side] = fmin(first[side], time);
    have[side]++;
  }
  for (int side = 0; side < 2; side++) {
    if (have[side] > 0) c->strike[side] = first[side];
    if (have[side] > 1 && second[side] > first[side]) c->length[side] = second[side] - first[side];
  }
}

/* of one step, of which a mirrored motion.csv holds two */
static void check_duration(const ambulo__cycle *c, const ambulo__yaml_node *node) {
  if (!node) return;
  double told = ambulo__yaml_number(node, 0.0), lasts = c->time[c->rows - 1] - c->time[0];
  if (fabs(lasts - told) <= 1e-6 * lasts || fabs(lasts - 2.0 * told) <= 1e-6 * lasts) return;
  ambulo__warning(c->diagnostics, ambulo__yaml_place(node),
                  "summary.json and motion.csv of one result belong together",
                  "a duration of %g s beside a motion of %g s", told, lasts);
}

static ambulo_status read_summary(ambulo__cycle *c, int have[2]) {
  ambulo__yaml *document = NULL;
  ambulo_status status =
      ambulo__yaml_load(c->summary_path, &c->allocator, c->diagnostics, &document);
  if (status) return status;
  const ambulo__yaml_node *root = ambulo__yaml_root(document);
  const ambulo__yaml_node *verdict = ambulo__yaml_get(root, "verdict");
  const char *word = ambulo__yaml_text(verdict);
  if (word[0] && strcmp(word, "optimal") != 0 && strcmp(word, "feasible") != 0)
    ambulo__warning(c->diagnostics, ambulo__yaml_place(verdict), NULL,
                    "the result is no solution (verdict %s); its curves predict nothing", word);
  check_duration(c, ambulo__yaml_get(root, "duration"));
  const ambulo__yaml_node *body = ambulo__yaml_get(root, "body");
  if (body) read_body(c, body);
  const ambulo__yaml_node *strikes = ambulo__yaml_get(root, "strikes");
  if (strikes) read_strikes(c, strikes, have);
  c->told_strikes = have[0] + have[1];
  c->told_gait = ambulo__yaml_get(root, "gait") != NULL;
  status = ambulo__yaml_finish(document);
  ambulo__yaml_free(document);
  return status;
}

static int is_file(const char *path) {
  struct stat info;
  return stat(path, &info) == 0 && S_ISREG(info.st_mode);
}

/* of another motion, it is left alone */
static ambulo_status read_muscles(ambulo__cycle *c, const char *directory) {
  char *path = join(&c->allocator, directory, "muscles.csv");
  ambulo_status status = path ? AMBULO_OK : AMBULO_E_MEMORY;
  if (path && is_file(path)) {
    status = ambulo__sheet_read(path, &c->allocator, c->diagnostics, &c->muscles);
    if (!status && c->muscles.line_count != c->sheet.line_count) {
      ambulo__warning(c->diagnostics, (ambulo__place){.file = path}, NULL,
                      "%d times, motion.csv has %d; muscles are left out",
                      c->muscles.line_count - 1, c->rows);
      ambulo__sheet_free(&c->muscles);
      memset(&c->muscles, 0, sizeof c->muscles);
    }
  }
  ambulo__free(&c->allocator, path);
  return status;
}

/* a folder without a motion */
static ambulo_status refuse_other_folder(const ambulo__cycle *c, const char *directory) {
  struct stat info;
  ambulo__place place = {.file = directory};
  if (stat(directory, &info) != 0) return ambulo__io_error(c->diagnostics, directory, "open");
  if (!S_ISDIR(info.st_mode) || stat(c->motion_path, &info) == 0) return AMBULO_OK;
  return ambulo__error(c->diagnostics, AMBULO_E_IO, place,
                       "ambulo solve writes result folders, with motion.csv and summary.json",
                       "the folder has no motion.csv; expected a result folder, or a file with a "
                       "person's own motion");
}

static ambulo_status refuse_options_of_a_subject(const char *directory,
                                                 const ambulo_compare_options *options,
                                                 ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = directory};
  if (!options->forces && !options->force_columns && !options->strikes) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, place, NULL,
                       "forces and strikes by foot are those of a person's own motion; expected a "
                       "file, or a result folder alone");
}

/* -------------------------------------------------------------- foot strikes */

/* the last time without load before the foot takes load, if there is a force column */
static ambulo_status find_onset(ambulo__cycle *c, ambulo__cycle_side side, int have[2]) {
  double *force = c->scratch, peak = 0.0;
  int found = 0;
  ambulo_status status = ambulo__cycle_samples(c, "grf.{foot}.up", 0, side, force, &found);
  if (status || !found) return status;
  for (int k = 0; k < c->rows; k++) peak = fmax(peak, force[k]);
  for (int k = 0; k + 1 < c->rows && !have[side]; k++) {
    if (force[k] > 1e-3 * peak || force[k + 1] <= 1e-3 * peak) continue;
    c->strike[side] = c->time[k];
    have[side] = 1;
  }
  return AMBULO_OK;
}

static ambulo_status find_strikes(ambulo__cycle *c, const ambulo_compare_options *options,
                                  int have[2]) {
  double whole = c->time[c->rows - 1] - c->time[0];
  int first = options->foot && strcmp(options->foot, feet[AMBULO__CYCLE_RIGHT]) == 0;
  for (int side = 0; side < 2; side++) {
    if (c->length[side] == 0.0) c->length[side] = whole;
  }
  if (isfinite(options->strike)) {
    ambulo__place place = {.file = c->motion_path};
    if (!is_within(c, options->strike))
      return ambulo__error(c->diagnostics, AMBULO_E_SCHEMA, place, "--strike S",
                           "a strike at %g s; the motion lasts from %g to %g s", options->strike,
                           c->time[0], c->time[c->rows - 1]);
    c->strike[first] = options->strike;
    c->strike[1 - first] = options->strike + 0.5 * c->length[first];
    return AMBULO_OK;
  }
  for (int side = 0; side < 2; side++) {
    ambulo_status status = have[side] ? AMBULO_OK : find_onset(c, (ambulo__cycle_side)side, have);
    if (status) return status;
  }
  if (!have[0] && !have[1]) {
    c->strike[0] = c->time[0];
    have[0] = 1;
  }
  if (!have[0]) c->strike[0] = c->strike[1] + 0.5 * c->length[1];
  if (!have[1]) c->strike[1] = c->strike[0] + 0.5 * c->length[0];
  return AMBULO_OK;
}

ambulo_status ambulo__cycle_open_subject(const char *file, const ambulo_compare_options *options,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics, ambulo__cycle *cycle) {
  ambulo__cycle c = {.allocator = ambulo__allocator_or_default(allocator),
                     .diagnostics = diagnostics,
                     .gravity = 9.81,
                     .mass = options->mass,
                     .up = {0.0, 1.0, 0.0},
                     .told_gait = 1};
  c.subject = ambulo__alloc(&c.allocator, 1, sizeof *c.subject);
  c.motion_path = ambulo__strdup(&c.allocator, file);
  c.summary_path = ambulo__strdup(&c.allocator, file);
  ambulo_status status = c.subject && c.motion_path && c.summary_path ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__subject_open(file, options, &c.allocator, diagnostics, c.subject);
  if (!status) {
    c.rows = c.subject->table->rows;
    c.forward[0] = c.subject->backward ? -1.0 : 1.0;
    c.told_strikes = c.subject->count[0] + c.subject->count[1];
    c.time = ambulo__alloc(&c.allocator, (size_t)c.rows, sizeof *c.time);
    c.scratch = ambulo__alloc(&c.allocator, 4 * (size_t)c.rows, sizeof *c.scratch);
    if (!c.time || !c.scratch) status = AMBULO_E_MEMORY;
  }
  if (status) {
    ambulo__cycle_close(&c);
    return status;
  }
  memcpy(c.time, c.subject->table->time, (size_t)c.rows * sizeof *c.time);
  *cycle = c;
  return AMBULO_OK;
}

ambulo_status ambulo__cycle_open(const char *directory, const ambulo_compare_options *options,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo__cycle *cycle) {
  ambulo__cycle c = {.allocator = ambulo__allocator_or_default(allocator),
                     .diagnostics = diagnostics,
                     .gravity = 9.81,
                     .up = {0.0, 1.0, 0.0},
                     .forward = {1.0, 0.0, 0.0}};
  int have[2] = {0, 0};
  ambulo_status status = ambulo__expect_path(directory, "result folder", diagnostics);
  if (status) return status;
  if (is_file(directory))
    return ambulo__cycle_open_subject(directory, options, allocator, diagnostics, cycle);
  status = refuse_options_of_a_subject(directory, options, diagnostics);
  if (status) return status;
  c.motion_path = join(&c.allocator, directory, "motion.csv");
  c.summary_path = join(&c.allocator, directory, "summary.json");
  status = c.motion_path && c.summary_path ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = refuse_other_folder(&c, directory);
  if (!status) status = ambulo__sheet_read(c.motion_path, &c.allocator, diagnostics, &c.sheet);
  if (!status) status = read_times(&c);
  if (!status) status = read_muscles(&c, directory);
  if (!status) status = read_summary(&c, have);
  if (!status) status = find_strikes(&c, options, have);
  if (!status && options->mass > 0.0) c.mass = options->mass;
  if (status) {
    ambulo__cycle_close(&c);
  } else {
    *cycle = c;
  }
  return status;
}

void ambulo__cycle_close(ambulo__cycle *c) {
  if (c->subject) ambulo__subject_free(c->subject);
  ambulo__free(&c->allocator, c->subject);
  ambulo__sheet_free(&c->sheet);
  ambulo__sheet_free(&c->muscles);
  ambulo__free(&c->allocator, c->motion_path);
  ambulo__free(&c->allocator, c->summary_path);
  ambulo__free(&c->allocator, c->time);
  ambulo__free(&c->allocator, c->scratch);
}

/* ------------------------------------------------------------- interpolation */

/* slope at t[k] of the parabola through the samples k-1, k, k+1; of a result, whose curves are
 * periodic, also at the ends, where those of a person's own motion go on straight */
static void fill_slopes(const ambulo__cycle *c, const double *y, double *slope) {
  int n = c->rows - 1; /* the last sample is the first of the next cycle */
  for (int k = 0; k <= n; k++) {
    int last = k == n ? 0 : k, before = k == 0 ? n - 1 : k - 1;
    if (c->subject && k == n) last = n - 1;
    if (c->subject && k == 0) before = 0;
    double left = c->time[before + 1] - c->time[before], right = c->time[last + 1] - c->time[last];
    double rise_left = (y[before + 1] - y[before]) / left;
    double rise_right = (y[last + 1] - y[last]) / right;
    slope[k] = (right * rise_left + left * rise_right) / (left + right);
  }
}

static double interpolate(const ambulo__cycle *c, const double *y, const double *slope, double t) {
  int low = 0, high = c->rows - 1;
  while (high - low > 1) {
    int middle = low + (high - low) / 2;
    if (c->time[middle] <= t) {
      low = middle;
    } else {
      high = middle;
    }
  }
  double h = c->time[high] - c->time[low], s = (t - c->time[low]) / h;
  double s2 = s * s, s3 = s2 * s;
  return (2.0 * s3 - 3.0 * s2 + 1.0) * y[low] + (s3 - 2.0 * s2 + s) * h * slope[low] +
         (3.0 * s2 - 2.0 * s3) * y[high] + (s3 - s2) * h * slope[high];
}

static void warn_if_open(ambulo__cycle *c, const double *y, const char *curve) {
  double least = y[0], most = y[0];
  for (int k = 0; k < c->rows; k++) {
    least = fmin(least, y[k]);
    most = fmax(most, y[k]);
  }
  if (c->warned_open || fabs(y[c->rows - 1] - y[0]) <= 0.05 * (most - least)) return;
  ambulo__place place = {.file = c->motion_path};
  ambulo__warning(c->diagnostics, place, NULL,
                  "'%s' ends at %.4g after it began at %.4g; a whole stride is expected", curve,
                  y[c->rows - 1], y[0]);
  c->warned_open = 1;
}

/* one stride from `strike` on: adds values / strides, and their squares */
static void add_stride(const ambulo__cycle *c, const double *y, const double *slope, double factor,
                       double strike, double length, const double *percents, int count, int strides,
                       double *values, double *squares) {
  double start = c->time[0], whole = c->time[c->rows - 1] - start;
  for (int i = 0; i < count; i++) {
    double t = strike + 0.01 * percents[i] * length - start;
    if (!c->subject) t -= whole * floor(t / whole);
    double value = factor * interpolate(c, y, slope, start + t);
    values[i] += value / (double)strides;
    if (squares) squares[i] += value * value / (double)strides;
  }
}

/* strides of a person's own motion that count for a unit */
static int count_strides(const ambulo__cycle *c, ambulo__cycle_side side, int is_angle) {
  int count = 0;
  if (!c->subject) return 1;
  for (int i = 0; i + 1 < c->subject->count[side]; i++)
    count += is_angle || c->subject->loaded[side][i];
  return count;
}

ambulo_status ambulo__cycle_spread(ambulo__cycle *c, const ambulo__map_entry *entry,
                                   ambulo__cycle_side side, const double *percents, int count,
                                   double *values, double *squares, int *strides) {
  double *y = c->scratch + c->rows, *slope = y + c->rows;
  int found = 0, is_angle = entry->unit == AMBULO__UNIT_ANGLE;
  int by_mass = !is_angle && entry->unit != AMBULO__UNIT_NONE;
  *strides = 0;
  ambulo_status status = ambulo__cycle_samples(c, entry->result, entry->by_body, side, y, &found);
  if (status || !found || (by_mass && !(c->mass > 0.0))) return status;
  if (!c->subject) warn_if_open(c, y, entry->curve);
  double factor = entry->factor * (is_angle ? 57.295779513082321 : by_mass ? 1.0 / c->mass : 1.0);
  if (entry->unit == AMBULO__UNIT_WEIGHT) factor /= c->gravity;
  if (entry->opposite && side == AMBULO__CYCLE_RIGHT) factor = -factor;
  int n = *strides = count_strides(c, side, is_angle);
  if (n == 0) return AMBULO_OK;
  memset(values, 0, (size_t)count * sizeof *values);
  if (squares) memset(squares, 0, (size_t)count * sizeof *squares);
  fill_slopes(c, y, slope);
  if (!c->subject)
    add_stride(c, y, slope, factor, c->strike[side] + entry->lag, c->length[side], percents, count,
               n, values, squares);
  for (int i = 0; c->subject && i + 1 < c->subject->count[side]; i++) {
    const double *t = c->subject->strikes[side] + i;
    if (is_angle || c->subject->loaded[side][i])
      add_stride(c, y, slope, factor, t[0] + entry->lag, t[1] - t[0], percents, count, n, values,
                 squares);
  }
  return AMBULO_OK;
}
