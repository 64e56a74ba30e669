/* ambulo/status.h - status codes, diagnostics, allocator hook.
 *
 * A function that can fail returns an ambulo_status. On failure it leaves its outputs untouched,
 * unless its comment says otherwise. A NULL argument is E_ARGUMENT unless the comment allows it; so
 * is an empty name of a file or folder. Functions that return a plain value require an object.
 *
 * A status says whether the *call* was legal and could be carried out. What the solver concluded is
 * an ambulo_verdict, and how good the point is is in the ambulo_audit (both in solve.h).
 *
 * Messages for people are collected in an ambulo_diagnostics list that the caller owns; the library
 * never prints.
 */
#ifndef AMBULO_STATUS_H
#define AMBULO_STATUS_H

#include <math.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(AMBULO_BUILDING_SHARED) && defined(__GNUC__)
#define AMBULO_API __attribute__((visibility("default")))
#else
#define AMBULO_API
#endif

#if defined(__GNUC__)
#define AMBULO_NODISCARD __attribute__((warn_unused_result))
#else
#define AMBULO_NODISCARD
#endif

/* ------------------------------------------------- structures that callers fill */

/* Start from the structure's `_default()` and change what you need:
 *
 *     ambulo_options options = ambulo_options_default();
 *     options.time_limit = 60.0;
 *
 * A structure passed to a function has its `size` as first member. The sizes of its array items and
 * of its parts are members too (`contact_size`). `_default()`, which is compiled into the caller,
 * sets them all. A newer library can therefore read the structures of an older program: structures
 * grow only at their end, and members that the program lacks take the library's defaults. A size
 * that no header ever had (as in a structure filled with zeros), or one larger than the library's
 * own, is E_ARGUMENT.
 *
 * "Not set" and "off" have one form for each type:
 *
 *   a number that is left out or switched off       AMBULO_OFF, which is NaN: test with isnan().
 *                                                   No other number means it: a limit of 0 is 0
 *   a bound that does not bind, an end of all time  INFINITY, -INFINITY
 *   an enumeration                                  0, its first constant: off, or what its
 *                                                   comment says; refused where a choice is needed
 *   an index (link, point, foot, coordinate)        -1
 *   a pointer; a flag or a count                    NULL; 0 */
#define AMBULO_OFF ((double)NAN)

/* One list for codes, names and texts: X(identifier, name, exit status, text).
 * "exit status" is what the command-line program returns for it. */
#define AMBULO_STATUS_LIST(X)                                                                      \
  X(AMBULO_OK, "OK", 0, "success")                                                                 \
  X(AMBULO_E_ARGUMENT, "E_ARGUMENT", 2, "an argument is outside its documented range")             \
  X(AMBULO_E_IO, "E_IO", 4, "a file could not be read or written")                                 \
  X(AMBULO_E_PARSE, "E_PARSE", 3, "the text is not well-formed")                                   \
  X(AMBULO_E_SCHEMA, "E_SCHEMA", 3, "the text is well-formed but not what the format asks for")    \
  X(AMBULO_E_MODEL, "E_MODEL", 3, "the model is physically or structurally impossible")            \
  X(AMBULO_E_PROBLEM, "E_PROBLEM", 3, "the problem contradicts itself or its model")               \
  X(AMBULO_E_LIMIT, "E_LIMIT", 5, "a size limit was exceeded")                                     \
  X(AMBULO_E_MEMORY, "E_MEMORY", 5, "memory could not be allocated")                               \
  X(AMBULO_E_NUMERIC, "E_NUMERIC", 1, "a value became non-finite or a factorization failed")       \
  X(AMBULO_E_INTERNAL, "E_INTERNAL", 6, "an internal invariant was violated; please report it")

typedef enum ambulo_status {
#define AMBULO_STATUS_ENUM(id, name, exit_status, text) id,
  AMBULO_STATUS_LIST(AMBULO_STATUS_ENUM)
#undef AMBULO_STATUS_ENUM
} ambulo_status;

/* Short name ("E_PARSE") and one-sentence text of a status. Never NULL; static strings. */
AMBULO_API const char *ambulo_status_name(ambulo_status status);
AMBULO_API const char *ambulo_status_text(ambulo_status status);

/* Process exit status that the command-line program uses for `status`. */
AMBULO_API int ambulo_status_exit_code(ambulo_status status);

/* ----------------------------------------------------------------- defaults */

/* Sets the first `bytes` bytes of a structure of type `name` ("ambulo_options") to its defaults;
 * the
 * `_default()` functions call this. A `size` member becomes `bytes`. The caller sets the sizes of
 * items and parts beforehand, and the kind of a device or term, on which its defaults depend.
 * ambulo_problem_defaults knows a problem's definition, its parts and ambulo_options;
 * ambulo_defaults knows the other structures of the engine; ambulo_tool_defaults
 * (ambulo/tools/common.h) knows those of the tools. E_ARGUMENT: unknown name; nothing is written.
 */
AMBULO_API ambulo_status ambulo_defaults(const char *name, void *structure, size_t bytes);
AMBULO_API ambulo_status ambulo_problem_defaults(const char *name, void *structure, size_t bytes);

/* Defines name_default() by one of those. AMBULO_DECLARATIONS_ONLY is for programs that read these
 * headers without a C compiler. */
#ifdef AMBULO_DECLARATIONS_ONLY
#define AMBULO_DEFAULT_BY(function, name) struct ambulo_allocator
#else
/* NOLINTBEGIN(bugprone-macro-parentheses): a type takes none */
#define AMBULO_DEFAULT_BY(function, name)                                                          \
  static inline name name##_default(void) {                                                        \
    name usual;                                                                                    \
    function(#name, &usual, sizeof usual);                                                         \
    return usual;                                                                                  \
  }                                                                                                \
  struct ambulo_allocator
/* NOLINTEND(bugprone-macro-parentheses) */
#endif
#define AMBULO_DEFAULT(name) AMBULO_DEFAULT_BY(ambulo_defaults, name)
#define AMBULO_PROBLEM_DEFAULT(name) AMBULO_DEFAULT_BY(ambulo_problem_defaults, name)

/* ---------------------------------------------------------------- allocator */

/* All memory of an object comes from the allocator given when it was created.
 * resize(user, NULL, n) allocates, resize(user, p, n) reallocates,
 * resize(user, p, 0) frees and returns NULL. Returned memory must be aligned
 * for any type. NULL in place of an allocator means realloc/free.
 * `user` must outlive the object; the structure itself is copied. It has no `size` and will not
 * grow. */
typedef struct ambulo_allocator {
  void *(*resize)(void *user, void *pointer, size_t size);
  void *user;
} ambulo_allocator;

/* -------------------------------------------------------------- diagnostics */

typedef enum ambulo_severity {
  AMBULO_SEVERITY_NOT_SET = 0,
  AMBULO_NOTE,
  AMBULO_WARNING,
  AMBULO_ERROR
} ambulo_severity;

/* One message about an input. Strings belong to the list. */
typedef struct ambulo_diagnostic {
  ambulo_severity severity;
  ambulo_status status; /* AMBULO_OK for notes and warnings */
  const char *file;     /* NULL: not about a file */
  int line;             /* 1-based; 0: no position */
  int column;           /* 1-based; 0: no position */
  const char *path;     /* key path such as "links[3].body.mass"; NULL: none */
  const char *message;  /* what is wrong (got X); expected Y */
  const char *hint;     /* "did you mean 'mass'?"; NULL: none */
} ambulo_diagnostic;

/* A list of messages. It keeps the first 20 errors and at most 64 messages, and counts further
 * errors. */
typedef struct ambulo_diagnostics ambulo_diagnostics;

/* NULL on failure to allocate. `allocator` may be NULL. */
AMBULO_API ambulo_diagnostics *ambulo_diagnostics_create(const ambulo_allocator *allocator);
/* Accepts NULL. */
AMBULO_API void ambulo_diagnostics_free(ambulo_diagnostics *diagnostics);
/* Number of messages kept; number of errors found, kept or not. NULL counts 0. */
AMBULO_API size_t ambulo_diagnostics_count(const ambulo_diagnostics *diagnostics);
AMBULO_API size_t ambulo_diagnostics_error_count(const ambulo_diagnostics *diagnostics);
/* Message `index`; NULL if out of range. Valid until the list changes. */
AMBULO_API const ambulo_diagnostic *ambulo_diagnostics_get(const ambulo_diagnostics *diagnostics,
                                                           size_t index);
/* Writes "file:line:col: error[E_X]: message\n  hint: ..." into buffer[size] and returns the length
 * of the whole text, like snprintf. No trailing newline; terminated if size > 0; control characters
 * are escaped. */
AMBULO_API size_t ambulo_diagnostics_format(const ambulo_diagnostics *diagnostics, size_t index,
                                            char *buffer, size_t size);

#ifdef __cplusplus
}
#endif
#endif
