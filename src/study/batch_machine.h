/* study/batch_machine.h - how many worker processes a machine carries. */
#ifndef AMBULO_STUDY_BATCH_MACHINE_H
#define AMBULO_STUDY_BATCH_MACHINE_H

/* Processors this process may use (affinity and control group), at least 1. */
int ambulo__usable_processors(void);
/* Processes at once: `wanted`, or the usable processors where that is 0; then no more than
 * fit into the free memory with `megabytes` each (0: 150, what a gait needs at most). */
int ambulo__worker_count(int wanted, int megabytes);

#endif
