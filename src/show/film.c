/* show/film.c - pictures one after another into ffmpeg, and its film into a file
 * (ambulo/tools/film.h).
 *
 * ffmpeg reads raw pictures from its standard input, a socket: where it ends early, a write fails
 * with EPIPE and nobody is killed by SIGPIPE. It writes to /dev/fd/1, an unnamed temporary file, in
 * which it may go back, as MP4 asks. The finished film is then written whole under its name. So
 * whatever ends this process leaves nothing behind. */
#include "ambulo/tools/film.h"

#include "base/sized.h"
#include "formats/atomic_file.h"
#include "show/film_scene.h"
#include "show/page.h"

#include <errno.h>
#include <math.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_PICTURES = 20000, NOT_FOUND = 127, WORDS = 160 };

#ifndef MSG_NOSIGNAL /* macOS: SO_NOSIGPIPE (untried) */
#define MSG_NOSIGNAL 0
#endif

static const char install_hint[] =
    "install it: 'apt-get install ffmpeg', 'dnf install ffmpeg-free', 'brew install ffmpeg'; the "
    "button Film of 'ambulo report' needs only a browser";

typedef struct film {
  const char *output;
  ambulo_film_options options;
  int is_gif, pictures;
  double rate;
  ambulo__film_scene scene;
  ambulo__canvas canvas;
  unsigned char *pixels;
  FILE *made, *words; /* of ffmpeg: the film, and what it says */
  int to;             /* socket; -1: closed */
  pid_t child;        /* 0: none */
  ambulo_diagnostics *diagnostics;
} film;

/* ------------------------------------------------------------------ options */

static int is_between(double x, double least, double most) {
  return x >= least && x <= most;
}

static int is_size(int x) {
  return x == 0 || (x >= 16 && x <= 3840 && x % 2 == 0);
}

/* NULL: the defaults. 0 when what was given is not valid */
static int options_of(const ambulo_film_options *given, ambulo_film_options *o) {
  return AMBULO__OWN(ambulo_film_options, o, given) && (int)o->view >= 0 &&
         o->view <= AMBULO_FILM_TOP && is_size(o->width) && is_size(o->height) &&
         (isnan(o->rate) || is_between(o->rate, 1.0, 120.0)) && is_between(o->speed, 0.01, 100.0) &&
         o->times >= 1 && o->times <= 100;
}

static ambulo_status read_name(film *f) {
  size_t length = strlen(f->output);
  ambulo__place place = {.file = f->output};
  const char *ending = length > 4 ? f->output + length - 4 : "";
  f->is_gif = strcasecmp(ending, ".gif") == 0;
  if (f->is_gif || strcasecmp(ending, ".mp4") == 0) return AMBULO_OK;
  return ambulo__error(
      f->diagnostics, AMBULO_E_ARGUMENT, place, NULL,
      "the name does not say what film it is; expected one that ends with .mp4 or .gif");
}

static ambulo_status read_scene(film *f, const char *directory, const ambulo_allocator *a) {
  ambulo__page_result result;
  ambulo_status status = ambulo__page_result_read(directory, a, f->diagnostics, &result);
  if (status) return status;
  status = ambulo__film_scene_read(result.scene.document, a, &f->scene);
  ambulo__page_result_free(&result);
  return status;
}

static ambulo_status plan(film *f, const ambulo_allocator *a) {
  ambulo_film_options *o = &f->options;
  ambulo__place place = {.file = f->output};
  f->rate = isnan(o->rate) ? (f->is_gif ? 25.0 : 30.0) : o->rate;
  if (o->width == 0) o->width = f->is_gif ? 640 : 1280;
  if (o->height == 0) o->height = f->is_gif ? 360 : 720;
  if (!f->scene.repeats) o->times = 1;
  double pictures = rint(o->times * f->scene.duration / o->speed * f->rate);
  if (pictures > MOST_PICTURES)
    return ambulo__error(f->diagnostics, AMBULO_E_LIMIT, place, "a higher speed, or a lower rate",
                         "a film of %.0f pictures; expected at most %d", pictures, MOST_PICTURES);
  f->pictures = pictures < 1.0 ? 1 : (int)pictures;
  f->pixels = ambulo__alloc(a, (size_t)o->width * (size_t)o->height, 3);
  if (!f->pixels) return AMBULO_E_MEMORY;
  return ambulo__canvas_create(o->width, o->height, a, &f->canvas);
}

/* ------------------------------------------------------------------- ffmpeg */

extern char **environ;

static int spawn(film *f, const char *const *argument, int from) {
  posix_spawn_file_actions_t files;
  int fault = posix_spawn_file_actions_init(&files);
  if (fault) return fault;
  const int given[3] = {from, fileno(f->made), fileno(f->words)};
  for (int i = 0; i < 3 && !fault; i++)
    fault = posix_spawn_file_actions_adddup2(&files, given[i], i);
  if (!fault) fault = posix_spawn_file_actions_addclose(&files, f->to);
  /* posix_spawnp takes char *const[] and changes nothing in it */
  if (!fault)
    fault = posix_spawnp(&f->child, argument[0], &files, NULL, (char *const *)argument, environ);
  if (fault) f->child = 0;
  (void)posix_spawn_file_actions_destroy(&files);
  return fault;
}

static int start(film *f) {
  char size[32], rate[32];
  const char *gif = "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=none";
  (void)snprintf(size, sizeof size, "%dx%d", f->options.width, f->options.height);
  (void)snprintf(rate, sizeof rate, "%d/1000", (int)rint(1000.0 * f->rate));
  const char *argument[] = {"ffmpeg",
                            "-nostdin",
                            "-v",
                            "error",
                            "-f",
                            "rawvideo",
                            "-pix_fmt",
                            "rgb24",
                            "-s",
                            size,
                            "-r",
                            rate,
                            "-i",
                            "pipe:0",
                            f->is_gif ? "-filter_complex" : "-pix_fmt",
                            f->is_gif ? gif : "yuv420p",
                            "-f",
                            f->is_gif ? "gif" : "mp4",
                            "-y",
                            "/dev/fd/1",
                            NULL};
  int ends[2];
  f->made = tmpfile();
  f->words = tmpfile();
  if (!f->made || !f->words || socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) return errno;
  f->to = ends[0];
#ifdef SO_NOSIGPIPE
  (void)setsockopt(f->to, SOL_SOCKET, SO_NOSIGPIPE, &(int){1}, sizeof(int));
#endif
  int fault = spawn(f, argument, ends[1]);
  (void)close(ends[1]);
  return fault;
}

static int send_all(int to, const unsigned char *bytes, size_t length) {
  while (length > 0) {
    ssize_t count = send(to, bytes, length, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return 0;
    bytes += count;
    length -= (size_t)count;
  }
  return 1;
}

/* closes its input and waits for its end; 1: it went well */
static int finish(film *f, int *ended) {
  if (f->to >= 0) (void)close(f->to);
  f->to = -1;
  if (f->child == 0) return 0;
  while (waitpid(f->child, ended, 0) < 0)
    if (errno != EINTR) return 0;
  f->child = 0;
  return WIFEXITED(*ended) && WEXITSTATUS(*ended) == 0;
}

/* its last line */
static void last_words(FILE *file, char words[WORDS]) {
  size_t count = 0, begin = 0;
  long end = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : 0;
  if (fseek(file, end > WORDS - 1 ? end - (WORDS - 1) : 0, SEEK_SET) == 0)
    count = fread(words, 1, WORDS - 1, file);
  while (count > 0 && (unsigned char)words[count - 1] <= ' ') count--;
  words[count] = '\0';
  for (size_t i = 0; i < count; i++) {
    if (words[i] == '\n') begin = i + 1;
    if ((unsigned char)words[i] < ' ') words[i] = ' ';
  }
  memmove(words, words + begin, count - begin + 1);
}

static ambulo_status no_program(const film *f, int fault) {
  ambulo__place place = {.file = f->output};
  if (fault == ENOENT)
    return ambulo__error(f->diagnostics, AMBULO_E_IO, place, install_hint,
                         "films are made by ffmpeg, which is not on PATH");
  return ambulo__error(f->diagnostics, AMBULO_E_IO, place, NULL, "ffmpeg cannot be started: %s",
                       strerror(fault));
}

/* ---------------------------------------------------------------- the film */

static int send_pictures(film *f) {
  const ambulo__film_scene *s = &f->scene;
  size_t bytes = 3 * (size_t)f->options.width * (size_t)f->options.height;
  for (int k = 0; k < f->pictures; k++) {
    double time = k / f->rate * f->options.speed;
    int period = s->repeats ? (int)floor(time / s->duration + 1e-9) : 0;
    ambulo__film_draw(s, time - period * s->duration, period, f->options.view, &f->canvas);
    ambulo__canvas_pixels(&f->canvas, f->pixels);
    if (!send_all(f->to, f->pixels, bytes)) return 0;
    if (f->options.progress) f->options.progress(f->options.user, k + 1, f->pictures);
  }
  return 1;
}

static ambulo_status take(film *f, const ambulo_allocator *a) {
  ambulo__text_buffer bytes;
  char part[4096];
  size_t count;
  ambulo__text_init(&bytes, a);
  (void)lseek(fileno(f->made), 0, SEEK_SET);
  while ((count = fread(part, 1, sizeof part, f->made)) > 0)
    ambulo__text_append_bytes(&bytes, part, count);
  ambulo_status status = ambulo__text_status(&bytes);
  if (!status && (ferror(f->made) || bytes.length == 0))
    status = ambulo__io_error(f->diagnostics, f->output, "read back what ffmpeg made of it");
  if (!status)
    status = ambulo__write_file(f->output, ambulo__text_data(&bytes), bytes.length, 1, a,
                                f->diagnostics);
  ambulo__text_free(&bytes);
  return status;
}

static ambulo_status make(film *f, const ambulo_allocator *a) {
  int fault = start(f), ended = 0;
  if (fault) return no_program(f, fault);
  int sent = send_pictures(f), good = finish(f, &ended) && sent;
  if (good) return take(f, a);
  if (WIFEXITED(ended) && WEXITSTATUS(ended) == NOT_FOUND) return no_program(f, ENOENT);
  char words[WORDS];
  ambulo__place place = {.file = f->output};
  last_words(f->words, words);
  return ambulo__error(f->diagnostics, AMBULO_E_IO, place, NULL, "ffmpeg made no film of it: %s",
                       words[0] ? words : "no reason given");
}

ambulo_status ambulo_film_write(const char *directory, const char *output,
                                const ambulo_film_options *options,
                                const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics) {
  film f = {.output = output, .to = -1, .diagnostics = diagnostics};
  if (!directory || !output || !options_of(options, &f.options)) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  int ended = 0;
  ambulo_status status = read_name(&f);
  if (!status)
    status = ambulo__output_check(output, &directory, 1, f.options.overwrite, diagnostics);
  if (!status) status = read_scene(&f, directory, &a);
  if (!status) status = plan(&f, &a);
  if (!status) status = make(&f, &a);
  (void)finish(&f, &ended);
  if (f.made) (void)fclose(f.made);
  if (f.words) (void)fclose(f.words);
  ambulo__free(&a, f.pixels);
  ambulo__canvas_free(&f.canvas, &a);
  ambulo__film_scene_free(&f.scene);
  return ambulo__conclude(diagnostics, errors, status, output);
}
