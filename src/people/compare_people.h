/* people/compare_people.h - the curves of people that a motion is set beside: those of one file,
 * or the shipped norms.
 *
 * The norms are a folder of two tables (models/norms/README.md):
 *   young_adults.csv     angles, mean and deviation           AMBULO__LAYOUT_BAND
 *   normal_cadence.csv   angles, moments, forces, means only  AMBULO__LAYOUT_WIDE
 * A curve that both have is that of the first. A file names its people in a line
 * "# source: ...", which goes to `source`. */
#ifndef AMBULO_PEOPLE_COMPARE_PEOPLE_H
#define AMBULO_PEOPLE_COMPARE_PEOPLE_H

#include "people/compare_reference.h"

enum { AMBULO__PEOPLE_FILES = 2 };

typedef struct ambulo__people_file {
  char *path, *source; /* source: NULL where the file names none */
  ambulo__map map;
  ambulo__reference reference; /* its curves point into the map */
} ambulo__people_file;

typedef struct ambulo__people {
  ambulo_allocator allocator;
  int count;
  ambulo__people_file files[AMBULO__PEOPLE_FILES];
} ambulo__people;

/* One file, with the column map of a file or (NULL) the built-in one of its layout. Errors: as of
 * ambulo__sheet_read, ambulo__map_read and ambulo__reference_curves. */
ambulo_status ambulo__people_read(const char *path, const char *map,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo__people *people);
/* The shipped ones, in their folder. */
ambulo_status ambulo__norms_read(const char *folder, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo__people *people);
void ambulo__people_free(ambulo__people *people); /* accepts a zero-filled one */

#endif
