/* study/case_files.c - see case_files.h. Result folders are flat. */
#include "study/case_files.h"
#include "formats/file_steps.h"
#include "formats/read_file.h"
#include "study/case_path.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static int by_ending(const void *left, const void *right) {
  const ambulo__case_file *a = left, *b = right;
  return strcmp(a->ending, b->ending);
}

int ambulo__case_files_have(const ambulo__case_files *files, const char *ending) {
  for (int i = 0; i < files->count; i++)
    if (strcmp(files->file[i].ending, ending) == 0) return 1;
  return 0;
}

/* ------------------------------------------------------------------- listing */

static ambulo_status add(ambulo__case_files *files, const char *lead, const char *name,
                         const char *path, ambulo_diagnostics *diagnostics) {
  ambulo__place place = {path, 0, 0, NULL};
  if (files->count == AMBULO__CASE_FILES ||
      strlen(lead) + strlen(name) >= sizeof files->file[0].ending)
    return ambulo__error(diagnostics, AMBULO_E_LIMIT, place, NULL,
                         "more or longer names than those of a result folder (got '%.80s')", name);
  ambulo__case_file *file = &files->file[files->count++];
  (void)snprintf(file->ending, sizeof file->ending, "%s%s", lead, name);
  return AMBULO_OK;
}

/* names of the files in the result folder */
static ambulo_status list_folder(const char *path, ambulo__case_files *files,
                                 ambulo_diagnostics *diagnostics, int *result) {
  DIR *stream = opendir(path);
  *result = stream != NULL;
  if (!stream)
    return errno == ENOENT ? AMBULO_OK : ambulo__io_error(diagnostics, path, "read the folder");
  ambulo_status status = AMBULO_OK;
  for (;;) {
    errno = 0;
    const struct dirent *entry = readdir(stream);
    if (!entry || status) break;
    if (entry->d_name[0] != '.') status = add(files, "/", entry->d_name, path, diagnostics);
  }
  if (!status && errno) status = ambulo__io_error(diagnostics, path, "read the folder");
  (void)closedir(stream);
  return status;
}

/* the log, where there is one */
static ambulo_status list_log(const char *path, ambulo__case_files *files,
                              ambulo_diagnostics *diagnostics) {
  struct stat entry;
  if (stat(path, &entry) == 0) return add(files, "", ".log", path, diagnostics);
  return errno == ENOENT ? AMBULO_OK : ambulo__io_error(diagnostics, path, "inspect");
}

ambulo_status ambulo__case_files_list(const char *directory, const char *id,
                                      const ambulo_allocator *a, ambulo_diagnostics *diagnostics,
                                      ambulo__case_files *files, int *result) {
  ambulo__case_files found = {.count = 0};
  char *folder = ambulo__case_path(a, directory, id, "");
  char *log = ambulo__case_path(a, directory, id, ".log");
  ambulo_status status = folder && log ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = list_folder(folder, &found, diagnostics, result);
  if (!status) status = list_log(log, &found, diagnostics);
  ambulo__free(a, folder);
  ambulo__free(a, log);
  for (int i = 0; i < found.count && !status; i++) {
    char *path = ambulo__case_path(a, directory, id, found.file[i].ending);
    status = path ? ambulo__digest_file(path, diagnostics, found.file[i].digest) : AMBULO_E_MEMORY;
    ambulo__free(a, path);
  }
  qsort(found.file, (size_t)found.count, sizeof found.file[0], by_ending);
  if (!status) *files = found;
  return status;
}

/* ------------------------------------------------------------------ checking */

ambulo_status ambulo__damage_of(ambulo_status status, const char *ending,
                                const ambulo_diagnostics *reasons, ambulo__damage *damage) {
  if (status == AMBULO_OK || status == AMBULO_E_MEMORY) return status;
  const ambulo_diagnostic *first = ambulo_diagnostics_get(reasons, 0);
  (void)snprintf(damage->ending, sizeof damage->ending, "%s", ending);
  (void)snprintf(damage->what, sizeof damage->what, "%s",
                 first ? first->message : ambulo_status_text(status));
  return AMBULO_OK;
}

static ambulo_status check_one(const char *path, const ambulo__case_file *file,
                               ambulo_diagnostics *reasons, int *intact, ambulo__damage *damage) {
  char digest[AMBULO__SHA256_TEXT];
  ambulo_status status = ambulo__digest_file(path, reasons, digest);
  *intact = !status && strcmp(digest, file->digest) == 0;
  if (status) return ambulo__damage_of(status, file->ending, reasons, damage);
  if (*intact) return AMBULO_OK;
  (void)snprintf(damage->ending, sizeof damage->ending, "%s", file->ending);
  (void)snprintf(damage->what, sizeof damage->what, "is not what was written");
  return AMBULO_OK;
}

ambulo_status ambulo__case_files_check(const char *directory, const char *id,
                                       const ambulo__case_files *files, const ambulo_allocator *a,
                                       int *intact, ambulo__damage *damage) {
  ambulo_diagnostics *reasons = ambulo_diagnostics_create(a);
  ambulo_status status = reasons ? AMBULO_OK : AMBULO_E_MEMORY;
  int good = 1;
  for (int i = 0; i < files->count && good && !status; i++) {
    char *path = ambulo__case_path(a, directory, id, files->file[i].ending);
    status = path ? check_one(path, &files->file[i], reasons, &good, damage) : AMBULO_E_MEMORY;
    ambulo__free(a, path);
  }
  ambulo_diagnostics_free(reasons);
  if (!status) *intact = good;
  return status;
}
