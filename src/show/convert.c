/* show/convert.c - see convert.h. */
#include "show/convert.h"

#include <errno.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
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
