/* study/fit.h - the inside of a fit.
 *
 * The unknowns are u [parameters], in steps: parameter i stands at
 *
 *     its keys' own values times  exp(step_i u_i)    scale: log
 *     its keys' own values plus        step_i u_i    scale: linear
 *
 * so that u = 0 is the problem as it is, and one step changes a motion visibly. A key's own value
 * is that of the problem file, or what the condition sets it to.
 *
 * A condition c is a set of overrides with reference curves. Its targets j, in the order of the
 * distance's curves, each have a block of residuals (fit_conditions.c); those of all fitted
 * conditions, one behind the other, are the vector r [residuals] with
 *
 *     D = r'r = sum_cj weight_c weight_j z_cj / sum_cj weight_c weight_j
 *
 * z_cj being 1 where a curve is off by one standard deviation. Guards, which bound a number of a
 * curve without any reference, add to the sum above alone, so that one that holds changes nothing;
 * where nothing but guards counts, they are in both. What is minimized is the cost
 * D + ridge |u|^2 / parameters.
 *
 * Files in order: fit_file.c, fit_conditions.c (references as targets), fit_residual.c,
 * fit_values.c (u to numbers of the problem), fit_solves.c (trials as cases of a batch),
 * fit_search.c, fit_run.c, fit_report.c, fit_table.c.
 */
#ifndef AMBULO_STUDY_FIT_H
#define AMBULO_STUDY_FIT_H

#include "ambulo/tools/fit.h"
#include "ambulo/tools/compare.h"
#include "base/alloc.h"
#include "people/compare.h"
#include "base/text_buffer.h"
#include "formats/inputs.h"
#include "formats/yaml_node.h"
#include "study/study.h"

enum {
  AMBULO__FIT_PARAMETERS = 64,
  AMBULO__FIT_KEYS = 64, /* of one parameter */
  AMBULO__FIT_CONDITIONS = 64,
  AMBULO__FIT_CURVES = 32,
  AMBULO__FIT_LABEL = 96
};

/* -------------------------------------------------------------------- the file */

typedef enum ambulo__fit_scale { AMBULO__FIT_LOG, AMBULO__FIT_LINEAR } ambulo__fit_scale;

/* Texts are those of the fit's document. */
typedef struct ambulo__fit_parameter {
  const char *name;
  ambulo__fit_scale scale;
  int keys;
  const char **key; /* [keys] */
  double *own;      /* [conditions][keys]: values of the keys by themselves */
  double *in_file;  /* [keys]: in the problem file; NaN: only conditions set it */
  double range[2];  /* of the factor or the addend */
  double step;
  double lower, upper; /* of u */
  const ambulo__yaml_node *node;
} ambulo__fit_parameter;

/* What of a curve is compared. */
typedef enum ambulo__fit_of {
  AMBULO__FIT_CURVE,
  AMBULO__FIT_RANGE,  /* largest less smallest */
  AMBULO__FIT_PEAK,   /* largest */
  AMBULO__FIT_LOWEST, /* smallest */
  AMBULO__FIT_LARGEST /* largest magnitude */
} ambulo__fit_of;

/* A curve, or a number of one, that the distance counts; as a guard, a number with bounds. */
typedef struct ambulo__fit_curve {
  const char *name, *curve; /* of itself; of the column map */
  ambulo__fit_of of;
  double weight, sd;              /* sd 0: that of the reference */
  double correlation, range_cost; /* of a whole curve: weights of 1 - r and of ln k */
  double from, to;                /* percent of the cycle */
  int centred;                    /* 1: less their means */
  int is_guard;
  double bound[2]; /* of a guard, in the curve's unit: at least, at most; infinite: none */
  const ambulo__map_entry *entry; /* of a guard: in fit->map */
  double *percent;                /* [points] of a guard: every half percent or closer */
  int points;
  const ambulo__yaml_node *node;
} ambulo__fit_curve;

/* A curve of a condition: its reference within `from` and `to`, or a guard. */
typedef struct ambulo__fit_target {
  int curve; /* of the distance */
  const ambulo__map_entry *entry;
  int points;
  const double *percent, *mean; /* [points]; mean NULL: a guard */
  double sd;                    /* in the curve's unit: of the file, root mean square; or given */
  int first, count;             /* its block within the condition's residuals */
} ambulo__fit_target;

typedef struct ambulo__fit_condition {
  const char *name;
  char **set; /* [sets]: "path=value", as --set takes them */
  int sets;
  char *reference; /* path; NULL: all its curves are guards */
  int held_out;    /* 1: does not count; its distance is reported apart */
  double weight;
  int after;                  /* the condition whose solution starts its first solve; -1: zero */
  ambulo__people people;      /* the file of its reference */
  ambulo__fit_target *target; /* [targets] */
  int targets;
  int first, residuals; /* its block in r; of a held-out one first is 0 */
  const ambulo__yaml_node *node, *reference_node, *set_node, *curves_node;
} ambulo__fit_condition;

struct ambulo_fit {
  ambulo_allocator allocator;
  ambulo_diagnostics *diagnostics; /* while loading */
  ambulo__yaml *document;
  char *path, *problem; /* paths */
  const char *name;
  ambulo__fit_parameter *parameter;
  int parameters;
  ambulo__fit_condition *condition;
  int conditions;
  ambulo__fit_curve *curve;
  int curves;
  int residuals;                       /* of all fitted conditions */
  double weights;                      /* that D is divided by */
  double correlation, range_cost, cap; /* the first two of curves without their own */
  ambulo_compare_options compare;
  ambulo__map map; /* of guards */
  int iterations;
  double ridge, tolerance;
  double case_seconds;
  int case_megabytes;
  unsigned long long hash; /* of the fit file, the problem's text, the map and the references */
  char *text;              /* of the problem, [length] */
  size_t length;
  ambulo__text_buffer known; /* files that solves are read from (formats/inputs.h) */
};

/* fit_conditions.c: the number of items or pairs at a node, of which there may be 1 to `most`; 0
 * after an error. `what` they are: "keys". */
int ambulo__fit_count(const ambulo__yaml_node *node, int most, const char *what);
/* The document knows the faults; E_MEMORY, E_IO where a file cannot be read. */
ambulo_status ambulo__fit_read_conditions(ambulo_fit *fit, const ambulo__yaml_node *node);
/* The references, once conditions and distance are known. */
ambulo_status ambulo__fit_read_references(ambulo_fit *fit);

/* fit_values.c: what the keys are by themselves in each condition, and whether the problem can be
 * read with each condition and each bound. Errors as above. */
ambulo_status ambulo__fit_read_keys(ambulo_fit *fit);
/* fit_conditions.c: fit->text, once. Errors: E_IO, E_LIMIT, E_MEMORY. */
ambulo_status ambulo__fit_read_text(ambulo_fit *fit, ambulo_diagnostics *diagnostics);
/* The factor or addend at u, and a key's value with it, to nine digits. */
double ambulo__fit_change(const ambulo__fit_parameter *parameter, double u);
double ambulo__fit_value(const ambulo__fit_parameter *parameter, double own, double u);
/* The overrides of a condition at u [parameters], as --set takes them: *overrides [*count] in one
 * block, to be freed. E_MEMORY. */
ambulo_status ambulo__fit_overrides(const ambulo_fit *fit, int condition, const double *u,
                                    const char ***overrides, int *count);
/* Appends the problem file with the numbers at u [parameters] in place of its own, to be written
 * into `directory`, which exists. The rest of the text stays, comments and all, but for names of
 * other files (`model`, each `reference`), which become those seen from there. Keys that only
 * conditions set are not in it. Errors: as of ambulo__yaml_load; E_IO; E_PROBLEM (the file is no
 * longer what it was); E_MEMORY. */
ambulo_status ambulo__fitted_problem(const ambulo_fit *fit, const double *u, const char *directory,
                                     ambulo_diagnostics *diagnostics, ambulo__text_buffer *text);

/* ---------------------------------------------------------------------- trials */

/* What a target scores; NaN where there is no such thing. */
typedef struct ambulo__fit_score {
  double z;                /* sum of squares of the block, after the cap */
  double rmse;             /* of y - m, not centred; of a number: |difference| */
  double r;                /* NaN: of a number, or y is constant */
  double ratio;            /* k */
  double value, reference; /* of a number; a guard has no reference, rmse and ratio */
} ambulo__fit_score;

/* fit_residual.c: residual [count of the target] of y [points]; y NULL: the solve failed. */
void ambulo__fit_residual(const ambulo_fit *fit, const ambulo__fit_target *target, const double *y,
                          double *residual, ambulo__fit_score *score);
/* The residual of a guard with a number of `value`, and its slope per unit of that. */
double ambulo__fit_guard(const ambulo_fit *fit, const ambulo__fit_target *target, double value,
                         double *slope);
/* What the curves of a condition weigh together: those with a reference, or its guards. */
double ambulo__fit_weight(const ambulo_fit *fit, const ambulo__fit_condition *condition,
                          int of_guards);

/* The problem with its parameters somewhere, solved in every condition. */
typedef struct ambulo__fit_trial {
  double u[AMBULO__FIT_PARAMETERS];  /* in steps */
  double *residual;                  /* [residuals], with their weights */
  double distance, cost;             /* D; with the ridge */
  int index[AMBULO__FIT_CONDITIONS]; /* of the case in the list of solves; -1: none */
  int solved[AMBULO__FIT_CONDITIONS];
  double apart[AMBULO__FIT_CONDITIONS]; /* distance of each by itself; NaN: not evaluated */
  ambulo__fit_score score[AMBULO__FIT_CONDITIONS][AMBULO__FIT_CURVES];
  int complete; /* 0: the run was stopped before it was solved */
  char label[AMBULO__FIT_LABEL];
} ambulo__fit_trial;

/* fit_solves.c: one block of `count` trials, to be freed; u = 0, nothing evaluated. NULL: no
 * memory.
 */
ambulo__fit_trial *ambulo__fit_trials_make(const ambulo_fit *fit, int count,
                                           const ambulo_allocator *allocator);
void ambulo__fit_trial_copy(const ambulo_fit *fit, const ambulo__fit_trial *from,
                            ambulo__fit_trial *to);

/* Which conditions are solved, and what they start from. */
typedef enum ambulo__fit_scope {
  AMBULO__FIT_FITTED,    /* those that count */
  AMBULO__FIT_ALL,       /* the held-out ones too */
  AMBULO__FIT_HELD_OUT,  /* those alone */
  AMBULO__FIT_FROM_ZERO, /* all, each by itself, as `ambulo solve` begins */
  AMBULO__FIT_FRESH      /* those that count, each by itself */
} ambulo__fit_scope;

typedef struct ambulo__fit_runner {
  const ambulo_fit *fit;
  const ambulo_fit_options *options;
  const ambulo_allocator *allocator;
  ambulo_diagnostics *diagnostics;
  char *solves; /* path of the batch folder */
  ambulo_sweep *sweep;
  int points;             /* most of a target */
  double *values, *block; /* [points], [most residuals of a condition] */
  double begin, solving;  /* s; of rounds that computed something */
  int before;             /* cases of earlier rounds */
  int computed;           /* solves of this run */
  int warned;             /* 1: warnings about motions were passed on */
  int wish;               /* of the caller: 1, 2: stop */
  ambulo_fit_progress progress;
} ambulo__fit_runner;

/* Fills *runner; ambulo__fit_runner_close releases it, filled or not. Errors as of
 * ambulo_sweep_load. */
ambulo_status ambulo__fit_runner_open(const ambulo_fit *fit, const char *directory,
                                      const ambulo_fit_options *options,
                                      const ambulo_allocator *allocator,
                                      ambulo_diagnostics *diagnostics, ambulo__fit_runner *runner);
void ambulo__fit_runner_close(ambulo__fit_runner *runner);
/* Solves and scores trials; from: the one whose solutions they start from (NULL: zero, or `after`).
 * Errors: as of ambulo_batch_run; E_PROBLEM (a motion lacks a curve). */
ambulo_status ambulo__fit_evaluate(ambulo__fit_runner *runner, ambulo__fit_scope scope,
                                   const ambulo__fit_trial *from, ambulo__fit_trial *trials,
                                   int count);
/* Puts the solutions of `fresh`, of the same parameters, in place of those whose objective is
 * greater, or that are none, in the conditions that both have. Errors: E_IO, E_MEMORY. */
ambulo_status ambulo__fit_take_better(const ambulo__fit_runner *runner,
                                      const ambulo__fit_trial *fresh, ambulo__fit_trial *trial);
/* Solves the conditions that count once more from zero, where the trial stands, and takes what is
 * better: a problem predicts its least objective, wherever the fit came from. Errors as above. */
ambulo_status ambulo__fit_refresh(ambulo__fit_runner *runner, ambulo__fit_trial *trial);
/* What the record of a solve says; "missing" where there is none. */
ambulo_status ambulo__fit_state(const ambulo__fit_runner *runner, int index, char state[24]);

/* ---------------------------------------------------------------------- search */

/* What became of an iteration. */
typedef struct ambulo__fit_step {
  double distance, cost; /* of the best trial after it */
  double damping;        /* of the accepted candidate; NaN: none */
  int dropped;           /* columns of the Jacobian that are no derivatives */
  const char *accepted;  /* "candidate", "difference", "none", "start" */
} ambulo__fit_step;

/* What the search is given. */
typedef struct ambulo__fit_task {
  const ambulo_fit *fit;
  const ambulo_allocator *allocator;
  /* Fills residual, distance, index, solved of count trials, each started from the solutions of
   * `from`. A stop of the caller leaves some of them not complete. */
  ambulo_status (*evaluate)(void *user, const ambulo__fit_trial *from, ambulo__fit_trial *trials,
                            int count);
  /* ambulo__fit_refresh: the distance may rise. */
  ambulo_status (*refresh)(void *user, ambulo__fit_trial *best);
  /* After each iteration. */
  ambulo_status (*note)(void *user, const ambulo__fit_step *step);
  void *user;
} ambulo__fit_task;

/* Cost of an evaluated trial: D + ridge |u|^2 / parameters. */
double ambulo__fit_cost(const ambulo_fit *fit, const ambulo__fit_trial *trial);
/* fit_search.c: from *best, an evaluated trial, to a better one. sensitivity [parameters]:
 * |dr/du_i| where it was found last; NaN where it was not. *stuck: the condition whose solves all
 * failed. Errors: what evaluate, refresh and note return, E_MEMORY. */
ambulo_status ambulo__fit_search(const ambulo__fit_task *task, ambulo__fit_trial *best,
                                 double *sensitivity, ambulo_fit_ending *ending, int *stuck);

/* --------------------------------------------------------------------- results */

typedef struct ambulo__fit_entry {
  ambulo__fit_step step;
  int solves; /* so far */
} ambulo__fit_entry;

typedef struct ambulo__fit_outcome {
  const ambulo_fit *fit;
  ambulo__fit_runner *runner;
  ambulo__fit_trial *trial; /* [4]: first, best, held-out ones at best, best from zero */
  double sensitivity[AMBULO__FIT_PARAMETERS];
  ambulo__fit_entry *entry; /* [entries] the course, entry 0 being the start */
  int entries;
  ambulo_fit_ending ending;
  int stuck; /* the condition whose solves all failed; -1 */
} ambulo__fit_outcome;

enum { AMBULO__FIT_FIRST, AMBULO__FIT_BEST, AMBULO__FIT_APART, AMBULO__FIT_COLD };

/* fit_report.c: about how many solves a fit takes, when none is in the folder yet. */
int ambulo__fit_expected(const ambulo_fit *fit);
/* Appends fit.json. Errors: E_MEMORY. */
ambulo_status ambulo__fit_json(const ambulo__fit_outcome *outcome, ambulo__text_buffer *text);
/* The trial that scores a condition after the fit: that of the held-out ones is another. */
const ambulo__fit_trial *ambulo__fit_after(const ambulo__fit_outcome *outcome, int condition);
/* -1, 1: parameter i of the best trial is at its lower, its upper bound; 0: between. */
int ambulo__fit_bound(const ambulo__fit_outcome *outcome, int i);
const char *ambulo__fit_ending_name(ambulo_fit_ending ending);
/* fit_table.c: appends the table for people. */
void ambulo__fit_table(const ambulo__fit_outcome *outcome, ambulo__text_buffer *text);

#endif
