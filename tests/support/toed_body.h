/* support/toed_body.h - models/lower_body_18.yaml with a joint between foot and toes: a hinge about
 * the foot's z axis, which all points ahead of it go with: 2 cm behind the ball, and so the ball
 * too, or ahead of it, and so the tip alone. Coordinates 18 and 19 are toes_r and toes_l. */
#ifndef AMBULO_TESTS_TOED_BODY_H
#define AMBULO_TESTS_TOED_BODY_H

#include "model/model.h"
#include "ambulo/tools/load.h"
#include "support/test.h"

enum { TOED_LINKS = 64, TOED_COORDINATES = 32, TOED_POINTS = 64, TOED_RIGHT = 0, TOED_LEFT = 1 };

typedef struct toed_parts {
  ambulo_link links[TOED_LINKS];
  ambulo_coordinate coordinates[TOED_COORDINATES];
  ambulo_point points[TOED_POINTS];
} toed_parts;

/* a fixed link that carries the frame to the joint, and the toes, whose frame is the foot's again
 */
static inline void toed_joint(toed_parts *parts, int links, const ambulo_model *body, int foot,
                              double ahead) {
  static const char *const names[2][2] = {{"ball_joint_r", "toes_r"}, {"ball_joint_l", "toes_l"}};
  const ambulo_foot *f = &body->feet[foot];
  const double *ball = body->points[f->toe_center].position;
  int on = body->points[f->toe_center].link, at = links + 2 * foot;
  double x = ball[0] + ahead, y = 0.5 * ball[1];
  ambulo_link *joint = &parts->links[at], *toes = joint + 1;
  *joint = *toes = ambulo_link_default();
  joint->name = names[foot][0];
  joint->type = AMBULO_FIXED;
  joint->parent = on;
  joint->theta = atan2(y, x);
  joint->a = hypot(x, y);
  toes->name = names[foot][1];
  toes->type = AMBULO_REVOLUTE;
  toes->parent = at;
  toes->theta = -joint->theta;
  toes->mass = 0.2;
  toes->com[0] = 0.03;
  for (int i = 0; i < 3; i++) toes->inertia[i] = 2e-4;
  for (int p = 0; p < body->point_count; p++) {
    ambulo_point *point = &parts->points[p];
    if (point->link != on || point->position[0] < x) continue;
    point->link = at + 1;
    point->position[0] -= x;
    point->position[1] -= y;
  }
  ambulo_coordinate *c = &parts->coordinates[body->coordinate_count + foot];
  *c = ambulo_coordinate_default();
  c->name = names[foot][1];
  c->type = AMBULO_REVOLUTE;
  c->mirror = body->coordinate_count + 1 - foot;
  c->mirror_sign = 1.0;
  c->range[0] = -0.2;
  c->range[1] = 1.0;
}

/* the hinge `ahead` of the ball, m */
static inline ambulo_model *toed_body_with(double ahead) {
  ambulo_model *body = NULL, *toed = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &body),
                   AMBULO_OK);
  toed_parts *parts = calloc(1, sizeof *parts);
  int links = body->link_count, coordinates = body->coordinate_count;
  assert_true(links + 4 <= TOED_LINKS && coordinates + 2 <= TOED_COORDINATES);
  memcpy(parts->links, body->links, (size_t)links * sizeof *parts->links);
  memcpy(parts->coordinates, body->coordinates, (size_t)coordinates * sizeof *parts->coordinates);
  memcpy(parts->points, body->points, (size_t)body->point_count * sizeof *parts->points);
  for (int foot = 0; foot < 2; foot++) toed_joint(parts, links, body, foot, ahead);
  ambulo_model_definition definition = ambulo_model_definition_default();
  definition.name = "toed body";
  definition.links = parts->links;
  definition.link_count = links + 4;
  definition.coordinates = parts->coordinates;
  definition.coordinate_count = coordinates + 2;
  definition.points = parts->points;
  definition.point_count = body->point_count;
  definition.feet = body->feet;
  definition.foot_count = 2;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  if (ambulo_model_create(&definition, NULL, list, &toed)) {
    char text[400];
    ambulo_diagnostics_format(list, 0, text, sizeof text);
    fail_msg("%s", text);
  }
  ambulo_diagnostics_free(list);
  free(parts);
  ambulo_model_free(body);
  return toed;
}

static inline ambulo_model *toed_body(void) {
  return toed_body_with(-0.02);
}

#endif
