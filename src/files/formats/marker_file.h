/* formats/marker_file.h - trajectories of markers, as motion capture writes them (TRC).
 *
 * A TRC file has five lines above its rows: "PathFileType ...", keys (NumFrames, Units, ...), their
 * values, the names of the columns (Frame#, Time, then one of each marker, over three columns) and
 * X1 Y1 Z1 X2 ... Cells are separated by tabs. */
#ifndef AMBULO_FORMATS_MARKER_FILE_H
#define AMBULO_FORMATS_MARKER_FILE_H

#include "formats/motion_file.h"

/* 1: the name of the file ends like that of a TRC. */
int ambulo__is_marker_file(const char *name);

/* A table with columns NAME.x, NAME.y, NAME.z in m, axes as in the file; NaN where a marker was not
 * seen (an empty cell, "nan"). Errors: E_PARSE (shape of the text), E_SCHEMA (names, numbers,
 * times, units), E_LIMIT, E_MEMORY. */
ambulo_status ambulo__markers_parse(const char *text, size_t length, const char *name,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo__motion **motion);
/* The same of a file, which is taken in (formats/inputs.h). Errors: also E_IO. */
ambulo_status ambulo__markers_read_input(ambulo__inputs *inputs, const char *path,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics, ambulo__motion **motion);

#endif
