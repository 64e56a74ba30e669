/* cli/cmd_export.c - ambulo export: a model, and a motion, for other programs. */
#include "cli/body.h"
#include "cli/output.h"

static int read_options(const ambulo__cli_input *input, ambulo_export_options *o,
                        ambulo_inverse_options *inverse) {
  static const ambulo_angle_unit angles[] = {AMBULO_ANGLES_OF_FILE, AMBULO_ANGLES_DEGREES,
                                             AMBULO_ANGLES_RADIANS};
  int format = ambulo__cli_choice(input, "format", -1);
  if (format < 0) {
    ambulo__cli_usage_error("export", NULL, "--format is not given; expected opensim, urdf or npz");
    return 0;
  }
  o->format = (ambulo_export_format)(AMBULO_EXPORT_OPENSIM + format);
  o->free_root = ambulo__cli_flag(input, "free-root");
  o->overwrite = ambulo__cli_flag(input, "force");
  o->inverse = inverse;
  inverse->angles = angles[ambulo__cli_choice(input, "angles", -1) + 1];
  return 1;
}

static int run(const ambulo__cli_input *input) {
  const char *output = ambulo__cli_value(input, "output");
  ambulo_export_options options = ambulo_export_options_default();
  ambulo_inverse_options inverse = ambulo_inverse_options_default();
  if (!read_options(input, &options, &inverse)) return 2;
  if (!output)
    return ambulo__cli_usage_error("export", NULL, "no output is given; expected -o FILE or DIR");
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo__cli_body body = {.model = NULL};
  ambulo__cli_forces forces = {.table = NULL};
  ambulo_status status = AMBULO_OK;
  int code = ambulo__cli_body_load(input, input->arguments[0], diagnostics, &body, &status);
  if (!code) {
    inverse.ground_height = body.ground_height;
    options.problem = body.problem;
    if (!status)
      status = ambulo__cli_forces_read(input, body.model, diagnostics, &forces, &inverse);
    if (!status)
      status = ambulo_export(body.model, input->argument_count > 1 ? input->arguments[1] : NULL,
                             output, &options, NULL, diagnostics);
    code = ambulo__cli_diagnostics(diagnostics, status, input->arguments[0]);
  }
  ambulo__cli_forces_free(&forces);
  ambulo__cli_body_free(&body);
  ambulo_diagnostics_free(diagnostics);
  return code;
}

static const ambulo__cli_option options_table[] = {
    {"format", 0, "opensim|urdf|npz", "the format"},
    {"output", 'o', "FILE|DIR", "output: a folder for opensim with a motion, else a file"},
    {"force", 0, NULL, "overwrite any file, or a folder that an export made"},
    {"free-root", 0, NULL,
     "URDF: omit the coordinates of the root, for programs that give it a\nfree joint, as an .npz "
     "does"},
    AMBULO__CLI_FORCE_OPTIONS,
    {"angles", 0, "degrees|radians", "unit of the motion's angles (default: as its file states)"},
    AMBULO__CLI_BODY_OPTIONS,
};

const ambulo__cli_command ambulo__cli_export = {
    .name = "export",
    .arguments = "MODEL.yaml|PROBLEM.yaml [RESULT_DIR|MOTION]",
    .summary = "write a model and a motion for OpenSim, URDF, Pinocchio, MuJoCo",
    .description =
        "Writes the model, and a motion of it, for other programs. The motion is a result folder "
        "or\n"
        "a table as for ambulo inverse.\n"
        "  opensim  FILE.osim; with a motion a folder: model.osim, motion.mot, grf.mot and\n"
        "           external_loads.xml\n"
        "  urdf     the model alone\n"
        "  npz      the motion alone: NumPy arrays in the coordinates of Pinocchio and MuJoCo\n"
        "Masses, coordinates and names are those of the model. See docs/guide-export.md.",
    .example = "ambulo export models/walk_normal.yaml walk --format opensim -o walk_opensim\n"
               "ambulo export models/lower_body_21.yaml --format urdf -o body.urdf",
    .options = options_table,
    .option_count = sizeof options_table / sizeof options_table[0],
    .minimum = 1,
    .maximum = 2,
    .files = 1,
    .words = "ambulo models --names",
    .run = run,
};
