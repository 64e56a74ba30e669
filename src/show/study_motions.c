/* show/study_motions.c - see study_motions.h. */
#include "show/study_motions.h"

#include <math.h>
#include <string.h>

#include "show/case_block.h"

enum { MOST_CASES = 1000, MOST_VALUES = 50000000, AROUND = 64 };

/* from the best one on; each takes about two thirds of what the one before takes */
static const ambulo__case_quality qualities[] = {{1, 4.0}, {1, 2.0}, {1, 1.0}, {2, 1.0}, {4, 1.0}};
enum { LAST = sizeof qualities / sizeof qualities[0] - 1 };

typedef struct block {
  ambulo__case_data *cases;
  int count;
  size_t values;
} block;

static void empty(block *b) {
  for (int i = 0; i < b->count; i++) ambulo__case_data_free(b->cases + i);
  b->count = 0;
  b->values = 0;
}

/* the next folders, until there are `most`, or they fill the memory that a block may take */
static ambulo_status read_block(block *b, char *const *folders, int most, const ambulo_allocator *a,
                                ambulo_diagnostics *diagnostics) {
  ambulo_status status = AMBULO_OK;
  while (b->count < most && b->values < MOST_VALUES && !status) {
    ambulo__page_result result;
    status = ambulo__page_result_read(folders[b->count], a, diagnostics, &result);
    if (status) break;
    ambulo__case_data *next = b->cases + b->count;
    status = ambulo__case_data_create(&result, a, next);
    if (!status) b->values += next->length;
    if (!status) b->count++;
    ambulo__page_result_free(&result);
  }
  return status;
}

/* as well as `room` allows; *fits: as many of its cases as there is place for */
static ambulo_status pack(const block *b, double room, ambulo__text_buffer *packed, int *fits) {
  ambulo_status status = AMBULO_OK;
  int quality = 0;
  for (*fits = b->count; *fits > 0 && !status;) {
    ambulo__text_clear(packed);
    status = ambulo__case_block(packed, b->cases, *fits, qualities + quality);
    if (status || (double)packed->length <= room) break;
    double share = fmax(room, 0.0) / (double)packed->length;
    if (quality == LAST) *fits = (int)fmin(*fits - 1, floor(0.98 * share * *fits));
    quality += share < 0.4 && quality + 1 < LAST ? 2 : quality < LAST;
  }
  return status;
}

ambulo_status ambulo__study_motions(ambulo__text_buffer *out, char *const *folders, int count,
                                    double room, ambulo_diagnostics *diagnostics, char *stands) {
  const ambulo_allocator *a = &out->allocator;
  int blocks = (count + MOST_CASES - 1) / MOST_CASES, most = blocks ? (count - 1) / blocks + 1 : 0;
  block b = {.cases = ambulo__alloc(a, (size_t)most, sizeof *b.cases)};
  ambulo__text_buffer packed;
  ambulo__text_init_part(&packed, out);
  ambulo_status status = b.cases ? AMBULO_OK : AMBULO_E_MEMORY;
  int written = 0;
  ambulo__text_append_char(out, '[');
  for (int from = 0, next = 0; from < count && !status; from = next) {
    int fits = 0;
    status =
        read_block(&b, folders + from, most < count - from ? most : count - from, a, diagnostics);
    next = from + b.count;
    double share = room * b.count / (count - from) - AROUND;
    if (!status) status = pack(&b, share, &packed, &fits);
    if (!status && fits > 0) {
      room -= (double)packed.length + AROUND;
      ambulo__text_append_format(out, "%s{\"count\":%d,\"packed\":", written++ ? "," : "", fits);
      ambulo__text_append_bytes(out, ambulo__text_data(&packed), packed.length);
      ambulo__text_append_char(out, '}');
      memset(stands + from, 1, (size_t)fits);
    }
    empty(&b);
  }
  ambulo__text_append_char(out, ']');
  ambulo__text_free(&packed);
  ambulo__free(a, b.cases);
  return status ? status : ambulo__text_status(out);
}
