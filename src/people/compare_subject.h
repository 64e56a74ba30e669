/* people/compare_subject.h - a person's own motion: angles and forces over time, and the strides
 * in it.
 *
 * The table of a subject has the columns of motion.csv (docs/results.md), whatever the file calls
 * them: q.NAME in rad with the signs of the shipped models, grf.FOOT.x, .y, .z in N (y up).
 *
 * Strikes, per foot, of the first kind that has two or more:
 *   given       by the caller
 *   by force    where the vertical force rises through the larger of 20 N and 2 % of its peak
 *   by reach    how far the ankle is ahead of the hip, as angles tell it (compare_strikes.c); a
 *               strike close to one by force takes its time */
#ifndef AMBULO_PEOPLE_COMPARE_SUBJECT_H
#define AMBULO_PEOPLE_COMPARE_SUBJECT_H

#include "ambulo/tools/report.h"
#include "ambulo/tools/compare.h"
#include "formats/motion_file.h"

typedef struct ambulo__subject {
  ambulo_allocator allocator;
  ambulo_diagnostics *diagnostics;
  const char *file;      /* borrowed */
  ambulo__motion *table; /* see above */
  int marker_pelvis;     /* 1: the pelvis frame is that of markers, tilted already */
  int backward;          /* 1: the walk goes along -x */
  double *strikes[2];    /* s, rising; left, right */
  int count[2];
  double force_until;       /* s, last time of the forces */
  unsigned char *loaded[2]; /* [count]: a force begins there, and is known for the stride */
} ambulo__subject;

/* Reads the motion and the forces of the options, and finds the strikes. Errors: E_IO, E_LIMIT,
 * E_PARSE, E_SCHEMA (columns that nobody knows, no whole stride), E_ARGUMENT (strikes), E_MEMORY.
 * `file` and the options must outlive it; ambulo__subject_free releases it. */
ambulo_status ambulo__subject_open(const char *file, const ambulo_compare_options *options,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo__subject *subject);
void ambulo__subject_free(ambulo__subject *subject); /* accepts a zero-filled one */

/* ---------------------------------------------- its parts, each in its file */

/* compare_columns.c: the table from a file's own names, units and signs, without forces; room for
 * `extra` columns behind it, of the given names. */
ambulo_status ambulo__subject_columns(ambulo__subject *subject, const ambulo__motion *motion,
                                      const char *const *extra, int extra_count);
/* compare_forces.c: fills the last six columns of the table, grf.left.x ... grf.right.z, from the
 * forces; onsets[side][most], s, rising. The number of onsets goes to onset_count. */
enum { AMBULO__SUBJECT_FORCES = 6, AMBULO__MOST_STRIKES = 4096 };
ambulo_status ambulo__subject_forces(ambulo__subject *subject, const char *file, const char *map,
                                     double *const onsets[2], int onset_count[2]);
/* compare_strikes.c: the strikes by reach of one side into strikes[most]; their number. E_MEMORY.
 * None where hip or knee are missing. */
ambulo_status ambulo__subject_reach(const ambulo__subject *subject, int side, double *strikes,
                                    int most, int *count);
/* compare_strikes.c: "left=0.1,1.2;right=0.6" of one side. E_ARGUMENT. */
ambulo_status ambulo__subject_given(const char *text, int side, const char *file,
                                    ambulo_diagnostics *diagnostics, double *strikes, int most,
                                    int *count);

#endif
