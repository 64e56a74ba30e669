/* show/page.h - the page of `ambulo report`: its program, its data, and texts that stand in it. */
#ifndef AMBULO_SHOW_PAGE_H
#define AMBULO_SHOW_PAGE_H

#include "ambulo/tools/page.h"
#include "base/diagnostics.h"
#include "base/text_buffer.h"
#include "formats/yaml_node.h"

#include <stddef.h>

extern const unsigned char ambulo__viewer[];
extern const size_t ambulo__viewer_size;

/* JSON that stands inside of a page's <script> element.
 *
 * JSON has '<' and the line ends of JavaScript, U+2028 and U+2029, only inside of texts, where they
 * may as well be written \u003c, \u2028 and \u2029: then no text, whatever it says, can end the
 * element or open a comment in it. Blanks outside of texts are left out. */

/* Appends JSON so. */
void ambulo__script_json(ambulo__text_buffer *out, const char *json, size_t length);
/* Appends a text of any bytes as a JSON text; what is not UTF-8 becomes U+FFFD. */
void ambulo__script_text(ambulo__text_buffer *out, const char *text);
/* Appends a number to six digits, a whole one to all of its digits, where the text reads as one;
 * null for "null" and for nothing; else the text. */
void ambulo__script_value(ambulo__text_buffer *out, const char *text);

/* long texts inside of a page. */

/* Appends a JSON string: text [length] compressed (formats/deflate.h), in base64 (RFC 4648).
 * viewer/inflated.js reads it. */
void ambulo__packed_text(ambulo__text_buffer *out, const char *text, size_t length);

/* the data of a page: what its program is given to show.
 *
 *     {"results": [{"name", "packed"}, ...]}            of result folders
 *     {"study": {"name", "motions": [...], "table"}}    of a batch folder (study/study_page.c)
 *
 * "packed" is {"summary", "scene", "strip"}, compressed (packed_text.h): `summary` and `scene` are
 * the files of the folder (docs/results.md), `strip` its gait.svg as a text. "table" is packed too.
 * All of it is JSON for a <script> element (script_text.h). */

/* One file of a folder, read and found to be JSON of that schema: the value of its key `schema`
 * begins with `schema`. */
typedef struct ambulo__page_file {
  ambulo_allocator allocator;
  char *path, *text;
  size_t length;
  ambulo__yaml *document;
} ambulo__page_file;
/* Errors: E_IO, E_LIMIT, E_PARSE, E_SCHEMA, E_MEMORY. */
ambulo_status ambulo__page_file_read(const char *directory, const char *name, const char *schema,
                                     const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics, ambulo__page_file *file);
void ambulo__page_file_free(ambulo__page_file *file); /* accepts a zero-filled one */

/* summary.json and scene.json of a result folder, of one and the same result. */
typedef struct ambulo__page_result {
  ambulo__page_file summary, scene;
} ambulo__page_result;
/* Errors: as of ambulo__page_file_read. */
ambulo_status ambulo__page_result_read(const char *directory, const ambulo_allocator *allocator,
                                       ambulo_diagnostics *diagnostics,
                                       ambulo__page_result *result);
void ambulo__page_result_free(ambulo__page_result *result); /* accepts a zero-filled one */

/* scene_check.c: the document knows what no page can show. */
void ambulo__page_check_scene(const ambulo__yaml_node *root);

/* Appends an item of "results"; `with_strip`: with its picture, where it has one. Errors: as of
 * ambulo__page_result_read. */
ambulo_status ambulo__page_add_result(const char *directory, int with_strip,
                                      ambulo__text_buffer *out, ambulo_diagnostics *diagnostics);
/* The same of a person's own motion (options.motion). Errors: as of ambulo__motion_read. */
ambulo_status ambulo__page_add_motion(const ambulo_page_options *options, ambulo__text_buffer *out,
                                      ambulo_diagnostics *diagnostics);

/* The caller's options as this library's, and whether the page may be written. Errors: E_ARGUMENT,
 * E_IO. */
ambulo_status ambulo__page_begin(const ambulo_page_options *options, const char *output,
                                 ambulo_diagnostics *diagnostics, ambulo_page_options *own);
/* Writes the page with these data in it, JSON for a <script> element. Errors: E_IO, E_MEMORY. */
ambulo_status ambulo__page_save(const char *output, const ambulo__text_buffer *data,
                                ambulo_diagnostics *diagnostics);

#endif
