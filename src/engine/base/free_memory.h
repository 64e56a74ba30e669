/* base/free_memory.h - what the machine has left. */
#ifndef AMBULO_BASE_FREE_MEMORY_H
#define AMBULO_BASE_FREE_MEMORY_H

/* Memory that a process can still have, MB: what the system calls available, and what the limits of
 * its control group and of its address space leave; 0: not known. */
double ambulo__free_megabytes(void);
/* The first numbers of a small file; how many were read, at most two. */
int ambulo__read_numbers(const char *path, double *first, double *second);

#endif
