/* model/link_check.c - the tree of links: parents, cycles, DH constants, bodies. */
#include <math.h>
#include <string.h>

#include "model/check.h"

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
