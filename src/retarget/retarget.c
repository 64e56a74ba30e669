/* retarget/retarget.c - see ambulo/tools/retarget.h. */
#include "ambulo/tools/retarget.h"

#include "ambulo/tools/load.h"
#include "base/sized.h"
#include "formats/atomic_file.h"
#include "formats/read_file.h"
#include "retarget/retargeting.h"

#include <string.h>

typedef struct job {
  const char *motion, *model_file;
  ambulo_retarget_options options;
  ambulo_allocator allocator;
  ambulo_diagnostics *diagnostics;
  ambulo__yaml *map;
  ambulo__given given;
  ambulo_model *target_model;
  ambulo__figure person, target;
  ambulo__retargeting plan;
} job;

static const char *const files[] = {"problem.yaml", "reference.csv", "model.yaml", "map.yaml",
                                    "source.yaml",  "source.csv",    "result",     "report.html"};
static const ambulo__folder_mark mark = {.file = "problem.yaml",
                                         .text = "# ambulo retarget",
                                         .names = files,
                                         .count = sizeof files / sizeof *files};

/* segments of one body, `role` in the map */
static ambulo_status make_figure(job *j, const ambulo_model *model, const char *role,
                                 ambulo__figure *figure) {
  ambulo__segment_map map;
  const ambulo__yaml_node *table =
      j->map ? ambulo__yaml_get(ambulo__yaml_root(j->map), role) : NULL;
  ambulo__segments_find(model, table, &map);
  ambulo_status status = j->map ? ambulo__yaml_finish(j->map) : AMBULO_OK;
  if (status) return status;
  return ambulo__figure_create(model, &map, role, &j->allocator, j->diagnostics, figure);
}

static ambulo_status read_all(job *j) {
  static const char *const kinds[] = {"retarget_map"};
  ambulo_status status = AMBULO_OK;
  if (j->options.map)
    status = ambulo__yaml_load(j->options.map, &j->allocator, j->diagnostics, &j->map);
  if (!status && j->map) {
    const ambulo__yaml_node *root = ambulo__yaml_root(j->map);
    (void)ambulo__yaml_integer(ambulo__yaml_get(root, "ambulo"), 1, 1, 1);
    (void)ambulo__yaml_choice(ambulo__yaml_get(root, "kind"), kinds, 1, 0);
    ambulo__yaml_expect(root, "source");
    ambulo__yaml_expect(root, "target");
    ambulo__yaml_close(root);
  }
  if (!status)
    status =
        ambulo_model_load(j->model_file, NULL, &j->allocator, j->diagnostics, &j->target_model);
  if (!status)
    status = ambulo__given_read(j->motion, &j->options, &j->allocator, j->diagnostics, &j->given);
  if (!status) status = make_figure(j, j->given.body, "source", &j->person);
  if (!status) status = make_figure(j, j->target_model, "target", &j->target);
  return status;
}

static ambulo_status write_text(ambulo__folder *folder, const char *name, ambulo_status status,
                                const ambulo__text_buffer *text, ambulo_diagnostics *diagnostics) {
  if (!status) status = ambulo__text_status(text);
  if (!status)
    status = ambulo__folder_write(folder, name, ambulo__text_data(text), text->length, diagnostics);
  return status;
}

static void print_map(const job *j, ambulo__text_buffer *text) {
  ambulo__text_append(text, "# ambulo retarget: which coordinates turn which segment\n"
                            "ambulo: 1\nkind: retarget_map\nsource:\n");
  ambulo__segments_print(j->given.body, &j->person.map, text);
  ambulo__text_append(text, "target:\n");
  ambulo__segments_print(j->target_model, &j->target.map, text);
}

/* a skeleton that came with the motion, and how it moves */
static ambulo_status write_source(const job *j, ambulo__folder *folder) {
  const ambulo__given *g = &j->given;
  ambulo__text_buffer text;
  if (!g->own) return AMBULO_OK;
  ambulo_status status = write_text(folder, "source.yaml", AMBULO_OK, &g->text, j->diagnostics);
  ambulo__text_init(&text, &j->allocator);
  ambulo__text_append(&text, "time");
  for (int c = 0; c < g->body->coordinate_count; c++)
    ambulo__text_append_format(&text, ",%s", g->body->coordinates[c].name);
  for (size_t k = 0, d = (size_t)g->body->coordinate_count; k < (size_t)g->rows; k++) {
    ambulo__text_append(&text, "\n");
    ambulo__text_append_number(&text, g->time[k]);
    for (size_t c = 0; c < d; c++) {
      ambulo__text_append(&text, ",");
      ambulo__text_append_number(&text, g->q[k * d + c]);
    }
  }
  ambulo__text_append(&text, "\n");
  status = write_text(folder, "source.csv", status, &text, j->diagnostics);
  ambulo__text_free(&text);
  return status;
}

static ambulo_status copy_model(const job *j, ambulo__folder *folder) {
  char *text = NULL;
  size_t length = 0;
  ambulo_status status = ambulo__read_file(j->model_file, AMBULO__YAML_MAX_BYTES, &j->allocator,
                                           j->diagnostics, &text, &length);
  if (!status) status = ambulo__folder_write(folder, "model.yaml", text, length, j->diagnostics);
  ambulo__free(&j->allocator, text);
  return status;
}

static ambulo_status fill(const job *j, ambulo__folder *folder) {
  ambulo__text_buffer text;
  ambulo__text_init(&text, &j->allocator);
  ambulo__retargeting_problem(&j->plan, j->motion, "model.yaml", &text);
  ambulo_status status = write_text(folder, "problem.yaml", AMBULO_OK, &text, j->diagnostics);
  ambulo__text_clear(&text);
  ambulo__retargeting_reference(&j->plan, &text);
  status = write_text(folder, "reference.csv", status, &text, j->diagnostics);
  ambulo__text_clear(&text);
  print_map(j, &text);
  status = write_text(folder, "map.yaml", status, &text, j->diagnostics);
  if (!status) status = write_source(j, folder);
  if (!status) status = copy_model(j, folder);
  ambulo__text_free(&text);
  return status;
}

static ambulo_status run(job *j, const char *directory) {
  ambulo__folder *folder = NULL;
  ambulo_status status = ambulo__folder_begin(directory, j->options.overwrite ? &mark : NULL,
                                              &j->allocator, j->diagnostics, &folder);
  if (!status) status = read_all(j);
  if (!status)
    status = ambulo__retargeting_make(&j->given, &j->person, &j->target, j->options.times,
                                      j->options.speed, j->diagnostics, &j->plan);
  if (!status) status = fill(j, folder);
  if (!status) return ambulo__folder_commit(folder, j->diagnostics);
  ambulo__folder_abort(folder, j->diagnostics);
  return status;
}

ambulo_status ambulo_retarget_write(const char *motion, const char *model_file,
                                    const char *directory, const ambulo_retarget_options *options,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics) {
  job j = {.motion = motion,
           .model_file = model_file,
           .allocator = ambulo__allocator_or_default(allocator),
           .diagnostics = diagnostics};
  if (!motion || !model_file || !directory) return AMBULO_E_ARGUMENT;
  if (!AMBULO__OWN(ambulo_retarget_options, &j.options, options)) return AMBULO_E_ARGUMENT;
  size_t before = ambulo_diagnostics_count(diagnostics);
  ambulo_status status = run(&j, directory);
  ambulo__retargeting_free(&j.plan);
  ambulo__figure_free(&j.person);
  ambulo__figure_free(&j.target);
  ambulo__given_free(&j.given);
  ambulo_model_free(j.target_model);
  ambulo__yaml_free(j.map);
  return ambulo__conclude(diagnostics, before, status, motion);
}
