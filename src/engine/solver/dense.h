/* solver/dense.h - what happens between the time nodes.
 *
 * Rows are enforced at the nodes. Here the same motion is looked at on a grid `samples` times as
 * fine: every row that such a grid would have, and two quantities that no row covers,
 *
 *   slip          how far a loaded point of a foot moves along the ground away from where the
 *                 nodes have it
 *   ground_force  how far the ground's normal force is from the straight line through its
 *                 values at the nodes
 *
 * Each quantity is a sample: a rule (its family and unit), a place, a time, a value
 * and the tolerance that holds there. Value / tolerance makes them comparable: the ratio.
 *
 *   dense_grid.c      the finer grid and the motion there; where nodes fall beside the times at
 *                     which contacts change; the rules
 *   dense_samples.c   samples, and the worst of each rule
 *   dense_cure.c      the intervals that would bring it under its tolerance
 *   overlaps.c        bodies that overlap, by their exact distance
 *   dense_audit.c     the steps in order, and all of it in words
 */
#ifndef AMBULO_SOLVER_DENSE_H
#define AMBULO_SOLVER_DENSE_H

#include "contact/schedule.h"
#include "solver/result.h"

#include <math.h>

/* The motion x on a finer grid. */
typedef struct ambulo__dense {
  ambulo_allocator allocator;
  const ambulo_problem *problem; /* whose nodes count */
  ambulo_problem *fine;          /* the same trajectory and rows, `samples` times the intervals */
  int samples;                   /* per interval */
  double *channel;               /* [blocks of fine][channels][8] */
  double *row_value;             /* [rows of fine]; only rows on one node */
} ambulo__dense;

/* `samples`, or as many as a problem may have intervals for; 1: there is no finer grid. */
int ambulo__dense_samples(const ambulo_problem *problem, int samples);

/* Evaluates x on a grid that many times as fine. Events of contacts inside (0, T) are moved by
 * `shift` s (0: as they are; less than any is from an end). E_PROBLEM, with the reason in
 * diagnostics: there is no such grid; E_MEMORY. Values may be infinite or NaN. */
ambulo_status ambulo__dense_open(const ambulo_problem *problem, const double *x, int samples,
                                 double shift, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo__dense *dense);
void ambulo__dense_close(ambulo__dense *dense);

static inline double ambulo__dense_channel(const ambulo__dense *dense, int node, int channel) {
  int channels = ambulo__channel_count(&dense->problem->channels);
  return dense->channel[ambulo__lane_index(node, channels, channel)];
}

/* ------------------------------------------------------------------- rules */

/* What is asked of a motion between its nodes, family by family: the one table of tolerances
 * (docs/results.md and include/ambulo/solve.h repeat it). The first two are of what no row covers.
 */
enum { AMBULO__DENSE_RULE_SLIP, AMBULO__DENSE_RULE_FORCE, AMBULO__DENSE_RULES = 26 };

/* What helps where more intervals do not. */
typedef enum ambulo__dense_remedy {
  AMBULO__REMEDY_NONE,
  AMBULO__REMEDY_CONTROL_POINTS, /* joint limits on the control points */
  AMBULO__REMEDY_TOLERANCE,      /* contacts within a tolerance, then more time intervals */
  AMBULO__REMEDY_TRANSFER        /* a load that passes gradually from foot to foot */
} ambulo__dense_remedy;

typedef struct ambulo__dense_rule {
  ambulo__row_kind kind;
  ambulo__measure measure; /* AMBULO__OTHER_MEASURE: any */
  double tolerance;        /* in that, or a share of the limit */
  /* Where two nodes hold a row its ratio goes down with this power of the number of time intervals,
   * at least: with the trajectory's kept; with the trajectory's in proportion. 0: it need not go
   * down at all. */
  double order_alone, order_both;
  /* Beside an event it goes down with the gap to the node: where a contact ends to the first
   * power, where it begins to this one. */
  double order_landing;
  int of_limit;  /* 1: the tolerance is a share */
  int at_events; /* 1: its rows change when a contact begins or ends */
  ambulo__dense_remedy remedy;
} ambulo__dense_rule;

/* 0 <= index < AMBULO__DENSE_RULES */
const ambulo__dense_rule *ambulo__dense_rule_at(int index);
/* The rule of a row; -1: rows on the ends, the same on every grid, and rows of the caller, which
 * are not asked between the nodes. */
int ambulo__dense_rule_of_row(const ambulo__table_row *row);

/* What the violation of a row of limits is compared with: the larger of the coordinate's two
 * bounds. Where both are zero: 1 rad/s or 1 m/s; the body weight, times 0.1 m for a torque. The row
 * belongs to `problem`. */
double ambulo__dense_limit_size(const ambulo_problem *problem, const ambulo__table_row *row);

/* ----------------------------------------------------------------- samples */

/* One value at one time. Names are static or live in the model. */
typedef struct ambulo__dense_sample {
  int rule; /* index of the table */
  const char *family, *subject, *detail, *unit;
  double time, value, tolerance; /* in unit; value >= 0, or not finite */
} ambulo__dense_sample;

/* value / tolerance; NaN where the value is not finite */
static inline double ambulo__dense_ratio(const ambulo__dense_sample *sample) {
  return sample->value * 0.0 == 0.0 ? sample->value / sample->tolerance : (double)NAN;
}

typedef void (*ambulo__dense_visitor)(void *user, const ambulo__dense_sample *sample);

/* Violations of the rows that stand on one node; rows on the ends are the same on every grid. */
void ambulo__dense_rows(const ambulo__dense *dense, ambulo__dense_visitor visit, void *user);
/* Of each loaded point of each foot. */
void ambulo__dense_slip(const ambulo__dense *dense, ambulo__dense_visitor visit, void *user);
/* What is asked of coordinates that nothing drives, at every node: rows hold it at few. */
void ambulo__dense_passive(const ambulo__dense *dense, ambulo__dense_visitor visit, void *user);
/* Of all contacts together and, with ground reaction, of each foot; nothing without contacts. */
void ambulo__dense_force(const ambulo__dense *dense, ambulo__dense_visitor visit, void *user);

/* ------------------------------------------------------------------ events */

/* On an equally spaced grid: from the last of `intervals` + 1 nodes before the event to the event,
 * s: a contact that ends there is not held at a node on the event itself. */
double ambulo__dense_gap_before(double event, double duration, int intervals);
/* From the event to the first node at or after it. */
double ambulo__dense_gap_after(double event, double duration, int intervals);
/* 1 if the interval around `time` has an event after its first node, up to its last. */
int ambulo__dense_near_event(const ambulo__events *events, double time, double duration,
                             int intervals);

/* 1 if a problem's nodes leave a gap beside an event, and `time` lies in the interval of that
 * event; on a grid on events only where the event is no node. */
int ambulo__dense_beside_event(const ambulo_problem *problem, const ambulo__events *events,
                               double time);

/* ------------------------------------------------------------------- worst */

typedef struct ambulo__dense_entry {
  int present;                 /* some sample follows this rule */
  ambulo__dense_sample sample; /* the worst, by its ratio; NaN is worse than any number */
  double ratio;
  double between; /* worst ratio in intervals without an event */
} ambulo__dense_entry;

typedef struct ambulo__dense_worst {
  ambulo__dense_entry entry[AMBULO__DENSE_RULES];
} ambulo__dense_worst;

void ambulo__dense_worst_of(const ambulo__dense *dense, const ambulo__events *events,
                            ambulo__dense_worst *worst);

/* -------------------------------------------------------------------- cure */

/* How many intervals bring which rule under its tolerance, as far as can be predicted. */
typedef struct ambulo__dense_cure {
  int intervals, spline_intervals;       /* 0: no number that is predicted helps any */
  int cured[AMBULO__DENSE_RULES];        /* 1: `intervals` are enough */
  int out_of_reach[AMBULO__DENSE_RULES]; /* 1: more intervals help, but not as few as are tried */
} ambulo__dense_cure;

/* 1: contacts are equations, so that the trajectory needs about as many intervals as time */
int ambulo__dense_is_strict(const ambulo_problem *problem);
/* trajectory.intervals that go with `intervals` time intervals */
int ambulo__dense_spline_intervals(const ambulo_problem *problem, int intervals);

ambulo_status ambulo__dense_cure_find(const ambulo_problem *problem, const double *x,
                                      const ambulo__events *events,
                                      const ambulo__dense_worst *worst,
                                      const ambulo_allocator *allocator, ambulo__dense_cure *cure);

/* ------------------------------------------------------------------ report */

enum {
  AMBULO__DENSE_SETTINGS_SIZE = 160,
  AMBULO__DENSE_LINE_SIZE = 480,
  AMBULO__DENSE_SUMMARY_SIZE = 1200
};

/* The public view and the memory it points into. Names in it are static or live in the model. */
enum { AMBULO__OVERLAPS = 64 };

typedef struct ambulo__dense_report {
  ambulo_dense_audit view;
  ambulo__dense_worst worst;
  int family_rule[AMBULO__DENSE_RULES]; /* whose family each is */
  ambulo_dense_family family[AMBULO__DENSE_RULES];
  char settings[AMBULO__DENSE_RULES][AMBULO__DENSE_SETTINGS_SIZE];
  char advice[AMBULO__DENSE_RULES][AMBULO__DENSE_LINE_SIZE];
  const char *line[AMBULO__DENSE_RULES];
  char line_text[AMBULO__DENSE_RULES][AMBULO__DENSE_LINE_SIZE];
  char summary[AMBULO__DENSE_SUMMARY_SIZE];
  char reason[AMBULO__DENSE_LINE_SIZE];
  ambulo_overlap overlap[AMBULO__OVERLAPS];
} ambulo__dense_report;

/* Bodies that overlap in the motion x, the deepest first: overlap[AMBULO__OVERLAPS], *count.
 * E_MEMORY. (overlaps.c) */
ambulo_status ambulo__overlaps_find(const ambulo_problem *problem, const double *x,
                                    const ambulo_allocator *allocator, ambulo_overlap *overlap,
                                    int *count);

/* Looks at result->x on a grid `samples` times as fine: fills result->dense (families, worst
 * first) and the audit's dense_violation. Where there is no such grid, or it is large and time is
 * up (`in_time` 0), the report says so. E_MEMORY. */
ambulo_status ambulo__dense_audit(const ambulo_problem *problem, int samples, int in_time,
                                  const ambulo_allocator *allocator, ambulo_result *result);

/* After the verdict, for points that satisfy every row at the nodes: what would help, in words,
 * and one warning. `in_time` 0: the intervals that help are not looked for. E_MEMORY. */
ambulo_status ambulo__dense_advise(const ambulo_problem *problem, int in_time,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo_result *result);

/* Settings, advice, lines and the summary of a report whose families are there.
 * `cure`: NULL when nothing was predicted. */
void ambulo__dense_words(const ambulo_problem *problem, ambulo_verdict verdict,
                         const ambulo__dense_cure *cure, ambulo__dense_report *report);

#endif
