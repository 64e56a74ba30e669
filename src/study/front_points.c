/* study/front_points.c - see front_points.h.
 *
 * The objective of a case is sum_i w_i J_i + R, and its summary names each term with its weight, so
 * J_i is what is written by w_i. Where free parameters are chosen by the objective per metre, it is
 * that which is minimized: total and terms are divided by the distance. */
#include "study/front_points.h"

#include "base/numtext.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TOTAL, PER, DISTANCE, TERMS, PATH = 160, OUTPUTS = TERMS + AMBULO__FRONT_TERMS };

ambulo_status ambulo__front_read_point(const char *directory, const char *id, char *const *term,
                                       int terms, const ambulo_allocator *a,
                                       ambulo__front_point *point) {
  char text[OUTPUTS][PATH] = {"objective.total", "free.per", "free.distance"}, *path[OUTPUTS];
  ambulo__output value[OUTPUTS];
  memset(value, 0, sizeof value);
  for (int i = 0; i < terms; i++)
    (void)snprintf(text[TERMS + i], PATH, "objective.terms.%.120s", term[i]);
  for (int i = 0; i < TERMS + terms; i++) path[i] = text[i];
  ambulo_status status = ambulo__outputs_of(directory, id, path, TERMS + terms, a, NULL, value);
  if (status) return status == AMBULO_E_MEMORY ? status : AMBULO_OK;
  double by = strcmp(value[PER].text, "distance") == 0 ? value[DISTANCE].number : 1.0;
  int solved = value[TOTAL].kind == AMBULO__OUTPUT_NUMBER && by > 0.0;
  point->total = value[TOTAL].number / by;
  for (int i = 0; i < terms; i++) {
    solved &= value[TERMS + i].kind == AMBULO__OUTPUT_NUMBER;
    point->value[i] = value[TERMS + i].number / by / point->weight[i];
    solved &= isfinite(point->value[i]);
  }
  point->solved = solved;
  return AMBULO_OK;
}

typedef struct gathering {
  const char *directory;
  const ambulo__listing *listing;
  ambulo__front *front;
} gathering;

static ambulo_status take(void *user, const ambulo__gathered *one) {
  gathering *g = user;
  const ambulo__listing *l = g->listing;
  ambulo__front_point *p = &g->front->point[one->index];
  for (int i = 0; i < l->front.terms; i++) {
    const char *cell = ambulo__listing_cell(l, one->index, AMBULO__LISTING_AXES + i);
    if (!ambulo__parse_double(cell, strlen(cell), &p->weight[i])) return AMBULO_OK;
  }
  if (!one->valid) return AMBULO_OK;
  return ambulo__front_read_point(g->directory,
                                  ambulo__listing_cell(l, one->index, AMBULO__LISTING_ID),
                                  l->front.name, l->front.terms, &l->allocator, p);
}

ambulo_status ambulo__front_gather(const char *directory, const ambulo__listing *l,
                                   ambulo__front *front, ambulo__front_report *report) {
  gathering g = {directory, l, front};
  memset(front, 0, sizeof *front);
  front->terms = l->front.terms;
  front->points = l->cases;
  front->wanted = l->front.points;
  front->least = l->front.least;
  memcpy(front->own, l->front.own, sizeof front->own);
  front->point = ambulo__alloc(&l->allocator, (size_t)l->cases, sizeof *front->point);
  if (!front->point) return AMBULO_E_MEMORY;
  /* what they started from is known to the run alone, and not asked here */
  for (int k = 0; k < l->cases; k++)
    front->point[k].from = front->point[k].parent[0] = front->point[k].parent[1] = -1;
  ambulo_status status = ambulo__gather(directory, l, AMBULO__GATHER_FILES, take, &g, NULL);
  if (!status) ambulo__front_judge(front, report);
  return status;
}

void ambulo__front_free(const ambulo_allocator *a, ambulo__front *front) {
  ambulo__free(a, front->point);
  front->point = NULL;
}

const char *ambulo__front_word(ambulo__front_standing standing) {
  static const char *const words[] = {"", "yes", "valley", "dominated", "repeats", "outside"};
  return words[standing];
}
