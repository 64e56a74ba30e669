/* contact/phases.h - the times at which contacts change, and grids that have a node at each of
 * them.
 *
 * A phase is what lies between two neighbouring events. A grid on events has nodes at all events
 * and equally spaced ones within each phase, so that no row appears or vanishes when an event
 * moves: it moves with its node. */
#ifndef AMBULO_CONTACT_PHASES_H
#define AMBULO_CONTACT_PHASES_H

#include "base/diagnostics.h"
#include "ambulo/problem.h"
#include "base/alloc.h"
#include "contact/contacts.h"

/* Inside (0, T), rising and apart by more than 1e-9 s. */
typedef struct ambulo__events {
  int count;
  double *time; /* [count] */
} ambulo__events;

typedef enum ambulo__event_kind {
  AMBULO__EVENTS_OF_CONTACTS, /* starts and ends of contacts */
  AMBULO__EVENTS_OF_ROWS      /* and where in a swing the foot's tip has to clear the ground, and
                                 where the foot comes to edges of steps and is past them; and
                                 when points have to be at places */
} ambulo__event_kind;

/* Freed with ambulo__free(allocator, events->time). Contacts need not be legal. E_MEMORY. */
ambulo_status ambulo__events_create(const ambulo_problem_definition *definition,
                                    ambulo__event_kind kind, const ambulo_allocator *allocator,
                                    ambulo__events *events);

/* In the swing of `foot` beside `time` its tip has to clear the ground from air->from + tip_from
 * (air->to - air->from) on, which this returns. */
double ambulo__tip_time(const ambulo_problem_definition *definition, int foot, double time,
                        ambulo__span *air);
/* When it comes to the first edge of a step on its way, and when it is past the last one, fixed
 * shares of the time in the air. Returns 2; 0 if there is no step. */
int ambulo__edge_times(const ambulo_problem_definition *definition, int foot, ambulo__span air,
                       double time[2]);
/* 1 if the definition has rows on the tips of feet. Contacts need not be legal. */
int ambulo__has_tip_rows(const ambulo_problem_definition *definition);
/* The event at `time`, -1: there is none. */
int ambulo__event_at(const ambulo__events *events, double time);

/* Fewest intervals of a phase: of the time nodes, and of the trajectory. */
enum {
  AMBULO__LEAST_NODE_INTERVALS = 2,
  AMBULO__WANTED_NODE_INTERVALS = 4, /* of contacts that share the load, where there are enough */
  AMBULO__LEAST_KNOT_INTERVALS = 1
};

/* Fewest intervals of the trajectory that a definition's knots have room for; 1 where they are
 * uniform. E_MEMORY. */
ambulo_status ambulo__knots_least(const ambulo_problem_definition *definition,
                                  const ambulo_allocator *allocator, int *intervals);

/* Distributes `intervals` over the phases of [0, duration], at least `least` to each, the others in
 * proportion to duration (largest remainder): times[intervals + 1]. In each phase they stand at
 * s - grade sin(2 pi s) / 2 pi of its length, s = 0, 1/n ... 1: 0 equally spaced; near 1 dense
 * beside the events, where forces that begin and end bend most. E_LIMIT: fewer than least *
 * (events->count + 1); E_MEMORY. */
#define AMBULO__NODE_GRADE 0.8
ambulo_status ambulo__phase_grid(const ambulo__events *events, double duration, int intervals,
                                 int least, double grade, const ambulo_allocator *allocator,
                                 double *times);

/* The time nodes of a definition, times[intervals + 1], s. Errors: E_PROBLEM, named in
 * `diagnostics`: more phases than there are intervals for; E_MEMORY. */
ambulo_status ambulo__node_times(const ambulo_problem_definition *definition,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 double *times);
/* The breakpoints of a trajectory of `intervals` with knots on events, times[intervals + 1]. Of
 * events that are closer to one another, to 0 or to T than a fifth of the mean knot interval, T /
 * intervals, the first has the knot: between knots that nearly coincide accelerations could be
 * anything. */
ambulo_status ambulo__knot_times(const ambulo_problem_definition *definition, int intervals,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 double *times);

#endif
