/* show/case_block.c - see case_block.h. */
#include "show/case_block.h"

#include <string.h>

#include "show/case_table.h"
#include "show/motion_pack.h"
#include "show/page.h"

static int is_of_family(const ambulo__case_data *a, const ambulo__case_data *b) {
  return a->samples == b->samples &&
         strcmp(ambulo__text_data(&a->kinds), ambulo__text_data(&b->kinds)) == 0;
}

/* family[i] of each case; returns how many there are */
static int find_families(const ambulo__case_data *cases, int count, int *family) {
  int families = 0;
  for (int i = 0; i < count; i++) {
    family[i] = -1;
    for (int k = i - 1; k >= 0 && family[i] < 0; k--)
      if (is_of_family(cases + k, cases + i)) family[i] = family[k];
    if (family[i] < 0) family[i] = families++;
  }
  return families;
}

/* the motions of one family; `of` is for as many as there are */
static ambulo__motions motions_of(const ambulo__case_data *cases, int count, const int *family,
                                  int number, const ambulo__case_quality *quality,
                                  const float **of) {
  ambulo__motions m = {.motion = of, .every = 1, .finer = quality->finer};
  for (int i = 0; i < count; i++) {
    if (family[i] != number) continue;
    of[m.count++] = cases[i].motion;
    m.series = (int)cases[i].kinds.length;
    m.samples = cases[i].samples;
    if ((m.samples - 1) % quality->every == 0) m.every = quality->every;
  }
  return m;
}

static void append_family(ambulo__text_buffer *out, const ambulo__case_data *cases,
                          const ambulo__motions *m, const int *family, int number) {
  int first = 0;
  while (family[first] != number) first++;
  ambulo__text_append_format(out, "%s{\"kinds\":\"%s\",\"samples\":%d,\"count\":%d}",
                             number ? "," : "", ambulo__text_data(&cases[first].kinds),
                             (m->samples - 1) / m->every + 1, m->count);
}

static ambulo_status append_all(ambulo__text_buffer *out, const ambulo__case_data *cases, int count,
                                const ambulo__case_quality *quality, int *form, int *family,
                                const float **of) {
  ambulo_status status;
  int families = find_families(cases, count, family);
  ambulo__text_append_format(out, "{\"every\":%d,\"steps\":", quality->every);
  ambulo__case_data_steps(out, quality->finer);
  ambulo__text_append(out, ",\"forms\":");
  status = ambulo__case_table(out, cases, count, form);
  ambulo__text_append(out, ",\"families\":[");
  for (int f = 0; f < families && !status; f++) {
    ambulo__motions m = motions_of(cases, count, family, f, quality, of);
    append_family(out, cases, &m, family, f);
  }
  ambulo__text_append(out, "],\"cases\":[");
  for (int i = 0; i < count && !status; i++)
    ambulo__text_append_format(out, "%s[%d,%d]", i ? "," : "", form[i], family[i]);
  ambulo__text_append(out, "]}");
  ambulo__text_append_char(out, '\0');
  for (int f = 0; f < families && !status; f++) {
    ambulo__motions m = motions_of(cases, count, family, f, quality, of);
    if (m.series > 0) status = ambulo__motion_pack(out, &m);
  }
  return status ? status : ambulo__text_status(out);
}

ambulo_status ambulo__case_block(ambulo__text_buffer *out, const ambulo__case_data *cases,
                                 int count, const ambulo__case_quality *quality) {
  const ambulo_allocator *a = &out->allocator;
  ambulo__text_buffer block;
  ambulo__text_init_part(&block, out);
  int *form = ambulo__alloc(a, (size_t)count, sizeof *form);
  int *family = ambulo__alloc(a, (size_t)count, sizeof *family);
  const float **of = ambulo__alloc(a, (size_t)count, sizeof *of);
  ambulo_status status = form && family && of ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = append_all(&block, cases, count, quality, form, family, of);
  if (!status) ambulo__packed_text(out, ambulo__text_data(&block), block.length);
  ambulo__text_free(&block);
  ambulo__free(a, (void *)of);
  ambulo__free(a, family);
  ambulo__free(a, form);
  return status ? status : ambulo__text_status(out);
}
