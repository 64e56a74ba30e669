/* exchange/xml_parse.c - from expat's events to a tree (xml_tree.h). */
#include "formats/read_file.h"
#include "exchange/xml_tree.h"

#include <string.h>

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
  stop(user, AMBULO_E_PARSE, "put the text that it stands for in its place",
       "the document declares an entity; expected none");
}

static void parse(building *b, const char *text, size_t length) {
  XML_SetUserData(b->parser, b);
  XML_SetElementHandler(b->parser, begin, end);
  XML_SetCharacterDataHandler(b->parser, characters);
  XML_SetEntityDeclHandler(b->parser, entity);
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
