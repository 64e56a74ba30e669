/* definitions/problem_reader.c - memory, file names and sections of a problem reader. */
#include "definitions/problem_reader.h"

#include "formats/paths.h"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* A block is a header in this list, then the memory handed out. */
struct ambulo__reader_block {
  ambulo__reader_block *next;
  max_align_t memory[];
};

void *ambulo__reader_alloc(ambulo__problem_reader *reader, size_t count, size_t size) {
  size_t bytes = count * size;
  int overflows = size != 0 && bytes / size != count;
  ambulo__reader_block *block = overflows || bytes > SIZE_MAX - sizeof *block
                                    ? NULL
                                    : ambulo__alloc(&reader->allocator, 1, sizeof *block + bytes);
  if (!block) {
    reader->failure = AMBULO_E_MEMORY;
    if (reader->document) ambulo__yaml_out_of_memory(reader->document);
    return NULL;
  }
  block->next = reader->blocks;
  reader->blocks = block;
  return block->memory;
}

static const char *copy_text(ambulo__problem_reader *reader, const char *text) {
  size_t size = strlen(text) + 1;
  char *copy = ambulo__reader_alloc(reader, size, 1);
  if (copy) memcpy(copy, text, size);
  return copy;
}

static const char *beside(ambulo__problem_reader *reader, const char *name) {
  size_t directory = strlen(reader->directory), length = strlen(name);
  if (name[0] == '/' || directory == 0) return name;
  int slash = reader->directory[directory - 1] != '/';
  char *path = ambulo__reader_alloc(reader, directory + (size_t)slash + length + 1, 1);
  if (!path) return NULL;
  memcpy(path, reader->directory, directory);
  if (slash) path[directory] = '/';
  memcpy(path + directory + slash, name, length);
  return path;
}

const char *ambulo__reader_path(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                const char *name) {
  const char *path = beside(reader, name);
  char *shipped = NULL;
  if (!path) return NULL;
  if (ambulo__shipped_path(&reader->allocator, path, name, &shipped)) {
    reader->failure = AMBULO_E_MEMORY;
    return NULL;
  }
  if (!shipped) return path;
  ambulo__note_shipped(reader->diagnostics, ambulo__yaml_place(node), name, shipped);
  path = copy_text(reader, shipped);
  ambulo__free(&reader->allocator, shipped);
  return path;
}

void ambulo__reader_clear(ambulo__problem_reader *reader) {
  ambulo__reader_block *block = reader->blocks;
  while (block) {
    ambulo__reader_block *next = block->next;
    ambulo__free(&reader->allocator, block);
    block = next;
  }
  reader->blocks = NULL;
  ambulo_model_free(reader->model);
  reader->model = NULL;
}

const ambulo__yaml_node *ambulo__reader_section(const ambulo__yaml_node *root, const char *key) {
  const ambulo__yaml_node *node = ambulo__yaml_get(root, key);
  if (!node || ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) return node;
  (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "'%s' is not a mapping; expected keys",
                           key);
  return NULL;
}
