/* cli/summary.c - a result as a person reads it: what is the point, how good is it, what did it
 * cost. */
#include "cli/summary.h"

#include <math.h>
#include <stdio.h>

static void print_objective(const ambulo_problem *problem, const ambulo_result *result) {
  int count = ambulo_problem_term_count(problem);
  const double *terms = ambulo_result_terms(result);
  if (count == 0) {
    printf("objective    none (feasibility only)\n");
    return;
  }
  printf("objective    %.8g\n", ambulo_result_objective(result));
  for (int i = 0; i < count; i++)
    printf("  %-24s %.6g\n", ambulo_problem_term_name(problem, i), terms[i]);
}

/* what was free, where it went, and what it brought */
static void print_parameters(const ambulo_result *result) {
  static const char *const bounds[] = {[AMBULO_AT_LOWER] = ", at its lower bound",
                                       [AMBULO_BETWEEN] = "",
                                       [AMBULO_AT_UPPER] = ", at its upper bound"};
  const ambulo_parameters_outcome *o = ambulo_result_parameters(result);
  if (!o) return;
  printf("free parameters\n");
  for (int i = 0; i < o->count; i++) {
    const ambulo_parameter_value *p = &o->items[i];
    printf("  %-24s %.6g %s (%.6g to %.6g; before %.6g)%s\n", p->name, p->value, p->unit, p->lower,
           p->upper, p->first, bounds[p->bound]);
  }
  const char *per = o->per == AMBULO_PER_DISTANCE ? "per metre" : "objective";
  if (!isnan(o->objective)) printf("  %-24s %.6g (before %.6g)\n", per, o->objective, o->first);
  printf("  %-24s %s, %.1f s\n", "outer run", o->ending, o->seconds);
}

static void print_place(const ambulo_violation *v) {
  if (v->subject && v->subject[0]) printf("  %s", v->subject);
  if (v->detail && v->detail[0]) printf(" %s", v->detail);
  printf("  t = %.3f s\n", v->time);
}

static void print_violation(const char *label, const ambulo_violation *v) {
  if (!v->family || !v->family[0]) {
    printf("  %-24s no rows\n", label);
  } else if (!(v->worst > 0.0)) {
    printf("  %-24s none\n", label);
  } else {
    printf("  %-24s %.2e %s  %s", label, v->worst, v->unit, v->family);
    print_place(v);
  }
}

static void print_dense_violation(const ambulo_result *result) {
  static const char label[] = "violation between nodes";
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(result);
  if (dense && dense->samples == 0) {
    printf("  %-24s not known: %s\n", label, dense->reason);
  } else {
    print_violation(label, &ambulo_result_audit(result)->dense_violation);
  }
}

static void print_audit(const ambulo_result *result) {
  const ambulo_audit *audit = ambulo_result_audit(result);
  printf("audit\n");
  print_violation("violation at nodes", &audit->violation);
  print_dense_violation(result);
  printf("  %-24s %.2e%s\n", "KKT residual", audit->kkt,
         audit->at_lower_bound ? "; the objective is at its lower bound, zero" : "");
  printf("  %-24s %d, rank %d", "active rows", audit->active_rows, audit->rank);
  if (audit->dropped_equalities) printf(", %d dependent equalities", audit->dropped_equalities);
  printf("\n");
}

/* families that fail between the nodes, a line each */
static void print_between(const ambulo_result *result) {
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(result);
  if (!dense || dense->line_count == 0) return;
  printf("between the nodes\n");
  for (int i = 0; i < dense->line_count; i++) printf("  %s\n", dense->lines[i]);
}

static void print_families(const ambulo_result *result) {
  int count = ambulo_result_family_count(result);
  if (count == 0) return;
  printf("worst violation by family\n");
  for (int i = 0; i < count; i++) {
    const ambulo_violation *v = ambulo_result_family(result, i);
    printf("  %-24s %.2e %s", v->family, v->worst, v->unit);
    if (v->worst > 0.0) {
      print_place(v);
    } else {
      printf("\n");
    }
  }
}

static void print_explanation(const ambulo_result *result) {
  const ambulo_explanation *e = ambulo_result_explanation(result);
  if (!e) return;
  printf("why there is no solution\n");
  for (int i = 0; i < e->line_count; i++) printf("  %s\n", e->lines[i]);
}

void ambulo__cli_print_last(const ambulo_result *result) {
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(result);
  if (dense && dense->summary[0]) printf("%s\n", dense->summary);
}

/* "grids  64 (trajectory 14): 0.1291, optimal", a line each */
static void print_grids(const ambulo_refinement *refinement) {
  for (int i = 0; refinement && i < refinement->grid_count; i++) {
    const ambulo_refined_grid *g = &refinement->grids[i];
    printf("%-12s %d time intervals, %d of the trajectory: objective %.6g, %s%s%s\n",
           i ? "" : "grids", g->intervals, g->spline_intervals, g->objective,
           ambulo_verdict_name(g->verdict), g->holds ? "" : ", not between the nodes",
           g->kept ? "" : "; not kept");
  }
}

void ambulo__cli_print_resolution(const ambulo_result *result) {
  const ambulo_refinement *refinement = ambulo_result_refinement(result);
  if (!ambulo_verdict_is_solution(ambulo_result_verdict(result))) return;
  if (!refinement || isnan(refinement->resolution)) {
    printf("resolution unknown: --refine tells\n");
    return;
  }
  printf("resolution: the objective %s by an estimated %.2g %% on finer grids\n",
         refinement->resolution < 0.0 ? "rises" : "falls", 100.0 * fabs(refinement->resolution));
}

/* "starts  8, of which 7 hold every row on 30 intervals: 2 motions, 0.0640 (5 times), 0.0712 (2
 * times); the result is from start 3" */
static void print_starts(const ambulo_starts *starts) {
  if (!starts) return;
  printf("starts       %d, of which %d hold every row on %d intervals", starts->count,
         starts->solved, starts->intervals);
  if (starts->basin_count > 0)
    printf(": %d motion%s", starts->basin_count, starts->basin_count == 1 ? "" : "s");
  for (int b = 0; b < starts->basin_count; b++)
    printf(", %.6g (%d times)", starts->basins[b].objective, starts->basins[b].found);
  printf("; the result is from start %d%s\n", starts->chosen,
         starts->chosen ? "" : ", the solver's own");
}

/* the end of the verdict, and a line for each */
static void print_overlaps(const ambulo_result *result) {
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(result);
  int count = dense ? dense->overlap_count : 0;
  if (count > 0) printf("; bodies overlap, by %.3g mm at most", 1e3 * dense->overlaps[0].depth);
  printf("\n");
  for (int i = 0; i < count; i++) {
    const ambulo_overlap *o = &dense->overlaps[i];
    printf("  %s is %.3g mm inside %s at t = %.4g s\n", o->one, 1e3 * o->depth, o->other, o->time);
  }
}

void ambulo__cli_print_result(const ambulo_problem *problem, const ambulo_result *result) {
  ambulo_verdict verdict = ambulo_result_verdict(result);
  const ambulo_timing *timing = ambulo_result_timing(result);
  printf("problem      %s\n", ambulo_problem_name(problem) ? ambulo_problem_name(problem) : "");
  printf("verdict      %s: %s", ambulo_verdict_name(verdict), ambulo_verdict_text(verdict));
  print_overlaps(result);
  print_objective(problem, result);
  print_parameters(result);
  print_audit(result);
  print_families(result);
  print_between(result);
  print_explanation(result);
  printf("size         %d unknowns, %d rows (%d equalities), %d nodes\n",
         ambulo_problem_variable_count(problem), ambulo_problem_row_count(problem),
         ambulo_problem_equality_count(problem), ambulo_problem_node_count(problem));
  printf("effort       %d iterations, %d evaluations, %.3f s (evaluation %.3f, linear algebra "
         "%.3f, NLopt %.3f)\n",
         ambulo_result_iterations(result), ambulo_result_evaluations(result), timing->total,
         timing->evaluate, timing->linear_algebra, timing->nlopt);
  const ambulo_nlopt_work *nlopt = ambulo_result_nlopt(result);
  if (nlopt->calls > 0)
    printf("NLopt        %d calls, %d outer iterations, %d evaluations, last result %s\n",
           nlopt->calls, nlopt->outer, nlopt->inner, nlopt->result_name);
  print_starts(ambulo_result_starts(result));
  print_grids(ambulo_result_refinement(result));
  if (ambulo_result_ending(result)) printf("ending       %s\n", ambulo_result_ending(result));
}

/* shares below this are not worth a line */
static const double least_share = 1e-5;

/* in words, +- its error in per cent of the objective, and as --set takes it */
static void print_sensitivity(const ambulo_sensitivity *s) {
  const char *blank = s->unit[0] ? " " : "";
  double error = fabs(s->share * s->error / s->derivative);
  printf("  %-72s", s->words);
  if (isfinite(error))
    printf("  +-%-8.1g", 100.0 * error);
  else
    printf("  %10s", "");
  if (isnan(s->file_value)) /* an angle of unknown unit */
    printf("  %s, %.6g rad, needs --set angles=degrees\n", s->name, s->value);
  else if (s->file_value == s->value)
    printf("  %s=%.6g%s%s\n", s->name, s->value, blank, s->unit);
  else
    printf("  %s=%.6g (%.6g%s%s)\n", s->name, s->file_value, s->value, blank, s->unit);
}

void ambulo__cli_print_sensitivities(const ambulo_sensitivity_list *list) {
  printf("sensitivities\n");
  if (list->reason[0]) printf("  none: %s\n", list->reason);
  int printed = 0;
  for (; printed < list->count; printed++) {
    if (fabs(list->items[printed].share) < least_share) break; /* the rest is smaller */
    print_sensitivity(&list->items[printed]);
  }
  if (printed < list->count)
    printf("  %d more change the objective by less than %g %%\n", list->count - printed,
           100.0 * least_share);
}

void ambulo__cli_print_metabolic(const ambulo_muscle_values *v) {
  double duration = v->times[v->rows - 1] - v->times[0];
  printf("metabolic    %.2f W/kg gross by Bhargava et al. (2004), %.2f by Umberger et al. (2003)\n",
         v->bhargava, v->umberger);
  if (v->distance > 0.01)
    printf("transport    %.2f and %.2f J/(kg m), gross, at %.2f m/s\n",
           v->bhargava * duration / v->distance, v->umberger * duration / v->distance,
           v->distance / duration);
}

ambulo_status ambulo__cli_print_muscles(const ambulo_problem *problem, const ambulo_result *result,
                                        const ambulo_report_options *report) {
  ambulo_muscle_analysis *analysis = NULL;
  ambulo_status status = ambulo_muscle_analysis_of_result(problem, result, report->muscles,
                                                          report->samples, NULL, NULL, &analysis);
  if (analysis) ambulo__cli_print_metabolic(ambulo_muscle_analysis_values(analysis));
  ambulo_muscle_analysis_free(analysis);
  return status;
}

void ambulo__cli_print_rows(const ambulo_problem *problem, const ambulo_result *result) {
  const double *values = ambulo_result_rows(result);
  const double *multipliers = ambulo_result_multipliers(result);
  printf("rows\n%7s %-20s %-20s %-10s %8s %2s %14s %-6s %12s\n", "row", "family", "subject",
         "detail", "time", "", "value", "unit", "multiplier");
  for (int r = 0; r < ambulo_problem_row_count(problem); r++) {
    ambulo_row row;
    if (ambulo_problem_row(problem, r, &row)) continue;
    printf("%7d %-20s %-20s %-10s %8.4f %2s %14.6e %-6s %12.4e\n", r, row.family, row.subject,
           row.detail, row.time, row.relation == AMBULO_EQUAL ? "=" : ">=", values[r], row.unit,
           multipliers ? multipliers[r] : 0.0);
  }
}
