/* muscle/muscles.c - building immutable muscles from a definition, and freeing them. */
#include "muscle/muscles.h"

#include <string.h>

#include "base/sized.h"

/* ------------------------------------------------------------------ copying */

/* how much of each a definition has */
typedef struct amounts {
  size_t text, pulls, terms, numbers;
} amounts;

static amounts amounts_of(const ambulo_muscles_definition *d) {
  amounts n = {strlen(d->name) + strlen(d->source) + 2, 0, 0, 0};
  for (int i = 0; i < d->muscle_count; i++) {
    const ambulo_muscle *m = &d->muscles[i];
    n.text += strlen(m->name) + strlen(m->group) + 2;
    n.pulls += (size_t)m->pull_count;
    n.terms += (size_t)m->term_count;
    n.numbers += (size_t)m->term_count;
    for (int p = 0; p < m->pull_count; p++) {
      n.text += strlen(m->pulls[p].joint) + 1;
      n.terms += (size_t)m->pulls[p].term_count;
      n.numbers += 3 * (size_t)m->pulls[p].term_count;
    }
  }
  return n;
}

static int allocate(ambulo_muscles *m, const amounts *n, int count) {
  const ambulo_allocator *a = &m->allocator;
  m->text = ambulo__alloc(a, n->text, 1);
  m->muscles = ambulo__alloc(a, (size_t)count, sizeof *m->muscles);
  m->pulls = ambulo__alloc(a, n->pulls, sizeof *m->pulls);
  m->exponents = ambulo__alloc(a, n->terms, sizeof *m->exponents);
  m->numbers = ambulo__alloc(a, n->numbers, sizeof *m->numbers);
  m->strands = ambulo__alloc(a, (size_t)count, sizeof *m->strands);
  m->limbs = ambulo__alloc(a, (size_t)count, sizeof *m->limbs);
  m->fixed = ambulo__alloc(a, (size_t)count, sizeof *m->fixed);
  return m->text && m->muscles && m->pulls && m->exponents && m->numbers && m->strands &&
         m->limbs && m->fixed;
}

/* where the next of each goes */
typedef struct ends {
  char *text;
  ambulo_muscle_pull *pull;
  unsigned char (*exponents)[AMBULO__SPAN];
  double *numbers;
} ends;

static const char *keep_text(ends *to, const char *text) {
  char *kept = to->text;
  size_t size = strlen(text) + 1;
  memcpy(kept, text, size);
  to->text += size;
  return kept;
}

/* exponents of the coordinates that are not there become 0 */
static const unsigned char (*keep_exponents(ends *to, const unsigned char (*from)[AMBULO__SPAN],
                                            int terms, int coordinates))[AMBULO__SPAN] {
  unsigned char(*kept)[AMBULO__SPAN] = to->exponents;
  for (int t = 0; t < terms; t++)
    for (int i = 0; i < AMBULO__SPAN; i++) kept[t][i] = i < coordinates ? from[t][i] : 0;
  to->exponents += terms;
  return (const unsigned char(*)[AMBULO__SPAN])kept;
}

static const double *keep_numbers(ends *to, const double *from, int count) {
  double *kept = to->numbers;
  memcpy(kept, from, (size_t)count * sizeof *kept);
  to->numbers += count;
  return kept;
}

static void keep_muscle(ends *to, int index, const ambulo_muscle *from, ambulo_muscle *m) {
  *m = *from;
  m->name = keep_text(to, from->name);
  m->group = keep_text(to, from->group);
  if (m->mirror < 0) m->mirror = index;
  m->exponents = keep_exponents(to, from->exponents, m->term_count, m->coordinate_count);
  m->length = keep_numbers(to, from->length, m->term_count);
  m->pulls = to->pull;
  to->pull += m->pull_count;
  for (int p = 0; p < m->pull_count; p++) {
    ambulo_muscle_pull *pull = (ambulo_muscle_pull *)&m->pulls[p];
    *pull = from->pulls[p];
    pull->joint = keep_text(to, pull->joint);
    pull->exponents = keep_exponents(to, pull->exponents, pull->term_count, m->coordinate_count);
    pull->slopes =
        (const double(*)[3])keep_numbers(to, (const double *)pull->slopes, 3 * pull->term_count);
  }
}

static ambulo_status copy(ambulo_muscles *m, const ambulo_muscles_definition *d) {
  amounts n = amounts_of(d);
  if (!allocate(m, &n, d->muscle_count)) return AMBULO_E_MEMORY;
  ends to = {m->text, m->pulls, m->exponents, m->numbers};
  m->name = keep_text(&to, d->name);
  m->source = keep_text(&to, d->source);
  m->count = d->muscle_count;
  for (int i = 0; i < m->count; i++) {
    keep_muscle(&to, i, &d->muscles[i], &m->muscles[i]);
    m->volume += m->muscles[i].force * m->muscles[i].fiber;
  }
  return AMBULO_OK;
}

/* ------------------------------------------------------------------ create */

ambulo_status ambulo__muscles_build(const ambulo_model *model,
                                    const ambulo_muscles_definition *definition,
                                    const ambulo__place *places, const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo_muscles **muscles) {
  ambulo_status status = ambulo__muscles_check(model, definition, places, diagnostics);
  if (status) return status;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_muscles *m = ambulo__alloc(&own, 1, sizeof *m);
  if (!m) return AMBULO_E_MEMORY;
  m->allocator = own;
  m->model = model;
  status = copy(m, definition);
  if (!status) status = ambulo__muscles_split(m, places, diagnostics);
  if (status)
    ambulo_muscles_free(m);
  else
    *muscles = m;
  return status;
}

ambulo_status ambulo_muscles_create(const ambulo_model *model,
                                    const ambulo_muscles_definition *definition,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo_muscles **muscles) {
  ambulo_muscles_definition own;
  if (!model || !definition || !muscles ||
      !AMBULO__OWN(ambulo_muscles_definition, &own, definition) || !own.name || !own.source ||
      own.muscle_count < 0 || (own.muscle_count > 0 && !own.muscles) ||
      !ambulo__sized_item(own.muscle_size, sizeof(ambulo_muscle)) ||
      own.muscle_pull_size != sizeof(ambulo_muscle_pull))
    return AMBULO_E_ARGUMENT;
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  void *longer = NULL;
  if (own.muscle_size < sizeof(ambulo_muscle) && own.muscle_count > 0) {
    longer = ambulo__sized_items(&a, own.muscles, own.muscle_count, own.muscle_size,
                                 sizeof(ambulo_muscle), "ambulo_muscle");
    if (!longer) return AMBULO_E_MEMORY;
    own.muscles = longer;
  }
  size_t before = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = ambulo__muscles_build(model, &own, NULL, &a, diagnostics, muscles);
  ambulo__free(&a, longer);
  return ambulo__conclude(diagnostics, before, status, NULL);
}

void ambulo_muscles_free(ambulo_muscles *muscles) {
  if (!muscles) return;
  ambulo_allocator a = muscles->allocator;
  void *blocks[] = {muscles->text,    muscles->muscles, muscles->pulls, muscles->exponents,
                    muscles->numbers, muscles->strands, muscles->limbs, muscles->fixed};
  for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) ambulo__free(&a, blocks[i]);
  ambulo__free(&a, muscles);
}

/* ----------------------------------------------------------------- queries */

const char *ambulo_muscles_name(const ambulo_muscles *muscles) {
  return muscles ? muscles->name : NULL;
}

const char *ambulo_muscles_source(const ambulo_muscles *muscles) {
  return muscles ? muscles->source : NULL;
}

int ambulo_muscles_count(const ambulo_muscles *muscles) {
  return muscles ? muscles->count : 0;
}

const ambulo_muscle *ambulo_muscles_get(const ambulo_muscles *muscles, int index) {
  return muscles && index >= 0 && index < muscles->count ? &muscles->muscles[index] : NULL;
}

int ambulo_muscles_find(const ambulo_muscles *muscles, const char *name) {
  for (int i = 0; muscles && name && i < muscles->count; i++)
    if (!strcmp(muscles->muscles[i].name, name)) return i;
  return -1;
}

int ambulo__muscles_span(const ambulo_muscles *muscles, int coordinate) {
  for (int i = 0; i < muscles->limb_count; i++)
    for (int j = 0; j < muscles->limbs[i].coordinate_count; j++)
      if (muscles->limbs[i].coordinates[j] == coordinate) return 1;
  return 0;
}
