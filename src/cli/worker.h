/* cli/worker.h - what the program does first when a batch started it. */
#ifndef AMBULO_CLI_WORKER_H
#define AMBULO_CLI_WORKER_H

/* If AMBULO_WORKER="<parent process> <megabytes>" is set: dies with the parent, and limits its
 * own address space (0: no limit). Returns 0 when the parent is gone already. */
int ambulo__cli_become_worker(void);
/* Whether it is set. */
int ambulo__cli_is_worker(void);

#endif
