/* people/compare_reference.h - normative curves over the gait cycle (docs/compare.md). */
#ifndef AMBULO_PEOPLE_COMPARE_REFERENCE_H
#define AMBULO_PEOPLE_COMPARE_REFERENCE_H

#include "people/compare_map.h"

typedef struct ambulo__reference_curve {
  const ambulo__map_entry *entry; /* of the map that was read with */
  int points;
  double *percent; /* [points], rising in [0, 100] */
  double *mean;    /* [points], unit of the entry */
  double *sd;      /* [points], > 0; NULL: the file gives none */
} ambulo__reference_curve;

typedef struct ambulo__reference {
  ambulo_allocator allocator;
  ambulo__reference_curve *curves;
  int count;
} ambulo__reference;

/* The layout, told by the header line, whose index goes to *header. E_SCHEMA if unknown. */
ambulo_status ambulo__reference_layout_of(const ambulo__sheet *sheet,
                                          ambulo_diagnostics *diagnostics,
                                          ambulo__reference_layout *layout, int *header);

/* The curves that both the map and the sheet have, in the order of the map; the others are left
 * out. E_SCHEMA (numbers, percents that do not rise, no curve at all), E_MEMORY. */
ambulo_status ambulo__reference_curves(const ambulo__sheet *sheet, ambulo__reference_layout layout,
                                       int header, const ambulo__map *map,
                                       ambulo_diagnostics *diagnostics,
                                       ambulo__reference *reference);
void ambulo__reference_curve_free(const ambulo_allocator *allocator,
                                  ambulo__reference_curve *curve);
void ambulo__reference_free(ambulo__reference *reference); /* accepts a zero-filled one */

#endif
