/* show/page.c - the page of `ambulo report`: the viewer with data in it (page.h). The viewer's own
 * program is in viewer/, from main.js on; data of a study: study/study_page.c. */
#include "show/page.h"

#include "base/sized.h"
#include "formats/atomic_file.h"
#include "formats/paths.h"

#include <math.h>
#include <string.h>
#include <sys/stat.h>

enum { START_BYTES = 1024 };

/* how a page is known for one of ours; and where the data go */
static const char own_mark[] = "<meta name=\"generator\" content=\"ambulo report\">";
static const char data_mark[] = "/*DATA*/";

static int options_are_valid(const ambulo_page_options *o) {
  if (!isfinite(o->ground_height)) return 0;
  if (!(o->megabytes >= 0.0 && o->megabytes <= 1e6)) return 0;
  return !o->motion || (o->body && o->from < o->to);
}

/* what stands at `output` is kept unless it is a page of ours */
static ambulo_status check_output(const char *output, int overwrite,
                                  ambulo_diagnostics *diagnostics) {
  struct stat there;
  ambulo__place place = {.file = output};
  if (overwrite || stat(output, &there) != 0 || !S_ISREG(there.st_mode) || there.st_size == 0)
    return AMBULO_OK;
  if (ambulo__file_says(output, own_mark, START_BYTES)) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_IO, place,
                       "give another name, or --force (in C: overwrite)",
                       "the file exists, and is no page by ambulo; it is not written over");
}

ambulo_status ambulo__page_begin(const ambulo_page_options *options, const char *output,
                                 ambulo_diagnostics *diagnostics, ambulo_page_options *own) {
  if (!AMBULO__OWN(ambulo_page_options, own, options)) return AMBULO_E_ARGUMENT;
  if (!output || !options_are_valid(own)) return AMBULO_E_ARGUMENT;
  return check_output(output, own->overwrite, diagnostics);
}

static int is_batch(const char *directory, const ambulo_allocator *a) {
  struct stat entry;
  char *path = ambulo__join_paths(a, directory, "batch.json", NULL);
  int there = path && stat(path, &entry) == 0;
  ambulo__free(a, path);
  return there;
}

static ambulo_status results(const char *const *directories, int count,
                             const ambulo_page_options *o, ambulo__text_buffer *data,
                             ambulo_diagnostics *diagnostics) {
  ambulo_status status = AMBULO_OK;
  ambulo__text_append(data, "\"results\":[");
  for (int i = 0; i < count && !status; i++) {
    ambulo__place place = {.file = directories[i]};
    if (i) ambulo__text_append_char(data, ',');
    if (is_batch(directories[i], &data->allocator))
      return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place,
                           "in C ambulo_batch_page writes the page of a batch",
                           "a batch folder beside others; expected it alone, or result folders");
    status = ambulo__page_add_result(directories[i], i == 0, data, diagnostics);
  }
  if (!status && o->motion) {
    ambulo__text_append_char(data, ',');
    status = ambulo__page_add_motion(o, data, diagnostics);
  }
  ambulo__text_append_char(data, ']');
  return status ? status : ambulo__text_status(data);
}

ambulo_status ambulo__page_save(const char *output, const ambulo__text_buffer *data,
                                ambulo_diagnostics *diagnostics) {
  const char *viewer = (const char *)ambulo__viewer;
  const char *mark = strstr(viewer, data_mark);
  if (!mark) return AMBULO_E_INTERNAL;
  size_t before = (size_t)(mark - viewer), behind = before + sizeof data_mark - 1;
  ambulo__text_buffer page;
  ambulo__text_init(&page, &data->allocator);
  ambulo__text_append_bytes(&page, viewer, before);
  ambulo__text_append_bytes(&page, ambulo__text_data(data), data->length);
  ambulo__text_append_bytes(&page, viewer + behind, ambulo__viewer_size - behind);
  ambulo_status status = ambulo__text_status(&page);
  if (!status)
    status = ambulo__write_file(output, ambulo__text_data(&page), page.length, 1, &data->allocator,
                                diagnostics);
  ambulo__text_free(&page);
  return status;
}

ambulo_status ambulo_page_write(const char *const *directories, int count, const char *output,
                                const ambulo_page_options *options,
                                const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics) {
  ambulo_page_options own;
  if (!directories || count < 1) return AMBULO_E_ARGUMENT;
  for (int i = 0; i < count; i++)
    if (!directories[i]) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = ambulo__page_begin(options, output, diagnostics, &own);
  if (status == AMBULO_E_ARGUMENT) return status;
  ambulo__text_buffer data;
  ambulo__text_init(&data, allocator);
  ambulo__text_append_char(&data, '{');
  if (!status) status = results(directories, count, &own, &data, diagnostics);
  ambulo__text_append_char(&data, '}');
  if (!status) status = ambulo__page_save(output, &data, diagnostics);
  ambulo__text_free(&data);
  return ambulo__conclude(diagnostics, errors, status, output);
}
