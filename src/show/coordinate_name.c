/* show/coordinate_name.c - see coordinate_name.h. */
#include "show/coordinate_name.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "model/neutral_pose.h"

static const double apart = 0.001; /* m: joints nearer than that stand in the median plane */

static int is_letter(char c, char letter) {
  return c == letter || c == letter - 'a' + 'A';
}

static int begins_with(const char *text, const char *word) {
  while (*word && is_letter(*text, *word)) text++, word++;
  return *word == '\0';
}

/* where two names part */
static size_t parting(const char *a, const char *b) {
  size_t i = 0;
  while (a[i] && a[i] == b[i]) i++;
  return i;
}

static ambulo__side side_of_names(const char *own, const char *other) {
  size_t at = parting(own, other);
  if (is_letter(own[at], 'l') && is_letter(other[at], 'r')) return AMBULO__LEFT;
  if (is_letter(own[at], 'r') && is_letter(other[at], 'l')) return AMBULO__RIGHT;
  return AMBULO__MIDDLE;
}

static double stands_left(const ambulo_model *model, int coordinate) {
  static const double origin[3] = {0.0, 0.0, 0.0};
  double world[3];
  ambulo__neutral_place(model, model->coordinate_link[coordinate], origin, world);
  return ambulo__dot(world, model->left);
}

ambulo__side ambulo__coordinate_side(const ambulo_model *model, int coordinate) {
  const ambulo_coordinate *c = &model->coordinates[coordinate];
  if (c->mirror == coordinate) return AMBULO__MIDDLE;
  ambulo__side named = side_of_names(c->name, model->coordinates[c->mirror].name);
  if (named != AMBULO__MIDDLE) return named;
  double left = stands_left(model, coordinate) - stands_left(model, c->mirror);
  if (fabs(left) > apart) return left > 0.0 ? AMBULO__LEFT : AMBULO__RIGHT;
  return c->mirror > coordinate ? AMBULO__RIGHT : AMBULO__LEFT;
}

/* the letters of the side: from[0] up to from[1]; none where the names do not say it */
static void find_side(const char *own, const char *other, size_t from[2]) {
  from[0] = from[1] = parting(own, other);
  if (side_of_names(own, other) == AMBULO__MIDDLE) return;
  const char *at = own + from[0];
  from[1] += begins_with(at, "left") ? 4 : begins_with(at, "right") ? 5 : 1;
}

void ambulo__coordinate_title(const ambulo_model *model, int coordinate, ambulo__text_buffer *out) {
  const ambulo_coordinate *c = &model->coordinates[coordinate];
  size_t side[2];
  find_side(c->name, model->coordinates[c->mirror].name, side);
  int space = 0, first = 1;
  for (size_t k = 0; c->name[k]; k++) {
    char letter = c->name[k];
    if (k >= side[0] && k < side[1]) continue;
    if (letter == '_' || letter == ' ') {
      space = !first;
      continue;
    }
    if (space) ambulo__text_append_char(out, ' ');
    if (first && letter >= 'a' && letter <= 'z') letter = (char)(letter - 'a' + 'A');
    ambulo__text_append_char(out, letter);
    space = first = 0;
  }
}
