/* people/inverse.c - inverse dynamics of a motion file (ambulo/tools/inverse.h).
 *
 * Values, rates and accelerations at the rows of the file give torques and root wrench (M, F) by
 * inverse dynamics, and the zero-moment point on the plane n . r = h by
 *
 *     p = (n x M + h F) / (n . F)                                                 (16')
 *
 * What hands hold is added to torques and root wrench (hand_load.h), and forces on the feet are
 * then taken off the torques (ground_load.h).
 */
#include "people/inverse.h"

#include <math.h>
#include <string.h>

#include "base/sized.h"
#include "formats/atomic_file.h"
#include "formats/motion_write.h"
#include "model/model.h"

static int is_unit(double unit) {
  return unit > 0.0 && isfinite(unit);
}

static int is_cutoff(double cutoff) {
  return isnan(cutoff) || (cutoff > 0.0 && isfinite(cutoff));
}

static int options_valid(const ambulo_inverse_options *o) {
  int order = o->filter_order;
  return is_unit(o->length_unit) && is_unit(o->time_unit) && is_unit(o->force_length_unit) &&
         is_unit(o->force_time_unit) && is_cutoff(o->cutoff) && is_cutoff(o->force_cutoff) &&
         !(o->from > o->to) && (order == 2 || order == 4 || order == 6 || order == 8) &&
         isfinite(o->ground_height) && o->angles >= AMBULO_ANGLES_OF_FILE &&
         o->angles <= AMBULO_ANGLES_RADIANS;
}

static void clear(ambulo__inverse *v) {
  const ambulo_allocator *a = &v->allocator;
  double *arrays[] = {v->q,   v->qd,       v->qdd, v->tau,         v->power,        v->wrench,
                      v->zmp, v->residual, v->cop, v->free_moment, v->poses.center, v->poses.foot};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) ambulo__free(a, arrays[i]);
  ambulo__free(a, v->has_value);
  ambulo__free(a, v->has_rate);
  ambulo__free(a, v->has_acceleration);
  ambulo__motion_free(v->given);
  ambulo__motion_free(v->force_table);
  ambulo__ground_load_free(&v->load);
  ambulo__hand_load_free(&v->hands);
}

/* ----------------------------------------------------------------- dynamics */

static void zero_moment_points(ambulo__inverse *v) {
  const double *n = v->model->up;
  for (int k = 0; k < v->rows; k++) {
    const double *m = v->wrench + 6 * (size_t)k, *f = m + 3;
    double normal = n[0] * f[0] + n[1] * f[1] + n[2] * f[2];
    double cross[3] = {n[1] * m[2] - n[2] * m[1], n[2] * m[0] - n[0] * m[2],
                       n[0] * m[1] - n[1] * m[0]};
    for (int i = 0; i < 3; i++)
      v->zmp[3 * (size_t)k + (size_t)i] =
          normal > 0.0 ? (cross[i] + v->options.ground_height * f[i]) / normal : (double)NAN;
  }
}

static ambulo_status compute(ambulo__inverse *v) {
  const ambulo_allocator *a = &v->allocator;
  size_t rows = (size_t)v->rows, d = (size_t)v->model->coordinate_count;
  ambulo_mechanics *mechanics = NULL;
  v->tau = ambulo__alloc(a, rows * d, sizeof(double));
  v->power = ambulo__alloc(a, rows * d, sizeof(double));
  v->wrench = ambulo__alloc(a, 6 * rows, sizeof(double));
  v->zmp = ambulo__alloc(a, 3 * rows, sizeof(double));
  if (!v->tau || !v->power || !v->wrench || !v->zmp) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo_mechanics_create(v->model, a, &mechanics);
  if (!status)
    status = ambulo_mechanics_inverse_dynamics(
        mechanics, v->rows, v->q, v->qd, v->qdd,
        &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = v->tau, .wrench = v->wrench});
  ambulo_mechanics_free(mechanics);
  if (status == AMBULO_E_NUMERIC) {
    ambulo__place place = {.file = v->file};
    (void)ambulo__error(v->doubts.diagnostics, status, place, NULL,
                        "the motion is too large or too fast for numbers: a torque is not finite");
  }
  return status;
}

/* ------------------------------------------------------------ what hands hold */

/* the columns held.* of the motion, else of the file of forces */
static ambulo_status apply_hands(ambulo__inverse *v) {
  int own = ambulo__has_hand_loads(v->given);
  ambulo__load_source source = {.model = v->model,
                                .file = own ? v->file : v->options.forces,
                                .table = own ? v->given : v->force_table,
                                .options = &v->options,
                                .times = v->given->time,
                                .rows = v->rows,
                                .doubts = &v->doubts};
  ambulo_inverse_options options = v->options;
  ambulo__place place = {.file = source.file};
  if (v->options.without_forces || !source.file) return AMBULO_OK;
  if (own) options.force_time_unit = 1.0; /* its times are in seconds already */
  source.options = &options;
  ambulo_status status = ambulo__hand_load_read(&source, &v->allocator, &v->hands);
  if (status || v->hands.loads == 0) return status;
  ambulo__note(v->doubts.diagnostics, place,
               "what its hands hold (held.*) is added to the torques; --grf none leaves it out");
  return ambulo__hand_load_apply(&v->hands, v->model, v->q, v->qd, v->tau, v->wrench);
}

/* -------------------------------------------------------- forces on the feet */

/* the file of the forces; NULL: there are none */
static const char *forces_of(const ambulo__inverse *v) {
  if (v->options.without_forces) return NULL;
  if (v->options.forces) return v->options.forces;
  for (int c = 0; c < v->given->columns && v->model->foot_count > 0; c++) {
    if (strncmp(v->given->names[c], "grf.", 4) == 0) return v->file;
  }
  return NULL;
}

/* once for feet and hands */
static ambulo_status read_forces(ambulo__inverse *v) {
  const char *file = v->options.forces;
  if (v->options.without_forces || !file || strcmp(file, v->file) == 0) return AMBULO_OK;
  ambulo_status status =
      ambulo__motion_read(file, 1, &v->allocator, v->doubts.diagnostics, &v->force_table);
  if (!status) ambulo__doubt_header(&v->doubts, file, v->force_table);
  return status;
}

static void tell(const ambulo__inverse *v, const char *forces, const ambulo_ground_residual *r) {
  ambulo__place place = {.file = forces};
  ambulo_diagnostics *list = v->doubts.diagnostics;
  if (forces == v->file)
    ambulo__note(list, place,
                 "its forces on the feet (grf.*) are taken off the torques; --grf none leaves "
                 "them out");
  if (v->options.other_forces) return;
  ambulo__note(list, place,
               "left over at the root: forward %.4f, up %.4f, left %.4f body weights (rms)",
               r->force_rms[0], r->force_rms[1], r->force_rms[2]);
  if (isfinite(r->moment_rms))
    ambulo__note(list, place, "moment left over: %.4f body weights m (rms)", r->moment_rms);
  ambulo__note(list, place,
               "vertical impulse %.2f N s; the motion needs %.2f N s (sums over the rows)",
               r->given_vertical_impulse, r->vertical_impulse);
}

/* a body with feet, and nothing that carries it */
static void tell_unloaded(const ambulo__inverse *v) {
  ambulo__place place = {.file = v->file};
  if (v->options.without_forces || v->model->foot_count == 0) return;
  ambulo__note(v->doubts.diagnostics, place,
               "no forces on the feet (--grf): the root carries the whole body, and the torques of "
               "legs on the ground lack what it does to them");
}

static ambulo_status allocate_loads(ambulo__inverse *v) {
  const ambulo_allocator *a = &v->allocator;
  size_t rows = (size_t)v->rows, feet = (size_t)v->model->foot_count;
  v->residual = ambulo__alloc(a, 6 * rows, sizeof(double));
  v->cop = ambulo__alloc(a, 3 * rows * feet, sizeof(double));
  v->free_moment = ambulo__alloc(a, rows * feet, sizeof(double));
  v->poses.center = ambulo__alloc(a, 3 * rows, sizeof(double));
  v->poses.foot = ambulo__alloc(a, 3 * rows * feet, sizeof(double));
  int complete = v->residual && v->cop && v->free_moment && v->poses.center && v->poses.foot;
  return complete ? AMBULO_OK : AMBULO_E_MEMORY;
}

static ambulo_status apply_forces(ambulo__inverse *v, const char *forces,
                                  ambulo_ground_residual *residual) {
  int own = forces == v->file;
  ambulo__place place = {.file = forces};
  if (v->model->foot_count == 0)
    return ambulo__error(v->doubts.diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "the model '%s' has no feet that forces could act on", v->model->name);
  ambulo__load_source source = {.model = v->model,
                                .file = forces,
                                .table = own ? v->given : v->force_table,
                                .options = &v->options,
                                .times = v->given->time,
                                .rows = v->rows,
                                .doubts = &v->doubts};
  if (own) v->options.force_time_unit = 1.0; /* its times are in seconds already */
  ambulo_status status = ambulo__ground_load_read(&source, &v->allocator, &v->load);
  if (!status) status = allocate_loads(v);
  if (!status) status = ambulo__load_poses_fill(v->model, v->q, v->rows, &v->allocator, &v->poses);
  if (status) return status;
  ambulo__ground_load_place(&v->load, &v->poses, v->zmp);
  status = ambulo__ground_load_apply(&v->load, v->model, v->q, v->tau);
  if (status) return status;
  ambulo__ground_load_pressure(&v->load, v->model, v->options.ground_height, v->cop,
                               v->free_moment);
  ambulo__ground_load_residual(&v->load, v->model, v->given->time, v->wrench, v->zmp,
                               v->poses.center, v->residual, residual);
  tell(v, forces, residual);
  ambulo__doubt_loads(v, forces, residual);
  return AMBULO_OK;
}

/* ------------------------------------------------------------------- output */

static ambulo_status check_output(const ambulo__inverse *v, const char *output) {
  const char *inputs[] = {v->file, v->options.forces};
  if (!output) return AMBULO_OK;
  return ambulo__output_check(output, inputs, 2, v->options.overwrite, v->doubts.diagnostics);
}

static ambulo_status deliver(ambulo__inverse *v, const char *output, char **text) {
  ambulo__text_buffer buffer;
  ambulo__text_init(&buffer, &v->allocator);
  ambulo__motion_table table = {
      .model = v->model,
      .name = v->model->name,
      .samples = v->rows,
      .times = v->given->time,
      .q = v->q,
      .qd = v->qd,
      .qdd = v->qdd,
      .tau = v->tau,
      .zmp = v->zmp,
      .feet = v->residual ? v->load.feet : 0,
      .grf = v->load.force,
      .cop = v->cop,
      .free_moment = v->free_moment,
      .grf_moment = v->load.moment,
      .holds = v->hands.loads,
      .hold = v->hands.hold,
      .hold_force = v->hands.force,
      .hold_moment = v->hands.moment,
      .hold_power = v->hands.power,
      .wrench = v->wrench,
      .residual = v->residual,
      .power = v->power,
  };
  ambulo__motion_csv(&table, &buffer);
  ambulo_status status = ambulo__text_status(&buffer);
  if (!status && output) {
    status = check_output(v, output);
    if (!status)
      status = ambulo__write_file(output, ambulo__text_data(&buffer), buffer.length, 1,
                                  &v->allocator, v->doubts.diagnostics);
  } else if (!status) {
    char *copy = ambulo__strdup(&v->allocator, ambulo__text_data(&buffer));
    if (copy) *text = copy;
    if (!copy) status = AMBULO_E_MEMORY;
  }
  ambulo__text_free(&buffer);
  return status;
}

/* ------------------------------------------------------------------- the whole */

static ambulo_status expect_paths(const ambulo__inverse *v, const char *output) {
  ambulo_diagnostics *diagnostics = v->doubts.diagnostics;
  ambulo_status status = ambulo__expect_path(v->file, "motion", diagnostics);
  if (!status) status = ambulo__expect_path(v->options.forces, "file of forces", diagnostics);
  return status ? status : ambulo__expect_path(output, "output", diagnostics);
}

static ambulo_status run(ambulo__inverse *v, const char *output, ambulo_ground_residual *residual,
                         char **text) {
  ambulo_ground_residual left_over = {.moment_rms = (double)NAN};
  ambulo_status status = expect_paths(v, output);
  if (!status) status = check_output(v, output);
  if (!status) status = ambulo__inverse_read(v);
  if (!status) status = read_forces(v);
  if (!status) status = ambulo__inverse_take_span(v);
  if (!status) status = ambulo__inverse_take_covered(v);
  if (!status) status = compute(v);
  if (!status) status = apply_hands(v);
  if (!status) zero_moment_points(v);
  const char *forces = status ? NULL : forces_of(v);
  if (forces) status = apply_forces(v, forces, &left_over);
  if (!status && !forces) tell_unloaded(v);
  size_t count = (size_t)v->rows * (size_t)v->model->coordinate_count;
  for (size_t i = 0; i < count && !status; i++) v->power[i] = v->tau[i] * v->qd[i];
  if (!status) status = ambulo__doubts_status(&v->doubts);
  if (!status) status = deliver(v, output, text);
  if (!status && forces && residual) *residual = left_over;
  return status;
}

ambulo_status ambulo_inverse_dynamics_motion(const ambulo_model *model, const char *motion,
                                             const char *output,
                                             const ambulo_inverse_options *options,
                                             const ambulo_allocator *allocator,
                                             ambulo_diagnostics *diagnostics,
                                             const ambulo_inverse_outputs *outputs) {
  ambulo_inverse_options own;
  ambulo_inverse_outputs out;
  if (!AMBULO__OWN(ambulo_inverse_options, &own, options) ||
      !AMBULO__OWN(ambulo_inverse_outputs, &out, outputs))
    return AMBULO_E_ARGUMENT;
  if (!model || !motion || (!output && !out.text) || !options_valid(&own)) return AMBULO_E_ARGUMENT;
  ambulo__inverse v = {.allocator = ambulo__allocator_or_default(allocator),
                       .model = model,
                       .options = own,
                       .file = motion,
                       .doubts = {diagnostics, own.strict, 0, own.other_forces}};
  v.load.allocator = v.hands.allocator = v.allocator;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = run(&v, output, out.residual, out.text);
  clear(&v);
  return ambulo__conclude(diagnostics, errors, status, motion);
}
