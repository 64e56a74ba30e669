/* formats/motion_csv.c - motion.csv: one line a time, columns named by quantity and coordinate. */
#include "formats/motion_csv.h"
#include "formats/output_check.h"

#include <math.h>

static void force_header(const char *name, ambulo__text_buffer *text) {
  static const char *const vectors[] = {"grf", "cop", "moment"};
  for (int i = 0; i < 9; i++) {
    if (i == 6) ambulo__text_append_format(text, ",free_moment.%s", name);
    ambulo__text_append_format(text, ",%s.%s.%c", vectors[i / 3], name, "xyz"[i % 3]);
  }
}

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

static void coordinates(const ambulo_model *model, const char *prefix, ambulo__text_buffer *text) {
  for (int i = 0; i < model->coordinate_count; i++) {
    ambulo__text_append(text, prefix);
    ambulo__text_append(text, model->coordinates[i].name);
  }
}

static void wrench_header(const char *name, ambulo__text_buffer *text) {
  for (int i = 0; i < 6; i++)
    ambulo__text_append_format(text, ",%s.%s.%c", name, i < 3 ? "force" : "moment", "xyz"[i % 3]);
}

static void device_header(const ambulo__motion_table *table, ambulo__text_buffer *text) {
  for (int i = 0; i < table->devices; i++) {
    const ambulo_device *device = &table->device[i];
    int at_joint = device->coordinate >= 0;
    int turns = at_joint && table->model->coordinates[device->coordinate].type == AMBULO_REVOLUTE;
    ambulo__text_append_format(text, ",device.%s.%s,device.%s.%s,device.%s.power", device->name,
                               turns ? "torque" : "force", device->name, turns ? "angle" : "length",
                               device->name);
  }
}

/* of what hands hold: each hand's force and moment, then the power */
static void hold_header(const ambulo__motion_table *table, ambulo__text_buffer *text) {
  for (int i = 0; i < table->holds; i++) {
    const ambulo_hold *hold = &table->hold[i];
    for (int hand = 0; hand < 2 && hold->hand[hand] >= 0; hand++) {
      const char *point = table->model->points[hold->hand[hand]].name;
      for (int k = 0; k < 6; k++)
        ambulo__text_append_format(text, ",held.%s.%s.%s.%c", hold->name, point,
                                   k < 3 ? "force" : "moment", "xyz"[k % 3]);
    }
    ambulo__text_append_format(text, ",held.%s.power", hold->name);
  }
}

static void header(const ambulo__motion_table *table, ambulo__text_buffer *text) {
  static const char *const prefixes[] = {",q.", ",qd.", ",qdd.", ",tau."};
  comment(table, text);
  ambulo__text_append(text, "time");
  for (int p = 0; p < 4; p++) coordinates(table->model, prefixes[p], text);
  ambulo__text_append(text, ",zmp.x,zmp.y,zmp.z");
  for (int foot = 0; foot < table->feet; foot++) force_header(table->model->feet[foot].name, text);
  for (int i = 0; i < table->patches; i++)
    force_header(table->model->patches[table->patch[i]].name, text);
  device_header(table, text);
  hold_header(table, text);
  if (table->wrench) wrench_header("wrench", text);
  if (table->residual) wrench_header("residual", text);
  if (table->power) coordinates(table->model, ",power.", text);
  ambulo__text_append_char(text, '\n');
}

static void numbers(ambulo__text_buffer *text, const double *values, int count) {
  for (int i = 0; i < count; i++) {
    ambulo__text_append_char(text, ',');
    ambulo__text_append_number(text, values[i]);
  }
}

static void patch_numbers(const ambulo__motion_table *table, int k, ambulo__text_buffer *text) {
  for (int i = 0; i < table->patches; i++) {
    size_t at = (size_t)k * (size_t)table->model->patch_count + (size_t)table->patch[i];
    numbers(text, table->patch_force + 3 * at, 3);
    numbers(text, table->patch_cop + 3 * at, 3);
    numbers(text, table->patch_free_moment + at, 1);
    numbers(text, table->patch_moment + 3 * at, 3);
  }
}

static void hold_numbers(const ambulo__motion_table *table, int k, ambulo__text_buffer *text) {
  for (int i = 0; i < table->holds; i++) {
    size_t at = (size_t)k * (size_t)table->holds + (size_t)i;
    for (size_t hand = 0; hand < 2 && table->hold[i].hand[hand] >= 0; hand++) {
      numbers(text, table->hold_force + 6 * at + 3 * hand, 3);
      numbers(text, table->hold_moment + 6 * at + 3 * hand, 3);
    }
    numbers(text, table->hold_power + at, 1);
  }
}

void ambulo__motion_csv(const ambulo__motion_table *table, ambulo__text_buffer *text) {
  int d = table->model->coordinate_count;
  header(table, text);
  for (int k = 0; k < table->samples; k++) {
    size_t at = (size_t)k * (size_t)d;
    ambulo__text_append_number(text, table->times[k]);
    numbers(text, table->q + at, d);
    numbers(text, table->qd + at, d);
    numbers(text, table->qdd + at, d);
    numbers(text, table->tau + at, d);
    numbers(text, table->zmp + 3 * (size_t)k, 3);
    for (int foot = 0; foot < table->feet; foot++) {
      size_t i = (size_t)k * (size_t)table->feet + (size_t)foot;
      numbers(text, table->grf + 3 * i, 3);
      numbers(text, table->cop + 3 * i, 3);
      numbers(text, table->free_moment + i, 1);
      numbers(text, table->grf_moment + 3 * i, 3);
    }
    patch_numbers(table, k, text);
    for (int i = 0; i < table->devices; i++) {
      size_t one = (size_t)k * (size_t)table->devices + (size_t)i;
      numbers(text, table->effort + one, 1);
      numbers(text, table->along + one, 1);
      numbers(text, table->device_power + one, 1);
    }
    hold_numbers(table, k, text);
    if (table->wrench) {
      numbers(text, table->wrench + 6 * (size_t)k + 3, 3);
      numbers(text, table->wrench + 6 * (size_t)k, 3);
    }
    if (table->residual) numbers(text, table->residual + 6 * (size_t)k, 6);
    if (table->power) numbers(text, table->power + at, d);
    ambulo__text_append_char(text, '\n');
  }
}
