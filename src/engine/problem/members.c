/* problem/members.c - the tables of members.h.
 *
 * Rows are in the order of the structures. Each names what is not 0: a number without a range is
 * one that its structure's check looks at by itself (contact/load_check.c, hold_check.c,
 * collision_check.c). */
#include "problem/member_forms.h"

#include "problem/term.h"
#include "trajectory/basis.h"

#include <math.h>

#define LARGEST 1e12 /* weights, scales and offsets: products of a few do not overflow */

/* ------------------------------------------------------------------ ground, feet */

#define OF ambulo_clearance
static const ambulo__member clearance[] = {
    {NUMBER("height", height, 0.0, 1.0, AMBULO_OFF), OFF | REQUIRED | LENGTH, AMBULO__SHORT_LENGTH,
     "clearance"},
    {NUMBER("tip_from", tip_from, 0.0, 1.0, 0.3), 0, AMBULO__RATIO},
    {NUMBER("ceiling", ceiling, 1e-3, 10.0, 0.35), INFINITE | LENGTH, AMBULO__STEP_LENGTH,
     "height allowed to swinging feet"},
    {NUMBER("turn", turn, 1e-3, 1.0, 0.2), INFINITE, AMBULO__SMALL_ANGLE,
     "turn allowed to swinging feet"},
    {NUMBER("outward", outward, 0.0, 10.0, 0.06), INFINITE | LENGTH, AMBULO__SHORT_LENGTH,
     "outward room of swinging feet"},
    {NUMBER("inward", inward, 0.0, 10.0, 0.03), INFINITE | LENGTH, AMBULO__SHORT_LENGTH,
     "inward room of swinging feet"},
    {NUMBER("feet", feet, 0.0, 1.0, AMBULO_OFF), OFF | LENGTH, AMBULO__SHORT_LENGTH,
     "gap between the feet"},
};
TABLE("constraints.clearance", clearance);
#undef OF

static const char *const reactions[] = {"none", "shared"};
#define OF ambulo_ground_reaction
static const ambulo__member ground_reaction[] = {
    {CHOICE("kind", kind, reactions, AMBULO_REACTION_NONE, AMBULO_REACTION_NONE), APART},
    {NUMBER("friction", friction, 0.0, 10.0, 0.5), OFF, AMBULO__RATIO, "friction"},
    {NUMBER("free_moment", free_moment, 0.0, 10.0, 0.02), OFF | LENGTH, AMBULO__SHORT_LENGTH,
     "free moment allowed"},
    {FLAG("pressure", pressure, 1), APART},
    {NUMBER("pressure.heel", heel_pressure, -1e3, 1e3, AMBULO_OFF, AMBULO_OFF),
     OFF | RISING | LENGTH, AMBULO__SHORT_LENGTH,
     "rear end of the pressure under the heel|front end of the pressure under the heel"},
    {NUMBER("pressure.roll", heel_roll, 0.0, 1.0, 0.04), LENGTH, AMBULO__SHORT_LENGTH,
     "roll of the pressure under the heel"},
    {NUMBER("pressure.flat", flat_pressure, -1e3, 1e3, AMBULO_OFF, AMBULO_OFF), OFF | LENGTH,
     AMBULO__SHORT_LENGTH,
     "rear end of the pressure under the flat foot|front end of the pressure under the flat foot"},
    {NUMBER("pressure.toe", toe_pressure, -1e3, 1e3, AMBULO_OFF, AMBULO_OFF), OFF | RISING | LENGTH,
     AMBULO__SHORT_LENGTH,
     "rear end of the pressure under the toes|front end of the pressure under the toes"},
    {NUMBER("pressure.width", pressure_width, 1e-6, 1.0, AMBULO_OFF), OFF | LENGTH,
     AMBULO__SHORT_LENGTH, "width of the pressure"},
    {NUMBER("pressure.arc", arc_pressure, 1e-6, 1.0, 0.0006), LENGTH, AMBULO__SHORT_LENGTH,
     "distance of the pressure from an arc's"},
    {NUMBER("moment_arm", moment_arm, 1e-3, 10.0, 0.2), LENGTH, AMBULO__STEP_LENGTH,
     "moment arm of contacts"},
    {NUMBER("slant", slant, 1e-2, 100.0, 0.2), 0, AMBULO__RATIO, "slant of forces on contacts"},
    {NUMBER("loading_rate", loading_rate, 0.0, 1e4, 15.0), OFF, AMBULO__LOADING_RATE,
     "loading rate of contacts"},
    {NUMBER("flight_tolerance", flight_tolerance, 1e-6, 1.0, 0.002), 0, AMBULO__RATIO,
     "force that is left in flight"},
    {NUMBER("heel_pad", heel_pad, 0.0, 0.1, 0.0), LENGTH, AMBULO__SHORT_LENGTH,
     "give of the heel's pad"},
};
TABLE("ground_reaction", ground_reaction);
#undef OF

static const char *const modes[] = {"heel", "flat", "toe"}; /* of feet; patches have one */
#define OF ambulo_contact
static const ambulo__member contact[] = {
    {INDEX("foot", foot), APART},
    {CHOICE("mode", mode, modes, AMBULO_CONTACT_HEEL, AMBULO_CONTACT_FLAT), APART},
    {NUMBER("from", from, -HUGE_VAL, HUGE_VAL, 0.0), REQUIRED, AMBULO__EVENT_TIME, "start of"},
    {NUMBER("to", to, -HUGE_VAL, HUGE_VAL, 0.0), REQUIRED, AMBULO__EVENT_TIME, "end of"},
    {NUMBER("place", place, 0.0, 0.0, 0.0), APART, AMBULO__STEP_LENGTH,
     "foothold forward of contact|foothold to the left of contact|height of the foothold of "
     "contact"},
    {NUMBER("normal", normal, 0.0, 0.0, 0.0), APART, AMBULO__RATIO,
     "normal forward at contact|normal to the left at contact|normal upward at contact"},
    {ANGLE("heading", heading, -HUGE_VAL, HUGE_VAL, 0.0), 0, AMBULO__ANGLE, "heading of contact"},
    {INDEX("patch", patch), APART},
};
TABLE("contacts", contact);
#undef OF

#define OF ambulo_end_value
static const ambulo__member end_value[] = {
    {INDEX(NULL, coordinate)},
    {INTEGER(NULL, order, 0, 2, 0)},
    {FLAG(NULL, final, 0)},
    {NUMBER(NULL, value, 0.0, 0.0, 0.0)},
};
TABLE("ends", end_value);
#undef OF

#define OF ambulo_tube
static const ambulo__member tube[] = {
    {COUNTER(samples)},
    {ARRAY("reference", reference, AMBULO__EACH_SAMPLE_COORDINATE, 1, 0.0, 0.0), APART,
     .count_at = offsetof(OF, samples)},
    {ARRAY("coordinates", half_width, AMBULO__EACH_COORDINATE, 1, 0.0, 0.0), APART, AMBULO__ANGLE,
     "half width of the tube around"},
};
TABLE("constraints.tubes", tube);
#undef OF

/* ------------------------------------------------------------- bodies, places */

#define OF ambulo_capsule_pair
static const ambulo__member capsule_pair[] = {{INDEX(NULL, one)}, {INDEX(NULL, other)}};
TABLE("constraints.collision.pairs", capsule_pair);
#undef OF

static const char *const collisions[] = {"off", "pairs", "automatic"};
#define OF ambulo_collision
static const ambulo__member collision[] = {
    {CHOICE(NULL, mode, collisions, AMBULO_COLLISION_OFF, AMBULO_COLLISION_AUTOMATIC)},
    {ITEMS("pairs", pairs, pair_count, capsule_pair_size, capsule_pair), APART},
    {COUNTER(pair_count)},
    {NUMBER("margin", margin, 0.0, 1.0, 0.0), LENGTH, AMBULO__SHORT_LENGTH,
     "margin between capsules"},
};
TABLE("constraints.collision", collision);
#undef OF

static const char *const shapes[] = {"box", "capsule"};
#define OF ambulo_obstacle
static const ambulo__member obstacle[] = {
    {TEXT("name", name), REQUIRED | AMBULO__NOT_COPIED},
    {CHOICE(NULL, shape, shapes, AMBULO_OBSTACLE_BOX, AMBULO_OBSTACLE_BOX)},
    {NUMBER("center", center, -1e3, 1e3, 0.0), APART, AMBULO__STEP_LENGTH,
     "place forward of obstacle|place to the left of obstacle|height of obstacle"},
    {NUMBER("half_size", half, 1e-6, 1e3, 0.0), APART | REQUIRED, AMBULO__STEP_LENGTH,
     "half length of obstacle|half width of obstacle|half height of obstacle"},
    {ANGLE("heading", heading, 0.0, 0.0, 0.0), APART, AMBULO__ANGLE, "heading of obstacle"},
    {NUMBER("from", from, -1e3, 1e3, 0.0), APART, AMBULO__STEP_LENGTH,
     "one end forward of obstacle|one end to the left of obstacle|height of one end of obstacle"},
    {NUMBER("to", to, -1e3, 1e3, 0.0), APART, AMBULO__STEP_LENGTH,
     "other end forward of obstacle|other end to the left of obstacle|height of the other end of "
     "obstacle"},
    {NUMBER("radius", radius, 1e-4, 1e3, 0.0), APART | REQUIRED, AMBULO__STEP_LENGTH,
     "radius of obstacle"},
    {NUMBER("margin", margin, 0.0, 1.0, 0.0), 0, AMBULO__SHORT_LENGTH, "margin of obstacle"},
    {AT("capsules", capsules, AMBULO__INDEX_ARRAY), .count = 1,
     .count_at = offsetof(OF, capsule_count), .flags = APART},
    {COUNTER(capsule_count)},
};
TABLE("obstacles", obstacle);
#undef OF

#define OF ambulo_reach
static const ambulo__member reach[] = {
    {INDEX("point", point), APART},
    {FLAG(NULL, is_relative, 0)},
    {INDEX("relative_to", about), APART},
    {NUMBER("place", place, -HUGE_VAL, HUGE_VAL, 0.0), REQUIRED, AMBULO__STEP_LENGTH,
     "place forward reached by|place to the left reached by|height reached by"},
    {NUMBER("at", from, 0.0, 0.0, 0.0), APART},
    {NUMBER(NULL, to, 0.0, 0.0, HUGE_VAL)},
    {NUMBER("tolerance", tolerance, 0.0, 1.0, 0.0), 0, AMBULO__SHORT_LENGTH,
     "tolerance of the place reached by"},
};
TABLE("constraints.reach", reach);
#undef OF

static const char *const device_kinds[] = {"spring", "damper", "actuator"};
static const char *const sides[] = {"both", "above", "below"};
static const char *const clocks[] = {"", "time", "stride"};
#define OF ambulo_device
static const ambulo__member device[] = {
    {CHOICE("kind", kind, device_kinds, AMBULO_DEVICE_SPRING, AMBULO_DEVICE_KIND_NOT_SET), APART},
    {TEXT("name", name), APART},
    {INDEX("coordinate", coordinate), APART},
    {INDEX("link", link), APART},
    {NUMBER("position", position, 0.0, 0.0, 0.0), APART},
    {NUMBER("stiffness", stiffness, 0.0, 1e9, 0.0), APART, AMBULO__RATIO, "stiffness"},
    {NUMBER("rest", rest, 0.0, 0.0, 0.0), APART, AMBULO__ANGLE, "rest"},
    {NUMBER("pretension", pretension, -1e9, 1e9, 0.0), APART, AMBULO__FORCE, "pretension"},
    {CHOICE("side", side, sides, AMBULO_DEVICE_BOTH, AMBULO_DEVICE_BOTH), APART},
    {NUMBER("smoothing", smoothing, 0.0, 0.0, 0.01), APART, AMBULO__ANGLE, "smoothing"},
    {NUMBER("damping", damping, 0.0, 1e9, 0.0), APART, AMBULO__RATIO, "damping"},
    {NUMBER("amount", amount, -1e9, 1e9, 1.0), APART, AMBULO__FORCE, "amount"},
    {CHOICE("by", clock, clocks, AMBULO_DEVICE_CONSTANT, AMBULO_DEVICE_CONSTANT), APART},
    {ARRAY("points", points, AMBULO__COUNTED, 2, 0.0, 0.0), APART,
     .count_at = offsetof(OF, point_count)},
    {COUNTER(point_count)},
    {INDEX("foot", foot), APART},
    {FLAG(NULL, clutch, 0)},
    {FLAG("alone", alone, 0), APART},
    {INDEX(NULL, image_of)},
    {NUMBER("engaged.from", from, 0.0, 1.0, 0.0), REQUIRED, AMBULO__RATIO, "engagement"},
    {NUMBER("engaged.to", to, 0.0, 1.0, 0.0), REQUIRED, AMBULO__RATIO, "release"},
    {NUMBER("engaged.ramp", ramp, 1e-6, 0.5, 0.05), 0, AMBULO__RATIO, "ramp"},
};
TABLE("devices", device);
#undef OF

#define OF ambulo_hold
static const ambulo__member hold[] = {
    {TEXT("name", name), APART},
    {INDEX("hands", hand), APART},
    {NUMBER("mass", mass, 0.0, 1000.0, 0.0), 0, AMBULO__MASS, "mass"},
    {NUMBER("inertia", inertia, 0.0, 1000.0, 0.0), 0, AMBULO__RATIO, "inertia"},
    {NUMBER("center", center, -100.0, 100.0, 0.0), 0, AMBULO__STEP_LENGTH,
     "center forward|center to the left|center upward"},
    {NUMBER("force", force, -1e5, 1e5, 0.0), 0, AMBULO__FORCE,
     "push forward|push to the left|push upward"},
    {NUMBER("from", from, 0.0, 1e6, 0.0), 0, AMBULO__EVENT_TIME, "start of the hold"},
    {NUMBER("to", to, 0.0, 1e6, HUGE_VAL), 0, AMBULO__EVENT_TIME, "end of the hold"},
    {NUMBER("ramp", ramp, 0.001, 1e6, 0.1), 0, AMBULO__TIME, "ramp"},
    {NUMBER("size", size, -100.0, 100.0, 0.0)},
};
TABLE("load", hold);
#undef OF

/* ---------------------------------------------------------------------- objective */

#define OF ambulo_term
static const ambulo__member term[] = {
    {INTEGER("term", kind, 0, 0, 0), APART},
    {TEXT("name", name), APART},
    {NUMBER("weight", weight, 0.0, LARGEST, 1.0), EXACT, AMBULO__RATIO, "weight of"},
    {ARRAY("scale", scale, AMBULO__EACH_COORDINATE, 1, -LARGEST, LARGEST), EXACT | APART,
     AMBULO__RATIO, "scale", AMBULO__TERM_SCALE | AMBULO__TERM_REST},
    {ARRAY("offset", offset, AMBULO__EACH_COORDINATE, 1, -LARGEST, LARGEST), EXACT | APART,
     AMBULO__TORQUE, "offset"},
    {NUMBER("smoothing", smoothing, 1e-9, 1e9, 1.0), 0, AMBULO__RATIO, "smoothing of",
     AMBULO__TERM_SMOOTHING},
    {NUMBER("power", power, 2.0, 8.0, 2.0), EXACT, AMBULO__RATIO, "exponent of",
     AMBULO__TERM_POWER},
    {ARRAY("passive", passive, AMBULO__EACH_COORDINATE, 4, -LARGEST, LARGEST), EXACT | APART,
     .of_kinds = AMBULO__TERM_CURVES},
    {ARRAY("strength", strength, AMBULO__EACH_COORDINATE, 6, -LARGEST, LARGEST), EXACT | APART,
     AMBULO__RATIO, "strength", AMBULO__TERM_CURVES},
    {FLAG(NULL, strength_is_limits, 0)},
    {ARRAY(NULL, price, AMBULO__EACH_COORDINATE, 2, -LARGEST, LARGEST), EXACT, AMBULO__RATIO,
     "price", AMBULO__TERM_CURVES},
    {INTEGER("points", point, 0, 0, 0), APART, .of_kinds = AMBULO__TERM_LINE},
    {NUMBER("height", height, 1e-6, 10.0, 0.02), LENGTH, AMBULO__SHORT_LENGTH,
     "height that swinging feet keep in", AMBULO__TERM_HEIGHT},
    {ARRAY("scale", device_scale, AMBULO__EACH_DEVICE, 1, 0.0, LARGEST), EXACT | APART,
     .of_kinds = AMBULO__TERM_DEVICES},
    {ARRAY("reference", reference, AMBULO__EACH_NODE_COORDINATE, 1, -LARGEST, LARGEST),
     EXACT | APART, .of_kinds = AMBULO__TERM_REFERENCE},
    {BORROWED(function)},
    {BORROWED(user)},
    {ARRAY("tendon", tendon, AMBULO__EACH_COORDINATE, 1, 0.0, LARGEST), EXACT | APART,
     AMBULO__RATIO, "stiffness of the tendon", AMBULO__TERM_TENDON},
    {NUMBER("negative", negative, 0.0, 1.0, 1.0), EXACT, AMBULO__RATIO,
     "price of negative power of", AMBULO__TERM_NEGATIVE},
    {NUMBER("activation", activation, 0.0, LARGEST, 1.0), EXACT, AMBULO__RATIO,
     "price of activation in", AMBULO__TERM_MUSCLES},
    {NUMBER("metabolic", metabolic, 0.0, LARGEST, 0.0), EXACT, AMBULO__RATIO,
     "price of metabolic power in", AMBULO__TERM_MUSCLES},
    {NUMBER("reserve", reserve, 1e-9, LARGEST, 0.2), EXACT, AMBULO__RATIO, "price of reserves in",
     AMBULO__TERM_MUSCLES},
    {AT("points", marks, AMBULO__INDEX_ARRAY), .count = 1, .count_at = offsetof(OF, mark_count),
     .flags = APART, .of_kinds = AMBULO__TERM_MARKS},
    {COUNTER(mark_count)},
    {ARRAY("scale", mark_scale, AMBULO__COUNTED, 1, 0.0, LARGEST), EXACT | APART,
     .count_at = offsetof(OF, mark_count), .of_kinds = AMBULO__TERM_MARKS},
    {ARRAY("reference", mark_reference, AMBULO__EACH_NODE_COUNTED, 3, -LARGEST, LARGEST),
     EXACT | APART | OFF, .count_at = offsetof(OF, mark_count), .of_kinds = AMBULO__TERM_MARKS},
    {ARRAY("scale", foot_scale, AMBULO__EACH_FOOT, 1, 0.0, LARGEST), EXACT | APART,
     .of_kinds = AMBULO__TERM_LOADS},
    {ARRAY("reference", foot_reference, AMBULO__EACH_NODE_FOOT, 3, -LARGEST, LARGEST),
     EXACT | APART | OFF, .of_kinds = AMBULO__TERM_LOADS},
};
TABLE("objective", term);
#undef OF

#define OF ambulo_user_row
static const ambulo__member user_row[] = {
    {TEXT(NULL, name)},
    {TEXT(NULL, unit)},
    {INTEGER(NULL, relation, 0, 0, AMBULO_NOT_NEGATIVE)},
    {NUMBER(NULL, from, 0.0, 0.0, 0.0)},
    {NUMBER(NULL, to, 0.0, 0.0, HUGE_VAL)},
    {BORROWED(function)},
    {BORROWED(user)},
};
TABLE(NULL, user_row);
#undef OF

/* --------------------------------------------------------------------- the whole */

static const char *const grids[] = {"uniform", "events"};
static const char *const bases[] = {"bspline", "central_difference", "hermite"};
static const char *const supports[] = {"off", "box", "hull"};
static const char *const limits[] = {"off", "nodes", "control_points"};
static const char *const kinds_of_ends[] = {"free", "periodic", "mirrored"};
#define OF ambulo_problem_definition
static const ambulo__member definition[] = {
    {TEXT("name", name), APART | AMBULO__NOT_HASHED},
    {BORROWED(model)},
    {NUMBER("time.duration", duration, 1e-6, 1e6, 1.0), EXACT | APART | REQUIRED, AMBULO__TIME,
     "duration"},
    {INTEGER("time.intervals", intervals, 1, AMBULO__MOST_INTERVALS, 12), REQUIRED},
    {CHOICE("time.grid", grid, grids, AMBULO_GRID_UNIFORM, AMBULO_GRID_UNIFORM)},
    {CHOICE("trajectory.basis", discretization, bases, AMBULO_BSPLINE, AMBULO_BSPLINE)},
    {INTEGER("trajectory.degree", degree, 3, AMBULO__MAX_DEGREE, 3), APART},
    {INTEGER("trajectory.intervals", spline_intervals, 0, AMBULO__MOST_INTERVALS, 0), APART},
    {CHOICE("trajectory.knots", knots, grids, AMBULO_GRID_UNIFORM, AMBULO_GRID_UNIFORM), APART},
    {ARRAY(NULL, node_times, AMBULO__EACH_NODE, 1, 0.0, 0.0)},
    {ARRAY("trajectory.breakpoints", breakpoints, AMBULO__EACH_KNOT, 1, 0.0, 0.0), APART},
    {ITEMS("contacts", contacts, contact_count, contact_size, contact)},
    {COUNTER(contact_count)},
    {NUMBER("constraints.ground_height", ground_height, -1e3, 1e3, 0.0), 0, AMBULO__STEP_LENGTH,
     "height of the ground"},
    {FLAG("constraints.ground_penetration", ground_penetration, 0)},
    {FLAG("constraints.foot_strike", foot_strike, 0)},
    {CHOICE("constraints.zmp", support, supports, AMBULO_SUPPORT_OFF, AMBULO_SUPPORT_OFF)},
    {NUMBER("constraints.zmp_margin", support_margin, 0.0, 10.0, 0.0), LENGTH, AMBULO__SHORT_LENGTH,
     "margin of the support polygon"},
    {NUMBER("constraints.minimum_force", minimum_force, 0.0, 100.0, AMBULO_OFF), OFF,
     AMBULO__BODY_WEIGHT, "least vertical force"},
    {NUMBER("constraints.contact_tolerance", contact_tolerance, 0.0, 0.1, 0.0), LENGTH,
     AMBULO__SHORT_LENGTH, "contact tolerance"},
    {NUMBER("constraints.orientation_tolerance", orientation_tolerance, 0.0, 0.5, 0.01), 0,
     AMBULO__SMALL_ANGLE, "orientation tolerance"},
    {ANGLE("constraints.strike_pitch", strike_pitch, -1.5, 1.5, AMBULO_OFF, AMBULO_OFF),
     OFF | APART, AMBULO__ANGLE, "least pitch at heel strike|largest pitch at heel strike"},
    {PART("constraints.clearance", clearance, clearance_size)},
    {PART("ground_reaction", ground_reaction, ground_reaction_size)},
    {CHOICE("constraints.joint_limits", joint_limits, limits, AMBULO_LIMIT_OFF, AMBULO_LIMIT_OFF)},
    {FLAG("constraints.speed_limits", speed_limits, 0)},
    {FLAG("constraints.torque_limits", torque_limits, 0)},
    {CHOICE("ends.kind", ends, kinds_of_ends, AMBULO_ENDS_FREE, AMBULO_ENDS_FREE), APART},
    {INTEGER("ends.order", ends_order, 0, 2, 1)},
    {NUMBER("ends.travel", travel, -1e6, 1e6, 0.0), 0, AMBULO__STEP_LENGTH, "travel"},
    {NUMBER("ends.rise", rise, -1e6, 1e6, 0.0), 0, AMBULO__STEP_LENGTH, "rise"},
    {ITEMS(NULL, end_values, end_value_count, end_value_size, end_value)},
    {COUNTER(end_value_count)},
    {COUNTER(tube_count)},
    {ITEMS("constraints.tubes", tubes, tube_count, tube_size, tube)},
    {PART("constraints.collision", collision, collision_size)},
    {ITEMS("obstacles", obstacles, obstacle_count, obstacle_size, obstacle)},
    {COUNTER(obstacle_count)},
    {ITEMS("constraints.reach", reaches, reach_count, reach_size, reach)},
    {COUNTER(reach_count)},
    {ITEMS("devices", devices, device_count, device_size, device)},
    {COUNTER(device_count)},
    {ITEMS("load", holds, hold_count, hold_size, hold)},
    {COUNTER(hold_count)},
    {ITEMS("objective", terms, term_count, term_size, term)},
    {COUNTER(term_count)},
    {ITEMS(NULL, user_rows, user_row_count, user_row_size, user_row)},
    {COUNTER(user_row_count)},
    {BORROWED(muscles)},
};
TABLE(NULL, definition);
#undef OF

/* ----------------------------------------------------------- options of the solver */

static const char *const algorithms[] = {"auto", "slsqp", "auglag"};
static const char *const switches[] = {"off", "on", "false", "true"};
static const char *const refinements[] = {"given", "auto"};
#define OF ambulo_options
static const ambulo__member options[] = {
    {CHOICE("solver.algorithm", algorithm, algorithms, AMBULO_AUTO, AMBULO_AUTO)},
    {INTEGER("solver.maximum_evaluations", maximum_evaluations, 1, 1e9, 20000)},
    {INTEGER("solver.maximum_iterations", maximum_iterations, 1, 1e9, 150)},
    {NUMBER("solver.time_limit", time_limit, 1e-9, 1e9, AMBULO_OFF), OFF | INFINITE | EXACT | APART,
     AMBULO__TIME},
    {NUMBER("solver.maximum_memory", maximum_memory, 1.0, 1e18, AMBULO_OFF),
     OFF | INFINITE | EXACT | APART, AMBULO__BYTES},
    {NUMBER("solver.feasibility_tolerance", feasibility_tolerance, 1e-14, 1.0, 1e-6), EXACT,
     AMBULO__RATIO},
    {NUMBER("solver.optimality_tolerance", optimality_tolerance, 1e-14, 1.0, 1e-3), EXACT,
     AMBULO__RATIO},
    {FLAG("solver.continuation", continuation, 1), .words = switches, .word_count = 4},
    {INTEGER("solver.dense_samples", dense_samples, 1, 1000, 10)},
    {CHOICE("solver.grid", refine, refinements, 0, 0)},
    {INTEGER("solver.starts", starts, 1, AMBULO_MOST_STARTS, 1)},
    {BORROWED(progress)},
    {BORROWED(user)},
    {BORROWED(multipliers)},
};
TABLE(NULL, options);
#undef OF
