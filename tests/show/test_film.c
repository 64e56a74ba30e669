/* Films as files: what ffmpeg is given, and what there is to say when it makes none. A script
 * stands in for it. */
#include "ambulo/tools/film.h"
#include "ambulo/tools/report.h"
#include "support/fail_sites.h"
#include "support/messages.h"
#include "support/scratch.h"
#include "support/walker_result.h"

typedef struct filming {
  char folder[SCRATCH_PATH + 8], output[SCRATCH_PATH + 8], program[SCRATCH_PATH + 16];
  char *path; /* PATH as it was */
  ambulo_film_options options;
} filming;

/* the result folder of a walk, and a folder on PATH for what stands in */
static void open_filming(void **state, filming *f) {
  walk w;
  char bin[SCRATCH_PATH + 8], all[8192];
  const char *directory = *state;
  (void)snprintf(f->folder, sizeof f->folder, "%s/r", directory);
  (void)snprintf(f->output, sizeof f->output, "%s/a.mp4", directory);
  (void)snprintf(bin, sizeof bin, "%s/bin", directory);
  (void)snprintf(f->program, sizeof f->program, "%s/ffmpeg", bin);
  assert_int_equal(mkdir(bin, 0777), 0);
  walk_open(&w, 12);
  assert_int_equal(ambulo_report_write(w.problem, w.result, f->folder, NULL, NULL, NULL),
                   AMBULO_OK);
  walk_close(&w);
  f->path = strdup(getenv("PATH"));
  assert_non_null(f->path);
  (void)snprintf(all, sizeof all, "%s:%s", bin, f->path);
  assert_int_equal(setenv("PATH", all, 1), 0);
  f->options = ambulo_film_options_default();
  f->options.width = 32;
  f->options.height = 16;
}

static void close_filming(filming *f) {
  assert_int_equal(setenv("PATH", f->path, 1), 0);
  free(f->path);
}

static void stand_in(const filming *f, const char *script) {
  (void)unlink(f->program);
  scratch_write(f->program, script);
  assert_int_equal(chmod(f->program, 0755), 0);
}

static long size_of(const char *path) {
  struct stat entry;
  return stat(path, &entry) == 0 ? (long)entry.st_size : -1;
}

/* every picture, whole, in the order of time; a motion that repeats as often as asked for */
static void pictures_are_sent(void **state) {
  filming f;
  open_filming(state, &f);
  stand_in(&f, "#!/bin/sh\nexec cat\n");
  f.options.rate = 10.0;
  f.options.overwrite = 1;
  long size[3];
  for (int i = 0; i < 3; i++) {
    f.options.times = i == 1 ? 3 : 1;
    f.options.speed = i == 2 ? 0.25 : 1.0;
    assert_int_equal(ambulo_film_write(f.folder, f.output, &f.options, NULL, NULL), AMBULO_OK);
    size[i] = size_of(f.output);
    assert_int_equal(size[i] % (32L * 16 * 3), 0);
  }
  long frame = 32L * 16 * 3;
  assert_true(size[0] / frame >= 5);
  assert_true(labs(size[1] - 3 * size[0]) <= 2 * frame);
  assert_true(labs(size[2] - 4 * size[0]) <= 3 * frame);
  char *bytes = read_whole(f.output);
  assert_int_not_equal(memcmp(bytes, bytes + frame, (size_t)frame), 0);
  free(bytes);
  close_filming(&f);
}

static void expect_none(const filming *f, const char *words) {
  char text[1024] = "";
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_film_write(f->folder, f->output, &f->options, NULL, list), AMBULO_E_IO);
  assert_int_equal(ambulo_diagnostics_count(list), 1);
  ambulo_diagnostics_format(list, 0, text, sizeof text);
  if (!strstr(text, words)) print_error("%s\n", text);
  assert_non_null(strstr(text, words));
  assert_int_equal(size_of(f->output), -1);
  ambulo_diagnostics_free(list);
}

/* one that is away, that never reads, that ends in the middle, that says nothing, that makes
 * nothing
 */
static void what_cannot_be(void **state) {
  filming f;
  open_filming(state, &f);
  f.options.width = f.options.height = 256; /* more than fits into a socket */
  stand_in(&f, "#!/bin/sh\necho first >&2\necho no codec here >&2\nexit 1\n");
  expect_none(&f, "ffmpeg made no film of it: no codec here");
  stand_in(&f, "#!/bin/sh\nhead -c 100000\nexit 3\n");
  expect_none(&f, "ffmpeg made no film of it: no reason given");
  stand_in(&f, "#!/bin/sh\nhead -c 100000\nexit 0\n");
  expect_none(&f, "no reason given");
  stand_in(&f, "#!/bin/sh\nexec cat >/dev/null\n");
  expect_none(&f, "cannot read back what ffmpeg made of it");
  assert_int_equal(setenv("PATH", "/nowhere", 1), 0);
  expect_none(&f, "films are made by ffmpeg, which is not on PATH");
  expect_none(&f, "apt-get install ffmpeg");
  assert_int_equal(entries_in(*state), 2); /* r, bin */
  close_filming(&f);
}

static void what_is_there_is_kept(void **state) {
  filming f;
  open_filming(state, &f);
  stand_in(&f, "#!/bin/sh\nexec cat\n");
  scratch_write(f.output, "mine\n");
  assert_int_equal(ambulo_film_write(f.folder, f.output, &f.options, NULL, NULL), AMBULO_E_IO);
  assert_file_equal(f.output, "mine\n");
  stand_in(&f, "#!/bin/sh\nexit 1\n");
  f.options.overwrite = 1;
  assert_int_equal(ambulo_film_write(f.folder, f.output, &f.options, NULL, NULL), AMBULO_E_IO);
  assert_file_equal(f.output, "mine\n");
  close_filming(&f);
}

static void arguments(void **state) {
  filming f;
  open_filming(state, &f);
  stand_in(&f, "#!/bin/sh\nexec cat\n");
  for (int i = 0; i < 16; i++) {
    ambulo_film_options o = f.options;
    if (i == 0) o.size = 0;
    if (i == 1) o.view = (ambulo_film_view)-1;
    if (i == 2) o.view = (ambulo_film_view)(AMBULO_FILM_TOP + 1);
    if (i == 3) o.width = 15;
    if (i == 4) o.width = 3842;
    if (i == 5) o.height = 17;
    if (i == 6) o.rate = 0.5;
    if (i == 7) o.rate = 121.0;
    if (i == 8) o.speed = 0.0;
    if (i == 9) o.speed = NAN;
    if (i == 10) o.times = 0;
    if (i == 11) o.times = 101;
    const char *name = i == 12 ? NULL : i == 13 ? ".mp4" : i == 14 ? "a.avi" : f.output;
    const char *folder = i == 15 ? NULL : f.folder;
    assert_int_equal(ambulo_film_write(folder, name, &o, NULL, NULL), AMBULO_E_ARGUMENT);
  }
  f.options.rate = 120.0;
  f.options.speed = 0.01;
  f.options.times = 100;
  assert_int_equal(ambulo_film_write(f.folder, f.output, &f.options, NULL, NULL), AMBULO_E_LIMIT);
  assert_int_equal(ambulo_film_write(*state, f.output, NULL, NULL, NULL), AMBULO_E_IO);
  assert_int_equal(size_of(f.output), -1);
  close_filming(&f);
}

static ambulo_status make(const ambulo_allocator *a, void *data) {
  const filming *f = data;
  (void)unlink(f->output);
  ambulo_status status = ambulo_film_write(f->folder, f->output, &f->options, a, NULL);
  assert_int_equal(size_of(f->output) > 0, status == AMBULO_OK);
  return status;
}

static void memory_may_run_out_anywhere(void **state) {
  static fail_sites sites;
  filming f;
  open_filming(state, &f);
  stand_in(&f, "#!/bin/sh\nexec cat\n");
  f.options.rate = 2.0;
  f.options.times = 1;
  print_message("film: %d places\n", fail_at_every_site(&sites, make, &f, 1));
  close_filming(&f);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(pictures_are_sent), TEST(what_cannot_be),
                                     TEST(what_is_there_is_kept), TEST(arguments),
                                     TEST(memory_may_run_out_anywhere)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
