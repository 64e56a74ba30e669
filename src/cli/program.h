/* cli/program.h - the process itself: its path, its part in a batch, the threads of BLAS. */
#ifndef AMBULO_CLI_PROGRAM_H
#define AMBULO_CLI_PROGRAM_H

#include <stddef.h>

/* Its path in buffer[size]; 0 when the system does not tell. */
int ambulo__cli_own_program(char *buffer, size_t size);
/* What workers are started from, for ambulo_batch_options.program: NULL where the library finds
 * the program by itself (Linux), else its path, which stays. */
const char *ambulo__cli_worker_program(void);

/* If AMBULO_WORKER="<parent process> <megabytes> <engine>" is set: dies with the parent, and limits
 * its own address space (0: no limit). Returns 0 when the parent is gone already. */
int ambulo__cli_become_worker(void);
/* Whether it is set. */
int ambulo__cli_is_worker(void);
/* 0 with a message when this program has another engine than the batch that started it. */
int ambulo__cli_worker_fits(void);

/* One thread for OpenBLAS, unless OPENBLAS_NUM_THREADS says otherwise. May start the program again
 * with `argv`. */
void ambulo__cli_single_threaded_blas(char **argv);
/* 0 with a message when a limit on the address space leaves no room for the buffer of OpenBLAS. */
int ambulo__cli_blas_fits(void);

#endif
