/* import/xml.c - XML documents as trees, and what is asked of them (xml.h). */
#include "import/xml.h"

#include "base/numtext.h"
#include "formats/read_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* ----------------------------------------------------------------------- asking */

int ambulo__xml_is(const ambulo__xml_node *node, const char *name) {
  return node && strcmp(node->name, name) == 0;
}

static ambulo__xml_node *first_of(ambulo__xml_node *node, const char *name) {
  while (node && strcmp(node->name, name) != 0) node = node->next;
  return node;
}

ambulo__xml_node *ambulo__xml_child(const ambulo__xml_node *node, const char *name) {
  return node ? first_of(node->first, name) : NULL;
}

ambulo__xml_node *ambulo__xml_next(const ambulo__xml_node *node, const char *name) {
  return node ? first_of(node->next, name) : NULL;
}

const char *ambulo__xml_attribute(const ambulo__xml_node *node, const char *name) {
  for (const char **a = node ? node->attributes : NULL; a && a[0]; a += 2) {
    if (strcmp(a[0], name) == 0) return a[1];
  }
  return NULL;
}

const char *ambulo__xml_name(const ambulo__xml_node *node) {
  const char *name = ambulo__xml_attribute(node, "name");
  return name ? name : "";
}

const char *ambulo__xml_last_name(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

ambulo__place ambulo__xml_place(const ambulo__xml_node *node) {
  if (!node) return ambulo__nowhere;
  return (ambulo__place){.file = node->file, .line = node->line, .column = node->column};
}

void ambulo__xml_error(ambulo__xml *xml, const ambulo__xml_node *node, ambulo_status status,
                       const char *hint, const char *format, ...) {
  char message[600];
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(message, sizeof message, format, arguments);
  va_end(arguments);
  if (xml->arena
          ->failed) { /* a name was not found without memory: nothing is wrong with the file */
    if (!xml->status)
      xml->status =
          ambulo__error(xml->diagnostics, AMBULO_E_MEMORY, ambulo__nowhere, NULL, "out of memory");
    return;
  }
  (void)ambulo__error(xml->diagnostics, status, ambulo__xml_place(node), hint, "%s", message);
  if (!xml->status) xml->status = status;
}

/* ------------------------------------------------------------------- numbers */

/* "inf", "+Infinity", "-INF" */
static int is_infinite(const char *word, size_t length, double *value) {
  int sign = word[0] == '-' ? -1 : 1;
  size_t skip = word[0] == '-' || word[0] == '+';
  static const char *const names[] = {"inf", "infinity"};
  for (int i = 0; i < 2; i++) {
    if (length - skip != strlen(names[i]) || strncasecmp(word + skip, names[i], length - skip) != 0)
      continue;
    *value = sign < 0 ? -INFINITY : INFINITY;
    return 1;
  }
  return 0;
}

/* Numbers of programs may lack the digits before the point, or behind it: ".5", "5." */
static int read_number(const char *word, size_t length, int infinite, double *value) {
  char full[96];
  size_t used = 0;
  if (length == 0 || length > 80) return 0;
  if (infinite && is_infinite(word, length, value)) return 1;
  for (size_t i = 0; i < length; i++) {
    int digit_before = i > 0 && word[i - 1] >= '0' && word[i - 1] <= '9';
    int digit_behind = i + 1 < length && word[i + 1] >= '0' && word[i + 1] <= '9';
    if (word[i] == '.' && !digit_before && !digit_behind) return 0;
    if (word[i] == '.' && !digit_before) full[used++] = '0';
    full[used++] = word[i];
    if (word[i] == '.' && !digit_behind) full[used++] = '0';
  }
  return ambulo__parse_double(full, used, value);
}

int ambulo__xml_numbers(ambulo__xml *xml, const ambulo__xml_node *node, const char *what,
                        const char *text, int most, int infinite, double *values) {
  static const char blanks[] = " \t\r\n,";
  int count = 0;
  for (text += strspn(text, blanks); *text; text += strspn(text, blanks)) {
    size_t length = strcspn(text, blanks);
    double value = 0.0;
    if (!read_number(text, length, infinite, &value)) {
      ambulo__xml_error(xml, node, AMBULO_E_SCHEMA, NULL,
                        "%s of <%s> is not a number (got '%.*s'); expected a finite number", what,
                        node->name, (int)(length > 40 ? 40 : length), text);
      return -1;
    }
    if (count < most) values[count] = value;
    count++;
    text += length;
  }
  return count;
}

static int exactly(ambulo__xml *xml, const ambulo__xml_node *node, const char *what,
                   const char *text, int count, int infinite, double *values) {
  enum { MOST = 16 };
  double read[MOST];
  int got = ambulo__xml_numbers(xml, node, what, text, MOST, infinite, read);
  if (got < 0) return 0;
  if (got != count) {
    ambulo__xml_error(xml, node, AMBULO_E_SCHEMA, NULL, "%s of <%s> has %d numbers; expected %d",
                      what, node->name, got, count);
    return 0;
  }
  memcpy(values, read, (size_t)count * sizeof *values);
  return 1;
}

int ambulo__xml_vector(ambulo__xml *xml, const ambulo__xml_node *node, const char *attribute,
                       int count, double *values) {
  const char *text = ambulo__xml_attribute(node, attribute);
  return text ? exactly(xml, node, attribute, text, count, 0, values) : 0;
}

int ambulo__xml_child_vector(ambulo__xml *xml, const ambulo__xml_node *node, const char *child,
                             int count, int infinite, double *values) {
  const ambulo__xml_node *item = ambulo__xml_child(node, child);
  if (!item || !item->text[0]) return 0;
  return exactly(xml, item, "the text", item->text, count, infinite, values);
}

const char *ambulo__xml_nearest(ambulo__xml *xml, const char *word, const char *const *names,
                                int count) {
  const char *near = names ? ambulo__nearest(word, names, (size_t)count) : NULL;
  return near ? ambulo__arena_print(xml->arena, "did you mean '%.64s'?", near) : NULL;
}

int ambulo__xml_choice(ambulo__xml *xml, const ambulo__xml_node *node, const char *what,
                       const char *text, const char *const *words, int count) {
  for (int i = 0; i < count; i++) {
    if (strcmp(text, words[i]) == 0) return i;
  }
  char list[400] = "";
  for (int i = 0; i < count; i++) {
    size_t used = strlen(list);
    (void)snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", words[i]);
  }
  ambulo__xml_error(xml, node, AMBULO_E_SCHEMA, ambulo__xml_nearest(xml, text, words, count),
                    "unknown %s (got '%.60s'); expected one of %s", what, text, list);
  return -1;
}

/* ---------------------------------------------------------------------- parsing */

enum { MOST_BYTES = 64 << 20 };

#ifdef AMBULO_HAS_EXPAT
#include <expat.h>

enum { MOST_NODES = 1000000, MOST_DEPTH = 200 };

typedef struct building {
  ambulo__xml *xml;
  XML_Parser parser;
  const char *file;
  ambulo__xml_node *root, *open;
  int nodes, depth;
  char *text; /* of all open elements, one behind the other */
  size_t used, capacity;
  size_t start[MOST_DEPTH + 1]; /* of the text of the open element of that depth */
  ambulo_status status;
} building;

static ambulo__place here(const building *b) {
  ambulo__place place = {.file = b->file,
                         .line = (int)XML_GetCurrentLineNumber(b->parser),
                         .column = (int)XML_GetCurrentColumnNumber(b->parser) + 1};
  return place;
}

static void stop(building *b, ambulo_status status, const char *hint, const char *what) {
  if (b->status) return;
  b->status = ambulo__error(b->xml->diagnostics, status, here(b), hint, "%s", what);
  XML_StopParser(b->parser, XML_FALSE);
}

static const char **copy_attributes(building *b, const XML_Char **attributes) {
  int count = 0;
  while (attributes[count]) count++;
  const char **copy = ambulo__arena_take(b->xml->arena, (size_t)count + 1, sizeof *copy);
  for (int i = 0; copy && i < count; i++)
    copy[i] = ambulo__arena_copy(b->xml->arena, attributes[i], strlen(attributes[i]));
  return copy;
}

static void begin(void *user, const XML_Char *name, const XML_Char **attributes) {
  building *b = user;
  if (b->status) return;
  if (b->nodes++ >= MOST_NODES)
    stop(b, AMBULO_E_LIMIT, NULL, "too many elements; expected at most a million");
  if (b->depth >= MOST_DEPTH)
    stop(b, AMBULO_E_LIMIT, NULL, "elements are nested too deeply; expected at most 200 levels");
  if (b->status) return;
  ambulo__xml_node *node = ambulo__arena_take(b->xml->arena, 1, sizeof *node);
  if (!node) {
    stop(b, AMBULO_E_MEMORY, NULL, "out of memory");
    return;
  }
  node->name = ambulo__arena_copy(b->xml->arena, name, strlen(name));
  node->attributes = copy_attributes(b, attributes);
  node->text = "";
  node->file = b->file;
  node->line = here(b).line;
  node->column = here(b).column;
  node->parent = b->open;
  if (!b->open) {
    b->root = node;
  } else {
    *(b->open->first ? &b->open->last->next : &b->open->first) = node;
    b->open->last = node;
  }
  b->open = node;
  b->start[++b->depth] = b->used;
  if (b->xml->arena->failed) stop(b, AMBULO_E_MEMORY, NULL, "out of memory");
}

static int is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static void end(void *user, const XML_Char *name) {
  building *b = user;
  (void)name;
  if (b->status || !b->open) return;
  size_t from = b->start[b->depth], to = b->used;
  while (from < to && is_blank(b->text[from])) from++;
  while (to > from && is_blank(b->text[to - 1])) to--;
  if (to > from) b->open->text = ambulo__arena_copy(b->xml->arena, b->text + from, to - from);
  b->used = b->start[b->depth--];
  b->open = b->open->parent;
  if (b->xml->arena->failed) stop(b, AMBULO_E_MEMORY, NULL, "out of memory");
}

static void characters(void *user, const XML_Char *text, int length) {
  building *b = user;
  if (b->status || length <= 0) return;
  if (b->capacity - b->used < (size_t)length) {
    size_t capacity = 2 * (b->capacity + (size_t)length);
    char *larger = ambulo__realloc(&b->xml->arena->allocator, b->text, capacity, 1);
    if (!larger) {
      stop(b, AMBULO_E_MEMORY, NULL, "out of memory");
      return;
    }
    b->text = larger;
    b->capacity = capacity;
  }
  memcpy(b->text + b->used, text, (size_t)length);
  b->used += (size_t)length;
}

static void entity(void *user, const XML_Char *name, int is_parameter, const XML_Char *value,
                   int length, const XML_Char *base, const XML_Char *system,
                   const XML_Char *public_id, const XML_Char *notation) {
  (void)name, (void)is_parameter, (void)value, (void)length, (void)base, (void)system;
  (void)public_id, (void)notation;
  stop(user, AMBULO_E_PARSE, "replace the entity by its text",
       "the document declares an entity; expected none");
}

/* The name of a document type may stand; what a document type elsewhere, or a part of it, declares
 * would be missing: expat leaves out each entity that may be declared there, and does not say so.
 */
static const char elsewhere[] =
    "the document type is declared outside of the document; expected none";

static void doctype(void *user, const XML_Char *name, const XML_Char *system,
                    const XML_Char *public_id, int has_own) {
  (void)name, (void)has_own;
  if (system || public_id)
    stop(user, AMBULO_E_PARSE, "remove <!DOCTYPE ...>, and replace entities by their text",
         elsewhere);
}

static int not_standalone(void *user) {
  stop(user, AMBULO_E_PARSE, "remove <!DOCTYPE ...>, and replace entities by their text",
       elsewhere);
  return XML_STATUS_ERROR;
}

static void skipped(void *user, const XML_Char *name, int is_parameter) {
  (void)name, (void)is_parameter;
  stop(user, AMBULO_E_PARSE, "replace the entity by its text",
       "the document refers to an entity that it does not declare; expected none");
}

static void parse(building *b, const char *text, size_t length) {
  XML_SetUserData(b->parser, b);
  XML_SetElementHandler(b->parser, begin, end);
  XML_SetCharacterDataHandler(b->parser, characters);
  XML_SetEntityDeclHandler(b->parser, entity);
  XML_SetStartDoctypeDeclHandler(b->parser, doctype);
  XML_SetNotStandaloneHandler(b->parser, not_standalone);
  XML_SetSkippedEntityHandler(b->parser, skipped);
  enum XML_Status outcome = XML_Parse(b->parser, text, (int)length, 1);
  if (b->status || outcome == XML_STATUS_OK) return;
  enum XML_Error code = XML_GetErrorCode(b->parser);
  const char *hint =
      code == XML_ERROR_TAG_MISMATCH && b->open ? "an element before is not closed" : NULL;
  b->status = ambulo__error(
      b->xml->diagnostics, code == XML_ERROR_NO_MEMORY ? AMBULO_E_MEMORY : AMBULO_E_PARSE, here(b),
      hint, "the text is not XML (%s); expected a well-formed document", XML_ErrorString(code));
}

static ambulo_status build(ambulo__xml *xml, const char *file, const char *text, size_t length,
                           ambulo__xml_node **root) {
  building b = {.xml = xml, .file = file, .parser = XML_ParserCreate(NULL)};
  if (!b.parser)
    return ambulo__error(xml->diagnostics, AMBULO_E_MEMORY, ambulo__nowhere, NULL, "out of memory");
  parse(&b, text, length);
  XML_ParserFree(b.parser);
  ambulo__free(&xml->arena->allocator, b.text);
  *root = b.root;
  return b.status;
}

#else

static ambulo_status build(ambulo__xml *xml, const char *file, const char *text, size_t length,
                           ambulo__xml_node **root) {
  (void)text, (void)length, (void)root;
  return ambulo__error(xml->diagnostics, AMBULO_E_IO, (ambulo__place){.file = file},
                       "install expat (libexpat1-dev, expat-devel) and build again",
                       "cannot read XML: this ambulo was built without expat");
}

#endif

ambulo__xml_node *ambulo__xml_load(ambulo__xml *xml, const char *file) {
  char *text = NULL;
  size_t length = 0;
  ambulo__xml_node *root = NULL;
  ambulo_status status =
      ambulo__read_file(file, MOST_BYTES, &xml->arena->allocator, xml->diagnostics, &text, &length);
  if (!status) status = build(xml, file, text, length, &root);
  ambulo__free(&xml->arena->allocator, text);
  if (status && !xml->status) xml->status = status;
  return status ? NULL : root;
}
