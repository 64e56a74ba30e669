/* people/compare_people.c - see compare_people.h. */
#include "people/compare_people.h"

#include <string.h>

#include "formats/paths.h"

static const char *const norm_names[AMBULO__PEOPLE_FILES] = {"young_adults.csv",
                                                             "normal_cadence.csv"};

/* the rest of the first line "# source: ..."; *source stays NULL where there is none */
static ambulo_status find_source(const char *text, const ambulo_allocator *a, char **source) {
  static const char mark[] = "# source: ";
  for (const char *line = text; line && *line == '#';) {
    const char *end = line + strcspn(line, "\r\n");
    size_t length = (size_t)(end - line), skipped = sizeof mark - 1;
    if (length > skipped && memcmp(line, mark, skipped) == 0) {
      *source = ambulo__alloc(a, length - skipped + 1, 1);
      if (!*source) return AMBULO_E_MEMORY;
      memcpy(*source, line + skipped, length - skipped);
      (*source)[length - skipped] = '\0';
      return AMBULO_OK;
    }
    line = end + strspn(end, "\r\n");
  }
  return AMBULO_OK;
}

/* takes over `path` (may be NULL: no memory) */
static ambulo_status read_file(ambulo__people *people, char *path, const char *map,
                               ambulo_diagnostics *diagnostics) {
  const ambulo_allocator *a = &people->allocator;
  ambulo__people_file *file = &people->files[people->count++];
  ambulo__sheet sheet = {.text = NULL};
  ambulo__reference_layout layout = AMBULO__LAYOUT_WIDE;
  int header = 0;
  file->path = path;
  if (!path) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__sheet_read(path, a, diagnostics, &sheet);
  if (!status) status = ambulo__reference_layout_of(&sheet, diagnostics, &layout, &header);
  if (!status)
    status = map ? ambulo__map_read(map, a, diagnostics, &file->map)
                 : ambulo__map_default(layout, a, &file->map);
  if (!status)
    status =
        ambulo__reference_curves(&sheet, layout, header, &file->map, diagnostics, &file->reference);
  if (!status) status = find_source(sheet.text, a, &file->source);
  ambulo__sheet_free(&sheet);
  return status;
}

ambulo_status ambulo__people_read(const char *path, const char *map,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo__people *people) {
  ambulo__people p = {.allocator = ambulo__allocator_or_default(allocator)};
  ambulo_status status = read_file(&p, ambulo__strdup(&p.allocator, path), map, diagnostics);
  if (status) {
    ambulo__people_free(&p);
  } else {
    *people = p;
  }
  return status;
}

static int has_curve(const ambulo__reference *reference, const char *curve) {
  for (int i = 0; i < reference->count; i++) {
    if (strcmp(reference->curves[i].entry->curve, curve) == 0) return 1;
  }
  return 0;
}

/* leaves out of `second` what `first` has */
static void leave_out(const ambulo__reference *first, ambulo__reference *second) {
  int kept = 0;
  for (int i = 0; i < second->count; i++) {
    ambulo__reference_curve curve = second->curves[i];
    if (has_curve(first, curve.entry->curve)) {
      ambulo__reference_curve_free(&second->allocator, &curve);
    } else {
      second->curves[kept++] = curve;
    }
  }
  second->count = kept;
}

ambulo_status ambulo__norms_read(const char *folder, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo__people *people) {
  ambulo__people p = {.allocator = ambulo__allocator_or_default(allocator)};
  ambulo_status status = AMBULO_OK;
  for (int f = 0; !status && f < AMBULO__PEOPLE_FILES; f++)
    status = read_file(&p, ambulo__join_paths(&p.allocator, folder, norm_names[f], NULL), NULL,
                       diagnostics);
  if (status) {
    ambulo__people_free(&p);
    return status;
  }
  leave_out(&p.files[0].reference, &p.files[1].reference);
  *people = p;
  return AMBULO_OK;
}

void ambulo__people_free(ambulo__people *people) {
  for (int f = 0; f < people->count; f++) {
    ambulo__people_file *file = &people->files[f];
    ambulo__reference_free(&file->reference);
    ambulo__map_free(&file->map);
    ambulo__free(&people->allocator, file->source);
    ambulo__free(&people->allocator, file->path);
  }
}
