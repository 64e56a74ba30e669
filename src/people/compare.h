/* people/compare.h - which column of a result belongs to which curve of a reference
 * (docs/compare.md). */
#ifndef AMBULO_PEOPLE_COMPARE_H
#define AMBULO_PEOPLE_COMPARE_H

#include "ambulo/tools/compare.h"
#include "ambulo/tools/report.h"
#include "formats/motion_file.h"
#include "formats/sheet.h"
#include "people/body_joints.h"

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
  AMBULO__UNIT_POWER,  /* W/kg, from W */
  AMBULO__UNIT_WEIGHT, /* body weights, from N */
  AMBULO__UNIT_NONE    /* of activations */
} ambulo__curve_unit;

/* One line of the map. `result` is a column of motion.csv or a sum of such ("a+b"), with
 * {side} for l or r and {foot} for the foot's name; "grf.{foot}.up", "grf.{foot}.forward",
 * "grf.{foot}.right" are components along the body's axes, "power.NAME" is tau times qd,
 * "size.NAME" the length of NAME.x, NAME.y, NAME.z. muscles.csv has more columns, if it is there.
 */
typedef struct ambulo__map_entry {
  char curve[AMBULO__CURVE_NAME], reference[AMBULO__CURVE_NAME], result[192];
  double factor; /* on the left side */
  int opposite;  /* 1: the right side takes -factor */
  int tilted;    /* 1: the pelvic tilt is added */
  ambulo__curve_unit unit;
  double lag;  /* s: the result comes so much later than the reference */
  int by_body; /* 1: joints of the result are a person's, whatever the body calls them and whichever
                  way it counts them (people/body_joints.h); 0: columns as they are */
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
 * right_factor, tilted, lag. Errors as of ambulo__sheet_read, and E_SCHEMA. */
ambulo_status ambulo__map_read(const char *path, const ambulo_allocator *allocator,
                               ambulo_diagnostics *diagnostics, ambulo__map *map);
void ambulo__map_free(ambulo__map *map); /* accepts a zero-filled one */
/* The line that goes by the curve's own name, else the first of that curve; NULL: none. */
const ambulo__map_entry *ambulo__map_find(const ambulo__map *map, const char *curve);

/* "deg", "N m/kg", "N/kg", "W/kg", "BW", "1". */
const char *ambulo__curve_unit_name(ambulo__curve_unit unit);

/* a person's own motion: angles and forces over time, and the strides
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

/* a result folder seen as one gait cycle of each foot, a person's own
 * motion as several.
 *
 * Percent p of a foot's cycle is the time  strike + p / 100 * length.  A result is taken as
 * periodic over what the file holds; between its times it is interpolated by cubic Hermite
 * pieces whose slopes are those of the parabola through three neighbours. */

typedef enum ambulo__cycle_side { AMBULO__CYCLE_LEFT, AMBULO__CYCLE_RIGHT } ambulo__cycle_side;

/* A joint that the body of a result calls or counts otherwise than people do. */
typedef struct ambulo__cycle_joint {
  char name[AMBULO__JOINT_NAME], coordinate[AMBULO__MOTION_MAX_NAME + 1];
  int sign;
} ambulo__cycle_joint;

typedef struct ambulo__cycle {
  ambulo_allocator allocator;
  ambulo_diagnostics *diagnostics;
  char *motion_path, *summary_path;
  ambulo__sheet sheet;         /* motion.csv; line 0 is its header */
  ambulo__sheet muscles;       /* muscles.csv, of as many times; no lines: there is none */
  int rows;                    /* times */
  double *time;                /* [rows], s, rising */
  double *scratch;             /* [4][rows] */
  double strike[2], length[2]; /* s, by side */
  double mass, gravity;        /* kg, m/s^2; mass 0: not known */
  double up[3], forward[3];
  int warned_open;
  ambulo__cycle_joint joint[AMBULO__BODY_JOINTS];
  int joint_count;
  int told_strikes, told_gait; /* by the summary: how many strikes; 1: the motion is a gait */
  ambulo__subject *subject;    /* a person's own motion: in place of sheet, strike and length */
} ambulo__cycle;

/* Reads motion.csv and summary.json of a folder (of a file: ambulo__cycle_open_subject) and finds
 * the strikes: the option, else what the summary says, else the onset of the vertical force, else 0
 * for the left foot. Errors: E_IO, E_PARSE, E_SCHEMA, E_MEMORY. Fills *cycle, which
 * ambulo__cycle_close releases. */
ambulo_status ambulo__cycle_open(const char *directory, const ambulo_compare_options *options,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo__cycle *cycle);
/* Of the file of a person's own motion (compare_subject.h), with its errors. */
ambulo_status ambulo__cycle_open_subject(const char *file, const ambulo_compare_options *options,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics, ambulo__cycle *cycle);
void ambulo__cycle_close(ambulo__cycle *cycle); /* accepts a zero-filled one */

/* The curve of one side at percents[count], in the unit of the entry, without the pelvic tilt: the
 * mean over the strides, and of their squares in squares[count] (NULL: not wanted). *strides: one
 * of a result, those between strikes of a person's own motion, and of its forces those that are
 * loaded; 0 (values untouched) when the motion has no such column, or the mass is not known but
 * needed. Errors: E_SCHEMA (a cell is no number). */
ambulo_status ambulo__cycle_spread(ambulo__cycle *cycle, const ambulo__map_entry *entry,
                                   ambulo__cycle_side side, const double *percents, int count,
                                   double *values, double *squares, int *strides);

struct ambulo__yaml_node;
/* Joints that the body calls or counts otherwise than people do, of summary.json; may be NULL. */
void ambulo__cycle_take_joints(ambulo__cycle *cycle, const struct ambulo__yaml_node *joints);

/* The samples of a result expression for one side, [rows], SI units; by_body as of a map entry. */
ambulo_status ambulo__cycle_samples(ambulo__cycle *cycle, const char *expression, int by_body,
                                    ambulo__cycle_side side, double *values, int *found);

/* one curve of a motion over the cycle: of the foot that is asked for, or
 * the mean of both where they are alike.
 *
 * With y_j the strides of a foot, m = mean y_j and s = mean y_j^2 at a percent; of two feet that
 * are alike m and s are means of the two. Over n strides the deviation is sqrt(n/(n - 1) (s -
 * m^2)). */

typedef struct ambulo__sampler {
  ambulo__cycle *cycle;
  const ambulo_compare_options *options;
  int most;                  /* percents at once */
  double *other, *square[2]; /* [most] */
  int warned_sides;
} ambulo__sampler;

/* Errors: E_MEMORY. Fills *sampler, which ambulo__sampler_free releases. */
ambulo_status ambulo__sampler_create(ambulo__cycle *cycle, const ambulo_compare_options *options,
                                     int most, ambulo__sampler *sampler);
void ambulo__sampler_free(ambulo__sampler *sampler); /* accepts a zero-filled one */

/* values[count] at percents[count], in the unit of the entry, with the pelvic tilt where it has
 * one. deviations [count] may be NULL; they are NaN for one stride. *strides: how many; 0 when the
 * motion has no such curve. Errors: as ambulo__cycle_spread. */
ambulo_status ambulo__sample_curve(ambulo__sampler *sampler, const ambulo__map_entry *entry,
                                   const double *percents, int count, double *values,
                                   double *deviations, int *strides);

/* the curves over the cycle as a table, in the layout of references with
 * a column a curve (AMBULO__LAYOUT_WIDE): percent 0 to 100, then NAME and, of more than one stride,
 * "NAME sd". Names are those of the curves; hip flexion and pelvic tilt stand as they are compared,
 * in a marker frame of the pelvis. */

/* Before any work: whether the file of the options may be written. E_IO. */
ambulo_status ambulo__cycles_check(const char *motion, const char *people,
                                   const ambulo_compare_options *options,
                                   ambulo_diagnostics *diagnostics);
/* Writes it, whole or not at all. Errors: E_IO, E_MEMORY, and of ambulo__sample_curve. */
ambulo_status ambulo__cycles_write(ambulo__sampler *sampler);

/* normative curves over the gait cycle (docs/compare.md). */

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

/* the curves of people that a motion is set beside: those of one file,
 * or the shipped norms.
 *
 * The norms are a folder of two tables (models/norms/README.md):
 *   young_adults.csv     angles, mean and deviation           AMBULO__LAYOUT_BAND
 *   normal_cadence.csv   angles, moments, forces, means only  AMBULO__LAYOUT_WIDE
 * A curve that both have is that of the first. A file names its people in a line
 * "# source: ...", which goes to `source`. */

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

/* how far a curve is from a reference, and what it looks like. */

enum { AMBULO__FINE = 201 }; /* points of a finely sampled cycle: every half percent */

/* values[points of the curve] at its percents, fine[AMBULO__FINE] every half percent. Sets all
 * numbers of *score. */
void ambulo__score_curve(const ambulo__reference_curve *reference, const double *values,
                         const double *fine, ambulo_curve_score *score);

/* Pearson's r of two curves; NaN where one of them is constant. */
double ambulo__correlation(const double *a, const double *b, int count);

/* Landmarks of one curve, added at landmarks[*count]: at most 5 each. Knee flexion and ankle
 * dorsiflexion in deg, forces in N/kg (gravity in m/s^2 turns them into body weights). */
enum { AMBULO__MAX_LANDMARKS = 16 };
void ambulo__knee_landmarks(const double *fine, ambulo_landmark *landmarks, int *count);
void ambulo__ankle_landmarks(const double *fine, ambulo_landmark *landmarks, int *count);
void ambulo__vertical_landmarks(const double *fine, double gravity, ambulo_landmark *landmarks,
                                int *count);
void ambulo__forward_landmarks(const double *fine, ambulo_landmark *landmarks, int *count);

/* what hardly can be meant about a reference and the curves asked for. */

/* 1 if a comma-separated list names the curve; no list names all. */
int ambulo__curve_is_listed(const char *list, const char *curve);
/* E_SCHEMA, naming it, if the list (may be NULL) names a curve that the people do not have. */
ambulo_status ambulo__curves_check(const char *list, const ambulo__people *people,
                                   ambulo_diagnostics *diagnostics);
/* Warns of a reference over part of the cycle, and of angles that look like radians beside the
 * predicted curve, fine[AMBULO__FINE] in degrees. Returns whether it did. */
int ambulo__curve_doubt(const ambulo__reference_curve *curve, const double *fine, const char *file,
                        ambulo_diagnostics *diagnostics);

#endif
