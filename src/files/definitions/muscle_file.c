/* definitions/muscle_file.c - a file of muscles, from text to muscles of a model
 * (docs/muscles-format.md).
 *
 * Lengths are those of the file's person. With d the distances from each of its `joints` to the
 * next, which the model has at q = 0, lengths are scaled by s = sum d / (thigh + shank), forces by
 * (mass / mass)^(2/3). Muscles are of one side; `mirror: {_r: _l}` adds each one's mirror image,
 * whose coordinates are those of the model's own mirror image and whose pull along z is reversed.
 */
#include <math.h>
#include <string.h>

#include "base/arithmetic.h"
#include "base/numtext.h"
#include "definitions/muscle_reader.h"
#include "mechanics/pose.h"

enum { MOST_NAMES = 256 };

/* ------------------------------------------------------------------- names */

/* "did you mean 'hip_r'?"; NULL: none is near */
static const char *hint_of(ambulo__muscle_reader *r, const char *name, const char *const *names,
                           int count) {
  const char *nearest = ambulo__nearest(name, names, (size_t)count);
  return nearest ? ambulo__arena_print(&r->arena, "did you mean '%s'?", nearest) : NULL;
}

static int missing(ambulo__muscle_reader *r, const ambulo__yaml_node *node, const char *what,
                   const char *name) {
  const ambulo_model *model = r->model;
  const char *names[MOST_NAMES];
  int count = 0, links = what[0] == 'l', all = links ? model->link_count : model->coordinate_count;
  for (; count < all && count < MOST_NAMES; count++)
    names[count] = links ? model->links[count].name : model->coordinates[count].name;
  if (name[0])
    (void)ambulo__yaml_error(node, AMBULO_E_MODEL, hint_of(r, name, names, count),
                             "no %s '%s' in model '%s'", what, name, model->name);
  return -1;
}

static int find_coordinate(ambulo__muscle_reader *r, const ambulo__yaml_node *node,
                           const char *name) {
  int found = ambulo_model_find_coordinate(r->model, name);
  if (found >= 0 && r->model->coordinates[found].mirror == found &&
      ambulo__muscle_other_side(r, name))
    (void)ambulo__yaml_error(node, AMBULO_E_MODEL, NULL,
                             "coordinate '%s' of model '%s' has no mirror image", name,
                             r->model->name);
  return found >= 0 ? found : missing(r, node, "coordinate", name);
}

static int find_link(ambulo__muscle_reader *r, const ambulo__yaml_node *node) {
  const char *name = ambulo__yaml_name(node);
  int found = ambulo_model_find_link(r->model, name);
  return found >= 0 ? found : missing(r, node, "link", name);
}

/* ------------------------------------------------------------------ header */

static void read_mirror(ambulo__muscle_reader *r, const ambulo__yaml_node *node) {
  int pairs = ambulo__yaml_pairs(node);
  if (pairs == 1) {
    r->suffix[0] = ambulo__yaml_key(node, 0);
    r->suffix[1] = ambulo__yaml_text(ambulo__yaml_value(node, 0));
  } else if (ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "%d pairs of endings; expected one, such as {_r: _l}", pairs);
  }
}

static void read_joints(ambulo__muscle_reader *r, const ambulo__yaml_node *node) {
  int pairs = ambulo__yaml_pairs(node);
  if (pairs > AMBULO__MOST_MUSCLE_JOINTS)
    (void)ambulo__yaml_error(node, AMBULO_E_LIMIT, NULL, "%d joints; expected at most %d", pairs,
                             AMBULO__MOST_MUSCLE_JOINTS);
  for (int i = 0; i < pairs && i < AMBULO__MOST_MUSCLE_JOINTS; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_value(node, i);
    ambulo__muscle_joint *j = &r->joints[r->joint_count++];
    j->name = ambulo__yaml_key(node, i);
    j->link = find_link(r, ambulo__yaml_require(item, "link"));
    j->axes = find_link(r, ambulo__yaml_require(item, "axes"));
    ambulo__yaml_close(item);
  }
}

static void read_ranges(ambulo__muscle_reader *r, const ambulo__yaml_node *node) {
  const double degree = acos(-1.0) / 180.0;
  int pairs = ambulo__yaml_pairs(node);
  r->ranges = ambulo__arena_take(&r->arena, (size_t)pairs, sizeof *r->ranges);
  for (int i = 0; r->ranges && i < pairs; i++) {
    const ambulo__yaml_node *value = ambulo__yaml_value(node, i);
    ambulo__muscle_range *one = &r->ranges[r->range_count++];
    one->coordinate = find_coordinate(r, value, ambulo__yaml_key(node, i));
    if (ambulo__yaml_numbers(value, 2, one->ends) && one->ends[0] >= one->ends[1])
      (void)ambulo__yaml_error(
          value, AMBULO_E_SCHEMA, NULL, "from %s to %s degrees; expected the smaller first",
          ambulo__number_text(one->ends[0]).text, ambulo__number_text(one->ends[1]).text);
    for (int end = 0; end < 2; end++) one->ends[end] *= degree;
  }
}

/* from each joint's centre, the origin of what its link hangs on, to the next one's, at q = 0 */
static ambulo_status leg_length(ambulo__muscle_reader *r) {
  ambulo__pose pose;
  size_t d = (size_t)r->model->coordinate_count;
  double at[2][3], *zero = ambulo__arena_take(&r->arena, d, sizeof *zero);
  if (!zero || ambulo__pose_create(r->model, &r->arena.allocator, &pose)) return AMBULO_E_MEMORY;
  ambulo__pose_at(&pose, zero);
  for (int i = 0; i < r->joint_count; i++) {
    const double origin[3] = {0.0, 0.0, 0.0};
    int link = r->joints[i].link;
    ambulo__pose_point(&pose, link < 0 ? -1 : r->model->links[link].parent, origin, at[i % 2]);
    for (int k = 0; i > 0 && k < 3; k++) at[(i + 1) % 2][k] -= at[i % 2][k];
    if (i > 0) r->length += sqrt(ambulo__dot(at[(i + 1) % 2], at[(i + 1) % 2]));
  }
  ambulo__pose_free(&pose);
  return AMBULO_OK;
}

static ambulo_status read_scale(ambulo__muscle_reader *r, const ambulo__yaml_node *subject) {
  double mass = ambulo__yaml_number_in(ambulo__yaml_require(subject, "mass"), 0.5, 1000, 75);
  double thigh = ambulo__yaml_number_in(ambulo__yaml_require(subject, "thigh"), 0.01, 2, 0.4);
  double shank = ambulo__yaml_number_in(ambulo__yaml_require(subject, "shank"), 0.01, 2, 0.4);
  ambulo__yaml_close(subject);
  ambulo_status status = leg_length(r);
  r->length = r->length > 0.0 ? r->length / (thigh + shank) : 1.0;
  r->force =
      pow((ambulo_model_mass(r->model) - ambulo__model_load_mass(r->model)) / mass, 2.0 / 3.0);
  return status;
}

/* ------------------------------------------------------------------ muscles */

static int read_exponents(ambulo__muscle_reader *r, const ambulo__yaml_node *node, int coordinates,
                          const unsigned char (**exponents)[AMBULO__SPAN]) {
  int terms = ambulo__yaml_items(node);
  unsigned char(*made)[AMBULO__SPAN] = ambulo__arena_take(&r->arena, (size_t)terms, sizeof *made);
  for (int t = 0; made && t < terms; t++) {
    const ambulo__yaml_node *row = ambulo__yaml_item(node, t);
    if (ambulo__yaml_items(row) != coordinates) {
      (void)ambulo__yaml_error(row, AMBULO_E_SCHEMA, NULL,
                               "%d exponents; expected one for each of %d coordinates",
                               ambulo__yaml_items(row), coordinates);
      return 0;
    }
    for (int i = 0; i < coordinates; i++)
      made[t][i] = (unsigned char)ambulo__yaml_integer(ambulo__yaml_item(row, i), 0,
                                                       AMBULO_MUSCLE_EXPONENT, 0);
  }
  *exponents = (const unsigned char(*)[AMBULO__SPAN])made;
  return made ? terms : 0;
}

static const double *read_lengths(ambulo__muscle_reader *r, const ambulo__yaml_node *node,
                                  int terms) {
  double *made = ambulo__arena_take(&r->arena, (size_t)terms, sizeof *made);
  if (!made || !ambulo__yaml_numbers(node, terms, made)) return made;
  for (int t = 0; t < terms; t++) made[t] *= r->length;
  return made;
}

static void read_pull(ambulo__muscle_reader *r, const ambulo__yaml_node *node,
                      const ambulo__muscle_joint *j, int coordinates, ambulo_muscle_pull *pull) {
  static const char *const axes[] = {"x", "y", "z"};
  pull->joint = j->name;
  pull->link = j->link;
  pull->axes = j->axes;
  pull->term_count =
      read_exponents(r, ambulo__yaml_require(node, "exponents"), coordinates, &pull->exponents);
  double(*slopes)[3] = ambulo__arena_take(&r->arena, (size_t)pull->term_count, sizeof *slopes);
  double *one = ambulo__arena_take(&r->arena, (size_t)pull->term_count, sizeof *one);
  for (int k = 0; k < 3; k++) {
    const ambulo__yaml_node *values = ambulo__yaml_require(node, axes[k]);
    if (!slopes || !one || !ambulo__yaml_numbers(values, pull->term_count, one)) continue;
    for (int t = 0; t < pull->term_count; t++) slopes[t][k] = one[t];
  }
  pull->slopes = (const double(*)[3])slopes;
  ambulo__yaml_close(node);
}

static void read_pulls(ambulo__muscle_reader *r, const ambulo__yaml_node *node, ambulo_muscle *m) {
  int count = ambulo__yaml_pairs(node);
  ambulo_muscle_pull *pulls = ambulo__arena_take(&r->arena, (size_t)count, sizeof *pulls);
  for (int i = 0; pulls && i < count; i++) {
    const char *name = ambulo__yaml_key(node, i), *names[AMBULO__MOST_MUSCLE_JOINTS];
    const ambulo__muscle_joint *found = NULL;
    for (int j = 0; j < r->joint_count; j++) {
      names[j] = r->joints[j].name;
      if (!strcmp(names[j], name)) found = &r->joints[j];
    }
    if (!found) {
      (void)ambulo__yaml_error(ambulo__yaml_value(node, i), AMBULO_E_SCHEMA,
                               hint_of(r, name, names, r->joint_count),
                               "no joint '%s' among the file's 'joints'", name);
      continue;
    }
    read_pull(r, ambulo__yaml_value(node, i), found, m->coordinate_count, &pulls[m->pull_count++]);
  }
  m->pulls = pulls;
}

static void read_coordinates(ambulo__muscle_reader *r, const ambulo__yaml_node *node,
                             ambulo_muscle *m) {
  int count = ambulo__yaml_items(node);
  if (count < 1 || count > AMBULO__SPAN) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "%d coordinates; expected 1 to %d", count,
                             AMBULO__SPAN);
    return;
  }
  m->coordinate_count = count;
  for (int i = 0; i < count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(node, i);
    m->coordinates[i] = find_coordinate(r, item, ambulo__yaml_name(item));
    for (int k = 0; k < r->range_count; k++)
      if (r->ranges[k].coordinate == m->coordinates[i])
        memcpy(m->range[i], r->ranges[k].ends, sizeof m->range[i]);
  }
}

static void read_muscle(ambulo__muscle_reader *r, const ambulo__yaml_node *item, ambulo_muscle *m) {
  *m = ambulo_muscle_default();
  m->name = ambulo__yaml_name(ambulo__yaml_require(item, "name"));
  const ambulo__yaml_node *group = ambulo__yaml_get(item, "group");
  if (group) m->group = ambulo__yaml_name(group);
  m->force = r->force * ambulo__yaml_number_in(ambulo__yaml_require(item, "force"), 0, 1e6, 1);
  m->fiber = r->length * ambulo__yaml_number_in(ambulo__yaml_require(item, "fiber"), 0, 2, 0.1);
  m->tendon = r->length * ambulo__yaml_number_in(ambulo__yaml_require(item, "tendon"), 0, 2, 0.1);
  m->pennation = ambulo__yaml_number(ambulo__yaml_get(item, "pennation"), 0.0);
  m->passive_strain =
      ambulo__yaml_number(ambulo__yaml_get(item, "passive_strain"), m->passive_strain);
  m->fast_fibers = ambulo__yaml_number(ambulo__yaml_get(item, "fast_fibers"), m->fast_fibers);
  const ambulo__yaml_node *elastic = ambulo__yaml_get(item, "elastic");
  if (elastic) {
    m->elastic = find_coordinate(r, elastic, ambulo__yaml_name(elastic));
    m->tendon_strain = ambulo__yaml_number(ambulo__yaml_require(item, "tendon_strain"), 0.05);
  }
  read_coordinates(r, ambulo__yaml_require(item, "coordinates"), m);
  m->term_count = read_exponents(r, ambulo__yaml_require(item, "exponents"), m->coordinate_count,
                                 &m->exponents);
  m->length = read_lengths(r, ambulo__yaml_require(item, "length"), m->term_count);
  read_pulls(r, ambulo__yaml_get(item, "pull"), m);
  ambulo__yaml_close(item);
}

/* ------------------------------------------------------------------ the file */

static const char *read_source(ambulo__muscle_reader *r, const ambulo__yaml_node *root) {
  const ambulo__yaml_node *list = ambulo__yaml_require(root, "source");
  const char *license = ambulo__yaml_text(ambulo__yaml_require(root, "license"));
  const char *all = ambulo__arena_print(&r->arena, "licence %s", license);
  for (int i = 0; i < ambulo__yaml_items(list); i++)
    all = ambulo__arena_print(&r->arena, "%s; %s", all,
                              ambulo__yaml_text(ambulo__yaml_item(list, i)));
  return all;
}

static ambulo_status read_document(ambulo__muscle_reader *r, const ambulo__yaml *document,
                                   ambulo_muscles_definition *d) {
  static const char *const kinds[] = {"muscles"}, *const versions[] = {"1"};
  const ambulo__yaml_node *root = ambulo__yaml_root(document);
  if (ambulo__yaml_file_kind(root, kinds, 1) < 0) return AMBULO_OK;
  (void)ambulo__yaml_choice(ambulo__yaml_require(root, "ambulo"), versions, 1, 0);
  d->name = ambulo__yaml_name(ambulo__yaml_require(root, "name"));
  d->source = read_source(r, root);
  read_mirror(r, ambulo__yaml_get(root, "mirror"));
  read_joints(r, ambulo__yaml_require(root, "joints"));
  read_ranges(r, ambulo__yaml_get(root, "coordinates"));
  ambulo_status status = read_scale(r, ambulo__yaml_require(root, "subject"));
  const ambulo__yaml_node *list = ambulo__yaml_require(root, "muscles");
  int sides = r->suffix[0] ? 2 : 1;
  ambulo__yaml_close(root);
  r->count = ambulo__yaml_items(list);
  if (r->count > AMBULO__MOST_MUSCLES / 2) {
    (void)ambulo__yaml_error(list, AMBULO_E_LIMIT, NULL, "%d muscles; expected at most %d",
                             r->count, AMBULO__MOST_MUSCLES / 2);
    r->count = 0;
  }
  size_t all = (size_t)(sides * r->count);
  r->muscles = ambulo__arena_take(&r->arena, all, sizeof *r->muscles);
  r->places = ambulo__arena_take(&r->arena, all, sizeof *r->places);
  r->fixed = ambulo__arena_take(&r->arena, all, sizeof *r->fixed);
  for (int i = 0; r->muscles && r->places && i < r->count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    read_muscle(r, item, &r->muscles[i]);
    r->places[i] = r->places[(sides - 1) * r->count + i] = ambulo__yaml_place(item);
    if (sides == 2) ambulo__muscle_mirror(r, item, i);
  }
  d->muscles = r->muscles;
  d->muscle_count = (int)all;
  return status;
}

ambulo_status ambulo__muscles_load_input(ambulo__inputs *inputs, const char *path,
                                         const ambulo__yaml_node *section,
                                         const ambulo_model *model,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics,
                                         ambulo_muscles **muscles) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__muscle_reader r = {.arena = {.allocator = own}, .model = model};
  ambulo_muscles_definition d = ambulo_muscles_definition_default();
  ambulo__yaml *document = NULL;
  char *text = NULL;
  size_t length = 0;
  ambulo_status status =
      ambulo__inputs_read(inputs, path, AMBULO__YAML_MAX_BYTES, &own, diagnostics, &text, &length);
  if (!status) status = ambulo__yaml_load_text(text, length, path, &own, diagnostics, &document);
  ambulo__free(&own, text);
  if (!status) status = read_document(&r, document, &d);
  if (!status && r.arena.failed) status = AMBULO_E_MEMORY;
  if (!status) status = ambulo__yaml_finish(document);
  if (!status) ambulo__muscle_strength(&r, section);
  if (!status) ambulo__muscle_numbers(&r, section);
  if (!status && r.arena.failed) status = AMBULO_E_MEMORY;
  if (!status) status = ambulo__muscles_build(model, &d, r.places, &own, diagnostics, muscles);
  if (!status) memcpy((*muscles)->fixed, r.fixed, (size_t)d.muscle_count * sizeof *r.fixed);
  ambulo__yaml_free(document);
  ambulo__arena_free(&r.arena);
  return status;
}

ambulo_status ambulo_muscles_load(const char *path, const ambulo_model *model,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_muscles **muscles) {
  if (!path || !model || !muscles) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status =
      ambulo__muscles_load_input(NULL, path, NULL, model, allocator, diagnostics, muscles);
  return ambulo__conclude(diagnostics, errors, status, path);
}
