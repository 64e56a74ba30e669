/* ambulo/tools/page.h - results to watch: one HTML file that needs no network (docs/guide-page.md).
 *
 * The page holds all it shows: the program that draws, the motions, the curves, the words. It is
 * written whole or not at all: temporary name, fsync, rename.
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_PAGE_H
#define AMBULO_TOOLS_PAGE_H

#include "ambulo/model.h"
#include "ambulo/tools/common.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ambulo_page_options {
  size_t size;   /* set by ambulo_page_options_default() */
  int overwrite; /* 1: write over a file that is no page by ambulo */

  /* A person's own motion (CSV, STO or MOT, as ambulo/tools/inverse.h reads it), to stand beside
   * the results; NULL: none. The body that it moves, which has to be there then, and the ground's
   * height under it, m along up; which part of it, s, from < to (INFINITY: all). */
  const char *motion;
  const ambulo_model *body;
  double ground_height;
  double from, to;

  /* How large the page of a batch may be, MB; 3. Motions that need more have fewer samples; cases
   * for which there still is no room have none. */
  double megabytes;
} ambulo_page_options;
AMBULO_TOOL_DEFAULT(ambulo_page_options);

/* Writes the page of result folders (ambulo/tools/report.h; the first is the one that is shown,
 * others may be laid beside it); that of a batch folder is ambulo_batch_page's. `options` (NULL:
 * the defaults), `allocator` and `diagnostics` may be NULL. Errors: E_ARGUMENT; E_IO (a folder, or
 * a file in it, that is not there or cannot be read; an output that cannot be written, or is a file
 * that ambulo did not write and overwrite is 0); E_PARSE, E_SCHEMA (a file of a folder is damaged,
 * cut off, or of another result; with file, line and column); E_PROBLEM, E_LIMIT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_page_write(const char *const *directories,
                                                            int count, const char *output,
                                                            const ambulo_page_options *options,
                                                            const ambulo_allocator *allocator,
                                                            ambulo_diagnostics *diagnostics);

#ifdef __cplusplus
}
#endif
#endif
