/* cli/cmd_inverse.c - ambulo inverse: torques and zero-moment point of a given motion. */
#include <stdio.h>

#include "cli/commands.h"
#include "cli/output.h"

static int run(const ambulo__cli_input *input) {
  const char *output = ambulo__cli_value(input, "output");
  const char *forces = ambulo__cli_value(input, "grf");
  if (output && !output[0])
    return ambulo__cli_usage_error("inverse", NULL, "--output is empty; expected a file name");
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_model *model = NULL;
  char *text = NULL;
  ambulo_status status = ambulo_model_load(input->arguments[0], NULL, NULL, diagnostics, &model);
  if (!status)
    status = forces ? ambulo_inverse_dynamics_loaded(model, input->arguments[1], forces, output,
                                                     NULL, diagnostics, NULL, output ? NULL : &text)
                    : ambulo_inverse_dynamics_file(model, input->arguments[1], output, NULL,
                                                   diagnostics, output ? NULL : &text);
  int code = ambulo__cli_diagnostics(diagnostics, status,
                                     model ? input->arguments[1] : input->arguments[0]);
  if (text) fputs(text, stdout);
  ambulo_text_free(text, NULL);
  ambulo_model_free(model);
  ambulo_diagnostics_free(diagnostics);
  return code;
}

static const ambulo__cli_option options[] = {
    {"output", 'o', "FILE", "write the CSV there (default: standard output)"},
    {"grf", 0, "FILE", "forces on the feet (CSV, STO or MOT), taken off the torques"},
};

const ambulo__cli_command ambulo__cli_inverse = {
    .name = "inverse",
    .arguments = "MODEL.yaml MOTION",
    .summary = "inverse dynamics of a given motion (CSV, STO or MOT)",
    .description =
        "Columns are named after the model's coordinates; rates and accelerations come from an\n"
        "interpolating spline. Writes a CSV with time, q.*, qd.*, qdd.*, tau.*, zmp.* in SI units\n"
        "and radians. With --grf, tau.* of the root is what the measured forces leave over.",
    .example = "ambulo inverse models/yardstick_body.yaml walk/motion.csv -o torques.csv",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 2,
    .maximum = 2,
    .run = run,
};
