/* people/muscle_analysis.h - a motion's torques shared among muscles: the inside. */
#ifndef AMBULO_PEOPLE_MUSCLE_ANALYSIS_H
#define AMBULO_PEOPLE_MUSCLE_ANALYSIS_H

#include "ambulo/tools/muscle_analysis.h"
#include "formats/json_text.h"
#include "formats/motion_file.h"
#include "people/hand_load.h"
#include "people/joint_contact.h"
#include "people/metabolic.h"
#include "people/stride.h"

enum { AMBULO__MOST_CUTS = 32 };

struct ambulo_muscle_analysis {
  ambulo_allocator allocator;
  const ambulo_muscles *muscles;
  char *motion; /* the file; of a result what it is called there */
  ambulo_muscle_options options;
  ambulo_muscle_values values;
  ambulo__cut cuts[AMBULO__MOST_CUTS];
  const char *joints[AMBULO__MOST_CUTS];
  /* what `values` shows, and what it comes from */
  double *times, *q, *qd, *qdd, *tau, *tau_rate, *grf;
  double *activation, *force, *length, *speed, *metabolic, *reserve, *contact, *between;
  int has_grf;
  int holds; /* what hands hold, while joints are found (joint_contact.h) */
  const ambulo_hold *hold;
  const double *hand_force;
  ambulo__hand_load hands; /* of a table; zero-filled: they hold nothing */
};

/* The motion of an analysis that has none yet, from its file; from a stride, which must outlive the
 * search for joints' forces (muscle_motion.c). E_SCHEMA, E_MEMORY, those of reading. */
ambulo_status ambulo__muscle_motion_read(ambulo_muscle_analysis *a,
                                         ambulo_diagnostics *diagnostics);
ambulo_status ambulo__muscle_motion_copy(ambulo_muscle_analysis *a, const ambulo__stride *stride,
                                         ambulo_diagnostics *diagnostics);

/* Integral over the rows (trapezoids) of values[k * stride]. */
double ambulo__muscle_integral(const ambulo_muscle_analysis *a, const double *values,
                               size_t stride);

/* The table as text: muscle_table.c. */
void ambulo__muscle_table(const ambulo_muscle_analysis *a, int sto, ambulo__text_buffer *text);
/* The summary as a member; `key` NULL: all of the text. */
void ambulo__muscle_json(ambulo__json *json, const char *key, const ambulo_muscle_analysis *a);

#endif
