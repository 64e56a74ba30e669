/* formats/motion_sto.c - motion.sto: OpenSim's storage form, tabs between columns. */
#include "formats/motion_csv.h"

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
