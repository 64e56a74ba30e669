/* definitions/muscle_mirror.c - the muscles of the other side (muscle_file.c). */
#include "definitions/muscle_reader.h"

#include <string.h>

const char *ambulo__muscle_other_side(ambulo__muscle_reader *r, const char *name) {
  size_t length = strlen(name), end = r->suffix[0] ? strlen(r->suffix[0]) : length;
  if (length <= end || strcmp(name + length - end, r->suffix[0]) != 0) return NULL;
  return ambulo__arena_print(&r->arena, "%.*s%s", (int)(length - end), name, r->suffix[1]);
}

/* sign of a term where coordinates change theirs */
static double sign_of(const ambulo__muscle_reader *r, const ambulo_muscle *m,
                      const unsigned char *exponents) {
  double sign = 1.0;
  for (int i = 0; i < m->coordinate_count; i++)
    if (m->coordinates[i] >= 0 && exponents[i] % 2)
      sign *= r->model->coordinates[m->coordinates[i]].mirror_sign;
  return sign;
}

static int mirror_link(ambulo__muscle_reader *r, int link) {
  const char *name = link < 0 ? NULL : ambulo__muscle_other_side(r, r->model->links[link].name);
  return name ? ambulo_model_find_link(r->model, name) : link;
}

static void mirror_pulls(ambulo__muscle_reader *r, const ambulo_muscle *m, ambulo_muscle *image) {
  ambulo_muscle_pull *pulls = ambulo__arena_take(&r->arena, (size_t)m->pull_count, sizeof *pulls);
  for (int p = 0; pulls && p < m->pull_count; p++) {
    const ambulo_muscle_pull *own = &m->pulls[p];
    double(*slopes)[3] = ambulo__arena_take(&r->arena, (size_t)own->term_count, sizeof *slopes);
    pulls[p] = *own;
    const char *image_name = ambulo__muscle_other_side(r, own->joint);
    if (image_name) pulls[p].joint = image_name;
    pulls[p].link = mirror_link(r, own->link);
    pulls[p].axes = mirror_link(r, own->axes);
    pulls[p].slopes = (const double(*)[3])slopes;
    for (int t = 0; slopes && t < own->term_count; t++)
      for (int k = 0; k < 3; k++)
        slopes[t][k] = sign_of(r, m, own->exponents[t]) * (k == 2 ? -1.0 : 1.0) * own->slopes[t][k];
  }
  image->pulls = pulls;
}

void ambulo__muscle_mirror(ambulo__muscle_reader *r, const ambulo__yaml_node *item, int index) {
  ambulo_muscle *m = &r->muscles[index], *image = &r->muscles[r->count + index];
  const char *name = ambulo__muscle_other_side(r, m->name);
  if (!name) {
    (void)ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL,
                             "muscle '%s' is not of the side '%s' that has a mirror image", m->name,
                             r->suffix[0]);
    return;
  }
  *image = *m;
  image->name = name;
  image->mirror = index;
  m->mirror = r->count + index;
  if (m->elastic >= 0) image->elastic = r->model->coordinates[m->elastic].mirror;
  double *length = ambulo__arena_take(&r->arena, (size_t)m->term_count, sizeof *length);
  for (int t = 0; length && m->length && t < m->term_count; t++)
    length[t] = sign_of(r, m, m->exponents[t]) * m->length[t];
  image->length = length;
  for (int i = 0; i < m->coordinate_count; i++) {
    const ambulo_coordinate *q = ambulo_model_coordinate(r->model, m->coordinates[i]);
    image->coordinates[i] = q ? q->mirror : -1;
    for (int end = 0; q && q->mirror_sign < 0.0 && end < 2; end++)
      image->range[i][end] = -m->range[i][1 - end];
  }
  mirror_pulls(r, m, image);
}
