/* study/batch_clean.c - see clean.h. Result folders are flat, so removing takes one level. */
#include "study/batch_clean.h"
#include "formats/paths.h"
#include "study/case_path.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static void remove_flat(int parent, const char *name) {
  if (unlinkat(parent, name, 0) == 0) return;
  int file = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  DIR *stream = file >= 0 ? fdopendir(file) : NULL;
  if (file >= 0 && !stream) close(file);
  if (stream) {
    for (struct dirent *e = readdir(stream); e; e = readdir(stream)) {
      if (e->d_name[0] != '.') (void)unlinkat(file, e->d_name, 0);
    }
    closedir(stream);
  }
  (void)unlinkat(parent, name, AT_REMOVEDIR);
}

void ambulo__clean_case(const char *directory, const char *id, long process,
                        const ambulo_allocator *a) {
  static const char *const kinds[] = {".tmp", ".old"};
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    char ending[48];
    (void)snprintf(ending, sizeof ending, "%s-%ld-0", kinds[i], process);
    char *path = ambulo__case_path(a, directory, id, ending);
    if (path) remove_flat(AT_FDCWD, path);
    ambulo__free(a, path);
  }
}

ambulo_status ambulo__clean_result(const char *directory, const char *id,
                                   const ambulo_allocator *a) {
  char *path = ambulo__case_path(a, directory, id, "");
  if (!path) return AMBULO_E_MEMORY;
  remove_flat(AT_FDCWD, path);
  ambulo__free(a, path);
  return AMBULO_OK;
}

static void clean_fan(const char *path) {
  DIR *stream = opendir(path);
  if (!stream) return;
  for (struct dirent *e = readdir(stream); e; e = readdir(stream)) {
    if (strstr(e->d_name, ".tmp-") || strstr(e->d_name, ".old-"))
      remove_flat(dirfd(stream), e->d_name);
  }
  closedir(stream);
}

void ambulo__clean_all(const char *directory, const ambulo_allocator *a) {
  char *cases = ambulo__join_paths(a, directory, "cases", NULL);
  DIR *stream = cases ? opendir(cases) : NULL;
  for (struct dirent *e = stream ? readdir(stream) : NULL; e; e = readdir(stream)) {
    if (e->d_name[0] == '.') continue;
    char *fan = ambulo__join_paths(a, cases, e->d_name, NULL);
    if (fan) clean_fan(fan);
    ambulo__free(a, fan);
  }
  if (stream) closedir(stream);
  ambulo__free(a, cases);
  clean_fan(directory);
}
