/* definitions/problem_file.c - problem file -> definition -> problem.
 *
 * Order: overrides are applied to the document; the model is loaded (names in the other
 * sections refer to it); sections are read; only a document without any fault becomes a
 * problem. What ambulo_problem_create() then objects to gets the position of the key
 * its message begins with.
 *
 * Reading order: problem_reader.h, problem_file.c, problem_reader.c, problem_grid.c,
 * problem_gait.c, problem_contacts.c, problem_constraints.c, problem_objective.c, problem_free.h;
 * model_reader.h, model_file.c, model_links.c; solution_load.c.
 */
#include "ambulo/tools/load.h"
#include "ambulo/tools/report.h"
#include "base/sized.h"
#include "definitions/problem_free.h"
#include "definitions/problem_load.h"
#include "formats/read_file.h"
#include "formats/yaml_node.h"
#include "problem/definition.h"
#include "problem/nlp.h"

#include <stdlib.h>
#include <string.h>

enum { FORMAT_VERSION = 1 };

/* ------------------------------------------------------------------ overrides */

/* "solver.algorithm=slsqp" must also work in a file without a section `solver`: adds it empty */
static ambulo_status add_section(ambulo__yaml *document, const char *path) {
  static const char *const sections[] = {"subject",         "time",       "trajectory", "gait",
                                         "constraints",     "ends",       "solver",     "ground",
                                         "ground_reaction", "written_for"};
  for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) {
    size_t length = strlen(sections[i]);
    if (strncmp(path, sections[i], length) != 0 || path[length] != '.') continue;
    if (ambulo__yaml_get(ambulo__yaml_root(document), sections[i])) return AMBULO_OK;
    return ambulo__yaml_set(document, sections[i], "{}");
  }
  return AMBULO_OK;
}

static ambulo_status apply_override(ambulo__problem_reader *reader, ambulo__yaml *document,
                                    const char *override) {
  static const ambulo__place command_line = {NULL, 0, 0, NULL};
  const char *equals = override ? strchr(override, '=') : NULL;
  if (!equals || equals == override) {
    return ambulo__error(reader->diagnostics, AMBULO_E_ARGUMENT, command_line, NULL,
                         "override '%s'; expected path=value, such as time.intervals=36",
                         override ? override : "");
  }
  size_t length = (size_t)(equals - override);
  char *path = ambulo__reader_alloc(reader, length + 1, 1);
  if (!path) return AMBULO_E_MEMORY;
  memcpy(path, override, length);
  if (strncmp(path, "model.", 6) == 0) {
    reader->model_override[reader->model_overrides++] = override;
    return AMBULO_OK;
  }
  ambulo_status status = add_section(document, path);
  return status ? status : ambulo__yaml_set(document, path, equals + 1);
}

static ambulo_status apply_overrides(ambulo__problem_reader *reader, ambulo__yaml *document,
                                     const char *const *overrides, int count) {
  ambulo_status status = AMBULO_OK;
  reader->model_override =
      ambulo__reader_alloc(reader, (size_t)count, sizeof *reader->model_override);
  if (!reader->model_override) return AMBULO_E_MEMORY;
  for (int i = 0; i < count; i++) {
    ambulo_status one = apply_override(reader, document, overrides[i]);
    if (!status) status = one;
  }
  return status;
}

/* ------------------------------------------------------------------- sections */

static void read_header(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  static const char *const units[] = {"degrees", "radians"};
  const ambulo__yaml_node *version = ambulo__yaml_require(root, "ambulo");
  int number = ambulo__yaml_integer(version, 0, 1000000, FORMAT_VERSION);
  if (number != FORMAT_VERSION) {
    (void)ambulo__yaml_error(version, AMBULO_E_SCHEMA, NULL,
                             "format version %d is not supported; expected %d", number,
                             FORMAT_VERSION);
  }
  const ambulo__yaml_node *name = ambulo__yaml_get(root, "name");
  reader->definition.name = name ? ambulo__yaml_name(name) : "problem";
  const ambulo__yaml_node *angles = ambulo__yaml_get(root, "angles");
  if (!angles) return;
  int radians = ambulo__yaml_choice(angles, units, 2, 1);
  reader->radians = radians ? 1.0 : 3.14159265358979323846 / 180.0;
}

static void read_model(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  ambulo_subject subject = ambulo__subject_of(ambulo__reader_section(root, "subject"));
  const ambulo__yaml_node *node = ambulo__yaml_require(root, "model");
  const char *name = ambulo__yaml_file_name(node);
  if (!name[0]) return;
  const char *path = ambulo__reader_path(reader, node, name);
  if (!path) return;
  ambulo_status status = ambulo__model_load_input(
      &reader->inputs, path, reader->model_override, reader->model_overrides, &subject,
      &reader->allocator, reader->diagnostics, &reader->model);
  reader->definition.model = reader->model;
  if (!status) return;
  reader->failure = status;
  (void)ambulo__yaml_error(node, status, NULL, "the model '%s' could not be loaded", path);
}

/* the body that the numbers of the file are for; what becomes of them for the subject is
 * ambulo__definition_resize's */
static void read_written_for(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  ambulo__problem_keys *keys = &reader->keys;
  keys->longer = keys->heavier = 1.0;
  const ambulo__yaml_node *section = ambulo__reader_section(root, "written_for");
  if (!section) return;
  double mass = ambulo__yaml_number_in(ambulo__yaml_require(section, "mass"), 1.0, 1000.0, 0.0);
  double stature = ambulo__yaml_number_in(ambulo__yaml_require(section, "stature"), 0.3, 3.0, 0.0);
  ambulo__yaml_close(section);
  if (!reader->model || !(mass > 0.0) || !(stature > 0.0)) return;
  double subject_mass = reader->model->units.mass;
  double subject_stature = ambulo_model_stature(reader->model);
  if (!(subject_stature > 0.0) || subject_mass == 1.0 || !(subject_mass > 0.0)) {
    (void)ambulo__yaml_error(section, AMBULO_E_PROBLEM, NULL,
                             "'written_for' with a model that has its own size; expected one whose "
                             "units are those of a subject");
    return;
  }
  keys->written_for = 1;
  keys->longer = subject_stature / stature;
  keys->heavier = subject_mass / mass;
}

static void scale_to_subject(ambulo__problem_reader *reader) {
  const ambulo__problem_keys *keys = &reader->keys;
  ambulo_problem_definition *d = &reader->definition;
  if (keys->written_for) ambulo__definition_resize(d, d->term_count, keys->longer, keys->heavier);
}

static void read_sections(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  static const char *const kinds[] = {"problem"};
  if (ambulo__yaml_file_kind(root, kinds, 1) < 0) return;
  read_header(reader, root);
  read_model(reader, root);
  read_written_for(reader, root);
  ambulo__read_solver(reader, ambulo__reader_section(root, "solver"));
  ambulo__read_constraints(reader, ambulo__reader_section(root, "constraints"));
  static const char *const others[] = {"trajectory",      "contacts", "ends",    "objective",
                                       "ground",          "load",     "devices", "muscles",
                                       "ground_reaction", "obstacles"};
  for (int i = 0; i < 10; i++) ambulo__yaml_expect(root, others[i]);
  reader->gait = ambulo__reader_section(root, "gait");
  ambulo__read_time(reader, root);
  if (reader->model) {
    ambulo__read_ground(reader, root);
    ambulo__read_bodies(reader, root);
    ambulo__read_problem_muscles(
        reader, ambulo__yaml_get(root, "muscles")); /* on the body as it is by now */
    ambulo__read_schedule(reader, root);
    ambulo__read_tubes(reader, root);
    ambulo__read_trajectory(reader, root);
    ambulo__read_ends(reader, ambulo__reader_section(root, "ends"));
    ambulo__read_devices(reader, ambulo__yaml_get(root, "devices"));
    ambulo__read_objective(reader, ambulo__yaml_require(root, "objective"));
    scale_to_subject(reader);
  }
  ambulo__yaml_expect(root, "free"); /* once there is a problem */
  ambulo__yaml_close(root);
}

/* ------------------------------------------- positions for what create() says */

/* Reads "[12]" at *at and steps over it; -1 when something else stands there. */
static int read_index(const char **at) {
  size_t digits = **at == '[' ? strspn(*at + 1, "0123456789") : 0;
  if (digits == 0 || digits > 6 || (*at)[1 + digits] != ']') return -1;
  int index = 0;
  for (size_t i = 0; i < digits; i++) index = 10 * index + ((*at)[1 + i] - '0');
  *at += digits + 2;
  return index;
}

/* The value of the key at *at, which is stepped over; NULL when there is no such key. */
static const ambulo__yaml_node *read_key(const ambulo__yaml_node *mapping, const char **at) {
  char key[32];
  size_t length = strspn(*at, "abcdefghijklmnopqrstuvwxyz_");
  if (length == 0 || length >= sizeof key) return NULL;
  if (!ambulo__yaml_is(mapping, AMBULO__YAML_MAPPING)) return NULL;
  memcpy(key, *at, length);
  key[length] = '\0';
  *at += length;
  return ambulo__yaml_get(mapping, key);
}

/* the node that a message such as "time.duration is ..." or "contacts[2]: ..." begins with */
static const ambulo__yaml_node *node_of_message(const ambulo__yaml_node *root,
                                                const char *message) {
  const ambulo__yaml_node *node = root;
  const char *at = message;
  for (;;) {
    const ambulo__yaml_node *child = read_key(node, &at);
    if (!child) return node;
    node = child;
    int index = read_index(&at);
    const ambulo__yaml_node *item = ambulo__yaml_item(node, index);
    if (item) node = item;
    if (*at != '.') return node;
    at++;
  }
}

static void pass_on(const ambulo__problem_reader *reader, const ambulo__yaml_node *root,
                    const ambulo_diagnostic *message) {
  const ambulo__yaml_node *node = node_of_message(root, message->message);
  if (reader->gait && strncmp(message->message, "contacts", 8) == 0) node = reader->gait;
  ambulo__place place = ambulo__yaml_place(node);
  if (message->severity == AMBULO_ERROR) {
    (void)ambulo__error(reader->diagnostics, message->status, place, message->hint, "%s",
                        message->message);
  } else if (message->severity == AMBULO_WARNING) {
    ambulo__warning(reader->diagnostics, place, message->hint, "%s", message->message);
  } else {
    ambulo__note(reader->diagnostics, place, "%s", message->message);
  }
}

static ambulo_status create(ambulo__problem_reader *reader, const ambulo__yaml_node *root,
                            ambulo_problem **problem) {
  ambulo_diagnostics *messages = NULL;
  if (reader->diagnostics) {
    messages = ambulo_diagnostics_create(&reader->allocator);
    if (!messages) return AMBULO_E_MEMORY;
  }
  ambulo_problem *created = NULL;
  ambulo_status status =
      ambulo_problem_create(&reader->definition, &reader->allocator, messages, &created);
  for (size_t i = 0; i < ambulo_diagnostics_count(messages); i++) {
    pass_on(reader, root, ambulo_diagnostics_get(messages, i));
  }
  ambulo_diagnostics_free(messages);
  if (status) return status;
  created->owned_model = reader->model;
  reader->model = NULL;
  created->owned_muscles = reader->muscles;
  reader->muscles = NULL;
  created->file_options = reader->options;
  created->keys = reader->keys;
  created->keys.file = 1;
  created->keys.radians = reader->radians;
  created->keys.terms = reader->definition.term_count;
  *problem = created;
  return AMBULO_OK;
}

/* ----------------------------------------------------------------- entry points */

static ambulo_status read_document(ambulo__problem_reader *reader, ambulo__yaml *document,
                                   ambulo_problem **problem) {
  ambulo_status status =
      apply_overrides(reader, document, reader->override, reader->override_count);
  if (status) return status;
  const ambulo__yaml_node *root = ambulo__yaml_root(document);
  read_sections(reader, root);
  if (reader->failure) return reader->failure;
  status = ambulo__yaml_finish(document);
  ambulo_problem *created = NULL;
  if (!status) status = create(reader, root, &created);
  if (!status) status = ambulo__read_free(reader, root, created);
  if (!status) {
    created->inputs = ambulo__strdup(&reader->allocator, ambulo__text_data(&reader->inputs.read));
    if (!created->inputs) status = AMBULO_E_MEMORY;
  }
  if (status) {
    ambulo_problem_free(created);
    return status;
  }
  *problem = created;
  return AMBULO_OK;
}

static ambulo__problem_reader reader_make(const ambulo_allocator *allocator,
                                          ambulo_diagnostics *diagnostics) {
  ambulo__problem_reader reader = {.allocator = ambulo__allocator_or_default(allocator),
                                   .diagnostics = diagnostics,
                                   .directory = "",
                                   .definition = ambulo_problem_definition_default(),
                                   .options = ambulo_options_default()};
  const char *expected = getenv("AMBULO_INPUTS");
  ambulo__text_init(&reader.inputs.read, &reader.allocator);
  reader.inputs.expected = expected && expected[0] ? expected : NULL;
  return reader;
}

/* the part of `path` up to and including its last '/' */
static const char *directory_of(ambulo__problem_reader *reader, const char *path) {
  const char *slash = strrchr(path, '/');
  if (!slash) return "";
  size_t length = (size_t)(slash - path) + 1;
  char *directory = ambulo__reader_alloc(reader, length + 1, 1);
  if (directory) memcpy(directory, path, length);
  return directory;
}

/* from the reader's text to a problem; the reader is used up */
static ambulo_status read_text(ambulo__problem_reader *reader, ambulo_problem **problem) {
  ambulo__yaml *document = NULL;
  ambulo_status status = ambulo__yaml_load_text(reader->text, reader->length, reader->name,
                                                &reader->allocator, reader->diagnostics, &document);
  reader->document = document;
  if (!status) status = read_document(reader, document, problem);
  ambulo__yaml_free(document);
  ambulo__reader_clear(reader);
  return status;
}

ambulo_status ambulo__problem_load_known(const char *path, const char *const *overrides,
                                         int override_count, ambulo__text_buffer *known,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics,
                                         ambulo_problem **problem) {
  if (!path || !problem || override_count < 0 || (override_count > 0 && !overrides)) {
    return AMBULO_E_ARGUMENT;
  }
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__problem_reader reader = reader_make(allocator, diagnostics);
  char *text = NULL;
  reader.inputs.known = known;
  ambulo_status status = ambulo__inputs_read(&reader.inputs, path, AMBULO__YAML_MAX_BYTES,
                                             &reader.allocator, diagnostics, &text, &reader.length);
  reader.text = text;
  reader.name = path;
  reader.override = overrides;
  reader.override_count = override_count;
  if (!status) reader.directory = directory_of(&reader, path);
  if (!status) status = reader.directory ? read_text(&reader, problem) : AMBULO_E_MEMORY;
  ambulo__reader_clear(&reader);
  ambulo__free(&reader.allocator, text);
  return ambulo__conclude(diagnostics, errors, status, path);
}

ambulo_status ambulo_problem_load(const char *path, const char *const *overrides,
                                  int override_count, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_problem **problem) {
  return ambulo__problem_load_known(path, overrides, override_count, NULL, allocator, diagnostics,
                                    problem);
}

const char *ambulo_problem_inputs(const ambulo_problem *problem) {
  const ambulo_problem *root = ambulo__problem_root(problem);
  return root->inputs ? root->inputs : "";
}

ambulo_status ambulo_problem_load_text(const ambulo_problem_text *text,
                                       const ambulo_allocator *allocator,
                                       ambulo_diagnostics *diagnostics, ambulo_problem **problem) {
  ambulo_problem_text own;
  if (!AMBULO__OWN(ambulo_problem_text, &own, text)) return AMBULO_E_ARGUMENT;
  if (!own.text || !problem || own.override_count < 0 || (own.override_count > 0 && !own.overrides))
    return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__problem_reader reader = reader_make(allocator, diagnostics);
  if (own.directory) reader.directory = own.directory;
  reader.text = own.text;
  reader.length = own.length;
  reader.name = own.name ? own.name : "problem";
  reader.override = own.overrides;
  reader.override_count = own.override_count;
  return ambulo__conclude(diagnostics, errors, read_text(&reader, problem), own.name);
}
/* -------------------------------------------------------------- model or problem? */

ambulo_status ambulo_file_kind_of(const char *path, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_file_kind *kind) {
  if (!path || !kind) return AMBULO_E_ARGUMENT;
  ambulo__yaml *document = NULL;
  ambulo_status status = ambulo__yaml_load(path, allocator, diagnostics, &document);
  if (status) return status;
  static const char *const kinds[] = {"model", "problem"};
  int choice = ambulo__yaml_file_kind(ambulo__yaml_root(document), kinds, 2);
  status = ambulo__yaml_finish(document);
  if (!status) *kind = choice == 0 ? AMBULO_FILE_MODEL : AMBULO_FILE_PROBLEM;
  ambulo__yaml_free(document);
  return status;
}
