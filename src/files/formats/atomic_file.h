/* formats/atomic_file.h - results appear whole or not at all.
 *
 * A file is written under a temporary name in its own folder, flushed to the disk and
 * renamed; a result folder is filled beside its final place and renamed. On any failure
 * (disk full, quota, no permission) the temporary is removed, what stood there before
 * stays, and E_IO is reported with the system's reason. A killed process may leave a
 * temporary "<name>.tmp-<pid>-<k>", or the earlier result as "<name>.old-<pid>-<k>", but never half
 * a result. What stays is named by a warning: where it cannot be removed, and of a folder by the
 * next run that has written it.
 *
 * Exception: a path that names a device, FIFO or socket is written directly. */
#ifndef AMBULO_FORMATS_ATOMIC_FILE_H
#define AMBULO_FORMATS_ATOMIC_FILE_H

#include "base/alloc.h"
#include "base/diagnostics.h"

/* replace = 0: an existing regular file is refused. Errors: E_IO, E_MEMORY. */
ambulo_status ambulo__write_file(const char *path, const char *data, size_t length, int replace,
                                 const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics);

/* A folder in the making. */
typedef struct ambulo__folder ambulo__folder;

/* How a folder is known to be an earlier result, and nothing but that. */
typedef struct ambulo__folder_mark {
  const char *file;         /* a regular file in it ... */
  const char *text;         /* ... whose first 256 bytes contain this */
  const char *const *names; /* [count]: what a result may hold */
  int count;
} ambulo__folder_mark;

/* Creates the temporary sibling of `path`. An existing folder at `path` is refused unless
 * it is empty, or unless `mark` is given and fits: ambulo__folder_commit then replaces it
 * (NULL: never replace). A folder that holds anything besides, which would be lost, is refused
 * by its name. `mark` must outlive the folder. Errors: E_IO, E_MEMORY. */
ambulo_status ambulo__folder_begin(const char *path, const ambulo__folder_mark *mark,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo__folder **folder);
/* Writes and flushes one file in it; `name` without '/'. Errors: E_ARGUMENT, E_IO, E_MEMORY. */
ambulo_status ambulo__folder_write(ambulo__folder *folder, const char *name, const char *data,
                                   size_t length, ambulo_diagnostics *diagnostics);
/* Moves the folder to its place. On failure the temporary is removed and what stood there
 * stays. Frees `folder` in any case. */
ambulo_status ambulo__folder_commit(ambulo__folder *folder, ambulo_diagnostics *diagnostics);
/* Removes the temporary folder and frees; accepts NULL. */
void ambulo__folder_abort(ambulo__folder *folder, ambulo_diagnostics *diagnostics);

/* First characters of every table that ambulo writes as a single file: how it knows its own. */
#define AMBULO__OWN_MARK "# ambulo"

/* AMBULO_OK if `output` may be written: nothing is there, an empty file, a device or a pipe, or a
 * file that ambulo wrote and that is none of inputs[count] (whose entries may be NULL), nor a file
 * of one that is a folder. The same file counts whatever the path to it: another spelling, a hard
 * or a symbolic link. `force`: a file is written over all the same. Errors: E_IO. */
ambulo_status ambulo__output_check(const char *output, const char *const *inputs, int count,
                                   int force, ambulo_diagnostics *diagnostics);

/* 1 if the file can be read and its first `within` bytes (at most 4096) contain `text`; within =
 * strlen(text): it begins with it. */
int ambulo__file_says(const char *path, const char *text, size_t within);

/* ---------------------------------------------------------------- single steps */

/* Reports "cannot <action>: <strerror(errno)>" about a file: E_IO, or E_MEMORY when the system had
 * none. */
ambulo_status ambulo__io_error(ambulo_diagnostics *diagnostics, const char *path,
                               const char *action);
/* E_MEMORY with a message about a file. */
ambulo_status ambulo__io_memory_error(ambulo_diagnostics *diagnostics, const char *path);

/* E_ARGUMENT, with a message, for an empty name; `what` it is the name of: "file", "folder". NULL
 * is for callers who may leave it out. */
ambulo_status ambulo__expect_path(const char *path, const char *what,
                                  ambulo_diagnostics *diagnostics);

/* Writes `data` into an open file, which it closes, and flushes it if asked to; file -1: it could
 * not be opened, and errno says why. Errors: E_IO, E_MEMORY. */
ambulo_status ambulo__fill_file(int file, const char *path, const char *data, size_t length,
                                int flush, ambulo_diagnostics *diagnostics);
/* fsync of a folder; 0, or -1 with errno. File systems that cannot flush folders count as
 * success. */
int ambulo__sync_folder(const char *path);

#endif
