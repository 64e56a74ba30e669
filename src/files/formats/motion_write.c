/* formats/motion_write.c - motion.csv: one line a time, columns named by quantity and coordinate;
 * and motion.sto, OpenSim's storage form. */
#include "formats/motion_write.h"

#include "formats/atomic_file.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

/* without the dust that sums of many parts leave */
static void append_rounded(ambulo__text_buffer *text, double value) {
  ambulo__text_append_number(text, round(1e9 * value) / 1e9);
}

static void comment(const ambulo__motion_table *table, ambulo__text_buffer *text) {
  ambulo__text_append(text, AMBULO__OWN_MARK " motion: mass ");
  append_rounded(text, table->model->mass);
  ambulo__text_append(text, " kg, gravity");
  for (int i = 0; i < 3; i++) {
    ambulo__text_append_char(text, ' ');
    append_rounded(text, table->model->gravity[i]);
  }
  ambulo__text_append(text, " m/s^2; SI units and radians: time s; q rad or m, qd per s, qdd per "
                            "s^2; tau N m or N; zmp m, world axes");
  if (table->feet || table->patches)
    ambulo__text_append(text, "; grf N, cop m, world axes; free_moment N m about the normal; "
                              "moment N m about the origin");
  if (table->devices) ambulo__text_append(text, "; device N m or N, rad or m, W");
  if (table->holds)
    ambulo__text_append(text, "; held N, N m about the hand's point, world axes, W");
  if (table->wrench) ambulo__text_append(text, "; wrench N, N m about the origin, world axes");
  if (table->residual)
    ambulo__text_append(text, "; residual N, N m about the centre of mass, world axes");
  if (table->power) ambulo__text_append(text, "; power W");
  ambulo__text_append_char(text, '\n');
}

/* Where columns go: as names (row -1), or as the numbers of one row. Names and numbers pass through
 * the same calls, so that they cannot differ in their order. */
typedef struct columns {
  ambulo__text_buffer *text;
  int row;
} columns;

/* one column, or three with the endings .x, .y, .z; `values` of row 0, `stride` from row to row */
static void put(const columns *to, const double *values, size_t stride, int width,
                const char *format, ...) __attribute__((format(printf, 5, 6)));
static void put(const columns *to, const double *values, size_t stride, int width,
                const char *format, ...) {
  char name[256];
  va_list arguments;
  if (to->row >= 0) {
    for (int i = 0; i < width; i++) {
      ambulo__text_append_char(to->text, ',');
      ambulo__text_append_number(to->text, values[(size_t)to->row * stride + (size_t)i]);
    }
    return;
  }
  va_start(arguments, format);
  (void)vsnprintf(name, sizeof name, format, arguments);
  va_end(arguments);
  for (int i = 0; i < width; i++)
    ambulo__text_append_format(to->text, width == 1 ? ",%s" : ",%s.%c", name, "xyz"[i]);
}

static void put_coordinates(const columns *to, const ambulo_model *model, const double *values,
                            const char *quantity) {
  int d = model->coordinate_count;
  for (int i = 0; i < d; i++)
    put(to, values + i, (size_t)d, 1, "%s.%s", quantity, model->coordinates[i].name);
}

/* what acts on one of `count` feet or patches */
static void put_load(const columns *to, const char *name, const double *const load[4], size_t one,
                     size_t count) {
  put(to, load[0] + 3 * one, 3 * count, 3, "grf.%s", name);
  put(to, load[1] + 3 * one, 3 * count, 3, "cop.%s", name);
  put(to, load[2] + one, count, 1, "free_moment.%s", name);
  put(to, load[3] + 3 * one, 3 * count, 3, "moment.%s", name);
}

static void put_loads(const columns *to, const ambulo__motion_table *t) {
  const double *const feet[] = {t->grf, t->cop, t->free_moment, t->grf_moment};
  const double *const patches[] = {t->patch_force, t->patch_cop, t->patch_free_moment,
                                   t->patch_moment};
  for (int i = 0; i < t->feet; i++)
    put_load(to, t->model->feet[i].name, feet, (size_t)i, (size_t)t->feet);
  for (int i = 0; i < t->patches; i++)
    put_load(to, t->model->patches[t->patch[i]].name, patches, (size_t)t->patch[i],
             (size_t)t->model->patch_count);
}

static void put_devices(const columns *to, const ambulo__motion_table *t) {
  size_t count = (size_t)t->devices;
  for (int i = 0; i < t->devices; i++) {
    const ambulo_device *device = &t->device[i];
    int turns = device->coordinate >= 0 &&
                t->model->coordinates[device->coordinate].type == AMBULO_REVOLUTE;
    put(to, t->effort + i, count, 1, "device.%s.%s", device->name, turns ? "torque" : "force");
    put(to, t->along + i, count, 1, "device.%s.%s", device->name, turns ? "angle" : "length");
    put(to, t->device_power + i, count, 1, "device.%s.power", device->name);
  }
}

/* of what hands hold: each hand's force and moment, then the power */
static void put_holds(const columns *to, const ambulo__motion_table *t) {
  size_t count = (size_t)t->holds;
  for (int i = 0; i < t->holds; i++) {
    const ambulo_hold *hold = &t->hold[i];
    for (int hand = 0; hand < 2 && hold->hand[hand] >= 0; hand++) {
      const char *point = t->model->points[hold->hand[hand]].name;
      int at = 6 * i + 3 * hand;
      put(to, t->hold_force + at, 6 * count, 3, "held.%s.%s.force", hold->name, point);
      put(to, t->hold_moment + at, 6 * count, 3, "held.%s.%s.moment", hold->name, point);
    }
    put(to, t->hold_power + i, count, 1, "held.%s.power", hold->name);
  }
}

static void put_all(const columns *to, const ambulo__motion_table *t) {
  put_coordinates(to, t->model, t->q, "q");
  put_coordinates(to, t->model, t->qd, "qd");
  put_coordinates(to, t->model, t->qdd, "qdd");
  put_coordinates(to, t->model, t->tau, "tau");
  put(to, t->zmp, 3, 3, "zmp");
  put_loads(to, t);
  put_devices(to, t);
  put_holds(to, t);
  if (t->wrench) {
    put(to, t->wrench + 3, 6, 3, "wrench.force");
    put(to, t->wrench, 6, 3, "wrench.moment");
  }
  if (t->residual) {
    put(to, t->residual, 6, 3, "residual.force");
    put(to, t->residual + 3, 6, 3, "residual.moment");
  }
  if (t->power) put_coordinates(to, t->model, t->power, "power");
  ambulo__text_append_char(to->text, '\n');
}

void ambulo__motion_csv(const ambulo__motion_table *table, ambulo__text_buffer *text) {
  comment(table, text);
  ambulo__text_append(text, "time");
  put_all(&(columns){text, -1}, table);
  for (int k = 0; k < table->samples; k++) {
    ambulo__text_append_number(text, table->times[k]);
    put_all(&(columns){text, k}, table);
  }
}

/* motion.sto: OpenSim's storage form, tabs between columns. */

void ambulo__motion_sto(const ambulo__motion_table *table, ambulo__text_buffer *text) {
  int d = table->model->coordinate_count;
  ambulo__text_append(text, table->name ? table->name : "motion");
  ambulo__text_append_format(text, "\nversion=1\nnRows=%d\nnColumns=%d\ninDegrees=no\nendheader\n",
                             table->samples, d + 1);
  ambulo__text_append(text, "time");
  for (int i = 0; i < d; i++) {
    ambulo__text_append_char(text, '\t');
    ambulo__text_append(text, table->model->coordinates[i].name);
  }
  ambulo__text_append_char(text, '\n');
  for (int k = 0; k < table->samples; k++) {
    ambulo__text_append_number(text, table->times[k]);
    for (int i = 0; i < d; i++) {
      ambulo__text_append_char(text, '\t');
      ambulo__text_append_number(text, table->q[(size_t)k * (size_t)d + (size_t)i]);
    }
    ambulo__text_append_char(text, '\n');
  }
}
