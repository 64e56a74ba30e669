/* contact/bounded.h - a linear form of one node's channels between two bounds: a pair of rows. */
#ifndef AMBULO_CONTACT_BOUNDED_H
#define AMBULO_CONTACT_BOUNDED_H

#include "contact/gait.h"

enum { AMBULO__FORM_TERMS = 12 };

/* constant + sum coefficient * channel */
typedef struct ambulo__linear {
  double constant;
  int count;
  int overflow; /* 1: a term found no room; ambulo__bounded_rows then refuses the form */
  int channel[AMBULO__FORM_TERMS];
  double coefficient[AMBULO__FORM_TERMS];
} ambulo__linear;

/* What a pair of rows is about. Static text, except the subject, which lives in the model. */
typedef struct ambulo__bounded_name {
  ambulo__row_kind kind;
  const char *subject, *lower, *upper;
  ambulo__measure measure;
} ambulo__bounded_name;

/* Adds factor times the components first, first + 1, first + 2 along `direction`. */
void ambulo__linear_add(ambulo__linear *form, int first, const double direction[3], double factor);

/* form - low >= 0 and high - form >= 0; an infinite bound has no row. A form that overflowed makes
 * the table fail with E_INTERNAL. */
void ambulo__bounded_rows(const ambulo__gait_context *context, int node,
                          const ambulo__bounded_name *name, const ambulo__linear *form, double low,
                          double high, ambulo__row_table *table);

/* Derivatives of q that rows look at: places none, forces and the zero-moment point two. */
enum { AMBULO__OF_PLACES = 0, AMBULO__OF_FORCES = 2 };

/* Number of nodes that have rows of contact (`order` AMBULO__OF_PLACES) or force
 * (AMBULO__OF_FORCES): with ground reaction or tolerances and ends that match up to that
 * derivative, the last node is the first one again and has none. */
int ambulo__distinct_nodes(const ambulo__gait_context *context, int order);

/* What the rows of an effector (contact/effector.h) at a node are about: contact[count], indices or
 * -1 in the air. One, but on a grid on events two where a contact begins or ends: that before the
 * node, then that from it on. Of a last node that is the first one again: only what ends there,
 * none otherwise. */
typedef struct ambulo__phases_of_foot {
  int count, contact[2];
} ambulo__phases_of_foot;
ambulo__phases_of_foot ambulo__phases_at(const ambulo__gait_context *context, int order, int node,
                                         int effector);
/* 1 if contact[i] of what ambulo__phases_at gives is that before the node. */
static inline int ambulo__phase_is_before(const ambulo__gait_context *context, int i) {
  return i == 0 && context->before != NULL;
}

#endif
