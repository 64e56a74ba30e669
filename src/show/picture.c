/* show/picture.c - pictures as files (ambulo/tools/picture.h).
 *
 * The order of work is such that nothing is drawn for a file that cannot be written, and nothing
 * converted that is not drawn: name, output, people, drawing, conversion, file.
 */
#include "ambulo/tools/picture.h"

#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "base/sized.h"
#include "formats/atomic_file.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "show/convert.h"
#include "show/gait_svg.h"

enum { MOST_BYTES = 256 << 20 };

AMBULO__FILL(ambulo_picture_options,
             {.size = size, .millimetres = AMBULO_OFF, .dots_per_inch = 300.0})

/* NULL: the defaults. 0 when what was given is not valid */
static int options_of(const ambulo_picture_options *given, ambulo_picture_options *o) {
  return AMBULO__OWN(ambulo_picture_options, o, given) && (int)o->parts >= 0 &&
         o->parts <= AMBULO_PICTURE_CURVES &&
         (isnan(o->millimetres) || (o->millimetres > 0.0 && o->millimetres <= 2000.0)) &&
         o->dots_per_inch >= 10.0 && o->dots_per_inch <= 2400.0;
}

static ambulo_status check_output(const char *output, int overwrite,
                                  ambulo_diagnostics *diagnostics) {
  struct stat there;
  ambulo__place place = {.file = output};
  if (overwrite || stat(output, &there) != 0 || !S_ISREG(there.st_mode) || there.st_size == 0)
    return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_IO, place,
                       "give another name, or --force (in C: overwrite)",
                       "the file exists; it is not written over");
}

/* what is drawn goes to its file, converted where its name asks for that */
static ambulo_status put(const ambulo__text_buffer *svg, const char *output,
                         ambulo__picture_format format, double dots_per_inch,
                         ambulo_diagnostics *diagnostics) {
  const ambulo_allocator *a = &svg->allocator;
  ambulo__text_buffer bytes;
  if (format == AMBULO__PICTURE_SVG)
    return ambulo__write_file(output, ambulo__text_data(svg), svg->length, 1, a, diagnostics);
  ambulo__text_init(&bytes, a);
  ambulo_status status =
      ambulo__picture_convert(svg, format, dots_per_inch, output, diagnostics, &bytes);
  if (!status)
    status = ambulo__write_file(output, ambulo__text_data(&bytes), bytes.length, 1, a, diagnostics);
  ambulo__text_free(&bytes);
  return status;
}

static ambulo_status draw(const ambulo_problem *problem, const ambulo_result *result,
                          const ambulo_picture_options *o, ambulo__text_buffer *text,
                          ambulo_diagnostics *diagnostics) {
  ambulo__people people = {.count = 0};
  ambulo__place place = {.file = o->reference};
  ambulo_status status = AMBULO_OK;
  int shown = 0, wanted = o->reference || (o->norms && ambulo__gait_is_walk(problem));
  const ambulo__gait_style style = {.without_strip = o->parts == AMBULO_PICTURE_CURVES,
                                    .without_curves = o->parts == AMBULO_PICTURE_STRIP,
                                    .powers = o->powers,
                                    .per_kg = o->per_kg,
                                    .percent = o->percent,
                                    .millimetres = isnan(o->millimetres) ? 0.0 : o->millimetres};
  if (o->reference)
    status = ambulo__people_read(o->reference, NULL, &text->allocator, diagnostics, &people);
  else if (wanted)
    status = ambulo__norms_read(o->norms, &text->allocator, diagnostics, &people);
  if (status) return status;
  status = ambulo__gait_picture(problem, result, wanted ? &people : NULL, &style, text, &shown);
  if (!status && o->reference && !shown && !style.without_curves)
    ambulo__warning(diagnostics, place, NULL,
                    ambulo__gait_is_walk(problem)
                        ? "none of its curves is one that the picture has; drawn without them"
                        : "curves of people are drawn behind walks on level ground alone; drawn "
                          "without them");
  ambulo__people_free(&people);
  return status;
}

ambulo_status ambulo_picture_write(const ambulo_problem *problem, const ambulo_result *result,
                                   const char *output, const ambulo_picture_options *options,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics) {
  ambulo_picture_options own;
  ambulo__picture_format format;
  if (!problem || !result || !output || !options_of(options, &own)) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = ambulo__picture_format_of(output, diagnostics, &format);
  if (!status) status = check_output(output, own.overwrite, diagnostics);
  if (status) return status;
  ambulo__text_buffer text;
  ambulo__text_init(&text, allocator);
  status = draw(problem, result, &own, &text, diagnostics);
  if (!status) status = put(&text, output, format, own.dots_per_inch, diagnostics);
  ambulo__text_free(&text);
  return ambulo__conclude(diagnostics, errors, status, output);
}

/* the SVG text of a file, or of a result folder's picture */
static ambulo_status read_source(const char *source, ambulo__text_buffer *text,
                                 ambulo_diagnostics *diagnostics) {
  const ambulo_allocator *a = &text->allocator;
  struct stat there;
  int folder = stat(source, &there) == 0 && S_ISDIR(there.st_mode);
  char *path = folder ? ambulo__join_paths(a, source, "gait.svg", NULL) : ambulo__strdup(a, source),
       *svg = NULL;
  size_t length = 0;
  ambulo__place place = {.file = path};
  ambulo_status status = path ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__read_file(path, MOST_BYTES, a, diagnostics, &svg, &length);
  if (!status && !strstr(svg, "<svg"))
    status = ambulo__error(diagnostics, AMBULO_E_PARSE, place, NULL,
                           "the file is no picture; expected SVG, or a result folder");
  if (!status) ambulo__text_append_bytes(text, svg, length);
  ambulo__free(a, svg);
  ambulo__free(a, path);
  return status ? status : ambulo__text_status(text);
}

ambulo_status ambulo_picture_convert(const char *source, const char *output,
                                     const ambulo_picture_options *options,
                                     const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics) {
  ambulo_picture_options own;
  ambulo__picture_format format;
  if (!source || !output || !options_of(options, &own)) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = ambulo__picture_format_of(output, diagnostics, &format);
  if (!status) status = check_output(output, own.overwrite, diagnostics);
  if (status) return status;
  ambulo__text_buffer text;
  ambulo__text_init(&text, allocator);
  status = read_source(source, &text, diagnostics);
  if (!status) status = put(&text, output, format, own.dots_per_inch, diagnostics);
  ambulo__text_free(&text);
  return ambulo__conclude(diagnostics, errors, status, source);
}
