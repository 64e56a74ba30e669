/* retarget/source.h - the motion that is given: a body, and its coordinates over time.
 *
 * Tables of angles move a body of the caller's. Other formats bring a skeleton along, which becomes
 * a model of its own: its text stands in source.yaml beside the result, so that the page can show
 * it. */
#ifndef AMBULO_RETARGET_SOURCE_H
#define AMBULO_RETARGET_SOURCE_H

#include "ambulo/tools/retarget.h"
#include "base/alloc.h"
#include "base/diagnostics.h"
#include "base/text_buffer.h"

typedef struct ambulo__given {
  ambulo_allocator allocator;
  const ambulo_model *body;
  ambulo_model *own;        /* the same, where it came with the file; NULL */
  ambulo__text_buffer text; /* its model file; empty without */
  int unplaced;             /* 1: nothing says where the body is, only how its joints turn */
  int rows;
  double *time; /* [rows], s from 0 */
  double *q;    /* [rows][coordinates], rad and m */
} ambulo__given;

/* Reads `path` by its ending, the part of it that the options ask for. Errors: E_IO, E_PARSE,
 * E_SCHEMA, E_MODEL, E_LIMIT, E_MEMORY. */
ambulo_status ambulo__given_read(const char *path, const ambulo_retarget_options *options,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo__given *given);
void ambulo__given_free(ambulo__given *given); /* accepts a zero-filled one */

/* Room for so many rows. E_MEMORY. */
ambulo_status ambulo__given_rows(ambulo__given *given, int rows);

/* Whole files of one format; `given` has an allocator and a text, and of a table the body. */
ambulo_status ambulo__given_table(const char *path, ambulo_diagnostics *diagnostics,
                                  ambulo__given *given);
ambulo_status ambulo__given_smpl(const char *path, ambulo_diagnostics *diagnostics,
                                 ambulo__given *given);
ambulo_status ambulo__given_bvh(const char *path, ambulo_diagnostics *diagnostics,
                                ambulo__given *given);

#endif
