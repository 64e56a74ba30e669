/* people/compare_columns.c - the columns of a subject's motion: whose names, units and signs.
 *
 *   OpenSim      NAME, q.NAME, .../NAME, .../NAME/value; rad or deg as the header says, and where
 * it does not, degrees if a joint turns by more than 3.2 Plug-in Gait LHipAngles and so on with x,
 * y, z or 1, 2, 3; degrees; positive are flexion, adduction, inward rotation, and of the pelvis:
 * forward tilt, the own side up, the own side forward (Vicon Nexus, lower body angles as output
 * from Plug-in Gait)
 *
 * A knee that bends with negative angles, as in some models of OpenSim, is turned. */
#include "people/compare_subject.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "formats/motion_columns.h"

static const double radian = 0.017453292519943295;
static const double most_radians = 3.2; /* no joint of a walk turns further */

/* canonical coordinate; the group and component of Plug-in Gait, and its sign there */
static const struct name_row {
  const char *name, *group;
  int component, sign;
} rows[] = {
    {"pelvis_tilt", "LPelvisAngles", 0, -1},     {"pelvis_tilt", "RPelvisAngles", 0, -1},
    {"pelvis_list", "LPelvisAngles", 1, 1},      {"pelvis_list", "RPelvisAngles", 1, -1},
    {"pelvis_rotation", "LPelvisAngles", 2, -1}, {"pelvis_rotation", "RPelvisAngles", 2, 1},
    {"hip_flexion_l", "LHipAngles", 0, 1},       {"hip_flexion_r", "RHipAngles", 0, 1},
    {"hip_adduction_l", "LHipAngles", 1, 1},     {"hip_adduction_r", "RHipAngles", 1, 1},
    {"hip_rotation_l", "LHipAngles", 2, 1},      {"hip_rotation_r", "RHipAngles", 2, 1},
    {"knee_angle_l", "LKneeAngles", 0, 1},       {"knee_angle_r", "RKneeAngles", 0, 1},
    {"ankle_angle_l", "LAnkleAngles", 0, 1},     {"ankle_angle_r", "RAnkleAngles", 0, 1},
};
enum { ROWS = sizeof rows / sizeof *rows };

typedef struct found_column {
  const char *name; /* canonical, without "q." */
  int column;
  double scale;
} found_column;

static int same_letters(const char *text, const char *word) {
  for (; *word; text++, word++) {
    if (tolower((unsigned char)*text) != tolower((unsigned char)*word)) return 0;
  }
  return 1;
}

/* "S01:LHipAngles_x", "LHipAngles (1)": the group from the beginning or behind ':', then its
 * component */
static int is_plug_in(const char *column, const char *group, int component) {
  const char *colon = strrchr(column, ':');
  const char *at = column;
  if (colon && !same_letters(column, group)) at = colon + 1;
  if (!same_letters(at, group)) return 0;
  at += strlen(group);
  while (*at && strchr(" _.:/-(", *at)) at++;
  int letter = tolower((unsigned char)*at);
  if (letter != "xyz"[component] && letter != "123"[component]) return 0;
  return !isalnum((unsigned char)at[1]);
}

static int plug_in_column(const ambulo__motion *motion, const struct name_row *row) {
  for (int c = 0; c < motion->columns; c++) {
    if (is_plug_in(motion->names[c], row->group, row->component)) return c;
  }
  return -1;
}

/* smallest and largest of a column */
static void extent(const ambulo__motion *motion, int column, double *low, double *high) {
  *low = INFINITY;
  *high = -INFINITY;
  for (int k = 0; k < motion->rows; k++) {
    double value = motion->values[(size_t)k * (size_t)motion->columns + (size_t)column];
    *low = fmin(*low, value);
    *high = fmax(*high, value);
  }
}

static void turn_knee(ambulo__subject *s, const ambulo__motion *motion, found_column *found) {
  double low, high;
  ambulo__place place = {.file = s->file};
  extent(motion, found->column, &low, &high);
  if (-low <= high) return;
  found->scale = -found->scale;
  ambulo__note(s->diagnostics, place, "'%s' bends with negative angles: its sign is turned",
               motion->names[found->column]);
}

/* the columns of OpenSim's kind; all in one unit */
static ambulo_status find_coordinates(ambulo__subject *s, const ambulo__motion *motion,
                                      found_column found[ROWS], int *count) {
  double most = 0.0, low, high;
  for (int i = 0; i < ROWS; i++) {
    int column = -1;
    if (i > 0 && strcmp(rows[i].name, rows[i - 1].name) == 0) continue;
    ambulo_status status = ambulo__motion_find(motion, s->file, rows[i].name, AMBULO__ORDER_VALUE,
                                               s->diagnostics, &column);
    if (status) return status;
    if (column < 0) continue;
    extent(motion, column, &low, &high);
    if (strncmp(rows[i].name, "pelvis_rot", 10) != 0) most = fmax(most, fmax(-low, high));
    found[(*count)++] = (found_column){rows[i].name, column, 1.0};
  }
  int degrees = motion->in_degrees;
  if (!motion->unit_stated && most > most_radians) {
    ambulo__place place = {.file = s->file};
    ambulo__warning(s->diagnostics, place, "a header line inDegrees=yes states the unit",
                    "angles reach %.3g and the file does not say in what; taken for degrees", most);
    degrees = 1;
  }
  for (int i = 0; i < *count; i++) {
    found[i].scale = degrees ? radian : 1.0;
    if (strncmp(found[i].name, "knee_angle", 10) == 0) turn_knee(s, motion, &found[i]);
  }
  return AMBULO_OK;
}

static int has_name(const found_column *found, int count, const char *name) {
  for (int i = 0; i < count; i++) {
    if (strcmp(found[i].name, name) == 0) return 1;
  }
  return 0;
}

static ambulo_status unknown_columns(const ambulo__subject *s, const ambulo__motion *motion) {
  ambulo__place place = {.file = s->file};
  char names[240] = "", hint[160] = "";
  size_t used = 0;
  const char *known[ROWS];
  for (int i = 0; i < ROWS; i++) known[i] = rows[i].name;
  for (int c = 0; c < motion->columns && !hint[0]; c++) {
    const char *near = ambulo__nearest(motion->names[c], known, ROWS);
    if (near)
      (void)snprintf(hint, sizeof hint, "did you mean '%s' with '%.60s'?", near, motion->names[c]);
  }
  for (int c = 0; c < motion->columns && used < 120; c++)
    used += (size_t)snprintf(names + used, sizeof names - used, "%s%.60s", c > 0 ? ", " : "",
                             motion->names[c]);
  return ambulo__error(s->diagnostics, AMBULO_E_SCHEMA, place,
                       hint[0] ? hint
                               : "hip_flexion_l, knee_angle_l, /jointset/.../value, LHipAngles x, "
                                 "y, z",
                       "no column of a joint that is known; the file has %s; expected names of "
                       "OpenSim or Plug-in Gait",
                       names);
}

ambulo_status ambulo__subject_columns(ambulo__subject *s, const ambulo__motion *motion,
                                      const char *const *extra, int extra_count) {
  found_column found[ROWS];
  char text[ROWS][32];
  const char *names[ROWS + AMBULO__SUBJECT_FORCES];
  int count = 0;
  ambulo_status status = find_coordinates(s, motion, found, &count);
  if (status) return status;
  for (int i = 0; i < ROWS; i++) {
    int column = has_name(found, count, rows[i].name) ? -1 : plug_in_column(motion, &rows[i]);
    if (column < 0) continue;
    found[count++] = (found_column){rows[i].name, column, radian * rows[i].sign};
    s->marker_pelvis = 1;
  }
  if (count == 0) return unknown_columns(s, motion);
  for (int i = 0; i < count; i++) {
    (void)snprintf(text[i], sizeof text[i], "q.%s", found[i].name);
    names[i] = text[i];
  }
  for (int i = 0; i < extra_count; i++) names[count + i] = extra[i];
  status =
      ambulo__motion_create(motion->rows, count + extra_count, names, &s->allocator, &s->table);
  if (status) return status;
  memcpy(s->table->time, motion->time, (size_t)motion->rows * sizeof *motion->time);
  for (int k = 0; k < motion->rows; k++) {
    for (int i = 0; i < count; i++)
      s->table->values[(size_t)k * (size_t)(count + extra_count) + (size_t)i] =
          found[i].scale *
          motion->values[(size_t)k * (size_t)motion->columns + (size_t)found[i].column];
  }
  int forward = ambulo__motion_column(motion, "pelvis_tx");
  for (int c = 0; c < motion->columns && forward < 0; c++) {
    if (ambulo__motion_names(motion->names[c], "pelvis_tx", AMBULO__ORDER_VALUE)) forward = c;
  }
  size_t last = (size_t)(motion->rows - 1) * (size_t)motion->columns;
  if (forward >= 0) s->backward = motion->values[last + (size_t)forward] < motion->values[forward];
  return AMBULO_OK;
}
