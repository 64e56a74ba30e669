/* study/batch_worker.c - the process of one case: started, and what its end means.
 *
 * The worker limits its own address space and asks to die with its parent (src/cli/worker.c):
 * it reads both from AMBULO_WORKER="<parent process> <megabytes> <engine>", and refuses to work for
 * another engine than its own. AMBULO_INPUTS has the files that it may read, with their checksums
 * (definitions/problem_file.c): a file that changed, or is away, ends the run, since its case would
 * be another one.
 *
 * Recorded: whatever the case itself brought about (a verdict, invalid input, a crash, its time
 * or memory used up). Not recorded, and tried again: what came from outside (SIGKILL, SIGTERM
 * and their like). What the disk brought about (a folder that cannot be written) ends the run. */
#include "ambulo/tools/report.h"
#include "base/machine.h"
#include "formats/atomic_file.h"
#include "formats/read_file.h"
#include "study/batch.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* a shared library of macOS has no `environ` of its own (untested) */
#ifdef __APPLE__
#include <crt_externs.h>
#define environ (*_NSGetEnviron())
#else
extern char **environ;
#endif

enum { FIXED_ARGUMENTS = 10, FIXED_VARIABLES = 3 };

typedef struct command {
  const ambulo_allocator *allocator;
  char *result, *start;
  const char **argument, **variable; /* both end with NULL */
  ambulo__text_buffer inputs;
  char limits[96];
} command;

static void free_command(command *c) {
  ambulo__free(c->allocator, c->result);
  ambulo__free(c->allocator, c->start);
  ambulo__free(c->allocator, (void *)c->argument);
  ambulo__free(c->allocator, (void *)c->variable);
  ambulo__text_free(&c->inputs);
}

static int is_variable(const char *text, const char *name) {
  size_t length = strlen(name);
  return strncmp(text, name, length) == 0 && text[length] == '=';
}

/* what the worker sets for its own process is none of the caller's */
static int is_ours(const char *text) {
  return is_variable(text, "OPENBLAS_NUM_THREADS") || is_variable(text, "AMBULO_WORKER") ||
         is_variable(text, "AMBULO_INPUTS");
}

static int fill_environment(command *c, const ambulo__supervisor *batch, int index) {
  size_t count = 0, kept = 0;
  while (environ[count]) count++;
  c->variable = ambulo__alloc(c->allocator, count + FIXED_VARIABLES + 1, sizeof *c->variable);
  if (!c->variable) return 0;
  for (size_t i = 0; i < count; i++)
    if (!is_ours(environ[i])) c->variable[kept++] = environ[i];
  ambulo_versions versions;
  ambulo_versions_get(&versions);
  (void)snprintf(c->limits, sizeof c->limits, "AMBULO_WORKER=%ld %d %s", (long)getpid(),
                 batch->case_megabytes, versions.engine);
  ambulo__text_append(&c->inputs, "AMBULO_INPUTS=");
  if (ambulo__sweep_case_inputs(batch->sweep, index, &c->inputs)) return 0;
  c->variable[kept++] = "OPENBLAS_NUM_THREADS=1";
  c->variable[kept++] = c->limits;
  c->variable[kept] = ambulo__text_data(&c->inputs);
  return 1;
}

static int fill_command(command *c, const ambulo__supervisor *batch, int index, int from) {
  const ambulo_allocator *a = c->allocator;
  const ambulo__sweep_case *all = batch->sweep->cases, *one = &all[index];
  c->result = ambulo__case_path(a, batch->directory, one->id, "");
  if (from >= 0) c->start = ambulo__case_path(a, batch->directory, all[from].id, "/solution.yaml");
  c->argument = ambulo__alloc(a, FIXED_ARGUMENTS + 2 * (size_t)one->overrides, sizeof *c->argument);
  if (!c->result || !c->argument || (from >= 0 && !c->start)) return 0;
  const char *fixed[] = {"ambulo", "solve", "--force", "--quiet", "-o", c->result};
  size_t count = sizeof fixed / sizeof *fixed;
  memcpy(c->argument, fixed, sizeof fixed);
  if (c->start) {
    c->argument[count++] = "--start";
    c->argument[count++] = c->start;
  }
  for (int i = 0; i < one->overrides; i++) {
    c->argument[count++] = "--set";
    c->argument[count++] = one->override[i];
  }
  c->argument[count] = batch->sweep->base;
  return fill_environment(c, batch, index);
}

/* messages: a pipe */
static int prepare(posix_spawn_file_actions_t *files, posix_spawnattr_t *attributes, int messages) {
  sigset_t none, usual;
  sigemptyset(&none);
  sigemptyset(&usual);
  sigaddset(&usual, SIGINT);
  sigaddset(&usual, SIGTERM);
  int fault = posix_spawn_file_actions_addopen(files, 0, "/dev/null", O_RDONLY, 0);
  if (!fault) fault = posix_spawn_file_actions_addopen(files, 1, "/dev/null", O_WRONLY, 0);
  if (!fault) fault = posix_spawn_file_actions_adddup2(files, messages, 2);
  if (!fault) fault = posix_spawnattr_setpgroup(attributes, 0);
  if (!fault) fault = posix_spawnattr_setsigmask(attributes, &none);
  if (!fault) fault = posix_spawnattr_setsigdefault(attributes, &usual);
  if (!fault)
    fault = posix_spawnattr_setflags(attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK |
                                                     POSIX_SPAWN_SETSIGDEF);
  return fault;
}

static int spawn(const command *c, const char *program, int messages, pid_t *process) {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  int fault = posix_spawn_file_actions_init(&files);
  if (fault) return fault;
  fault = posix_spawnattr_init(&attributes);
  if (!fault) {
    fault = prepare(&files, &attributes, messages);
    /* posix_spawn takes char *const[] and changes nothing in it */
    if (!fault)
      fault = posix_spawn(process, program, &files, &attributes, (char *const *)c->argument,
                          (char *const *)c->variable);
    (void)posix_spawnattr_destroy(&attributes);
  }
  (void)posix_spawn_file_actions_destroy(&files);
  return fault;
}

/* ------------------------------------------------------------------- folders */

/* result folders are flat */
static void remove_flat(int parent, const char *name) {
  if (unlinkat(parent, name, 0) == 0) return;
  int file = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  DIR *stream = file >= 0 ? fdopendir(file) : NULL;
  if (file >= 0 && !stream) close(file);
  if (stream) {
    for (struct dirent *e = readdir(stream); e; e = readdir(stream)) {
      if (e->d_name[0] != '.') (void)unlinkat(file, e->d_name, 0);
    }
    closedir(stream);
  }
  (void)unlinkat(parent, name, AT_REMOVEDIR);
}

void ambulo__clean_folder(const char *path, const char *begin) {
  DIR *stream = opendir(path);
  if (!stream) return;
  for (struct dirent *e = readdir(stream); e; e = readdir(stream)) {
    if (strncmp(e->d_name, begin, strlen(begin)) == 0 &&
        (strstr(e->d_name, ".tmp-") || strstr(e->d_name, ".old-")))
      remove_flat(dirfd(stream), e->d_name);
  }
  closedir(stream);
}

/* the folder that holds a case's, to be freed */
static char *fan_of(const ambulo__supervisor *batch, const char *id) {
  char *path = ambulo__case_path(batch->allocator, batch->directory, id, "");
  if (path) *strrchr(path, '/') = '\0';
  return path;
}

/* what its killed worker left */
static void clean_case(const ambulo__supervisor *batch, const char *id) {
  char *fan = fan_of(batch, id);
  if (fan) ambulo__clean_folder(fan, id);
  ambulo__free(batch->allocator, fan);
}

/* the folder for the result, without one that is damaged or of other inputs, and its messages */
static ambulo_status make_place(const ambulo__supervisor *batch, const char *id) {
  const ambulo_allocator *a = batch->allocator;
  char *fan = fan_of(batch, id), *result = ambulo__case_path(a, batch->directory, id, "");
  char *log = ambulo__case_path(a, batch->directory, id, ".log");
  ambulo_status status = fan && result && log ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status && mkdir(fan, 0777) != 0 && errno != EEXIST)
    status = ambulo__io_error(batch->diagnostics, fan, "create the folder");
  if (!status) remove_flat(AT_FDCWD, result);
  if (!status) (void)unlink(log);
  ambulo__free(a, log);
  ambulo__free(a, fan);
  ambulo__free(a, result);
  return status;
}

ambulo_status ambulo__worker_start(const ambulo__supervisor *batch, ambulo__slot *slot) {
  command c = {.allocator = batch->allocator};
  ambulo__text_init(&c.inputs, batch->allocator);
  const char *program = batch->options.program;
  ambulo_status status = make_place(batch, batch->sweep->cases[slot->index].id);
  if (!status && !fill_command(&c, batch, slot->index, slot->from)) status = AMBULO_E_MEMORY;
  int messages = status ? -1 : ambulo__worker_log_open(&slot->log, batch->allocator);
  if (!status) {
    if (messages >= 0)
      errno = spawn(&c, program ? program : "/proc/self/exe", messages, &slot->process);
    if (messages < 0 || errno)
      status = ambulo__io_error(batch->diagnostics, c.result, "start a worker that writes");
  }
  if (messages >= 0) (void)close(messages);
  if (status) ambulo__worker_log_close(&slot->log);
  free_command(&c);
  slot->begin = ambulo__seconds_now();
  return status;
}

/* ------------------------------------------------------------------- the end */

enum { MOST_ATTEMPTS = 20, NOT_STARTED = 127, SIGNAL_BASE = 128 };

static int from_outside(int number) {
  return number == SIGKILL || number == SIGTERM || number == SIGINT || number == SIGHUP ||
         number == SIGQUIT;
}

/* the first error of what the worker said, with its file, in the message */
static ambulo_status disk_trouble(ambulo__supervisor *batch, const char *id, const char *text) {
  if (batch->status) return batch->status; /* said once */
  const char *file = ambulo__first_error(text), *error = file ? strstr(file, "error[") : NULL;
  const char *said = error && strstr(error, "]: ") ? strstr(error, "]: ") + 3 : "";
  int named = said[0] ? (int)(error - file) : 0;
  if (!said[0]) said = text[0] ? text : "its worker ended without a message";
  ambulo__place place = {batch->directory, 0, 0, NULL};
  return ambulo__error(batch->diagnostics, AMBULO_E_IO, place,
                       "what is finished is kept; run the same command again", "case %s: %.*s%.*s",
                       id, named, file, (int)strcspn(said, "\n"), said);
}

/* what is to become of the case */
typedef enum judgement { RECORDED, AGAIN } judgement;

/* it ended without a result: what stands there of one does not count, its log does */
static judgement without_result(ambulo__record *record, const char *state) {
  ambulo__case_files *files = &record->files;
  int kept = 0;
  for (int i = 0; i < files->count; i++)
    if (files->file[i].ending[0] != '/') files->file[kept++] = files->file[i];
  files->count = kept;
  record->valid = 0;
  record->violation = -1.0;
  (void)snprintf(record->state, sizeof record->state, "%s", state);
  return RECORDED;
}

/* a worker that exited; `taken`: it left a result */
static judgement judge_exit(int code, int taken, ambulo__record *record) {
  record->exit_code = code;
  if (code > SIGNAL_BASE && from_outside(code - SIGNAL_BASE)) return AGAIN;
  if (code <= 1 && taken) return RECORDED;
  if (code == 0) return AGAIN;
  return without_result(record, code == 2 || code == 3 ? "invalid"
                                : code == 5            ? "memory"
                                                       : "error");
}

static judgement judge(const ambulo__slot *slot, int wait_status, int taken,
                       ambulo__record *record) {
  if (WIFEXITED(wait_status)) return judge_exit(WEXITSTATUS(wait_status), taken, record);
  record->signal = WTERMSIG(wait_status);
  if (slot->cut == 1) return without_result(record, "timeout");
  return from_outside(record->signal) ? AGAIN : without_result(record, "crashed");
}

/* the log of a case that was solved is kept when it has warnings */
static ambulo_status write_log(const ambulo__supervisor *batch, const ambulo__slot *slot,
                               ambulo_diagnostics *diagnostics) {
  const char *id = batch->sweep->cases[slot->index].id;
  char *path = ambulo__case_path(batch->allocator, batch->directory, id, ".log");
  if (!path) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__worker_log_write(&slot->log, path, diagnostics);
  ambulo__free(batch->allocator, path);
  return status;
}

static ambulo_status keep(ambulo__supervisor *batch, int index, const ambulo__record *record,
                          const char *log) {
  const ambulo__sweep_case *one = &batch->sweep->cases[index];
  ambulo__text_buffer inputs;
  ambulo__text_init(&inputs, batch->allocator);
  ambulo_status status = ambulo__sweep_case_inputs(batch->sweep, index, &inputs);
  if (!status)
    status = ambulo__record_write(batch->directory, one->id, record, ambulo__text_data(&inputs),
                                  batch->allocator, batch->diagnostics);
  ambulo__text_free(&inputs);
  if (status) return status;
  ambulo_batch_progress *p = &batch->progress;
  batch->of[index].state = AMBULO__CASE_DONE;
  batch->of[index].solved = (unsigned char)record->valid;
  batch->of[index].origin = record->origin;
  batch->finished_now++;
  ambulo__tally_case(batch, index, record, log);
  p->last = one->name;
  (void)snprintf(p->last_state, sizeof p->last_state, "%s", record->state);
  if (record->violation >= 0.0 && !(record->violation <= p->worst_violation)) {
    p->worst_violation = record->violation;
    p->worst = one->name;
  }
  return AMBULO_OK;
}

static ambulo__record new_record(const ambulo__supervisor *batch, const ambulo__slot *slot) {
  ambulo__record record;
  memset(&record, 0, sizeof record);
  record.key = batch->sweep->cases[slot->index].key;
  record.exit_code = -1;
  record.violation = -1.0;
  record.origin = slot->origin;
  if (slot->from >= 0)
    (void)snprintf(record.start, sizeof record.start, "%s", batch->sweep->cases[slot->from].id);
  record.seconds = ambulo__seconds_now() - slot->begin;
  record.limit_seconds = batch->case_seconds;
  record.limit_megabytes = batch->case_megabytes;
  return record;
}

static void give_up(ambulo__supervisor *batch, int index) {
  batch->of[index].state = AMBULO__CASE_GIVEN_UP;
  ambulo__place place = {batch->directory, 0, 0, NULL};
  ambulo__warning(batch->diagnostics, place, "is the machine out of memory?",
                  "case %s was killed from outside %d times; left out of this run",
                  batch->sweep->cases[index].id, MOST_ATTEMPTS);
}

ambulo_status ambulo__worker_end(ambulo__supervisor *batch, ambulo__slot *slot, int wait_status) {
  const char *id = batch->sweep->cases[slot->index].id;
  ambulo__record record = new_record(batch, slot);
  int taken = 0, code = WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : -1;
  batch->of[slot->index].state = AMBULO__CASE_WAITING;
  if (code < 0 || code > 3) clean_case(batch, id);
  if (ambulo__worker_log_read(&slot->log))
    return ambulo__io_error(batch->diagnostics, batch->directory, "read what a worker says");
  if (code == 4 || code == NOT_STARTED) {
    (void)write_log(batch, slot, NULL); /* where the disk takes it */
    return disk_trouble(batch, id, ambulo__text_data(&slot->log.text));
  }
  ambulo_status status = write_log(batch, slot, batch->diagnostics);
  if (!status)
    status = ambulo__record_take_result(batch->directory, id, batch->allocator, batch->diagnostics,
                                        &record, &taken);
  if (status) return status;
  if (judge(slot, wait_status, taken, &record) == RECORDED)
    return keep(batch, slot->index, &record, ambulo__text_data(&slot->log.text));
  if (slot->cut == 0 && ++batch->of[slot->index].attempts == MOST_ATTEMPTS)
    give_up(batch, slot->index);
  return AMBULO_OK;
}
