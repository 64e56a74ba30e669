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
  char *result, *log, *start;
  const char **argument, **variable; /* both end with NULL */
  ambulo__text_buffer inputs;
  char limits[96];
} command;

static void free_command(command *c) {
  ambulo__free(c->allocator, c->result);
  ambulo__free(c->allocator, c->log);
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
  c->log = ambulo__case_path(a, batch->directory, one->id, ".log");
  if (from >= 0) c->start = ambulo__case_path(a, batch->directory, all[from].id, "/solution.yaml");
  c->argument = ambulo__alloc(a, FIXED_ARGUMENTS + 2 * (size_t)one->overrides, sizeof *c->argument);
  if (!c->result || !c->log || !c->argument || (from >= 0 && !c->start)) return 0;
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

/* the folder for the result, without one that is damaged or of other inputs */
static ambulo_status make_place(const ambulo__supervisor *batch, const char *id) {
  const ambulo_allocator *a = batch->allocator;
  char *fan = fan_of(batch, id), *result = ambulo__case_path(a, batch->directory, id, "");
  ambulo_status status = fan && result ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status && mkdir(fan, 0777) != 0 && errno != EEXIST)
    status = ambulo__io_error(batch->diagnostics, fan, "create the folder");
  if (!status) remove_flat(AT_FDCWD, result);
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
  if (!status) {
    errno = spawn(&c, program ? program : "/proc/self/exe", &slot->process);
    if (errno) status = ambulo__io_error(batch->diagnostics, c.log, "start a worker that writes");
  }
  free_command(&c);
  slot->begin = ambulo__seconds_now();
  return status;
}

/* ------------------------------------------------------------------- the end */

enum { MOST_ATTEMPTS = 20, MOST_LOG_BYTES = 1 << 20, NOT_STARTED = 127, SIGNAL_BASE = 128 };

static int from_outside(int number) {
  return number == SIGKILL || number == SIGTERM || number == SIGINT || number == SIGHUP ||
         number == SIGQUIT;
}

/* the first error of the worker's log, with its file, in the message */
static ambulo_status disk_trouble(ambulo__supervisor *batch, const char *id) {
  if (batch->status) return batch->status; /* said once */
  char *path = ambulo__case_path(batch->allocator, batch->directory, id, ".log"), *text = NULL;
  size_t length = 0;
  if (path && ambulo__read_file(path, MOST_LOG_BYTES, batch->allocator, NULL, &text, &length))
    text = NULL;
  const char *error = text ? strstr(text, "error[") : NULL, *file = text, *said = "";
  if (error && strstr(error, "]: ")) said = strstr(error, "]: ") + 3;
  for (const char *line = text; error && line && line < error; line = strchr(line, '\n')) {
    line += *line == '\n';
    file = line;
  }
  int named = said[0] ? (int)(error - file) : 0;
  if (!said[0]) said = text && text[0] ? text : "its log says nothing";
  ambulo__place place = {batch->directory, 0, 0, NULL};
  ambulo_status status =
      ambulo__error(batch->diagnostics, AMBULO_E_IO, place,
                    "what is finished is kept; run the same command again", "case %s: %.*s%.*s", id,
                    named, file, (int)strcspn(said, "\n"), said);
  ambulo__free(batch->allocator, text);
  ambulo__free(batch->allocator, path);
  return status;
}

/* what is to become of the case */
typedef enum judgement { RECORDED, AGAIN, DISK } judgement;

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
  if (code == 4 || code == NOT_STARTED) return DISK;
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

/* an empty log says nothing; one of a case that was solved is kept when it has warnings */
static ambulo_status drop_empty_log(const ambulo__supervisor *batch, const char *id) {
  struct stat entry;
  char *path = ambulo__case_path(batch->allocator, batch->directory, id, ".log");
  if (!path) return AMBULO_E_MEMORY;
  if (stat(path, &entry) == 0 && entry.st_size == 0) (void)unlink(path);
  ambulo__free(batch->allocator, path);
  return AMBULO_OK;
}

static ambulo_status keep(ambulo__supervisor *batch, int index, const ambulo__record *record) {
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
  p->done++;
  p->failed += !record->valid;
  p->last = one->name;
  (void)snprintf(p->last_state, sizeof p->last_state, "%s", record->state);
  if (record->violation >= 0.0 && !(record->violation <= p->worst_violation)) {
    p->worst_violation = record->violation;
    p->worst = one->name;
  }
  return AMBULO_OK;
}

ambulo_status ambulo__worker_end(ambulo__supervisor *batch, const ambulo__slot *slot,
                                 int wait_status) {
  const ambulo__sweep_case *one = &batch->sweep->cases[slot->index];
  ambulo__record record;
  memset(&record, 0, sizeof record);
  record.key = one->key;
  record.exit_code = -1;
  record.violation = -1.0;
  record.origin = slot->origin;
  if (slot->from >= 0)
    (void)snprintf(record.start, sizeof record.start, "%s", batch->sweep->cases[slot->from].id);
  record.seconds = ambulo__seconds_now() - slot->begin;
  record.limit_seconds = batch->case_seconds;
  record.limit_megabytes = batch->case_megabytes;
  int taken = 0;
  batch->of[slot->index].state = AMBULO__CASE_WAITING;
  if (!(WIFEXITED(wait_status) && WEXITSTATUS(wait_status) <= 3)) clean_case(batch, one->id);
  ambulo_status status = drop_empty_log(batch, one->id);
  if (!status)
    status = ambulo__record_take_result(batch->directory, one->id, batch->allocator,
                                        batch->diagnostics, &record, &taken);
  if (status) return status;
  judgement judged = judge(slot, wait_status, taken, &record);
  if (judged == RECORDED) return keep(batch, slot->index, &record);
  if (judged == DISK) return disk_trouble(batch, one->id);
  if (slot->cut == 0 && ++batch->of[slot->index].attempts == MOST_ATTEMPTS) {
    batch->of[slot->index].state = AMBULO__CASE_GIVEN_UP;
    ambulo__place place = {batch->directory, 0, 0, NULL};
    ambulo__warning(batch->diagnostics, place, "is the machine out of memory?",
                    "case %s was killed from outside %d times; left out of this run", one->id,
                    MOST_ATTEMPTS);
  }
  return AMBULO_OK;
}
