/* batch/paths.h - names of files, and hashes. */
#ifndef AMBULO_BATCH_PATHS_H
#define AMBULO_BATCH_PATHS_H

#include "base/alloc.h"

/* `name` as seen from the folder of `file`; absolute names stay. NULL: no memory. */
char *ambulo__sibling_path(const ambulo_allocator *allocator, const char *file, const char *name);
/* directory/first[/second]; `second` may be NULL. NULL: no memory. */
char *ambulo__join_paths(const ambulo_allocator *allocator, const char *directory,
                         const char *first, const char *second);
/* DIR/cases/<last two digits of the id>/<id><ending>: at most 256 neighbours of a million cases
 * share a folder's fan-out, and a listing stays short. */
char *ambulo__case_path(const ambulo_allocator *allocator, const char *directory, const char *id,
                        const char *ending);

/* FNV-1a, 64 bit; start with AMBULO__HASH_START. */
#define AMBULO__HASH_START 14695981039346656037ULL
unsigned long long ambulo__hash_text(unsigned long long hash, const char *text);
unsigned long long ambulo__hash_word(unsigned long long hash, unsigned long long word);

#endif
