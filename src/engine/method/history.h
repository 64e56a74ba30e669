/* method/history.h - what a solve passed through, in bounded memory. */
#ifndef AMBULO_METHOD_HISTORY_H
#define AMBULO_METHOD_HISTORY_H

#include "ambulo/solve.h"

enum { AMBULO__HISTORY_MOST = 256 };

typedef struct ambulo__history {
  ambulo_history shown; /* its items are those below; `every` as there */
  int number;           /* of the last iteration on its grid, from 0 on */
  int passing;          /* 1: the last item stands only until its grid has a next one */
  ambulo_iteration item[AMBULO__HISTORY_MOST];
} ambulo__history;

/* Empty. NULL: no memory. */
ambulo__history *ambulo__history_create(const ambulo_allocator *allocator);
/* `history` may be NULL: nothing is kept. */
void ambulo__history_add(ambulo__history *history, const ambulo_iteration *iteration);

#endif
