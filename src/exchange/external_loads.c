/* exchange/external_loads.c - OpenSim's <ExternalLoads>: which columns of which table act on which
 * body.
 *
 *   <OpenSimDocument><ExternalLoads>
 *     <objects><ExternalForce name=...>
 *       <applied_to_body>, <force_expressed_in_body>, <point_expressed_in_body>
 *       <force_identifier>, <point_identifier>, <torque_identifier>   beginnings of columns
 *       <appliesForce> (version 4), <isDisabled> (version 3)
 *     <datafile>
 *
 * Names of bodies may be paths ("/bodyset/calcn_r"), "Unassigned" stands for nothing, the table is
 * looked for beside the file.
 */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "ambulo/tools/import.h"
#include "formats/paths.h"
#include "base/text_buffer.h"
#include "import/osim.h"
#include "import/body_tree.h"
#include "import/xml.h"
#include "model/model.h"

typedef struct loads {
  const ambulo_model *model;
  ambulo__xml *xml;
  ambulo__text_buffer *columns; /* [feet]: F:P:T+F:P:T */
} loads;

/* the text of a child, without the path before a name; "" for what is unassigned */
static const char *value_of(const ambulo__xml_node *node, const char *name) {
  const char *text = ambulo__osim_text(node, name, NULL);
  return strcmp(text, "Unassigned") == 0 ? "" : text;
}

/* --------------------------------------------------------------------------- feet */

static int leader(const ambulo_model *model, int link) {
  while (link >= 0 && model->links[link].type == AMBULO_FIXED) link = model->links[link].parent;
  return link;
}

static int foot_of_link(const ambulo_model *model, int link) {
  for (int foot = 0; foot < model->foot_count; foot++) {
    const int points[2] = {model->feet[foot].heel[0], model->feet[foot].toe[0]};
    for (int i = 0; i < 2; i++)
      if (leader(model, model->points[points[i]].link) == leader(model, link)) return foot;
  }
  return -1;
}

/* the one foot of the side that a body of a foot is named after; -1 */
static int foot_of_name(const ambulo_model *model, const char *body) {
  static const char *const words[] = {"calcn", "calcaneus", "foot", "toes", "talus"};
  char side = ambulo__side_of(body);
  int found = -1, part = 0;
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) part |= strstr(body, words[i]) != NULL;
  for (int foot = 0; side && part && foot < model->foot_count; foot++) {
    const char *link = model->links[model->points[model->feet[foot].heel[0]].link].name;
    char own = ambulo__side_of(model->feet[foot].name);
    if (!own) own = ambulo__side_of(link);
    if (own != side) continue;
    if (found >= 0) return -1;
    found = foot;
  }
  return found;
}

static int foot_of_body(const ambulo_model *model, const char *body) {
  int link = ambulo_model_find_link(model, body);
  return link >= 0 ? foot_of_link(model, link) : foot_of_name(model, body);
}

/* ------------------------------------------------------------------------- forces */

static void expect_ground(loads *l, const ambulo__xml_node *force, const char *which) {
  const char *frame = ambulo__xml_last_name(value_of(force, which));
  if (!frame[0] || strcmp(frame, "ground") == 0) return;
  ambulo__xml_error(l->xml, ambulo__xml_child(force, which), AMBULO_E_SCHEMA,
                    "express it in ground", "<%s> is '%.60s'; expected ground", which, frame);
}

/* "F:P:T", which commas and the like in a name would break */
static void add_force(loads *l, const ambulo__xml_node *force, int foot) {
  static const char *const parts[] = {"force_identifier", "point_identifier", "torque_identifier"};
  ambulo__text_buffer *text = &l->columns[foot];
  if (text->length) ambulo__text_append_char(text, '+');
  for (int i = 0; i < 3; i++) {
    const char *part = value_of(force, parts[i]);
    if (strpbrk(part, ",+:=") || (i == 0 && !part[0])) {
      ambulo__xml_error(l->xml, force, AMBULO_E_SCHEMA, NULL,
                        "<%s> is '%.60s'; expected the beginning of names of columns", parts[i],
                        part);
      return;
    }
    if (i) ambulo__text_append_char(text, ':');
    ambulo__text_append(text, part);
  }
}

static void read_force(loads *l, const ambulo__xml_node *force) {
  const char *name = ambulo__xml_attribute(force, "name");
  const char *body = ambulo__xml_last_name(value_of(force, "applied_to_body"));
  int off =
      ambulo__osim_flag(force, "isDisabled", 0) || !ambulo__osim_flag(force, "appliesForce", 1);
  int foot = foot_of_body(l->model, body);
  if (!name) name = "";
  if (off || foot < 0) {
    ambulo__warning(
        l->xml->diagnostics, ambulo__xml_place(force), NULL,
        off ? "force '%.60s' on '%.60s' is switched off: it is left out"
            : "force '%.60s' acts on '%.60s', which is not a foot of the model: it is left out",
        name, body);
    return;
  }
  expect_ground(l, force, "force_expressed_in_body");
  expect_ground(l, force, "point_expressed_in_body");
  if (!l->xml->status) add_force(l, force, foot);
}

static const ambulo__xml_node *read_forces(loads *l, const ambulo__xml_node *root) {
  const ambulo__xml_node *list = ambulo__xml_child(root, "ExternalLoads");
  int count = 0;
  if (!list) {
    ambulo__xml_error(l->xml, root, AMBULO_E_SCHEMA, NULL,
                      "this is not a file of external loads (got <%.40s>); expected "
                      "<OpenSimDocument> with <ExternalLoads>",
                      root->first ? root->first->name : root->name);
    return NULL;
  }
  for (const ambulo__xml_node *n = ambulo__osim_objects(root, "ExternalLoads"); n; n = n->next)
    if (ambulo__xml_is(n, "ExternalForce")) read_force(l, n);
  for (int foot = 0; foot < l->model->foot_count; foot++)
    count += l->columns[foot].length > 0 || l->columns[foot].failed;
  if (!l->xml->status && !l->xml->arena->failed && count == 0)
    ambulo__xml_error(l->xml, list, AMBULO_E_SCHEMA, NULL,
                      "no force acts on a foot of the model '%.60s'", l->model->name);
  return list;
}

/* ----------------------------------------------------------------------- the table */

static int is_there(const char *path) {
  struct stat about;
  return path && stat(path, &about) == 0;
}

/* beside the file under its path or its name alone, as many are moved; NULL: no memory */
static char *find_table(const ambulo_allocator *allocator, const char *path, const char *table) {
  char *plain = ambulo__strdup(allocator, table);
  for (char *c = plain; c && *c; c++)
    if (*c == '\\') *c = '/';
  char *found = plain ? ambulo__sibling_path(allocator, path, plain) : NULL;
  if (found && !is_there(found)) {
    char *other = ambulo__sibling_path(allocator, path, ambulo__xml_last_name(plain));
    int better = is_there(other);
    ambulo__free(allocator, better ? found : other);
    if (better) found = other;
  }
  ambulo__free(allocator, plain);
  return found;
}

/* "right=F:P:T,left=none" */
static ambulo_status conclude(const loads *l, const char *path, const char *table,
                              const ambulo_allocator *allocator, char **forces, char **columns) {
  ambulo__text_buffer all;
  ambulo__text_init(&all, allocator);
  for (int foot = 0; foot < l->model->foot_count; foot++) {
    const ambulo__text_buffer *own = &l->columns[foot];
    if (own->failed) all.failed = 1;
    ambulo__text_append_format(&all, "%s%s=%s", foot ? "," : "", l->model->feet[foot].name,
                               own->length ? ambulo__text_data(own) : "none");
  }
  char *found = find_table(&all.allocator, path, table);
  char *map =
      ambulo__text_status(&all) ? NULL : ambulo__strdup(&all.allocator, ambulo__text_data(&all));
  if (found && map) {
    *forces = found;
    *columns = map;
  } else {
    ambulo__free(&all.allocator, found);
    ambulo__free(&all.allocator, map);
  }
  ambulo_status status = found && map ? AMBULO_OK : AMBULO_E_MEMORY;
  ambulo__text_free(&all);
  return status;
}

static ambulo_status read_file(loads *l, const char *path, const ambulo_allocator *allocator,
                               char **forces, char **columns) {
  const ambulo__xml_node *root = ambulo__xml_load(l->xml, path);
  if (!root) return l->xml->status;
  const ambulo__xml_node *list = read_forces(l, root);
  const char *table = list ? value_of(list, "datafile") : "";
  if (!l->xml->status && !table[0])
    ambulo__xml_error(l->xml, list, AMBULO_E_SCHEMA, NULL,
                      "no <datafile>: expected the table of the forces");
  if (l->xml->status) return l->xml->status;
  if (l->xml->arena->failed) return AMBULO_E_MEMORY;
  return conclude(l, path, table, allocator, forces, columns);
}

ambulo_status ambulo_import_external_loads(const char *path, const ambulo_model *model,
                                           const ambulo_allocator *allocator,
                                           ambulo_diagnostics *diagnostics, char **forces,
                                           char **columns) {
  if (!path || !path[0] || !model || !forces || !columns) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__arena arena = {.allocator = ambulo__allocator_or_default(allocator)};
  ambulo__xml xml = {.arena = &arena, .diagnostics = diagnostics};
  loads l = {.model = model, .xml = &xml};
  size_t feet = (size_t)model->foot_count;
  l.columns = ambulo__arena_take(&arena, feet, sizeof *l.columns);
  for (size_t i = 0; l.columns && i < feet; i++) ambulo__text_init(&l.columns[i], allocator);
  ambulo_status status =
      l.columns ? read_file(&l, path, allocator, forces, columns) : AMBULO_E_MEMORY;
  for (size_t i = 0; l.columns && i < feet; i++) ambulo__text_free(&l.columns[i]);
  ambulo__arena_free(&arena);
  return ambulo__conclude(diagnostics, errors, status, path);
}
