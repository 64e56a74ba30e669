/* solver/event_rates.h - what goes along when one event of the contacts moves.
 *
 * An event is a time inside (0, T) at which contacts begin or end (contact/phases.h). With it move
 * the times of these contacts, the times in swings that depend on them, and nodes and knots in
 * between: rates, s per s. */
#ifndef AMBULO_SOLVER_EVENT_RATES_H
#define AMBULO_SOLVER_EVENT_RATES_H

#include "contact/phases.h"
#include "linear/pool.h"
#include "problem/nlp.h"

typedef struct ambulo__event_map {
  const ambulo_problem *problem;
  ambulo__events contacts, rows; /* of each kind */
  ambulo__events knots;          /* those of contacts that have a knot */
  int *of_contact;               /* [contacts][2]: the event of from and to; -1: 0, T or beyond */
  /* of each of rows: its time is a sum of up to two events', times these factors */
  int *source;    /* [rows][2]; -1: none */
  double *factor; /* [rows][2] */
  int *unclear;   /* [contacts.count]: 1: another time is there too, which does not go along */
} ambulo__event_map;

/* Memory from `pool`. E_MEMORY. */
ambulo_status ambulo__event_map_create(const ambulo_problem *problem, ambulo__pool *pool,
                                       ambulo__event_map *map);
/* Rates of nodes [nodes], of breakpoints [intervals + 1] when `event` moves. */
void ambulo__event_node_rates(const ambulo__event_map *map, int event, double *rates);
void ambulo__event_knot_rates(const ambulo__event_map *map, int event, double *rates);

/* A time of what hands hold, on a grid on events. */
typedef enum ambulo__hold_time {
  AMBULO__TIME_FROM,
  AMBULO__TIME_TO,
  AMBULO__TIME_RAMP
} ambulo__hold_time;
/* Rates of nodes when it moves; no knot goes along. 0: something else is there too. */
int ambulo__event_hold_rates(const ambulo__event_map *map, int hold, ambulo__hold_time which,
                             double *rates);

#endif
