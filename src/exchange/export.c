/* exchange/export.c - ambulo_export: a model and a motion for another program.
 */
#include "ambulo/tools/export.h"
#include "base/sized.h"
#include "exchange/export.h"
#include "formats/atomic_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ------------------------------------------------------- motion for OpenSim's tools */

/* Beside the model:
 *
 *   motion.mot           coordinates, in degrees and metres
 *   grf.mot              of each load: force, its point and its torque there, in the
 *                        ground's axes
 *   external_loads.xml   which columns act on which body
 *
 * World and ground differ by a turn W about the origin: vectors are W v.
 */

static const double degree = 180.0 / 3.14159265358979323846;

static void header(ambulo__text_buffer *text, const char *name, int rows, int columns,
                   int in_degrees) {
  ambulo__text_append(text, name);
  ambulo__text_append_format(text,
                             "\nversion=1\nnRows=%d\nnColumns=%d\ninDegrees=%s\nendheader\ntime",
                             rows, columns, in_degrees ? "yes" : "no");
}

static void cell(ambulo__text_buffer *text, double value) {
  ambulo__text_append_char(text, '\t');
  ambulo__text_append_number(text, value == 0.0 ? 0.0 : value);
}

/* For each joint that follows elsewhere: its name (q NULL), or where it stands. Returns how many.
 */
static int print_followers(const ambulo__bodies *bodies, const double *q,
                           ambulo__text_buffer *text) {
  const ambulo_model *model = bodies->model;
  int count = 0;
  for (int b = 0; b < bodies->count; b++) {
    const ambulo__export_body *body = &bodies->list[b];
    for (int i = 0; i < body->joints; i++) {
      if (!ambulo__follows_elsewhere(body, model, i)) continue;
      count++;
      if (!text) continue;
      double unit = model->links[body->link_of[i]].type == AMBULO_REVOLUTE ? degree : 1.0;
      if (q) cell(text, unit * ambulo__joint_value(model, body->link_of[i], q, NULL));
      if (!q) ambulo__text_append_char(text, '\t');
      if (!q) ambulo__mover_name(body, model, i, text);
    }
  }
  return count;
}

static void print_motion(const ambulo__bodies *bodies, const ambulo__source *source,
                         ambulo__text_buffer *text) {
  const ambulo_coordinate *coordinates = bodies->model->coordinates;
  int d = source->coordinates;
  header(text, source->name, source->rows, d + 1 + print_followers(bodies, NULL, NULL), 1);
  for (int i = 0; i < d; i++) {
    ambulo__text_append_char(text, '\t');
    ambulo__text_append(text, coordinates[i].name);
  }
  (void)print_followers(bodies, NULL, text);
  ambulo__text_append_char(text, '\n');
  for (int k = 0; k < source->rows; k++) {
    const double *q = source->q + (size_t)k * (size_t)d;
    ambulo__text_append_number(text, source->time[k]);
    for (int i = 0; i < d; i++)
      cell(text, coordinates[i].type == AMBULO_REVOLUTE ? q[i] * degree : q[i] + bodies->offset[i]);
    (void)print_followers(bodies, q, text);
    ambulo__text_append_char(text, '\n');
  }
}

/* columns of a load are called force_NAME_v., force_NAME_p., torque_NAME_., behind this */
static const char *prefix_of(const ambulo__export_load *load) {
  return load->kind == AMBULO__LOAD_DEVICE ? "" : "ground_";
}

/* on a body that moves */
static int acts(const ambulo__export_load *load) {
  return load->body >= 0;
}

static void print_forces(const ambulo__bodies *bodies, const double *time,
                         const ambulo__loads *loads, ambulo__text_buffer *text) {
  int count = 0;
  for (int i = 0; i < loads->count; i++) count += acts(&loads->list[i]);
  header(text, "grf", loads->rows, 9 * count + 1, 0);
  for (int i = 0; i < loads->count; i++) {
    const ambulo__export_load *load = &loads->list[i];
    for (int column = 0; column < 9 && acts(load); column++)
      ambulo__text_append_format(text, "\t%s%s_%s_%s%c", prefix_of(load),
                                 column < 6 ? "force" : "torque", load->name,
                                 column < 3   ? "v"
                                 : column < 6 ? "p"
                                              : "",
                                 "xyz"[column % 3]);
  }
  ambulo__text_append_char(text, '\n');
  for (int k = 0; k < loads->rows; k++) {
    ambulo__text_append_number(text, time[k]);
    for (int i = 0; i < loads->count; i++) {
      size_t at = 3 * ((size_t)k * (size_t)loads->count + (size_t)i);
      double out[9];
      ambulo__rigid_vector(&bodies->world, loads->force + at, out);
      ambulo__rigid_vector(&bodies->world, loads->point + at, out + 3);
      ambulo__rigid_vector(&bodies->world, loads->torque + at, out + 6);
      for (int c = 0; c < 9 && acts(&loads->list[i]); c++) cell(text, out[c]);
    }
    ambulo__text_append_char(text, '\n');
  }
}

static void element(ambulo__text_buffer *text, const char *tag, const char *before,
                    const char *name, const char *after) {
  ambulo__text_append_format(text, "\t\t\t\t<%s>", tag);
  ambulo__markup_text(text, before, name, after);
  ambulo__text_append_format(text, "</%s>\n", tag);
}

static void identifier(ambulo__text_buffer *text, const char *tag, const ambulo__export_load *load,
                       const char *what, const char *after) {
  char before[32];
  (void)snprintf(before, sizeof before, "%s%s_", prefix_of(load), what);
  element(text, tag, before, load->name, after);
}

static void print_external_loads(const ambulo__bodies *bodies, const ambulo__loads *loads,
                                 ambulo__text_buffer *text) {
  ambulo__text_append(text, "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n" AMBULO__XML_MARK
                            "export: external loads of OpenSim -->\n"
                            "<OpenSimDocument Version=\"40000\">\n"
                            "\t<ExternalLoads name=\"external_loads\">\n\t\t<objects>\n");
  for (int i = 0; i < loads->count; i++) {
    const ambulo__export_load *load = &loads->list[i];
    if (!acts(load)) continue;
    ambulo__markup_text(text, "\t\t\t<ExternalForce name=\"", load->name, "\">\n");
    element(text, "applied_to_body", "", ambulo__export_name(bodies, load->body), "");
    element(text, "force_expressed_in_body", "", "ground", "");
    element(text, "point_expressed_in_body", "", "ground", "");
    identifier(text, "force_identifier", load, "force", "_v");
    identifier(text, "point_identifier", load, "force", "_p");
    identifier(text, "torque_identifier", load, "torque", "_");
    element(text, "data_source_name", "", "grf.mot", "");
    ambulo__text_append(text, "\t\t\t</ExternalForce>\n");
  }
  ambulo__text_append(text, "\t\t</objects>\n\t\t<datafile>grf.mot</datafile>\n"
                            "\t</ExternalLoads>\n</OpenSimDocument>\n");
}

/* --------------------------------------------------------------------- one export */

static const char *const file_names[] = {"model.osim", "motion.mot", "grf.mot",
                                         "external_loads.xml"};
static const ambulo__folder_mark mark = {"model.osim", AMBULO__XML_MARK, file_names,
                                         sizeof file_names / sizeof *file_names};

/* what one export needs */
typedef struct job {
  const ambulo_model *model;
  const char *motion, *output;
  const ambulo_export_options *options;
  const ambulo_allocator *allocator;
  ambulo_diagnostics *diagnostics;
  ambulo__bodies bodies;
  ambulo__source source;
  ambulo__loads loads;
  ambulo__text_buffer text;
} job;

/* ------------------------------------------------------------------------ refusals */

static ambulo_status check_names(const job *j, const char *own) {
  for (int i = 0; i < j->model->link_count; i++)
    if (strcmp(j->model->links[i].name, own) == 0)
      return ambulo__error(j->diagnostics, AMBULO_E_MODEL, ambulo__nowhere, NULL,
                           "a link is named '%s', which is the other program's name for the world; "
                           "expected another name",
                           own);
  return AMBULO_OK;
}

/* links and coordinates; masses may be others, and points more (a problem's may have some on its
 * capsules) */
static int same_body(const ambulo_model *a, const ambulo_model *b) {
  if (a->link_count != b->link_count || a->coordinate_count != b->coordinate_count) return 0;
  for (int i = 0; i < a->link_count; i++)
    if (strcmp(a->links[i].name, b->links[i].name) != 0) return 0;
  return a->foot_count == b->foot_count && a->patch_count == b->patch_count;
}

static ambulo_status check_asked(const job *j) {
  ambulo_export_format format = j->options->format;
  if (format == AMBULO_EXPORT_NPZ && !j->motion)
    return ambulo__error(j->diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere,
                         "--format urdf writes the model alone",
                         "no motion is given; an .npz holds a motion");
  if (format == AMBULO_EXPORT_URDF && j->motion)
    return ambulo__error(j->diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere,
                         "--format npz writes the motion", "a URDF cannot hold a motion");
  ambulo_status coupled = ambulo__coupled_check(j->model, j->options, j->diagnostics);
  if (coupled) return coupled;
  if (j->options->problem && !same_body(j->model, j->options->problem->model))
    return ambulo__error(j->diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "the problem belongs to another body, '%s'; expected the model's",
                         j->options->problem->model->name);
  if (j->options->free_root && format != AMBULO_EXPORT_URDF)
    return ambulo__error(j->diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "only a URDF can have a free root");
  if (j->options->free_root && ambulo__free_root(j->model) < 0)
    return ambulo__error(j->diagnostics, AMBULO_E_MODEL, ambulo__nowhere, NULL,
                         "the root is not free: its first joints are actuated, or branch "
                         "before any mass; expected coordinates with actuated: false");
  return check_names(j, format == AMBULO_EXPORT_OPENSIM ? "ground" : "world");
}

/* --------------------------------------------------------------------- what is lost */

static void warn_gravity(const job *j) {
  double g[3];
  ambulo__rigid_vector(&j->bodies.world, j->model->gravity, g);
  if (g[0] == 0.0 && g[1] == 0.0 && g[2] == -9.81) return;
  ambulo__warning(j->diagnostics, ambulo__nowhere, NULL,
                  "a URDF has no gravity; the model's is %g %g %g m/s^2 in its axes", g[0], g[1],
                  g[2]);
}

static void warn_limits(const job *j) {
  int uneven = 0;
  const char *first = "";
  for (int i = j->model->coordinate_count - 1; i >= 0; i--) {
    const ambulo_coordinate *c = &j->model->coordinates[i];
    if (c->torque[0] == -c->torque[1] && c->speed[0] == -c->speed[1]) continue;
    uneven++;
    first = c->name;
  }
  if (uneven)
    ambulo__warning(j->diagnostics, ambulo__nowhere, NULL,
                    "limits of torque or speed of %d coordinates ('%s') differ by direction: the "
                    "URDF has the larger",
                    uneven, first);
}

/* a URDF has damping and friction, but no rotors; an OpenSim model none of them */
static void warn_drives(const job *j) {
  int is_urdf = j->options->format == AMBULO_EXPORT_URDF, lost = 0;
  for (int i = 0; i < j->model->coordinate_count; i++) {
    const ambulo_coordinate *c = &j->model->coordinates[i];
    lost += c->armature != 0.0 || (!is_urdf && (c->damping != 0.0 || c->friction != 0.0));
  }
  if (lost)
    ambulo__warning(j->diagnostics, ambulo__nowhere, NULL, "%s of %d coordinates %s left out",
                    is_urdf ? "armature" : "armature, damping and friction", lost,
                    is_urdf ? "is" : "are");
}

/* ------------------------------------------------------------------------- writing */

static ambulo_status write_single(job *j) {
  ambulo_status status = ambulo__text_status(&j->text);
  if (status) return status;
  return ambulo__write_file(j->output, ambulo__text_data(&j->text), j->text.length, 1, j->allocator,
                            j->diagnostics);
}

static void print_file(job *j, int file) {
  switch (file) {
  case 0:
    ambulo__export_osim(&j->bodies, &j->text);
    break;
  case 1:
    print_motion(&j->bodies, &j->source, &j->text);
    break;
  case 2:
    print_forces(&j->bodies, j->source.time, &j->loads, &j->text);
    break;
  default:
    print_external_loads(&j->bodies, &j->loads, &j->text);
  }
}

/* a folder, whole or not at all */
static ambulo_status write_folder(job *j) {
  ambulo__folder *folder = NULL;
  ambulo_status status = ambulo__folder_begin(j->output, j->options->overwrite ? &mark : NULL,
                                              j->allocator, j->diagnostics, &folder);
  if (status) return status;
  for (int i = 0; !status && i < (j->loads.count ? 4 : 2); i++) {
    ambulo__text_clear(&j->text);
    print_file(j, i);
    status = ambulo__text_status(&j->text);
    if (!status)
      status = ambulo__folder_write(folder, file_names[i], ambulo__text_data(&j->text),
                                    j->text.length, j->diagnostics);
  }
  if (!status) return ambulo__folder_commit(folder, j->diagnostics);
  ambulo__folder_abort(folder, j->diagnostics);
  return status;
}

static ambulo_status add_loads(job *j) {
  return ambulo__loads_create(&j->bodies, j->options->problem, &j->source, j->diagnostics,
                              &j->loads);
}

static ambulo_status write_format(job *j) {
  ambulo_status status = AMBULO_OK;
  switch (j->options->format) {
  case AMBULO_EXPORT_OPENSIM:
    status = ambulo__bodies_merged(j->model, j->allocator, &j->bodies);
    warn_drives(j);
    if (!status && j->motion) status = add_loads(j);
    if (status) return status;
    if (j->motion) return write_folder(j);
    ambulo__export_osim(&j->bodies, &j->text);
    return write_single(j);
  case AMBULO_EXPORT_URDF:
    status = ambulo__bodies_single(j->model, j->options->free_root, j->allocator, &j->bodies);
    if (status) return status;
    warn_gravity(j);
    warn_limits(j);
    warn_drives(j);
    ambulo__export_urdf(&j->bodies, &j->text);
    return write_single(j);
  case AMBULO_EXPORT_NPZ:
  case AMBULO_EXPORT_FORMAT_NOT_SET:
    break;
  }
  status = ambulo__bodies_single(j->model, 1, j->allocator, &j->bodies);
  if (!status) status = add_loads(j);
  if (!status) status = ambulo__npz_motion(&j->bodies, &j->source, &j->loads, &j->text);
  return status ? status : write_single(j);
}

static ambulo_status run(job *j) {
  int folder = j->options->format == AMBULO_EXPORT_OPENSIM && j->motion;
  ambulo_status status = check_asked(j);
  const char *inputs[] = {j->motion, j->options->inverse ? j->options->inverse->forces : NULL};
  if (!status && !folder)
    status = ambulo__output_check(j->output, inputs, 2, j->options->overwrite, j->diagnostics);
  if (!status && j->motion)
    status = ambulo__source_read(j->model, j->motion, j->options->inverse,
                                 ambulo__has_loads(j->options->problem), j->allocator,
                                 j->diagnostics, &j->source);
  return status ? status : write_format(j);
}

ambulo_status ambulo_export(const ambulo_model *model, const char *motion, const char *output,
                            const ambulo_export_options *options, const ambulo_allocator *allocator,
                            ambulo_diagnostics *diagnostics) {
  ambulo_export_options own;
  if (!model || !output || !output[0] || (motion && !motion[0]) ||
      !AMBULO__OWN(ambulo_export_options, &own, options))
    return AMBULO_E_ARGUMENT;
  if (own.format < AMBULO_EXPORT_OPENSIM || own.format > AMBULO_EXPORT_NPZ)
    return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "the format of an export is %s (got %d); expected an ambulo_export_format",
                         own.format ? "unknown" : "not set", (int)own.format);
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  job j = {.model = model,
           .motion = motion,
           .output = output,
           .options = &own,
           .allocator = allocator,
           .diagnostics = diagnostics};
  ambulo__text_init(&j.text, allocator);
  ambulo_status status = run(&j);
  ambulo__text_free(&j.text);
  ambulo__loads_free(&j.loads);
  ambulo__source_free(&j.source);
  ambulo__bodies_free(&j.bodies);
  return ambulo__conclude(diagnostics, errors, status, output);
}
