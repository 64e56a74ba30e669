/* show/report.c - solution.yaml, and the result folder: all of it or nothing.
 *
 * Reading order: report.h, report.c. Numbers: summary_json.h, summary_json.c, summary_parts.c.
 * Pictures: svg.h, skeleton.h, gait_svg.h, gait_svg.c, gait_strip.c, gait_surroundings.h,
 * gait_people.h, gait_chart.h, gait_curves.c, picture.h. Space: scene.h, scene_body.c,
 * scene_surroundings.c, scene.c. The page: page.h, page_data.c, page.c. Films:
 * canvas.h, film_scene.h, film_draw.c, film.c.
 */
#include "show/report.h"

#include "ambulo/tools/load.h"
#include "ambulo/tools/report.h"
#include "base/sized.h"
#include "contact/contacts.h"
#include "formats/atomic_file.h"
#include "formats/json_text.h"
#include "formats/motion_write.h"
#include "model/model_check.h"
#include "people/stride.h"
#include "problem/nlp.h"
#include "show/gait_svg.h"
#include "show/scene.h"
#include "show/summary_json.h"

#include <string.h>

static void number_list(ambulo__text_buffer *text, const double *values, int count) {
  ambulo__text_append_char(text, '[');
  for (int i = 0; i < count; i++) {
    if (i) ambulo__text_append(text, ", ");
    ambulo__text_append_number(text, values[i]);
  }
  ambulo__text_append(text, "]\n");
}

static void trajectory(const ambulo__basis *basis, ambulo__text_buffer *text) {
  static const char *const words[] = {"bspline", "central_difference", "hermite"};
  ambulo__basis_kind kind = ambulo__basis_get_kind(basis);
  int intervals = ambulo__basis_intervals(basis);
  ambulo__text_append_format(text, "trajectory:\n  basis: %s\n", words[kind]);
  if (kind == AMBULO__BSPLINE)
    ambulo__text_append_format(text, "  degree: %d\n", ambulo__basis_degree(basis));
  ambulo__text_append_format(text, "  intervals: %d\n", intervals);
  if (kind != AMBULO__BSPLINE) return;
  ambulo__text_append(text, "  breakpoints: ");
  number_list(text, ambulo__basis_breakpoints(basis), intervals + 1);
}

/* multipliers as definitions/solution_multipliers.c reads them */

static int presses(const ambulo_problem *p, const ambulo_result *result, int row) {
  return p->table.rows[row].relation == AMBULO_NOT_NEGATIVE &&
         ambulo_result_multipliers(result)[row] > 0.0;
}

enum { UNKNOWN, DONE, WANTED };

/* the rows that are like `first`, the first with a force: wanted are those with a force and their
 * neighbours in time, where its density ends */
static void choose(const ambulo_problem *p, const ambulo_result *result, int first, char *state) {
  int before = -1;
  for (int r = 0; r < p->rows; r++) {
    if (!ambulo__rows_alike(&p->table.rows[r], &p->table.rows[first])) continue;
    int pressed = before >= 0 && presses(p, result, before);
    state[r] = presses(p, result, r) || pressed ? WANTED : DONE;
    if (before >= 0 && presses(p, result, r)) state[before] = WANTED;
    before = r;
  }
}

static void series(const ambulo_problem *p, const ambulo_result *result, int first, char *state,
                   ambulo__text_buffer *text) {
  const ambulo__table_row *rows = p->table.rows;
  const char *const label[] = {rows[first].family, rows[first].subject, rows[first].detail};
  ambulo__text_append(text, "\n    - name: [");
  for (int i = 0; i < 3; i++) {
    ambulo__text_append(text, i ? ", " : "");
    ambulo__json_quote(text, label[i]);
  }
  choose(p, result, first, state);
  for (int part = 0; part < 2; part++) {
    const char *between = part ? "]\n      densities: [" : "]\n      times: [";
    for (int r = 0; r < p->rows; r++) {
      if (state[r] != WANTED) continue;
      double time = rows[r].node < 0 ? 1.0 : p->quadrature[rows[r].node];
      double density = presses(p, result, r) ? ambulo_result_multipliers(result)[r] / time : 0.0;
      ambulo__text_append(text, between);
      ambulo__text_append_number(text, part ? density : rows[r].time / p->definition.duration);
      between = ", ";
      if (part) state[r] = DONE;
    }
  }
  ambulo__text_append(text, "]");
}

static void multipliers(const ambulo_problem *p, const ambulo_result *result,
                        ambulo__text_buffer *text) {
  char *state = ambulo__alloc(&text->allocator, (size_t)p->rows + 1, sizeof *state);
  if (!state) {
    text->failed = 1;
    return;
  }
  double interval = 0.0;
  for (int k = 0; k + 1 < p->nodes; k++) interval = fmax(interval, p->times[k + 1] - p->times[k]);
  ambulo__text_append(text, "multipliers:\n  objective: ");
  ambulo__text_append_number(text, ambulo_result_objective(result));
  ambulo__text_append(text, "\n  interval: ");
  ambulo__text_append_number(text, interval / p->definition.duration);
  ambulo__text_append(text, "\n  rows:");
  size_t before = text->length;
  for (int r = 0; r < p->rows; r++)
    if (presses(p, result, r) && state[r] == UNKNOWN) series(p, result, r, state, text);
  ambulo__text_append(text, text->length > before ? "\n" : " []\n");
  ambulo__free(&text->allocator, state);
}

void ambulo__solution_yaml(const ambulo_problem *problem, const ambulo_result *result,
                           ambulo__text_buffer *text) {
  const ambulo_model *model = problem->model;
  const double *x = ambulo_result_x(result);
  ambulo_verdict verdict = ambulo_result_verdict(result);
  ambulo__text_append_format(text, "# verdict: %s\n# SI units and radians\n",
                             ambulo_verdict_name(verdict));
  ambulo__text_append(text, "ambulo: 1\nkind: solution\nduration: ");
  ambulo__text_append_number(text, ambulo_problem_duration(problem));
  ambulo__text_append_char(text, '\n');
  trajectory(problem->basis, text);
  ambulo__text_append(text, "coordinates: [");
  for (int i = 0; i < model->coordinate_count; i++) {
    if (i) ambulo__text_append(text, ", ");
    ambulo__text_append(text, model->coordinates[i].name);
  }
  ambulo__text_append(text, "]\ncontrol_points:\n");
  for (int c = 0; c < problem->control_points; c++) {
    ambulo__text_append(text, "  - ");
    number_list(text, x + (size_t)c * (size_t)problem->coordinates, problem->coordinates);
  }
  multipliers(problem, result, text);
}

/* -------------------------------------------------------------- the result folder */

static const char summary_name[] = "summary.json";

/* only a folder of these files (the last is the page that `ambulo report` puts there) is taken for
 * an earlier result and replaced */
static const char *const file_names[] = {"summary.json",  "motion.csv", "motion.sto",
                                         "solution.yaml", "gait.svg",   "scene.json",
                                         "muscles.csv",   "report.html"};
static const ambulo__folder_mark mark = {summary_name, "\"schema\": \"ambulo-summary/", file_names,
                                         sizeof file_names / sizeof *file_names};

/* NULL: the defaults. 0 when what was given is not valid */
static int options_of(const ambulo_report_options *given, ambulo_report_options *options) {
  return AMBULO__OWN(ambulo_report_options, options, given) && options->samples >= 0 &&
         options->samples != 1;
}

static ambulo_status begin(const char *directory, const ambulo_report_options *options,
                           const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                           ambulo__folder **folder) {
  return ambulo__folder_begin(directory, options->overwrite ? &mark : NULL, allocator, diagnostics,
                              folder);
}

ambulo_status ambulo_report_check(const char *directory, const ambulo_report_options *options,
                                  ambulo_diagnostics *diagnostics) {
  ambulo_report_options own;
  if (!directory || !options_of(options, &own)) return AMBULO_E_ARGUMENT;
  ambulo__folder *folder = NULL;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = begin(directory, &own, NULL, diagnostics, &folder);
  if (!status) ambulo__folder_abort(folder, diagnostics);
  return ambulo__conclude(diagnostics, errors, status, directory);
}

/* hands a finished text to the folder and empties the buffer for the next one */
static ambulo_status write_text(ambulo__folder *folder, const char *name, ambulo__text_buffer *text,
                                ambulo_diagnostics *diagnostics) {
  ambulo_status status = ambulo__text_status(text);
  if (!status)
    status = ambulo__folder_write(folder, name, ambulo__text_data(text), text->length, diagnostics);
  ambulo__text_clear(text);
  return status;
}

static ambulo_status write_motion(const ambulo_problem *problem, const ambulo_result *result,
                                  int samples, ambulo__folder *folder, ambulo__text_buffer *text,
                                  ambulo_diagnostics *diagnostics) {
  ambulo__stride stride = {.samples = 0};
  ambulo_status status =
      ambulo__stride_create(problem, ambulo_result_x(result), samples, &text->allocator, &stride);
  if (status) return status;
  int patch[AMBULO__MAX_PATCHES], patches = 0;
  for (int i = 0; i < stride.patches; i++)
    if (ambulo__patch_is_used(&problem->definition, i)) patch[patches++] = i;
  ambulo__motion_table table = {
      .model = stride.model,
      .name = ambulo_problem_name(problem),
      .samples = stride.samples,
      .times = stride.times,
      .q = stride.q,
      .qd = stride.qd,
      .qdd = stride.qdd,
      .tau = stride.tau,
      .zmp = stride.zmp,
      .feet = stride.feet,
      .grf = stride.grf,
      .cop = stride.cop,
      .free_moment = stride.free_moment,
      .grf_moment = stride.grf_moment,
      .patches = patches,
      .patch = patch,
      .patch_force = stride.patch_force,
      .patch_cop = stride.patch_cop,
      .patch_free_moment = stride.patch_free_moment,
      .patch_moment = stride.patch_moment,
      .devices = stride.devices,
      .device = problem->definition.devices,
      .effort = stride.effort,
      .along = stride.along,
      .device_power = stride.power,
      .holds = stride.holds,
      .hold = problem->definition.holds,
      .hold_force = stride.hold_force,
      .hold_moment = stride.hold_moment,
      .hold_power = stride.hold_power,
  };
  ambulo__motion_csv(&table, text);
  status = write_text(folder, "motion.csv", text, diagnostics);
  if (!status) {
    ambulo__motion_sto(&table, text);
    status = write_text(folder, "motion.sto", text, diagnostics);
  }
  ambulo__stride_free(&stride);
  return status;
}

/* the picture and the scene; no result is lost over curves of people that cannot be read */
static ambulo_status draw(const ambulo_problem *problem, const ambulo_result *result,
                          const ambulo_report_options *options, ambulo__folder *folder,
                          ambulo__text_buffer *text, ambulo_diagnostics *diagnostics) {
  const char *norms = options->norms;
  ambulo__people people = {.count = 0};
  ambulo_status status = AMBULO_OK;
  int wanted = norms && ambulo__gait_is_walk(problem);
  if (wanted) status = ambulo__norms_read(norms, &text->allocator, NULL, &people);
  if (status == AMBULO_E_MEMORY) return status;
  if (status) {
    ambulo__place place = {.file = norms};
    ambulo__warning(diagnostics, place, NULL,
                    "the curves of people cannot be read; gait.svg is without them");
  }
  const ambulo__people *beside = wanted && !status ? &people : NULL;
  status = ambulo__gait_svg(problem, result, beside, text);
  if (!status) status = write_text(folder, "gait.svg", text, diagnostics);
  if (!status)
    status = ambulo__scene_json(problem, result, beside, options->muscles, options->inputs, text);
  if (!status) status = write_text(folder, "scene.json", text, diagnostics);
  ambulo__people_free(&people);
  return status;
}

static ambulo_status write_summary(const ambulo_problem *problem, const ambulo_result *result,
                                   const ambulo_report_options *options, ambulo__folder *folder,
                                   ambulo__text_buffer *text, ambulo_diagnostics *diagnostics) {
  ambulo_muscle_analysis *muscles = NULL;
  ambulo_status status = ambulo_muscle_analysis_of_result(
      problem, result, options->muscles, options->samples, &text->allocator, diagnostics, &muscles);
  if (status) return status;
  ambulo__summary_json(problem, result, options, muscles, text);
  status = write_text(folder, summary_name, text, diagnostics);
  if (!status && muscles) {
    ambulo__muscle_table(muscles, 0, text);
    status = write_text(folder, "muscles.csv", text, diagnostics);
  }
  ambulo_muscle_analysis_free(muscles);
  return status;
}

static ambulo_status write_all(const ambulo_problem *problem, const ambulo_result *result,
                               const ambulo_report_options *options, ambulo__folder *folder,
                               ambulo__text_buffer *text, ambulo_diagnostics *diagnostics) {
  ambulo_status status = write_summary(problem, result, options, folder, text, diagnostics);
  if (status) return status;
  ambulo__solution_yaml(problem, result, text);
  status = write_text(folder, "solution.yaml", text, diagnostics);
  if (status) return status;
  status = write_motion(problem, result, options->samples, folder, text, diagnostics);
  return status ? status : draw(problem, result, options, folder, text, diagnostics);
}

ambulo_status ambulo_report_write(const ambulo_problem *problem, const ambulo_result *result,
                                  const char *directory, const ambulo_report_options *options,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics) {
  ambulo_report_options own;
  if (!problem || !result || !directory || !options_of(options, &own)) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__folder *folder = NULL;
  ambulo_status status = begin(directory, &own, allocator, diagnostics, &folder);
  if (status) return status;
  ambulo__text_buffer text;
  ambulo__text_init(&text, allocator);
  status = write_all(problem, result, &own, folder, &text, diagnostics);
  ambulo__text_free(&text);
  if (status) {
    ambulo__folder_abort(folder, diagnostics);
    return ambulo__conclude(diagnostics, errors, status, directory);
  }
  return ambulo__folder_commit(folder, diagnostics);
}

ambulo_status ambulo_report_summary(const ambulo_problem *problem, const ambulo_result *result,
                                    const ambulo_report_options *options,
                                    const ambulo_allocator *allocator, char **text) {
  ambulo_report_options own;
  if (!problem || !result || !text || !options_of(options, &own)) return AMBULO_E_ARGUMENT;
  ambulo__text_buffer buffer;
  ambulo__text_init(&buffer, allocator);
  ambulo_muscle_analysis *muscles = NULL;
  ambulo_status status = ambulo_muscle_analysis_of_result(problem, result, own.muscles, own.samples,
                                                          allocator, NULL, &muscles);
  if (!status) {
    ambulo__summary_json(problem, result, &own, muscles, &buffer);
    status = ambulo__text_status(&buffer);
  }
  ambulo_muscle_analysis_free(muscles);
  char *copy = status ? NULL : ambulo__strdup(&buffer.allocator, ambulo__text_data(&buffer));
  ambulo__text_free(&buffer);
  if (!status && !copy) status = AMBULO_E_MEMORY;
  if (!status) *text = copy;
  return status;
}
