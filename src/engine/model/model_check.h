/* model/model_check.h - the checks of a model and of its definition. */
#ifndef AMBULO_MODEL_MODEL_CHECK_H
#define AMBULO_MODEL_MODEL_CHECK_H

#include "base/diagnostics.h"
#include "base/numtext.h"
#include "model/model.h"

enum {
  AMBULO__MAX_LINKS = 4096,
  AMBULO__MAX_POINTS = 4096,
  AMBULO__MAX_FEET = 64,
  AMBULO__MAX_PATCHES = 64,
  AMBULO__MAX_CAPSULES = 256,
  AMBULO__MAX_PARTS = 256, /* bodies merged into one link */
  AMBULO__MAX_NAME = 64
};

/* A body that could exist: mass finite and in range, centre of mass finite, inertia
 * [xx yy zz xy xz yz] positive semidefinite with principal moments that obey the
 * triangle inequality. `what` names it in messages; the places are those of the mass and of
 * the inertia. Reports at most one error. */
typedef struct ambulo__body_places {
  ambulo__place mass, inertia;
} ambulo__body_places;
ambulo_status ambulo__check_body(const char *what, double mass, const double com[3],
                                 const double inertia[6], ambulo__body_places places,
                                 ambulo_diagnostics *diagnostics);

/* Eigenvalues of a symmetric 3x3 matrix [xx yy zz xy xz yz], ascending. */
void ambulo__principal_moments(const double inertia[6], double moments[3]);

/* What a check needs, and its verdict so far. */
typedef struct ambulo__checker {
  const ambulo_model_definition *definition;
  const ambulo__model_places *places; /* may be NULL */
  ambulo_diagnostics *diagnostics;
  ambulo_status status;
} ambulo__checker;

/* 1: a joint that moves by a coordinate of its own. */
static inline int ambulo__link_has_coordinate(const ambulo_link *link) {
  return link->type != AMBULO_FIXED && link->coupled_to < 0;
}

static inline ambulo__place ambulo__place_of_model(const ambulo__checker *c) {
  return c->places ? c->places->model : (ambulo__place){0};
}
/* list[index]; that of the model where there is no list. */
static inline ambulo__place ambulo__place_in(const ambulo__checker *c, const ambulo__place *list,
                                             int index) {
  return list ? list[index] : ambulo__place_of_model(c);
}
static inline ambulo__place ambulo__place_of_link(const ambulo__checker *c, int link) {
  return ambulo__place_in(c, c->places ? c->places->links : NULL, link);
}

/* Parents exist, no cycles; DH constants; bodies. */
void ambulo__check_links(ambulo__checker *c);
/* Ranges ordered, mirror pairs mutual. */
void ambulo__check_coordinates(ambulo__checker *c);
/* Points on links, feet and patches on points. */
void ambulo__check_contacts(ambulo__checker *c);
/* Capsules: links, sizes, mirror pairs. */
void ambulo__check_capsules(ambulo__checker *c);

/* several rigid bodies as one. */

/* A rigid body: mass, centre of mass, inertia about it [xx yy zz xy xz yz]. */
typedef struct ambulo__part {
  double mass, com[3], inertia[6];
} ambulo__part;

/* Adds `part` to `whole` by the parallel-axis theorem. */
void ambulo__part_add(ambulo__part *whole, const ambulo__part *part);

#endif
