/* study/batch_lock.c - see lock.h. */
#include "study/batch_lock.h"
#include "formats/file_steps.h"
#include "base/numtext.h"
#include "formats/paths.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static struct flock whole_file(short type) {
  struct flock region;
  memset(&region, 0, sizeof region);
  region.l_type = type;
  region.l_whence = SEEK_SET;
  return region;
}

static int set_lock(int file, short type) {
  struct flock region = whole_file(type);
  return fcntl(file, F_SETLK, &region);
}

static void print_holder(long process, char holder[AMBULO__HOLDER_TEXT]) {
  char host[64] = "";
  if (gethostname(host, sizeof host - 1) != 0 || !host[0]) (void)snprintf(host, sizeof host, "?");
  (void)snprintf(holder, AMBULO__HOLDER_TEXT, "%s:%ld", host, process);
}

/* 1: somebody else holds it. The system knows the process when it is one of this machine; of
 * another machine the file's own text tells, which of several shards is the last one's. */
static int find_holder(int file, char holder[AMBULO__HOLDER_TEXT]) {
  struct flock region = whole_file(F_WRLCK);
  if (fcntl(file, F_GETLK, &region) != 0 || region.l_type == F_UNLCK) return 0;
  if (region.l_pid > 0 && (kill(region.l_pid, 0) == 0 || errno == EPERM)) {
    print_holder((long)region.l_pid, holder);
    return 1;
  }
  ssize_t length = pread(file, holder, AMBULO__HOLDER_TEXT - 1, 0);
  holder[length > 0 ? length : 0] = '\0';
  holder[strcspn(holder, "\n")] = '\0';
  if (!holder[0]) (void)snprintf(holder, AMBULO__HOLDER_TEXT, "another process");
  return 1;
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

static ambulo_status held(ambulo_diagnostics *diagnostics, const char *path, const char *holder) {
  ambulo__place place = {path, 0, 0, NULL};
  return ambulo__error(diagnostics, AMBULO_E_IO, place,
                       "wait for it, or stop it; it then resumes where it was",
                       "another batch runs in this folder, held by %s; expected none", holder);
}

static ambulo_status take(const char *path, short type, ambulo_diagnostics *diagnostics,
                          int *descriptor) {
  int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) return ambulo__io_error(diagnostics, path, "open the lock");
  if (set_lock(file, type) == 0) {
    *descriptor = file;
    return AMBULO_OK;
  }
  int fault = errno;
  char holder[AMBULO__HOLDER_TEXT] = "another process";
  ambulo_status status;
  if (fault == EACCES || fault == EAGAIN) {
    (void)find_holder(file, holder);
    status = held(diagnostics, path, holder);
  } else {
    errno = fault;
    status = ambulo__io_error(diagnostics, path, "lock");
  }
  close(file);
  return status;
}

/* k of a name "lock.i-of-k"; 0: another name */
static int division_of(const char *name) {
  static const char lead[] = "lock.", middle[] = "-of-";
  if (strncmp(name, lead, sizeof lead - 1) != 0) return 0;
  const char *at = name + sizeof lead - 1;
  at += strspn(at, "0123456789");
  if (strncmp(at, middle, sizeof middle - 1) != 0) return 0;
  at += sizeof middle - 1;
  long long division = 0;
  return ambulo__parse_integer(at, strlen(at), 1, 1000000, &division) ? (int)division : 0;
}

static ambulo_status refuse_if_held(const char *path, ambulo_diagnostics *diagnostics) {
  char holder[AMBULO__HOLDER_TEXT];
  int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return ambulo__io_error(diagnostics, path, "open the lock");
  ambulo_status status = find_holder(file, holder) ? held(diagnostics, path, holder) : AMBULO_OK;
  close(file);
  return status;
}

/* Shards of another k would compute the same cases. Each run looks after it holds its own lock,
 * so that of two which begin at once at least one sees the other. */
static ambulo_status refuse_other_division(const char *directory, int shards,
                                           const ambulo_allocator *a,
                                           ambulo_diagnostics *diagnostics) {
  ambulo_status status = AMBULO_OK;
  DIR *stream = opendir(directory);
  if (!stream) return ambulo__io_error(diagnostics, directory, "read the folder");
  while (!status) {
    errno = 0;
    const struct dirent *e = readdir(stream);
    if (!e) break;
    int division = division_of(e->d_name);
    if (division == 0 || division == shards) continue;
    char *path = ambulo__join_paths(a, directory, e->d_name, NULL);
    status = path ? refuse_if_held(path, diagnostics) : AMBULO_E_MEMORY;
    ambulo__free(a, path);
  }
  if (!status && errno) status = ambulo__io_error(diagnostics, directory, "read the folder");
  closedir(stream);
  return status;
}

ambulo_status ambulo__lock_take(const char *directory, int shard, int shards,
                                const ambulo_allocator *a, ambulo_diagnostics *diagnostics,
                                ambulo__lock *lock) {
  ambulo__lock taken = {-1, -1};
  char name[64];
  (void)snprintf(name, sizeof name, "lock.%d-of-%d", shard, shards);
  char *folder = ambulo__join_paths(a, directory, "lock", NULL);
  char *own = ambulo__join_paths(a, directory, name, NULL);
  ambulo_status status = folder && own ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = take(folder, shards > 1 ? F_RDLCK : F_WRLCK, diagnostics, &taken.folder);
  if (!status && shards > 1) status = take(own, F_WRLCK, diagnostics, &taken.shard);
  if (!status && shards > 1) status = refuse_other_division(directory, shards, a, diagnostics);
  if (!status) status = write_holder(taken.folder, folder, diagnostics);
  if (!status && shards > 1) status = write_holder(taken.shard, own, diagnostics);
  if (status) {
    ambulo__lock_release(&taken);
  } else {
    *lock = taken;
  }
  ambulo__free(a, folder);
  ambulo__free(a, own);
  return status;
}

void ambulo__lock_release(ambulo__lock *lock) {
  if (lock->shard >= 0) close(lock->shard);
  if (lock->folder >= 0) close(lock->folder);
  lock->shard = lock->folder = -1;
}

ambulo_status ambulo__lock_holder(const char *directory, const ambulo_allocator *a,
                                  ambulo_diagnostics *diagnostics,
                                  char holder[AMBULO__HOLDER_TEXT]) {
  holder[0] = '\0';
  char *path = ambulo__join_paths(a, directory, "lock", NULL);
  if (!path) return AMBULO_E_MEMORY;
  int file = open(path, O_RDONLY | O_CLOEXEC);
  ambulo_status status = AMBULO_OK;
  if (file >= 0) {
    if (!find_holder(file, holder)) holder[0] = '\0';
    close(file);
  } else if (errno != ENOENT) {
    status = ambulo__io_error(diagnostics, path, "open the lock");
  }
  ambulo__free(a, path);
  return status;
}
