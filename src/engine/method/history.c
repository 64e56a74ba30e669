/* method/history.c - see history.h.
 *
 * Of each grid there are the iterations whose number on it is a multiple of `every`, and its last
 * one: an iteration that is no multiple gives way to the next of its grid. When the memory is full,
 * `every` doubles, and of each grid every other item goes. What is kept follows from the iterations
 * alone, not from the clock.
 */
#include "method/history.h"

#include "base/alloc.h"

enum { LARGEST = 1 << 20 };

ambulo__history *ambulo__history_create(const ambulo_allocator *allocator) {
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo__history *history = ambulo__alloc(&a, 1, sizeof *history);
  if (!history) return NULL;
  history->shown = (ambulo_history){.items = history->item, .every = 1};
  return history;
}

/* how many of `count` items are left; goes_on: the last grid has a next iteration */
static int thin(ambulo_iteration *item, int count, int goes_on) {
  int kept = 0, place = 0; /* place on its grid */
  for (int i = 0, before = -1; i < count; i++) {
    int intervals = item[i].intervals;
    int is_last = i + 1 < count ? item[i + 1].intervals != intervals : !goes_on;
    place = intervals == before ? place + 1 : 0;
    before = intervals;
    if (place % 2 == 0 || is_last) item[kept++] = item[i];
  }
  return kept;
}

void ambulo__history_add(ambulo__history *history, const ambulo_iteration *iteration) {
  if (!history) return;
  ambulo_history *shown = &history->shown;
  int count = shown->count;
  int goes_on = count > 0 && history->item[count - 1].intervals == iteration->intervals;
  history->number = goes_on ? history->number + 1 : 0;
  if (goes_on && history->passing) count--;
  if (count == AMBULO__HISTORY_MOST) {
    int kept = thin(history->item, count, goes_on);
    if (kept < count && shown->every < LARGEST) shown->every *= 2;
    count = kept < count ? kept : count - 1; /* of more grids than a solve has */
  }
  history->item[count] = *iteration;
  history->passing = history->number % shown->every != 0;
  shown->count = count + 1;
}
