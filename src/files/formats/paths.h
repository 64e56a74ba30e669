/* formats/paths.h - names of files. */
#ifndef AMBULO_FORMATS_PATHS_H
#define AMBULO_FORMATS_PATHS_H

#include "base/alloc.h"
#include "base/diagnostics.h"

/* `name` as seen from the folder of `file`; absolute names stay. NULL: no memory. */
char *ambulo__sibling_path(const ambulo_allocator *allocator, const char *file, const char *name);
/* directory/first[/second]; `second` may be NULL. NULL: no memory. */
char *ambulo__join_paths(const ambulo_allocator *allocator, const char *directory,
                         const char *first, const char *second);
/* The parts, one after the other. NULL: no memory. */
char *ambulo__join_parts(const ambulo_allocator *allocator, const char *const *part, int parts);

/* Path of the folder that holds `path` ("." without a '/'). NULL: no memory. */
char *ambulo__parent_path(const ambulo_allocator *allocator, const char *path);
/* "<path>.<kind>-<pid>-<k>", where <kind> is "tmp" or "old". NULL: no memory. */
char *ambulo__sibling_name(const ambulo_allocator *allocator, const char *path, const char *kind,
                           int k);

/* `path` is `name` as seen from some folder. *shipped: where nothing is there and
 * the name is relative, without "..", the file of that name below the folder that the environment
 * calls AMBULO_MODELS; NULL when `path` is to be taken. Errors: E_MEMORY. */
ambulo_status ambulo__shipped_path(const ambulo_allocator *allocator, const char *path,
                                   const char *name, char **shipped);
/* Says, once, that `name` stands for the shipped file `path`. */
void ambulo__note_shipped(ambulo_diagnostics *diagnostics, ambulo__place place, const char *name,
                          const char *path);
/* *path: `name` as seen from the folder of `file`, or the shipped file, which a note at `place`
 * says. Errors: E_MEMORY. */
ambulo_status ambulo__named_file(const ambulo_allocator *allocator, const char *file,
                                 const char *name, ambulo__place place,
                                 ambulo_diagnostics *diagnostics, char **path);

/* How a file of folder `to` is written as seen from folder `from`: "", "../../a/",
 * or an absolute path that ends with '/'. Both folders exist. NULL: one of them does not, or no
 * memory.
 */
char *ambulo__path_between(const ambulo_allocator *allocator, const char *from, const char *to);

#endif
