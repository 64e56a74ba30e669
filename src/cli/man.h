/* cli/man.h - manual pages, made from the tables that --help prints. */
#ifndef AMBULO_CLI_MAN_H
#define AMBULO_CLI_MAN_H

#include "cli/args.h"

/* ambulo(1), and ambulo-COMMAND(1), as man(7) source on stdout. */
void ambulo__cli_print_man_overview(const ambulo__cli_command *const *commands, int count);
void ambulo__cli_print_man(const ambulo__cli_command *command);

#endif
