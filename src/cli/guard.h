/* cli/guard.h - no input is an output. */
#ifndef AMBULO_CLI_GUARD_H
#define AMBULO_CLI_GUARD_H

#include "cli/command.h"

/* 0; or the exit code after a message, where the output of a command (-o, --cycles) is a file that
 * its command line names besides, and --force is not given. The same file counts whatever the path
 * to it. */
int ambulo__cli_guard_words(const ambulo__cli_input *input);
/* The same of the files of a problem (ambulo_problem_inputs). */
int ambulo__cli_guard_files(const ambulo__cli_input *input, const char *files);

#endif
