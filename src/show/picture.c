/* show/picture.c - pictures as files (ambulo/tools/picture.h): SVG, and PDF or PNG by another
 * program (picture.h). */
#include "show/picture.h"

#include "ambulo/tools/picture.h"
#include "base/sized.h"
#include "formats/atomic_file.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "show/gait_svg.h"

#include <errno.h>
#include <math.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* px of an SVG to the inch, by CSS */
static const double usual_dots = 96.0;
enum {
  NOT_FOUND = 127
}; /* how a child that could not become the program ends, where spawn does
      not say so itself */

static const char install_hint[] =
    "install librsvg: 'apt-get install librsvg2-bin', 'dnf install librsvg2-tools', "
    "'brew install librsvg'; .svg needs nothing";

ambulo_status ambulo__picture_format_of(const char *output, ambulo_diagnostics *diagnostics,
                                        ambulo__picture_format *format) {
  static const char *const endings[] = {".svg", ".pdf", ".png"};
  size_t length = strlen(output);
  for (int i = 0; i < 3; i++) {
    if (length <= 4 || strcasecmp(output + length - 4, endings[i]) != 0) continue;
    *format = (ambulo__picture_format)i;
    return AMBULO_OK;
  }
  ambulo__place place = {.file = output};
  return ambulo__error(
      diagnostics, AMBULO_E_ARGUMENT, place, NULL,
      "the name does not say what picture it is; expected one that ends with .svg, "
      ".pdf or .png");
}

/* the child's standard streams */
typedef struct streams {
  FILE *in, *out, *words;
} streams;

static void close_streams(streams *s) {
  FILE *all[] = {s->in, s->out, s->words};
  for (int i = 0; i < 3; i++)
    if (all[i]) fclose(all[i]);
}

static int open_streams(const ambulo__text_buffer *svg, streams *s) {
  s->in = tmpfile();
  s->out = tmpfile();
  s->words = tmpfile();
  if (!s->in || !s->out || !s->words) return 0;
  if (fwrite(ambulo__text_data(svg), 1, svg->length, s->in) != svg->length) return 0;
  return fflush(s->in) == 0 && lseek(fileno(s->in), 0, SEEK_SET) == 0;
}

extern char **environ;

/* 0, or the fault */
static int run(const char *const *argument, const streams *s, int *ended) {
  posix_spawn_file_actions_t files;
  pid_t child = 0;
  int fault = posix_spawn_file_actions_init(&files);
  if (fault) return fault;
  const int from[3] = {fileno(s->in), fileno(s->out), fileno(s->words)};
  for (int i = 0; i < 3 && !fault; i++)
    fault = posix_spawn_file_actions_adddup2(&files, from[i], i);
  /* posix_spawnp takes char *const[] and changes nothing in it */
  if (!fault)
    fault = posix_spawnp(&child, argument[0], &files, NULL, (char *const *)argument, environ);
  (void)posix_spawn_file_actions_destroy(&files);
  if (fault) return fault;
  while (waitpid(child, ended, 0) < 0) {
    if (errno != EINTR) return errno;
  }
  return WIFEXITED(*ended) && WEXITSTATUS(*ended) == NOT_FOUND ? ENOENT : 0;
}

static void read_all(FILE *file, ambulo__text_buffer *bytes) {
  char part[4096];
  size_t count;
  (void)lseek(fileno(file), 0, SEEK_SET);
  while ((count = fread(part, 1, sizeof part, file)) > 0)
    ambulo__text_append_bytes(bytes, part, count);
}

/* the last words of the program, on one line */
static void last_words(FILE *file, char words[160]) {
  size_t count;
  (void)lseek(fileno(file), 0, SEEK_SET);
  count = fread(words, 1, 159, file);
  while (count > 0 && (words[count - 1] == '\n' || words[count - 1] == ' ')) count--;
  words[count] = '\0';
  for (char *c = words; *c; c++)
    if ((unsigned char)*c < ' ') *c = ' ';
}

static ambulo_status convert(const streams *s, const char *const *argument, const char *signature,
                             const char *output, ambulo_diagnostics *diagnostics,
                             ambulo__text_buffer *bytes) {
  ambulo__place place = {.file = output};
  int ended = 0, fault = run(argument, s, &ended);
  if (fault == ENOENT)
    return ambulo__error(diagnostics, AMBULO_E_IO, place, install_hint,
                         "PDF and PNG are made by rsvg-convert, which is not on PATH");
  if (fault)
    return ambulo__error(diagnostics, AMBULO_E_IO, place, NULL,
                         "rsvg-convert cannot be started: %s", strerror(fault));
  read_all(s->out, bytes);
  ambulo_status status = ambulo__text_status(bytes);
  if (status) return status;
  size_t size = strlen(signature);
  int good = WIFEXITED(ended) && WEXITSTATUS(ended) == 0 && bytes->length > size;
  if (good && memcmp(ambulo__text_data(bytes), signature, size) == 0) return AMBULO_OK;
  char words[160];
  last_words(s->words, words);
  return ambulo__error(diagnostics, AMBULO_E_IO, place, NULL,
                       "rsvg-convert made no picture of it: %s",
                       words[0] ? words : "no reason given");
}

ambulo_status ambulo__picture_convert(const ambulo__text_buffer *svg, ambulo__picture_format format,
                                      double dots_per_inch, const char *output,
                                      ambulo_diagnostics *diagnostics, ambulo__text_buffer *bytes) {
  static const char *const signatures[] = {"", "%PDF-", "\x89PNG\r\n"};
  const char *argument[6] = {"rsvg-convert", "--dpi-x=96", "--dpi-y=96"};
  ambulo__text_buffer zoom;
  ambulo__text_init_part(&zoom, bytes);
  ambulo__text_append(&zoom, "--zoom=");
  ambulo__text_append_number(&zoom, dots_per_inch / usual_dots);
  argument[3] = format == AMBULO__PICTURE_PDF ? "--format=pdf" : "--format=png";
  if (format == AMBULO__PICTURE_PNG) argument[4] = ambulo__text_data(&zoom);
  streams s = {.in = NULL};
  ambulo__place place = {.file = output};
  ambulo_status status = ambulo__text_status(&zoom);
  if (!status && !open_streams(svg, &s))
    status =
        ambulo__error(diagnostics, AMBULO_E_IO, place, NULL,
                      "temporary files for rsvg-convert cannot be written: %s", strerror(errno));
  if (!status) status = convert(&s, argument, signatures[format], output, diagnostics, bytes);
  close_streams(&s);
  ambulo__text_free(&zoom);
  return status;
}

/* pictures as files (ambulo/tools/picture.h).
 *
 * The order of work is such that nothing is drawn for a file that cannot be written, and nothing
 * converted that is not drawn: name, output, people, drawing, conversion, file.
 */

enum { MOST_BYTES = 256 << 20 };

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
  ambulo__picture_format format = AMBULO__PICTURE_SVG;
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
  ambulo__picture_format format = AMBULO__PICTURE_SVG;
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
