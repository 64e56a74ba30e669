/* contact/collision.h - capsules that keep clear: which, of what, and their rows. */
#ifndef AMBULO_CONTACT_COLLISION_H
#define AMBULO_CONTACT_COLLISION_H

#include "contact/row_families.h"

/* What a definition's collision comes to. Arrays are freed by ambulo__pairs_free. */
typedef struct ambulo__pairs {
  ambulo_capsule_pair *kept; /* [kept_count], one < other */
  int kept_count;
  ambulo_capsule_pair *left; /* [left_count] they overlap in the rest pose (automatic) */
  int left_count;
  int too_far; /* too far apart to meet (automatic) */
} ambulo__pairs;

/* E_MEMORY. */
ambulo_status ambulo__pairs_create(const ambulo_problem_definition *definition,
                                   const ambulo_allocator *allocator, ambulo__pairs *pairs);
void ambulo__pairs_free(const ambulo_allocator *allocator, ambulo__pairs *pairs);

/* How far two capsules are apart in the rest pose: every coordinate 0, or as near as its range lets
 * it; m, negative: they overlap. E_MEMORY. */
ambulo_status ambulo__rest_gap(const ambulo_model *model, ambulo_capsule_pair pair,
                               const ambulo_allocator *allocator, double *gap);

/* 1: rows of the definition stand on capsule i, whose ends then are points of the model
 * (model/model_query.h). The pairs are those listed, not AMBULO_COLLISION_AUTOMATIC. */
int ambulo__capsule_is_used(const ambulo_problem_definition *definition, int capsule);
/* Capsules, obstacles, places and times: every number and name in its range; reaches without a
 * node are found with the rows. E_PROBLEM. */
ambulo_status ambulo__collision_check(const ambulo_problem_definition *definition,
                                      ambulo_diagnostics *diagnostics);
/* With mirrored ends: no obstacles, no places in the world to reach, capsules of rows are mirror
 * images. E_PROBLEM. */
ambulo_status ambulo__collision_mirror_check(const ambulo_problem_definition *definition,
                                             ambulo_diagnostics *diagnostics);

/* "collision": of each pair that is listed (m). */
void ambulo__collision_rows(const ambulo__gait_context *context, ambulo__row_table *table);
/* "obstacle": of each capsule and obstacle (m). */
void ambulo__obstacle_rows(const ambulo__gait_context *context, ambulo__row_table *table);
/* "reach": points at places (m). E_PROBLEM: a reach without a node. */
ambulo_status ambulo__reach_rows(const ambulo__gait_context *context, ambulo__row_table *table,
                                 ambulo_diagnostics *diagnostics);
/* A place along forward, left and up above the ground's height, in the world, m. */
void ambulo__world_place(const ambulo_problem_definition *definition, const double place[3],
                         double world[3]);
/* What rows keep clear of, in the world, as contact/curved.h has it; where channels begin is left
 * 0. Of two capsules; of an obstacle by itself, without a capsule's radius, distance and weights;
 * of a capsule and an obstacle. */
ambulo__solid ambulo__solid_of_pair(const ambulo_problem_definition *definition,
                                    ambulo_capsule_pair pair);
ambulo__solid ambulo__solid_of_obstacle(const ambulo_problem_definition *definition, int obstacle);
ambulo__solid ambulo__solid_near_obstacle(const ambulo_problem_definition *definition, int obstacle,
                                          int capsule);
/* How many capsules keep clear of an obstacle, and the i-th of them. */
int ambulo__obstacle_capsules(const ambulo_problem_definition *definition, int obstacle);
int ambulo__obstacle_capsule(const ambulo_problem_definition *definition, int obstacle, int i);

#endif
