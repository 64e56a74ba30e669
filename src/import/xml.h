/* import/xml.h - an XML document as a tree that remembers file, line and column.
 *
 * Elements with their attributes and their text; comments and processing instructions are passed
 * over. Entities of a document's own are refused, so that none can unfold into more than was read;
 * document types outside of it too, so that nothing that they declare is missing. At most 64 MiB a
 * file, a million elements, 200 levels.
 *
 * Parsing is expat's. A library that was built without it (AMBULO_HAS_EXPAT is not defined) refuses
 * every document with a message that says so. */
#ifndef AMBULO_IMPORT_XML_H
#define AMBULO_IMPORT_XML_H

#include "base/diagnostics.h"
#include "formats/arena.h"

/* ------------------------------------------------------------------------- tree */

typedef struct ambulo__xml_node ambulo__xml_node;
struct ambulo__xml_node {
  const char *name;
  const char *text;        /* of its own, trimmed; "" without */
  const char **attributes; /* name, value, name, value, ..., NULL */
  const char *file;
  int line, column;
  ambulo__xml_node *parent, *first, *last, *next;
};

typedef struct ambulo__xml {
  ambulo__arena *arena;
  ambulo_diagnostics *diagnostics;
  ambulo_status status; /* of everything that was asked of the tree; the first fault counts */
} ambulo__xml;

/* The root element of a file, NULL after an error (in xml->status too). `file` must outlive it. */
ambulo__xml_node *ambulo__xml_load(ambulo__xml *xml, const char *file);

/* The first child of that name, the next sibling of that name; NULL: none. NULL has no children. */
ambulo__xml_node *ambulo__xml_child(const ambulo__xml_node *node, const char *name);
ambulo__xml_node *ambulo__xml_next(const ambulo__xml_node *node, const char *name);
int ambulo__xml_is(const ambulo__xml_node *node, const char *name);
/* NOLINTBEGIN(bugprone-macro-parentheses): `child` names a variable */
#define AMBULO__XML_EACH(child, node, name)                                                        \
  for (const ambulo__xml_node *child = ambulo__xml_child(node, name); child;                       \
       child = ambulo__xml_next(child, name))
/* NOLINTEND(bugprone-macro-parentheses) */
/* Value of an attribute; NULL without. */
const char *ambulo__xml_attribute(const ambulo__xml_node *node, const char *name);

/* The attribute name=..., "" without. */
const char *ambulo__xml_name(const ambulo__xml_node *node);

ambulo__place ambulo__xml_place(const ambulo__xml_node *node);
/* Records an error at a node. */
void ambulo__xml_error(ambulo__xml *xml, const ambulo__xml_node *node, ambulo_status status,
                       const char *hint, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* Numbers in `text`, between blanks, into values[0..most); returns how many there are, or -1 after
 * an error about `what` at the node. Infinity (inf, Infinity) is a number only where `infinite`. */
int ambulo__xml_numbers(ambulo__xml *xml, const ambulo__xml_node *node, const char *what,
                        const char *text, int most, int infinite, double *values);
/* The number(s) of an attribute, exactly `count`: 1; 0 without it, or after an error, and values
 * stay. */
int ambulo__xml_vector(ambulo__xml *xml, const ambulo__xml_node *node, const char *attribute,
                       int count, double *values);
/* The same of the text of a child. */
int ambulo__xml_child_vector(ambulo__xml *xml, const ambulo__xml_node *node, const char *child,
                             int count, int infinite, double *values);
/* "did you mean 'NAME'?" for the nearest of names[count], in the arena; NULL: none is near. */
const char *ambulo__xml_nearest(ambulo__xml *xml, const char *word, const char *const *names,
                                int count);
/* What stands behind the last '/' of a path. */
const char *ambulo__xml_last_name(const char *path);
/* Index of a text among words; -1 after an error at the node with the nearest of them. */
int ambulo__xml_choice(ambulo__xml *xml, const ambulo__xml_node *node, const char *what,
                       const char *text, const char *const *words, int count);

#endif
