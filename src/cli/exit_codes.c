/* cli/exit_codes.c - the one list of exit codes, for --help and the manual. */
#include "cli/args.h"

const ambulo__cli_exit_code ambulo__cli_exit_codes[AMBULO__CLI_EXIT_CODES] = {
    {"0", "solved, or done"},
    {"1", "ended without a valid solution (the result is written and marked)"},
    {"2", "usage"},
    {"3", "invalid input"},
    {"4", "input/output"},
    {"5", "memory or size limit"},
    {"6", "internal error"},
    {"130/143", "interrupted by Ctrl-C or SIGTERM (the best point is saved)"},
};
