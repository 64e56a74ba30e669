/* cli/body.h - files of the command line that may be a model or a problem, as --set changes them;
 * the body of a motion under the conditions of options; forces on its feet. */
#ifndef AMBULO_CLI_BODY_H
#define AMBULO_CLI_BODY_H

#include "ambulo/tools/tools.h"
#include "cli/command.h"

/* Options that the functions below read, for a command's table. */
#define AMBULO__CLI_SET_OPTION                                                                     \
  { "set", 0, "path=value", "replace a value of the model or problem file; may be repeated" }
#define AMBULO__CLI_BODY_OPTIONS                                                                   \
  AMBULO__CLI_SET_OPTION, {"mass", 0, "KG", "body mass of the subject"},                           \
      {"stature", 0, "M", "stature of the subject"},                                               \
      {"sex", 0, "female|male", "sex of the subject"},                                             \
      {"slope", 0, "DEG", "slope of the ground along forward"}, {                                  \
    "load", 0, "LINK:KG:X,Y,Z", "add a mass to a link, at a position in its frame, m"              \
  }

#define AMBULO__CLI_FORCE_OPTIONS                                                                  \
  {"grf", 0, "FILE|none",                                                                          \
   "forces on the feet (CSV, STO or MOT, or OpenSim's external loads),\n"                          \
   "which are subtracted from the torques (default: the columns grf.*\n"                           \
   "of the motion, if any)"},                                                                      \
  {                                                                                                \
    "force-columns", 0, "MAP",                                                                     \
        "columns of forces of each foot, if their names do not say it:\n"                          \
        "left=ground_force_1,right=ground_force_2+ground_force_3 or right=none"                    \
  }

typedef struct ambulo__cli_body {
  ambulo_model *loaded, *adapted;
  ambulo_problem *problem;
  const ambulo_model *model; /* the one to use: belongs to one of the above */
  double ground_height;      /* m */
} ambulo__cli_body;

/* A problem file, with what --set changes. */
ambulo_status ambulo__cli_load_problem(const ambulo__cli_input *input, const char *file,
                                       ambulo_diagnostics *diagnostics, ambulo_problem **problem);
/* A file of muscles, or a shipped one of that name; NULL: the shipped leg_muscles.yaml. */
ambulo_status ambulo__cli_load_muscles(const char *file, const ambulo_model *model,
                                       ambulo_diagnostics *diagnostics, ambulo_muscles **muscles);
/* A model or a problem file, by what it is. */
ambulo_status ambulo__cli_load(const ambulo__cli_input *input, const char *file,
                               ambulo_diagnostics *diagnostics, ambulo__cli_body *body);
/* Whether a batch has filled the folder. */
int ambulo__cli_is_batch(const char *directory);
/* The exit code for what a command found in one: 4 with damaged cases, 1 with missing or stale
 * ones.
 */
int ambulo__cli_census_code(const ambulo_batch_census *census);
/* A model or a problem file under the options of the body. Returns 0, or an exit code after a usage
 * error; *status tells how loading went. */
int ambulo__cli_body_load(const ambulo__cli_input *input, const char *file,
                          ambulo_diagnostics *diagnostics, ambulo__cli_body *body,
                          ambulo_status *status);
void ambulo__cli_body_free(ambulo__cli_body *body); /* accepts a zero-filled one */

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
