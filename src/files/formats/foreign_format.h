/* formats/foreign_format.h - files of other programs, known by their first bytes whatever their
 * names are: skeletons of OpenSim, URDF and MJCF, markers, archives, pictures, text in UTF-16. */
#ifndef AMBULO_FORMATS_FOREIGN_FORMAT_H
#define AMBULO_FORMATS_FOREIGN_FORMAT_H

#include "base/diagnostics.h"

#include <stddef.h>

/* What a reader takes: everything else is foreign to it. */
typedef enum ambulo__taken {
  AMBULO__TAKES_YAML,  /* models, problems, solutions, sweeps; JSON is YAML */
  AMBULO__TAKES_CSV,   /* normative curves, column maps, tables of sweeps */
  AMBULO__TAKES_MOTION /* CSV, STO, MOT */
} ambulo__taken;

/* AMBULO_OK for what the reader takes, and for what is not known; else an error about `file` that
 * says what it is and what to do: E_SCHEMA, or E_PARSE for bytes that are no text in UTF-8. */
ambulo_status ambulo__refuse_foreign(const char *text, size_t length, ambulo__taken taken,
                                     const char *file, ambulo_diagnostics *diagnostics);

#endif
