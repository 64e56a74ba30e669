/* study/case_files.h - the files of a finished case and their checksums.
 *
 * They are the files of its result folder and its log, where it has one; the record names each with
 * its SHA-256, so that later damage to any of them is seen. */
#ifndef AMBULO_STUDY_CASE_FILES_H
#define AMBULO_STUDY_CASE_FILES_H

#include "base/alloc.h"
#include "base/diagnostics.h"
#include "formats/sha256.h"

enum { AMBULO__CASE_FILES = 16, AMBULO__CASE_FILE_NAME = 64, AMBULO__DAMAGE_TEXT = 200 };

typedef struct ambulo__case_file {
  char ending[AMBULO__CASE_FILE_NAME]; /* after the id: "/motion.csv", ".log" */
  char digest[AMBULO__SHA256_TEXT];
} ambulo__case_file;

/* Sorted by ending. */
typedef struct ambulo__case_files {
  int count;
  ambulo__case_file file[AMBULO__CASE_FILES];
} ambulo__case_files;

/* What is wrong with a finished case. */
typedef struct ambulo__damage {
  char ending[AMBULO__CASE_FILE_NAME]; /* of the file; ".json": the record itself */
  char what[AMBULO__DAMAGE_TEXT];      /* "is not what was written" */
} ambulo__damage;

/* Computes the checksums of what stands there now. *result = 1: there is a result folder.
 * Errors: E_IO, E_LIMIT (more files than a result has), E_MEMORY. */
ambulo_status ambulo__case_files_list(const char *directory, const char *id,
                                      const ambulo_allocator *allocator,
                                      ambulo_diagnostics *diagnostics, ambulo__case_files *files,
                                      int *result);
/* *intact = 0 and *damage, when one of them is missing, cannot be read, or is another.
 * Errors: E_MEMORY. */
ambulo_status ambulo__case_files_check(const char *directory, const char *id,
                                       const ambulo__case_files *files,
                                       const ambulo_allocator *allocator, int *intact,
                                       ambulo__damage *damage);
/* Whether the list has a file of this ending. */
int ambulo__case_files_have(const ambulo__case_files *files, const char *ending);

/* A failure to read a file of the case: E_MEMORY goes on, anything else becomes *damage (its first
 * error's text) and AMBULO_OK. */
ambulo_status ambulo__damage_of(ambulo_status status, const char *ending,
                                const ambulo_diagnostics *reasons, ambulo__damage *damage);

#endif
