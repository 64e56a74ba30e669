/* model/model_check.c - what every definition must satisfy: sizes, names, the world. */
#include "model/model_check.h"
#include "model/coupling.h"

#include <math.h>
#include <string.h>

/* ------------------------------------------------------------------- sizes */

static int counts_are_sane(const ambulo_model_definition *d) {
  return d->link_count >= 0 && d->coordinate_count >= 0 && d->point_count >= 0 &&
         d->foot_count >= 0 && d->patch_count >= 0 && d->capsule_count >= 0 &&
         (d->capsules || d->capsule_count == 0) && (d->links || d->link_count == 0) &&
         (d->coordinates || d->coordinate_count == 0) && (d->points || d->point_count == 0) &&
         (d->feet || d->foot_count == 0) && (d->patches || d->patch_count == 0);
}

static ambulo_status check_sizes(ambulo__checker *c) {
  const ambulo_model_definition *d = c->definition;
  ambulo__place place = ambulo__place_of_model(c);
  if (!counts_are_sane(d)) return AMBULO_E_ARGUMENT;
  const struct {
    const char *kind;
    int count, limit;
  } sizes[] = {{"links", d->link_count, AMBULO__MAX_LINKS},
               {"coordinates", d->coordinate_count, AMBULO__MAX_LINKS},
               {"points", d->point_count, AMBULO__MAX_POINTS},
               {"feet", d->foot_count, AMBULO__MAX_FEET},
               {"patches", d->patch_count, AMBULO__MAX_PATCHES},
               {"capsules", d->capsule_count, AMBULO__MAX_CAPSULES}};
  for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
    if (sizes[i].count <= sizes[i].limit) continue;
    return ambulo__error(c->diagnostics, AMBULO_E_LIMIT, place, NULL,
                         "too many %s (got %d); expected at most %d", sizes[i].kind, sizes[i].count,
                         sizes[i].limit);
  }
  int joints = 0;
  for (int i = 0; i < d->link_count; i++) joints += ambulo__link_has_coordinate(&d->links[i]);
  if (joints == 0) {
    return ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                         "the model cannot move (got %d links, none revolute or prismatic); "
                         "expected at least one joint",
                         d->link_count);
  }
  if (joints != d->coordinate_count) {
    return ambulo__error(
        c->diagnostics, AMBULO_E_MODEL, place, NULL,
        "one coordinate belongs to each revolute or prismatic link that is not coupled (got %d "
        "coordinates for %d such links)",
        d->coordinate_count, joints);
  }
  return AMBULO_OK;
}

/* ------------------------------------------------------------------- names */

typedef const char *(*name_getter)(const ambulo_model_definition *definition, int index);

static int is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.';
}

static int is_name(const char *text) {
  size_t length = 0;
  if (!text) return 0;
  for (; text[length]; length++) {
    if (!is_name_character(text[length]) || length == AMBULO__MAX_NAME) return 0;
  }
  return length > 0;
}

/* a model's name is a title: it may hold spaces, but no control characters */
static int is_title(const char *text) {
  size_t length = 0;
  if (!text) return 0;
  for (; text[length]; length++) {
    unsigned char c = (unsigned char)text[length];
    if (c < 0x20 || c == 0x7f || length == AMBULO__MAX_NAME) return 0;
  }
  return length > 0;
}

static void report_name(ambulo__checker *c, const char *kind, const char *name,
                        ambulo__place place) {
  c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                            "%s name is not allowed (got '%.80s'); expected 1 to %d letters, "
                            "digits, '_', '-' or '.'",
                            kind, name ? name : "", (int)AMBULO__MAX_NAME);
}

static void report_duplicate(ambulo__checker *c, const char *kinds, const char *name,
                             ambulo__place first, ambulo__place second) {
  if (first.line > 0) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, second, NULL,
                              "two %s are named '%s' (the first one at line %d); expected "
                              "different names",
                              kinds, name, first.line);
  } else {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, second, NULL,
                              "two %s are named '%s'; expected different names", kinds, name);
  }
}

static void check_names(ambulo__checker *c, const char *kind, const char *kinds, int count,
                        name_getter name_of, const ambulo__place *places) {
  for (int i = 0; i < count; i++) {
    const char *name = name_of(c->definition, i);
    ambulo__place place = ambulo__place_in(c, places, i);
    if (!is_name(name)) {
      report_name(c, kind, name, place);
      continue;
    }
    for (int k = 0; k < i; k++) {
      const char *other = name_of(c->definition, k);
      if (!other || strcmp(name, other) != 0) continue;
      report_duplicate(c, kinds, name, ambulo__place_in(c, places, k), place);
      break;
    }
  }
}

static const char *link_name(const ambulo_model_definition *d, int i) {
  return d->links[i].name;
}
static const char *point_name(const ambulo_model_definition *d, int i) {
  return d->points[i].name;
}
static const char *foot_name(const ambulo_model_definition *d, int i) {
  return d->feet[i].name;
}

static const char *patch_name(const ambulo_model_definition *d, int i) {
  return d->patches[i].name;
}

static const char *capsule_name(const ambulo_model_definition *d, int i) {
  return d->capsules[i].name;
}

static const char *coordinate_name(const ambulo_model_definition *d, int i) {
  return d->coordinates[i].name;
}

static void check_all_names(ambulo__checker *c) {
  const ambulo_model_definition *d = c->definition;
  const ambulo__model_places none = {0}, *p = c->places ? c->places : &none;
  if (!is_title(d->name)) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, ambulo__place_of_model(c), NULL,
                              "model name is not allowed (got '%.80s'); expected 1 to %d printable "
                              "characters",
                              d->name ? d->name : "", (int)AMBULO__MAX_NAME);
  }
  check_names(c, "link", "links", d->link_count, link_name, p->links);
  check_names(c, "coordinate", "coordinates", d->coordinate_count, coordinate_name, p->coordinates);
  check_names(c, "point", "points", d->point_count, point_name, p->points);
  check_names(c, "foot", "feet", d->foot_count, foot_name, p->feet);
  check_names(c, "patch", "patches", d->patch_count, patch_name, p->patches);
  check_names(c, "capsule", "capsules", d->capsule_count, capsule_name, p->capsules);
}

/* --------------------------------------------------------------- the world */

static void check_world(ambulo__checker *c) {
  const double *g = c->definition->gravity, *f = c->definition->forward;
  ambulo__place place = ambulo__place_of_model(c);
  double gg = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
  double ff = f[0] * f[0] + f[1] * f[1] + f[2] * f[2];
  double gf = g[0] * f[0] + g[1] * f[1] + g[2] * f[2];
  if (!isfinite(gg) || sqrt(gg) < 1e-9 || sqrt(gg) > 1e6) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "gravity must be finite and not zero, it tells what is up (got "
                              "[%s, %s, %s]); expected a vector such as [0, -9.81, 0]",
                              ambulo__number_text(g[0]).text, ambulo__number_text(g[1]).text,
                              ambulo__number_text(g[2]).text);
    return;
  }
  if (!isfinite(ff) || ff < 1e-18 || ff * gg - gf * gf < 1e-12 * ff * gg) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "the walking direction `forward` must not be zero or vertical (got "
                              "[%s, %s, %s]); expected a horizontal vector such as [1, 0, 0]",
                              ambulo__number_text(f[0]).text, ambulo__number_text(f[1]).text,
                              ambulo__number_text(f[2]).text);
  }
  double stature = c->definition->stature;
  if (!isnan(stature) && !(stature > 0 && stature <= 100)) {
    c->status =
        ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                      "stature is out of range (got %s); expected up to 100 m, or AMBULO_OFF",
                      ambulo__number_text(stature).text);
  }
}

ambulo_status ambulo__model_check(const ambulo_model_definition *definition,
                                  const ambulo__model_places *places,
                                  ambulo_diagnostics *diagnostics) {
  ambulo__checker c = {definition, places, diagnostics, AMBULO_OK};
  if (!definition) return AMBULO_E_ARGUMENT;
  ambulo_status sizes = check_sizes(&c);
  if (sizes != AMBULO_OK) return sizes;
  check_all_names(&c);
  check_world(&c);
  ambulo__check_links(&c);
  ambulo__check_coordinates(&c);
  ambulo__check_contacts(&c);
  ambulo__check_capsules(&c);
  return c.status;
}

/* the tree of links: parents, cycles, DH constants, bodies. */

static const char *name_of(const ambulo__checker *c, int link) {
  const char *name = c->definition->links[link].name;
  return name ? name : "";
}

static int check_parents(ambulo__checker *c) {
  const ambulo_model_definition *d = c->definition;
  int good = 1;
  for (int i = 0; i < d->link_count; i++) {
    int parent = d->links[i].parent;
    if (parent >= -1 && parent < d->link_count) continue;
    good = 0;
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, ambulo__place_of_link(c, i), NULL,
                              "parent of link '%s' does not exist (got index %d); expected -1 "
                              "(the world) to %d",
                              name_of(c, i), parent, d->link_count - 1);
  }
  return good;
}

/* Appends "name" or "-name"; what does not fit ends in "...". */
static void append_name(char *text, size_t size, const char *name) {
  size_t used = strlen(text), more = strlen(name);
  if (used + more + 5 > size) {
    if (used >= 3 && strcmp(text + used - 3, "...") != 0) memcpy(text + used, "...", 4);
    return;
  }
  if (used > 0) text[used++] = '-';
  memcpy(text + used, name, more + 1);
}

static void report_cycle(ambulo__checker *c, int first) {
  const ambulo_link *links = c->definition->links;
  char text[400] = "";
  int i = first;
  do {
    append_name(text, sizeof text, name_of(c, i));
    i = links[i].parent;
  } while (i != first);
  append_name(text, sizeof text, name_of(c, first));
  c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, ambulo__place_of_link(c, first), NULL,
                            "the links form a cycle (%s, each the child of the next); expected a "
                            "tree",
                            text);
}

/* Climbing from a link ends at the world, or goes on for ever: then, after as many steps as
 * there are links, one stands on the cycle. */
static void check_cycles(ambulo__checker *c) {
  const ambulo_model_definition *d = c->definition;
  for (int i = 0; i < d->link_count; i++) {
    int at = i;
    for (int step = 0; step < d->link_count && at >= 0; step++) at = d->links[at].parent;
    if (at < 0) continue;
    int first = at;
    for (int k = d->links[at].parent; k != at; k = d->links[k].parent) {
      if (k < first) first = k;
    }
    report_cycle(c, first);
    return;
  }
}

/* what is wrong with the points of a spline; NULL: nothing */
static const char *fault_of_spline(const ambulo_link *link) {
  const double *points = link->knots ? link->knots[0] : NULL;
  if (link->knot_count < 2 || link->knot_count > AMBULO__MOST_KNOTS || !points)
    return "expected 2 to 1024 points";
  for (int k = 0; k < 2 * link->knot_count; k++) {
    if (!isfinite(points[k]) || fabs(points[k]) > 1e6) return "expected finite numbers up to 1e6";
    if (k >= 2 && k % 2 == 0 && points[k] - points[k - 2] < 1e-9)
      return "expected coordinates that rise from point to point, by 1e-9 or more";
  }
  return NULL;
}

static const char *fault_of_polynomial(const ambulo_link *link) {
  for (int k = 0; k < AMBULO__COUPLING_TERMS; k++)
    if (!isfinite(link->polynomial[k]) || fabs(link->polynomial[k]) > 1e9)
      return "expected finite numbers up to 1e9";
  return NULL;
}

static void check_coupling(ambulo__checker *c, int i) {
  const ambulo_link *link = &c->definition->links[i];
  ambulo__place place = ambulo__place_of_link(c, i);
  if (link->coupled_to < 0) return;
  if (link->type == AMBULO_FIXED) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "link '%s' is coupled, but fixed; expected revolute or prismatic",
                              name_of(c, i));
  }
  if (link->coupled_to >= c->definition->coordinate_count) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                              "link '%s' is coupled to a coordinate that does not exist (got index "
                              "%d); expected 0 to %d",
                              name_of(c, i), link->coupled_to, c->definition->coordinate_count - 1);
  }
  const char *fault = link->knot_count != 0 ? fault_of_spline(link) : fault_of_polynomial(link);
  if (!fault) return;
  c->status =
      ambulo__error(c->diagnostics, AMBULO_E_MODEL, place, NULL,
                    "the function of coupled link '%s' is not usable (its %s has %d "
                    "numbers); %s",
                    name_of(c, i), link->knot_count != 0 ? "spline" : "polynomial",
                    link->knot_count != 0 ? 2 * link->knot_count : AMBULO__COUPLING_TERMS, fault);
}

static void check_link(ambulo__checker *c, int i) {
  const ambulo_link *link = &c->definition->links[i];
  const double dh[4] = {link->theta, link->d, link->a, link->alpha};
  for (int k = 0; k < 4; k++) {
    static const char *const names[] = {"theta", "d", "a", "alpha"};
    if (isfinite(dh[k]) && fabs(dh[k]) <= 1e6) continue;
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, ambulo__place_of_link(c, i), NULL,
                              "DH constant %s of link '%s' is out of range (got %s); expected a "
                              "finite number up to 1e6",
                              names[k], name_of(c, i), ambulo__number_text(dh[k]).text);
  }
  if (link->type != AMBULO_FIXED && link->type != AMBULO_REVOLUTE &&
      link->type != AMBULO_PRISMATIC) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, ambulo__place_of_link(c, i), NULL,
                              "the joint type of link '%s' is %s (got %d); expected fixed, "
                              "revolute or prismatic",
                              name_of(c, i), link->type ? "unknown" : "not set", (int)link->type);
  }
  check_coupling(c, i);
  int has_inertia = 0;
  for (int k = 0; k < 6; k++) has_inertia |= link->inertia[k] != 0;
  if (link->mass == 0 && !has_inertia) return; /* no body */
  ambulo__place place = ambulo__place_of_link(c, i);
  ambulo_status status = ambulo__check_body(name_of(c, i), link->mass, link->com, link->inertia,
                                            (ambulo__body_places){place, place}, c->diagnostics);
  if (status != AMBULO_OK) c->status = status;
}

void ambulo__check_links(ambulo__checker *c) {
  int bodies = 0;
  for (int i = 0; i < c->definition->link_count; i++) {
    check_link(c, i);
    bodies += c->definition->links[i].mass != 0;
  }
  if (bodies == 0) {
    c->status = ambulo__error(c->diagnostics, AMBULO_E_MODEL, ambulo__place_of_model(c), NULL,
                              "the model has no mass; expected at least one link with a body");
  }
  if (check_parents(c)) check_cycles(c);
}
