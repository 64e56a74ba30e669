/* cli/blas.h - OpenBLAS as this program wants it: one thread, and memory for its buffer. */
#ifndef AMBULO_CLI_BLAS_H
#define AMBULO_CLI_BLAS_H

/* One thread, unless OPENBLAS_NUM_THREADS says otherwise. May start the program again with `argv`.
 */
void ambulo__cli_single_threaded_blas(char **argv);

/* 0 with a message when a limit on the address space leaves no room for its buffer. */
int ambulo__cli_blas_fits(void);

#endif
