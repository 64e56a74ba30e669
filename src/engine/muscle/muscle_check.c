/* muscle/muscle_check.c - what every definition of muscles must satisfy. */
#include <math.h>
#include <string.h>

#include "base/numtext.h"
#include "muscle/muscles.h"

typedef struct checker {
  const ambulo_model *model;
  const ambulo_muscles_definition *definition;
  const ambulo__place *places;
  ambulo_diagnostics *diagnostics;
  ambulo_status status;
} checker;

static ambulo__place place_of(const checker *c, int muscle) {
  return c->places ? c->places[muscle] : ambulo__nowhere;
}

static void refuse(checker *c, int muscle, const char *what, double got, const char *expected) {
  c->status =
      ambulo__error(c->diagnostics, AMBULO_E_MODEL, place_of(c, muscle), NULL,
                    "muscle '%s': %s (got %s); expected %s", c->definition->muscles[muscle].name,
                    what, ambulo__number_text(got).text, expected);
}

/* ------------------------------------------------------------------ numbers */

static void check_numbers(checker *c, int muscle) {
  const ambulo_muscle *m = &c->definition->muscles[muscle];
  const struct {
    const char *what;
    double value, low, high; /* low is left out */
    const char *expected;
  } numbers[] = {{"force", m->force, 0.0, 1e6, "above 0 and at most 1e6 N"},
                 {"fiber", m->fiber, 0.0, 2.0, "above 0 and at most 2 m"},
                 {"tendon", m->tendon, -1e-300, 2.0, "0 to 2 m"},
                 {"pennation", m->pennation, -1e-300, 1.4, "0 to 1.4 rad"},
                 {"passive_strain", m->passive_strain, 0.0, 10.0, "above 0 and at most 10"},
                 {"fast_fibers", m->fast_fibers, -1e-300, 1.0, "0 to 1"},
                 {"tendon_strain", m->elastic >= 0 ? m->tendon_strain : 0.01, 0.0, 1.0,
                  "above 0 and at most 1 beside an elastic tendon"}};
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    if (!(numbers[i].value > numbers[i].low && numbers[i].value <= numbers[i].high))
      refuse(c, muscle, numbers[i].what, numbers[i].value, numbers[i].expected);
}

/* ------------------------------------------------------------------- paths */

static void check_polynomial(checker *c, int muscle, int terms,
                             const unsigned char (*exponents)[AMBULO__SPAN], const double *numbers,
                             int each) {
  const ambulo_muscle *m = &c->definition->muscles[muscle];
  if (terms < 1 || terms > AMBULO__MOST_TERMS || !exponents || !numbers) {
    refuse(c, muscle, "terms of a polynomial", terms, "1 to 400");
    return;
  }
  for (int t = 0; t < terms; t++) {
    for (int i = 0; i < m->coordinate_count; i++)
      if (exponents[t][i] > AMBULO_MUSCLE_EXPONENT)
        refuse(c, muscle, "an exponent", exponents[t][i], "0 to 6");
    for (int k = 0; k < each; k++)
      if (!isfinite(numbers[t * each + k]))
        refuse(c, muscle, "a coefficient", numbers[t * each + k], "a finite number");
  }
}

static int is_above(const ambulo_model *model, int axes, int link) {
  do link = ambulo_model_link(model, link)->parent;
  while (link >= 0 && link != axes);
  return link >= 0;
}

/* a joint's name means one cut, whoever crosses it: the first muscle that does says which */
static void check_joint(checker *c, int muscle, const ambulo_muscle_pull *pull) {
  const ambulo_muscle *first = c->definition->muscles;
  const ambulo_muscle_pull *other = NULL;
  for (int i = 0; i <= muscle && !other; i++)
    for (int p = 0; p < first[i].pull_count && !other; p++)
      if (!strcmp(first[i].pulls[p].joint, pull->joint)) other = &first[i].pulls[p];
  if (!other || (other->link == pull->link && other->axes == pull->axes)) return;
  int links = other->link != pull->link;
  c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place_of(c, muscle), NULL,
                            "muscle '%s': the %s of joint '%s' (got %d); expected %d, as of others",
                            first[muscle].name, links ? "link" : "axes", pull->joint,
                            links ? pull->link : pull->axes, links ? other->link : other->axes);
}

static void check_pulls(checker *c, int muscle) {
  const ambulo_muscle *m = &c->definition->muscles[muscle];
  for (int p = 0; p < m->pull_count; p++) {
    const ambulo_muscle_pull *pull = &m->pulls[p];
    if (!ambulo_model_link(c->model, pull->link))
      refuse(c, muscle, "the link of a pull", pull->link, "a link of the model");
    else if (!is_above(c->model, pull->axes, pull->link))
      refuse(c, muscle, "the axes of a pull", pull->axes, "a link above its link");
    else
      check_joint(c, muscle, pull);
    check_polynomial(c, muscle, pull->term_count, pull->exponents, (const double *)pull->slopes, 3);
  }
}

static void check_path(checker *c, int muscle) {
  const ambulo_muscle *m = &c->definition->muscles[muscle];
  if (m->coordinate_count < 1 || m->coordinate_count > AMBULO__SPAN) {
    refuse(c, muscle, "coordinates", m->coordinate_count, "1 to 4 of them");
    return;
  }
  for (int i = 0; i < m->coordinate_count; i++) {
    const ambulo_coordinate *q = ambulo_model_coordinate(c->model, m->coordinates[i]);
    if (!q || !q->actuated) {
      refuse(c, muscle, "a coordinate", m->coordinates[i], "one of a joint that muscles drive");
      return;
    }
    for (int k = 0; k < i; k++)
      if (m->coordinates[k] == m->coordinates[i])
        refuse(c, muscle, "a coordinate twice", m->coordinates[i], "each once");
  }
  check_polynomial(c, muscle, m->term_count, m->exponents, m->length, 1);
  check_pulls(c, muscle);
}

static void check_mirror(checker *c, int muscle) {
  const ambulo_muscles_definition *d = c->definition;
  int other = d->muscles[muscle].mirror;
  if (other == -1) return;
  if (other < 0 || other >= d->muscle_count)
    refuse(c, muscle, "mirror", other, "a muscle");
  else if (other != muscle && d->muscles[other].mirror != muscle)
    refuse(c, muscle, "mirror", other, "a muscle whose mirror image is this one");
}

static void check_elastic(checker *c, int muscle) {
  const ambulo_muscle *m = &c->definition->muscles[muscle];
  int spans = m->elastic < 0;
  for (int i = 0; i < m->coordinate_count && i < AMBULO__SPAN; i++)
    spans |= m->coordinates[i] == m->elastic;
  if (!spans) refuse(c, muscle, "elastic", m->elastic, "a coordinate that the muscle spans");
}

static void check_name(checker *c, int muscle) {
  const char *name = c->definition->muscles[muscle].name;
  for (int k = 0; k < muscle; k++)
    if (!strcmp(c->definition->muscles[k].name, name))
      refuse(c, muscle, "its name is another's too", k, "unlike names");
}

ambulo_status ambulo__muscles_check(const ambulo_model *model,
                                    const ambulo_muscles_definition *definition,
                                    const ambulo__place *places, ambulo_diagnostics *diagnostics) {
  checker c = {model, definition, places, diagnostics, AMBULO_OK};
  const ambulo_muscles_definition *d = definition;
  if (d->muscle_count < 1 || d->muscle_count > AMBULO__MOST_MUSCLES)
    return ambulo__error(diagnostics, AMBULO_E_MODEL, ambulo__nowhere, NULL,
                         "the number of muscles is out of range (got %d); expected 1 to %d",
                         d->muscle_count, AMBULO__MOST_MUSCLES);
  for (int i = 0; i < d->muscle_count; i++) {
    const ambulo_muscle *m = &d->muscles[i];
    if (!m->name || !m->group || m->pull_count < 0 || (m->pull_count > 0 && !m->pulls))
      return AMBULO_E_ARGUMENT;
    for (int p = 0; p < m->pull_count; p++)
      if (!m->pulls[p].joint) return AMBULO_E_ARGUMENT;
  }
  for (int i = 0; i < d->muscle_count; i++) {
    check_name(&c, i);
    check_numbers(&c, i);
    check_path(&c, i);
    check_mirror(&c, i);
    check_elastic(&c, i);
  }
  return c.status;
}
