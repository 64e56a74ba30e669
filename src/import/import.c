/* import/import.c - ambulo_import_model: from a file of another program to a model file.
 *
 * XML tree -> reader of the format -> body tree -> feet, mirror images -> text, which is read back
 * as a model before anything is written: what an import gives loads.
 */
#include "ambulo/tools/import.h"
#include "ambulo/tools/load.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/arithmetic.h"
#include "base/numtext.h"
#include "base/sized.h"
#include "formats/atomic_file.h"
#include "import/body_tree.h"
#include "import/meshes.h"

static int options_are_sane(const ambulo_import_options *o) {
  return o->pose_count >= 0 && o->foot_count >= 0 && o->heel_count >= 0 && o->toe_count >= 0 &&
         (o->pose || !o->pose_count) && (o->feet || !o->foot_count) &&
         (o->heels || !o->heel_count) && (o->toes || !o->toe_count) &&
         o->root >= AMBULO_ROOT_AS_IS && o->root <= AMBULO_ROOT_FIXED;
}

/* ------------------------------------------------------------------------ reading */

static void read_format(ambulo__tree *tree, ambulo__xml_node *root, const char *path) {
  static const struct {
    const char *element;
    int which;
  } formats[] = {{"robot", 0}, {"OpenSimDocument", 1}, {"mujoco", 2}};
  int which = -1;
  for (int i = 0; i < 3; i++)
    if (ambulo__xml_is(root, formats[i].element)) which = formats[i].which;
  if (which == 0) ambulo__read_urdf(tree, root);
  if (which == 1) ambulo__read_osim(tree, root);
  if (which == 2) ambulo__read_mjcf(tree, root, path);
  if (which < 0)
    ambulo__xml_error(tree->xml, root, AMBULO_E_SCHEMA, NULL,
                      "this is not a model that can be imported (got <%.40s>); expected <robot> "
                      "(URDF), <OpenSimDocument> or <mujoco>",
                      root->name);
}

static void expect_motion(const ambulo__tree *tree, const ambulo__xml_node *root) {
  int joints = 0;
  double mass = 0.0;
  for (int i = 0; i < tree->link_count; i++) {
    joints += tree->links[i].type != AMBULO_FIXED && !tree->links[i].follows;
    mass += tree->links[i].body.mass;
  }
  if (tree->xml->status || tree->arena->failed) return;
  if (joints == 0)
    ambulo__xml_error(tree->xml, root, AMBULO_E_MODEL, NULL,
                      "the model cannot move (got %d links, none with a coordinate); expected at "
                      "least one joint",
                      tree->link_count);
  else if (!(mass > 0.0))
    ambulo__xml_error(tree->xml, root, AMBULO_E_MODEL, NULL,
                      "the model has no mass; expected at least one body");
}

/* a name as model files have them, of whatever the source has */
static const char *model_name(ambulo__arena *arena, const char *name) {
  char *copy = ambulo__arena_copy(arena, name, strlen(name) > 64 ? 64 : strlen(name));
  for (char *c = copy; c && *c; c++) {
    int good = (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9') ||
               *c == '-' || *c == '.';
    if (!good) *c = '_';
  }
  return copy && copy[0] ? copy : "model";
}

static int is_well(const ambulo__tree *tree) {
  return !tree->xml->status && !tree->arena->failed;
}

static void read_links(ambulo__tree *tree, const char *path) {
  ambulo__xml_node *root = ambulo__xml_load(tree->xml, path);
  if (!root) return;
  tree->path = path;
  read_format(tree, root, path);
  if (is_well(tree)) ambulo__tree_resolve(tree);
  expect_motion(tree, root);
  if (is_well(tree)) ambulo__tree_check(tree);
  tree->trunk = is_well(tree) ? ambulo__tree_trunk(tree) : -1;
}

static ambulo_status read_tree(ambulo__tree *tree, const char *path, ambulo__text_buffer *text) {
  ambulo__xml *xml = tree->xml;
  read_links(tree, path);
  if (is_well(tree)) ambulo__find_feet(tree);
  if (is_well(tree) && tree->options->symmetrize) ambulo__symmetrize(tree);
  if (is_well(tree)) ambulo__find_start(tree);
  if (is_well(tree)) ambulo__find_mirrors(tree);
  if (is_well(tree)) ambulo__find_trunk_points(tree);
  if (is_well(tree)) ambulo__tree_center(tree);
  if (xml->status) return xml->status;
  if (tree->options->name) tree->name = tree->options->name;
  tree->name = model_name(tree->arena, tree->name);
  if (!tree->arena->failed) ambulo__tree_print(tree, ambulo__xml_last_name(path), text);
  if (tree->arena->failed || ambulo__text_status(text))
    return ambulo__error(xml->diagnostics, AMBULO_E_MEMORY, ambulo__nowhere, NULL, "out of memory");
  return AMBULO_OK;
}

/* ------------------------------------------------------------------------ forward */

/* "x", "-y" or three numbers; 0 for anything else */
static int parse_forward(const char *text, double forward[3]) {
  int sign = text[0] == '-' ? -1 : 1;
  const char *letter = text + (text[0] == '-' || text[0] == '+');
  if (letter[0] >= 'x' && letter[0] <= 'z' && !letter[1]) {
    for (int i = 0; i < 3; i++) forward[i] = letter[0] - 'x' == i ? sign : 0.0;
    return 1;
  }
  for (int i = 0; i < 3; i++) {
    size_t digits = strcspn(text, ",");
    if (!ambulo__parse_double(text, digits, &forward[i]) || (text[digits] == ',') != (i < 2))
      return 0;
    text += digits + 1;
  }
  return ambulo__normalize(forward) > 1e-9;
}

/* Coordinates of a free body are about forward, so it is known before the links are read in
 * earnest: they are read once in silence. */
static ambulo_status settle_forward(const char *path, const ambulo_import_options *options,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, double forward[3]) {
  ambulo__arena arena = {.allocator = ambulo__allocator_or_default(allocator)};
  ambulo__xml xml = {.arena = &arena};
  ambulo__tree tree = {.arena = &arena,
                       .xml = &xml,
                       .options = options,
                       .name = "model",
                       .format = "",
                       .gravity = {0, -9.81, 0},
                       .forward = {1, 0, 0}};
  const char *given = options->forward;
  double across[3];
  read_links(&tree, path);
  if (is_well(&tree) && !given && ambulo__find_forward(&tree))
    memcpy(forward, tree.forward, sizeof tree.forward);
  int good = !given || parse_forward(given, forward);
  if (good && given && is_well(&tree)) {
    ambulo__cross(tree.gravity, forward, across);
    good = ambulo__normalize(across) > 1e-3;
  }
  ambulo__arena_free(&arena);
  if (good) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                       "--forward '%.60s' is no direction along the ground; expected x, -x, y, -y, "
                       "z, -z or X,Y,Z",
                       given);
}

/* the text as a model, with its own messages */
static ambulo_status read_back(const ambulo__text_buffer *text, const ambulo_allocator *allocator,
                               ambulo_diagnostics *diagnostics) {
  ambulo_model *model = NULL;
  ambulo_status status =
      ambulo_model_load_text(ambulo__text_data(text), text->length, "the imported model", NULL,
                             allocator, diagnostics, &model);
  ambulo_model_free(model);
  return status;
}

/* `meshes`: NULL: not asked for */
static ambulo_status import_text(const char *path, const ambulo_import_options *options,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo__text_buffer *text, ambulo__text_buffer *meshes) {
  ambulo__arena arena = {.allocator = ambulo__allocator_or_default(allocator)};
  ambulo__xml xml = {.arena = &arena, .diagnostics = diagnostics};
  ambulo__tree tree = {.arena = &arena,
                       .xml = &xml,
                       .options = options,
                       .name = "model",
                       .format = "",
                       .gravity = {0, -9.81, 0},
                       .forward = {1, 0, 0}};
  ambulo_status status = settle_forward(path, options, allocator, diagnostics, tree.forward);
  if (!status) status = read_tree(&tree, path, text);
  if (!status) status = read_back(text, allocator, diagnostics);
  if (!status && meshes) status = ambulo__tree_meshes(&tree, meshes);
  ambulo__arena_free(&arena);
  return status;
}

/* The meshes first, then the model that they stand beside: without it they are removed again. Those
 * of an earlier model go with it. */
static ambulo_status write_both(const char *output, const char *beside, const char *source,
                                int overwrite, const ambulo__text_buffer *text,
                                const ambulo__text_buffer *meshes,
                                ambulo_diagnostics *diagnostics) {
  const ambulo_allocator *a = &text->allocator;
  ambulo_status status = AMBULO_OK;
  int was_there = beside && access(beside, F_OK) == 0, shown = meshes->length > 0;
  if (shown) status = ambulo__output_check(beside, &source, 1, overwrite, diagnostics);
  if (shown && !status)
    status =
        ambulo__write_file(beside, ambulo__text_data(meshes), meshes->length, 1, a, diagnostics);
  if (!status)
    status = ambulo__write_file(output, ambulo__text_data(text), text->length, 1, a, diagnostics);
  int stale = !shown && was_there && overwrite &&
              ambulo__file_says(beside, "\"" AMBULO__MESHES_SCHEMA "\"", 64);
  if (status ? shown && !was_there : stale) (void)unlink(beside);
  return status;
}

ambulo_status ambulo_import_model(const char *path, const char *output,
                                  const ambulo_import_options *options,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, char **text) {
  ambulo_import_options own;
  if (!AMBULO__OWN(ambulo_import_options, &own, options)) return AMBULO_E_ARGUMENT;
  options = &own;
  if (!path || !path[0] || (!output && !text) || (output && !output[0]) ||
      !options_are_sane(options))
    return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__text_buffer buffer, meshes;
  ambulo__text_init(&buffer, allocator);
  ambulo__text_init(&meshes, allocator);
  char *beside = NULL;
  ambulo_status status =
      output ? ambulo__meshes_path(&buffer.allocator, output, &beside) : AMBULO_OK;
  if (!status && output)
    status = ambulo__output_check(output, &path, 1, options->overwrite, diagnostics);
  if (!status)
    status = import_text(path, options, allocator, diagnostics, &buffer, beside ? &meshes : NULL);
  if (!status && output)
    status = write_both(output, beside, path, options->overwrite, &buffer, &meshes, diagnostics);
  if (!status && !output) {
    char *copy = ambulo__strdup(&buffer.allocator, ambulo__text_data(&buffer));
    if (copy) *text = copy;
    status = copy ? AMBULO_OK : AMBULO_E_MEMORY;
  }
  ambulo__free(&buffer.allocator, beside);
  ambulo__text_free(&meshes);
  ambulo__text_free(&buffer);
  return ambulo__conclude(diagnostics, errors, status, path);
}
