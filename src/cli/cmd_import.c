/* cli/cmd_import.c - ambulo import: a model of OpenSim, URDF or MuJoCo as a model file. */
#include <stdio.h>

#include "cli/command.h"
#include "cli/output.h"

static void read_options(const ambulo__cli_input *input, ambulo_import_options *o) {
  static const ambulo_import_root roots[] = {AMBULO_ROOT_FREE, AMBULO_ROOT_FIXED};
  int root = ambulo__cli_choice(input, "root", -1);
  if (root >= 0) o->root = roots[root];
  o->pose = ambulo__cli_values(input, "pose", &o->pose_count);
  o->feet = ambulo__cli_values(input, "foot", &o->foot_count);
  o->heels = ambulo__cli_values(input, "heel", &o->heel_count);
  o->toes = ambulo__cli_values(input, "toe", &o->toe_count);
  o->name = ambulo__cli_value(input, "name");
  o->forward = ambulo__cli_value(input, "forward");
  o->symmetrize = ambulo__cli_flag(input, "symmetrize");
  o->unlock = ambulo__cli_flag(input, "unlock");
  o->repair_inertia = ambulo__cli_flag(input, "repair-inertia");
  o->overwrite = ambulo__cli_flag(input, "force");
}

static int run(const ambulo__cli_input *input) {
  const char *source = input->arguments[0], *output = ambulo__cli_value(input, "output");
  ambulo_import_options options = ambulo_import_options_default();
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  char *text = NULL;
  read_options(input, &options);
  ambulo_status status =
      ambulo_import_model(source, output, &options, NULL, diagnostics, output ? NULL : &text);
  int code = ambulo__cli_diagnostics(diagnostics, status, source);
  if (text) fputs(text, stdout);
  ambulo_text_free(text, NULL);
  ambulo_diagnostics_free(diagnostics);
  return code;
}

static const ambulo__cli_option options_table[] = {
    {"output", 'o', "FILE", "write the model there (default: standard output)"},
    {"force", 0, NULL, "overwrite an existing file"},
    {"name", 0, "NAME", "name of the model (default: that of the source)"},
    {"root", 0, "free|fixed",
     "how the root of a URDF is attached to the world\n(default: free, unless the root link is "
     "named world)"},
    {"foot", 0, "FOOT=LINK",
     "take the corners of a foot from the geometry of a link\n(default: links named foot, sole or "
     "calcn, else the lowest of each leg)"},
    {"heel", 0, "FOOT=LINK:X,Y,Z", "heel of a foot, in m; a second corner follows another ':'"},
    {"toe", 0, "FOOT=LINK:X,Y,Z", "toe of a foot, likewise"},
    {"pose", 0, "COORDINATE=VALUE",
     "value, in rad or m, at which functions that no joint can follow are\nheld (default: the "
     "source's "
     "default pose)"},
    {"forward", 0, "DIRECTION",
     "where the body goes: x, -x, y, -y, z, -z or X,Y,Z\n(default: as left and right say, else "
     "heels and toes)"},
    {"symmetrize", 0, NULL, "make left and right exact mirror images, where they differ by little"},
    {"unlock", 0, NULL, "free the coordinates that the source locks"},
    {"repair-inertia", 0, NULL, "increase moments of inertia that are impossible"},
};

const ambulo__cli_command ambulo__cli_import = {
    .name = "import",
    .arguments = "MODEL.osim|MODEL.urdf|MODEL.xml",
    .summary = "convert a model of OpenSim, URDF or MuJoCo",
    .description =
        "Reads the skeleton of an OpenSim model (versions 3 and 4), of a URDF or of the rigid "
        "part\n"
        "of a MuJoCo model (MJCF), and writes a commented model file: links, masses, ranges, "
        "torque\n"
        "limits, feet, left and right. What cannot be carried over is named in a warning and in "
        "the\n"
        "file, with what was done instead. Nothing is written if the source is invalid. Feet are\n"
        "found by their names, else as the lowest links of legs; --foot, --heel and --toe name\n"
        "them.\n"
        "See docs/guide-import.md.",
    .example =
        "ambulo import robot.urdf -o robot.yaml\n"
        "ambulo import gait.osim --heel right=calcn_r:0,0,0 --toe right=calcn_r:0.18,0,0 \\\n"
        "  --heel left=calcn_l:0,0,0 --toe left=calcn_l:0.18,0,0 -o gait.yaml",
    .options = options_table,
    .option_count = sizeof options_table / sizeof options_table[0],
    .minimum = 1,
    .maximum = 1,
    .run = run,
};
