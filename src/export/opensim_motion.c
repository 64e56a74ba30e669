/* export/opensim_motion.c - a motion for OpenSim's tools, beside the model of osim_text.c.
 *
 *   motion.mot           coordinates, in degrees and metres
 *   grf.mot              of each foot, and of each hand that holds something: force, its point and
 * its torque there, in the ground's axes external_loads.xml   which columns act on which body
 *
 * World and ground differ by a turn W about the origin: vectors are W v.
 */
#include <math.h>

#include "export/markup.h"
#include "export/texts.h"

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

void ambulo__grf_text(const ambulo__bodies *bodies, const ambulo__source *source,
                      ambulo__text_buffer *text) {
  header(text, "grf", source->rows, 9 * source->loads + 1, 0);
  for (int load = 0; load < source->loads; load++) {
    const char *name = source->load[load].name;
    for (int column = 0; column < 9; column++)
      ambulo__text_append_format(text, "\tground_%s_%s_%s%c", column < 6 ? "force" : "torque", name,
                                 column < 3   ? "v"
                                 : column < 6 ? "p"
                                              : "",
                                 "xyz"[column % 3]);
  }
  ambulo__text_append_char(text, '\n');
  for (int k = 0; k < source->rows; k++) {
    ambulo__text_append_number(text, source->time[k]);
    for (int load = 0; load < source->loads; load++) {
      size_t at = (size_t)k * (size_t)source->loads + (size_t)load;
      double out[9];
      ambulo__rigid_vector(&bodies->world, source->force + 3 * at, out);
      ambulo__rigid_vector(&bodies->world, source->point + 3 * at, out + 3);
      ambulo__rigid_vector(&bodies->world, source->torque + 3 * at, out + 6);
      for (int i = 0; i < 9; i++) cell(text, out[i]);
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

void ambulo__external_loads_text(const ambulo__bodies *bodies, const ambulo__source *source,
                                 ambulo__text_buffer *text) {
  ambulo__text_append(text, "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n" AMBULO__XML_MARK
                            "export: external loads of OpenSim -->\n"
                            "<OpenSimDocument Version=\"40000\">\n"
                            "\t<ExternalLoads name=\"external_loads\">\n\t\t<objects>\n");
  for (int load = 0; load < source->loads; load++) {
    const char *name = source->load[load].name;
    int link = source->load[load].link;
    ambulo__text_append(text, "\t\t\t<ExternalForce name=\"");
    ambulo__markup_text(text, name);
    ambulo__text_append(text, "\">\n");
    element(text, "applied_to_body", "", ambulo__export_name(bodies, bodies->body_of[link]), "");
    element(text, "force_expressed_in_body", "", "ground", "");
    element(text, "point_expressed_in_body", "", "ground", "");
    element(text, "force_identifier", "ground_force_", name, "_v");
    element(text, "point_identifier", "ground_force_", name, "_p");
    element(text, "torque_identifier", "ground_torque_", name, "_");
    element(text, "data_source_name", "", "grf.mot", "");
    ambulo__text_append(text, "\t\t\t</ExternalForce>\n");
  }
  ambulo__text_append(text, "\t\t</objects>\n\t\t<datafile>grf.mot</datafile>\n"
                            "\t</ExternalLoads>\n</OpenSimDocument>\n");
}
