/* people/compare_columns.c - the columns of a subject's motion: whose names, units and signs.
 *
 *   OpenSim      NAME, q.NAME, .../NAME, .../NAME/value; rad or deg as the header says, and where
 * it does not, degrees if a joint turns by more than 3.2 Plug-in Gait LHipAngles and so on with x,
 * y, z or 1, 2, 3; degrees; positive are flexion, adduction, inward rotation, and of the pelvis:
 * forward tilt, the own side up, the own side forward (Vicon Nexus, lower body angles as output
 * from Plug-in Gait)
 *
 * A knee that bends with negative angles, as in some models of OpenSim, is turned. */
#include "formats/motion_file.h"
#include "people/compare.h"
#include "people/force_columns.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

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

/* the column of a joint under any of its names */
static ambulo_status find_joint(const ambulo__subject *s, const ambulo__motion *motion,
                                const char *joint, int *column) {
  char name[AMBULO__JOINT_NAME];
  int index = 0;
  for (; index < AMBULO__BODY_JOINTS; index++) {
    ambulo__joint_name(index, name);
    if (strcmp(name, joint) == 0) break;
  }
  ambulo_status status = AMBULO_OK;
  for (int alias = 0; !status && *column < 0 && index < AMBULO__BODY_JOINTS &&
                      ambulo__joint_alias(index, alias, name);
       alias++)
    status =
        ambulo__motion_find(motion, s->file, name, AMBULO__ORDER_VALUE, s->diagnostics, column);
  return status;
}

/* the columns of OpenSim's kind; all in one unit */
static ambulo_status find_coordinates(ambulo__subject *s, const ambulo__motion *motion,
                                      found_column found[ROWS], int *count) {
  double most = 0.0, low, high;
  for (int i = 0; i < ROWS; i++) {
    int column = -1;
    if (i > 0 && strcmp(rows[i].name, rows[i - 1].name) == 0) continue;
    ambulo_status status = find_joint(s, motion, rows[i].name, &column);
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

/* measured forces on the feet of a subject, at the times of its motion.
 *
 * Columns are known by the names that inverse dynamics knows (people/force_columns.h); y is up.
 * A group belongs to the foot whose side its name says, or to the one that the caller names. The
 * forces are interpolated linearly; outside of their file, and where it has gaps, they are 0. */

static const char *const feet[] = {"left", "right"};
static const double least_force = 20.0, least_share = 0.02; /* N, of the peak */
static const double soon = 0.25, loaded_share = 0.3; /* s after an onset, and of the peak by then */

/* 0, 1, or -1: "r", "calcn_l", "right" */
static int side_of(const char *tag) {
  size_t length = strlen(tag);
  for (int side = 0; side < 2; side++) {
    size_t size = strlen(feet[side]);
    int last = length ? tolower((unsigned char)tag[length - 1]) : 0;
    int alone = length == 1 || (length > 1 && tag[length - 2] == '_');
    if (alone && last == feet[side][0]) return side;
    if (length < size) continue;
    int equal = 1;
    for (size_t i = 0; i < size; i++)
      equal &= tolower((unsigned char)tag[length - size + i]) == feet[side][i];
    if (equal) return side;
  }
  return -1;
}

static ambulo_status wrong_map(const ambulo__force_columns *groups, const char *map,
                               ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = groups->file};
  char names[300] = "";
  size_t used = 0;
  for (int g = 0; g < groups->count && used < 200; g++)
    used += (size_t)snprintf(names + used, sizeof names - used, "%s%.60s", g > 0 ? ", " : "",
                             groups->groups[g].name);
  return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, "--force-columns left=NAME,right=NAME",
                       map ? "force columns '%s' name no foot and group of this file; it has %s"
                           : "no group of columns%s says whose foot it is; the file has %s",
                       map ? map : "", names[0] ? names : "none");
}

/* sets the side of each group */
static ambulo_status match(ambulo__force_columns *groups, const char *map,
                           ambulo_diagnostics *diagnostics) {
  int any = 0;
  for (int g = 0; g < groups->count; g++) {
    groups->groups[g].foot = map ? -1 : side_of(groups->groups[g].tag);
    if (groups->groups[g].force[1] < 0) groups->groups[g].foot = -1;
    any |= groups->groups[g].foot >= 0;
  }
  for (const char *at = map; at && *at;) {
    size_t length = strcspn(at, ",");
    int side = strncmp(at, "left=", 5) == 0 ? 0 : strncmp(at, "right=", 6) == 0 ? 1 : -1;
    size_t head = side < 0 ? 0 : strlen(feet[side]) + 1;
    int g = side < 0 ? -1 : ambulo__force_group_named(groups, at + head, length - head);
    if (g < 0) return wrong_map(groups, map, diagnostics);
    groups->groups[g].foot = side;
    any = 1;
    at += length + (at[length] == ',');
  }
  return any ? AMBULO_OK : wrong_map(groups, map, diagnostics);
}

static double cell(const ambulo__motion *m, int row, int column) {
  double value = column < 0 ? 0.0 : m->values[(size_t)row * (size_t)m->columns + (size_t)column];
  return isfinite(value) ? value : 0.0;
}

/* of all groups of a side */
static double force(const ambulo__force_columns *groups, int side, int axis, int row) {
  double sum = 0.0;
  for (int g = 0; g < groups->count; g++) {
    if (groups->groups[g].foot == side)
      sum += cell(groups->table, row, groups->groups[g].force[axis]);
  }
  return sum;
}

static int find_onsets(const ambulo__force_columns *groups, int side, double *onsets) {
  const ambulo__motion *m = groups->table;
  double peak = 0.0;
  int count = 0;
  for (int k = 0; k < m->rows; k++) peak = fmax(peak, force(groups, side, 1, k));
  double least = fmax(least_force, least_share * peak);
  for (int k = 1; k < m->rows && count < AMBULO__MOST_STRIKES; k++) {
    double before = force(groups, side, 1, k - 1), now = force(groups, side, 1, k), most = now;
    if (before >= least || now < least) continue;
    for (int i = k; i < m->rows && m->time[i] - m->time[k] < soon; i++)
      most = fmax(most, force(groups, side, 1, i));
    if (most < loaded_share * peak) continue;
    onsets[count++] =
        m->time[k - 1] + (m->time[k] - m->time[k - 1]) * (least - before) / (now - before);
  }
  return count;
}

static void fill(ambulo__subject *s, const ambulo__force_columns *groups) {
  const ambulo__motion *m = groups->table;
  ambulo__motion *to = s->table;
  s->force_until = m->rows > 0 ? m->time[m->rows - 1] : -INFINITY;
  for (int k = 0, i = 0; k < to->rows; k++) {
    double t = to->time[k], *row = to->values + (size_t)(k + 1) * (size_t)to->columns;
    while (i + 2 < m->rows && m->time[i + 1] <= t) i++;
    if (m->rows < 2 || t < m->time[0] || t > m->time[m->rows - 1]) continue;
    double share = (t - m->time[i]) / (m->time[i + 1] - m->time[i]);
    for (int j = 0; j < AMBULO__SUBJECT_FORCES; j++) {
      double a = force(groups, j / 3, j % 3, i), b = force(groups, j / 3, j % 3, i + 1);
      row[j - AMBULO__SUBJECT_FORCES] = a + share * (b - a);
    }
  }
}

ambulo_status ambulo__subject_forces(ambulo__subject *s, const char *file, const char *map,
                                     double *const onsets[2], int onset_count[2]) {
  ambulo__motion *table = NULL;
  ambulo__force_columns groups = {.groups = NULL};
  ambulo_status status = ambulo__motion_read(file, 1, &s->allocator, s->diagnostics, &table);
  if (!status)
    status = ambulo__force_columns_find(table, file, &s->allocator, s->diagnostics, &groups);
  if (!status) status = match(&groups, map, s->diagnostics);
  for (int side = 0; !status && side < 2; side++)
    onset_count[side] = find_onsets(&groups, side, onsets[side]);
  if (!status) fill(s, &groups);
  ambulo__force_columns_free(&groups);
  ambulo__motion_free(table);
  return status;
}
