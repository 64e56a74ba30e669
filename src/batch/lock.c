/* batch/lock.c - see lock.h. */
#include "batch/lock.h"
#include "base/file_steps.h"
#include "batch/paths.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static int set_lock(int file, int command, short type) {
  struct flock region;
  memset(&region, 0, sizeof region);
  region.l_type = type;
  region.l_whence = SEEK_SET;
  if (fcntl(file, command, &region) != 0) return -1;
  return command == F_GETLK ? region.l_type != F_UNLCK : 0;
}

static void read_holder(int file, char holder[AMBULO__HOLDER_TEXT]) {
  ssize_t length = pread(file, holder, AMBULO__HOLDER_TEXT - 1, 0);
  holder[length > 0 ? length : 0] = '\0';
  holder[strcspn(holder, "\n")] = '\0';
  if (!holder[0]) (void)snprintf(holder, AMBULO__HOLDER_TEXT, "another process");
}

static int write_holder(int file) {
  char host[64] = "", text[AMBULO__HOLDER_TEXT];
  if (gethostname(host, sizeof host - 1) != 0 || !host[0]) (void)snprintf(host, sizeof host, "?");
  int length = snprintf(text, sizeof text, "%s:%ld\n", host, (long)getpid());
  if (pwrite(file, text, (size_t)length, 0) != length) return -1;
  return ftruncate(file, length);
}

static ambulo_status take(const char *path, short type, ambulo_diagnostics *diagnostics,
                          int *descriptor) {
  int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) return ambulo__io_error(diagnostics, path, "open the lock");
  ambulo_status status = AMBULO_OK;
  if (set_lock(file, F_SETLK, type) != 0) {
    if (errno == EACCES || errno == EAGAIN) {
      char holder[AMBULO__HOLDER_TEXT];
      read_holder(file, holder);
      ambulo__place place = {path, 0, 0, NULL};
      status = ambulo__error(
          diagnostics, AMBULO_E_IO, place, "wait for it, or stop it; it then resumes where it was",
          "another batch runs in this folder, held by %s; expected none", holder);
    } else {
      status = ambulo__io_error(diagnostics, path, "lock");
    }
  } else if (write_holder(file) != 0) {
    status = ambulo__io_error(diagnostics, path, "write the lock");
  }
  if (status) {
    close(file);
  } else {
    *descriptor = file;
  }
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

void ambulo__lock_holder(const char *directory, const ambulo_allocator *a,
                         char holder[AMBULO__HOLDER_TEXT]) {
  holder[0] = '\0';
  char *path = ambulo__join_paths(a, directory, "lock", NULL);
  int file = path ? open(path, O_RDONLY | O_CLOEXEC) : -1;
  if (file >= 0) {
    if (set_lock(file, F_GETLK, F_WRLCK) == 1) read_holder(file, holder);
    close(file);
  }
  ambulo__free(a, path);
}
