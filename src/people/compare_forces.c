/* people/compare_forces.c - measured forces on the feet of a subject, at the times of its motion.
 *
 * Columns are known by the names that inverse dynamics knows (people/force_columns.h); y is up.
 * A group belongs to the foot whose side its name says, or to the one that the caller names. The
 * forces are interpolated linearly; outside of their file, and where it has gaps, they are 0. */
#include "people/compare_subject.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "people/force_columns.h"

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
  ambulo_status status = ambulo__motion_read_gaps(file, &s->allocator, s->diagnostics, &table);
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
