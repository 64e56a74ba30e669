/* people/force_complete.c - components that a group of force columns lacks (force_columns.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "people/force_columns.h"
#include "mechanics/pose.h"

ambulo_status ambulo__idle_axis(const ambulo_model *model, const ambulo_allocator *allocator,
                                int *axis) {
  static const double world[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const double *left = ambulo_model_left(model);
  ambulo__pose pose = {.model = NULL};
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  int lateral = -1, planar = 1;
  for (int i = 0; i < 3; i++) {
    if (fabs(left[i]) > 1.0 - 1e-9) lateral = i;
  }
  double *q = ambulo__alloc(&own, (size_t)ambulo_model_coordinate_count(model), sizeof *q);
  if (!q) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__pose_create(model, &own, &pose);
  if (!status) {
    /* axes that are all lateral in one pose are so in every pose */
    ambulo__pose_at(&pose, q);
    for (int i = 0; i < ambulo_model_link_count(model); i++) {
      const ambulo_link *link = ambulo_model_link(model, i);
      const double *frame = link->parent < 0 ? world : pose.frames + 12 * (size_t)link->parent;
      double along = fabs(frame[2] * left[0] + frame[6] * left[1] + frame[10] * left[2]);
      if (link->type == AMBULO_REVOLUTE) planar &= along > 1.0 - 1e-9;
      if (link->type == AMBULO_PRISMATIC) planar &= along < 1e-9;
    }
    *axis = planar ? lateral : -1;
    ambulo__pose_free(&pose);
  }
  ambulo__free(&own, q);
  return status;
}

/* how many of the axes in `mask` have no column, and their letters */
static int missing(const int columns[3], int mask, char letters[8]) {
  int count = 0;
  letters[0] = '\0';
  for (int i = 0; i < 3; i++) {
    if (columns[i] >= 0 || !(mask & 1 << i)) continue;
    size_t used = strlen(letters);
    (void)snprintf(letters + used, 8 - used, "%s%c", count ? ", " : "", "xyz"[i]);
    count++;
  }
  return count;
}

/* bit of the axis that points up; 0 if none does */
static int upward(const ambulo_model *model) {
  const double *up = ambulo_model_up(model);
  for (int i = 0; i < 3; i++) {
    if (fabs(up[i]) > 1.0 - 1e-9) return 1 << i;
  }
  return 0;
}

static void check_points(const ambulo__force_group *group, const ambulo_model *model, int mask,
                         const char *file, ambulo__doubts *doubts) {
  ambulo__place place = {.file = file};
  const char *foot = ambulo_model_foot(model, group->foot)->name;
  int up = upward(model) & mask, aside = mask & ~up;
  char letters[8];
  if (group->point[0] < 0 && group->point[1] < 0 && group->point[2] < 0) return;
  if (missing(group->point, up, letters))
    ambulo__note(doubts->diagnostics, place,
                 "'%s' of foot '%s' has no %s of its points; they are taken to be on the ground",
                 group->name, foot, letters);
  if (missing(group->point, aside, letters))
    ambulo__doubt(doubts, file, "a column of zeros says that it is zero",
                  "'%s' of foot '%s' lacks the %s of its points; it is taken as 0", group->name,
                  foot, letters);
}

static ambulo_status check(const ambulo__force_columns *c, const ambulo__force_group *group,
                           const ambulo_model *model, int mask, ambulo__doubts *doubts) {
  ambulo__place place = {.file = c->file};
  const char *foot = ambulo_model_foot(model, group->foot)->name;
  char letters[8];
  int lacking = missing(group->force, mask, letters), all = mask == 7 ? 3 : 2;
  if (lacking == all)
    return ambulo__error(doubts->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "'%s' of foot '%s' has no columns of force", group->name, foot);
  if (lacking > 0)
    ambulo__doubt(doubts, c->file, "a column of zeros says that it is zero",
                  "'%s' of foot '%s' lacks the %s of its force; it is taken as 0", group->name,
                  foot, letters);
  int short_of = missing(group->moment, 7, letters);
  if (short_of == 0) return AMBULO_OK;
  if (short_of < 3)
    ambulo__doubt(doubts, c->file, "its points and its free moment are taken",
                  "'%s' of foot '%s' lacks the %s of its moment; the others are left out",
                  group->name, foot, letters);
  check_points(group, model, mask, c->file, doubts);
  if (group->free_moment < 0 && missing(group->torque, 7, letters) == 3)
    ambulo__note(doubts->diagnostics, place,
                 "'%s' of foot '%s' has no torques; its free moment is taken as 0", group->name,
                 foot);
  return AMBULO_OK;
}

ambulo_status ambulo__force_columns_complete(const ambulo__force_columns *columns,
                                             const ambulo_model *model, ambulo__doubts *doubts) {
  int idle = -1;
  ambulo_status status = ambulo__idle_axis(model, &columns->allocator, &idle);
  int mask = idle < 0 ? 7 : 7 & ~(1 << idle);
  for (int i = 0; i < columns->count && !status; i++) {
    if (columns->groups[i].foot >= 0)
      status = check(columns, &columns->groups[i], model, mask, doubts);
  }
  return status;
}
