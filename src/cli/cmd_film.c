/* cli/cmd_film.c - ambulo film: a motion as MP4 or GIF. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "ambulo/tools/film.h"
#include "cli/body.h"
#include "cli/output.h"

static const char *const views[] = {"free", "side", "front", "top"};
enum { VIEWS = sizeof views / sizeof *views };

static int read_view(const ambulo__cli_input *input, ambulo_film_options *o) {
  const char *text = ambulo__cli_value(input, "view");
  for (int i = 0; text && i < VIEWS; i++) {
    if (strcmp(text, views[i]) != 0) continue;
    o->view = (ambulo_film_view)i;
    return 1;
  }
  if (!text) return 1;
  ambulo__cli_usage_error("film", NULL, "--view is '%s'; expected free, side, front or top", text);
  return 0;
}

static int read_size(const ambulo__cli_input *input, ambulo_film_options *o) {
  const char *text = ambulo__cli_value(input, "size");
  char *end = NULL;
  if (!text) return 1;
  long width = strtol(text, &end, 10), height = *end == 'x' ? strtol(end + 1, &end, 10) : 0;
  int good = !*end && width >= 16 && width <= 3840 && height >= 16 && height <= 3840;
  if (good && width % 2 == 0 && height % 2 == 0) {
    o->width = (int)width;
    o->height = (int)height;
    return 1;
  }
  ambulo__cli_usage_error(
      "film", NULL, "--size is '%s'; expected WIDTHxHEIGHT, even numbers from 16 to 3840", text);
  return 0;
}

static void show(void *user, int pictures, int of) {
  (void)user;
  fprintf(stderr, "\rpicture %d of %d\033[K%s", pictures, of, pictures == of ? "\r\033[K" : "");
  fflush(stderr);
}

static int run(const ambulo__cli_input *input) {
  ambulo_film_options o = ambulo_film_options_default();
  const char *output = ambulo__cli_value(input, "output"), *directory = input->arguments[0];
  if (!output)
    return ambulo__cli_usage_error("film", NULL,
                                   "no output is given; expected -o FILE.mp4 or .gif");
  if (!read_view(input, &o) || !read_size(input, &o) ||
      !ambulo__cli_number(input, "rate", 1.0, 120.0, &o.rate) ||
      !ambulo__cli_number(input, "speed", 0.01, 100.0, &o.speed) ||
      !ambulo__cli_integer(input, "times", 1, 100, &o.times))
    return 2;
  o.overwrite = ambulo__cli_flag(input, "force");
  if (isatty(STDERR_FILENO)) o.progress = show;
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_film_write(directory, output, &o, NULL, diagnostics);
  int code = ambulo__cli_diagnostics(diagnostics, status, directory);
  if (!code) printf("written to %s\n", output);
  ambulo_diagnostics_free(diagnostics);
  return code;
}

static const ambulo__cli_option options[] = {
    {"output", 'o', "FILE", "the film: FILE.mp4 or FILE.gif"},
    {"view", 0, "VIEW", "free, side, front or top (default: free)"},
    {"speed", 0, "X", "1: as fast as the motion; 0.25: four times as slow (default: 1)"},
    {"times", 0, "N", "how often a motion that repeats is shown (default: 2)"},
    {"rate", 0, "N", "pictures a second (default: 30, of a GIF 25)"},
    {"size", 0, "WxH", "pixels (default: 1280x720, of a GIF 640x360)"},
    {"force", 0, NULL, "overwrite an existing file"},
};

const ambulo__cli_command ambulo__cli_film = {
    .name = "film",
    .arguments = "DIR",
    .summary = "make a film of a motion, MP4 or GIF",
    .description =
        "Draws the motion of a result folder picture by picture: the body, what it stands on, the\n"
        "ground forces. The film appears whole or not at all. Needs ffmpeg on PATH; the button\n"
        "Film on the page of 'ambulo report' needs only a browser. See docs/guide-page.md.",
    .example = "ambulo film walk -o walk.mp4\n"
               "ambulo film walk -o slow.gif --speed 0.25 --view side",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 1,
    .maximum = 1,
    .run = run,
};
