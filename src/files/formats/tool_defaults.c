/* formats/tool_defaults.c - what the tools have in common: the defaults of their structures, one
 * row each; texts that are handed out. */
#include "ambulo/tools/tools.h"
#include "base/alloc.h"
#include "base/sized.h"

#include <math.h>

/* `sizes`: how many members at the beginning are sizes */
#define ROW(type, sizes, ...)                                                                      \
  { #type, &(const type)__VA_ARGS__, sizeof(type), sizes }

static const ambulo__usual rows[] = {
    ROW(ambulo_subject, 1, {.mass = AMBULO_OFF, .stature = AMBULO_OFF}),
    ROW(ambulo_problem_text, 1, {0}),
    ROW(ambulo_report_options, 1, {0}),
    ROW(ambulo_picture_options, 1, {.millimetres = AMBULO_OFF, .dots_per_inch = 300.0}),
    ROW(ambulo_film_options, 1, {.rate = AMBULO_OFF, .speed = 1.0, .times = 2}),
    ROW(ambulo_page_options, 1, {.from = -INFINITY, .to = INFINITY, .megabytes = 3.0}),
    ROW(ambulo_compare_options, 1,
        {.pelvic_tilt = 0.19896753472735357, /* 11.4 degrees */
         .strike = AMBULO_OFF,
         .mass = AMBULO_OFF}),
    ROW(ambulo_inverse_options, 1,
        {.length_unit = 1.0,
         .time_unit = 1.0,
         .force_length_unit = 1.0,
         .force_time_unit = 1.0,
         .cutoff = AMBULO_OFF,
         .force_cutoff = AMBULO_OFF,
         .from = AMBULO_OFF,
         .to = AMBULO_OFF,
         .filter_order = 4}),
    ROW(ambulo_inverse_outputs, 1, {0}),
    ROW(ambulo_muscle_options, 1,
        {.activation = 1.0, .reserve = 0.2, .by_volume = 1, .resting_power = 1.2}),
    ROW(ambulo_batch_options, 1,
        {.shard = 1, .shards = 1, .case_seconds = AMBULO_OFF, .grace = 30.0}),
    ROW(ambulo_fit_options, 1, {.case_seconds = AMBULO_OFF, .grace = 30.0}),
    ROW(ambulo_import_options, 1, {0}),
    ROW(ambulo_walk_options, 1, {.speed = AMBULO_OFF, .step_length = AMBULO_OFF}),
    ROW(ambulo_retarget_options, 1, {.from = -INFINITY, .to = INFINITY}),
    ROW(ambulo_export_options, 1, {.format = AMBULO_EXPORT_OPENSIM}),
};

ambulo_status ambulo_tool_defaults(const char *name, void *structure, size_t bytes) {
  return ambulo__defaults_of(rows, (int)(sizeof rows / sizeof *rows), name, structure, bytes);
}

void ambulo_text_free(char *text, const ambulo_allocator *allocator) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__free(&own, text);
}
