/* people/compare_map.h - which column of a result belongs to which curve of a reference
 * (docs/compare.md). */
#ifndef AMBULO_PEOPLE_COMPARE_MAP_H
#define AMBULO_PEOPLE_COMPARE_MAP_H

#include "formats/sheet.h"

#define AMBULO__CURVE_NAME 64

/* How a reference file is laid out. */
typedef enum ambulo__reference_layout {
  AMBULO__LAYOUT_BAND,     /* variable,percent,mean_deg,sd_deg */
  AMBULO__LAYOUT_QUANTITY, /* quantity,variable,percent,mean,sd */
  AMBULO__LAYOUT_WIDE      /* one column a curve beside one of the percents */
} ambulo__reference_layout;

typedef enum ambulo__curve_unit {
  AMBULO__UNIT_ANGLE,  /* deg, from rad */
  AMBULO__UNIT_MOMENT, /* N m/kg, from N m */
  AMBULO__UNIT_FORCE,  /* N/kg, from N */
  AMBULO__UNIT_POWER   /* W/kg, from W */
} ambulo__curve_unit;

/* One line of the map. `result` is a column of motion.csv or a sum of such ("a+b"), with
 * {side} for l or r and {foot} for the foot's name; "grf.{foot}.up", "grf.{foot}.forward" are
 * components along the body's axes, "power.NAME" is tau times qd. */
typedef struct ambulo__map_entry {
  char curve[AMBULO__CURVE_NAME], reference[AMBULO__CURVE_NAME], result[192];
  double factor; /* on the left side */
  int opposite;  /* 1: the right side takes -factor */
  int tilted;    /* 1: the pelvic tilt is added */
  ambulo__curve_unit unit;
} ambulo__map_entry;

typedef struct ambulo__map {
  ambulo_allocator allocator;
  ambulo__map_entry *entries;
  int count;
} ambulo__map;

/* The built-in map of a layout. E_MEMORY. */
ambulo_status ambulo__map_default(ambulo__reference_layout layout,
                                  const ambulo_allocator *allocator, ambulo__map *map);
/* From a CSV with the columns curve, reference, result, unit and, if wanted, factor,
 * right_factor, tilted. Errors as of ambulo__sheet_read, and E_SCHEMA. */
ambulo_status ambulo__map_read(const char *path, const ambulo_allocator *allocator,
                               ambulo_diagnostics *diagnostics, ambulo__map *map);
void ambulo__map_free(ambulo__map *map); /* accepts a zero-filled one */

/* "deg", "N m/kg", "N/kg", "W/kg". */
const char *ambulo__curve_unit_name(ambulo__curve_unit unit);

#endif
