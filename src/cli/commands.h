/* cli/commands.h - the commands, one file each. */
#ifndef AMBULO_CLI_COMMANDS_H
#define AMBULO_CLI_COMMANDS_H

#include "cli/args.h"

extern const ambulo__cli_command ambulo__cli_solve;
extern const ambulo__cli_command ambulo__cli_evaluate;
extern const ambulo__cli_command ambulo__cli_check;
extern const ambulo__cli_command ambulo__cli_info;
extern const ambulo__cli_command ambulo__cli_inverse;
extern const ambulo__cli_command ambulo__cli_compare;
extern const ambulo__cli_command ambulo__cli_batch;
extern const ambulo__cli_command ambulo__cli_collect;
extern const ambulo__cli_command ambulo__cli_fit;
extern const ambulo__cli_command ambulo__cli_models;
extern const ambulo__cli_command ambulo__cli_new;
extern const ambulo__cli_command ambulo__cli_import;
extern const ambulo__cli_command ambulo__cli_report;
extern const ambulo__cli_command ambulo__cli_draw;
extern const ambulo__cli_command ambulo__cli_export;

#endif
