/* report/motion_csv.c - motion.csv: one line a time, columns named by quantity and coordinate. */
#include "report/motion_csv.h"

static void foot_header(const char *foot, ambulo__text_buffer *text) {
  static const char *const prefixes[] = {",grf.", ",cop."}, *const axes[] = {".x", ".y", ".z"};
  for (int i = 0; i < 6; i++) {
    ambulo__text_append(text, prefixes[i / 3]);
    ambulo__text_append(text, foot);
    ambulo__text_append(text, axes[i % 3]);
  }
  ambulo__text_append(text, ",free_moment.");
  ambulo__text_append(text, foot);
}

static void header(const ambulo__motion_table *table, ambulo__text_buffer *text) {
  static const char *const prefixes[] = {"q.", "qd.", "qdd.", "tau."};
  ambulo__text_append(text, "# SI units and radians: time s; q rad or m, qd per s, qdd per s^2; "
                            "tau N m or N; zmp m, world axes");
  if (table->feet)
    ambulo__text_append(text, "; grf N, cop m, world axes; free_moment N m about the normal");
  ambulo__text_append(text, "\ntime");
  for (int p = 0; p < 4; p++) {
    for (int i = 0; i < table->model->coordinate_count; i++) {
      ambulo__text_append_char(text, ',');
      ambulo__text_append(text, prefixes[p]);
      ambulo__text_append(text, table->model->coordinates[i].name);
    }
  }
  ambulo__text_append(text, ",zmp.x,zmp.y,zmp.z");
  for (int foot = 0; foot < table->feet; foot++) foot_header(table->model->feet[foot].name, text);
  ambulo__text_append_char(text, '\n');
}

static void numbers(ambulo__text_buffer *text, const double *values, int count) {
  for (int i = 0; i < count; i++) {
    ambulo__text_append_char(text, ',');
    ambulo__text_append_number(text, values[i]);
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
    }
    ambulo__text_append_char(text, '\n');
  }
}
