/* people/muscle_table.c - what muscles did, as a table and as JSON. */
#include <math.h>
#include <string.h>

#include "formats/atomic_file.h"
#include "model/model.h"
#include "people/muscle_analysis.h"

/* ------------------------------------------------------------------- table */

/* what each muscle has a column of */
typedef struct quantity {
  const char *name;
  const double *values; /* [rows][muscles] */
} quantity;

enum { QUANTITIES = 5 };

static void list_quantities(const ambulo_muscle_values *v, quantity list[QUANTITIES]) {
  list[0] = (quantity){"activation", v->activation};
  list[1] = (quantity){"force", v->force};
  list[2] = (quantity){"fiber_length", v->fiber_length};
  list[3] = (quantity){"fiber_speed", v->fiber_speed};
  list[4] = (quantity){"metabolic", v->metabolic};
}

static int column_count(const ambulo_muscle_analysis *a) {
  int count = 1 + QUANTITIES * a->muscles->count + 3 * a->values.joints;
  for (int c = 0; c < a->muscles->model->coordinate_count; c++)
    count += ambulo__muscles_span(a->muscles, c);
  return count;
}

static void put_names(const ambulo_muscle_analysis *a, char between, ambulo__text_buffer *text) {
  quantity list[QUANTITIES];
  list_quantities(&a->values, list);
  ambulo__text_append(text, "time");
  for (int k = 0; k < QUANTITIES; k++)
    for (int i = 0; i < a->muscles->count; i++)
      ambulo__text_append_format(text, "%c%s.%s", between, list[k].name,
                                 a->muscles->muscles[i].name);
  for (int c = 0; c < a->muscles->model->coordinate_count; c++)
    if (ambulo__muscles_span(a->muscles, c))
      ambulo__text_append_format(text, "%creserve.%s", between,
                                 a->muscles->model->coordinates[c].name);
  for (int j = 0; j < a->values.joints; j++)
    for (const char *axis = "xyz"; *axis; axis++)
      ambulo__text_append_format(text, "%ccontact.%s.%c", between, a->cuts[j].name, *axis);
  ambulo__text_append_char(text, '\n');
}

static void put_number(ambulo__text_buffer *text, char between, double value) {
  ambulo__text_append_char(text, between);
  ambulo__text_append_number(text, value);
}

static void put_row(const ambulo_muscle_analysis *a, int row, char between,
                    ambulo__text_buffer *text) {
  const size_t k = (size_t)row, m = (size_t)a->muscles->count, j = (size_t)a->values.joints,
               d = (size_t)a->muscles->model->coordinate_count;
  quantity list[QUANTITIES];
  list_quantities(&a->values, list);
  ambulo__text_append_number(text, a->values.times[row]);
  for (int q = 0; q < QUANTITIES; q++)
    for (size_t i = 0; i < m; i++) put_number(text, between, list[q].values[k * m + i]);
  for (size_t c = 0; c < d; c++)
    if (ambulo__muscles_span(a->muscles, (int)c))
      put_number(text, between, a->values.reserve[k * d + c]);
  for (size_t i = 0; i < 3 * j; i++) put_number(text, between, a->values.contact[k * 3 * j + i]);
  ambulo__text_append_char(text, '\n');
}

void ambulo__muscle_table(const ambulo_muscle_analysis *a, int sto, ambulo__text_buffer *text) {
  const char between = sto ? '\t' : ',';
  if (sto)
    ambulo__text_append_format(text,
                               "# ambulo muscles: %s\nversion=1\nnRows=%d\nnColumns=%d\n"
                               "inDegrees=no\nendheader\n",
                               a->muscles->name, a->values.rows, column_count(a));
  else
    ambulo__text_append_format(
        text,
        "# ambulo muscles: %s. N, W, N m; fibers in optimal lengths; contact: "
        "force on the link below, axes of the link above\n",
        a->muscles->name);
  if (!sto) ambulo__text_append_format(text, "# %s\n", a->muscles->source);
  put_names(a, between, text);
  for (int k = 0; k < a->values.rows; k++) put_row(a, k, between, text);
}

static int is_sto(const char *output) {
  size_t length = strlen(output);
  return length > 4 && !strcmp(output + length - 4, ".sto");
}

ambulo_status ambulo_muscle_analysis_write(const ambulo_muscle_analysis *a, const char *output,
                                           int overwrite, ambulo_diagnostics *diagnostics) {
  if (!a || !output) return AMBULO_E_ARGUMENT;
  const char *inputs[] = {a->motion};
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = ambulo__output_check(output, inputs, 1, overwrite, diagnostics);
  ambulo__text_buffer text;
  ambulo__text_init(&text, &a->allocator);
  if (!status) {
    ambulo__muscle_table(a, is_sto(output), &text);
    status = ambulo__text_status(&text);
  }
  if (!status)
    status = ambulo__write_file(output, ambulo__text_data(&text), text.length, 1, &a->allocator,
                                diagnostics);
  ambulo__text_free(&text);
  return ambulo__conclude(diagnostics, errors, status, output);
}

/* ------------------------------------------------------------------- summary */

typedef struct peak {
  double value, time;
} peak;

/* largest size of a vector [rows][entries] at `entry`, of `parts` numbers */
static peak peak_of(const ambulo_muscle_values *v, const double *values, size_t entries,
                    size_t entry, size_t parts) {
  peak most = {0.0, v->times[0]};
  for (int k = 0; k < v->rows; k++) {
    double square = 0.0;
    for (size_t i = 0; i < parts; i++) square += pow(values[(size_t)k * entries + entry + i], 2.0);
    if (sqrt(square) > most.value) most = (peak){sqrt(square), v->times[k]};
  }
  return most;
}

static void put_joints(ambulo__json *json, const ambulo_muscle_analysis *a) {
  const ambulo_muscle_values *v = &a->values;
  const size_t all = 3 * (size_t)v->joints;
  ambulo__json_open(json, "joints", '{');
  for (int j = 0; j < v->joints; j++) {
    peak contact = peak_of(v, v->contact, all, 3 * (size_t)j, 3);
    peak between = peak_of(v, v->between_links, all, 3 * (size_t)j, 3);
    ambulo__json_open(json, v->joint[j], '{');
    ambulo__json_number(json, "contact", contact.value);
    ambulo__json_number(json, "contact_body_weights", contact.value / v->body_weight);
    ambulo__json_number(json, "time", contact.time);
    ambulo__json_number(json, "intersegmental", between.value);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, '}');
}

static void put_muscles(ambulo__json *json, const ambulo_muscle_analysis *a) {
  const ambulo_muscle_values *v = &a->values;
  const size_t m = (size_t)a->muscles->count;
  double duration = v->times[v->rows - 1] - v->times[0];
  ambulo__json_open(json, "muscles", '{');
  for (size_t i = 0; i < m; i++) {
    peak activation = peak_of(v, v->activation, m, i, 1), force = peak_of(v, v->force, m, i, 1);
    ambulo__json_open(json, a->muscles->muscles[i].name, '{');
    ambulo__json_text(json, "group", a->muscles->muscles[i].group);
    ambulo__json_number(json, "activation", activation.value);
    ambulo__json_number(json, "time", activation.time);
    ambulo__json_number(json, "force", force.value);
    ambulo__json_number(json, "metabolic",
                        ambulo__muscle_integral(a, v->metabolic + i, m) / duration);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, '}');
}

static void put_reserves(ambulo__json *json, const ambulo_muscle_analysis *a) {
  const ambulo_model *model = a->muscles->model;
  ambulo__json_open(json, "reserves", '{');
  for (int c = 0; c < model->coordinate_count; c++) {
    if (!ambulo__muscles_span(a->muscles, c)) continue;
    ambulo__json_number(
        json, model->coordinates[c].name,
        peak_of(&a->values, a->values.reserve, (size_t)model->coordinate_count, (size_t)c, 1)
            .value);
  }
  ambulo__json_close(json, '}');
}

void ambulo__muscle_json(ambulo__json *json, const char *key, const ambulo_muscle_analysis *a) {
  const ambulo_muscle_values *v = &a->values;
  double duration = v->times[v->rows - 1] - v->times[0], rest = a->options.resting_power;
  ambulo__json_open(json, key, '{');
  ambulo__json_text(json, "muscles_of", a->muscles->name);
  ambulo__json_text(json, "source", a->muscles->source);
  ambulo__json_number(json, "duration", duration);
  ambulo__json_number(json, "distance", v->distance);
  ambulo__json_open(json, "metabolic", '{');
  ambulo__json_number(json, "resting", rest);
  ambulo__json_number(json, "bhargava", v->bhargava);
  ambulo__json_number(json, "umberger", v->umberger);
  if (v->distance > 0.01) {
    ambulo__json_number(json, "bhargava_per_kg_metre", v->bhargava * duration / v->distance);
    ambulo__json_number(json, "umberger_per_kg_metre", v->umberger * duration / v->distance);
  }
  ambulo__json_close(json, '}');
  put_joints(json, a);
  put_reserves(json, a);
  put_muscles(json, a);
  ambulo__json_close(json, '}');
}

ambulo_status ambulo_muscle_analysis_json(const ambulo_muscle_analysis *a,
                                          const ambulo_allocator *allocator, char **text) {
  if (!a || !text) return AMBULO_E_ARGUMENT;
  ambulo_allocator memory = ambulo__allocator_or_default(allocator);
  ambulo__text_buffer buffer;
  ambulo__text_init(&buffer, &memory);
  ambulo__json json = {&buffer, 0, 1};
  ambulo__muscle_json(&json, NULL, a);
  ambulo_status status = ambulo__text_status(&buffer);
  if (!status) {
    *text = ambulo__strdup(&memory, ambulo__text_data(&buffer));
    if (!*text) status = AMBULO_E_MEMORY;
  }
  ambulo__text_free(&buffer);
  return status;
}
