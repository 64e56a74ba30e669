/* tests/fuzz/texts.h - targets: YAML files of our own. */
#ifndef AMBULO_TESTS_FUZZ_TEXTS_H
#define AMBULO_TESTS_FUZZ_TEXTS_H

#include "support/sweep_files.h"
#include "target.h"

/* ----------------------------------------------------------------------- model */

enum { FUZZ_MOST_COORDINATES = 64 };

static void fuzz_move(const ambulo_model *model) {
  double q[3 * FUZZ_MOST_COORDINATES], tau[FUZZ_MOST_COORDINATES];
  int d = ambulo_model_coordinate_count(model);
  if (!(ambulo_model_mass(model) > 0.0)) fuzz_fault("mass", "not positive");
  if (d > FUZZ_MOST_COORDINATES || d == 0) return;
  for (int i = 0; i < 3 * d; i++) q[i] = 0.3 * sin(1.0 + i);
  ambulo_mechanics *mechanics = NULL;
  ambulo_outputs outputs = ambulo_outputs_default();
  outputs.tau = tau;
  if (ambulo_mechanics_create(model, &fuzz_memory, &mechanics)) return;
  ambulo_status status =
      ambulo_mechanics_inverse_dynamics(mechanics, 1, q, q + d, q + 2 * d, &outputs);
  for (int i = 0; i < d && !status; i++)
    if (!isfinite(tau[i])) fuzz_fault("torque", "not finite, and no status says so");
  ambulo_mechanics_free(mechanics);
}

static void fuzz_model(unsigned choice, const char *bytes, size_t length) {
  fuzz_call call = fuzz_begin();
  ambulo_model *model = NULL;
  ambulo_subject person = ambulo_subject_default();
  if (choice & 1) person.mass = 60.0;
  if (choice & 2) person.stature = 1.6;
  ambulo_status status = ambulo_model_load_text(
      bytes, length, "m.yaml", choice & 3 ? &person : NULL, &fuzz_memory, call.list, &model);
  fuzz_status(&call, status);
  if (!status) fuzz_move(model);
  ambulo_model_free(model);
  fuzz_end(&call);
}

/* what is exported is read by the importer, and that is a model again, unless it is refused */
static void fuzz_round(unsigned choice, const char *bytes, size_t length) {
  static const ambulo_export_format formats[] = {AMBULO_EXPORT_OPENSIM, AMBULO_EXPORT_URDF};
  fuzz_call call = fuzz_begin();
  ambulo_model *model = NULL;
  char *text = NULL;
  ambulo_export_options options = ambulo_export_options_default();
  options.format = formats[choice & 1];
  options.free_root = choice >> 1 & 1;
  options.overwrite = 1;
  const char *out = fuzz_path("round.xml");
  ambulo_status status =
      ambulo_model_load_text(bytes, length, "m.yaml", NULL, &fuzz_memory, call.list, &model);
  fuzz_status(&call, status);
  if (!status) status = ambulo_export(model, NULL, out, &options, &fuzz_memory, call.list);
  fuzz_status(&call, status);
  if (!status) {
    status = ambulo_import_model(out, NULL, NULL, &fuzz_memory, call.list, &text);
    fuzz_status(&call, status);
    if (status == AMBULO_E_PARSE) fuzz_fault("an export", "is no XML");
  }
  fuzz_free_text(text);
  ambulo_model_free(model);
  fuzz_end(&call);
}

/* --------------------------------------------------------------------- problem */

enum { FUZZ_MOST_ENTRIES = 1000000 };

static void fuzz_evaluate(const ambulo_problem *problem) {
  int n = ambulo_problem_variable_count(problem), m = ambulo_problem_row_count(problem);
  if ((long)n * (m + 1) > FUZZ_MOST_ENTRIES) return;
  double *x = calloc((size_t)n + 1, sizeof *x), *rows = calloc((size_t)m + 1, sizeof *rows);
  double objective = 0.0;
  ambulo_workspace *workspace = NULL;
  if (!x || !rows) abort();
  if (!ambulo_workspace_create(problem, &fuzz_memory, &workspace)) {
    ambulo_status status = ambulo_problem_evaluate(problem, workspace, x, &objective, NULL, rows);
    if (!status) status = ambulo_problem_gradient(problem, workspace, x, 1.0, rows, x);
    if (!status && !isfinite(objective)) fuzz_fault("objective", "not finite");
  }
  ambulo_workspace_free(workspace);
  free(rows);
  free(x);
}

static const char fuzz_two_terms[] =
    "ambulo: 1\nkind: problem\nname: swing\nmodel: one.yaml\nangles: radians\n"
    "time: {duration: 1.0, intervals: 10}\ntrajectory: {intervals: 6}\n"
    "ends: {initial: {pin: 0}, final: {pin: 1}}\nobjective:\n"
    "  - {term: torque_squared, weight: 1}\n  - {term: acceleration, weight: 0.1}\n";

static void fuzz_open_rod(void) {
  scratch_write(fuzz_path("p.yaml"), sweep_problem);
  scratch_write(fuzz_path("one.yaml"), sweep_model);
  scratch_write(fuzz_path("two.yaml"), fuzz_two_terms);
  fuzz_copy("models/two_link.yaml", "two_link.yaml");
  fuzz_copy("models/walker_2d.yaml", "walker_2d.yaml");
  scratch_write(fuzz_path("r.csv"), "time,pin\n0,0\n0.5,0.2\n1,1\n");
  scratch_write(fuzz_path("feet.csv"), "foot,begin,end,x,z\nleft,0,.5,.1,0\n");
}

static void fuzz_problem(unsigned choice, const char *bytes, size_t length) {
  fuzz_call call = fuzz_begin();
  ambulo_problem_text text = ambulo_problem_text_default();
  ambulo_problem *problem = NULL;
  (void)choice;
  text.text = bytes;
  text.length = length;
  text.name = "t.yaml";
  text.directory = (const char *)fuzz_state;
  ambulo_status status = ambulo_problem_load_text(&text, &fuzz_memory, call.list, &problem);
  fuzz_status(&call, status);
  if (!status) fuzz_evaluate(problem);
  ambulo_problem_free(problem);
  fuzz_end(&call);
}

/* lines "path=value", as --set has them; control characters are the shell's matter */
static void fuzz_override(unsigned choice, const char *bytes, size_t length) {
  enum { MOST = 8 };
  char *text = malloc(length + 1);
  const char *lines[MOST];
  int count = 0;
  if (!text) abort();
  memcpy(text, bytes, length);
  text[length] = '\0';
  for (char *line = strtok(text, "\n"); line && count < MOST; line = strtok(NULL, "\n"))
    lines[count++] = line;
  fuzz_call call = fuzz_begin();
  ambulo_problem *problem = NULL;
  ambulo_model *model = NULL;
  ambulo_status status = choice & 1 ? ambulo_model_load_with(fuzz_path("one.yaml"), lines, count,
                                                             NULL, &fuzz_memory, call.list, &model)
                                    : ambulo_problem_load(fuzz_path("p.yaml"), lines, count,
                                                          &fuzz_memory, call.list, &problem);
  if (status != AMBULO_E_ARGUMENT) fuzz_status(&call, status); /* an override that is none */
  if (problem) fuzz_evaluate(problem);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
  fuzz_end(&call);
  free(text);
}

/* the tables that a problem names: a reference, footholds */
static void fuzz_reference(unsigned choice, const char *bytes, size_t length) {
  static const char *const settings[] = {
      "constraints={tubes: [{reference: z.csv, coordinates: {pin: 0.5}}]}",
      "objective[0]={term: tracking, weight: 1, reference: z.csv}"};
  fuzz_call call = fuzz_begin();
  ambulo_problem *problem = NULL;
  (void)fuzz_put("z.csv", bytes, length);
  ambulo_status status = ambulo_problem_load(fuzz_path("p.yaml"), &settings[choice & 1], 1,
                                             &fuzz_memory, call.list, &problem);
  fuzz_status(&call, status);
  if (!status) fuzz_evaluate(problem);
  ambulo_problem_free(problem);
  fuzz_end(&call);
}

/* -------------------------------------------------------------------- solution */

static ambulo_problem *fuzz_rod;

static void fuzz_open_solution(void) {
  fuzz_open_rod();
  if (ambulo_problem_load(fuzz_path("p.yaml"), NULL, 0, NULL, NULL, &fuzz_rod))
    fuzz_fault("p.yaml", "not read");
}

static void fuzz_solution(unsigned choice, const char *bytes, size_t length) {
  enum { MOST = 64 };
  double x[MOST];
  fuzz_call call = fuzz_begin();
  const char *path = fuzz_put("s.yaml", bytes, length);
  int n = ambulo_problem_variable_count(fuzz_rod);
  if (n > MOST) abort();
  ambulo_status status =
      choice % 3 == 0   ? ambulo_solution_load(path, fuzz_rod, &fuzz_memory, call.list, x)
      : choice % 3 == 1 ? ambulo_solution_start(path, fuzz_rod, &fuzz_memory, call.list, x)
                        : ambulo_solution_repeat(path, fuzz_rod, AMBULO_ENDS_PERIODIC, &fuzz_memory,
                                                 call.list, x);
  fuzz_status(&call, status);
  for (int i = 0; i < n && !status; i++)
    if (!isfinite(x[i])) fuzz_fault("an unknown", "not finite");
  fuzz_end(&call);
}

/* ------------------------------------------------------------------ sweep, fit */

static void fuzz_sweep(unsigned choice, const char *bytes, size_t length) {
  fuzz_call call = fuzz_begin();
  ambulo_sweep *sweep = NULL;
  (void)choice;
  ambulo_status status =
      ambulo_sweep_load(fuzz_put("z.yaml", bytes, length), &fuzz_memory, call.list, &sweep);
  fuzz_status(&call, status);
  int cases = status ? 0 : ambulo_sweep_case_count(sweep);
  for (int k = 0; k < cases && k < 100; k++) {
    ambulo_case one;
    if (ambulo_sweep_case(sweep, k, &one)) fuzz_fault("a case of the list", "is none");
    for (int a = 0; a < ambulo_sweep_axis_count(sweep); a++)
      if (!ambulo_sweep_axis_name(sweep, a) || !ambulo_sweep_value(sweep, k, a))
        fuzz_fault("an axis", "has no name or value");
  }
  ambulo_sweep_free(sweep);
  fuzz_end(&call);
}

static void fuzz_open_fit(void) {
  fuzz_open_rod();
  scratch_write(fuzz_path("map.csv"), "curve,reference,result,unit\npin,pin,q.pin,deg\n");
  scratch_write(fuzz_path("slow.csv"),
                "percent,pin,pin sd\n0,30,2\n20,45,2\n40,40,2\n60,20,2\n80,15,2\n100,30,2\n");
}

static void fuzz_fit(unsigned choice, const char *bytes, size_t length) {
  fuzz_call call = fuzz_begin();
  ambulo_fit *fit = NULL;
  char *text = NULL;
  (void)choice;
  ambulo_status status =
      ambulo_fit_load(fuzz_put("z.yaml", bytes, length), &fuzz_memory, call.list, &fit);
  fuzz_status(&call, status);
  if (!status && ambulo_fit_describe(fit, &fuzz_memory, &text)) text = NULL;
  fuzz_free_text(text);
  ambulo_fit_free(fit);
  fuzz_end(&call);
}

#endif
