/* formats/yaml_parse.c - libyaml's events to a tree.
 *
 * libyaml has no depth limit and takes quadratic time in the depth, accepts duplicate keys and
 * further documents silently, and passes aliases that nothing defines: all of these are refused
 * here, event by event. Its own memory does not come from the allocator hook. */
#include "formats/atomic_file.h"
#include "formats/yaml_tree.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <yaml.h>

/* ----------------------------------------------------- bytes refused before parsing
 *
 * libyaml would refuse most of these as well, but with a byte offset instead of a line. */

/* Length of the UTF-8 sequence at the start of bytes[0..left), 0 if it is not valid: too
 * short, overlong, a surrogate, or beyond U+10FFFF. *code is the character. */
static size_t decode(const unsigned char *bytes, size_t left, uint32_t *code) {
  static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  unsigned char lead = bytes[0];
  if (lead < 0x80) {
    *code = lead;
    return 1;
  }
  size_t width = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 0;
  if (width == 0 || width > left || lead >= 0xf8) return 0;
  uint32_t value = lead & (0x7fU >> width);
  for (size_t i = 1; i < width; i++) {
    if ((bytes[i] & 0xc0) != 0x80) return 0;
    value = value << 6 | (bytes[i] & 0x3fU);
  }
  if (value < least[width] || value > 0x10ffff || (value >= 0xd800 && value < 0xe000)) return 0;
  *code = value;
  return width;
}

static int is_control(uint32_t code) {
  if (code < 0x20) return code != '\t' && code != '\n' && code != '\r';
  return code == 0x7f || (code >= 0x80 && code < 0xa0 && code != 0x85) || code == 0xfeff ||
         code == 0xfffe || code == 0xffff;
}

/* refuses bytes that are no YAML text (invalid UTF-8, control characters, directives) with their
 * line and column */
static ambulo_status scan(ambulo_diagnostics *diagnostics, const char *text, size_t length,
                          const char *file) {
  const unsigned char *bytes = (const unsigned char *)text;
  ambulo__place place = {file, 1, 1, NULL};
  for (size_t at = 0; at < length;) {
    uint32_t code = 0;
    size_t width = decode(bytes + at, length - at, &code);
    if (width == 0) {
      return ambulo__error(diagnostics, AMBULO_E_PARSE, place, "save the file as UTF-8",
                           "invalid UTF-8 (got byte 0x%02x); expected UTF-8 text", bytes[at]);
    }
    if (code == 0) {
      return ambulo__error(diagnostics, AMBULO_E_PARSE, place, NULL,
                           "got a NUL byte; expected text");
    }
    if (is_control(code)) {
      return ambulo__error(diagnostics, AMBULO_E_PARSE, place, NULL,
                           "got the control character U+%04X; expected text", (unsigned)code);
    }
    /* libyaml compares each %TAG with all others: a file of them would never end */
    int is_version = length - at >= 6 && memcmp(text + at, "%YAML ", 6) == 0;
    if (code == '%' && place.column == 1 && !is_version) {
      return ambulo__error(diagnostics, AMBULO_E_PARSE, place, NULL,
                           "got a line that starts with '%%'; directives are not allowed");
    }
    at += width;
    int carriage = code == '\r' && !(at < length && bytes[at] == '\n');
    if (code == '\n' || carriage) {
      place.line++;
      place.column = 1;
    } else {
      place.column++;
    }
  }
  return AMBULO_OK;
}

/* ---------------------------------------------------------- where a hint looks */

/* offset of a line */
static size_t start_of_line(const char *text, size_t length, int line) {
  size_t at = 0;
  for (; line > 1 && at < length; at++)
    if (text[at] == '\n') line--;
  return at;
}

/* byte at a line and a column, which counts characters (both 1-based); '\0' beyond the text */
static char byte_at(const char *text, size_t length, int line, int column) {
  size_t at = start_of_line(text, length, line);
  for (; at < length && text[at] != '\n'; at++) {
    int is_first = ((unsigned char)text[at] & 0xc0) != 0x80; /* of a character */
    if (is_first && column-- == 1) return text[at];
  }
  return '\0';
}

/* whether a line (1-based) is indented with a tab */
static int tab_indent(const char *text, size_t length, int line) {
  size_t at = start_of_line(text, length, line);
  for (; at < length && (text[at] == ' ' || text[at] == '\t'); at++)
    if (text[at] == '\t') return 1;
  return 0;
}

typedef struct builder {
  ambulo__yaml *document;
  const char *text; /* the whole input, for hints */
  size_t length;
  const char *file;
  int depth, base_depth;
  ambulo__yaml_node *root;
  ambulo__yaml_node *open;    /* innermost open collection */
  ambulo__yaml_key_text *key; /* read, its value not yet */
  int documents;
} builder;

static ambulo__place place_at(const builder *b, yaml_mark_t mark) {
  ambulo__place place = {b->file, (int)mark.line + 1, (int)mark.column + 1, NULL};
  return place;
}

static ambulo_status refuse(const builder *b, ambulo_status status, yaml_mark_t mark,
                            const char *message) {
  ambulo__error(b->document->diagnostics, status, place_at(b, mark), NULL, "%s", message);
  return status;
}

static ambulo_status out_of_memory(const builder *b) {
  (void)ambulo__io_memory_error(b->document->diagnostics, b->file);
  return AMBULO_E_MEMORY;
}

/* ---------------------------------------------------------------- tree growth */

static void to_array(ambulo__yaml_node *collection) {
  int i = 0;
  for (ambulo__yaml_node *child = collection->first; child; child = child->next)
    collection->items[i++] = child;
}

/* the linked children become an array, so that items are found by index in one step */
static ambulo_status close_collection(builder *b) {
  ambulo__yaml_node *node = b->open;
  if (!node) return AMBULO_E_INTERNAL; /* an end without a start: libyaml sends none */
  if (node->count > 0) {
    node->items = ambulo__arena_take(&b->document->arena, (size_t)node->count, sizeof *node->items);
    if (!node->items) return out_of_memory(b);
    to_array(node);
  }
  b->open = node->parent;
  b->depth--;
  return AMBULO_OK;
}

static void attach(builder *b, ambulo__yaml_node *node) {
  ambulo__yaml_node *parent = b->open;
  node->parent = parent;
  node->key = b->key;
  b->key = NULL;
  if (!parent) {
    b->root = node;
    return;
  }
  node->index = parent->count++;
  if (parent->last) {
    parent->last->next = node;
  } else {
    parent->first = node;
  }
  parent->last = node;
}

static ambulo_status new_node(builder *b, ambulo__yaml_kind kind, yaml_mark_t mark,
                              ambulo__yaml_node **made) {
  if (b->document->node_count >= AMBULO__YAML_MAX_NODES)
    return refuse(b, AMBULO_E_LIMIT, mark, "more than 1000000 values in one document");
  ambulo__yaml_node *node = ambulo__arena_take(&b->document->arena, 1, sizeof *node);
  if (!node) return out_of_memory(b);
  b->document->node_count++;
  node->document = b->document;
  node->kind = kind;
  node->file = b->file;
  node->line = (int)mark.line + 1;
  node->column = (int)mark.column + 1;
  *made = node;
  return AMBULO_OK;
}

static ambulo_status open_collection(builder *b, ambulo__yaml_kind kind, yaml_mark_t mark) {
  if (b->depth + b->base_depth >= AMBULO__YAML_MAX_DEPTH)
    return refuse(b, AMBULO_E_LIMIT, mark, "nested too deeply; expected at most 32 levels");
  if (b->open && b->open->kind == AMBULO__YAML_MAPPING && !b->key)
    return refuse(b, AMBULO_E_PARSE, mark, "got a collection as a key; expected a name");
  ambulo__yaml_node *node = NULL;
  ambulo_status status = new_node(b, kind, mark, &node);
  if (status != AMBULO_OK) return status;
  if (kind == AMBULO__YAML_MAPPING) {
    node->marks = ambulo__arena_take(&b->document->arena, 1, sizeof *node->marks);
    if (!node->marks) return out_of_memory(b);
  }
  attach(b, node);
  b->open = node;
  b->depth++;
  return AMBULO_OK;
}

/* --------------------------------------------------------------------- scalars */

static ambulo_status check_key(const builder *b, const char *text, int plain, yaml_mark_t mark) {
  if (plain && strcmp(text, "<<") == 0)
    return refuse(b, AMBULO_E_PARSE, mark, "merge keys ('<<') are not allowed");
  if (b->open->count >= AMBULO__YAML_MAX_KEYS)
    return refuse(b, AMBULO_E_LIMIT, mark, "more than 1024 keys in one mapping");
  for (const ambulo__yaml_node *value = b->open->first; value; value = value->next) {
    if (strcmp(value->key->text, text) != 0) continue;
    return ambulo__error(b->document->diagnostics, AMBULO_E_SCHEMA, place_at(b, mark), NULL,
                         "duplicate key '%.60s'; the first one is in line %d", text,
                         value->key->line);
  }
  return AMBULO_OK;
}

static ambulo_status add_key(builder *b, const char *text, int plain, yaml_mark_t mark) {
  ambulo_status status = check_key(b, text, plain, mark);
  if (status != AMBULO_OK) return status;
  ambulo__yaml_key_text *key = ambulo__arena_take(&b->document->arena, 1, sizeof *key);
  if (!key) return out_of_memory(b);
  key->text = text;
  key->line = (int)mark.line + 1;
  key->column = (int)mark.column + 1;
  b->key = key;
  return AMBULO_OK;
}

static ambulo_status add_scalar(builder *b, const yaml_event_t *event) {
  const char *value = (const char *)event->data.scalar.value;
  size_t length = event->data.scalar.length;
  yaml_mark_t mark = event->start_mark;
  int plain = event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
  if (memchr(value, '\0', length))
    return refuse(b, AMBULO_E_PARSE, mark, "got a NUL character in a text");
  char *text = ambulo__arena_copy(&b->document->arena, value, length);
  if (!text) return out_of_memory(b);
  if (b->open && b->open->kind == AMBULO__YAML_MAPPING && !b->key)
    return add_key(b, text, plain, mark);
  ambulo__yaml_node *node = NULL;
  ambulo_status status = new_node(b, AMBULO__YAML_SCALAR, mark, &node);
  if (status != AMBULO_OK) return status;
  node->text = text;
  node->quoted = !plain;
  attach(b, node);
  return AMBULO_OK;
}

/* ---------------------------------------------------------------------- events */

static ambulo_status refuse_extras(const builder *b, const yaml_event_t *event,
                                   const yaml_char_t *anchor, const yaml_char_t *tag) {
  if (anchor) {
    return refuse(b, AMBULO_E_PARSE, event->start_mark,
                  "anchors ('&') are not allowed; expected a plain value");
  }
  if (tag) {
    return refuse(b, AMBULO_E_PARSE, event->start_mark,
                  "tags ('!') are not allowed; expected a plain value");
  }
  return AMBULO_OK;
}

static ambulo_status take_event(builder *b, const yaml_event_t *event) {
  ambulo_status status = AMBULO_OK;
  switch (event->type) {
  case YAML_ALIAS_EVENT:
    return refuse(b, AMBULO_E_PARSE, event->start_mark,
                  "aliases ('*') are not allowed; expected a plain value");
  case YAML_DOCUMENT_START_EVENT:
    if (b->documents++ == 0) return AMBULO_OK;
    return refuse(b, AMBULO_E_PARSE, event->start_mark,
                  "a second document starts here; expected one document");
  case YAML_SCALAR_EVENT:
    status = refuse_extras(b, event, event->data.scalar.anchor, event->data.scalar.tag);
    return status == AMBULO_OK ? add_scalar(b, event) : status;
  case YAML_SEQUENCE_START_EVENT:
    status =
        refuse_extras(b, event, event->data.sequence_start.anchor, event->data.sequence_start.tag);
    if (status != AMBULO_OK) return status;
    return open_collection(b, AMBULO__YAML_SEQUENCE, event->start_mark);
  case YAML_MAPPING_START_EVENT:
    status =
        refuse_extras(b, event, event->data.mapping_start.anchor, event->data.mapping_start.tag);
    if (status != AMBULO_OK) return status;
    return open_collection(b, AMBULO__YAML_MAPPING, event->start_mark);
  case YAML_SEQUENCE_END_EVENT:
  case YAML_MAPPING_END_EVENT:
    return close_collection(b);
  default:
    return AMBULO_OK;
  }
}

/* what was probably meant; NULL: no idea */
static const char *parser_hint(const builder *b, const yaml_parser_t *parser) {
  int line = (int)parser->problem_mark.line + 1, column = (int)parser->problem_mark.column + 1;
  if (tab_indent(b->text, b->length, line))
    return "indent with spaces; YAML does not allow tabs there";
  char at = byte_at(b->text, b->length, line, column);
  if ((at == '[' || at == '{') && parser->context && strstr(parser->context, "flow"))
    return "between brackets a text that holds brackets stands in quotes: "
           "{key: \"objective[0].weight\"}";
  return NULL;
}

/* libyaml's message, where it noticed, and where the construct began that it was in */
static ambulo_status parser_error(const builder *b, const yaml_parser_t *parser) {
  if (parser->error == YAML_MEMORY_ERROR) return out_of_memory(b);
  const char *problem = parser->problem ? parser->problem : "not well-formed YAML";
  char context[160] = "";
  if (parser->context) {
    (void)snprintf(context, sizeof context, " %s that starts in line %d, column %d",
                   parser->context, (int)parser->context_mark.line + 1,
                   (int)parser->context_mark.column + 1);
  }
  return ambulo__error(b->document->diagnostics, AMBULO_E_PARSE, place_at(b, parser->problem_mark),
                       parser_hint(b, parser), "%s%s", problem, context);
}

static ambulo_status parse_events(builder *b, yaml_parser_t *parser) {
  for (;;) {
    yaml_event_t event;
    if (!yaml_parser_parse(parser, &event)) return parser_error(b, parser);
    int end = event.type == YAML_STREAM_END_EVENT;
    ambulo_status status = take_event(b, &event);
    yaml_event_delete(&event);
    if (end || status != AMBULO_OK) return status;
  }
}

ambulo_status ambulo__yaml_parse(ambulo__yaml *document, const char *text, size_t length,
                                 const char *file, int base_depth, ambulo__yaml_node **root) {
  if (length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) {
    text += 3; /* byte order mark */
    length -= 3;
  }
  ambulo_status status = scan(document->diagnostics, text, length, file);
  if (status != AMBULO_OK) return status;
  builder b = {.document = document, .text = text, .length = length, .file = file};
  b.base_depth = base_depth;
  yaml_parser_t parser;
  if (!yaml_parser_initialize(&parser)) return out_of_memory(&b);
  yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
  yaml_parser_set_input_string(&parser, (const unsigned char *)text, length);
  status = parse_events(&b, &parser);
  yaml_parser_delete(&parser);
  if (status == AMBULO_OK) *root = b.root;
  return status;
}
