/* exchange/opensim_motion.c - a motion for OpenSim's tools, beside the model of osim_text.c.
 *
 *   motion.mot           coordinates, in degrees and metres
 *   grf.mot              of each load (loads.h): force, its point and its torque there, in the
 *                        ground's axes
 *   external_loads.xml   which columns act on which body
 *
 * World and ground differ by a turn W about the origin: vectors are W v.
 */
#include <math.h>
#include <stdio.h>

#include "exchange/markup.h"
#include "exchange/texts.h"

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

void ambulo__mot_text(const ambulo__bodies *bodies, const ambulo__source *source,
                      ambulo__text_buffer *text) {
  const ambulo_coordinate *coordinates = bodies->model->coordinates;
  int d = source->coordinates;
  header(text, source->name, source->rows, d + 1, 1);
  for (int i = 0; i < d; i++) {
    ambulo__text_append_char(text, '\t');
    ambulo__text_append(text, coordinates[i].name);
  }
  ambulo__text_append_char(text, '\n');
  for (int k = 0; k < source->rows; k++) {
    const double *q = source->q + (size_t)k * (size_t)d;
    ambulo__text_append_number(text, source->time[k]);
    for (int i = 0; i < d; i++)
      cell(text, coordinates[i].type == AMBULO_REVOLUTE ? q[i] * degree : q[i] + bodies->offset[i]);
    ambulo__text_append_char(text, '\n');
  }
}

/* on a body that moves */
static int acts(const ambulo__export_load *load) {
  return load->body >= 0;
}

void ambulo__grf_text(const ambulo__bodies *bodies, const double *time, const ambulo__loads *loads,
                      ambulo__text_buffer *text) {
  int count = 0;
  for (int i = 0; i < loads->count; i++) count += acts(&loads->list[i]);
  header(text, "grf", loads->rows, 9 * count + 1, 0);
  for (int i = 0; i < loads->count; i++) {
    const ambulo__export_load *load = &loads->list[i];
    for (int column = 0; column < 9 && acts(load); column++)
      ambulo__text_append_format(text, "\t%s%s_%s_%s%c", ambulo__load_prefix(load),
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
  ambulo__text_append_format(text, "\t\t\t\t<%s>%s", tag, before);
  ambulo__markup_text(text, name);
  ambulo__text_append_format(text, "%s</%s>\n", after, tag);
}

static void identifier(ambulo__text_buffer *text, const char *tag, const ambulo__export_load *load,
                       const char *what, const char *after) {
  char before[32];
  (void)snprintf(before, sizeof before, "%s%s_", ambulo__load_prefix(load), what);
  element(text, tag, before, load->name, after);
}

void ambulo__external_loads_text(const ambulo__bodies *bodies, const ambulo__loads *loads,
                                 ambulo__text_buffer *text) {
  ambulo__text_append(text, "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n" AMBULO__XML_MARK
                            "export: external loads of OpenSim -->\n"
                            "<OpenSimDocument Version=\"40000\">\n"
                            "\t<ExternalLoads name=\"external_loads\">\n\t\t<objects>\n");
  for (int i = 0; i < loads->count; i++) {
    const ambulo__export_load *load = &loads->list[i];
    if (!acts(load)) continue;
    ambulo__text_append(text, "\t\t\t<ExternalForce name=\"");
    ambulo__markup_text(text, load->name);
    ambulo__text_append(text, "\">\n");
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
