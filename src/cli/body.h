/* cli/body.h - the body of a motion: a model file or a problem's, under the conditions of options.
 */
#ifndef AMBULO_CLI_BODY_H
#define AMBULO_CLI_BODY_H

#include "ambulo/ambulo.h"
#include "cli/load.h"

/* Options that ambulo__cli_body_load reads, for a command's table. */
#define AMBULO__CLI_BODY_OPTIONS                                                                   \
  AMBULO__CLI_SET_OPTION, {"mass", 0, "KG", "body mass of the subject"},                           \
      {"stature", 0, "M", "stature of the subject"},                                               \
      {"sex", 0, "female|male", "sex of the subject"},                                             \
      {"slope", 0, "DEG", "the ground rises so much along forward"}, {                             \
    "load", 0, "LINK:KG:X,Y,Z", "a mass fixed on a link, at a place in its frame (m)"              \
  }

typedef struct ambulo__cli_body {
  ambulo_model *loaded, *adapted;
  ambulo_problem *problem;
  const ambulo_model *model; /* the one to use: belongs to one of the above */
  double ground_height;      /* m */
} ambulo__cli_body;

/* Loads `file`. Returns 0, or an exit code after a usage error; *status tells how loading went. */
int ambulo__cli_body_load(const ambulo__cli_input *input, const char *file,
                          ambulo_diagnostics *diagnostics, ambulo__cli_body *body,
                          ambulo_status *status);
void ambulo__cli_body_free(ambulo__cli_body *body); /* accepts a zero-filled one */

#endif
