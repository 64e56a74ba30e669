/* cli/front_words.h - what a front has become, in a line. */
#ifndef AMBULO_CLI_FRONT_WORDS_H
#define AMBULO_CLI_FRONT_WORDS_H

#include "ambulo/tools/tools.h"

/* Nothing where the folder has no front. */
void ambulo__cli_print_front(const ambulo_front_census *front);

#endif
