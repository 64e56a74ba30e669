/* cli/own_program.h - where the program itself is. */
#ifndef AMBULO_CLI_OWN_PROGRAM_H
#define AMBULO_CLI_OWN_PROGRAM_H

#include <stddef.h>

/* Its path in buffer[size]; 0 when the system does not tell. */
int ambulo__cli_own_program(char *buffer, size_t size);

/* What workers are started from, for ambulo_batch_options.program: NULL where the library finds
 * the program by itself (Linux), else its path, which stays. */
const char *ambulo__cli_worker_program(void);

#endif
