/* solver/sensitivity_words.c - a sensitivity as a person says it: "1 cm more step length costs 0.8
 * %". */
#include "solver/sensitivity_parameters.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct quantity_entry {
  double step;      /* in the unit; of AMBULO__RATIO: share of the value */
  const char *more; /* that step in words */
} quantity_entry;

#define DEGREE 0.017453292519943295

/* in the order of ambulo__quantity */
static const quantity_entry quantities[] = {
    {0.01, "1 cm more"},
    {0.001, "1 mm more"},
    {DEGREE, "1 degree more"},
    {0.1 * DEGREE, "0.1 degrees more"},
    {0.01, "10 ms more"},
    {0.1, "0.1 m/s more"},
    {0.1, "0.1 rad/s more"},
    {1.0, "1 kg more"},
    {1.0, "1 N m more"},
    {10.0, "10 N more"},
    {0.01, "0.01 body weights more"},
    {1.0, "1 rad/s^2 more"},
    {0.1, "0.1 m/s^2 more"},
    {1.0, "1 body weight/s more"},
    {0.01, "1 % of the stride later"},
    {0.01, "10 ms later"},
    {1.0, "1 N m/rad more"},
    {10.0, "10 N/m more"},
    {0.01, "1 % more"},
};

static void say(ambulo__parameter *p, double objective) {
  const quantity_entry *q = &quantities[p->quantity];
  int is_ratio = p->quantity == AMBULO__RATIO && p->value != 0.0;
  p->step = is_ratio ? q->step * fabs(p->value) : q->step;
  const char *more = p->quantity == AMBULO__RATIO && !is_ratio ? "0.01 more" : q->more;
  double change = p->derivative * p->step;
  p->share = objective > 0.0 ? change / objective : (double)NAN;
  if (!isfinite(p->share)) {
    (void)snprintf(p->words, sizeof p->words, "%s %s changes the objective by %.2g", more, p->label,
                   change);
  } else if (change == 0.0) {
    (void)snprintf(p->words, sizeof p->words, "%s %s costs nothing", more, p->label);
  } else {
    (void)snprintf(p->words, sizeof p->words, "%s %s %s %.2g %%", more, p->label,
                   change > 0.0 ? "costs" : "saves", 100.0 * fabs(p->share));
  }
}

static double size_of(const ambulo__parameter *p) {
  return fabs(p->derivative * p->step);
}

/* larger first; what is not finite last; alike ones as they were */
static int compare(const void *left, const void *right) {
  const ambulo__parameter *a = left, *b = right;
  double x = size_of(a), y = size_of(b);
  if (x > y || (!isnan(x) && isnan(y))) return -1;
  if (x < y || (isnan(x) && !isnan(y))) return 1;
  return a->order - b->order;
}

void ambulo__parameters_say(ambulo__parameters *p, double objective) {
  for (int i = 0; i < p->count; i++) {
    say(&p->list[i], objective);
    p->list[i].order = i;
  }
  if (p->count > 0) qsort(p->list, (size_t)p->count, sizeof *p->list, compare);
}
