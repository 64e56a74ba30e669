/* solver/numbers_muscles.c - numbers of muscles by their keys: muscles.soleus_r.force, .fiber,
 * .tendon.
 *
 * They are listed where the objective has the term muscle_effort, which alone depends on them: at
 * the same q, qd, tau and tau', another least cost of the sharing (variant_muscles.c). With
 * mirrored ends a muscle moves together with its mirror image; without, each side has numbers of
 * its own.
 */
#include "solver/sensitivity.h"

#include "muscle/muscles.h"

#include <stddef.h>
#include <stdio.h>

static const struct {
  const char *key, *label;
  ambulo__quantity quantity;
  size_t at;
  double low, high; /* what a file may say */
} numbers[] = {
    {"force", "isometric force", AMBULO__RATIO, offsetof(ambulo_muscle, force), 1e-6, 1e6},
    {"fiber", "optimal fibre length", AMBULO__SHORT_LENGTH, offsetof(ambulo_muscle, fiber), 1e-6,
     2.0},
    {"tendon", "slack length of the tendon", AMBULO__SHORT_LENGTH, offsetof(ambulo_muscle, tendon),
     0.0, 2.0},
};
enum { NUMBERS = sizeof numbers / sizeof *numbers };

static double *number_of(ambulo_muscle *m, int k) {
  return (double *)(void *)((char *)m + numbers[k].at);
}

static void add_muscle(ambulo__parameters *p, int i, int image) {
  ambulo_muscle *m = &p->variant.muscles[i], *other = &p->variant.muscles[image];
  char label[AMBULO__PARAMETER_TEXT];
  for (int k = 0; k < NUMBERS; k++) {
    (void)snprintf(label, sizeof label, "%s of %s%s", numbers[k].label, m->name,
                   other != m ? AMBULO__BOTH_OF_A_PAIR : "");
    ambulo__parameter_add(p, numbers[k].quantity, number_of(m, k), label, "muscles.%s.%s", m->name,
                          numbers[k].key);
    ambulo__parameter_within(p, numbers[k].low, numbers[k].high);
    if (other != m)
      ambulo__parameter_with(p, 1.0, number_of(other, k), "muscles.%s.%s", other->name,
                             numbers[k].key);
  }
}

void ambulo__parameters_of_muscles(ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->problem->definition;
  int term = 0;
  while (term < d->term_count && d->terms[term].kind != AMBULO_MUSCLE_EFFORT) term++;
  if (term == d->term_count) return;
  p->next.enters = AMBULO__ENTERS_TERM;
  p->next.term = term;
  for (int i = 0; i < d->muscles->count; i++) {
    int image = d->ends == AMBULO_ENDS_MIRRORED ? d->muscles->muscles[i].mirror : i;
    if (image >= i) add_muscle(p, i, image); /* or said before */
  }
  p->next.enters = AMBULO__ENTERS_ALL;
}
