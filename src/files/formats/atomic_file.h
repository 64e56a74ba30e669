/* formats/atomic_file.h - results appear whole or not at all.
 *
 * A file is written under a temporary name in its own folder, flushed to the disk and
 * renamed; a result folder is filled beside its final place and renamed. On any failure
 * (disk full, quota, no permission) the temporary is removed, what stood there before
 * stays, and E_IO is reported with the system's reason. A killed process may leave a
 * temporary "<name>.tmp-<pid>-<k>" but never half a result.
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
void ambulo__folder_abort(ambulo__folder *folder);

#endif
