/* tests/support/shared_ground.h - overrides of a walk whose contacts share the load. */
#ifndef AMBULO_TESTS_SHARED_GROUND_H
#define AMBULO_TESTS_SHARED_GROUND_H

/* patches that are not symmetrical, so that every end counts */
#define SHARED                                                                                     \
  "ground_reaction={kind: shared, friction: 0.5, free_moment: 0.02, minimum_force: 0.2, "          \
  "moment_arm: 0.25, slant: 0.3, pressure: {heel: [-0.02, 0.03], flat: [-0.005, 0.02], "           \
  "toe: [-0.02, 0.055], roll: 0.04, width: 0.035}}"
#define ON_EVENTS "time.grid=events", "trajectory.knots=events", "trajectory.degree=4"

/* feet that roll on arcs: two points that nothing else needs are their centres */
#define POINT(name, link, x, y)                                                                    \
  "model.points[" name "]={name: " name ", link: " link ", position: [" x ", " y ", 0]}"
#define ARCS                                                                                       \
  POINT("hip_r", "foot_r", "-0.028571", "-0.022857"),                                              \
      POINT("hip_l", "foot_l", "-0.028571", "-0.022857"),                                          \
      POINT("knee_r", "foot_r", "0.08", "-0.012857"),                                              \
      POINT("knee_l", "foot_l", "0.08", "-0.012857"),                                              \
      "model.feet[right].arcs={heel: hip_r, toe: knee_r}",                                         \
      "model.feet[left].arcs={heel: hip_l, toe: knee_l}"

#endif
