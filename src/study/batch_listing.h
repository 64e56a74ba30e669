/* study/batch_listing.h - what a batch folder says about itself.
 *
 * DIR/cases.tsv: one line a case: id, key (16 hexadecimal digits), name, one column an axis.
 * DIR/batch.json: name, version, base problem and its hash, checksum of the list, axes, outputs;
 * sealed (formats/seal.h).
 * Both are written when a run begins; everything that only reads the folder starts here. */
#ifndef AMBULO_STUDY_BATCH_LISTING_H
#define AMBULO_STUDY_BATCH_LISTING_H

#include "ambulo/tools/batch.h"
#include "base/alloc.h"
#include "base/diagnostics.h"
#include "study/front.h"

enum {
  AMBULO__LISTING_ID,
  AMBULO__LISTING_KEY,
  AMBULO__LISTING_NAME,
  AMBULO__LISTING_AXES /* first axis */
};

#define AMBULO__LISTING_SCHEMA "ambulo-batch/2"
#define AMBULO__LISTING_WITHOUT_CHECKSUMS "ambulo-batch/1"

enum { AMBULO__LISTING_NAMES = 256 }; /* looked through for the nearest name */

/* Of a front (sweep.h): its terms, whose weights are the axes. */
typedef struct ambulo__listing_front {
  int terms, points;
  double least;
  char **name; /* [terms] */
  double own[AMBULO__FRONT_TERMS];
} ambulo__listing_front;

typedef struct ambulo__listing {
  ambulo_allocator allocator;
  char *text;
  const char **cell; /* [cases + 1][columns]; row 0: titles */
  int cases, columns;
  char **output, **output_label, **output_unit; /* [outputs] */
  char **axis_label, **axis_unit;               /* [axes] */
  int outputs, axes;                            /* axes: columns - AMBULO__LISTING_AXES */
  int zipped;                                   /* the first so many axes advance together */
  char *name, *version, *problem_hash, *text_hash;
  char *digest;                /* SHA-256 of cases.tsv, as batch.json says */
  ambulo__listing_front front; /* terms 0: none */
  char *front_text; /* the key `front` and what points start from, as a text; NULL: none */
} ambulo__listing;

/* Errors: E_IO (no such folder, no batch in it, either file damaged), E_PROBLEM (of a version that
 * wrote no checksums, or of a later one), E_MEMORY. */
ambulo_status ambulo__listing_load(const char *directory, const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo__listing *listing);
/* The same, and *damaged = 1 where a file is there, and is not what was written. */
ambulo_status ambulo__listing_try(const char *directory, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo__listing *listing,
                                  int *damaged);
void ambulo__listing_free(ambulo__listing *listing);
/* Cell of case `index` (0-based). */
const char *ambulo__listing_cell(const ambulo__listing *listing, int index, int column);
const char *ambulo__listing_title(const ambulo__listing *listing, int column);
/* The output with this label or path; -1: none. */
int ambulo__listing_output(const ambulo__listing *listing, const char *name);
unsigned long long ambulo__listing_key(const ambulo__listing *listing, int index);

/* Creates DIR and DIR/cases; a folder that holds other things is refused. Errors: E_IO. */
ambulo_status ambulo__batch_make_folders(const char *directory, const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics);

/* Whether the folder, if it is a batch folder already, is that of this sweep: refused as below. */
ambulo_status ambulo__listing_check(const ambulo_sweep *sweep, const char *directory, int force,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics);

/* Makes the folder a batch folder of this sweep. One that holds another list is refused, with
 * what changed, unless force = 1; so is one without checksums. A damaged list is written anew, with
 * a warning: the records carry the keys themselves. Errors: E_IO, E_PROBLEM (changed), E_MEMORY. */
ambulo_status ambulo__listing_prepare(const ambulo_sweep *sweep, const char *directory, int force,
                                      const ambulo_allocator *allocator,
                                      ambulo_diagnostics *diagnostics);

#endif
