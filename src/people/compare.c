/* people/compare.c - ambulo_compare(): a result folder, or a person's own motion, against curves
 * of people.
 *
 * Reading order: first the motion as it is shown: stride.h, stride.c, stride_loads.c,
 * stride_measures.h. Then inverse dynamics of a motion file: motion_fit.h, inverse.h,
 * inverse_motion.c, force_columns.h, force_match.c, ground_load.h, load_apply.c, hand_load.h,
 * plausibility.h, inverse.c. Then the comparison: compare.h, compare_reference.c, compare_map.c,
 * compare_cycle.c, compare_columns.c, compare_subject.c, compare_curve.c, compare_score.c,
 * compare.c.
 */
#include "people/compare.h"
#include "base/sized.h"
#include "formats/json_text.h"

#include <math.h>
#include <string.h>

typedef char curve_name[AMBULO__CURVE_NAME];

struct ambulo_comparison {
  ambulo_allocator allocator;
  ambulo_curve_score *scores;
  curve_name *names; /* [capacity] */
  char *sources[AMBULO__PEOPLE_FILES];
  int score_count;
  ambulo_landmark landmarks[AMBULO__MAX_LANDMARKS];
  int landmark_count;
};

typedef struct comparing {
  const ambulo_compare_options *options;
  ambulo_diagnostics *diagnostics;
  ambulo__cycle cycle;
  ambulo__people people;
  ambulo__sampler sampler;
  double *percents, *values; /* [most points] */
  int angles_alone;          /* torques without the ground's forces are not those of people */
  ambulo_comparison *result;
} comparing;

static int options_valid(const ambulo_compare_options *o) {
  if (!isfinite(o->pelvic_tilt) || isinf(o->strike)) return 0;
  if (!isnan(o->mass) && !(o->mass > 0.0 && isfinite(o->mass))) return 0;
  return !o->foot || strcmp(o->foot, "left") == 0 || strcmp(o->foot, "right") == 0;
}

/* ---------------------------------------------------------------- one curve */

static ambulo_status sample_fine(comparing *c, const ambulo__map_entry *entry, double *fine,
                                 int *strides) {
  for (int i = 0; i < AMBULO__FINE; i++) c->percents[i] = 0.5 * (double)i;
  return ambulo__sample_curve(&c->sampler, entry, c->percents, AMBULO__FINE, fine, NULL, strides);
}

static ambulo_status score_one(comparing *c, const ambulo__people_file *people, int index,
                               const char *source, int *doubted) {
  const ambulo__reference_curve *curve = &people->reference.curves[index];
  ambulo_comparison *result = c->result;
  double fine[AMBULO__FINE];
  int found = 0;
  ambulo_status status = ambulo__sample_curve(&c->sampler, curve->entry, curve->percent,
                                              curve->points, c->values, NULL, &found);
  if (!status && found) status = sample_fine(c, curve->entry, fine, &found);
  if (status || !found) return status;
  *doubted = *doubted || ambulo__curve_doubt(curve, fine, people->path, c->diagnostics);
  ambulo_curve_score *score = &result->scores[result->score_count];
  memcpy(result->names[result->score_count], curve->entry->curve, sizeof(curve_name));
  score->name = result->names[result->score_count++];
  score->unit = ambulo__curve_unit_name(curve->entry->unit);
  score->source = source;
  ambulo__score_curve(curve, c->values, fine, score);
  return AMBULO_OK;
}

static ambulo_status score_all(comparing *c) {
  int doubted = 0; /* once is enough */
  for (int f = 0; f < c->people.count; f++) {
    const ambulo__people_file *people = &c->people.files[f];
    for (int i = 0; i < people->reference.count; i++) {
      const ambulo__map_entry *entry = people->reference.curves[i].entry;
      if (!ambulo__curve_is_listed(c->options->curves, entry->curve)) continue;
      if (c->angles_alone && entry->unit != AMBULO__UNIT_ANGLE) continue;
      ambulo_status status = score_one(c, people, i, c->result->sources[f], &doubted);
      if (status) return status;
    }
  }
  ambulo__place place = {.file = c->cycle.motion_path};
  const ambulo__people_file *people = &c->people.files[0];
  if (c->result->score_count > 0) return AMBULO_OK;
  return ambulo__error(
      c->diagnostics, AMBULO_E_SCHEMA, place,
      c->cycle.mass > 0.0 ? NULL : "moments and forces need the body mass: summary.json, or --mass",
      "no curve of '%s' can be made from these columns; the first would be '%s' "
      "from '%s'",
      people->path, people->reference.curves[0].entry->curve,
      people->reference.curves[0].entry->result);
}

/* ---------------------------------------------------------------- landmarks */

static ambulo_status add_landmarks(comparing *c, const ambulo__map *fallback) {
  static const char *const curves[] = {"knee_flexion", "ankle_dorsiflexion", "grf_vertical",
                                       "grf_forward"};
  ambulo_comparison *to = c->result;
  double fine[AMBULO__FINE];
  for (int i = 0; i < 4; i++) {
    const ambulo__map_entry *entry = NULL;
    int found = 0;
    for (int f = 0; !entry && f < c->people.count; f++)
      entry = ambulo__map_find(&c->people.files[f].map, curves[i]);
    if (!entry) entry = ambulo__map_find(fallback, curves[i]);
    ambulo_status status = sample_fine(c, entry, fine, &found);
    if (status) return status;
    if (!found) continue;
    if (i == 0) ambulo__knee_landmarks(fine, to->landmarks, &to->landmark_count);
    if (i == 1) ambulo__ankle_landmarks(fine, to->landmarks, &to->landmark_count);
    if (i == 2) {
      ambulo__vertical_landmarks(fine, c->cycle.gravity, to->landmarks, &to->landmark_count);
    }
    if (i == 3) ambulo__forward_landmarks(fine, to->landmarks, &to->landmark_count);
  }
  return AMBULO_OK;
}

/* -------------------------------------------------------------- entry points */

static ambulo_status allocate(comparing *c) {
  const ambulo_allocator *a = &c->cycle.allocator;
  int most = AMBULO__FINE, curves = 0;
  for (int f = 0; f < c->people.count; f++) {
    const ambulo__reference *reference = &c->people.files[f].reference;
    curves += reference->count;
    for (int i = 0; i < reference->count; i++) {
      if (reference->curves[i].points > most) most = reference->curves[i].points;
    }
  }
  c->percents = ambulo__alloc(a, (size_t)most, sizeof(double));
  c->values = ambulo__alloc(a, (size_t)most, sizeof(double));
  c->result = ambulo__alloc(a, 1, sizeof *c->result);
  if (c->result) c->result->allocator = *a;
  if (!c->percents || !c->values || !c->result) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__sampler_create(&c->cycle, c->options, most, &c->sampler);
  if (status) return status;
  c->result->scores = ambulo__alloc(a, (size_t)curves, sizeof(ambulo_curve_score));
  c->result->names = ambulo__alloc(a, (size_t)curves, sizeof(curve_name));
  for (int f = 0; f < c->people.count; f++) {
    const char *source = c->people.files[f].source;
    c->result->sources[f] = source ? ambulo__strdup(a, source) : NULL;
    if (source && !c->result->sources[f]) return AMBULO_E_MEMORY;
  }
  return c->result->scores && c->result->names ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* norms are those of a walk: of a motion without strikes there is nothing to compare */
static ambulo_status expect_walk(comparing *c) {
  ambulo__place place = {.file = c->cycle.summary_path};
  if (c->cycle.told_strikes == 0)
    return ambulo__error(
        c->diagnostics, AMBULO_E_SCHEMA, place,
        "ambulo compare DIR REFERENCE.csv takes curves of another motion",
        "no foot strikes in this motion; expected a walk, whose curves the shipped "
        "ones of people are");
  if (!c->cycle.told_gait)
    ambulo__warning(c->diagnostics, place, NULL,
                    "no 'gait' in this summary: the shipped curves are those of people who walk "
                    "steadily on level ground");
  int loaded = 0;
  ambulo_status status = ambulo__cycle_samples(&c->cycle, "grf.{foot}.up", 0, AMBULO__CYCLE_LEFT,
                                               c->cycle.scratch, &loaded);
  c->angles_alone = !loaded;
  return status;
}

/* against what c->people already holds */
static ambulo_status compare_with(comparing *c) {
  ambulo__map fallback = {.entries = NULL};
  ambulo_status status = ambulo__map_default(AMBULO__LAYOUT_WIDE, &c->cycle.allocator, &fallback);
  if (!status) status = ambulo__curves_check(c->options->curves, &c->people, c->diagnostics);
  if (!status) status = allocate(c);
  if (!status) status = score_all(c);
  if (!status) status = add_landmarks(c, &fallback);
  if (!status && c->options->cycles) status = ambulo__cycles_write(&c->sampler);
  ambulo__map_free(&fallback);
  return status;
}

/* `people`: a file, or the folder of the norms */
static ambulo_status compare(const char *directory, const char *people, int are_norms,
                             const ambulo_compare_options *options,
                             const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                             ambulo_comparison **comparison) {
  ambulo_compare_options own;
  if (!AMBULO__OWN(ambulo_compare_options, &own, options)) return AMBULO_E_ARGUMENT;
  options = &own;
  if (!directory || !people || !comparison || !options_valid(options)) return AMBULO_E_ARGUMENT;
  if (are_norms && options->map) return AMBULO_E_ARGUMENT;
  comparing c = {.options = options, .diagnostics = diagnostics};
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = ambulo__cycles_check(directory, people, options, diagnostics);
  if (!status) status = ambulo__cycle_open(directory, options, allocator, diagnostics, &c.cycle);
  if (status) return ambulo__conclude(diagnostics, errors, status, directory);
  ambulo_allocator a = c.cycle.allocator;
  if (are_norms) {
    status = expect_walk(&c);
    if (!status) status = ambulo__norms_read(people, &a, diagnostics, &c.people);
  } else {
    status = ambulo__people_read(people, options->map, &a, diagnostics, &c.people);
  }
  if (!status) status = compare_with(&c);
  if (!status) {
    *comparison = c.result;
    c.result = NULL;
  }
  ambulo_comparison_free(c.result);
  ambulo__free(&a, c.percents);
  ambulo__free(&a, c.values);
  ambulo__sampler_free(&c.sampler);
  ambulo__people_free(&c.people);
  ambulo__cycle_close(&c.cycle);
  return ambulo__conclude(diagnostics, errors, status, people);
}

ambulo_status ambulo_compare(const char *directory, const char *reference,
                             const ambulo_compare_options *options,
                             const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                             ambulo_comparison **comparison) {
  return compare(directory, reference, 0, options, allocator, diagnostics, comparison);
}

ambulo_status ambulo_compare_norms(const char *directory, const char *norms,
                                   const ambulo_compare_options *options,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics,
                                   ambulo_comparison **comparison) {
  return compare(directory, norms, 1, options, allocator, diagnostics, comparison);
}

void ambulo_comparison_free(ambulo_comparison *comparison) {
  if (!comparison) return;
  ambulo_allocator a = comparison->allocator;
  ambulo__free(&a, comparison->scores);
  ambulo__free(&a, comparison->names);
  for (int f = 0; f < AMBULO__PEOPLE_FILES; f++) ambulo__free(&a, comparison->sources[f]);
  ambulo__free(&a, comparison);
}

int ambulo_comparison_curve_count(const ambulo_comparison *comparison) {
  return comparison->score_count;
}

const ambulo_curve_score *ambulo_comparison_curve(const ambulo_comparison *comparison, int index) {
  return index >= 0 && index < comparison->score_count ? &comparison->scores[index] : NULL;
}

int ambulo_comparison_landmark_count(const ambulo_comparison *comparison) {
  return comparison->landmark_count;
}

const ambulo_landmark *ambulo_comparison_landmark(const ambulo_comparison *comparison, int index) {
  return index >= 0 && index < comparison->landmark_count ? &comparison->landmarks[index] : NULL;
}

ambulo_status ambulo_comparison_json(const ambulo_comparison *comparison,
                                     const ambulo_allocator *allocator, char **text) {
  if (!comparison || !text) return AMBULO_E_ARGUMENT;
  ambulo__text_buffer buffer;
  ambulo__text_init(&buffer, allocator);
  ambulo__json json = {.text = &buffer, .first = 1};
  ambulo__json_open(&json, NULL, '{');
  ambulo__json_open(&json, "curves", '{');
  for (int i = 0; i < comparison->score_count; i++) {
    const ambulo_curve_score *score = &comparison->scores[i];
    ambulo__json_open(&json, score->name, '{');
    ambulo__json_number(&json, "rmse", score->rmse);
    ambulo__json_number(&json, "r", score->r);
    ambulo__json_number(&json, "within_2sd", score->within_2sd);
    ambulo__json_number(&json, "peak", score->peak);
    ambulo__json_number(&json, "peak_time", score->peak_time);
    if (score->source) ambulo__json_text(&json, "source", score->source);
    ambulo__json_close(&json, '}');
  }
  ambulo__json_close(&json, '}');
  ambulo__json_close(&json, '}');
  ambulo_status status = ambulo__text_status(&buffer);
  char *copy = status ? NULL : ambulo__strdup(&buffer.allocator, ambulo__text_data(&buffer));
  if (!status && !copy) status = AMBULO_E_MEMORY;
  ambulo__text_free(&buffer);
  if (!status) *text = copy;
  return status;
}
