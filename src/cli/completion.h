/* cli/completion.h - scripts for shells that complete command lines, made from the tables. */
#ifndef AMBULO_CLI_COMPLETION_H
#define AMBULO_CLI_COMPLETION_H

#include "cli/args.h"

/* The script of "bash", "zsh" or "fish" on stdout; returns the exit code. */
int ambulo__cli_print_completion(const char *shell, const ambulo__cli_command *const *commands,
                                 int count);

#endif
