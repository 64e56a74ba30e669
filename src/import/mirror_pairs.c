/* import/mirror_pairs.c - which coordinate takes whose place in the mirror image.
 *
 * Partners are found by name (body_tree.h); their sign by the axes at q = 0: with H the reflection
 * of left, a_partner = sign H a for sliders and -sign H a for hinges (docs/model-format.md). Where
 * neither sign fits, the body is not symmetric there and nothing is said.
 */
#include "import/body_tree.h"

#include "base/arithmetic.h"

#include <ctype.h>
#include <math.h>
#include <string.h>
#include <strings.h>

/* ------------------------------------------------------ left and right in names */

/* A side is the word left or right in any case, or the letter l or r alone between characters that
 * are no letters or digits (FL_HIP and HR_HIP: front and hind), or at the front as a capital before
 * a capital: LHip, but not Lever. Where R may be roll as well (RLEG_ANKLE_R), single letters are
 * exchanged one at a time.
 */

static int is_word(char c) {
  return isalnum((unsigned char)c) != 0;
}

/* Length of the side that name + at begins with, 0: none. */
static size_t side_at(const char *name, size_t at) {
  const char *here = name + at;
  if (strncasecmp(here, "left", 4) == 0) return 4;
  if (strncasecmp(here, "right", 5) == 0) return 5;
  char c = (char)tolower((unsigned char)here[0]);
  if (c != 'l' && c != 'r') return 0;
  int starts = at == 0 || !is_word(name[at - 1]);
  int corner = at > 0 && strchr("FHBfhb", name[at - 1]) && (at == 1 || !is_word(name[at - 2]));
  int alone = (starts || corner) && !is_word(here[1]);
  int capital = at == 0 && isupper((unsigned char)here[0]) && isupper((unsigned char)here[1]) &&
                islower((unsigned char)here[2]);
  return alone || capital ? 1 : 0;
}

char ambulo__side_of(const char *name) {
  for (size_t i = 0; name[i]; i++)
    if (side_at(name, i)) return (char)tolower((unsigned char)name[i]);
  return 0;
}

/* the other word, with the case of the first letter, or of all */
static void exchange(const char *side, size_t length, char *out) {
  int left = tolower((unsigned char)side[0]) == 'l';
  const char *word = length == 1 ? (left ? "r" : "l") : left ? "right" : "left";
  int all = length > 1 && isupper((unsigned char)side[1]);
  for (size_t i = 0; word[i]; i++) {
    int capital = all || (i == 0 && isupper((unsigned char)side[0]));
    out[i] = capital ? (char)toupper((unsigned char)word[i]) : word[i];
    out[i + 1] = '\0';
  }
}

int ambulo__flip_letter(const char *name, size_t at, char *text, size_t size) {
  static const char letters[] = "lrLR", others[] = "rlRL";
  const char *found = strchr(letters, name[at]);
  if (!found || !name[at] || strlen(name) + 1 > size) return 0;
  memcpy(text, name, strlen(name) + 1);
  text[at] = others[found - letters];
  return 1;
}

int ambulo__other_side(const char *name, char *text, size_t size) {
  size_t used = 0;
  int found = 0;
  for (size_t i = 0; name[i];) {
    size_t length = side_at(name, i);
    char word[8] = {name[i], '\0'};
    if (length) exchange(name + i, length, word);
    if (used + strlen(word) + 1 > size) return 0;
    memcpy(text + used, word, strlen(word) + 1);
    used += strlen(word);
    found |= length > 0;
    i += length ? length : 1;
  }
  return found;
}

/* ------------------------------------------------------------------------ pairs */

/* sine of the angle by which axes of the two sides may differ from images: what people round in
 * files; `ambulo info` tells of less */
static const double alike = 1e-3;

static void left_of(const ambulo__tree *tree, double left[3]) {
  double up[3] = {-tree->gravity[0], -tree->gravity[1], -tree->gravity[2]};
  ambulo__cross(up, tree->forward, left);
  (void)ambulo__normalize(left);
}

/* +1 or -1; 0: neither */
static double sign_of(ambulo__tree *tree, int link, int partner, const double left[3]) {
  double a[3], b[3];
  ambulo__rigid place = ambulo__tree_place(tree, link), other = ambulo__tree_place(tree, partner);
  ambulo__rigid_vector(&place, tree->links[link].axis, a);
  ambulo__rigid_vector(&other, tree->links[partner].axis, b);
  double across = ambulo__dot(a, left),
         kind = tree->links[link].type == AMBULO_REVOLUTE ? -1.0 : 1.0;
  for (int i = 0; i < 3; i++) a[i] = kind * (a[i] - 2.0 * across * left[i]);
  for (int sign = 1; sign >= -1; sign -= 2) {
    double away = 0.0;
    for (int i = 0; i < 3; i++) away = fmax(away, fabs(b[i] - sign * a[i]));
    if (away < alike) return sign;
  }
  return 0.0;
}

/* What has the name with the sides that it says exchanged; else with one letter l or r exchanged,
 * wherever that makes another name: lfemurrx, leg_l4, LR_HR of a left leg (its hip's roll). */
static int partner_by_name(const ambulo__tree *tree, const char *own,
                           int (*find)(const ambulo__tree *, const char *)) {
  char name[80];
  int partner = ambulo__other_side(own, name, sizeof name) ? find(tree, name) : -1;
  for (size_t i = 0; partner < 0 && own[i]; i++)
    if (ambulo__flip_letter(own, i, name, sizeof name)) partner = find(tree, name);
  return partner;
}

int ambulo__partner_link(const ambulo__tree *tree, int link) {
  return partner_by_name(tree, tree->links[link].name, ambulo__tree_find);
}

char ambulo__side_of_link(const ambulo__tree *tree, int link) {
  const char *own = tree->links[link].name;
  int partner = ambulo__partner_link(tree, link);
  if (partner < 0) return ambulo__side_of(own);
  const char *other = tree->links[partner].name;
  size_t i = 0;
  while (own[i] && tolower((unsigned char)own[i]) == tolower((unsigned char)other[i])) i++;
  return (char)tolower((unsigned char)own[i]);
}

int ambulo__partner_coordinate(const ambulo__tree *tree, int link) {
  const char *own = tree->links[link].coordinate.name;
  int partner = partner_by_name(tree, own, ambulo__tree_find_coordinate);
  if (partner < 0 || tree->links[partner].type != tree->links[link].type) return link;
  own = tree->links[partner].coordinate.name;
  return partner_by_name(tree, own, ambulo__tree_find_coordinate) == link ? partner : link;
}

void ambulo__find_mirrors(ambulo__tree *tree) {
  double left[3];
  int lonely = 0;
  const char *example = "";
  left_of(tree, left);
  for (int i = 0; i < tree->link_count; i++) {
    ambulo__tree_link *link = &tree->links[i];
    if (link->type == AMBULO_FIXED || link->follows) continue;
    int partner = ambulo__partner_coordinate(tree, i);
    double sign = sign_of(tree, i, partner, left);
    link->has_mirror = sign != 0.0;
    if (partner == i && !link->has_mirror && ambulo__side_of(link->coordinate.name)) {
      lonely++;
      example = link->coordinate.name;
    }
    link->coordinate.mirror = partner;
    link->coordinate.mirror_sign = sign;
  }
  if (lonely)
    ambulo__tree_note(tree, NULL, "%d coordinates have no partner on the other side (%s, for one)",
                      lonely, example);
}

/* fl and fr, l1 and r1; names of the importer's own begin or end with their side */
int ambulo__tree_mirror_foot(const ambulo__tree *tree, int foot) {
  char name[80];
  const char *own = tree->feet[foot].name;
  size_t length = strlen(own), at = length > 1 && isdigit((unsigned char)own[1]) ? 0 : length - 1;
  int sided = ambulo__other_side(own, name, sizeof name) ||
              (length == 2 && ambulo__flip_letter(own, at, name, sizeof name));
  for (int i = 0; sided && i < tree->foot_count; i++)
    if (strcmp(tree->feet[i].name, name) == 0) return i;
  return -1;
}
