/* formats/file_steps.h - the single steps that atomic files and atomic folders share. */
#ifndef AMBULO_FORMATS_FILE_STEPS_H
#define AMBULO_FORMATS_FILE_STEPS_H

#include "base/alloc.h"
#include "base/diagnostics.h"

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

/* "<path>.<kind>-<pid>-<k>", where <kind> is "tmp" or "old"; free with ambulo__free. */
char *ambulo__sibling_name(const ambulo_allocator *allocator, const char *path, const char *kind,
                           int k);
/* "<folder>/<name>" */
char *ambulo__join_path(const ambulo_allocator *allocator, const char *folder, const char *name);

/* Path of the folder that holds `path` ("." without a '/'). */
char *ambulo__parent_path(const ambulo_allocator *allocator, const char *path);

/* write(2) until all is out; 0, or -1 with errno */
int ambulo__write_all(int file, const char *data, size_t length);
/* fsync of a folder; 0, or -1 with errno. File systems that cannot flush folders count as
 * success. */
int ambulo__sync_folder(const char *path);

#endif
