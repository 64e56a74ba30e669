/* exchange/mjcf_include.c - <include file=...> of a MuJoCo model (mjcf.h).
 *
 * The element is replaced by the children of the file's root. Names are relative to the folder of
 * the model; a file may be included once, as MuJoCo has it, so that none can include itself. */
#include <string.h>

#include "exchange/mjcf.h"

enum { MOST_FILES = 64, MOST_DEPTH = 200 };

typedef struct includes {
  ambulo__xml *xml;
  const char *path; /* of the model */
  const char *files[MOST_FILES];
  int count;
} includes;

/* in the folder of the model */
static const char *path_of(includes *in, const char *file) {
  const char *slash = strrchr(in->path, '/');
  if (file[0] == '/' || !slash) return ambulo__arena_copy(in->xml->arena, file, strlen(file));
  return ambulo__arena_print(in->xml->arena, "%.*s/%s", (int)(slash - in->path), in->path, file);
}

static ambulo__xml_node *load(includes *in, const ambulo__xml_node *node) {
  const char *file = ambulo__xml_attribute(node, "file");
  if (!file || !file[0]) {
    ambulo__xml_error(in->xml, node, AMBULO_E_SCHEMA, NULL,
                      "<include> names no file; expected file=...");
    return NULL;
  }
  for (int i = 0; i < in->count; i++) {
    if (strcmp(in->files[i], file) != 0) continue;
    ambulo__xml_error(in->xml, node, AMBULO_E_SCHEMA, NULL,
                      "'%.80s' is included twice; expected each file once", file);
    return NULL;
  }
  if (in->count == MOST_FILES) {
    ambulo__xml_error(in->xml, node, AMBULO_E_LIMIT, NULL,
                      "too many <include>; expected at most %d", (int)MOST_FILES);
    return NULL;
  }
  in->files[in->count++] = file;
  const char *path = path_of(in, file);
  ambulo__xml_node *root = path && path[0] ? ambulo__xml_load(in->xml, path) : NULL;
  if (!root)
    ambulo__xml_error(in->xml, node, in->xml->status ? in->xml->status : AMBULO_E_MEMORY, NULL,
                      "the included file '%.80s' could not be read", file);
  return root;
}

/* `node` of `parent` behind `before` (NULL: the first) by the children of `root` */
static void replace(ambulo__xml_node *parent, ambulo__xml_node *before, ambulo__xml_node *node,
                    ambulo__xml_node *root) {
  ambulo__xml_node *first = root->first ? root->first : node->next;
  for (ambulo__xml_node *n = root->first; n; n = n->next) n->parent = parent;
  if (root->last) root->last->next = node->next;
  *(before ? &before->next : &parent->first) = first;
  if (parent->last == node) parent->last = root->last ? root->last : before;
}

static void expand(includes *in, ambulo__xml_node *parent, int depth) {
  if (depth > MOST_DEPTH) {
    ambulo__xml_error(in->xml, parent, AMBULO_E_LIMIT, NULL,
                      "included elements are nested too deeply; expected at most %d levels",
                      (int)MOST_DEPTH);
    return;
  }
  ambulo__xml_node *before = NULL, *node = parent->first;
  while (node && !in->xml->status) {
    if (!ambulo__xml_is(node, "include")) {
      expand(in, node, depth + 1);
      before = node;
      node = node->next;
      continue;
    }
    ambulo__xml_node *root = load(in, node);
    if (!root) return;
    replace(parent, before, node, root);
    node = before ? before->next : parent->first;
  }
}

void ambulo__mjcf_include(ambulo__xml *xml, ambulo__xml_node *root, const char *path) {
  includes in = {.xml = xml, .path = path};
  expand(&in, root, 0);
}
