/* cli/body.c - see body.h. */
#include "cli/format.h"
#include "cli/body.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/output.h"

enum { SUBJECT_KEYS = 3, OVERRIDE = 64 };

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

/* what the options say about the subject, and as values of a problem file */
typedef struct subject_text {
  ambulo_subject subject;
  char overrides[SUBJECT_KEYS][OVERRIDE];
  int count;
} subject_text;

static int read_subject(const ambulo__cli_input *input, subject_text *s) {
  const char *sex = ambulo__cli_value(input, "sex");
  if (!ambulo__cli_number(input, "mass", 0.5, 1000.0, &s->subject.mass) ||
      !ambulo__cli_number(input, "stature", 0.2, 3.0, &s->subject.stature))
    return 0;
  int female = sex && strcmp(sex, "female") == 0;
  if (sex && !female && strcmp(sex, "male") != 0) {
    ambulo__cli_usage_error(input->command->name, NULL, "--sex is '%s'; expected female or male",
                            sex);
    return 0;
  }
  if (sex) s->subject.sex = female ? AMBULO_FEMALE : AMBULO_MALE;
  static const char *const names[SUBJECT_KEYS] = {"mass", "stature", "sex"};
  for (int i = 0; i < SUBJECT_KEYS; i++) {
    const char *value = ambulo__cli_value(input, names[i]);
    if (!value) continue;
    ambulo__cli_format(s->overrides[s->count++], OVERRIDE, "subject.%s=%s", names[i], value);
  }
  return 1;
}

static ambulo_status load(const ambulo__cli_input *input, const char *file,
                          const subject_text *subject, ambulo_diagnostics *diagnostics,
                          ambulo__cli_body *body) {
  const char *overrides[SUBJECT_KEYS];
  for (int i = 0; i < subject->count; i++) overrides[i] = subject->overrides[i];
  ambulo__cli_changes changes = {subject->subject, overrides, subject->count};
  ambulo_status status =
      ambulo__cli_load(input, file, &changes, diagnostics, &body->loaded, &body->problem);
  if (status) return status;
  body->model = body->problem ? ambulo_problem_model(body->problem) : body->loaded;
  if (body->problem) body->ground_height = ambulo_problem_ground_height(body->problem);
  return AMBULO_OK;
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
  return *status ? 0 : adapt(input, &carried, diagnostics, body, status);
}

void ambulo__cli_body_free(ambulo__cli_body *body) {
  ambulo_model_free(body->adapted);
  ambulo_problem_free(body->problem);
  ambulo_model_free(body->loaded);
}
