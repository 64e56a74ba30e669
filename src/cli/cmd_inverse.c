/* cli/cmd_inverse.c - ambulo inverse: torques, root wrench and powers of a given motion. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/body.h"
#include "cli/output.h"

static void read_units(const ambulo__cli_input *input, ambulo_inverse_options *o) {
  static const double metres[] = {1.0, 0.01, 0.001}, seconds[] = {1.0, 0.001};
  static const ambulo_angle_unit angles[] = {AMBULO_ANGLES_OF_FILE, AMBULO_ANGLES_DEGREES,
                                             AMBULO_ANGLES_RADIANS};
  o->angles = angles[ambulo__cli_choice(input, "angles", -1) + 1];
  o->length_unit = metres[ambulo__cli_choice(input, "lengths", 0)];
  o->time_unit = seconds[ambulo__cli_choice(input, "time", 0)];
  o->force_length_unit = metres[ambulo__cli_choice(input, "grf-lengths", 0)];
  o->force_time_unit = seconds[ambulo__cli_choice(input, "grf-time", 0)];
}

static int read_options(const ambulo__cli_input *input, ambulo_inverse_options *o) {
  o->strict = ambulo__cli_flag(input, "strict");
  o->overwrite = ambulo__cli_flag(input, "force");
  o->recompute_rates = ambulo__cli_choice(input, "derivatives", 0);
  read_units(input, o);
  return ambulo__cli_number(input, "from", -1e9, 1e9, &o->from) &&
         ambulo__cli_number(input, "to", isnan(o->from) ? -1e9 : o->from, 1e9, &o->to) &&
         ambulo__cli_number(input, "filter", 1e-6, 1e6, &o->cutoff) &&
         ambulo__cli_number(input, "grf-filter", 1e-6, 1e6, &o->force_cutoff);
}

/* warnings about the model count too: an option that changes nothing, for one */
static ambulo_status be_strict(const ambulo_inverse_options *o, const ambulo_diagnostics *list) {
  for (size_t i = 0; o->strict && i < ambulo_diagnostics_count(list); i++) {
    if (ambulo_diagnostics_get(list, i)->severity == AMBULO_WARNING) return AMBULO_E_SCHEMA;
  }
  return AMBULO_OK;
}

static int run(const ambulo__cli_input *input) {
  const char *output = ambulo__cli_value(input, "output"), *motion = input->arguments[1];
  ambulo_inverse_options options = ambulo_inverse_options_default();
  if (!read_options(input, &options)) return 2;
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo__cli_body body = {.model = NULL};
  ambulo__cli_forces forces = {.table = NULL};
  ambulo_status status = AMBULO_OK;
  char *text = NULL;
  int code = ambulo__cli_body_load(input, input->arguments[0], diagnostics, &body, &status);
  if (!code) {
    if (!status) status = be_strict(&options, diagnostics);
    options.ground_height = body.ground_height;
    const char *subject = status ? input->arguments[0] : motion;
    if (!status)
      status = ambulo__cli_forces_read(input, body.model, diagnostics, &forces, &options);
    if (!status)
      status = ambulo_inverse_dynamics_motion(
          body.model, motion, output, &options, NULL, diagnostics,
          &(ambulo_inverse_outputs){.size = sizeof(ambulo_inverse_outputs),
                                    .text = output ? NULL : &text});
    code = ambulo__cli_diagnostics(diagnostics, status, subject);
  }
  if (text) fputs(text, stdout);
  ambulo_text_free(text, NULL);
  ambulo__cli_forces_free(&forces);
  ambulo__cli_body_free(&body);
  ambulo_diagnostics_free(diagnostics);
  return code;
}

static const ambulo__cli_option options_table[] = {
    {"output", 'o', "FILE", "write the CSV there (default: standard output)"},
    {"force", 0, NULL, "overwrite an input, or a file that ambulo did not write"},
    {"strict", 0, NULL, "treat warnings as errors: exit code 3, nothing is written"},
    AMBULO__CLI_FORCE_OPTIONS,
    {"from", 0, "S", "leave out the rows before (default: the first)"},
    {"to", 0, "S", "leave out the rows after (default: the last)"},
    {"angles", 0, "degrees|radians", "unit of the motion's angles (default: as its file states)"},
    {"lengths", 0, "m|cm|mm", "unit of the motion's lengths (default: m)"},
    {"time", 0, "s|ms", "unit of the motion's times (default: s)"},
    {"grf-lengths", 0, "m|cm|mm", "length unit of the forces (default: m)"},
    {"grf-time", 0, "s|ms", "unit of the forces' times (default: s)"},
    {"derivatives", 0, "file|spline",
     "use the rates and accelerations of the file (default), or compute\nthem from its values"},
    {"filter", 0, "HZ", "zero-lag Butterworth low-pass filter, order 4, of the motion"},
    {"grf-filter", 0, "HZ", "the same for the forces and their moments"},
    AMBULO__CLI_BODY_OPTIONS,
};

static const char *const former[] = {"filter-order", "the filter has order 4", NULL};

const ambulo__cli_command ambulo__cli_inverse = {
    .name = "inverse",
    .arguments = "MODEL.yaml|PROBLEM.yaml MOTION",
    .summary = "compute the torques of a motion (CSV, STO or MOT)",
    .description =
        "Writes a CSV with time, q.*, qd.*, qdd.*, tau.*, zmp.*, the root wrench and the joint\n"
        "powers, in SI units and radians. Columns of MOTION are named after the coordinates of "
        "the\n"
        "model. Rates and accelerations are read from the file, or come from an interpolating "
        "spline.\n"
        "Forces on the feet are subtracted from the torques, so that tau.* of the root is the\n"
        "residual; what hands hold (held.* of a result of solve) is added. A problem instead of a\n"
        "model gives its body, subject, slope and load. A warning names the option that corrects\n"
        "what looks wrong. See docs/guide-inverse.md.",
    .example = "ambulo inverse models/walk_normal.yaml walk/motion.csv -o torques.csv\n"
               "ambulo inverse model.yaml ik.mot --grf grf.mot --filter 6 --grf-filter 6 \\\n"
               "  --force-columns right=ground_force,left=1_ground_force -o torques.csv",
    .options = options_table,
    .option_count = sizeof options_table / sizeof options_table[0],
    .former = former,
    .minimum = 2,
    .maximum = 2,
    .files = 2,
    .words = "ambulo models --names",
    .run = run,
};
