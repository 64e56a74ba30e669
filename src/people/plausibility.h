/* people/plausibility.h - doubts: warnings, or errors under --strict. */
#ifndef AMBULO_PEOPLE_PLAUSIBILITY_H
#define AMBULO_PEOPLE_PLAUSIBILITY_H

#include "base/diagnostics.h"
#include "formats/motion_file.h"

typedef struct ambulo__doubts {
  ambulo_diagnostics *diagnostics;
  int strict;
  int count;        /* so far */
  int other_forces; /* of ambulo_inverse_options */
} ambulo__doubts;

/* Says it about a file; `hint` (may be NULL) names the option that mends it. */
void ambulo__doubt(ambulo__doubts *doubts, const char *file, const char *hint, const char *format,
                   ...) __attribute__((format(printf, 4, 5)));
/* A table that has other columns than its header says. */
void ambulo__doubt_header(ambulo__doubts *doubts, const char *file, const ambulo__motion *table);
/* Another body, or another gravity, than the motion of the file was written for. */
void ambulo__doubt_body(ambulo__doubts *doubts, const char *file, const ambulo__motion *motion,
                        const ambulo_model *model);
/* E_SCHEMA if there were doubts and they count as errors. */
ambulo_status ambulo__doubts_status(const ambulo__doubts *doubts);

#endif
