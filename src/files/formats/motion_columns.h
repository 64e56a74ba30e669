/* formats/motion_columns.h - the columns of a motion that belong to a coordinate. */
#ifndef AMBULO_FORMATS_MOTION_COLUMNS_H
#define AMBULO_FORMATS_MOTION_COLUMNS_H

#include "formats/motion_file.h"

typedef enum ambulo__motion_order {
  AMBULO__ORDER_VALUE,       /* NAME, q.NAME, .../NAME, .../NAME/value */
  AMBULO__ORDER_RATE,        /* qd.NAME, NAME_u, .../NAME/speed */
  AMBULO__ORDER_ACCELERATION /* qdd.NAME, .../NAME/accel, .../NAME/acceleration */
} ambulo__motion_order;

/* 1: `column` is a name of the coordinate's value, rate or acceleration. */
int ambulo__motion_names(const char *column, const char *coordinate, ambulo__motion_order order);
/* 1: `column` can only be the value of some coordinate: q.NAME, /jointset/.../NAME/value. */
int ambulo__motion_is_value(const char *column);

/* Sets *column to the column of a coordinate under one of the names that result files and OpenSim
 * give it, or to -1. Paths below /forceset/ are actuators, never coordinates. Columns that agree in
 * every row are one; two that do not are an E_SCHEMA that names both and where they part (`file`
 * for the message). */
ambulo_status ambulo__motion_find(const ambulo__motion *motion, const char *file,
                                  const char *coordinate, ambulo__motion_order order,
                                  ambulo_diagnostics *diagnostics, int *column);

#endif
