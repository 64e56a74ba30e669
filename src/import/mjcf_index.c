/* import/mjcf_index.c - what elements of a MuJoCo model find by name (mjcf.h).
 *
 * Every geom asks its default class for some twenty attributes, and a file may have as many classes
 * as geoms. So all names are put into one sorted table, once; a question is a search by halves.
 *
 * A default class may stand in several places (<default class=...>, nested): its table has of each
 * attribute the first. What it does not say the elements around its last place say, inwards first.
 * The top class is that of the elements that are in no other. */
#include "import/mjcf.h"

#include <stdlib.h>
#include <string.h>

/* whose names they are: of meshes, of driven joints, of the top class; then of a place and of all
 * places of one class, by the number of the (first) place */
enum { MESHES, JOINTS, TOP, PLACES };

typedef struct entry {
  int owner, order;
  const char *first, *second;
  const void *value;
} entry;

/* a <default> */
typedef struct place {
  const ambulo__xml_node *node;
  const char *name; /* NULL: none */
  int parent;       /* -1: none */
  int order;
} place;

struct ambulo__mjcf_names {
  entry *entries;
  int count, capacity, sorted; /* what is behind is not found yet */
  place *places;
  int place_count, place_capacity;
  place *named; /* [named_count]: by name, then in order */
  int named_count;
};

static int compare_entries(const void *one, const void *other) {
  const entry *a = one, *b = other;
  int order = (a->owner > b->owner) - (a->owner < b->owner);
  if (order == 0) order = strcmp(a->first, b->first);
  return order == 0 ? strcmp(a->second, b->second) : order;
}

static int compare_all(const void *one, const void *other) {
  int order = compare_entries(one, other), a = ((const entry *)one)->order,
      b = ((const entry *)other)->order;
  return order ? order : (a > b) - (a < b);
}

static int compare_places(const void *one, const void *other) {
  const place *a = one, *b = other;
  int order = strcmp(a->name, b->name);
  return order ? order : (a->order > b->order) - (a->order < b->order);
}

/* the first of its owner with these names */
static const void *find(const struct ambulo__mjcf_names *names, int owner, const char *first,
                        const char *second) {
  const entry wanted = {.owner = owner, .first = first, .second = second};
  int low = 0, high = names->sorted;
  while (low < high) {
    int middle = low + (high - low) / 2;
    if (compare_entries(&names->entries[middle], &wanted) < 0)
      low = middle + 1;
    else
      high = middle;
  }
  int found = low < names->sorted && compare_entries(&names->entries[low], &wanted) == 0;
  return found ? names->entries[low].value : NULL;
}

static void add(ambulo__mjcf *m, int owner, const char *first, const char *second,
                const void *value) {
  struct ambulo__mjcf_names *names = m->names;
  if (!ambulo__arena_grow(m->tree->arena, &names->entries, names->count, &names->capacity,
                          sizeof *names->entries))
    return;
  names->entries[names->count] = (entry){owner, names->count, first, second, value};
  names->count++;
}

/* --------------------------------------------------------------- default classes */

static void collect(ambulo__mjcf *m, const ambulo__xml_node *node, int parent) {
  struct ambulo__mjcf_names *names = m->names;
  const char *name = ambulo__xml_attribute(node, "class");
  int own = names->place_count;
  if (!ambulo__arena_grow(m->tree->arena, &names->places, own, &names->place_capacity,
                          sizeof *names->places))
    return;
  if (!name && parent < 0) name = "main";
  names->places[names->place_count++] = (place){node, name, parent, own};
  AMBULO__XML_EACH (n, node, "default") collect(m, n, own);
}

/* how many names come before this one; `with`: and are it */
static int before(const struct ambulo__mjcf_names *names, const char *name, int with) {
  int low = 0, high = names->named_count;
  while (low < high) {
    int middle = low + (high - low) / 2;
    if (strcmp(names->named[middle].name, name) < with)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

static int owner_of_place(int number) {
  return PLACES + 2 * number;
}

static int owner_of_class(int first) {
  return PLACES + 2 * first + 1;
}

static void add_attributes(ambulo__mjcf *m, int owner, const ambulo__xml_node *node) {
  for (const ambulo__xml_node *n = node->first; n; n = n->next) {
    if (ambulo__xml_is(n, "default")) continue;
    for (const char **a = n->attributes; a && a[0]; a += 2) add(m, owner, n->name, a[0], a[1]);
  }
}

static void index_classes(ambulo__mjcf *m) {
  struct ambulo__mjcf_names *names = m->names;
  AMBULO__XML_EACH (n, m->root, "default") collect(m, n, -1);
  names->named =
      ambulo__arena_take(m->tree->arena, (size_t)names->place_count + 1, sizeof *names->named);
  if (!names->named) return;
  for (int i = 0; i < names->place_count; i++)
    if (names->places[i].name) names->named[names->named_count++] = names->places[i];
  if (names->named_count > 1)
    qsort(names->named, (size_t)names->named_count, sizeof *names->named, compare_places);
  for (int i = 0; i < names->place_count; i++) {
    const place *p = &names->places[i];
    if (p->parent < 0) add_attributes(m, TOP, p->node);
    if (ambulo__xml_child(p->node, "default")) add_attributes(m, owner_of_place(i), p->node);
    if (p->name) add_attributes(m, owner_of_class(before(names, p->name, 0)), p->node);
  }
}

const char *ambulo__mjcf_default(const ambulo__mjcf *m, const char *name, const char *tag,
                                 const char *attribute) {
  const struct ambulo__mjcf_names *names = m->names;
  if (!names) return NULL;
  if (!name) return find(names, TOP, tag, attribute);
  int first = before(names, name, 0), behind = before(names, name, 1);
  if (first == behind) return NULL;
  const char *text = find(names, owner_of_class(first), tag, attribute);
  if (text) return text;
  for (int p = names->named[behind - 1].parent; p >= 0 && !text; p = names->places[p].parent)
    text = find(names, owner_of_place(p), tag, attribute);
  return text;
}

/* -------------------------------------------------------------- meshes, actuators */

static void index_meshes(ambulo__mjcf *m) {
  AMBULO__XML_EACH (set, m->root, "asset") {
    AMBULO__XML_EACH (n, set, "mesh") {
      const char *file = ambulo__xml_attribute(n, "file");
      if (!file) file = ambulo__mjcf_default(m, ambulo__xml_attribute(n, "class"), "mesh", "file");
      const char *name = ambulo__xml_attribute(n, "name");
      if (!file) continue;
      if (!name) {
        const char *base = ambulo__xml_last_name(file), *dot = strrchr(base, '.');
        name = ambulo__arena_copy(m->tree->arena, base, dot ? (size_t)(dot - base) : strlen(base));
      }
      if (name) add(m, MESHES, name, "", n);
    }
  }
}

static void index_joints(ambulo__mjcf *m) {
  AMBULO__XML_EACH (set, m->root, "actuator") {
    for (const ambulo__xml_node *n = set->first; n; n = n->next) {
      const char *joint = ambulo__xml_attribute(n, "joint");
      if (joint) add(m, JOINTS, joint, "", n);
    }
  }
}

static void sort(struct ambulo__mjcf_names *names) {
  if (names->count > 1)
    qsort(names->entries, (size_t)names->count, sizeof *names->entries, compare_all);
  names->sorted = names->count;
}

void ambulo__mjcf_index(ambulo__mjcf *m) {
  m->names = ambulo__arena_take(m->tree->arena, 1, sizeof *m->names);
  if (!m->names) return;
  index_classes(m);
  sort(m->names); /* files of meshes may be those of a class */
  index_meshes(m);
  index_joints(m);
  sort(m->names);
}

const ambulo__xml_node *ambulo__mjcf_mesh(const ambulo__mjcf *m, const char *name) {
  return m->names ? find(m->names, MESHES, name, "") : NULL;
}

int ambulo__mjcf_is_driven(const ambulo__mjcf *m, const char *joint) {
  return m->names && find(m->names, JOINTS, joint, "") != NULL;
}
