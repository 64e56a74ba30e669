/* ambulo/tools/common.h - what the tools have in common: defaults of options, texts.
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_COMMON_H
#define AMBULO_TOOLS_COMMON_H

#include "ambulo/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ambulo_defaults (ambulo/status.h) of the structures of ambulo/tools. */
AMBULO_API ambulo_status ambulo_tool_defaults(const char *name, void *structure, size_t bytes);
#define AMBULO_TOOL_DEFAULT(name) AMBULO_DEFAULT_BY(ambulo_tool_defaults, name)

/* Frees a text that a tool allocated with `allocator`; accepts NULL. */
AMBULO_API void ambulo_text_free(char *text, const ambulo_allocator *allocator);

#ifdef __cplusplus
}
#endif
#endif
