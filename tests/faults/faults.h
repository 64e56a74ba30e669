/* tests/faults/faults.h - what test_commands.c asks of preload.c, through a file that both map. */
#ifndef AMBULO_TESTS_FAULTS_H
#define AMBULO_TESTS_FAULTS_H

/* AMBULO_FAULTS: the file's path. Programs without it, and those of the other side, are not
 * disturbed. */
#define FAULTS_VARIABLE "AMBULO_FAULTS"

/* what fails: calls counted together, from main() on */
#define FAULT_LIST(kind)                                                                           \
  kind(MEMORY, "memory") kind(OPEN, "open") kind(READ, "read") kind(WRITE, "write")                \
      kind(FSYNC, "fsync") kind(RENAME, "rename") kind(CLOSE, "close") kind(STAT, "stat")          \
          kind(MKDIR, "mkdir") kind(UNLINK, "unlink") kind(FOLDER, "folder") kind(SPAWN, "spawn")

typedef enum fault_kind {
#define FAULT_ENUM(name, text) FAULT_##name,
  FAULT_LIST(FAULT_ENUM) FAULT_KINDS
} fault_kind;

typedef enum fault_way {
  FAULT_ONCE,
  FAULT_FOR_EVER,
  FAULT_SHORT,      /* half of it is read or written */
  FAULT_INTERRUPTED /* EINTR */
} fault_way;

typedef struct faults {
  int kind, way, worker; /* worker = 1: in workers of a batch, 0: in all else */
  long at;               /* the call that fails, from 0; -1: none */
  long count[FAULT_KINDS];
  long hits;
} faults;

#endif
