/* tests/support/patched_walker.h - the walker (support/walker_fixture.h) with hands and a seat.
 *
 * On the pelvis, whose frame has x up, y backward, z right: hands 0.3 m up, 0.4 m ahead and 0.25 m
 * to either side of its origin, half sizes 0.04 and 0.02 m; a seat 0.1 m below it, half sizes 0.1
 * and 0.15 m. At q = 0 the origin is at (0, 0.92, 0). */
#ifndef AMBULO_TESTS_PATCHED_WALKER_H
#define AMBULO_TESTS_PATCHED_WALKER_H

#include "model/model.h"
#include "support/walker_fixture.h"

enum { HAND_R = 0, HAND_L = 1, SEAT = 2, PATCHES = 3 };

/* a copy of `body`, which is freed, with `points` and patches more */
static inline ambulo_model *with_more(ambulo_model *body, const ambulo_point *points, int count,
                                      const ambulo_patch *patches, int patch_count) {
  ambulo_model *model = NULL;
  ambulo_point *all = calloc((size_t)(body->point_count + count), sizeof *all);
  ambulo_model_definition d = ambulo_model_definition_default();
  memcpy(all, body->points, (size_t)body->point_count * sizeof *all);
  memcpy(all + body->point_count, points, (size_t)count * sizeof *all);
  d.name = body->name;
  d.links = body->links;
  d.link_count = body->link_count;
  d.coordinates = body->coordinates;
  d.coordinate_count = body->coordinate_count;
  d.points = all;
  d.point_count = body->point_count + count;
  d.feet = body->feet;
  d.foot_count = body->foot_count;
  d.patches = patches;
  d.patch_count = patch_count;
  assert_int_equal(ambulo_model_create(&d, NULL, NULL, &model), AMBULO_OK);
  free(all);
  ambulo_model_free(body);
  return model;
}

static inline ambulo_model *patched_walker(int planar) {
  ambulo_model *body = walker_create(planar);
  int link = ambulo_model_find_link(body, "pelvis"), first = body->point_count;
  double side = planar ? 0.0 : 0.25;
  const ambulo_point points[PATCHES] = {{"palm_r", link, {0.3, -0.4, side}},
                                        {"palm_l", link, {0.3, -0.4, -side}},
                                        {"seat", link, {-0.1, 0.0, 0.0}}};
  const ambulo_patch patches[PATCHES] = {{"hand_r", first, {0.04, 0.02}, HAND_L},
                                         {"hand_l", first + 1, {0.04, 0.02}, HAND_R},
                                         {"seat", first + 2, {0.1, 0.15}, -1}};
  return with_more(body, points, PATCHES, patches, PATCHES);
}

/* a contact of a patch; from, to in s, place along forward, left, up in m */
/* clang-format off */
#define OF_PATCH(index, begin, end, ...)                                                           \
  {.foot = -1, .mode = AMBULO_CONTACT_PATCH, .from = (begin), .to = (end),                         \
   .place = __VA_ARGS__, .patch = (index)}
/* clang-format on */

#endif
