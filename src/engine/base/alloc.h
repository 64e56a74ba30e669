/* base/alloc.h - the one door to memory: overflow-checked, through the caller's hook.
 *
 * Every object keeps the ambulo_allocator it was made with; {NULL, NULL} stands
 * for realloc/free. */
#ifndef AMBULO_BASE_ALLOC_H
#define AMBULO_BASE_ALLOC_H

#include "ambulo/status.h"

/* Copy of *allocator, or the default when NULL. */
ambulo_allocator ambulo__allocator_or_default(const ambulo_allocator *allocator);

/* count * size bytes, zero-filled, or NULL (also when the product overflows).
 * A request for nothing yields a valid block of one byte. */
void *ambulo__alloc(const ambulo_allocator *allocator, size_t count, size_t size);
/* The same, aligned to 64 bytes; free with ambulo__free_aligned. */
void *ambulo__alloc_aligned(const ambulo_allocator *allocator, size_t count, size_t size);
/* Grows or shrinks; new bytes are not cleared; NULL leaves `pointer` as it was. */
void *ambulo__realloc(const ambulo_allocator *allocator, void *pointer, size_t count, size_t size);
void ambulo__free(const ambulo_allocator *allocator, void *pointer);         /* accepts NULL */
void ambulo__free_aligned(const ambulo_allocator *allocator, void *pointer); /* accepts NULL */
char *ambulo__strdup(const ambulo_allocator *allocator, const char *text);

#endif
