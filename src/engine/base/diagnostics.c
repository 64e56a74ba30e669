/* base/diagnostics.c - statuses, and the list of messages about an input. */
#include "base/diagnostics.h"

#include "ambulo/ambulo.h"
#include "base/alloc.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* ------------------------------------------------------------------- statuses */

static const struct {
  const char *name, *text;
  int exit_code;
} statuses[] = {
#define STATUS_ROW(id, name, exit_code, text) [id] = {name, text, exit_code},
    AMBULO_STATUS_LIST(STATUS_ROW)
#undef STATUS_ROW
};

static int is_status(ambulo_status status) {
  return (unsigned)status < sizeof statuses / sizeof *statuses;
}

const char *ambulo_status_name(ambulo_status status) {
  return is_status(status) ? statuses[status].name : "E_UNKNOWN";
}

const char *ambulo_status_text(ambulo_status status) {
  return is_status(status) ? statuses[status].text : "not a status of this library";
}

int ambulo_status_exit_code(ambulo_status status) {
  return is_status(status) ? statuses[status].exit_code : statuses[AMBULO_E_INTERNAL].exit_code;
}

const char *ambulo_version(void) {
  return AMBULO_VERSION_STRING;
}

/* -------------------------------------------------------------------- messages */

const ambulo__place ambulo__nowhere = {NULL, 0, 0, NULL};

enum { MAX_ERRORS = 20, MAX_MESSAGES = 64, MAX_TEXT = 1024, MAX_WORD = 64, MAX_FILE = 512 };

/* Room for a message that finds no memory. There is one for the error that says so, which is often
 * the first to be short of it, one for an error that is about something else, and one for a
 * warning: what follows it may have memory again. */
typedef struct reserve {
  int used;
  char file[MAX_FILE], message[MAX_TEXT];
} reserve;

enum { FOR_MEMORY, FOR_OTHERS, FOR_WARNINGS, RESERVES };

struct ambulo_diagnostics {
  ambulo_allocator allocator;
  ambulo_diagnostic items[MAX_MESSAGES];
  size_t count, kept_errors, error_count;
  reserve reserves[RESERVES];
};

ambulo_diagnostics *ambulo_diagnostics_create(const ambulo_allocator *allocator) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_diagnostics *list = ambulo__alloc(&own, 1, sizeof *list);
  if (list) list->allocator = own;
  return list;
}

/* the strings of an item are ours; the public view shows them as const */
static void release(const ambulo_allocator *a, const char *text) {
  union {
    const char *constant;
    char *owned;
  } view = {text};
  ambulo__free(a, view.owned);
}

static void clear_item(ambulo_diagnostics *list, ambulo_diagnostic *item) {
  const ambulo_allocator *a = &list->allocator;
  int reserved = 0;
  for (int i = 0; i < RESERVES; i++) reserved |= item->message == list->reserves[i].message;
  if (!reserved) {
    release(a, item->file);
    release(a, item->message);
  }
  release(a, item->path);
  release(a, item->hint);
  memset(item, 0, sizeof *item);
}

void ambulo__diagnostics_clear(ambulo_diagnostics *list) {
  if (!list) return;
  for (size_t i = 0; i < list->count; i++) clear_item(list, &list->items[i]);
  for (int i = 0; i < RESERVES; i++) list->reserves[i].used = 0;
  list->count = list->kept_errors = list->error_count = 0;
}

void ambulo_diagnostics_free(ambulo_diagnostics *list) {
  if (!list) return;
  ambulo_allocator a = list->allocator;
  ambulo__diagnostics_clear(list);
  ambulo__free(&a, list);
}

size_t ambulo_diagnostics_count(const ambulo_diagnostics *list) {
  return list ? list->count : 0;
}

size_t ambulo_diagnostics_error_count(const ambulo_diagnostics *list) {
  return list ? list->error_count : 0;
}

const ambulo_diagnostic *ambulo_diagnostics_get(const ambulo_diagnostics *list, size_t index) {
  return list && index < list->count ? &list->items[index] : NULL;
}

/* ------------------------------------------------------------------ adding */

static char *copy_or_null(const ambulo_allocator *a, const char *text) {
  return text ? ambulo__strdup(a, text) : NULL;
}

static int has_room(const ambulo_diagnostics *list, ambulo_severity severity) {
  if (list->count == MAX_MESSAGES) return 0;
  if (severity == AMBULO_ERROR) return list->kept_errors < MAX_ERRORS;
  /* warnings leave room for every error that may still come */
  return list->count + MAX_ERRORS - list->kept_errors < MAX_MESSAGES;
}

/* file and message of an item where copies of them found no memory; 0: no room left */
static int use_reserve(ambulo_diagnostics *list, ambulo_diagnostic *item, const char *file,
                       const char *text) {
  reserve *r = &list->reserves[item->severity != AMBULO_ERROR    ? FOR_WARNINGS
                               : item->status == AMBULO_E_MEMORY ? FOR_MEMORY
                                                                 : FOR_OTHERS];
  if (r->used) return 0;
  r->used = 1;
  (void)snprintf(r->message, sizeof r->message, "%s", text);
  if (file) (void)snprintf(r->file, sizeof r->file, "%s", file);
  release(&list->allocator, item->file);
  release(&list->allocator, item->message);
  item->file = file ? r->file : NULL;
  item->message = r->message;
  return 1;
}

static void add(ambulo_diagnostics *list, ambulo_severity severity, ambulo_status status,
                ambulo__place place, const char *hint, const char *format, va_list arguments) {
  if (!list) return;
  if (severity == AMBULO_ERROR) list->error_count++;
  if (!has_room(list, severity)) return;
  char text[MAX_TEXT];
  (void)vsnprintf(text, sizeof text, format, arguments);
  const ambulo_allocator *a = &list->allocator;
  ambulo_diagnostic item = {severity,
                            status,
                            copy_or_null(a, place.file),
                            place.line,
                            place.column,
                            copy_or_null(a, place.path),
                            copy_or_null(a, text),
                            copy_or_null(a, hint)};
  int complete = item.message && (item.file || !place.file);
  if (!complete && !use_reserve(list, &item, place.file, text) && !item.message) {
    clear_item(list, &item);
    return;
  }
  list->items[list->count++] = item;
  if (severity == AMBULO_ERROR) list->kept_errors++;
}

ambulo_status ambulo__error(ambulo_diagnostics *list, ambulo_status status, ambulo__place place,
                            const char *hint, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  add(list, AMBULO_ERROR, status, place, hint, format, arguments);
  va_end(arguments);
  return status;
}

ambulo_status ambulo__conclude(ambulo_diagnostics *list, size_t errors_before, ambulo_status status,
                               const char *file) {
  ambulo__place place = {.file = file};
  if (status == AMBULO_OK || status == AMBULO_E_ARGUMENT) return status;
  if (ambulo_diagnostics_error_count(list) > errors_before) return status;
  return ambulo__error(list, status, place, NULL, "%s", ambulo_status_text(status));
}

void ambulo__warning(ambulo_diagnostics *list, ambulo__place place, const char *hint,
                     const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  add(list, AMBULO_WARNING, AMBULO_OK, place, hint, format, arguments);
  va_end(arguments);
}

void ambulo__note(ambulo_diagnostics *list, ambulo__place place, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  add(list, AMBULO_NOTE, AMBULO_OK, place, NULL, format, arguments);
  va_end(arguments);
}

void ambulo__diagnostics_append(const ambulo_diagnostics *from, ambulo_diagnostics *list) {
  for (size_t i = 0; i < ambulo_diagnostics_count(from); i++) {
    const ambulo_diagnostic *m = ambulo_diagnostics_get(from, i);
    ambulo__place place = {m->file, m->line, m->column, m->path};
    if (m->severity == AMBULO_ERROR)
      (void)ambulo__error(list, m->status, place, m->hint, "%s", m->message);
    else if (m->severity == AMBULO_WARNING)
      ambulo__warning(list, place, m->hint, "%s", m->message);
    else
      ambulo__note(list, place, "%s", m->message);
  }
}

/* -------------------------------------------------------------- formatting */

typedef struct writer {
  char *buffer;
  size_t size, length;
} writer;

static void put(writer *w, char c) {
  if (w->length + 1 < w->size) w->buffer[w->length] = c;
  w->length++;
}

/* control characters (terminal escapes among them) are shown as \xNN */
static void put_text(writer *w, const char *text) {
  static const char digits[] = "0123456789abcdef";
  for (; *text; text++) {
    unsigned char c = (unsigned char)*text;
    if (c >= 0x20 && c != 0x7f) {
      put(w, (char)c);
      continue;
    }
    put(w, '\\');
    put(w, 'x');
    put(w, digits[c >> 4]);
    put(w, digits[c & 15]);
  }
}

static void put_place(writer *w, const ambulo_diagnostic *item) {
  char number[48];
  put_text(w, item->file ? item->file : "ambulo");
  if (item->file && item->line > 0) {
    (void)snprintf(number, sizeof number, ":%d:%d", item->line,
                   item->column > 0 ? item->column : 1);
    put_text(w, number);
  }
  put_text(w, ": ");
}

size_t ambulo_diagnostics_format(const ambulo_diagnostics *list, size_t index, char *buffer,
                                 size_t size) {
  static const char *const severities[] = {"", "note", "warning", "error"};
  writer w = {buffer, size, 0};
  const ambulo_diagnostic *item = ambulo_diagnostics_get(list, index);
  if (item) {
    put_place(&w, item);
    put_text(&w, severities[item->severity]);
    if (item->severity == AMBULO_ERROR) {
      put(&w, '[');
      put_text(&w, ambulo_status_name(item->status));
      put(&w, ']');
    }
    put_text(&w, ": ");
    put_text(&w, item->message);
    if (item->hint) {
      put(&w, '\n');
      put_text(&w, "  hint: ");
      put_text(&w, item->hint);
    }
  }
  if (size > 0) buffer[w.length < size ? w.length : size - 1] = '\0';
  return w.length;
}

/* ---------------------------------------------------------- nearest names */

static size_t smaller(size_t a, size_t b) {
  return a < b ? a : b;
}

static int same_letter(char a, char b) {
  return tolower((unsigned char)a) == tolower((unsigned char)b);
}

/* letters inserted, dropped, replaced or swapped with their neighbour to get from a to b,
 * without regard to case; words longer than MAX_WORD are cut */
static size_t edit_distance(const char *a, const char *b) {
  size_t rows[3][MAX_WORD + 1]; /* i - 2, i - 1 and i letters of a; j letters of b */
  size_t *before = rows[0], *last = rows[1], *row = rows[2];
  size_t la = smaller(strlen(a), MAX_WORD), lb = smaller(strlen(b), MAX_WORD);
  for (size_t j = 0; j <= lb; j++) row[j] = j;
  for (size_t i = 1; i <= la; i++) {
    size_t *free_row = before;
    before = last;
    last = row;
    row = free_row;
    row[0] = i;
    for (size_t j = 1; j <= lb; j++) {
      size_t replaced = last[j - 1] + (same_letter(a[i - 1], b[j - 1]) ? 0 : 1);
      row[j] = smaller(smaller(last[j], row[j - 1]) + 1, replaced);
      if (i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) && same_letter(a[i - 2], b[j - 1]))
        row[j] = smaller(row[j], before[j - 2] + 1);
    }
  }
  return row[lb];
}

const char *ambulo__nearest(const char *word, const char *const *candidates, size_t count) {
  const char *best = NULL;
  size_t length = smaller(strlen(word), MAX_WORD);
  size_t least = length / 3 + 1;
  for (size_t i = 0; i < count; i++) {
    size_t distance = edit_distance(word, candidates[i]);
    if (distance >= least) continue;
    least = distance;
    best = candidates[i];
  }
  return best;
}
