/* cli/cmd_compare.c - ambulo compare: a result folder against curves of people. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/command.h"
#include "cli/output.h"
#include "cli/shipped.h"

static const double radians_per_degree = 0.017453292519943295;

/* "left=0.1,1.2" of each --strike, separated by ';', into text[size]; a plain number stays alone */
static int read_strikes(const ambulo__cli_input *input, ambulo_compare_options *options, char *text,
                        size_t size) {
  const char *last = ambulo__cli_value(input, "strike");
  if (!last || !strchr(last, '='))
    return ambulo__cli_number(input, "strike", -1e6, 1e6, &options->strike) ? 0 : 2;
  int count, fits = 1;
  const char *const *values = ambulo__cli_values(input, "strike", &count);
  text[0] = '\0';
  for (int i = 0; i < count; i++) {
    size_t used = strlen(text);
    fits = fits && used + strlen(values[i]) + 2 < size;
    if (fits) ambulo__cli_format(text + used, size - used, "%s%s", i > 0 ? ";" : "", values[i]);
  }
  options->strikes = text;
  return fits ? 0
              : ambulo__cli_usage_error("compare", NULL, "--strike has more than %zu characters",
                                        size - 1);
}

static int read_options(const ambulo__cli_input *input, ambulo_compare_options *options) {
  double tilt = options->pelvic_tilt / radians_per_degree;
  options->forces = ambulo__cli_value(input, "forces");
  options->force_columns = ambulo__cli_value(input, "force-columns");
  options->cycles = ambulo__cli_value(input, "cycles");
  options->overwrite = ambulo__cli_flag(input, "force");
  options->map = ambulo__cli_value(input, "map");
  options->curves = ambulo__cli_value(input, "columns");
  options->foot = ambulo__cli_value(input, "foot");
  if (!ambulo__cli_number(input, "pelvic-tilt", -90.0, 90.0, &tilt) ||
      !ambulo__cli_number(input, "mass", 1e-3, 1e6, &options->mass))
    return 2;
  options->pelvic_tilt = tilt * radians_per_degree;
  return 0;
}

/* a number in a column of its own, or a dash */
static void print_number(double value, int decimals) {
  if (isnan(value)) {
    printf(" %9s", "-");
  } else {
    printf(" %9.*f", decimals, value);
  }
}

static void print_curves(const ambulo_comparison *comparison) {
  printf("%-28s %-7s %9s %9s %9s %9s %9s %9s %9s\n", "curve", "unit", "rmse", "r", "in 2 SD %",
         "peak", "at %", "people", "at %");
  for (int i = 0; i < ambulo_comparison_curve_count(comparison); i++) {
    const ambulo_curve_score *s = ambulo_comparison_curve(comparison, i);
    int decimals = s->unit[0] == 'd' ? 1 : 2;
    printf("%-28s %-7s", s->name, s->unit);
    print_number(s->rmse, decimals);
    print_number(s->r, 3);
    print_number(100.0 * s->within_2sd, 0);
    print_number(s->peak, decimals);
    print_number(s->peak_time, 1);
    print_number(s->reference_peak, decimals);
    print_number(s->reference_peak_time, 1);
    printf("\n");
  }
}

/* who the people are, once for all curves that are theirs */
static void print_sources(const ambulo_comparison *comparison) {
  const char *last = NULL;
  for (int i = 0; i < ambulo_comparison_curve_count(comparison); i++) {
    const ambulo_curve_score *s = ambulo_comparison_curve(comparison, i);
    if (!s->source) continue;
    if (s->source == last) {
      printf(", %s", s->name);
    } else {
      printf("\npeople: %s\n  %s", s->source, s->name);
    }
    last = s->source;
  }
  if (last) printf("\n");
}

static void print_landmarks(const ambulo_comparison *comparison) {
  int count = ambulo_comparison_landmark_count(comparison);
  if (count > 0) printf("\n%-28s %-7s %9s %9s\n", "landmark", "unit", "value", "at %");
  for (int i = 0; i < count; i++) {
    const ambulo_landmark *l = ambulo_comparison_landmark(comparison, i);
    printf("%-28s %-7s", l->name, l->unit);
    print_number(l->value, l->unit[0] == 'd' ? 1 : 3);
    print_number(l->time, 1);
    printf("\n");
  }
}

/* against the table that was named, or else the shipped norms */
static ambulo_status compare(const ambulo__cli_input *input, const ambulo_compare_options *options,
                             ambulo_diagnostics *diagnostics, ambulo_comparison **comparison) {
  if (input->argument_count > 1)
    return ambulo_compare(input->arguments[0], input->arguments[1], options, NULL, diagnostics,
                          comparison);
  char folder[4096];
  int found = ambulo__cli_shipped_file("norms", folder, sizeof folder);
  return ambulo_compare_norms(input->arguments[0], found ? folder : "norms", options, NULL,
                              diagnostics, comparison);
}

static int run(const ambulo__cli_input *input) {
  ambulo_compare_options options = ambulo_compare_options_default();
  char strikes[8192];
  int code = read_options(input, &options);
  if (!code) code = read_strikes(input, &options, strikes, sizeof strikes);
  if (code) return code;
  if (options.map && input->argument_count < 2)
    return ambulo__cli_usage_error("compare", NULL,
                                   "--map needs a reference table; expected DIR REFERENCE.csv");
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_comparison *comparison = NULL;
  char *text = NULL;
  ambulo_status status = compare(input, &options, diagnostics, &comparison);
  if (!status && ambulo__cli_flag(input, "json"))
    status = ambulo_comparison_json(comparison, NULL, &text);
  code = ambulo__cli_diagnostics(diagnostics, status, input->arguments[input->argument_count - 1]);
  if (text) {
    fputs(text, stdout);
  } else if (!status) {
    print_curves(comparison);
    print_sources(comparison);
    print_landmarks(comparison);
  }
  ambulo_text_free(text, NULL);
  ambulo_comparison_free(comparison);
  ambulo_diagnostics_free(diagnostics);
  return code;
}

static const ambulo__cli_option options[] = {
    {"json", 0, NULL, "print the scores as JSON"},
    {"map", 0, "FILE", "column map (CSV) instead of the built-in one"},
    {"columns", 0, "NAMES", "only these curves, separated by commas"},
    {"foot", 0, "left|right", "compare one foot (default: the mean of both where they are alike)"},
    {"pelvic-tilt", 0, "DEG", "anterior tilt of the reference's pelvis (default: 11.4)"},
    {"strike", 0, "S|SIDE=S,S,...",
     "time of heel strike of a result (default: from the folder); of a\nrecording all times of a "
     "side, left=0.1,1.2 (default: found)"},
    {"forces", 0, "FILE", "ground forces of a recording (CSV, STO, MOT)"},
    {"force-columns", 0, "MAP",
     "columns of each foot: left=NAME,right=NAME (default: by their names)"},
    {"cycles", 0, "OUT.csv", "write the mean curves over the cycle, with their deviations"},
    {"force", 0, NULL, "let --cycles overwrite any file"},
    {"mass", 0, "KG", "body mass (default: from the folder)"},
};

const ambulo__cli_command ambulo__cli_compare = {
    .name = "compare",
    .arguments = "DIR|MOTION [REFERENCE.csv]",
    .summary = "score a result or a recorded motion against curves of people",
    .description =
        "Prints for each curve the root mean square error, Pearson's r, the share of the cycle\n"
        "within two standard deviations, and the peak with its time in percent of the cycle from\n"
        "heel strike to heel strike; then the landmarks that gait tables quote. Without\n"
        "REFERENCE.csv the reference is the bundled data (models/norms): angles of 24 young "
        "adults,\n"
        "moments and forces of normal cadence. MOTION is a recording (CSV, STO or MOT) with "
        "columns\n"
        "of OpenSim or Plug-in Gait; its strides are averaged. See docs/compare.md.",
    .example = "ambulo compare walk\nambulo compare walk adults.csv",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 1,
    .maximum = 2,
    .run = run,
};
