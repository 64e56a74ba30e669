/* study/fit.h - the inside of a fit: what its file says, in arrays.
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
 * distance's curves, each have a block of residuals (residual.h); those of all fitted conditions,
 * one behind the other, are the vector r [residuals] with
 *
 *     D = r'r = sum_cj weight_c weight_j z_cj / sum_cj weight_c weight_j
 *
 * z_cj being 1 where a curve is off by one standard deviation. What is minimized is the cost
 * D + ridge |u|^2 / parameters.
 *
 * Reading order: fit.h, fit_file.c, fit_conditions.c, fit_distance.c, fit_keys.c, fit_overrides.c,
 * fit_residual.h, fit_trial.h, fit_evaluate.h, fit_search.c, fit_run.c, fitted_problem.h,
 * fit_outcome.h.
 */
#ifndef AMBULO_STUDY_FIT_H
#define AMBULO_STUDY_FIT_H

#include "ambulo/tools/fit.h"
#include "ambulo/tools/report.h"
#include "ambulo/tools/compare.h"
#include "base/alloc.h"
#include "people/compare.h"
#include "formats/yaml_node.h"

enum {
  AMBULO__FIT_PARAMETERS = 64,
  AMBULO__FIT_KEYS = 64, /* of one parameter */
  AMBULO__FIT_CONDITIONS = 32,
  AMBULO__FIT_CURVES = 32
};

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
  AMBULO__FIT_RANGE, /* largest less smallest */
  AMBULO__FIT_PEAK,  /* largest */
  AMBULO__FIT_LOWEST /* smallest */
} ambulo__fit_of;

/* A curve, or a number of one, that the distance counts. */
typedef struct ambulo__fit_curve {
  const char *name, *curve; /* of itself; of the column map */
  ambulo__fit_of of;
  double weight, sd; /* sd 0: that of the reference */
  double from, to;   /* percent of the cycle */
  int centred;       /* 1: less their means */
  const ambulo__yaml_node *node;
} ambulo__fit_curve;

/* A curve of a condition: its reference within `from` and `to`. */
typedef struct ambulo__fit_target {
  int curve; /* of the distance */
  const ambulo__map_entry *entry;
  int points;
  const double *percent, *mean; /* [points] */
  double sd;                    /* in the curve's unit: of the file, root mean square; or given */
  int first, count;             /* its block within the condition's residuals */
} ambulo__fit_target;

typedef struct ambulo__fit_condition {
  const char *name;
  char **set; /* [sets]: "path=value", as --set takes them */
  int sets;
  char *reference; /* path */
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
  int residuals; /* of all fitted conditions */
  double correlation, range_cost, cap;
  ambulo_compare_options compare;
  int iterations;
  double ridge, tolerance;
  double case_seconds;
  int case_megabytes;
  unsigned long long hash; /* of the fit file, the problem's text and the references */
};

/* fit_conditions.c, fit_distance.c: the sections of the file. The document knows the faults;
 * E_MEMORY, E_IO where a file cannot be read. */
ambulo_status ambulo__fit_read_conditions(ambulo_fit *fit, const ambulo__yaml_node *node);
ambulo_status ambulo__fit_read_distance(ambulo_fit *fit, const ambulo__yaml_node *node);
/* fit_conditions.c: the references, once conditions and distance are known. */
ambulo_status ambulo__fit_read_references(ambulo_fit *fit);
/* fit_keys.c: what the keys are by themselves in each condition, and whether the problem can be
 * read with each condition and each bound. */
ambulo_status ambulo__fit_read_keys(ambulo_fit *fit);

/* fit_overrides.c: the factor or addend at u, and a key's value with it, to nine digits. */
double ambulo__fit_change(const ambulo__fit_parameter *parameter, double u);
double ambulo__fit_value(const ambulo__fit_parameter *parameter, double own, double u);
/* The overrides of a condition at u [parameters], as --set takes them: *overrides [*count] in one
 * block, to be freed. E_MEMORY. */
ambulo_status ambulo__fit_overrides(const ambulo_fit *fit, int condition, const double *u,
                                    const char ***overrides, int *count);

#endif
