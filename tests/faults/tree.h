/* tests/faults/tree.h - what is in a folder: paths with a hash of their bytes. Times, and
 * records that hold them, are left out of the hash. A file that has not been written since its hash
 * is known is not read again. */
#ifndef AMBULO_TESTS_FAULTS_TREE_H
#define AMBULO_TESTS_FAULTS_TREE_H

#include "support/scratch.h"

#include <errno.h>
#include <string.h>

typedef struct tree_entry {
  char path[240]; /* below the folder */
  unsigned long long hash;
  ino_t file;
  off_t size;
  struct timespec changed;
} tree_entry;

typedef struct tree {
  tree_entry *entry; /* by path */
  int count;
} tree;

/* to be freed; a NUL follows */
static inline char *tree_read(const char *path, size_t *length) {
  struct stat entry;
  int file = open(path, O_RDONLY);
  size_t size = file >= 0 && fstat(file, &entry) == 0 ? (size_t)entry.st_size : 0, got = 0;
  char *text = malloc(size + 1);
  assert_non_null(text);
  for (ssize_t n = 1; got < size && n > 0; got += n > 0 ? (size_t)n : 0)
    n = read(file, text + got, size - got);
  if (file >= 0) close(file);
  text[got] = '\0';
  if (length) *length = got;
  return text;
}

/* seconds that something took */
static inline int tree_is_time(const char *line, size_t length) {
  static const char *const words[] = {
      "\"seconds\"", "\"total\": ", "\"evaluate\": ", "\"linear_algebra\"",
      "\"nlopt\": ", "effort  ",    " in total",      "seconds  "};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (memmem(line, length, words[i], strlen(words[i]))) return 1;
  return 0;
}

static inline unsigned long long tree_hash(const char *path) {
  unsigned long long hash = 14695981039346656037ull;
  size_t length = 0;
  char *text = tree_read(path, &length);
  for (const char *line = text, *end = text + length; line < end;) {
    const char *stop = memchr(line, '\n', (size_t)(end - line));
    size_t size = stop ? (size_t)(stop - line) + 1 : (size_t)(end - line);
    if (!tree_is_time(line, size))
      for (size_t i = 0; i < size; i++) hash = (hash ^ (unsigned char)line[i]) * 1099511628211ull;
    line += size;
  }
  free(text);
  return hash;
}

static inline int tree_order(const void *a, const void *b) {
  return strcmp(((const tree_entry *)a)->path, ((const tree_entry *)b)->path);
}

static inline const tree_entry *tree_find(const tree *t, const char *path) {
  tree_entry key;
  assert_true(strlen(path) < sizeof key.path);
  strcpy(key.path, path);
  return t->count ? bsearch(&key, t->entry, (size_t)t->count, sizeof key, tree_order) : NULL;
}

/* whether it is the file of which the hash is known, and has not been written since */
static inline int tree_unwritten(const tree_entry *known, const struct stat *now) {
  return known && known->file == now->st_ino && known->size == now->st_size &&
         known->changed.tv_sec == now->st_ctim.tv_sec &&
         known->changed.tv_nsec == now->st_ctim.tv_nsec;
}

static inline void tree_add(tree *t, const char *folder, const char *below, const tree *known) {
  char path[700];
  (void)snprintf(path, sizeof path, "%s/%s", folder, below);
  DIR *stream = opendir(path);
  for (struct dirent *e = stream ? readdir(stream) : NULL; e; e = readdir(stream)) {
    struct stat entry;
    if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0) continue;
    t->entry = realloc(t->entry, (size_t)(t->count + 1) * sizeof *t->entry);
    assert_non_null(t->entry);
    tree_entry *one = &t->entry[t->count++];
    int size = snprintf(one->path, sizeof one->path, "%s%s%s", below, *below ? "/" : "", e->d_name);
    assert_true(size < (int)sizeof one->path);
    (void)snprintf(path, sizeof path, "%s/%s", folder, one->path);
    int is_folder = lstat(path, &entry) == 0 && S_ISDIR(entry.st_mode);
    /* a lock holds the number of a process */
    one->file = entry.st_ino;
    one->size = entry.st_size;
    one->changed = entry.st_ctim;
    const tree_entry *old = known ? tree_find(known, one->path) : NULL;
    if (is_folder || strcmp(e->d_name, "lock") == 0)
      one->hash = 0;
    else
      one->hash = tree_unwritten(old, &entry) ? old->hash : tree_hash(path);
    char name[240];
    memcpy(name, one->path, sizeof name);
    if (is_folder) tree_add(t, folder, name, known);
  }
  if (stream) closedir(stream);
}

/* known: an earlier tree of the folder, or NULL */
static inline tree tree_of(const char *folder, const tree *known) {
  tree t = {NULL, 0};
  tree_add(&t, folder, "", known);
  qsort(t.entry, (size_t)t.count, sizeof *t.entry, tree_order);
  return t;
}

static inline void tree_free(tree *t) {
  free(t->entry);
  *t = (tree){NULL, 0};
}

/* in both, and alike */
static inline int tree_same(const tree *a, const char *path, const tree *b) {
  const tree_entry *one = tree_find(a, path), *two = tree_find(b, path);
  return one && two && one->hash == two->hash;
}

static inline int tree_remove(const char *path) {
  return scratch_remove_at(AT_FDCWD, path);
}

/* as it was before, from a copy; cheap where nothing old was touched */
static inline void tree_restore(const char *folder, tree *before, const char *copy) {
  tree now = tree_of(folder, before);
  int touched = 0;
  char path[700];
  for (int i = 0; i < now.count; i++) {
    if (tree_find(before, now.entry[i].path)) {
      touched |= !tree_same(&now, now.entry[i].path, before);
      continue;
    }
    (void)snprintf(path, sizeof path, "%s/%s", folder, now.entry[i].path);
    (void)tree_remove(path);
  }
  for (int i = 0; i < before->count; i++) touched |= !tree_find(&now, before->entry[i].path);
  tree_free(&now);
  if (!touched) return;
  (void)snprintf(path, sizeof path, "rm -rf '%s' && cp -r '%s' '%s'", folder, copy, folder);
  assert_int_equal(system(path), 0);
  tree_free(before);
  *before = tree_of(folder, NULL);
}

#endif
