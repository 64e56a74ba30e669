/* base/machine.h - the one clock, by which budgets, reports and limits of time are measured; and
 * the memory that the machine has left. */
#ifndef AMBULO_BASE_MACHINE_H
#define AMBULO_BASE_MACHINE_H

/* s since some fixed moment; never goes back. */
double ambulo__seconds_now(void);

/* Memory that a process can still have, MB: what the system calls available, and what the limits of
 * its control group and of its address space leave; 0: not known. */
double ambulo__free_megabytes(void);
/* The first numbers of a small file; how many were read, at most two. */
int ambulo__read_numbers(const char *path, double *first, double *second);

#endif
