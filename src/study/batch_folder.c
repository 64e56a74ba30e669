/* study/batch_folder.c - whether a run may fill a folder: what stands in it, whose list it has, who
 * else runs in it (batch.h). */
#include "base/text_buffer.h"
#include "formats/atomic_file.h"
#include "formats/paths.h"
#include "study/batch.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* names that a batch gives; of earlier versions also drawings */
static int is_known(const char *name) {
  static const char *const names[] = {".",          "..",   "cases",       "cases.tsv",
                                      "batch.json", "lock", "results.csv", "results.jsonl",
                                      "report.html"};
  static const char *const starts[] = {
      "lock.",    "cases.tsv.tmp-", "batch.json.tmp-", "results.csv.tmp-", "results.jsonl.tmp-",
      "results_", "front.svg"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (strcmp(name, names[i]) == 0) return 1;
  for (size_t i = 0; i < sizeof starts / sizeof *starts; i++)
    if (strncmp(name, starts[i], strlen(starts[i])) == 0) return 1;
  return 0;
}

/* *may = 1: a batch's folder; or empty but for a folder `cases`; or what a batch leaves that was
 * stopped before it had written its description, or whose description is damaged */
static ambulo_status may_fill(const char *directory, const ambulo_allocator *a,
                              ambulo_diagnostics *diagnostics, int *may) {
  char *mark = ambulo__join_paths(a, directory, "batch.json", NULL);
  if (!mark) return AMBULO_E_MEMORY;
  *may = ambulo__file_says(mark, "\"ambulo-batch/", 64);
  ambulo__free(a, mark);
  if (*may) return AMBULO_OK;
  int strange = 0, locked = 0, others = 0;
  DIR *stream = opendir(directory);
  for (const struct dirent *e; stream && (errno = 0, e = readdir(stream)) != NULL;) {
    strange |= !is_known(e->d_name);
    locked |= strcmp(e->d_name, "lock") == 0;
    others |= strcmp(e->d_name, "cases") != 0 && e->d_name[strspn(e->d_name, ".")] != '\0';
  }
  int fault = errno;
  if (stream) closedir(stream);
  errno = fault;
  *may = !strange && (locked || !others);
  return fault ? ambulo__io_error(diagnostics, directory, "read the folder") : AMBULO_OK;
}

static ambulo_status make_folder(const char *path, ambulo_diagnostics *diagnostics) {
  struct stat entry;
  if (mkdir(path, 0777) == 0) return AMBULO_OK;
  if (errno == EEXIST && stat(path, &entry) == 0 && !S_ISDIR(entry.st_mode)) errno = ENOTDIR;
  return errno == EEXIST ? AMBULO_OK : ambulo__io_error(diagnostics, path, "create the folder");
}

ambulo_status ambulo__batch_make_folders(const char *directory, const ambulo_allocator *a,
                                         ambulo_diagnostics *diagnostics) {
  int may = 0;
  ambulo_status status = make_folder(directory, diagnostics);
  if (!status) status = may_fill(directory, a, diagnostics, &may);
  if (!status && !may) {
    ambulo__place place = {directory, 0, 0, NULL};
    status = ambulo__error(diagnostics, AMBULO_E_IO, place, NULL,
                           "the folder holds other files; expected a new, an empty or a batch "
                           "folder");
  }
  char *cases = ambulo__join_paths(a, directory, "cases", NULL);
  if (!status) status = cases ? make_folder(cases, diagnostics) : AMBULO_E_MEMORY;
  ambulo__free(a, cases);
  return status;
}

/* ---------------------------------------------------------------- comparing */

/* "torque_power 1, force_rate 0.1; 12 points, least 0.01, from zero" */
static void front_text(const ambulo__front *f, ambulo__text_buffer *text) {
  for (int i = 0; i < f->terms; i++) {
    ambulo__text_append_format(text, "%s%s ", i ? ", " : "", f->name[i]);
    ambulo__text_append_number(text, f->own[i]);
  }
  if (f->terms == 0) {
    ambulo__text_append(text, "no front");
    return;
  }
  ambulo__text_append_format(text, "; %d points, least ", f->wanted);
  ambulo__text_append_number(text, f->least);
  ambulo__text_append(text, f->neighbour ? ", from neighbours" : ", from zero");
}

/* cases of two lists that are sorted by id */
typedef struct changes {
  int same, changed, added, gone;
  const char *first; /* name of the first case that is not the same; NULL: none */
} changes;

static changes compare(const ambulo_sweep *s, const ambulo_sweep *old) {
  changes c = {0, 0, 0, 0, NULL};
  int i = 0, j = 0;
  while (i < s->case_count || j < old->case_count) {
    int order = i == s->case_count     ? 1
                : j == old->case_count ? -1
                                       : strcmp(s->cases[i].id, old->cases[j].id);
    int same = order == 0 && old->cases[j].key == s->cases[i].key;
    c.same += same;
    c.changed += order == 0 && !same;
    c.added += order < 0;
    c.gone += order > 0;
    if (!c.first && !same) c.first = order > 0 ? old->cases[j].name : s->cases[i].name;
    i += order <= 0;
    j += order >= 0;
  }
  return c;
}

/* which input is another one, as far as the folder has written it down; "": none of these */
static void name_cause(const ambulo_sweep *s, const ambulo_sweep *old, char *cause, size_t size) {
  int problem = strcmp(s->problem_hash, old->problem_hash) != 0;
  cause[0] = '\0';
  if (strcmp(s->version, old->version) != 0)
    (void)snprintf(cause, size, "the version changed (was %s)", old->version);
  else if (problem && strcmp(s->text_hash, old->text_hash) != 0)
    (void)snprintf(cause, size, "the base problem changed");
  else if (problem)
    (void)snprintf(cause, size, "a file that the base problem names changed, its model or data");
}

static ambulo_status refuse(const char *directory, const char *cause, const changes *c,
                            ambulo_diagnostics *diagnostics) {
  char counts[200] = "";
  ambulo__place place = {directory, 0, 0, NULL};
  if (c)
    (void)snprintf(counts, sizeof counts,
                   "; %d cases the same, %d with other inputs, %d new, %d gone (first: '%.60s')",
                   c->same, c->changed, c->added, c->gone, c->first ? c->first : "");
  return ambulo__error(
      diagnostics, AMBULO_E_PROBLEM, place,
      "--force keeps the cases that are the same and computes the others; or give another folder",
      "the folder was filled from other inputs: %s%s", cause, counts);
}

/* the list of a front grows, so it is what makes the list that is compared */
static ambulo_status compare_fronts(const ambulo_sweep *s, const ambulo_sweep *old,
                                    const char *directory, char *cause, size_t size,
                                    ambulo_diagnostics *diagnostics) {
  ambulo__text_buffer now, then;
  ambulo__text_init(&now, &old->allocator);
  ambulo__text_init(&then, &old->allocator);
  front_text(&s->front, &now);
  front_text(&old->front, &then);
  if (strcmp(ambulo__text_data(&now), ambulo__text_data(&then)) != 0)
    (void)snprintf(cause, size, "the front changed (was: %.90s)", ambulo__text_data(&then));
  ambulo_status status = now.failed || then.failed ? AMBULO_E_MEMORY : AMBULO_OK;
  ambulo__text_free(&now);
  ambulo__text_free(&then);
  return status || !cause[0] ? status : refuse(directory, cause, NULL, diagnostics);
}

static ambulo_status compare_lists(const ambulo_sweep *s, const ambulo_sweep *old,
                                   const char *directory, ambulo_diagnostics *diagnostics) {
  char cause[128];
  name_cause(s, old, cause, sizeof cause);
  if (s->front.terms > 0)
    return compare_fronts(s, old, directory, cause, sizeof cause, diagnostics);
  changes c = compare(s, old);
  if (c.changed + c.added + c.gone == 0) return AMBULO_OK;
  if (!cause[0])
    (void)snprintf(cause, sizeof cause, "%s",
                   c.added + c.gone > 0
                       ? "the sweep changed"
                       : "a file that the sweep names, or what cases start from, changed");
  return refuse(directory, cause, &c, diagnostics);
}

/* of a folder that has a batch.json */
static ambulo_status check_list(const ambulo_sweep *s, const char *directory, int force,
                                const ambulo_allocator *a, ambulo_diagnostics *diagnostics,
                                ambulo_diagnostics *reasons) {
  ambulo_sweep *old = NULL;
  ambulo__place place = {directory, 0, 0, NULL};
  int damaged = 0;
  ambulo_status status = ambulo__study_try(directory, a, reasons, &old, &damaged);
  const ambulo_diagnostic *reason = ambulo_diagnostics_get(reasons, 0);
  if (!status && !force) {
    status = compare_lists(s, old, directory, diagnostics);
  } else if (damaged) {
    ambulo__warning(diagnostics, place, NULL,
                    "damaged: the list of cases is not what was written; it is written anew from "
                    "the sweep, and cases of other inputs are computed again");
    status = AMBULO_OK;
  } else if (status == AMBULO_E_PROBLEM && force) {
    status = AMBULO_OK;
  } else if (status && reason) {
    place.file = reason->file;
    (void)ambulo__error(diagnostics, status, place, reason->hint, "%s", reason->message);
  }
  ambulo_sweep_free(old);
  return status;
}

ambulo_status ambulo__batch_check_folder(const ambulo_sweep *s, const char *directory, int force,
                                         const ambulo_allocator *a,
                                         ambulo_diagnostics *diagnostics) {
  struct stat entry;
  char *mark = ambulo__join_paths(a, directory, "batch.json", NULL);
  ambulo_diagnostics *reasons = ambulo_diagnostics_create(a);
  ambulo_status status = mark && reasons ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status && stat(mark, &entry) == 0)
    status = check_list(s, directory, force, a, diagnostics, reasons);
  else if (!status && errno != ENOENT)
    status = ambulo__io_error(diagnostics, mark, "inspect");
  ambulo_diagnostics_free(reasons);
  ambulo__free(a, mark);
  return status;
}

/* ------------------------------------------------------------------ the lock
 *
 * POSIX record locks: the system releases them when the holder ends, however it ends, and they
 * work across the nodes of a cluster where the file system offers them. A whole run holds all of
 * DIR/lock exclusively. Shard i of k holds byte i exclusively and byte FIRST + k shared, so that
 * shards of one k run beside each other, and those of another are seen. The file names the last one
 * that has taken it as host:pid. */

#define FIRST ((off_t)1 << 32)

static struct flock region(short type, off_t start, off_t length) {
  struct flock r;
  memset(&r, 0, sizeof r);
  r.l_type = type;
  r.l_whence = SEEK_SET;
  r.l_start = start;
  r.l_len = length;
  return r;
}

static void print_holder(long process, char holder[AMBULO__HOLDER_TEXT]) {
  char host[64] = "";
  if (gethostname(host, sizeof host - 1) != 0 || !host[0]) (void)snprintf(host, sizeof host, "?");
  (void)snprintf(holder, AMBULO__HOLDER_TEXT, "%s:%ld", host, process);
}

/* 1: somebody else holds a part of these bytes (length 0: to the end). The system knows the process
 * when it is one of this machine; of another machine the file's own text tells. */
static int find_holder(int file, off_t start, off_t length, char holder[AMBULO__HOLDER_TEXT]) {
  struct flock r = region(F_WRLCK, start, length);
  if (fcntl(file, F_GETLK, &r) != 0 || r.l_type == F_UNLCK) return 0;
  if (r.l_pid > 0 && (kill(r.l_pid, 0) == 0 || errno == EPERM)) {
    print_holder((long)r.l_pid, holder);
    return 1;
  }
  ssize_t bytes = pread(file, holder, AMBULO__HOLDER_TEXT - 1, 0);
  holder[bytes > 0 ? bytes : 0] = '\0';
  holder[strcspn(holder, "\n")] = '\0';
  if (!holder[0]) (void)snprintf(holder, AMBULO__HOLDER_TEXT, "another process");
  return 1;
}

static ambulo_status refuse_lock(ambulo_diagnostics *diagnostics, const char *path,
                                 const char *holder) {
  ambulo__place place = {path, 0, 0, NULL};
  return ambulo__error(diagnostics, AMBULO_E_IO, place,
                       "wait for it, or stop it; it then resumes where it was",
                       "another batch runs in this folder, held by %s; expected none", holder);
}

static ambulo_status take(int file, const char *path, short type, off_t start, off_t length,
                          ambulo_diagnostics *diagnostics) {
  char holder[AMBULO__HOLDER_TEXT] = "another process";
  struct flock r = region(type, start, length);
  if (fcntl(file, F_SETLK, &r) == 0) return AMBULO_OK;
  if (errno != EACCES && errno != EAGAIN) return ambulo__io_error(diagnostics, path, "lock");
  (void)find_holder(file, start, length, holder);
  return refuse_lock(diagnostics, path, holder);
}

/* Shards of another k would compute the same cases. Each run looks after it holds its own lock,
 * so that of two which begin at once at least one sees the other. */
static ambulo_status take_shard(int file, const char *path, int shard, int shards,
                                ambulo_diagnostics *diagnostics) {
  char holder[AMBULO__HOLDER_TEXT];
  ambulo_status status = take(file, path, F_WRLCK, shard, 1, diagnostics);
  if (!status) status = take(file, path, F_RDLCK, FIRST + shards, 1, diagnostics);
  if (!status && (find_holder(file, FIRST, shards, holder) ||
                  find_holder(file, FIRST + shards + 1, 0, holder)))
    status = refuse_lock(diagnostics, path, holder);
  return status;
}

static ambulo_status write_holder(int file, const char *path, ambulo_diagnostics *diagnostics) {
  char text[AMBULO__HOLDER_TEXT];
  print_holder((long)getpid(), text);
  size_t length = strlen(text);
  text[length] = '\n';
  if (pwrite(file, text, length + 1, 0) != (ssize_t)length + 1 ||
      ftruncate(file, (off_t)length + 1) != 0)
    return ambulo__io_error(diagnostics, path, "write the lock");
  return AMBULO_OK;
}

ambulo_status ambulo__lock_take(const char *directory, int shard, int shards,
                                const ambulo_allocator *a, ambulo_diagnostics *diagnostics,
                                int *lock) {
  char *path = ambulo__join_paths(a, directory, "lock", NULL);
  if (!path) return AMBULO_E_MEMORY;
  int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  ambulo_status status = AMBULO_OK;
  if (file < 0)
    status = ambulo__io_error(diagnostics, path, "open the lock");
  else if (shards > 1)
    status = take_shard(file, path, shard, shards, diagnostics);
  else
    status = take(file, path, F_WRLCK, 0, 0, diagnostics);
  if (!status) status = write_holder(file, path, diagnostics);
  if (status) {
    ambulo__lock_release(file);
  } else {
    *lock = file;
  }
  ambulo__free(a, path);
  return status;
}

void ambulo__lock_release(int lock) {
  if (lock >= 0) close(lock);
}

ambulo_status ambulo__lock_holder(const char *directory, const ambulo_allocator *a,
                                  ambulo_diagnostics *diagnostics,
                                  char holder[AMBULO__HOLDER_TEXT]) {
  holder[0] = '\0';
  char *path = ambulo__join_paths(a, directory, "lock", NULL);
  if (!path) return AMBULO_E_MEMORY;
  int file = open(path, O_RDONLY | O_CLOEXEC);
  ambulo_status status = AMBULO_OK;
  if (file < 0 && errno != ENOENT) status = ambulo__io_error(diagnostics, path, "open the lock");
  if (file >= 0 && !find_holder(file, 0, 0, holder)) holder[0] = '\0';
  ambulo__lock_release(file);
  ambulo__free(a, path);
  return status;
}
