/* cli/forces.h - --grf and --force-columns: forces on the feet of a motion. */
#ifndef AMBULO_CLI_FORCES_H
#define AMBULO_CLI_FORCES_H

#include "ambulo/tools/tools.h"
#include "cli/args.h"

/* Options that ambulo__cli_forces_read reads, for a command's table. */
#define AMBULO__CLI_FORCE_OPTIONS                                                                  \
  {"grf", 0, "FILE|none",                                                                          \
   "forces on the feet (CSV, STO or MOT, or OpenSim's external loads,\n"                           \
   "XML, which name the table and its columns), taken off the torques\n"                           \
   "(default: the columns grf.* of the motion, if it has some)"},                                  \
  {                                                                                                \
    "force-columns", 0, "MAP",                                                                     \
        "columns of forces of each foot, when their names do not tell:\n"                          \
        "left=ground_force_1,right=ground_force_2+ground_force_3 or right=none"                    \
  }

typedef struct ambulo__cli_forces {
  char *table, *columns; /* what external loads said; NULL */
} ambulo__cli_forces;

/* Sets forces, without_forces and force_columns of the options; they live as long as *forces and
 * the input. */
ambulo_status ambulo__cli_forces_read(const ambulo__cli_input *input, const ambulo_model *model,
                                      ambulo_diagnostics *diagnostics, ambulo__cli_forces *forces,
                                      ambulo_inverse_options *options);
void ambulo__cli_forces_free(ambulo__cli_forces *forces); /* accepts a zero-filled one */

#endif
