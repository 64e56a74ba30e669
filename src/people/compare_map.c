/* people/compare_map.c - the column map: built in for three published layouts, or from a file.
 *
 * Signs. Results: hip flexion, hip adduction, knee flexion and dorsiflexion are positive, and so
 * are the torques that cause them. References: extension and plantarflexion moments are
 * positive. Pelvis angles are those of the side that strikes: with x forward, y up, z right, a
 * positive list lowers the right side and a positive rotation brings the right side forward.
 * Bending of the trunk is positive to the right, its moment to the side that strikes; the medial
 * force on the left foot points to the right.
 */
#include "people/compare.h"

#include <string.h>

/* curve, reference, result, factor, opposite, tilted, unit, lag, by_body */
static const ambulo__map_entry band[] = {
    {"pelvis_anterior_tilt", "pelvic_tilt", "q.pelvis_tilt", -1, 0, 1, AMBULO__UNIT_ANGLE, 0, 1},
    {"pelvis_up_obliquity", "pelvic_obliquity", "q.pelvis_list", 1, 1, 0, AMBULO__UNIT_ANGLE, 0, 1},
    {"pelvis_internal_rotation", "pelvic_rotation", "q.pelvis_rotation", -1, 1, 0,
     AMBULO__UNIT_ANGLE, 0, 1},
    {"hip_flexion", "hip_flexion", "q.hip_flexion_{side}", 1, 0, 1, AMBULO__UNIT_ANGLE, 0, 1},
    {"hip_adduction", "hip_adduction", "q.hip_adduction_{side}", 1, 0, 0, AMBULO__UNIT_ANGLE, 0, 1},
    {"hip_internal_rotation", "hip_rotation", "q.hip_rotation_{side}", 1, 0, 0, AMBULO__UNIT_ANGLE,
     0, 1},
    {"knee_flexion", "knee_flexion", "q.knee_angle_{side}", 1, 0, 0, AMBULO__UNIT_ANGLE, 0, 1},
    {"ankle_dorsiflexion", "ankle_dorsiflexion", "q.ankle_angle_{side}", 1, 0, 0,
     AMBULO__UNIT_ANGLE, 0, 1},
};

static const ambulo__map_entry quantity[] = {
    {"pelvis_anterior_tilt", "angle_deg/pelvis_anterior_tilt", "q.pelvis_tilt", -1, 0, 1,
     AMBULO__UNIT_ANGLE, 0, 1},
    {"pelvis_up_obliquity", "angle_deg/pelvis_up_obliquity", "q.pelvis_list", 1, 1, 0,
     AMBULO__UNIT_ANGLE, 0, 1},
    {"pelvis_internal_rotation", "angle_deg/pelvis_internal_rotation", "q.pelvis_rotation", -1, 1,
     0, AMBULO__UNIT_ANGLE, 0, 1},
    {"hip_flexion", "angle_deg/hip_flexion", "q.hip_flexion_{side}", 1, 0, 1, AMBULO__UNIT_ANGLE, 0,
     1},
    {"hip_adduction", "angle_deg/hip_adduction", "q.hip_adduction_{side}", 1, 0, 0,
     AMBULO__UNIT_ANGLE, 0, 1},
    {"hip_internal_rotation", "angle_deg/hip_internal_rotation", "q.hip_rotation_{side}", 1, 0, 0,
     AMBULO__UNIT_ANGLE, 0, 1},
    {"knee_flexion", "angle_deg/knee_flexion", "q.knee_angle_{side}", 1, 0, 0, AMBULO__UNIT_ANGLE,
     0, 1},
    {"ankle_dorsiflexion", "angle_deg/ankle_dorsiflexion", "q.ankle_angle_{side}", 1, 0, 0,
     AMBULO__UNIT_ANGLE, 0, 1},
    {"hip_extension_moment", "moment_nm_per_kg/hip_extension", "tau.hip_flexion_{side}", -1, 0, 0,
     AMBULO__UNIT_MOMENT, 0, 1},
    {"hip_abduction_moment", "moment_nm_per_kg/hip_abduction", "tau.hip_adduction_{side}", -1, 0, 0,
     AMBULO__UNIT_MOMENT, 0, 1},
    {"knee_extension_moment", "moment_nm_per_kg/knee_extension", "tau.knee_angle_{side}", -1, 0, 0,
     AMBULO__UNIT_MOMENT, 0, 1},
    {"ankle_plantarflexion_moment", "moment_nm_per_kg/ankle_plantarflexion",
     "tau.ankle_angle_{side}", -1, 0, 0, AMBULO__UNIT_MOMENT, 0, 1},
    {"hip_power", "power_w_per_kg/hip",
     "power.hip_flexion_{side}+power.hip_adduction_{side}+power.hip_rotation_{side}", 1, 0, 0,
     AMBULO__UNIT_POWER, 0, 1},
    {"knee_power", "power_w_per_kg/knee", "power.knee_angle_{side}", 1, 0, 0, AMBULO__UNIT_POWER, 0,
     1},
    {"ankle_power", "power_w_per_kg/ankle", "power.ankle_angle_{side}+power.subtalar_angle_{side}",
     1, 0, 0, AMBULO__UNIT_POWER, 0, 1},
};

/* the hip angle of this table is that of the thigh against the trunk: no pelvic tilt */
static const ambulo__map_entry wide[] = {
    {"hip_flexion", "hip angle", "q.hip_flexion_{side}", 1, 0, 0, AMBULO__UNIT_ANGLE, 0, 1},
    {"knee_flexion", "knee angle", "q.knee_angle_{side}", 1, 0, 0, AMBULO__UNIT_ANGLE, 0, 1},
    {"ankle_dorsiflexion", "ankle angle", "q.ankle_angle_{side}", 1, 0, 0, AMBULO__UNIT_ANGLE, 0,
     1},
    {"grf_forward", "horizontal GRF", "grf.{foot}.forward", 1, 0, 0, AMBULO__UNIT_FORCE, 0, 1},
    {"grf_vertical", "vertical GRF", "grf.{foot}.up", 1, 0, 0, AMBULO__UNIT_FORCE, 0, 1},
    {"hip_extension_moment", "hip moment", "tau.hip_flexion_{side}", -1, 0, 0, AMBULO__UNIT_MOMENT,
     0, 1},
    {"knee_extension_moment", "knee moment", "tau.knee_angle_{side}", -1, 0, 0, AMBULO__UNIT_MOMENT,
     0, 1},
    {"ankle_plantarflexion_moment", "ankle moment", "tau.ankle_angle_{side}", -1, 0, 0,
     AMBULO__UNIT_MOMENT, 0, 1},
};

/* curves that no published layout has; a table of cycles names its columns as the curves */
static const ambulo__map_entry others[] = {
    {"grf_forward", "grf_forward", "grf.{foot}.forward", 1, 0, 0, AMBULO__UNIT_FORCE, 0, 1},
    {"grf_vertical", "grf_vertical", "grf.{foot}.up", 1, 0, 0, AMBULO__UNIT_FORCE, 0, 1},
    {"grf_medial", "grf_medial", "grf.{foot}.right", 1, 1, 0, AMBULO__UNIT_FORCE, 0, 1},
    {"mtp_extension", "mtp_extension", "q.mtp_angle_{side}", 1, 0, 0, AMBULO__UNIT_ANGLE, 0, 1},
    {"lumbar_extension_moment", "lumbar_extension_moment", "tau.lumbar_extension", 1, 0, 0,
     AMBULO__UNIT_MOMENT, 0, 1},
    {"lumbar_bending_moment", "lumbar_bending_moment", "tau.lumbar_bending", -1, 1, 0,
     AMBULO__UNIT_MOMENT, 0, 1},
};
enum {
  OWN_COUNT = sizeof quantity / sizeof *quantity,
  OTHER_COUNT = sizeof others / sizeof *others
};

static void add_own_names(ambulo__map *map) {
  ambulo__map_entry *to = map->entries + map->count;
  memcpy(to, quantity, sizeof quantity);
  for (int i = 0; i < OWN_COUNT; i++) memcpy(to[i].reference, to[i].curve, sizeof to[i].curve);
  memcpy(to + OWN_COUNT, others, sizeof others);
  map->count += OWN_COUNT + OTHER_COUNT;
}

static const struct {
  const ambulo__map_entry *entries;
  size_t count;
} builtin[] = {
    [AMBULO__LAYOUT_BAND] = {band, sizeof band / sizeof *band},
    [AMBULO__LAYOUT_QUANTITY] = {quantity, sizeof quantity / sizeof *quantity},
    [AMBULO__LAYOUT_WIDE] = {wide, sizeof wide / sizeof *wide},
};

static const char *const unit_names[] = {"deg", "N m/kg", "N/kg", "W/kg", "BW", "1"};
enum { UNIT_COUNT = sizeof unit_names / sizeof *unit_names };

const char *ambulo__curve_unit_name(ambulo__curve_unit unit) {
  return unit_names[unit];
}

ambulo_status ambulo__map_default(ambulo__reference_layout layout,
                                  const ambulo_allocator *allocator, ambulo__map *map) {
  ambulo__map m = {.allocator = ambulo__allocator_or_default(allocator),
                   .count = (int)builtin[layout].count};
  size_t room = builtin[layout].count + OWN_COUNT + OTHER_COUNT;
  m.entries = ambulo__alloc(&m.allocator, room, sizeof *m.entries);
  if (!m.entries) return AMBULO_E_MEMORY;
  memcpy(m.entries, builtin[layout].entries, builtin[layout].count * sizeof *m.entries);
  if (layout == AMBULO__LAYOUT_WIDE) add_own_names(&m);
  *map = m;
  return AMBULO_OK;
}

void ambulo__map_free(ambulo__map *map) {
  ambulo__free(&map->allocator, map->entries);
}

const ambulo__map_entry *ambulo__map_find(const ambulo__map *map, const char *curve) {
  const ambulo__map_entry *first = NULL;
  for (int i = map->count - 1; i >= 0; i--) {
    const ambulo__map_entry *entry = &map->entries[i];
    if (strcmp(entry->curve, curve) != 0) continue;
    if (strcmp(entry->reference, curve) == 0) return entry;
    first = entry;
  }
  return first;
}

/* ---------------------------------------------------------------- from a file */

typedef struct map_columns {
  int curve, reference, result, unit;    /* required */
  int factor, right_factor, tilted, lag; /* -1: not given */
} map_columns;

typedef struct map_reader {
  const ambulo__sheet *sheet;
  ambulo_diagnostics *diagnostics;
  map_columns at;
  ambulo_status status;
} map_reader;

static void read_text(map_reader *reader, int line, int column, const char *what, char *to,
                      size_t size) {
  const ambulo__table_cell *cell = ambulo__sheet_cell(reader->sheet, line, column);
  if (cell && cell->length > 0 && cell->length < size) {
    memcpy(to, cell->start, cell->length);
    to[cell->length] = '\0';
    return;
  }
  reader->status = ambulo__error(
      reader->diagnostics, AMBULO_E_SCHEMA, ambulo__sheet_place(reader->sheet, line, column), NULL,
      "%s has %zu characters; expected 1 to %zu", what, cell ? cell->length : 0, size - 1);
}

static void read_optional(map_reader *reader, int line, int column, const char *what,
                          double *value) {
  const ambulo__table_cell *cell = ambulo__sheet_cell(reader->sheet, line, column);
  if (!cell || cell->length == 0) return;
  ambulo_status status =
      ambulo__sheet_number(reader->sheet, line, column, what, reader->diagnostics, value);
  if (status) reader->status = status;
}

static void read_unit(map_reader *reader, int line, ambulo__map_entry *entry) {
  const ambulo__table_cell *cell = ambulo__sheet_cell(reader->sheet, line, reader->at.unit);
  for (int i = 0; i < UNIT_COUNT; i++) {
    if (!ambulo__cell_is(cell, unit_names[i])) continue;
    entry->unit = (ambulo__curve_unit)i;
    return;
  }
  reader->status = ambulo__error(reader->diagnostics, AMBULO_E_SCHEMA,
                                 ambulo__sheet_place(reader->sheet, line, reader->at.unit), NULL,
                                 "unknown unit; expected deg, N m/kg, N/kg, W/kg, BW or 1");
}

static void read_entry(map_reader *reader, int line, ambulo__map_entry *entry) {
  double tilted = 0.0, right;
  read_text(reader, line, reader->at.curve, "the curve's name", entry->curve, sizeof entry->curve);
  read_text(reader, line, reader->at.reference, "the reference", entry->reference,
            sizeof entry->reference);
  read_text(reader, line, reader->at.result, "the result's column", entry->result,
            sizeof entry->result);
  read_unit(reader, line, entry);
  entry->factor = 1.0;
  read_optional(reader, line, reader->at.factor, "factor", &entry->factor);
  right = entry->factor;
  read_optional(reader, line, reader->at.right_factor, "right_factor", &right);
  read_optional(reader, line, reader->at.tilted, "tilted", &tilted);
  read_optional(reader, line, reader->at.lag, "lag", &entry->lag);
  if ((right != entry->factor && right != -entry->factor) || (tilted != 0.0 && tilted != 1.0)) {
    reader->status = ambulo__error(
        reader->diagnostics, AMBULO_E_SCHEMA, ambulo__sheet_place(reader->sheet, line, 0), NULL,
        "right_factor %g, tilted %g; expected plus or minus the factor, and 0 or 1", right, tilted);
  }
  entry->opposite = right != entry->factor;
  entry->tilted = tilted == 1.0;
}

static ambulo_status find_columns(map_reader *reader) {
  const struct {
    const char *name;
    int *at;
    int required;
  } columns[] = {
      {"curve", &reader->at.curve, 1},   {"reference", &reader->at.reference, 1},
      {"result", &reader->at.result, 1}, {"unit", &reader->at.unit, 1},
      {"factor", &reader->at.factor, 0}, {"right_factor", &reader->at.right_factor, 0},
      {"tilted", &reader->at.tilted, 0}, {"lag", &reader->at.lag, 0},
  };
  for (size_t i = 0; i < sizeof columns / sizeof *columns; i++) {
    *columns[i].at = ambulo__sheet_find(reader->sheet, 0, columns[i].name);
    if (*columns[i].at >= 0 || !columns[i].required) continue;
    return ambulo__error(
        reader->diagnostics, AMBULO_E_SCHEMA, ambulo__sheet_place(reader->sheet, 0, 0), NULL,
        "no column '%s'; a column map needs curve, reference, result and unit", columns[i].name);
  }
  return AMBULO_OK;
}

ambulo_status ambulo__map_read(const char *path, const ambulo_allocator *allocator,
                               ambulo_diagnostics *diagnostics, ambulo__map *map) {
  ambulo__sheet sheet;
  ambulo_status status = ambulo__sheet_read(path, allocator, diagnostics, &sheet);
  if (status) return status;
  ambulo__map m = {.allocator = sheet.allocator, .count = sheet.line_count - 1};
  map_reader reader = {.sheet = &sheet, .diagnostics = diagnostics};
  reader.status = find_columns(&reader);
  if (!reader.status) {
    m.entries = ambulo__alloc(&m.allocator, (size_t)m.count, sizeof *m.entries);
    if (!m.entries) reader.status = AMBULO_E_MEMORY;
  }
  for (int i = 0; m.entries && i < m.count; i++) read_entry(&reader, i + 1, &m.entries[i]);
  ambulo__sheet_free(&sheet);
  if (reader.status) {
    ambulo__map_free(&m);
  } else {
    *map = m;
  }
  return reader.status;
}
