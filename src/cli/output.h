/* cli/output.h - data goes to stdout, messages go to stderr; Ctrl-C and SIGTERM as wishes. */
#ifndef AMBULO_CLI_OUTPUT_H
#define AMBULO_CLI_OUTPUT_H

#include <stddef.h>

#include "ambulo/tools/tools.h"

/* snprintf that always terminates and says nothing about truncation */
void ambulo__cli_format(char *buffer, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* "ambulo: error[CODE]: ..." and an optional hint line. */
void ambulo__cli_error(const char *code, const char *hint, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* The same with E_ARGUMENT and a pointer to the command's help; returns 2. `command`
 * may be NULL. */
int ambulo__cli_usage_error(const char *command, const char *hint, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Prints every message of the list; if `status` is a failure that left no error in it,
 * says what the status means. Returns the exit code of `status`; without a list that of E_MEMORY,
 * if it is no failure. */
int ambulo__cli_diagnostics(const ambulo_diagnostics *diagnostics, ambulo_status status,
                            const char *subject);
/* The same without messages that say what is known. NULL: all. */
int ambulo__cli_diagnostics_but(const ambulo_diagnostics *diagnostics, ambulo_status status,
                                const char *subject, const char *known);

/* Flushes stdout. `code` if all output arrived, else 4 and a message; the message is left out where
 * the reader of a pipe has gone away, as `head` does when it has seen enough. */
int ambulo__cli_finish(int code);

/* Descriptors 0, 1 and 2 exist afterwards, so that no file that is opened later takes
 * their place; a missing stdout then fails to be written, as it should. */
void ambulo__cli_guard_streams(void);

/* From now on SIGINT and SIGTERM are counted. fatal = 1: a second one ends the program. */
void ambulo__cli_catch_stops(int fatal);
/* How many came; the last one's number. */
int ambulo__cli_stops(void);
int ambulo__cli_stop_signal(void);

/* Letters that fit into a line of the terminal, which a longer one would break. */
int ambulo__cli_line_room(void);

#endif
