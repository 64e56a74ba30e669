/* formats/yaml_tree.h - what the yaml_*.c files share: the nodes and their memory.
 *
 * Nodes, texts and paths are in the document's arena. Nodes are handed out as const; what the
 * getters must write (known keys, messages) is behind pointers. */
#ifndef AMBULO_FORMATS_YAML_TREE_H
#define AMBULO_FORMATS_YAML_TREE_H

#include "formats/arena.h"
#include "formats/yaml_node.h"

enum {
  AMBULO__YAML_MAX_DEPTH = 32,
  AMBULO__YAML_MAX_KEYS = 1024,    /* of one mapping: lookups compare one by one */
  AMBULO__YAML_MAX_NODES = 1000000 /* about 130 MB */
};

typedef struct ambulo__yaml_key_text {
  const char *text;
  int line, column;
  int known; /* somebody asked for it */
} ambulo__yaml_key_text;

/* keys that were asked for in a mapping, there or not: candidates for "did you mean" */
typedef struct ambulo__yaml_marks {
  const char **names;
  size_t count, capacity;
} ambulo__yaml_marks;

struct ambulo__yaml_node {
  ambulo__yaml *document;
  ambulo__yaml_node *parent; /* NULL: root */
  ambulo__yaml_kind kind;
  int quoted;                             /* scalar in quotes or a block scalar: never a number */
  int line, column;                       /* 1-based; 0: set by ambulo__yaml_set() */
  int grown;                              /* by a path: a row of numbers may be shorter, and have
                                             '~' for those that keep their values */
  int index;                              /* among the children of the parent */
  int count;                              /* children */
  const char *file;                       /* where it was read from */
  const char *text;                       /* scalars */
  ambulo__yaml_node **items;              /* children, in file order */
  ambulo__yaml_key_text *key;             /* values of a mapping */
  ambulo__yaml_marks *marks;              /* mappings */
  ambulo__yaml_node *first, *last, *next; /* children while the tree grows */
};

struct ambulo__yaml {
  ambulo__arena arena;             /* of nodes, texts and paths */
  ambulo_diagnostics *diagnostics; /* may be NULL */
  const char *file;
  ambulo__yaml_node *root;
  int node_count;
  ambulo_status status;                /* of the getters */
  const ambulo__yaml_node *wrong_kind; /* reported last: once is enough */
};

/* The value of a key, NULL when absent; marks nothing. */
ambulo__yaml_node *ambulo__yaml_find(const ambulo__yaml_node *mapping, const char *key);

/* Parses a whole text into a tree of `document`. `base_depth` collections are already open
 * around it. Leaves *root NULL for a text without content. Faults go to the diagnostics
 * of the document under the name `file`, which must live as long as the document. */
ambulo_status ambulo__yaml_parse(ambulo__yaml *document, const char *text, size_t length,
                                 const char *file, int base_depth, ambulo__yaml_node **root);

#endif
