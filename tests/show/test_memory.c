/* Pictures, pages and result folders whose memory gives out at each place that asks for it:
 * E_MEMORY, nothing leaked, and nothing written. */
#include "ambulo/tools/tools.h"
#include "support/fail_sites.h"
#include "support/scratch.h"
#include "support/walker_result.h"

typedef struct drawing {
  walk walk;
  char output[SCRATCH_PATH + 16], folder[SCRATCH_PATH + 16];
  ambulo_picture_options options;
} drawing;

static fail_sites sites;

static ambulo_status draw(const ambulo_allocator *a, void *data) {
  const drawing *d = data;
  (void)unlink(d->output);
  ambulo_status status =
      ambulo_picture_write(d->walk.problem, d->walk.result, d->output, &d->options, a, NULL);
  assert_int_equal(access(d->output, F_OK) == 0, status == AMBULO_OK);
  return status;
}

static ambulo_status write_report(const ambulo_allocator *a, void *data) {
  const drawing *d = data;
  (void)scratch_remove_at(AT_FDCWD, d->folder);
  ambulo_status status =
      ambulo_report_write(d->walk.problem, d->walk.result, d->folder, NULL, a, NULL);
  assert_int_equal(access(d->folder, F_OK) == 0, status == AMBULO_OK);
  return status;
}

static ambulo_status write_page(const ambulo_allocator *a, void *data) {
  const drawing *d = data;
  const char *const folders[] = {d->folder, d->folder};
  (void)unlink(d->output);
  ambulo_status status = ambulo_page_write(folders, 2, d->output, NULL, a, NULL);
  assert_int_equal(access(d->output, F_OK) == 0, status == AMBULO_OK);
  return status;
}

static void open_drawing(void **state, drawing *d) {
  memset(d, 0, sizeof *d);
  walk_open(&d->walk, 12);
  (void)snprintf(d->output, sizeof d->output, "%s/a.svg", (const char *)*state);
  (void)snprintf(d->folder, sizeof d->folder, "%s/r", (const char *)*state);
  d->options = ambulo_picture_options_default();
}

/* every part, unit and curve of people in turn */
static void pictures(void **state) {
  drawing d;
  open_drawing(state, &d);
  for (int i = 0; i < 5; i++) {
    d.options.parts = i == 1   ? AMBULO_PICTURE_STRIP
                      : i == 2 ? AMBULO_PICTURE_CURVES
                               : AMBULO_PICTURE_ALL;
    d.options.powers = d.options.per_kg = i > 2;
    d.options.percent = i > 3;
    d.options.norms = i > 3 ? "models/norms" : NULL;
    print_message("picture %d: %d places\n", i, fail_at_every_site(&sites, draw, &d, 1));
  }
  walk_close(&d.walk);
}

static void reports_and_pages(void **state) {
  drawing d;
  open_drawing(state, &d);
  print_message("report: %d places\n", fail_at_every_site(&sites, write_report, &d, 1));
  assert_int_equal(write_report(NULL, &d), AMBULO_OK);
  print_message("page: %d places\n", fail_at_every_site(&sites, write_page, &d, 1));
  walk_close(&d.walk);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(pictures), TEST(reports_and_pages)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
