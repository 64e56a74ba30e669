/* people/muscle_analysis.c - from a motion to muscles, joints and cost. */
#include "people/muscle_analysis.h"

#include <math.h>
#include <string.h>

#include "base/sized.h"
#include "mechanics/pose.h"

static const double shortest = 0.02; /* s: rates of torques are differences over no less */

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
      a->values.rows, a->q,     a->qd,   a->qdd,       a->has_grf ? a->grf : NULL,
      a->force,       a->holds, a->hold, a->hand_force};
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
  if (!status) status = ambulo__muscle_motion_read(a, diagnostics);
  if (!status) status = analyse(a, diagnostics);
  return ambulo__conclude(diagnostics, errors, end(a, status, analysis), motion);
}

static ambulo_status of_stride(const ambulo_muscles *muscles, const ambulo__stride *stride,
                               const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                               ambulo_muscle_analysis **analysis) {
  const ambulo_muscle_options usual = ambulo_muscle_options_default();
  ambulo_muscle_analysis *a = NULL;
  ambulo_status status = begin(muscles, "motion.csv", &usual, allocator, &a);
  if (!status) status = ambulo__muscle_motion_copy(a, stride, diagnostics);
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
