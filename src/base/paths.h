/* base/paths.h - names of files. */
#ifndef AMBULO_BASE_PATHS_H
#define AMBULO_BASE_PATHS_H

#include "base/alloc.h"

/* `name` as seen from the folder of `file`; absolute names stay. NULL: no memory. */
char *ambulo__sibling_path(const ambulo_allocator *allocator, const char *file, const char *name);
/* directory/first[/second]; `second` may be NULL. NULL: no memory. */
char *ambulo__join_paths(const ambulo_allocator *allocator, const char *directory,
                         const char *first, const char *second);
/* The parts, one after the other. NULL: no memory. */
char *ambulo__join_parts(const ambulo_allocator *allocator, const char *const *part, int parts);

/* path_between.c: how a file of folder `to` is written as seen from folder `from`: "", "../../a/",
 * or an absolute path that ends with '/'. Both folders exist. NULL: one of them does not, or no
 * memory.
 */
char *ambulo__path_between(const ambulo_allocator *allocator, const char *from, const char *to);

#endif
