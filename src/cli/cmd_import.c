/* cli/cmd_import.c - ambulo import: a model of OpenSim, URDF or MuJoCo as a model file. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/foot_list.h"
#include "cli/output.h"

/* the values of the options that may be repeated */
typedef struct lists {
  const char **pose, **feet, **heels, **toes;
} lists;

static int read_root(const ambulo__cli_input *input, ambulo_import_root *root) {
  const char *text = ambulo__cli_value(input, "root");
  if (!text) return 1;
  if (strcmp(text, "free") == 0) {
    *root = AMBULO_ROOT_FREE;
  } else if (strcmp(text, "fixed") == 0) {
    *root = AMBULO_ROOT_FIXED;
  } else {
    ambulo__cli_usage_error("import", NULL, "--root is '%s'; expected free or fixed", text);
    return 0;
  }
  return 1;
}

static int read_options(const ambulo__cli_input *input, lists *l, ambulo_import_options *o) {
  size_t given = (size_t)input->given_count + 1;
  l->pose = calloc(given, sizeof *l->pose);
  l->feet = calloc(given, sizeof *l->feet);
  l->heels = calloc(given, sizeof *l->heels);
  l->toes = calloc(given, sizeof *l->toes);
  if (!l->pose || !l->feet || !l->heels || !l->toes) return 0;
  o->pose = l->pose;
  o->feet = l->feet;
  o->heels = l->heels;
  o->toes = l->toes;
  o->pose_count = ambulo__cli_values(input, "pose", l->pose);
  o->foot_count = ambulo__cli_values(input, "foot", l->feet);
  o->heel_count = ambulo__cli_values(input, "heel", l->heels);
  o->toe_count = ambulo__cli_values(input, "toe", l->toes);
  o->name = ambulo__cli_value(input, "name");
  o->unlock = ambulo__cli_flag(input, "unlock");
  o->repair_inertia = ambulo__cli_flag(input, "repair-inertia");
  o->overwrite = ambulo__cli_flag(input, "force");
  return 1;
}

static int run(const ambulo__cli_input *input) {
  const char *source = input->arguments[0], *output = ambulo__cli_value(input, "output");
  ambulo_import_options options = ambulo_import_options_default();
  lists l = {NULL, NULL, NULL, NULL};
  ambulo__cli_feet asked;
  if (!read_root(input, &options.root)) return 2;
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_status status = read_options(input, &l, &options) ? AMBULO_OK : AMBULO_E_MEMORY;
  char *text = NULL;
  if (!status) ambulo__cli_ask_feet(source, output, &options, &asked);
  if (!status)
    status =
        ambulo_import_model(source, output, &options, NULL, diagnostics, output ? NULL : &text);
  int code = ambulo__cli_diagnostics(diagnostics, status, source);
  if (text) fputs(text, stdout);
  ambulo_text_free(text, NULL);
  ambulo_diagnostics_free(diagnostics);
  free(l.pose);
  free(l.feet);
  free(l.heels);
  free(l.toes);
  return code;
}

static const ambulo__cli_option options_table[] = {
    {"output", 'o', "FILE", "write the model there (default: standard output)"},
    {"force", 0, NULL, "write over what is there"},
    {"name", 0, "NAME", "name of the model (default: as in the source)"},
    {"root", 0, "free|fixed",
     "how the root hangs on the world where the source does not say\n"
     "(URDF; default: free, unless the root link is named world)"},
    {"foot", 0, "FOOT=LINK",
     "a foot whose corners come from the geometry of a link\n"
     "(default: links named foot, sole or calcn, else the lowest)"},
    {"heel", 0, "FOOT=LINK:X,Y,Z", "heel of a foot by hand, m; a second corner behind another ':'"},
    {"toe", 0, "FOOT=LINK:X,Y,Z", "its toe, likewise"},
    {"pose", 0, "COORDINATE=VALUE",
     "rad or m: where splines and coupled joints are frozen\n"
     "(default: the source's default pose)"},
    {"unlock", 0, NULL, "coordinates that the source locks move all the same"},
    {"repair-inertia", 0, NULL, "raise moments of inertia that no body can have"},
};

const ambulo__cli_command ambulo__cli_import = {
    .name = "import",
    .arguments = "MODEL.osim|MODEL.urdf|MODEL.xml",
    .summary = "a model of OpenSim, URDF or MuJoCo as a model file",
    .description =
        "Reads the skeleton of an OpenSim model (versions 3 and 4), of a URDF or of the rigid "
        "part\n"
        "of a MuJoCo model (MJCF), and writes a commented model file: links, masses, ranges,\n"
        "torque limits, feet, left and right. What cannot be carried over is named, with what was\n"
        "done instead, as a warning and in the file. Nothing is written when the source is wrong.\n"
        "Where the source tells no feet, a terminal is asked which links they are.\n"
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
