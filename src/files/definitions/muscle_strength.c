/* definitions/muscle_strength.c - muscles that are weaker or stronger than their file says.
 *
 * A key names a muscle ("soleus_r"), a group on both sides ("plantarflexors"), or a group on one
 * ("plantarflexors_r"). Its factor multiplies F_max of each of them; several multiply one another.
 * Tendons keep their stiffness: an elastic one stretches by l_s strain s(tau / T), T = sum F_max
 * r(0) of all that stretch with a coordinate, so strain is multiplied by what T is multiplied by.
 */
#include <string.h>

#include "definitions/muscle_reader.h"

enum { NAMES = 3 }; /* of a muscle: its own, its group's, its group's on its side */

static const double most = 10.0; /* a factor of force */

static void names_of(ambulo__muscle_reader *r, int muscle, const char *names[NAMES]) {
  const ambulo_muscle *m = &r->muscles[muscle];
  const char *side = r->suffix[muscle >= r->count];
  names[0] = m->name;
  names[1] = m->group;
  names[2] = side && m->group[0] ? ambulo__arena_print(&r->arena, "%s%s", m->group, side) : "";
}

/* the torque of strong muscles that stretches the tendons of a coordinate */
static double stretching(const ambulo__muscle_reader *r, int all, int coordinate) {
  double torque = 0.0;
  for (int i = 0; i < all; i++) {
    const ambulo_muscle *m = &r->muscles[i];
    for (int k = 0; k < m->coordinate_count && m->elastic == coordinate; k++)
      if (m->coordinates[k] == coordinate) torque -= m->force * ambulo__muscle_slope_at_zero(m, k);
  }
  return torque;
}

static void keep_tendons(ambulo__muscle_reader *r, int all, const double *before) {
  for (int c = 0; c < r->model->coordinate_count; c++) {
    double after = stretching(r, all, c);
    for (int i = 0; i < all && after != before[c]; i++)
      if (r->muscles[i].elastic == c) r->muscles[i].tendon_strain *= after / before[c];
  }
}

static void apply(ambulo__muscle_reader *r, const ambulo__yaml_node *strength, int pair, int all,
                  const char **names) {
  const ambulo__yaml_node *value = ambulo__yaml_value(strength, pair);
  const char *key = ambulo__yaml_key(strength, pair);
  double factor = ambulo__yaml_number_in(value, 0.0, most, 1.0);
  int found = 0;
  if (!(factor > 0.0))
    (void)ambulo__yaml_error(value, AMBULO_E_SCHEMA, NULL, "got '0'; expected above 0, at most 10");
  for (int i = 0; i < all; i++)
    for (int k = 0; k < NAMES; k++) {
      if (strcmp(names[NAMES * i + k], key) != 0) continue;
      r->muscles[i].force *= factor > 0.0 ? factor : 1.0;
      found = 1;
      break;
    }
  if (found) return;
  const char *nearest = ambulo__nearest(key, names, (size_t)(NAMES * all));
  (void)ambulo__yaml_error(value, AMBULO_E_SCHEMA,
                           nearest ? ambulo__arena_print(&r->arena, "did you mean '%s'?", nearest)
                                   : NULL,
                           "no muscle and no group of the muscles is named '%s'", key);
}

void ambulo__muscle_strength(ambulo__muscle_reader *r, const ambulo__yaml_node *section) {
  const ambulo__yaml_node *strength = ambulo__yaml_get(section, "strength");
  int pairs = ambulo__yaml_pairs(strength), all = r->count * (r->suffix[0] ? 2 : 1);
  if (pairs == 0) return;
  const char **names = ambulo__arena_take(&r->arena, (size_t)(NAMES * all), sizeof *names);
  double *before =
      ambulo__arena_take(&r->arena, (size_t)r->model->coordinate_count, sizeof *before);
  if (!names || !before) return;
  for (int i = 0; i < all; i++) names_of(r, i, names + (size_t)(NAMES * i));
  for (int c = 0; c < r->model->coordinate_count; c++) before[c] = stretching(r, all, c);
  for (int pair = 0; pair < pairs; pair++) apply(r, strength, pair, all, names);
  keep_tendons(r, all, before);
}
