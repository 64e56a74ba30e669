/* people/muscle_analysis.c - from a table of a motion to muscles, joints and cost. */
#include "people/muscle_analysis.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/sized.h"
#include "mechanics/pose.h"
#include "people/plausibility.h"
#include "people/stride.h"

static const double shortest = 0.02; /* s: rates of torques are differences over no less */

/* ------------------------------------------------------------------- reading */

static ambulo_status allocate(ambulo_muscle_analysis *a, int rows) {
  const size_t n = (size_t)rows, d = (size_t)a->muscles->model->coordinate_count,
               m = (size_t)a->muscles->count, f = (size_t)a->muscles->model->foot_count,
               j = (size_t)a->values.joints;
  const struct {
    double **array;
    size_t each;
  } arrays[] = {{&a->times, 1},   {&a->q, d},           {&a->qd, d},         {&a->qdd, d},
                {&a->tau, d},     {&a->tau_rate, d},    {&a->grf, 3 * f},    {&a->activation, m},
                {&a->force, m},   {&a->length, m},      {&a->speed, m},      {&a->metabolic, m},
                {&a->reserve, d}, {&a->contact, 3 * j}, {&a->between, 3 * j}};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
    *arrays[i].array = ambulo__alloc(&a->allocator, n * arrays[i].each, sizeof(double));
    if (!*arrays[i].array) return AMBULO_E_MEMORY;
  }
  return AMBULO_OK;
}

static void copy_column(const ambulo__motion *motion, int column, int entries, int entry,
                        double *to) {
  for (int k = 0; k < motion->rows; k++)
    to[(size_t)k * (size_t)entries + (size_t)entry] =
        motion->values[(size_t)k * (size_t)motion->columns + (size_t)column];
}

static ambulo_status read_coordinates(ambulo_muscle_analysis *a, const ambulo__motion *motion,
                                      ambulo_diagnostics *diagnostics) {
  static const char *const prefixes[] = {"q", "qd", "qdd", "tau"};
  const ambulo_model *model = a->muscles->model;
  double *const to[] = {a->q, a->qd, a->qdd, a->tau};
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < model->coordinate_count; i++)
    for (int k = 0; k < 4; k++) {
      char name[AMBULO__MOTION_MAX_NAME + 1];
      (void)snprintf(name, sizeof name, "%s.%s", prefixes[k], model->coordinates[i].name);
      int column = ambulo__motion_column(motion, name);
      if (column >= 0) {
        copy_column(motion, column, model->coordinate_count, i, to[k]);
        continue;
      }
      ambulo__place place = {.file = a->motion};
      if (!status)
        status = ambulo__error(diagnostics, AMBULO_E_SCHEMA, place,
                               "'ambulo inverse MODEL MOTION -o FILE' makes one of a motion",
                               "no column '%s'; expected a table of 'ambulo solve' or 'ambulo "
                               "inverse' of this body",
                               name);
    }
  return status;
}

static void warn_of_forces(const ambulo_muscle_analysis *a, const char *foot,
                           ambulo_diagnostics *diagnostics) {
  ambulo__warning(diagnostics, (ambulo__place){.file = a->motion}, NULL,
                  "no columns 'grf.%s.x|y|z'; contact forces leave out the ground's", foot);
}

static void read_forces(ambulo_muscle_analysis *a, const ambulo__motion *motion,
                        ambulo_diagnostics *diagnostics) {
  static const char axes[] = "xyz";
  const ambulo_model *model = a->muscles->model;
  const char *lacking = NULL; /* the first foot whose force is not known */
  for (int f = 0; f < model->foot_count; f++)
    for (int k = 0; k < 3; k++) {
      char name[AMBULO__MOTION_MAX_NAME + 1];
      (void)snprintf(name, sizeof name, "grf.%s.%c", model->feet[f].name, axes[k]);
      int column = ambulo__motion_column(motion, name);
      if (column < 0) {
        if (!lacking) lacking = model->feet[f].name;
        continue;
      }
      a->has_grf = 1;
      copy_column(motion, column, 3 * model->foot_count, 3 * f + k, a->grf);
    }
  if (lacking) warn_of_forces(a, lacking, diagnostics);
}

static ambulo_status read_hands(ambulo_muscle_analysis *a, const ambulo__motion *motion,
                                ambulo_diagnostics *diagnostics) {
  const ambulo_inverse_options options = ambulo_inverse_options_default();
  ambulo__doubts doubts = {.diagnostics = diagnostics};
  const ambulo__load_source source = {.model = a->muscles->model,
                                      .file = a->motion,
                                      .table = motion,
                                      .options = &options,
                                      .times = a->times,
                                      .rows = motion->rows,
                                      .doubts = &doubts};
  if (!ambulo__has_hand_loads(motion)) return AMBULO_OK;
  return ambulo__hand_load_read(&source, &a->allocator, &a->hands);
}

static ambulo_status read_motion(ambulo_muscle_analysis *a, ambulo_diagnostics *diagnostics) {
  ambulo__motion *motion = NULL;
  ambulo_status status = ambulo__motion_read(a->motion, 0, &a->allocator, diagnostics, &motion);
  const ambulo__place place = {.file = a->motion};
  if (!status && motion->rows < 2)
    status = ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, NULL,
                           "the table has one row; expected at least 2");
  if (!status && motion->in_degrees)
    status = ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, NULL,
                           "angles are in degrees; expected a table of 'ambulo solve' or 'ambulo "
                           "inverse', in radians");
  if (!status) status = allocate(a, motion->rows);
  if (!status) {
    a->values.rows = motion->rows;
    memcpy(a->times, motion->time, (size_t)motion->rows * sizeof *a->times);
    status = read_coordinates(a, motion, diagnostics);
    if (!status) read_forces(a, motion, diagnostics);
    if (!status) status = read_hands(a, motion, diagnostics);
    ambulo__doubt_body(&(ambulo__doubts){.diagnostics = diagnostics}, a->motion, motion,
                       a->muscles->model);
  }
  ambulo__motion_free(motion);
  return status;
}

/* ------------------------------------------------------------------- sharing */

static void find_rates(ambulo_muscle_analysis *a) {
  const int n = a->values.rows, d = a->muscles->model->coordinate_count;
  for (int k = 0; k < n; k++) {
    int from = k, to = k;
    while (from > 0 && a->times[k] - a->times[from] < 0.5 * shortest) from--;
    while (to + 1 < n && a->times[to] - a->times[k] < 0.5 * shortest) to++;
    for (int i = 0; i < d; i++)
      a->tau_rate[k * d + i] =
          (a->tau[to * d + i] - a->tau[from * d + i]) / (a->times[to] - a->times[from]);
  }
}

static ambulo_status share(ambulo_muscle_analysis *a) {
  const ambulo_muscle_options *o = &a->options;
  const ambulo_sharing sharing = {sizeof sharing, o->activation, o->metabolic, o->reserve,
                                  o->by_volume};
  ambulo_sharing_outputs out = ambulo_sharing_outputs_default();
  out.activation = a->activation;
  out.force = a->force;
  out.length = a->length;
  out.speed = a->speed;
  out.reserve = a->reserve;
  find_rates(a);
  ambulo_sharing_states states = ambulo_sharing_states_default();
  states.count = a->values.rows;
  states.q = a->q;
  states.qd = a->qd;
  states.tau = a->tau;
  states.tau_rate = a->tau_rate;
  return ambulo_muscles_share(a->muscles, &sharing, &states, &a->allocator, &out);
}

double ambulo__muscle_integral(const ambulo_muscle_analysis *a, const double *values,
                               size_t stride) {
  double sum = 0.0;
  for (int k = 0; k + 1 < a->values.rows; k++)
    sum += 0.5 * (a->times[k + 1] - a->times[k]) *
           (values[(size_t)k * stride] + values[(size_t)(k + 1) * stride]);
  return sum;
}

/* mean power of all muscles, W; `kept`, which may be NULL: of each at each time */
static double mean_power(ambulo_muscle_analysis *a,
                         ambulo__metabolic (*model)(const ambulo_muscle *,
                                                    const ambulo__fiber_state *),
                         double *kept) {
  const int n = a->values.rows, m = a->muscles->count;
  double energy = 0.0, before = 0.0;
  for (int k = 0; k < n; k++) {
    double power = 0.0;
    for (int i = 0; i < m; i++) {
      const ambulo_muscle *muscle = &a->muscles->muscles[i];
      const size_t at = (size_t)k * (size_t)m + (size_t)i;
      ambulo__fiber_state s = {a->activation[at], a->length[at], a->speed[at], 0.0};
      s.force = s.activation * muscle->force * ambulo__force_by_length(s.length) *
                ambulo__force_by_speed(s.speed);
      double one = model(muscle, &s).power;
      if (kept) kept[at] = one;
      power += one;
    }
    if (k > 0) energy += 0.5 * (a->times[k] - a->times[k - 1]) * (power + before);
    before = power;
  }
  return energy / (a->times[n - 1] - a->times[0]);
}

static ambulo_status find_distance(ambulo_muscle_analysis *a) {
  ambulo__pose pose;
  const ambulo_model *model = a->muscles->model;
  ambulo_status status = ambulo__pose_create(model, &a->allocator, &pose);
  if (status) return status;
  double center[2][3];
  for (int end = 0; end < 2; end++) {
    size_t row = end ? (size_t)(a->values.rows - 1) : 0;
    ambulo__pose_at(&pose, a->q + row * (size_t)model->coordinate_count);
    ambulo__pose_center_of_mass(&pose, center[end]);
  }
  for (int k = 0; k < 3; k++)
    a->values.distance += (center[1][k] - center[0][k]) * model->forward[k];
  ambulo__pose_free(&pose);
  return AMBULO_OK;
}

/* ------------------------------------------------------------------- doubts */

static void warn_of_range(const ambulo_muscle_analysis *a, ambulo_diagnostics *diagnostics) {
  const int d = a->muscles->model->coordinate_count;
  const double degree = acos(-1.0) / 180.0;
  unsigned char told[4096] = {0};
  for (int i = 0; i < a->muscles->count; i++) {
    const ambulo_muscle *m = &a->muscles->muscles[i];
    for (int c = 0; c < m->coordinate_count; c++) {
      int q = m->coordinates[c];
      double low = INFINITY, high = -INFINITY;
      for (int k = 0; k < a->values.rows; k++) {
        low = fmin(low, a->q[k * d + q]);
        high = fmax(high, a->q[k * d + q]);
      }
      double slack = 1e-6;
      if (q >= 4096 || told[q] || (low >= m->range[c][0] - slack && high <= m->range[c][1] + slack))
        continue;
      told[q] = 1;
      ambulo__warning(diagnostics, (ambulo__place){.file = a->motion}, NULL,
                      "'%s' goes from %.0f to %.0f degrees; the muscles' paths hold from %.0f to "
                      "%.0f",
                      a->muscles->model->coordinates[q].name, low / degree, high / degree,
                      m->range[c][0] / degree, m->range[c][1] / degree);
    }
  }
}

static void warn_of_reserve(const ambulo_muscle_analysis *a, ambulo_diagnostics *diagnostics) {
  const int d = a->muscles->model->coordinate_count;
  for (int i = 0; i < d; i++) {
    double torque = 0.0, missing = 0.0, when = 0.0;
    for (int k = 0; k < a->values.rows; k++) {
      torque = fmax(torque, fabs(a->tau[k * d + i]));
      if (fabs(a->reserve[k * d + i]) <= missing) continue;
      missing = fabs(a->reserve[k * d + i]);
      when = a->times[k];
    }
    if (missing > 0.05 * torque && missing > 1.0)
      ambulo__warning(diagnostics, (ambulo__place){.file = a->motion}, NULL,
                      "muscles leave %.1f N m of '%s' at %.3f s (its largest torque is %.1f N m)",
                      missing, a->muscles->model->coordinates[i].name, when, torque);
  }
}

/* ------------------------------------------------------------------- public */

static ambulo_status analyse(ambulo_muscle_analysis *a, ambulo_diagnostics *diagnostics) {
  ambulo_status status = share(a);
  if (!status) status = find_distance(a);
  if (status) return status;
  const ambulo__cut_motion motion = {
      a->values.rows, a->q, a->qd, a->qdd, a->has_grf ? a->grf : NULL, a->force, &a->hands};
  status = ambulo__joint_contact(a->muscles, a->cuts, a->values.joints, &motion, &a->allocator,
                                 a->contact, a->between);
  if (status) return status;
  const ambulo_model *model = a->muscles->model;
  double own = model->mass - ambulo__model_load_mass(model);
  ambulo_muscle_values *v = &a->values;
  v->body_weight = ambulo__model_weight(model) * own / model->mass;
  v->bhargava = a->options.resting_power + mean_power(a, ambulo__bhargava, a->metabolic) / own;
  v->umberger = a->options.resting_power + mean_power(a, ambulo__umberger, NULL) / own;
  v->times = a->times;
  v->activation = a->activation;
  v->force = a->force;
  v->fiber_length = a->length;
  v->fiber_speed = a->speed;
  v->metabolic = a->metabolic;
  v->reserve = a->reserve;
  v->contact = a->contact;
  v->between_links = a->between;
  warn_of_range(a, diagnostics);
  warn_of_reserve(a, diagnostics);
  return AMBULO_OK;
}

/* one without a motion */
static ambulo_status begin(const ambulo_muscles *muscles, const char *motion,
                           const ambulo_muscle_options *options, const ambulo_allocator *allocator,
                           ambulo_muscle_analysis **analysis) {
  ambulo_allocator memory = ambulo__allocator_or_default(allocator);
  ambulo_muscle_analysis *a = ambulo__alloc(&memory, 1, sizeof *a);
  if (!a) return AMBULO_E_MEMORY;
  a->allocator = memory;
  a->muscles = muscles;
  a->options = *options;
  a->values.size = sizeof a->values;
  a->values.joints = ambulo__cuts(muscles, AMBULO__MOST_CUTS, a->cuts);
  for (int j = 0; j < a->values.joints; j++) a->joints[j] = a->cuts[j].name;
  a->values.joint = a->joints;
  a->motion = ambulo__strdup(&memory, motion);
  *analysis = a;
  return a->motion ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* the analysis, or nothing of it */
static ambulo_status end(ambulo_muscle_analysis *a, ambulo_status status,
                         ambulo_muscle_analysis **analysis) {
  if (status)
    ambulo_muscle_analysis_free(a);
  else
    *analysis = a;
  return status;
}

ambulo_status ambulo_muscle_analysis_create(const ambulo_muscles *muscles, const char *motion,
                                            const ambulo_muscle_options *options,
                                            const ambulo_allocator *allocator,
                                            ambulo_diagnostics *diagnostics,
                                            ambulo_muscle_analysis **analysis) {
  ambulo_muscle_options own;
  if (!muscles || !motion || !analysis || !AMBULO__OWN(ambulo_muscle_options, &own, options) ||
      !(own.resting_power >= 0.0 && own.resting_power < 100.0))
    return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_muscle_analysis *a = NULL;
  ambulo_status status = begin(muscles, motion, &own, allocator, &a);
  if (!status) status = read_motion(a, diagnostics);
  if (!status) status = analyse(a, diagnostics);
  return ambulo__conclude(diagnostics, errors, end(a, status, analysis), motion);
}

static ambulo_status copy_stride(ambulo_muscle_analysis *a, const ambulo__stride *s) {
  const size_t all = (size_t)s->samples * (size_t)s->coordinates * sizeof *s->q;
  ambulo_status status = allocate(a, s->samples);
  if (status) return status;
  a->values.rows = s->samples;
  a->has_grf = s->feet > 0;
  memcpy(a->times, s->times, (size_t)s->samples * sizeof *s->times);
  memcpy(a->q, s->q, all);
  memcpy(a->qd, s->qd, all);
  memcpy(a->qdd, s->qdd, all);
  memcpy(a->tau, s->tau, all);
  if (a->has_grf) memcpy(a->grf, s->grf, 3 * (size_t)s->samples * (size_t)s->feet * sizeof *s->grf);
  return AMBULO_OK;
}

static ambulo_status of_stride(const ambulo_muscles *muscles, const ambulo__stride *stride,
                               const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                               ambulo_muscle_analysis **analysis) {
  const ambulo_muscle_options usual = ambulo_muscle_options_default();
  const ambulo_model *model = muscles->model;
  ambulo_muscle_analysis *a = NULL;
  ambulo_status status = begin(muscles, "motion.csv", &usual, allocator, &a);
  if (!status) status = copy_stride(a, stride);
  if (!status && !a->has_grf && model->foot_count > 0)
    warn_of_forces(a, model->feet[0].name, diagnostics);
  if (!status) status = analyse(a, diagnostics);
  return end(a, status, analysis);
}

ambulo_status ambulo_muscle_analysis_of_result(const ambulo_problem *problem,
                                               const ambulo_result *result,
                                               const ambulo_muscles *muscles, int samples,
                                               const ambulo_allocator *allocator,
                                               ambulo_diagnostics *diagnostics,
                                               ambulo_muscle_analysis **analysis) {
  if (!problem || !result || !analysis) return AMBULO_E_ARGUMENT;
  if (!muscles) muscles = problem->definition.muscles;
  *analysis = NULL;
  if (!muscles) return AMBULO_OK;
  const ambulo_model *model = problem->model;
  if (muscles->model->coordinate_count != model->coordinate_count ||
      muscles->model->foot_count != model->foot_count)
    return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__stride stride = {.samples = 0};
  ambulo_status status =
      ambulo__stride_create(problem, ambulo_result_x(result), samples, allocator, &stride);
  if (!status) status = of_stride(muscles, &stride, allocator, diagnostics, analysis);
  ambulo__stride_free(&stride);
  if (status != AMBULO_E_NUMERIC) return ambulo__conclude(diagnostics, errors, status, "muscles");
  ambulo__warning(diagnostics, (ambulo__place){.file = "motion.csv"}, NULL,
                  "the motion is not finite; the result is without muscles");
  return AMBULO_OK;
}

void ambulo_muscle_analysis_free(ambulo_muscle_analysis *a) {
  if (!a) return;
  ambulo_allocator memory = a->allocator;
  void *blocks[] = {a->motion,     a->times,  a->q,       a->qd,     a->qdd,       a->tau,
                    a->tau_rate,   a->grf,    a->force,   a->speed,  a->metabolic, a->reserve,
                    a->activation, a->length, a->contact, a->between};
  for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) ambulo__free(&memory, blocks[i]);
  ambulo__hand_load_free(&a->hands);
  ambulo__free(&memory, a);
}

const ambulo_muscle_values *ambulo_muscle_analysis_values(const ambulo_muscle_analysis *a) {
  return a ? &a->values : NULL;
}
