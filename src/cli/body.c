/* cli/body.c - see body.h. */
#include "cli/body.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "ambulo/tools/load.h"
#include "cli/guard.h"
#include "cli/output.h"
#include "cli/shipped.h"

enum { SUBJECT_KEYS = 3, OVERRIDE = 64 };

/* ----------------------------------------------------------------------- files */

ambulo_status ambulo__cli_load_problem(const ambulo__cli_input *input, const char *file,
                                       ambulo_diagnostics *diagnostics, ambulo_problem **problem) {
  int count;
  const char *const *overrides = ambulo__cli_values(input, "set", &count);
  return ambulo_problem_load(file, overrides, count, NULL, diagnostics, problem);
}

ambulo_status ambulo__cli_load_muscles(const char *file, const ambulo_model *model,
                                       ambulo_diagnostics *diagnostics, ambulo_muscles **muscles) {
  char path[4096];
  int found = file ? ambulo__cli_find_file(file, path, sizeof path)
                   : ambulo__cli_shipped_file("leg_muscles.yaml", path, sizeof path);
  if (!file) file = "leg_muscles.yaml";
  return ambulo_muscles_load(found ? path : file, model, NULL, diagnostics, muscles);
}

/* what options say about the subject; of a problem file as values of it */
typedef struct subject_text {
  ambulo_subject subject;
  char overrides[SUBJECT_KEYS][OVERRIDE];
  int count;
} subject_text;

static ambulo_status load_file(const ambulo__cli_input *input, const char *file,
                               const subject_text *subject, ambulo_diagnostics *diagnostics,
                               ambulo__cli_body *body) {
  int count;
  const char *const *sets = ambulo__cli_values(input, "set", &count);
  ambulo_file_kind kind = AMBULO_FILE_UNKNOWN;
  ambulo_status status = ambulo_file_kind_of(file, NULL, diagnostics, &kind);
  if (!status && kind == AMBULO_FILE_MODEL)
    status = ambulo_model_load_with(file, sets, count, subject ? &subject->subject : NULL, NULL,
                                    diagnostics, &body->loaded);
  if (status || kind == AMBULO_FILE_MODEL) return status;
  const char **overrides =
      calloc((size_t)count + SUBJECT_KEYS, sizeof *overrides); /* after those of --set */
  if (!overrides) return AMBULO_E_MEMORY;
  for (int i = 0; i < count; i++) overrides[i] = sets[i];
  for (int i = 0; subject && i < subject->count; i++) overrides[count++] = subject->overrides[i];
  status = ambulo_problem_load(file, overrides, count, NULL, diagnostics, &body->problem);
  free(overrides);
  return status;
}

static ambulo_status load(const ambulo__cli_input *input, const char *file,
                          const subject_text *subject, ambulo_diagnostics *diagnostics,
                          ambulo__cli_body *body) {
  ambulo_status status = load_file(input, file, subject, diagnostics, body);
  if (status) return status;
  body->model = body->problem ? ambulo_problem_model(body->problem) : body->loaded;
  if (body->problem) body->ground_height = ambulo_problem_ground_height(body->problem);
  return AMBULO_OK;
}

ambulo_status ambulo__cli_load(const ambulo__cli_input *input, const char *file,
                               ambulo_diagnostics *diagnostics, ambulo__cli_body *body) {
  return load(input, file, NULL, diagnostics, body);
}

int ambulo__cli_is_batch(const char *directory) {
  char path[4200];
  struct stat entry;
  ambulo__cli_format(path, sizeof path, "%.4096s/batch.json", directory);
  return stat(path, &entry) == 0;
}

int ambulo__cli_census_code(const ambulo_batch_census *c) {
  if (c->corrupt > 0) return ambulo_status_exit_code(AMBULO_E_IO);
  return c->missing + c->stale > 0 ? 1 : 0;
}

/* --------------------------------------------------------------------- options */

/* "LINK:KG:X,Y,Z" */
typedef struct load_text {
  char link[128];
  double mass, position[3];
} load_text;

/* a plain number up to `end` ('\0': the end of the text); NULL if there is none */
static const char *read_number(const char *text, char end, double *value) {
  char *stop = NULL;
  size_t length = strspn(text, "0123456789.eE+-");
  if (length == 0) return NULL;
  *value = strtod(text, &stop);
  if (stop != text + length || *stop != end || !isfinite(*value)) return NULL;
  return end ? stop + 1 : stop;
}

static int read_load(const ambulo__cli_input *input, load_text *load) {
  const char *text = ambulo__cli_value(input, "load");
  if (!text) return 1;
  const char *colon = strchr(text, ':'), *at = NULL;
  size_t length = colon ? (size_t)(colon - text) : 0;
  if (length > 0 && length < sizeof load->link) {
    memcpy(load->link, text, length);
    load->link[length] = '\0';
    at = read_number(colon + 1, ':', &load->mass);
  }
  for (int i = 0; i < 3 && at; i++) at = read_number(at, i < 2 ? ',' : '\0', &load->position[i]);
  if (at && load->mass > 0.0) return 1;
  ambulo__cli_usage_error(input->command->name, NULL,
                          "--load is '%s'; expected LINK:KG:X,Y,Z, such as pelvis:20:-0.18,0.35,0",
                          text);
  return 0;
}

static int read_subject(const ambulo__cli_input *input, subject_text *s) {
  static const char *const names[SUBJECT_KEYS] = {"mass", "stature", "sex"};
  int sex = ambulo__cli_choice(input, "sex", -1);
  if (!ambulo__cli_number(input, "mass", 0.5, 1000.0, &s->subject.mass) ||
      !ambulo__cli_number(input, "stature", 0.2, 3.0, &s->subject.stature))
    return 0;
  if (sex >= 0) s->subject.sex = sex == 0 ? AMBULO_FEMALE : AMBULO_MALE;
  for (int i = 0; i < SUBJECT_KEYS; i++) {
    const char *value = ambulo__cli_value(input, names[i]);
    if (!value) continue;
    ambulo__cli_format(s->overrides[s->count++], OVERRIDE, "subject.%s=%s", names[i], value);
  }
  return 1;
}

/* slope and load on top of what the file says */
static int adapt(const ambulo__cli_input *input, const load_text *carried,
                 ambulo_diagnostics *diagnostics, ambulo__cli_body *body, ambulo_status *status) {
  ambulo_conditions conditions = ambulo_conditions_default();
  double slope = 0.0;
  if (!ambulo__cli_number(input, "slope", -34.0, 34.0, &slope)) return 2;
  conditions.slope = slope * 0.017453292519943295;
  if (carried->link[0]) {
    conditions.load_link = ambulo_model_find_link(body->model, carried->link);
    conditions.load_mass = carried->mass;
    memcpy(conditions.load_position, carried->position, sizeof conditions.load_position);
    if (conditions.load_link < 0)
      return ambulo__cli_usage_error(input->command->name, "ambulo info lists the links",
                                     "--load: the model has no link '%s'", carried->link);
  }
  if (slope == 0.0 && !carried->link[0]) return 0;
  *status = ambulo_model_adapt(body->model, &conditions, NULL, diagnostics, &body->adapted);
  if (!*status) body->model = body->adapted;
  return 0;
}

int ambulo__cli_body_load(const ambulo__cli_input *input, const char *file,
                          ambulo_diagnostics *diagnostics, ambulo__cli_body *body,
                          ambulo_status *status) {
  load_text carried = {.link = ""};
  subject_text subject = {.subject = ambulo_subject_default()};
  if (!read_load(input, &carried) || !read_subject(input, &subject)) return 2;
  *status = load(input, file, &subject, diagnostics, body);
  if (*status) return 0;
  int code =
      body->problem ? ambulo__cli_guard_files(input, ambulo_problem_inputs(body->problem)) : 0;
  return code ? code : adapt(input, &carried, diagnostics, body, status);
}

void ambulo__cli_body_free(ambulo__cli_body *body) {
  ambulo_model_free(body->adapted);
  ambulo_problem_free(body->problem);
  ambulo_model_free(body->loaded);
}

/* ---------------------------------------------------------------------- forces */

static int is_xml(const char *file) {
  const char *dot = strrchr(file, '.');
  return dot && strcasecmp(dot, ".xml") == 0;
}

ambulo_status ambulo__cli_forces_read(const ambulo__cli_input *input, const ambulo_model *model,
                                      ambulo_diagnostics *diagnostics, ambulo__cli_forces *forces,
                                      ambulo_inverse_options *options) {
  const char *file = ambulo__cli_value(input, "grf");
  options->without_forces = file && strcmp(file, "none") == 0;
  options->forces = options->without_forces ? NULL : file;
  options->force_columns = ambulo__cli_value(input, "force-columns");
  if (!options->forces || !is_xml(file)) return AMBULO_OK;
  ambulo_status status = ambulo_import_external_loads(file, model, NULL, diagnostics,
                                                      &forces->table, &forces->columns);
  if (status) return status;
  options->forces = forces->table;
  if (!options->force_columns) options->force_columns = forces->columns;
  return AMBULO_OK;
}

void ambulo__cli_forces_free(ambulo__cli_forces *forces) {
  ambulo_text_free(forces->table, NULL);
  ambulo_text_free(forces->columns, NULL);
}
