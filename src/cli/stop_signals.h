/* cli/stop_signals.h - Ctrl-C and SIGTERM as wishes, and the width of the terminal: what commands
 * that run long share. */
#ifndef AMBULO_CLI_STOP_SIGNALS_H
#define AMBULO_CLI_STOP_SIGNALS_H

/* From now on SIGINT and SIGTERM are counted. */
void ambulo__cli_catch_stops(void);
/* How many came; the last one's number. */
int ambulo__cli_stops(void);
int ambulo__cli_stop_signal(void);

/* Letters that fit into a line of the terminal, which a longer one would break. */
int ambulo__cli_line_room(void);

#endif
