/* model/contact_check.c - coordinates, points, feet and patches: ranges, drives, pairs,
 * references. */
#include "model/model_check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double LONGEST = 1e6;        /* m */
static const double LARGEST_PATCH = 10.0; /* m */
static const double LARGEST_LIMIT = 1e12; /* rad, m, their rates, N m, N */

/* ------------------------------------------------------------- coordinates */

static ambulo__place place_of_coordinate(const ambulo__checker *c, int index) {
  return ambulo__place_in(c, c->places ? c->places->coordinates : NULL, index);
}

static ambulo_joint_type type_of_coordinate(const ambulo_model_definition *d, int index) {
  for (int i = 0, seen = 0; i < d->link_count; i++) {
    if (ambulo__link_has_coordinate(&d->links[i]) && seen++ == index) return d->links[i].type;
  }
  return AMBULO_FIXED;
}

/* An interval may be unbounded, or one point; never empty or undefined. */
static void check_interval(ambulo__checker *c, int index, const char *what,
                           const double interval[2]) {
  const char *name = c->definition->coordinates[index].name;
  for (int k = 0; k < 2; k++) {
    if (!isfinite(interval[k]) || fabs(interval[k]) <= LARGEST_LIMIT) continue;
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place_of_coordinate(c, index), NULL,
                              "%s limit of coordinate '%s' is out of range (got %s); expected at "
                              "most 1e12, or none",
                              what, name ? name : "", ambulo__number_text(interval[k]).text);
    return;
  }
  if (interval[0] <= interval[1] && interval[0] < INFINITY && interval[1] > -INFINITY) return;
  char in_degrees[80] = "";
  int angle = type_of_coordinate(c->definition, index) == AMBULO_REVOLUTE;
  if (angle && strcmp(what, "torque") != 0 && isfinite(interval[0] - interval[1])) {
    const double degrees = 180.0 / 3.14159265358979323846;
    (void)snprintf(in_degrees, sizeof in_degrees, ", in degrees [%.6g, %.6g]",
                   degrees * interval[0], degrees * interval[1]);
  }
  c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place_of_coordinate(c, index), NULL,
                            "%s limits of coordinate '%s' contradict each other (got [%s, %s]%s); "
                            "expected lower <= upper",
                            what, name ? name : "", ambulo__number_text(interval[0]).text,
                            ambulo__number_text(interval[1]).text, in_degrees);
}

/* 0 is where coordinates stand that nobody gave a default, whatever their range */
static void check_default(ambulo__checker *c, int index) {
  const ambulo_coordinate *self = &c->definition->coordinates[index];
  double value = self->default_value;
  if (value == 0.0 || (value >= self->range[0] && value <= self->range[1] && isfinite(value) &&
                       fabs(value) <= LARGEST_LIMIT))
    return;
  c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place_of_coordinate(c, index), NULL,
                            "the default of coordinate '%s' is out of its range (got %s); expected "
                            "%s to %s",
                            self->name ? self->name : "", ambulo__number_text(value).text,
                            ambulo__number_text(self->range[0]).text,
                            ambulo__number_text(self->range[1]).text);
}

/* ------------------------------------------------------------------ drives */

static int link_of_coordinate(const ambulo_model_definition *d, int index) {
  int link = -1;
  for (int i = 0, seen = 0; i < d->link_count && link < 0; i++) {
    if (d->links[i].type != AMBULO_FIXED && seen++ == index) link = i;
  }
  return link;
}

/* the next link toward the world; -1: there is none. Links may still form a cycle, so that whoever
 * climbs counts. */
static int above(const ambulo_model_definition *d, int link) {
  int parent = d->links[link].parent;
  return parent < d->link_count ? parent : -1;
}

static int carries_every_mass(const ambulo_model_definition *d, int carrier) {
  for (int i = 0; i < d->link_count; i++) {
    int at = i;
    for (int step = 0; step < d->link_count && at >= 0 && at != carrier; step++) at = above(d, at);
    if (at != carrier && d->links[i].mass > 0.0) return 0;
  }
  return 1;
}

/* 1 if some slider has no hinge between itself and the world */
static int is_free(const ambulo_model_definition *d) {
  for (int i = 0; i < d->link_count; i++) {
    if (d->links[i].type != AMBULO_PRISMATIC) continue;
    int at = i;
    for (int step = 0; step <= d->link_count && at >= 0; step++) {
      if (d->links[at].type == AMBULO_REVOLUTE) break;
      at = above(d, at);
    }
    if (at < 0) return 1;
  }
  return 0;
}

static void check_drive(ambulo__checker *c, int index) {
  const ambulo_model_definition *d = c->definition;
  const ambulo_coordinate *self = &d->coordinates[index];
  const struct {
    const char *what, *units[2];
    double value;
  } parts[] = {{"armature", {"kg m^2", "kg"}, self->armature},
               {"damping", {"N m s/rad", "N s/m"}, self->damping},
               {"friction", {"N m", "N"}, self->friction}};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
    const char *unit = parts[i].units[type_of_coordinate(d, index) == AMBULO_PRISMATIC];
    const char *name = self->name ? self->name : "";
    if (parts[i].value == 0.0) continue;
    if (!(parts[i].value > 0.0 && parts[i].value <= LARGEST_LIMIT)) {
      c->status =
          ambulo__error(c->diagnostics, AMBULO_E_MODEL, place_of_coordinate(c, index), NULL,
                        "%s of coordinate '%s' is out of range (got %s %s); expected 0 to "
                        "1e12",
                        parts[i].what, name, ambulo__number_text(parts[i].value).text, unit);
    } else if (!self->actuated && is_free(d) &&
               carries_every_mass(d, link_of_coordinate(d, index))) {
      c->status =
          ambulo__error(c->diagnostics, AMBULO_E_MODEL, place_of_coordinate(c, index), NULL,
                        "coordinate '%s' moves the whole free body, and no joint is there "
                        "to have %s (got %s %s); expected 0",
                        name, parts[i].what, ambulo__number_text(parts[i].value).text, unit);
    }
  }
}

static void report_mirror(ambulo__checker *c, int index, const char *why) {
  const char *name = c->definition->coordinates[index].name;
  c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place_of_coordinate(c, index), NULL,
                            "mirror image of coordinate '%s' %s", name ? name : "", why);
}

static void check_mirror(ambulo__checker *c, int index) {
  const ambulo_model_definition *d = c->definition;
  const ambulo_coordinate *self = &d->coordinates[index];
  int other = self->mirror < 0 ? index : self->mirror;
  if (other >= d->coordinate_count) {
    report_mirror(c, index, "does not exist; expected the index of a coordinate");
    return;
  }
  const ambulo_coordinate *image = &d->coordinates[other];
  if (self->mirror_sign != 1 && self->mirror_sign != -1) {
    report_mirror(c, index, "has a sign that is neither +1 nor -1");
    return;
  }
  if ((image->mirror < 0 ? other : image->mirror) != index) {
    report_mirror(c, index, "has another mirror image itself; expected a pair");
  } else if (image->mirror_sign != self->mirror_sign) {
    report_mirror(c, index, "has another sign; expected the same on both");
  } else if (type_of_coordinate(d, index) != type_of_coordinate(d, other)) {
    report_mirror(c, index, "is of another kind; expected two angles or two displacements");
  }
}

void ambulo__check_coordinates(ambulo__checker *c) {
  for (int i = 0; i < c->definition->coordinate_count; i++) {
    const ambulo_coordinate *coordinate = &c->definition->coordinates[i];
    check_interval(c, i, "range", coordinate->range);
    check_interval(c, i, "speed", coordinate->speed);
    check_interval(c, i, "torque", coordinate->torque);
    check_default(c, i);
    check_drive(c, i);
    check_mirror(c, i);
  }
}

/* -------------------------------------------------- points, feet and patches */

static void check_point(ambulo__checker *c, int index) {
  const ambulo_point *point = &c->definition->points[index];
  ambulo__place place = ambulo__place_in(c, c->places ? c->places->points : NULL, index);
  const char *name = point->name ? point->name : "";
  if (point->link < 0 || point->link >= c->definition->link_count) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "link of point '%s' does not exist (got index %d); expected 0 to %d",
                              name, point->link, c->definition->link_count - 1);
  }
  for (int i = 0; i < 3; i++) {
    if (fabs(point->position[i]) <= LONGEST) continue;
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "position of point '%s' is out of range (got %s m); expected three "
                              "finite numbers up to 1e6 m",
                              name, ambulo__number_text(point->position[i]).text);
    return;
  }
}

int ambulo__foot_is_point(const ambulo_foot *foot) {
  int point = foot->heel_center;
  return foot->toe_center == point && foot->heel[0] == point && foot->toe[0] == point &&
         foot->heel[1] == -1 && foot->toe[1] == -1 && !foot->has_tip && !foot->has_arcs;
}

static int is_point(const ambulo_model_definition *d, int index) {
  return index >= 0 && index < d->point_count;
}

static void check_foot(ambulo__checker *c, int index) {
  const ambulo_model_definition *d = c->definition;
  const ambulo_foot *foot = &d->feet[index];
  ambulo__place place = ambulo__place_in(c, c->places ? c->places->feet : NULL, index);
  const char *name = foot->name ? foot->name : "";
  int good = is_point(d, foot->heel[0]) && is_point(d, foot->toe[0]) &&
             (foot->heel[1] == -1 || is_point(d, foot->heel[1])) &&
             (foot->toe[1] == -1 || is_point(d, foot->toe[1])) && is_point(d, foot->heel_center) &&
             is_point(d, foot->toe_center) && (!foot->has_tip || is_point(d, foot->tip)) &&
             (!foot->has_arcs || (is_point(d, foot->arc[0]) && is_point(d, foot->arc[1])));
  if (!good) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "foot '%s' refers to points that do not exist; expected point "
                              "indices 0 to %d (-1 only for a missing second corner)",
                              name, d->point_count - 1);
  } else if ((foot->heel[1] == -1) != (foot->toe[1] == -1)) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "foot '%s' has two corners at one end and one at the other; "
                              "expected as many at the heel as at the toe",
                              name);
  } else if (!ambulo__foot_is_point(foot) &&
             (foot->heel[0] == foot->heel[1] || foot->toe[0] == foot->toe[1] ||
              foot->heel[0] == foot->toe[0] || foot->heel_center == foot->toe_center)) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "foot '%s' uses one point twice; expected different corners, and "
                              "different centres of heel and toe, or one point for all four",
                              name);
  }
  int mirror = foot->mirror < 0 ? index : foot->mirror;
  if (mirror >= d->foot_count) {
    c->status =
        ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                      "mirror image of foot '%s' does not exist (got index %d)", name, mirror);
  } else if ((d->feet[mirror].mirror < 0 ? mirror : d->feet[mirror].mirror) != index) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "mirror image of foot '%s' has another mirror image itself; "
                              "expected a pair",
                              name);
  }
}

static void check_patch_mirror(ambulo__checker *c, int index, ambulo__place place) {
  const ambulo_model_definition *d = c->definition;
  const ambulo_patch *patch = &d->patches[index];
  const char *name = patch->name ? patch->name : "";
  int mirror = patch->mirror < 0 ? index : patch->mirror;
  if (mirror >= d->patch_count) {
    c->status =
        ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                      "mirror image of patch '%s' does not exist (got index %d)", name, mirror);
  } else if ((d->patches[mirror].mirror < 0 ? mirror : d->patches[mirror].mirror) != index) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "mirror image of patch '%s' has another mirror image itself; "
                              "expected a pair",
                              name);
  }
}

static void check_patch(ambulo__checker *c, int index) {
  const ambulo_model_definition *d = c->definition;
  const ambulo_patch *patch = &d->patches[index];
  ambulo__place place = ambulo__place_in(c, c->places ? c->places->patches : NULL, index);
  const char *name = patch->name ? patch->name : "";
  if (!is_point(d, patch->point))
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "point of patch '%s' does not exist (got index %d); expected 0 to %d",
                              name, patch->point, d->point_count - 1);
  for (int i = 0; i < 2; i++) {
    if (patch->size[i] > 0.0 && patch->size[i] <= LARGEST_PATCH) continue;
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "%s of patch '%s' is out of range (got %s m); expected more than 0, "
                              "at most %g m",
                              i ? "half the width" : "half the length", name,
                              ambulo__number_text(patch->size[i]).text, LARGEST_PATCH);
  }
  for (int f = 0; f < d->foot_count; f++) {
    if (!d->feet[f].name || strcmp(d->feet[f].name, name) != 0) continue;
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "a patch and a foot are both named '%s'; expected different names, "
                              "results are named after them",
                              name);
  }
  check_patch_mirror(c, index, place);
}

void ambulo__check_contacts(ambulo__checker *c) {
  for (int i = 0; i < c->definition->point_count; i++) check_point(c, i);
  for (int i = 0; i < c->definition->foot_count; i++) check_foot(c, i);
  for (int i = 0; i < c->definition->patch_count; i++) check_patch(c, i);
}

/* capsules: links, sizes, mirror pairs. */

static const double CAPSULE_CHECK_LONGEST = 1e6; /* m */
static const double LARGEST_CAPSULE = 10.0;      /* m, of the radius */

static void check_ends(ambulo__checker *c, const ambulo_capsule *capsule, ambulo__place place) {
  for (int i = 0; i < 6; i++) {
    double number = i < 3 ? capsule->from[i] : capsule->to[i - 3];
    if (fabs(number) <= CAPSULE_CHECK_LONGEST) continue;
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "'%s' of capsule '%s' is out of range (got %s m); expected three "
                              "finite numbers up to 1e6 m",
                              i < 3 ? "from" : "to", capsule->name ? capsule->name : "",
                              ambulo__number_text(number).text);
    return;
  }
}

static void capsule_check_check_mirror(ambulo__checker *c, int index, ambulo__place place) {
  const ambulo_model_definition *d = c->definition;
  const ambulo_capsule *capsule = &d->capsules[index];
  const char *name = capsule->name ? capsule->name : "";
  int mirror = capsule->mirror < 0 ? index : capsule->mirror;
  if (mirror >= d->capsule_count) {
    c->status =
        ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                      "mirror image of capsule '%s' does not exist (got index %d)", name, mirror);
  } else if ((d->capsules[mirror].mirror < 0 ? mirror : d->capsules[mirror].mirror) != index) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "mirror image of capsule '%s' has another mirror image itself; "
                              "expected a pair",
                              name);
  }
}

static void check_capsule(ambulo__checker *c, int index) {
  const ambulo_model_definition *d = c->definition;
  const ambulo_capsule *capsule = &d->capsules[index];
  ambulo__place place = ambulo__place_in(c, c->places ? c->places->capsules : NULL, index);
  const char *name = capsule->name ? capsule->name : "";
  if (capsule->link < 0 || capsule->link >= d->link_count)
    c->status =
        ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                      "link of capsule '%s' does not exist (got index %d); expected 0 to %d", name,
                      capsule->link, d->link_count - 1);
  if (!(capsule->radius > 0.0 && capsule->radius <= LARGEST_CAPSULE))
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "radius of capsule '%s' is out of range (got %s m); expected more "
                              "than 0, at most %g m",
                              name, ambulo__number_text(capsule->radius).text, LARGEST_CAPSULE);
  check_ends(c, capsule, place);
  capsule_check_check_mirror(c, index, place);
}

void ambulo__check_capsules(ambulo__checker *c) {
  for (int i = 0; i < c->definition->capsule_count; i++) check_capsule(c, i);
}
