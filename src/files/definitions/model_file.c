/* definitions/model_file.c - a model file, from text to model (docs/model-format.md). */
#include "ambulo/tools/load.h"
#include "base/sized.h"

#include <math.h>
#include <string.h>

#include "definitions/model_reader.h"

/* ------------------------------------------------------------------- memory */

static int allocate(ambulo__reader *r) {
  const ambulo_allocator *a = &r->allocator;
  const ambulo_model_definition *d = &r->definition;
  const int counts[] = {d->link_count, d->link_count,  d->point_count,
                        d->foot_count, d->patch_count, d->capsule_count};
  int complete = 1;
  r->links = ambulo__alloc(a, (size_t)d->link_count, sizeof *r->links);
  r->coordinates = ambulo__alloc(a, (size_t)d->link_count, sizeof *r->coordinates);
  r->points = ambulo__alloc(a, (size_t)d->point_count, sizeof *r->points);
  r->feet = ambulo__alloc(a, (size_t)d->foot_count, sizeof *r->feet);
  r->patches = ambulo__alloc(a, (size_t)d->patch_count, sizeof *r->patches);
  r->capsules = ambulo__alloc(a, (size_t)d->capsule_count, sizeof *r->capsules);
  r->origins = ambulo__origins_create(a, d->link_count);
  for (int k = 0; k < AMBULO__MODEL_LISTS; k++) {
    r->names[k] = ambulo__alloc(a, (size_t)counts[k], sizeof *r->names[k]);
    r->place_of[k] = ambulo__alloc(a, (size_t)counts[k], sizeof *r->place_of[k]);
    complete &= r->names[k] && r->place_of[k];
  }
  r->places.links = r->place_of[AMBULO__LIST_LINKS];
  r->places.coordinates = r->place_of[AMBULO__LIST_COORDINATES];
  r->places.points = r->place_of[AMBULO__LIST_POINTS];
  r->places.feet = r->place_of[AMBULO__LIST_FEET];
  r->places.patches = r->place_of[AMBULO__LIST_PATCHES];
  r->places.capsules = r->place_of[AMBULO__LIST_CAPSULES];
  return complete && r->origins && r->links && r->coordinates && r->points && r->feet &&
         r->patches && r->capsules;
}

static void release(ambulo__reader *r) {
  void *blocks[] = {r->links,    r->coordinates, r->points, r->feet,       r->patches,
                    r->capsules, r->origins,     r->rows,   r->row_places, r->row_names};
  for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++)
    ambulo__free(&r->allocator, blocks[i]);
  ambulo__arena_free(&r->arena);
  for (int k = 0; k < AMBULO__MODEL_LISTS; k++) {
    ambulo__free(&r->allocator, r->names[k]);
    ambulo__free(&r->allocator, r->place_of[k]);
  }
}

/* ------------------------------------------------------------------ sections */

/* A free text, or a list of them. */
static void read_source(const ambulo__yaml_node *node) {
  if (!ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE)) {
    (void)ambulo__yaml_text(node);
    return;
  }
  for (int i = 0; i < ambulo__yaml_items(node); i++) {
    (void)ambulo__yaml_text(ambulo__yaml_item(node, i));
  }
}

static void read_header(ambulo__reader *r, const ambulo__yaml_node *root) {
  static const char *const versions[] = {"1"};
  (void)ambulo__yaml_choice(ambulo__yaml_require(root, "ambulo"), versions, 1, 0);
  const char *name = ambulo__yaml_name(ambulo__yaml_require(root, "name"));
  if (name[0]) r->definition.name = name;
  read_source(ambulo__yaml_get(root, "source"));
  (void)ambulo__yaml_numbers(ambulo__yaml_get(root, "gravity"), 3, r->definition.gravity);
  (void)ambulo__yaml_numbers(ambulo__yaml_get(root, "forward"), 3, r->definition.forward);
}

static void read_document(ambulo__reader *r, const ambulo_subject *asked) {
  static const char *const kinds[] = {"model"};
  const ambulo__yaml_node *root = ambulo__yaml_root(r->document);
  ambulo_model_definition *d = &r->definition;
  if (ambulo__yaml_file_kind(root, kinds, 1) < 0) return;
  r->places.model = (ambulo__place){ambulo__yaml_file(r->document), 1, 1, NULL};
  read_header(r, root);
  ambulo__read_subject(r, root);
  ambulo__read_units(r, root, asked);
  const ambulo__yaml_node *links = ambulo__yaml_require(root, "links");
  const ambulo__yaml_node *points = ambulo__yaml_get(root, "points");
  const ambulo__yaml_node *feet = ambulo__yaml_get(root, "feet");
  const ambulo__yaml_node *patches = ambulo__yaml_get(root, "patches");
  const ambulo__yaml_node *capsules = ambulo__yaml_get(root, "capsules");
  ambulo__yaml_close(root);
  int good = ambulo__read_count(links, "links", AMBULO__MAX_LINKS, &d->link_count);
  good &= ambulo__read_count(points, "points", AMBULO__MAX_POINTS, &d->point_count);
  good &= ambulo__read_count(feet, "feet", AMBULO__MAX_FEET, &d->foot_count);
  good &= ambulo__read_count(patches, "patches", AMBULO__MAX_PATCHES, &d->patch_count);
  good &= ambulo__read_count(capsules, "capsules", AMBULO__MAX_CAPSULES, &d->capsule_count);
  if (!good) return;
  if (!allocate(r)) {
    r->status = AMBULO_E_MEMORY;
    return;
  }
  ambulo__read_links(r, links);
  ambulo__read_points(r, points);
  ambulo__read_feet(r, feet);
  ambulo__read_patches(r, patches);
  ambulo__read_capsules(r, capsules);
  d->links = r->links;
  d->coordinates = r->coordinates;
  d->points = r->points;
  d->feet = r->feet;
  d->patches = r->patches;
  d->capsules = r->capsules;
  ambulo__expand_origins(r);
}

/* ------------------------------------------------------------------- loading */

/* *own: what the caller asks for, of whatever age */
static ambulo_status take_subject(const ambulo_subject *given, ambulo_diagnostics *diagnostics,
                                  ambulo_subject *own) {
  if (!AMBULO__OWN(ambulo_subject, own, given)) return AMBULO_E_ARGUMENT;
  const ambulo_subject *subject = own;
  int good = subject->sex >= AMBULO_SEX_NOT_SET && subject->sex <= AMBULO_MALE;
  good &= isnan(subject->mass) || (subject->mass >= 0.5 && subject->mass <= 1000);
  good &= isnan(subject->stature) || (subject->stature >= 0.2 && subject->stature <= 3);
  if (good) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                       "the subject is out of range (got %s kg, %s m); expected a mass of 0.5 to "
                       "1000 kg and a stature of 0.2 to 3 m",
                       ambulo__number_text(subject->mass).text,
                       ambulo__number_text(subject->stature).text);
}

static ambulo_status build(ambulo__yaml *document, const ambulo_subject *subject,
                           const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                           ambulo_model **model) {
  ambulo__reader reader = {.allocator = ambulo__allocator_or_default(allocator),
                           .diagnostics = diagnostics,
                           .document = document,
                           .arena = {.allocator = ambulo__allocator_or_default(allocator)},
                           .definition = ambulo_model_definition_default()};
  reader.subject = *subject;
  read_document(&reader, subject);
  ambulo_status status = ambulo__yaml_finish(document);
  if (status == AMBULO_OK) status = reader.status;
  if (status == AMBULO_OK) {
    status = ambulo__model_build(&reader.definition, &reader.places, &reader.allocator, diagnostics,
                                 model);
  }
  if (status == AMBULO_OK) {
    ambulo__model_units units = {reader.angle, reader.length, reader.moment, reader.force,
                                 reader.mass};
    (*model)->units = units;
    ambulo__name_written(&reader, *model);
  }
  release(&reader);
  return status;
}

/* Where a model file comes from, and what is replaced before it is read. */
typedef struct source {
  const char *path; /* NULL: the text */
  const char *text, *name;
  size_t length;
  const char *const *override; /* [overrides] "path=value" */
  int overrides;
  ambulo__inputs *inputs; /* of which the file is one; NULL */
} source;

/* "path=value" put into the document */
static ambulo_status apply_override(ambulo__yaml *document, const char *override,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics) {
  static const char prefix[] = "model.";
  const char *equals = override ? strchr(override, '=') : NULL;
  if (!equals || equals == override)
    return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "override '%s'; expected path=value, such as links[shank_r].body.mass=4",
                         override ? override : "");
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  char *path = ambulo__alloc(&own, (size_t)(equals - override) + 1, 1);
  if (!path)
    return ambulo__error(diagnostics, AMBULO_E_MEMORY, ambulo__nowhere, NULL, "out of memory");
  memcpy(path, override, (size_t)(equals - override));
  int below = strncmp(path, prefix, sizeof prefix - 1) == 0;
  ambulo_status status = ambulo__yaml_set_below(
      document, below ? prefix : "", below ? path + sizeof prefix - 1 : path, equals + 1);
  ambulo__free(&own, path);
  return status;
}

static ambulo_status load_file(const source *from, const ambulo_allocator *allocator,
                               ambulo_diagnostics *diagnostics, ambulo__yaml **document) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  char *text = NULL;
  size_t length = 0;
  ambulo_status status = ambulo__inputs_read(from->inputs, from->path, AMBULO__YAML_MAX_BYTES, &own,
                                             diagnostics, &text, &length);
  if (!status)
    status = ambulo__yaml_load_text(text, length, from->path, &own, diagnostics, document);
  ambulo__free(&own, text);
  return status;
}

static ambulo_status load(const source *from, const ambulo_subject *subject,
                          const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                          ambulo_model **model) {
  ambulo__yaml *document = NULL;
  ambulo_subject own;
  ambulo_status status = take_subject(subject, diagnostics, &own);
  if (!status)
    status = from->path ? load_file(from, allocator, diagnostics, &document)
                        : ambulo__yaml_load_text(from->text, from->length, from->name, allocator,
                                                 diagnostics, &document);
  for (int i = 0; i < from->overrides && !status; i++)
    status = apply_override(document, from->override[i], allocator, diagnostics);
  if (!status) status = build(document, &own, allocator, diagnostics, model);
  ambulo__yaml_free(document);
  return status;
}

ambulo_status ambulo_model_load(const char *path, const ambulo_subject *subject,
                                const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                ambulo_model **model) {
  const source from = {.path = path};
  if (!path || !model) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = load(&from, subject, allocator, diagnostics, model);
  return ambulo__conclude(diagnostics, errors, status, path);
}

ambulo_status ambulo__model_load_input(ambulo__inputs *inputs, const char *path,
                                       const char *const *overrides, int override_count,
                                       const ambulo_subject *subject,
                                       const ambulo_allocator *allocator,
                                       ambulo_diagnostics *diagnostics, ambulo_model **model) {
  const source from = {
      .path = path, .override = overrides, .overrides = override_count, .inputs = inputs};
  return load(&from, subject, allocator, diagnostics, model);
}

ambulo_status ambulo_model_load_with(const char *path, const char *const *overrides,
                                     int override_count, const ambulo_subject *subject,
                                     const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics, ambulo_model **model) {
  if (!path || !model || override_count < 0 || (override_count > 0 && !overrides))
    return AMBULO_E_ARGUMENT;
  return ambulo__model_load_input(NULL, path, overrides, override_count, subject, allocator,
                                  diagnostics, model);
}

ambulo_status ambulo_model_load_text(const char *text, size_t length, const char *name,
                                     const ambulo_subject *subject,
                                     const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics, ambulo_model **model) {
  const source from = {.text = text, .length = length, .name = name};
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  if (!text || !model) return AMBULO_E_ARGUMENT;
  ambulo_status status = load(&from, subject, allocator, diagnostics, model);
  return ambulo__conclude(diagnostics, errors, status, name);
}
