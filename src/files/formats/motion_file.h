/* formats/motion_file.h - a motion as a table: named columns over time.
 *
 * Formats, one header row and numbers with '.' below it:
 *   CSV  cells separated by ',', lines that start with '#' are comments
 *   STO, MOT (OpenSim)  a title and key=value lines up to "endheader", then columns
 *        separated by tabs or spaces; inDegrees=yes|no states the unit of angles, which are in
 *        degrees where there is no version=... either, as OpenSim takes files of SIMM. nRows, where
 *        given, is not more than the table has (a cut-off file is noticed); less, and another
 *        nColumns, are warned of.
 * A comment "# inDegrees=yes" says the same in a CSV. The first column is "time" (s),
 * strictly increasing (but rows of an STO that repeat the one before, which are left out); names
 * are unique; every number is finite, except that points of the
 * ground that do not exist (columns "zmp.*", "cop.*") are "nan". CRLF, a byte-order mark,
 * empty lines and a missing final newline are accepted.
 *
 * Tables that ambulo writes say in their first line whose motion they hold (motion_write.h). */
#ifndef AMBULO_FORMATS_MOTION_FILE_H
#define AMBULO_FORMATS_MOTION_FILE_H

#include "ambulo/model.h"
#include "base/alloc.h"
#include "base/diagnostics.h"
#include "formats/inputs.h"
#include "formats/sheet.h"

#define AMBULO__MOTION_MAX_BYTES ((size_t)64 * 1024 * 1024)
#define AMBULO__MOTION_MAX_COLUMNS 4096
#define AMBULO__MOTION_MAX_NAME 255

typedef struct ambulo__motion {
  ambulo_allocator allocator;
  int rows, columns; /* columns: without time */
  int in_degrees;    /* 1: angles are in degrees, as in the file or by SIMM's custom; 0: radians */
  int unit_stated;   /* 1: the file says which */
  int declared_columns; /* as the header says, with time; -1: it does not. Published files are wrong
                           about it; rows of another length than the names are faults */
  double body_mass;     /* kg, of a table by ambulo; NaN: not stated */
  double gravity[3];    /* m/s^2, with body_mass */
  char **names;         /* [columns] */
  double *time;         /* [rows], s */
  double *values;       /* [rows][columns] */
} ambulo__motion;

typedef enum ambulo__motion_format {
  AMBULO__MOTION_AUTO, /* by the name's ending (.csv, .sto, .mot), else by "endheader" */
  AMBULO__MOTION_CSV,
  AMBULO__MOTION_STO
} ambulo__motion_format;

/* Zero-filled table with copied names. Errors: E_ARGUMENT, E_MEMORY. */
ambulo_status ambulo__motion_create(int rows, int columns, const char *const *names,
                                    const ambulo_allocator *allocator, ambulo__motion **motion);
void ambulo__motion_free(ambulo__motion *motion); /* accepts NULL */

/* gaps 1: any cell below a name may be "nan", as measured forces have gaps. Errors: E_IO, E_LIMIT
 * (size, columns), E_PARSE (shape of the text), E_SCHEMA (names, numbers, times), E_MEMORY. All
 * faults of a file are reported in one go. */
ambulo_status ambulo__motion_read(const char *path, int gaps, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo__motion **motion);
/* The same, and takes the file in (formats/inputs.h). */
ambulo_status ambulo__motion_read_input(ambulo__inputs *inputs, const char *path, int gaps,
                                        const ambulo_allocator *allocator,
                                        ambulo_diagnostics *diagnostics, ambulo__motion **motion);
/* The same of a text under that name. */
ambulo_status ambulo__table_read(const char *text, size_t length, const char *name,
                                 ambulo__motion_format format, int gaps,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo__motion **motion);
/* Format that a file name asks for: AUTO when its ending is none of the known. */
ambulo__motion_format ambulo__motion_format_of(const char *name);

/* Column of a name, or -1; those of coordinates: ambulo__motion_find. */
int ambulo__motion_column(const ambulo__motion *motion, const char *name);

/* Degrees to radians in the columns with is_angle[column] != 0, if the table is in degrees;
 * in_degrees is cleared. */
void ambulo__motion_to_radians(ambulo__motion *motion, const unsigned char *is_angle);

/* ------------------------------------------------- lines above the column names */

typedef struct ambulo__table_header {
  int in_degrees, unit_stated;               /* unit of angles, and whether the file says so */
  int has_version;                           /* a line version=...: not of SIMM */
  long long declared_rows, declared_columns; /* -1: not stated */
  int rows_line;                             /* where the former is */
  double body_mass, gravity[3];              /* kg, m/s^2; mass NaN: not stated */
} ambulo__table_header;

ambulo__table_header ambulo__table_header_default(void);

/* Takes in one line: of an STO or MOT header "key = value" (inDegrees, version, nRows or datarows,
 * nColumns or datacolumns), as SIMM has it "datarows 8", and the sentence "Angles are in degrees.";
 * of a CSV a comment "# inDegrees=yes" and, in its first line, whose motion it is. Anything else is
 * a title or a remark. Errors: E_SCHEMA. */
ambulo_status ambulo__table_header_take(const ambulo__table_line *line, int is_sto,
                                        const char *file, ambulo_diagnostics *diagnostics,
                                        ambulo__table_header *header);

/* -------------------------------------------- columns that belong to a coordinate */

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

/* The size beyond which a value (rad or m) is doubted: ten times the range of the joint, and for an
 * angle that has a range no more than a turn; ten turns for an angle without range, INFINITY for a
 * length without. Degrees taken for radians, and millimetres for metres, are beyond it unless the
 * motion is minute. */
double ambulo__largest_plausible(const ambulo_coordinate *coordinate);

#endif
