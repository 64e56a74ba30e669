/* solver/hold_parameters.c - numbers of what hands hold by their keys: load.mass of the one
 * load, load[box].force[0] or load[1].mass of a list's.
 *
 * Numbers that are zero are mostly not in the file and have no key; of a center or a push that is
 * there, all three numbers have one. With mirrored ends what it has to the side stays zero.
 */
#include "solver/sensitivity_parameters.h"

#include "contact/hold_times.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct hold_keys {
  ambulo__parameters *p;
  const ambulo_hold *hold;
  const double *by;
  char path[AMBULO__PARAMETER_TEXT]; /* "load[box]" */
} hold_keys;

static void name_path(hold_keys *k, int i) {
  const ambulo__problem_keys *keys = &k->p->problem->keys;
  int alone = k->p->problem->definition.hold_count == 1 && k->p->problem->model->load_count == 0;
  if (alone && !keys->loads)
    (void)snprintf(k->path, sizeof k->path, "load");
  else if (strcmp(k->hold->name, "load") == 0) /* as loads without a name are called */
    (void)snprintf(k->path, sizeof k->path, "load[%d]", keys->loads ? keys->hold_item[i] : i);
  else
    (void)snprintf(k->path, sizeof k->path, "load[%s]", k->hold->name);
}

static void add(const hold_keys *k, int number, ambulo__quantity quantity, double value,
                const char *what, const char *key) {
  char label[AMBULO__PARAMETER_TEXT];
  if (!isfinite(k->by[number])) return;
  (void)snprintf(label, sizeof label, "%s of %s", what, k->hold->name);
  ambulo__parameter_add(k->p, quantity, value, k->by[number], label, "%s.%s", k->path, key);
}

static void add_vector(const hold_keys *k, int first, ambulo__quantity quantity,
                       const double value[3], const char *const words[3], const char *key) {
  int mirrored = k->p->problem->definition.ends == AMBULO_ENDS_MIRRORED;
  if (value[0] == 0.0 && value[1] == 0.0 && value[2] == 0.0) return;
  for (int i = 0; i < 3; i++) {
    char one[20];
    if (i == 1 && mirrored) continue;
    (void)snprintf(one, sizeof one, "%s[%d]", key, i);
    add(k, first + i, quantity, value[i], words[i], one);
  }
}

static void add_times(const hold_keys *k) {
  const ambulo_hold *h = k->hold;
  int rises = ambulo__hold_rises(h),
      falls = ambulo__hold_falls(h, ambulo_problem_duration(k->p->problem));
  if (rises) add(k, AMBULO__HOLD_FROM, AMBULO__EVENT_TIME, h->from, "start of the hold", "from");
  if (falls) add(k, AMBULO__HOLD_TO, AMBULO__EVENT_TIME, h->to, "end of the hold", "to");
  if (rises || falls) add(k, AMBULO__HOLD_RAMP, AMBULO__TIME, h->ramp, "ramp", "ramp");
}

void ambulo__parameters_of_holds(ambulo__parameters *p) {
  static const char *const centers[3] = {"center forward", "center to the left", "center upward"};
  static const char *const pushes[3] = {"push forward", "push to the left", "push upward"};
  const ambulo_problem_definition *d = &p->problem->definition;
  for (int i = 0; i < d->hold_count; i++) {
    hold_keys k = {.p = p, .hold = &d->holds[i]};
    k.by = p->partials->hold + (size_t)i * AMBULO__HOLD_NUMBERS;
    name_path(&k, i);
    if (k.hold->mass > 0.0) add(&k, AMBULO__HOLD_MASS, AMBULO__MASS, k.hold->mass, "mass", "mass");
    if (k.hold->inertia > 0.0)
      add(&k, AMBULO__HOLD_INERTIA, AMBULO__RATIO, k.hold->inertia, "inertia", "inertia");
    add_vector(&k, AMBULO__HOLD_CENTER, AMBULO__STEP_LENGTH, k.hold->center, centers, "center");
    add_vector(&k, AMBULO__HOLD_FORCE, AMBULO__FORCE, k.hold->force, pushes, "force");
    add_times(&k);
  }
}
