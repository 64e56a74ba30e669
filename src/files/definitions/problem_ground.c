/* definitions/problem_ground.c - `ground`, `load` and `ground_reaction` of a problem file, and the
 * parts of `constraints` that go with them: tolerances of the contacts, clearance. */
#include "definitions/problem_reader.h"

#include "model/conditions.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

double ambulo__read_plain_angle(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                double fallback) {
  if (!node) return fallback;
  if (reader->radians == 0.0) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "an angle, but the file does not state its unit; expected 'angles: "
                             "degrees' or 'angles: radians'");
    return fallback;
  }
  return reader->radians * ambulo__yaml_number(node, 0.0);
}

/* ------------------------------------------------------------ ground and load */

static void read_slope(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  if (!section) return;
  const ambulo__yaml_node *node = ambulo__yaml_get(section, "slope");
  double slope = ambulo__read_plain_angle(reader, node, 0.0);
  if (fabs(slope) > AMBULO__LARGEST_SLOPE)
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "a slope of %g rad; expected -%g to %g rad", slope,
                             AMBULO__LARGEST_SLOPE, AMBULO__LARGEST_SLOPE);
  else if (slope != 0.0)
    ambulo__model_tilt(reader->model, slope);
  ambulo__yaml_close(section);
}

static void unknown_link(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                         const char *name) {
  const ambulo_model *model = reader->model;
  size_t count = (size_t)model->link_count;
  const char **names = ambulo__reader_alloc(reader, count, sizeof *names);
  char hint[100];
  for (size_t i = 0; names && i < count; i++) names[i] = model->links[i].name;
  const char *nearest = names ? ambulo__nearest(name, names, count) : NULL;
  if (nearest) (void)snprintf(hint, sizeof hint, "did you mean '%s'?", nearest);
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, nearest ? hint : NULL,
                           "unknown link (got '%s'); expected a link of the model", name);
}

static void read_one_load(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  double position[3] = {0.0, 0.0, 0.0};
  if (ambulo__yaml_get(section, "hands")) {
    ambulo__read_hold(reader, section);
    return;
  }
  const ambulo__yaml_node *node = ambulo__yaml_require(section, "link");
  const char *name = ambulo__yaml_name(node);
  double mass = ambulo__yaml_number_in(ambulo__yaml_require(section, "mass"), 1e-6, 1000.0, 1.0);
  int placed = ambulo__yaml_numbers(ambulo__yaml_require(section, "position"), 3, position);
  ambulo__yaml_close(section);
  int link = name[0] ? ambulo_model_find_link(reader->model, name) : -1;
  if (name[0] && link < 0) unknown_link(reader, node, name);
  if (link >= 0 && placed) ambulo__model_carry(reader->model, link, mass, position);
}

/* one mapping, or a list of them */
static void read_load(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  if (!node) return;
  reader->keys.loads = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE);
  if (!reader->keys.loads) {
    read_one_load(reader, node);
    return;
  }
  int count = ambulo__yaml_items(node);
  if (count < 1 || count > AMBULO__MOST_LOADS) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "%d loads; expected 1 to %d", count,
                             AMBULO__MOST_LOADS);
    return;
  }
  for (int i = 0; i < count; i++) {
    int on_links = reader->model->load_count, in_hands = reader->definition.hold_count;
    read_one_load(reader, ambulo__yaml_item(node, i));
    if (reader->definition.hold_count > in_hands) reader->keys.hold_item[in_hands] = i;
    if (reader->model->load_count > on_links) reader->keys.load_item[on_links] = i;
  }
}

/* ------------------------------------------------------------ ground reaction */

/* a number, or the word `off`: no rows */
static double read_bound(const ambulo__yaml_node *node, double most, double fallback) {
  static const char *const words[] = {"off"};
  const char *text = ambulo__yaml_text(node);
  if (!text[0]) return fallback;
  if (text[0] != 'o') return ambulo__yaml_number_in(node, 0.0, most, fallback);
  (void)ambulo__yaml_choice(node, words, 1, 0);
  return AMBULO_OFF;
}

static void read_interval(const ambulo__yaml_node *node, double interval[2]) {
  if (!ambulo__yaml_numbers(node, 2, interval) || interval[0] < interval[1]) return;
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL, "[%g, %g] m; expected lower < upper",
                           interval[0], interval[1]);
}

static void read_pressure(const ambulo__yaml_node *node, ambulo_ground_reaction *r) {
  static const char *const words[] = {"off", "on"};
  if (!node) return;
  if (ambulo__yaml_is(node, AMBULO__YAML_SCALAR)) {
    r->pressure = ambulo__yaml_choice(node, words, 2, 1);
    return;
  }
  read_interval(ambulo__yaml_get(node, "heel"), r->heel_pressure);
  r->heel_roll = ambulo__yaml_number_in(ambulo__yaml_get(node, "roll"), 0.0, 1.0, r->heel_roll);
  if (ambulo__yaml_get(node, "flat"))
    (void)ambulo__yaml_numbers(ambulo__yaml_get(node, "flat"), 2, r->flat_pressure);
  read_interval(ambulo__yaml_get(node, "toe"), r->toe_pressure);
  r->pressure_width =
      ambulo__yaml_number_in(ambulo__yaml_get(node, "width"), 1e-6, 1.0, r->pressure_width);
  r->arc_pressure =
      ambulo__yaml_number_in(ambulo__yaml_get(node, "arc"), 1e-6, 1.0, r->arc_pressure);
  ambulo__yaml_close(node);
}

/* a law has numbers of its own; those of the other one may stay in the file */
static void warn_of_others(const ambulo__yaml_node *section, int kind) {
  static const char *const kinds[] = {"none", "two_step", "shared"};
  static const struct {
    const char *key;
    int kind;
  } own[] = {{"transfer", AMBULO_REACTION_TWO_STEP},      {"exponent", AMBULO_REACTION_TWO_STEP},
             {"shear", AMBULO_REACTION_TWO_STEP},         {"moment_arm", AMBULO_REACTION_SHARED},
             {"slant", AMBULO_REACTION_SHARED},           {"loading_rate", AMBULO_REACTION_SHARED},
             {"flight_tolerance", AMBULO_REACTION_SHARED}};
  for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
    const ambulo__yaml_node *node = ambulo__yaml_get(section, own[i].key);
    if (!node || kind == AMBULO_REACTION_NONE || kind == own[i].kind) continue;
    ambulo__yaml_warning(node, NULL, "'%s' has no effect with kind %s; it belongs to kind %s",
                         own[i].key, kinds[kind], kinds[own[i].kind]);
  }
}

static void read_reaction(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  static const char *const kinds[] = {"none", "two_step", "shared"};
  static const char *const transfers[] = {"early", "linear", "smooth"};
  ambulo_problem_definition *d = &reader->definition;
  ambulo_ground_reaction *r = &d->ground_reaction;
  if (!section) return;
  const ambulo__yaml_node *given = ambulo__yaml_get(section, "kind");
  int kind = ambulo__yaml_choice(given, kinds, 3, given ? -1 : AMBULO_REACTION_TWO_STEP);
  int transfer = ambulo__yaml_choice(ambulo__yaml_get(section, "transfer"), transfers, 3, 0);
  if (kind >= 0) warn_of_others(section, kind);
  if (kind < 0) kind = AMBULO_REACTION_TWO_STEP; /* that was said */
  r->kind = (ambulo_reaction_kind)kind;
  r->transfer = (ambulo_transfer)(AMBULO_TRANSFER_EARLY + transfer);
  r->exponent =
      ambulo__yaml_number_in(ambulo__yaml_get(section, "exponent"), 1.0, 10.0, r->exponent);
  r->shear = ambulo__yaml_number_in(ambulo__yaml_get(section, "shear"), 0.0, 2.0, r->shear);
  r->moment_arm =
      ambulo__yaml_number_in(ambulo__yaml_get(section, "moment_arm"), 1e-3, 10.0, r->moment_arm);
  r->slant = ambulo__yaml_number_in(ambulo__yaml_get(section, "slant"), 1e-2, 100.0, r->slant);
  r->loading_rate = read_bound(ambulo__yaml_get(section, "loading_rate"), 1e4, r->loading_rate);
  r->flight_tolerance = ambulo__yaml_number_in(ambulo__yaml_get(section, "flight_tolerance"), 1e-6,
                                               1.0, r->flight_tolerance);
  r->friction = read_bound(ambulo__yaml_get(section, "friction"), 10.0, r->friction);
  r->free_moment = read_bound(ambulo__yaml_get(section, "free_moment"), 10.0, r->free_moment);
  int is_split = kind == AMBULO_REACTION_TWO_STEP;
  double force = d->minimum_force >= 0.0 || !is_split ? d->minimum_force : 0.2;
  d->minimum_force = read_bound(ambulo__yaml_get(section, "minimum_force"), 100.0, force);
  read_pressure(ambulo__yaml_get(section, "pressure"), r);
  ambulo__yaml_close(section);
}

void ambulo__read_ground(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  read_slope(reader, ambulo__reader_section(root, "ground"));
  read_load(reader, ambulo__yaml_get(root, "load"));
  read_reaction(reader, ambulo__reader_section(root, "ground_reaction"));
}

/* --------------------------------------------------------- contacts, clearance */

static void read_strike_pitch(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  double *pitch = reader->definition.strike_pitch;
  if (!node) return;
  if (!ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) || ambulo__yaml_items(node) != 2) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "'strike_pitch' is not a list of two angles");
    return;
  }
  for (int i = 0; i < 2; i++)
    pitch[i] = ambulo__read_plain_angle(reader, ambulo__yaml_item(node, i), 0.0);
  if (pitch[0] < pitch[1] && fabs(pitch[0]) < 1.5 && fabs(pitch[1]) < 1.5) return;
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                           "from %g to %g rad; expected two rising angles of less than 1.5 rad",
                           pitch[0], pitch[1]);
}

void ambulo__read_contact_rows(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  ambulo_problem_definition *d = &reader->definition;
  ambulo_clearance *c = &d->clearance;
  d->contact_tolerance =
      ambulo__yaml_number_in(ambulo__yaml_get(section, "contact_tolerance"), 0.0, 0.1, 0.0);
  d->orientation_tolerance = ambulo__yaml_number_in(
      ambulo__yaml_get(section, "orientation_tolerance"), 0.0, 0.5, d->orientation_tolerance);
  read_strike_pitch(reader, ambulo__yaml_get(section, "strike_pitch"));
  const ambulo__yaml_node *node = ambulo__reader_section(section, "clearance");
  if (!node) return;
  c->height = ambulo__yaml_number_in(ambulo__yaml_require(node, "height"), 0.0, 1.0, 0.0);
  c->tip_from = ambulo__yaml_number_in(ambulo__yaml_get(node, "tip_from"), 0.0, 1.0, c->tip_from);
  c->ceiling = ambulo__yaml_number_in(ambulo__yaml_get(node, "ceiling"), 1e-3, 10.0, c->ceiling);
  c->turn = ambulo__yaml_number_in(ambulo__yaml_get(node, "turn"), 1e-3, 1.0, c->turn);
  c->outward = ambulo__yaml_number_in(ambulo__yaml_get(node, "outward"), 0.0, 10.0, c->outward);
  c->inward = ambulo__yaml_number_in(ambulo__yaml_get(node, "inward"), 0.0, 10.0, c->inward);
  c->feet = ambulo__yaml_number_in(ambulo__yaml_get(node, "feet"), 0.0, 1.0, c->feet);
  ambulo__yaml_close(node);
}
