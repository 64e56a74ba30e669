/* cli/front_words.c - see front_words.h. */
#include "cli/front_words.h"

#include <stdio.h>

void ambulo__cli_print_front(const ambulo_front_census *f) {
  if (f->terms == 0) return;
  printf("front of %d points", f->points);
  if (f->points > 1 && f->mean_gap > 0.0)
    printf(", largest gap %.2f mean gaps", f->largest_gap / f->mean_gap);
  if (f->refused > 0) printf(", %d gap%s refused to close", f->refused, f->refused > 1 ? "s" : "");
  if (f->left_out > 0) printf(", %d left out that another beats", f->left_out);
  printf("\n");
}
