/* show/motion_data.c - a person's own motion as data of a page (page.h).
 *
 * Columns, units and doubts are those of inverse dynamics of a file (ambulo/tools/inverse.h), whose
 * table is read; between its rows values go linearly.
 */
#include "show/page.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "ambulo/tools/inverse.h"
#include "ambulo/tools/report.h"
#include "ambulo/tools/load.h"
#include "formats/motion_file.h"
#include "model/model.h"
#include "show/packed_text.h"
#include "show/script_text.h"
#include "show/scene.h"

/* q [AMBULO__SCENE_SAMPLES][coordinates] evenly spaced from..to */
static void sample(const ambulo_model *model, const ambulo__motion *table, double from, double to,
                   double *q) {
  int count = model->coordinate_count, row = 0, last = table->rows - 1;
  for (int k = 0; k < AMBULO__SCENE_SAMPLES; k++) {
    double t = from + (to - from) * k / (AMBULO__SCENE_SAMPLES - 1);
    while (row < last - 1 && table->time[row + 1] < t) row++;
    double share = (t - table->time[row]) / (table->time[row + 1] - table->time[row]);
    for (int i = 0; i < count; i++) {
      char name[AMBULO__MOTION_MAX_NAME + 3];
      (void)snprintf(name, sizeof name, "q.%s", model->coordinates[i].name);
      int column = ambulo__motion_column(table, name);
      const double *at = table->values + (size_t)row * (size_t)table->columns + column;
      q[k * count + i] = column < 0 ? 0.0 : at[0] + share * (at[table->columns] - at[0]);
    }
  }
}

static ambulo_status check_span(const ambulo_page_options *o, const ambulo__motion *table,
                                double span[2], ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = o->motion};
  double first = table->time[0], last = table->time[table->rows - 1];
  span[0] = fmax(o->from, first);
  span[1] = fmin(o->to, last);
  if (table->rows >= 2 && span[1] - span[0] > 1e-6) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, NULL,
                       "no motion from %g to %g s; the file has %g to %g s", o->from, o->to, first,
                       last);
}

static ambulo_status append(const ambulo_page_options *o, const ambulo__motion *table,
                            const double span[2], ambulo__text_buffer *out) {
  const ambulo_model *model = o->body;
  size_t count = (size_t)model->coordinate_count * AMBULO__SCENE_SAMPLES;
  double *q = ambulo__alloc(&out->allocator, count, sizeof *q);
  if (!q) return AMBULO_E_MEMORY;
  const char *slash = strrchr(o->motion, '/');
  const char *name = slash ? slash + 1 : o->motion;
  ambulo__text_buffer scene, data;
  ambulo__text_init(&scene, &out->allocator);
  sample(model, table, span[0], span[1], q);
  ambulo_status status = ambulo__scene_of_motion(model, "measured", q, AMBULO__SCENE_SAMPLES,
                                                 span[1] - span[0], o->ground_height, &scene);
  ambulo__text_init_part(&data, out);
  ambulo__text_append(&data, "{\"summary\":{},\"scene\":");
  ambulo__script_json(&data, ambulo__text_data(&scene), scene.length);
  ambulo__text_append_char(&data, '}');
  ambulo__text_append(out, "{\"name\":");
  ambulo__script_text(out, name);
  ambulo__text_append(out, ",\"packed\":");
  ambulo__packed_text(out, ambulo__text_data(&data), data.length);
  ambulo__text_append_char(out, '}');
  ambulo__text_free(&data);
  ambulo__text_free(&scene);
  ambulo__free(&out->allocator, q);
  return status ? status : ambulo__text_status(out);
}

ambulo_status ambulo__page_add_motion(const ambulo_page_options *o, ambulo__text_buffer *out,
                                      ambulo_diagnostics *diagnostics) {
  ambulo_inverse_options options = ambulo_inverse_options_default();
  options.without_forces = 1;
  options.ground_height = o->ground_height;
  char *text = NULL;
  double span[2];
  ambulo__motion *table = NULL;
  const ambulo_allocator *a = &out->allocator;
  ambulo_status status = ambulo_inverse_dynamics_motion(
      o->body, o->motion, NULL, &options, a, diagnostics,
      &(ambulo_inverse_outputs){.size = sizeof(ambulo_inverse_outputs), .text = &text});
  if (!status)
    status = ambulo__table_read(text, strlen(text), o->motion, AMBULO__MOTION_CSV, 1, a,
                                diagnostics, &table);
  if (!status) status = check_span(o, table, span, diagnostics);
  if (!status) status = append(o, table, span, out);
  ambulo__motion_free(table);
  ambulo_text_free(text, a);
  return status;
}
