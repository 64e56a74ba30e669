/* formats/atomic_folder.c - a result folder filled beside its place (atomic_file.h).
 *
 * POSIX renames a folder only onto an empty one, so replacing takes two renames: the old
 * folder steps aside, the new one takes its place, the old one is removed. If the second
 * rename fails the old one is put back. */
#include "formats/atomic_file.h"
#include "formats/paths.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define NAME_ATTEMPTS 100
/* result folders are flat or nearly so; a deeper tree is not one */
#define REMOVE_DEPTH 8

struct ambulo__folder {
  ambulo_allocator allocator;
  char *path, *parent, *temporary;
  const ambulo__folder_mark *mark; /* may be NULL */
  int created;
};

static int is_dot(const char *name) {
  return strcmp(name, ".") == 0 || strcmp(name, "..") == 0;
}

/* needs no memory, so that cleaning up cannot fail for want of it; links are removed, not
 * followed; 0: something stays, and errno says why */
static int remove_tree(int parent, const char *name, int depth) {
  int file = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  DIR *stream = file >= 0 ? fdopendir(file) : NULL;
  if (file >= 0 && !stream) close(file);
  if (stream) {
    for (struct dirent *entry = readdir(stream); entry; entry = readdir(stream)) {
      if (is_dot(entry->d_name) || unlinkat(file, entry->d_name, 0) == 0) continue;
      if (depth < REMOVE_DEPTH) (void)remove_tree(file, entry->d_name, depth + 1);
    }
    closedir(stream);
  }
  return unlinkat(parent, name, AT_REMOVEDIR) == 0;
}

/* a folder of ours that stays is named */
static void remove_or_tell(const char *name, const char *what, ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = name};
  if (!remove_tree(AT_FDCWD, name, 0))
    ambulo__warning(diagnostics, place, NULL, "%s stays here: it cannot be removed: %s", what,
                    strerror(errno));
}

/* 1 empty, 0 not, -1 with errno */
static int folder_is_empty(const char *path) {
  DIR *stream = opendir(path);
  if (!stream) return -1;
  int empty = 1;
  for (const struct dirent *e; empty && (errno = 0, e = readdir(stream)) != NULL;)
    empty = is_dot(e->d_name);
  int reason = errno;
  closedir(stream);
  errno = reason;
  return empty && reason ? -1 : empty;
}

static ambulo_status expect_mark(const ambulo__folder *folder, ambulo_diagnostics *diagnostics) {
  const ambulo__folder_mark *mark = folder->mark;
  ambulo__place place = {.file = folder->path};
  struct stat info;
  char *path = ambulo__join_paths(&folder->allocator, folder->path, mark->file, NULL);
  if (!path) return ambulo__io_memory_error(diagnostics, folder->path);
  int found = lstat(path, &info) == 0 && S_ISREG(info.st_mode);
  int ours = found && ambulo__file_says(path, mark->text, 256);
  ambulo__free(&folder->allocator, path);
  if (ours) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_IO, place, NULL,
                       "the folder is not empty and holds no '%s'%s: it is not an earlier result "
                       "and is not replaced",
                       mark->file, found ? " of ambulo's" : "");
}

static ambulo_status expect_nothing_else(const ambulo__folder *folder,
                                         ambulo_diagnostics *diagnostics) {
  const ambulo__folder_mark *mark = folder->mark;
  ambulo__place place = {.file = folder->path};
  ambulo_status status = AMBULO_OK;
  DIR *stream = opendir(folder->path);
  if (!stream) return ambulo__io_error(diagnostics, folder->path, "read the folder");
  for (const struct dirent *entry; !status && (errno = 0, entry = readdir(stream)) != NULL;) {
    int known = is_dot(entry->d_name);
    for (int i = 0; i < mark->count && !known; i++)
      known = strcmp(entry->d_name, mark->names[i]) == 0;
    if (known) continue;
    status = ambulo__error(diagnostics, AMBULO_E_IO, place, "move it elsewhere first",
                           "the folder also holds '%s', which ambulo did not write and which would "
                           "be lost; it is not replaced",
                           entry->d_name);
  }
  if (!status && errno) status = ambulo__io_error(diagnostics, folder->path, "read the folder");
  closedir(stream);
  return status;
}

/* *occupied: a folder that must step aside stands at the target */
static ambulo_status inspect_target(const ambulo__folder *folder, ambulo_diagnostics *diagnostics,
                                    int *occupied) {
  ambulo__place place = {.file = folder->path};
  struct stat info;
  *occupied = 0;
  if (lstat(folder->path, &info) != 0) {
    return errno == ENOENT ? AMBULO_OK : ambulo__io_error(diagnostics, folder->path, "inspect");
  }
  if (!S_ISDIR(info.st_mode)) {
    return ambulo__error(diagnostics, AMBULO_E_IO, place, NULL,
                         "exists and is not a folder; expected a new or empty folder");
  }
  int empty = folder_is_empty(folder->path);
  if (empty < 0) return ambulo__io_error(diagnostics, folder->path, "read the folder");
  if (empty) return AMBULO_OK;
  if (!folder->mark) {
    return ambulo__error(diagnostics, AMBULO_E_IO, place,
                         "--force (in C: overwrite) replaces an earlier result",
                         "the folder exists and is not empty; expected a new or empty folder");
  }
  ambulo_status status = expect_mark(folder, diagnostics);
  if (!status) status = expect_nothing_else(folder, diagnostics);
  if (status) return status;
  *occupied = 1;
  return AMBULO_OK;
}

static void folder_free(ambulo__folder *folder) {
  ambulo_allocator allocator = folder->allocator;
  ambulo__free(&allocator, folder->path);
  ambulo__free(&allocator, folder->parent);
  ambulo__free(&allocator, folder->temporary);
  ambulo__free(&allocator, folder);
}

void ambulo__folder_abort(ambulo__folder *folder, ambulo_diagnostics *diagnostics) {
  if (!folder) return;
  if (folder->created) remove_or_tell(folder->temporary, "an unfinished folder", diagnostics);
  folder_free(folder);
}

/* "<name>.tmp-<process>-<k>", "<name>.old-<process>-<k>": *process; 0: another name */
static int is_leftover(const char *entry, const char *name, long *process) {
  size_t length = strlen(name);
  if (strncmp(entry, name, length) != 0) return 0;
  const char *rest = entry + length;
  if (strncmp(rest, ".tmp-", 5) != 0 && strncmp(rest, ".old-", 5) != 0) return 0;
  char *end = NULL;
  *process = strtol(rest + 5, &end, 10);
  return end > rest + 5 && *end == '-' && *process > 0;
}

/* what a run that was killed left beside the place, unless it still runs */
static void tell_leftovers(const ambulo__folder *folder, ambulo_diagnostics *diagnostics) {
  const char *slash = strrchr(folder->path, '/'), *name = slash ? slash + 1 : folder->path;
  DIR *stream = opendir(folder->parent);
  for (const struct dirent *e; stream && (e = readdir(stream)) != NULL;) {
    long process = 0;
    ambulo__place place = {.file = folder->parent};
    if (!is_leftover(e->d_name, name, &process)) continue;
    if (process == (long)getpid() || kill((pid_t)process, 0) == 0 || errno == EPERM) continue;
    ambulo__warning(diagnostics, place, "remove it, once no run on another machine writes it",
                    "a run that was cut off left '%s' here", e->d_name);
  }
  if (stream) (void)closedir(stream);
}

static ambulo_status create_temporary(ambulo__folder *folder, ambulo_diagnostics *diagnostics) {
  for (int k = 0; k < NAME_ATTEMPTS; k++) {
    ambulo__free(&folder->allocator, folder->temporary);
    folder->temporary = ambulo__sibling_name(&folder->allocator, folder->path, "tmp", k);
    if (!folder->temporary) return ambulo__io_memory_error(diagnostics, folder->path);
    if (mkdir(folder->temporary, 0777) == 0) {
      folder->created = 1;
      return AMBULO_OK;
    }
    if (errno != EEXIST) break;
  }
  return ambulo__io_error(diagnostics, folder->path, "create");
}

ambulo_status ambulo__folder_begin(const char *path, const ambulo__folder_mark *mark,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo__folder **folder) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_status status = ambulo__expect_path(path, "folder to write", diagnostics);
  if (status) return status;
  ambulo__folder *f = ambulo__alloc(&own, 1, sizeof *f);
  if (!f) return ambulo__io_memory_error(diagnostics, path);
  f->allocator = own;
  f->path = ambulo__strdup(&own, path);
  f->mark = mark;
  if (!f->path) {
    ambulo__folder_abort(f, diagnostics);
    return ambulo__io_memory_error(diagnostics, path);
  }
  /* "out/" and "out" are one place; the temporary must be a sibling, not a child */
  for (size_t n = strlen(f->path); n > 1 && f->path[n - 1] == '/'; n--) f->path[n - 1] = '\0';
  int occupied;
  status = inspect_target(f, diagnostics, &occupied);
  if (status == AMBULO_OK) {
    f->parent = ambulo__parent_path(&own, f->path);
    status =
        f->parent ? create_temporary(f, diagnostics) : ambulo__io_memory_error(diagnostics, path);
  }
  if (status != AMBULO_OK) {
    ambulo__folder_abort(f, diagnostics);
    return status;
  }
  *folder = f;
  return AMBULO_OK;
}

/* The folder is a temporary as a whole, so its files need none of their own, and its entries are
 * flushed once, by the commit. */
ambulo_status ambulo__folder_write(ambulo__folder *folder, const char *name, const char *data,
                                   size_t length, ambulo_diagnostics *diagnostics) {
  if (name[0] == '\0' || is_dot(name) || strchr(name, '/')) return AMBULO_E_ARGUMENT;
  char *path = ambulo__join_paths(&folder->allocator, folder->temporary, name, NULL);
  if (!path) return ambulo__io_memory_error(diagnostics, name);
  int file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  ambulo_status status = ambulo__fill_file(file, path, data, length, 1, diagnostics);
  if (status) (void)unlink(path);
  ambulo__free(&folder->allocator, path);
  return status;
}

/* renames the old result away; *aside is its new name */
static ambulo_status step_aside(const ambulo__folder *folder, ambulo_diagnostics *diagnostics,
                                char **aside) {
  for (int k = 0; k < NAME_ATTEMPTS; k++) {
    char *name = ambulo__sibling_name(&folder->allocator, folder->path, "old", k);
    if (!name) return ambulo__io_memory_error(diagnostics, folder->path);
    if (rename(folder->path, name) == 0) {
      *aside = name;
      return AMBULO_OK;
    }
    int reason = errno;
    ambulo__free(&folder->allocator, name);
    errno = reason;
    if (reason != EEXIST && reason != ENOTEMPTY) break;
  }
  return ambulo__io_error(diagnostics, folder->path, "replace");
}

static ambulo_status move_into_place(ambulo__folder *folder, ambulo_diagnostics *diagnostics) {
  char *aside = NULL;
  int occupied;
  ambulo_status status = inspect_target(folder, diagnostics, &occupied);
  if (status == AMBULO_OK && occupied) status = step_aside(folder, diagnostics, &aside);
  if (status != AMBULO_OK) return status;
  if (rename(folder->temporary, folder->path) != 0) {
    status = ambulo__io_error(diagnostics, folder->path, "create");
    if (aside && rename(aside, folder->path) != 0) {
      ambulo__place place = {.file = aside};
      ambulo__warning(diagnostics, place, "rename it by hand",
                      "the earlier result stays here: it cannot be put back: %s", strerror(errno));
    }
  } else {
    folder->created = 0;
    if (aside) remove_or_tell(aside, "the earlier result", diagnostics);
    if (ambulo__sync_folder(folder->parent) != 0) {
      status = ambulo__io_error(diagnostics, folder->path, "flush the folder of");
    }
  }
  ambulo__free(&folder->allocator, aside);
  return status;
}

ambulo_status ambulo__folder_commit(ambulo__folder *folder, ambulo_diagnostics *diagnostics) {
  ambulo_status status = AMBULO_OK;
  if (ambulo__sync_folder(folder->temporary) != 0) {
    status = ambulo__io_error(diagnostics, folder->path, "flush to disk");
  }
  if (status == AMBULO_OK) status = move_into_place(folder, diagnostics);
  if (status == AMBULO_OK) tell_leftovers(folder, diagnostics);
  ambulo__folder_abort(folder, diagnostics);
  return status;
}
