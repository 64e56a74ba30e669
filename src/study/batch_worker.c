/* study/batch_worker.c - see worker.h.
 *
 * The worker limits its own address space and asks to die with its parent (src/cli/worker.c):
 * it is told by AMBULO_WORKER="<parent process> <megabytes>". */
#include "study/batch_worker.h"
#include "formats/file_steps.h"
#include "study/case_path.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* a shared library of macOS has no `environ` of its own (untested) */
#ifdef __APPLE__
#include <crt_externs.h>
#define environ (*_NSGetEnviron())
#else
extern char **environ;
#endif

enum { FIXED_ARGUMENTS = 10, FIXED_VARIABLES = 2 };

typedef struct command {
  const ambulo_allocator *allocator;
  char *result, *log, *start;
  const char **argument, **variable; /* both end with NULL */
  char told[64];
} command;

static void free_command(command *c) {
  ambulo__free(c->allocator, c->result);
  ambulo__free(c->allocator, c->log);
  ambulo__free(c->allocator, c->start);
  ambulo__free(c->allocator, (void *)c->argument);
  ambulo__free(c->allocator, (void *)c->variable);
}

static int is_variable(const char *text, const char *name) {
  size_t length = strlen(name);
  return strncmp(text, name, length) == 0 && text[length] == '=';
}

static int fill_environment(command *c, int megabytes) {
  size_t count = 0, kept = 0;
  while (environ[count]) count++;
  c->variable = ambulo__alloc(c->allocator, count + FIXED_VARIABLES + 1, sizeof *c->variable);
  if (!c->variable) return 0;
  for (size_t i = 0; i < count; i++) {
    if (is_variable(environ[i], "OPENBLAS_NUM_THREADS") || is_variable(environ[i], "AMBULO_WORKER"))
      continue;
    c->variable[kept++] = environ[i];
  }
  (void)snprintf(c->told, sizeof c->told, "AMBULO_WORKER=%ld %d", (long)getpid(), megabytes);
  c->variable[kept++] = "OPENBLAS_NUM_THREADS=1";
  c->variable[kept] = c->told;
  return 1;
}

static int fill_command(command *c, const ambulo__worker_job *job) {
  const ambulo_allocator *a = c->allocator;
  const ambulo_case *one = job->one;
  c->result = ambulo__case_path(a, job->directory, one->id, "");
  c->log = ambulo__case_path(a, job->directory, one->id, ".log");
  if (job->start_id)
    c->start = ambulo__case_path(a, job->directory, job->start_id, "/solution.yaml");
  c->argument =
      ambulo__alloc(a, FIXED_ARGUMENTS + 2 * (size_t)one->override_count, sizeof *c->argument);
  if (!c->result || !c->log || !c->argument || (job->start_id && !c->start)) return 0;
  const char *fixed[] = {"ambulo", "solve", "--force", "--quiet", "-o", c->result};
  size_t count = sizeof fixed / sizeof *fixed;
  memcpy(c->argument, fixed, sizeof fixed);
  if (c->start) {
    c->argument[count++] = "--start";
    c->argument[count++] = c->start;
  }
  for (int i = 0; i < one->override_count; i++) {
    c->argument[count++] = "--set";
    c->argument[count++] = one->overrides[i];
  }
  c->argument[count] = job->base;
  return fill_environment(c, job->megabytes);
}

static int prepare(posix_spawn_file_actions_t *files, posix_spawnattr_t *attributes,
                   const char *log) {
  sigset_t none, usual;
  sigemptyset(&none);
  sigemptyset(&usual);
  sigaddset(&usual, SIGINT);
  sigaddset(&usual, SIGTERM);
  int fault = posix_spawn_file_actions_addopen(files, 0, "/dev/null", O_RDONLY, 0);
  if (!fault) fault = posix_spawn_file_actions_addopen(files, 1, "/dev/null", O_WRONLY, 0);
  if (!fault)
    fault = posix_spawn_file_actions_addopen(files, 2, log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (!fault) fault = posix_spawnattr_setpgroup(attributes, 0);
  if (!fault) fault = posix_spawnattr_setsigmask(attributes, &none);
  if (!fault) fault = posix_spawnattr_setsigdefault(attributes, &usual);
  if (!fault)
    fault = posix_spawnattr_setflags(attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK |
                                                     POSIX_SPAWN_SETSIGDEF);
  return fault;
}

static int spawn(const command *c, const char *program, pid_t *process) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  int fault = posix_spawn_file_actions_init(&files);
  if (fault) return fault;
  fault = posix_spawnattr_init(&attributes);
  if (!fault) {
    fault = prepare(&files, &attributes, c->log);
    /* posix_spawn takes char *const[] and changes nothing in it */
    if (!fault)
      fault = posix_spawn(process, program, &files, &attributes, (char *const *)c->argument,
                          (char *const *)c->variable);
    (void)posix_spawnattr_destroy(&attributes);
  }
  (void)posix_spawn_file_actions_destroy(&files);
  return fault;
}

ambulo_status ambulo__worker_start(const ambulo__worker_job *job, const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, pid_t *process) {
  command c;
  memset(&c, 0, sizeof c);
  c.allocator = allocator;
  ambulo_status status = AMBULO_E_MEMORY;
  if (fill_command(&c, job)) {
    errno = spawn(&c, job->program ? job->program : "/proc/self/exe", process);
    status = errno ? ambulo__io_error(diagnostics, c.log, "start a worker that writes") : AMBULO_OK;
  }
  free_command(&c);
  return status;
}
