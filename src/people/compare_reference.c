/* people/compare_reference.c - reading the three layouts of normative curves.
 *
 * Long layouts have one line a point and name the curve in it ("hip_flexion", or
 * "angle_deg/hip_flexion" from two columns). The wide one has a column a curve; lines above its
 * header are remarks, a line of units may follow it, and a column "NAME sd" holds deviations. */
#include "people/compare.h"

#include "formats/paths.h"

#include <stdio.h>
#include <string.h>

enum { HEADER_LINES = 12, FEWEST = 3 };

/* ------------------------------------------------------------------- layout */

static const char *const percent_names[] = {"percent", "%gait cycle", "% gait cycle", "% cycle"};

static int percent_column(const ambulo__sheet *sheet, int line) {
  for (size_t i = 0; i < sizeof percent_names / sizeof *percent_names; i++) {
    int column = ambulo__sheet_find(sheet, line, percent_names[i]);
    if (column >= 0) return column;
  }
  return -1;
}

static int has_columns(const ambulo__sheet *sheet, int line, const char *const *names, int count) {
  for (int i = 0; i < count; i++) {
    if (ambulo__sheet_find(sheet, line, names[i]) < 0) return 0;
  }
  return 1;
}

ambulo_status ambulo__reference_layout_of(const ambulo__sheet *sheet,
                                          ambulo_diagnostics *diagnostics,
                                          ambulo__reference_layout *layout, int *header) {
  static const char *const band[] = {"variable", "percent", "mean_deg", "sd_deg"};
  static const char *const quantity[] = {"quantity", "variable", "percent", "mean", "sd"};
  for (int line = 0; line < sheet->line_count && line < HEADER_LINES; line++) {
    if (has_columns(sheet, line, quantity, 5)) {
      *layout = AMBULO__LAYOUT_QUANTITY;
    } else if (has_columns(sheet, line, band, 4)) {
      *layout = AMBULO__LAYOUT_BAND;
    } else if (percent_column(sheet, line) >= 0) {
      *layout = AMBULO__LAYOUT_WIDE;
    } else {
      continue;
    }
    *header = line;
    return AMBULO_OK;
  }
  return ambulo__error(diagnostics, AMBULO_E_SCHEMA, ambulo__sheet_place(sheet, 0, 0),
                       "docs/compare.md lists the layouts",
                       "no header of a known layout in the first %d lines; expected the columns "
                       "variable,percent,mean_deg,sd_deg or quantity,variable,percent,mean,sd or "
                       "'percent' with one column a curve",
                       HEADER_LINES);
}

/* ------------------------------------------------------------------- curves */

typedef struct curve_reader {
  const ambulo__sheet *sheet;
  ambulo_diagnostics *diagnostics;
  const ambulo_allocator *allocator;
  ambulo__reference_layout layout;
  int header, percent, mean, sd, variable, quantity; /* columns; -1: none */
} curve_reader;

static int belongs(const curve_reader *r, int line, const ambulo__map_entry *entry) {
  const ambulo__table_cell *variable = ambulo__sheet_cell(r->sheet, line, r->variable);
  if (r->layout == AMBULO__LAYOUT_WIDE) return 1;
  if (r->layout == AMBULO__LAYOUT_BAND) return ambulo__cell_is(variable, entry->reference);
  const char *slash = strchr(entry->reference, '/');
  const ambulo__table_cell *quantity = ambulo__sheet_cell(r->sheet, line, r->quantity);
  if (!slash || !quantity || quantity->length != (size_t)(slash - entry->reference)) return 0;
  return memcmp(quantity->start, entry->reference, quantity->length) == 0 &&
         ambulo__cell_is(variable, slash + 1);
}

/* first line with data: a line of units has no percent */
static int first_line(const curve_reader *r) {
  int line = r->header + 1;
  const ambulo__table_cell *cell = ambulo__sheet_cell(r->sheet, line, r->percent);
  return r->layout == AMBULO__LAYOUT_WIDE && (!cell || cell->length == 0) ? line + 1 : line;
}

static ambulo_status read_point(const curve_reader *r, int line, ambulo__reference_curve *c) {
  int i = c->points;
  ambulo_status status = ambulo__sheet_number(r->sheet, line, r->percent, "the percent",
                                              r->diagnostics, &c->percent[i]);
  if (!status)
    status = ambulo__sheet_number(r->sheet, line, r->mean, "the mean", r->diagnostics, &c->mean[i]);
  if (!status && c->sd)
    status =
        ambulo__sheet_number(r->sheet, line, r->sd, "the deviation", r->diagnostics, &c->sd[i]);
  if (status) return status;
  if (c->sd && c->sd[i] < 0.0)
    return ambulo__error(r->diagnostics, AMBULO_E_SCHEMA,
                         ambulo__sheet_place(r->sheet, line, r->sd), NULL,
                         "the deviation is %g; expected at least 0", c->sd[i]);
  double above = i > 0 ? c->percent[i - 1] : -1.0;
  if (c->percent[i] < 0.0 || c->percent[i] > 100.0 || c->percent[i] <= above)
    return ambulo__error(r->diagnostics, AMBULO_E_SCHEMA,
                         ambulo__sheet_place(r->sheet, line, r->percent), NULL,
                         "percent %g of '%s'; expected rising values from 0 to 100", c->percent[i],
                         c->entry->reference);
  c->points++;
  return AMBULO_OK;
}

void ambulo__reference_curve_free(const ambulo_allocator *a, ambulo__reference_curve *c) {
  ambulo__free(a, c->percent);
  ambulo__free(a, c->mean);
  ambulo__free(a, c->sd);
}

/* a curve without points where the sheet does not have it */
static ambulo_status read_curve(curve_reader *r, const ambulo__map_entry *entry,
                                ambulo__reference_curve *curve) {
  ambulo__reference_curve c = {.entry = entry};
  *curve = c;
  if (r->layout == AMBULO__LAYOUT_WIDE) {
    char deviation[AMBULO__CURVE_NAME + 4];
    snprintf(deviation, sizeof deviation, "%s sd", entry->reference);
    ambulo_status status =
        ambulo__sheet_find_one(r->sheet, r->header, entry->reference, r->diagnostics, &r->mean);
    if (!status)
      status = ambulo__sheet_find_one(r->sheet, r->header, deviation, r->diagnostics, &r->sd);
    if (status) return status;
  }
  if (r->mean < 0) return AMBULO_OK;
  int lines = 0;
  for (int line = first_line(r); line < r->sheet->line_count; line++) {
    lines += belongs(r, line, entry);
  }
  if (lines == 0) return AMBULO_OK;
  c.percent = ambulo__alloc(r->allocator, (size_t)lines, sizeof *c.percent);
  c.mean = ambulo__alloc(r->allocator, (size_t)lines, sizeof *c.mean);
  if (r->sd >= 0) c.sd = ambulo__alloc(r->allocator, (size_t)lines, sizeof *c.sd);
  int failed = !c.percent || !c.mean || (r->sd >= 0 && !c.sd);
  ambulo_status status = failed ? AMBULO_E_MEMORY : AMBULO_OK;
  for (int line = first_line(r); !status && line < r->sheet->line_count; line++) {
    if (belongs(r, line, entry)) status = read_point(r, line, &c);
  }
  if (!status && c.points < FEWEST)
    status = ambulo__error(
        r->diagnostics, AMBULO_E_SCHEMA, ambulo__sheet_place(r->sheet, r->header, 0), NULL,
        "'%s' has %d points; expected at least %d", entry->reference, c.points, FEWEST);
  if (status) {
    ambulo__reference_curve_free(r->allocator, &c);
    return status;
  }
  *curve = c;
  return AMBULO_OK;
}

static int has_curve(const ambulo__reference *reference, const char *curve) {
  for (int i = 0; i < reference->count; i++) {
    if (strcmp(reference->curves[i].entry->curve, curve) == 0) return 1;
  }
  return 0;
}

ambulo_status ambulo__reference_curves(const ambulo__sheet *sheet, ambulo__reference_layout layout,
                                       int header, const ambulo__map *map,
                                       ambulo_diagnostics *diagnostics,
                                       ambulo__reference *reference) {
  ambulo__reference f = {.allocator = sheet->allocator};
  curve_reader r = {.sheet = sheet,
                    .diagnostics = diagnostics,
                    .allocator = &f.allocator,
                    .layout = layout,
                    .header = header,
                    .percent = percent_column(sheet, header),
                    .variable = ambulo__sheet_find(sheet, header, "variable"),
                    .quantity = ambulo__sheet_find(sheet, header, "quantity")};
  int is_band = layout == AMBULO__LAYOUT_BAND;
  r.mean = ambulo__sheet_find(sheet, header, is_band ? "mean_deg" : "mean");
  r.sd = ambulo__sheet_find(sheet, header, is_band ? "sd_deg" : "sd");
  f.curves = ambulo__alloc(&f.allocator, (size_t)map->count, sizeof *f.curves);
  if (!f.curves) return AMBULO_E_MEMORY;
  ambulo_status status = AMBULO_OK;
  for (int i = 0; !status && i < map->count; i++) {
    if (has_curve(&f, map->entries[i].curve)) continue; /* a table has it under one name */
    status = read_curve(&r, &map->entries[i], &f.curves[f.count]);
    if (!status && f.curves[f.count].points > 0) f.count++;
  }
  if (!status && f.count == 0)
    status = ambulo__error(diagnostics, AMBULO_E_SCHEMA, ambulo__sheet_place(sheet, header, 0),
                           "a column map names the curves of another file: --map FILE",
                           "no curve of the column map is in this file; expected for example '%s'",
                           map->count ? map->entries[0].reference : "");
  if (status) {
    ambulo__reference_free(&f);
  } else {
    *reference = f;
  }
  return status;
}

void ambulo__reference_free(ambulo__reference *reference) {
  for (int i = 0; i < reference->count; i++)
    ambulo__reference_curve_free(&reference->allocator, &reference->curves[i]);
  ambulo__free(&reference->allocator, reference->curves);
}

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

static int compare_people_has_curve(const ambulo__reference *reference, const char *curve) {
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
    if (compare_people_has_curve(first, curve.entry->curve)) {
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
