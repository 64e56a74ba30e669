/* formats/output_check.h - what a single output file must not be written over. */
#ifndef AMBULO_FORMATS_OUTPUT_CHECK_H
#define AMBULO_FORMATS_OUTPUT_CHECK_H

#include "base/diagnostics.h"

/* First characters of every table that ambulo writes as a single file: how it knows its own. */
#define AMBULO__OWN_MARK "# ambulo"

/* AMBULO_OK if `output` may be written: nothing is there, an empty file, a device or a pipe, or a
 * file that ambulo wrote and that is none of inputs[count] (whose entries may be NULL). The same
 * file counts whatever the path to it: another spelling, a hard or a symbolic link. `force`: a file
 * is written over all the same. Errors: E_IO. */
ambulo_status ambulo__output_check(const char *output, const char *const *inputs, int count,
                                   int force, ambulo_diagnostics *diagnostics);

/* 1 if the file can be read and its first `within` bytes (at most 4096) contain `text`; within =
 * strlen(text): it begins with it. */
int ambulo__file_says(const char *path, const char *text, size_t within);

#endif
