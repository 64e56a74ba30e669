/* exchange/side.c - left and right in names (side.h).
 *
 * A side is the word left or right in any case, or the letter l or r alone between characters that
 * are no letters or digits (FL_HIP and HR_HIP: front and hind), or at the front as a capital before
 * a capital: LHip, but not Lever. Where R may be roll as well (RLEG_ANKLE_R), single letters are
 * exchanged one at a time.
 */
#include "exchange/side.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

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
