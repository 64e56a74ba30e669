/* show/scene_meshes.c - what a body looks like: meshes of its links, and where these are over time
 * (scene.h).
 *
 * They stand beside the model file (import/meshes.h), one of the files that a problem was read
 * from. A result is one without them too: what cannot be read, and links that the model does not
 * have, are left out.
 */
#include "show/scene.h"

#include "import/meshes.h"
#include "formats/inputs.h"
#include "formats/yaml_node.h"

#include <string.h>

/* A point along each axis tells where that points: as far as this, in m, to within its rounding. */
static const double reach = 0.3;

/* the meshes beside one input; *document stays NULL where there are none that can be read. Errors:
 * E_MEMORY. */
static ambulo_status load(const char *input, size_t length, const ambulo_allocator *a,
                          ambulo__yaml **document) {
  char *model = ambulo__alloc(a, length + 1, 1), *path = NULL, *text = NULL;
  ambulo_status status = model ? AMBULO_OK : AMBULO_E_MEMORY;
  size_t size = 0;
  if (model) {
    memcpy(model, input, length);
    status = ambulo__meshes_path(a, model, &path);
  }
  if (path) status = ambulo__read_file(path, AMBULO__YAML_MAX_BYTES, a, NULL, &text, &size);
  if (text) status = ambulo__yaml_load_text(text, size, path, a, NULL, document);
  const ambulo__yaml_node *root = *document ? ambulo__yaml_root(*document) : NULL;
  const ambulo__yaml_node *schema =
      ambulo__yaml_is(root, AMBULO__YAML_MAPPING) ? ambulo__yaml_get(root, "schema") : NULL;
  if (*document && (!schema || strcmp(ambulo__yaml_text(schema), AMBULO__MESHES_SCHEMA) != 0)) {
    ambulo__yaml_free(*document);
    *document = NULL;
  }
  ambulo__free(a, text);
  ambulo__free(a, path);
  ambulo__free(a, model);
  return status == AMBULO_E_MEMORY ? status : AMBULO_OK;
}

/* origin, and the points along x and y, of a link: nine numbers at each time */
static ambulo_status frame(ambulo__json *json, ambulo__scene_body *body, int link, double *place) {
  const double ends[3][3] = {{0.0, 0.0, 0.0}, {reach, 0.0, 0.0}, {0.0, reach, 0.0}};
  for (int k = 0; k < body->samples; k++) {
    ambulo__pose_at(&body->skeleton.pose,
                    body->q + (size_t)k * (size_t)body->model->coordinate_count);
    for (int e = 0; e < 3; e++) {
      double world[3];
      ambulo__pose_point(&body->skeleton.pose, link, ends[e], world);
      ambulo__scene_place(body->model, body->ground, world, place + 9 * (size_t)k + 3 * e);
    }
  }
  ambulo__json_open(json, "frame", '[');
  for (int e = 0; e < 3; e++) {
    ambulo__json_open(json, NULL, '[');
    for (int i = 0; i < 3; i++)
      ambulo__series(json, NULL, place + 3 * e + i, 9, body->samples, AMBULO__SCENE_LENGTH);
    ambulo__json_close(json, ']');
  }
  ambulo__json_close(json, ']');
  return ambulo__text_status(json->text);
}

static ambulo_status mesh(ambulo__json *json, ambulo__scene_body *body,
                          const ambulo__yaml_node *item, double *place) {
  static const char *const keys[] = {"vertices", "triangles"};
  const ambulo__yaml_node *name = ambulo__yaml_get(item, "link");
  int link = name ? ambulo_model_find_link(body->model, ambulo__yaml_text(name)) : -1;
  for (int i = 0; i < 2; i++)
    if (!ambulo__yaml_get(item, keys[i])) link = -1;
  if (link < 0) return AMBULO_OK;
  ambulo__json_open(json, NULL, '{');
  ambulo__json_text(json, "link", ambulo__yaml_text(name));
  ambulo__json_text(json, "side", ambulo__scene_side(body->skeleton.side[link]));
  ambulo_status status = frame(json, body, link, place);
  for (int i = 0; i < 2; i++)
    ambulo__json_text(json, keys[i], ambulo__yaml_text(ambulo__yaml_get(item, keys[i])));
  ambulo__json_close(json, '}');
  return status;
}

ambulo_status ambulo__scene_meshes(ambulo__json *json, ambulo__scene_body *body,
                                   const char *inputs) {
  const ambulo_allocator *a = &body->allocator;
  ambulo__yaml *document = NULL;
  ambulo_status status = AMBULO_OK;
  char digest[AMBULO__SHA256_TEXT];
  const char *path;
  size_t length;
  while (!document && !status && ambulo__inputs_next(&inputs, digest, &path, &length))
    status = load(path, length, a, &document);
  if (!document) return status;
  const ambulo__yaml_node *list = ambulo__yaml_get(ambulo__yaml_root(document), "meshes");
  double *place = ambulo__alloc(a, 9 * (size_t)body->samples, sizeof *place);
  if (!place) status = AMBULO_E_MEMORY;
  ambulo__json_open(json, "meshes", '[');
  for (int i = 0; !status && list && i < ambulo__yaml_items(list); i++)
    if (ambulo__yaml_is(ambulo__yaml_item(list, i), AMBULO__YAML_MAPPING))
      status = mesh(json, body, ambulo__yaml_item(list, i), place);
  ambulo__json_close(json, ']');
  ambulo__free(a, place);
  ambulo__yaml_free(document);
  return status;
}
