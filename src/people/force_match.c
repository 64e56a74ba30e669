/* people/force_match.c - which foot a group of force columns belongs to (force_columns.h). */
#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "people/force_columns.h"

enum { MOST_NAMED = 12, LIST = 700 };

/* the names there are, for a message */
static void list_groups(const ambulo__force_columns *c, char text[LIST]) {
  size_t used = 0;
  text[0] = '\0';
  for (int i = 0; i < c->count && used + 1 < LIST; i++) {
    int more = i == MOST_NAMED;
    int length =
        snprintf(text + used, LIST - used, "%s%s", i ? ", " : "", more ? "..." : c->groups[i].name);
    used += length > 0 ? (size_t)length : 0;
    if (more) break;
  }
}

/* "--force-columns right=NAME,left=NAME says which (NAME may be none)" */
static void map_hint(const ambulo_model *model, char text[LIST]) {
  size_t used = (size_t)snprintf(text, LIST, "say which: --force-columns ");
  for (int foot = 0; foot < ambulo_model_foot_count(model) && used + 1 < LIST; foot++) {
    int length = snprintf(text + used, LIST - used, "%s%s=NAME", foot ? "," : "",
                          ambulo_model_foot(model, foot)->name);
    used += length > 0 ? (size_t)length : 0;
  }
  if (used + 1 < LIST) (void)snprintf(text + used, LIST - used, " (or none)");
}

/* -------------------------------------------------------------------- names */

typedef struct words {
  const char *at; /* the next word of a name; letters and digits */
  size_t length;
} words;

static int next_word(words *w) {
  w->at += w->length;
  while (*w->at && !isalnum((unsigned char)*w->at)) w->at++;
  w->length = 0;
  while (isalnum((unsigned char)w->at[w->length])) w->length++;
  return w->length > 0;
}

static int word_is(const words *w, const char *text) {
  return w->length == strlen(text) && strncasecmp(w->at, text, w->length) == 0;
}

/* 'l', 'r', or 0 for any other word */
static int side_of_word(const words *w) {
  if (word_is(w, "l") || word_is(w, "left")) return 'l';
  return word_is(w, "r") || word_is(w, "right") ? 'r' : 0;
}

/* 0: neither side, or both */
static int side_of_name(const char *name) {
  int side = 0;
  for (words w = {name, 0}; next_word(&w);) {
    int one = side_of_word(&w);
    if (one && side && one != side) return 0;
    if (one) side = one;
  }
  return side;
}

static const char *link_of_foot(const ambulo_model *model, int foot) {
  int point = ambulo_model_foot(model, foot)->heel[0];
  return ambulo_model_link(model, ambulo_model_point(model, point)->link)->name;
}

static int side_of_foot(const ambulo_model *model, int foot) {
  int side = side_of_name(ambulo_model_foot(model, foot)->name);
  return side ? side : side_of_name(link_of_foot(model, foot));
}

/* a word that may stand for the foot, and not for a hand */
static int may_be_foot(const words *w, const ambulo_model *model, int foot) {
  static const char *const common[] = {"foot", "feet",  "leg", "limb", "calcn", "calcaneus",
                                       "toes", "plate", "fp",  "grf",  "force", "forceplate"};
  for (size_t i = 0; i < sizeof common / sizeof *common; i++) {
    if (word_is(w, common[i])) return 1;
  }
  const char *names[] = {ambulo_model_foot(model, foot)->name, link_of_foot(model, foot)};
  for (int i = 0; i < 2; i++) {
    for (words own = {names[i], 0}; next_word(&own);) {
      if (own.length == w->length && strncasecmp(own.at, w->at, w->length) == 0) return 1;
    }
  }
  return 0;
}

/* 2: the same name; 1: the same side of the body, and nothing against it; 0: no */
static int fit(const ambulo_model *model, int foot, const char *tag) {
  if (strcasecmp(tag, ambulo_model_foot(model, foot)->name) == 0) return 2;
  int side = side_of_name(tag);
  if (!side || side != side_of_foot(model, foot)) return 0;
  for (words w = {tag, 0}; next_word(&w);) {
    if (!side_of_word(&w) && !may_be_foot(&w, model, foot)) return 0;
  }
  return 1;
}

/* ---------------------------------------------------------------------- map */

typedef struct matching {
  ambulo__force_columns *columns;
  const ambulo_model *model;
  ambulo__doubts *doubts;
  unsigned char *settled; /* [feet]: the map says what it has */
} matching;

static int find_foot(const matching *m, const char *name, size_t length) {
  for (int foot = 0; foot < ambulo_model_foot_count(m->model); foot++) {
    const char *other = ambulo_model_foot(m->model, foot)->name;
    if (strlen(other) == length && strncmp(other, name, length) == 0) return foot;
  }
  return -1;
}

static ambulo_status refuse_map(const matching *m, const char *text, size_t length,
                                const char *why) {
  char hint[LIST];
  map_hint(m->model, hint);
  return ambulo__error(m->doubts->diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, hint,
                       "force columns: '%.*s' %s", length < 200 ? (int)length : 200, text, why);
}

/* one group of a foot: a name, or F:P:T */
static ambulo_status map_group(matching *m, int foot, const char *text, size_t length) {
  int index = ambulo__force_group_named(m->columns, text, length);
  if (index < 0 && memchr(text, ':', length)) {
    ambulo_status status =
        ambulo__force_group_add(m->columns, text, length, m->doubts->diagnostics, &index);
    if (status) return status;
  }
  ambulo__place place = {.file = m->columns->file};
  char list[LIST];
  list_groups(m->columns, list);
  if (index < 0)
    return ambulo__error(m->doubts->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "no columns of forces are called '%.*s'; the file has %s",
                         length < 200 ? (int)length : 200, text, list[0] ? list : "none");
  if (m->columns->groups[index].foot >= 0)
    return refuse_map(m, text, length, "belongs to a foot already");
  m->columns->groups[index].foot = foot;
  return AMBULO_OK;
}

/* "FOOT=GROUP+GROUP" */
static ambulo_status map_entry(matching *m, const char *text, size_t length) {
  const char *equals = memchr(text, '=', length), *end = text + length;
  if (!equals || equals == text || equals + 1 == end)
    return refuse_map(m, text, length, "is not FOOT=NAME");
  int foot = find_foot(m, text, (size_t)(equals - text));
  if (foot < 0) return refuse_map(m, text, (size_t)(equals - text), "is no foot of the model");
  if (m->settled[foot]) return refuse_map(m, text, (size_t)(equals - text), "is given twice");
  m->settled[foot] = 1;
  words rest = {equals + 1, (size_t)(end - equals - 1)};
  if (word_is(&rest, "none")) return AMBULO_OK;
  for (const char *at = equals + 1; at <= end;) {
    const char *plus = memchr(at, '+', (size_t)(end - at));
    const char *stop = plus ? plus : end;
    if (stop == at) return refuse_map(m, text, length, "is not FOOT=NAME");
    ambulo_status status = map_group(m, foot, at, (size_t)(stop - at));
    if (status) return status;
    at = stop + 1;
  }
  return AMBULO_OK;
}

static ambulo_status read_map(matching *m, const char *map) {
  for (const char *at = map; at;) {
    const char *comma = strchr(at, ',');
    ambulo_status status = map_entry(m, at, comma ? (size_t)(comma - at) : strlen(at));
    if (status) return status;
    at = comma ? comma + 1 : NULL;
  }
  return AMBULO_OK;
}

/* -------------------------------------------------------------------- names */

static ambulo_status refuse_both(const matching *m, const char *what, const char *a, const char *b,
                                 const char *tail, const char *whom) {
  ambulo__place place = {.file = m->columns->file};
  char hint[LIST];
  map_hint(m->model, hint);
  return ambulo__error(m->doubts->diagnostics, AMBULO_E_SCHEMA, place, hint,
                       "%s '%s' and '%s' %s '%s'", what, a, b, tail, whom);
}

/* the one group without a foot that fits best; *index -1: none */
static ambulo_status find_group(const matching *m, int foot, int *index) {
  int best = 0;
  *index = -1;
  for (int i = 0; i < m->columns->count; i++) {
    const ambulo__force_group *group = &m->columns->groups[i];
    int quality = group->foot < 0 ? fit(m->model, foot, group->tag) : 0;
    if (quality == 0 || quality < best) continue;
    if (quality == best)
      return refuse_both(m, "the columns", m->columns->groups[*index].name, group->name,
                         "both fit foot", ambulo_model_foot(m->model, foot)->name);
    best = quality;
    *index = i;
  }
  return AMBULO_OK;
}

/* another foot that is not settled and that the group fits as well */
static int rival(const matching *m, int foot, const char *tag) {
  for (int other = 0; other < ambulo_model_foot_count(m->model); other++) {
    if (other == foot || m->settled[other]) continue;
    if (fit(m->model, other, tag) >= fit(m->model, foot, tag)) return other;
  }
  return -1;
}

static ambulo_status match_by_names(matching *m) {
  for (int foot = 0; foot < ambulo_model_foot_count(m->model); foot++) {
    int index;
    if (m->settled[foot]) continue;
    ambulo_status status = find_group(m, foot, &index);
    if (status) return status;
    if (index < 0) continue;
    ambulo__force_group *group = &m->columns->groups[index];
    int other = rival(m, foot, group->tag);
    if (other >= 0)
      return refuse_both(m, "the feet", ambulo_model_foot(m->model, foot)->name,
                         ambulo_model_foot(m->model, other)->name, "both fit the columns",
                         group->name);
    group->foot = foot;
    m->settled[foot] = 1;
  }
  return AMBULO_OK;
}

/* ----------------------------------------------------------- what is left over */

static ambulo_status tell_rest(const matching *m, int mapped) {
  ambulo__force_columns *c = m->columns;
  ambulo__place place = {.file = c->file};
  char list[LIST], hint[LIST];
  int free_groups = 0, matched = 0;
  for (int i = 0; i < c->count; i++) {
    matched += c->groups[i].foot >= 0;
    free_groups += c->groups[i].foot < 0;
  }
  list_groups(c, list);
  map_hint(m->model, hint);
  for (int foot = 0; foot < ambulo_model_foot_count(m->model); foot++) {
    const char *name = ambulo_model_foot(m->model, foot)->name;
    if (m->settled[foot]) continue;
    if (free_groups > 0 && !mapped)
      return ambulo__error(m->doubts->diagnostics, AMBULO_E_SCHEMA, place, hint,
                           "no columns of forces are named after foot '%s'; the file has %s", name,
                           list);
    ambulo__doubt(m->doubts, c->file, hint,
                  "no columns of forces on foot '%s'; it is taken to carry nothing", name);
  }
  for (int i = 0; i < c->count; i++) {
    if (c->groups[i].foot < 0 && !mapped && matched > 0 && !m->doubts->other_forces)
      ambulo__doubt(m->doubts, c->file, hint, "the forces '%s' act on no foot and are left out",
                    c->groups[i].name);
  }
  return AMBULO_OK;
}

static ambulo_status refuse_empty(const ambulo__force_columns *c, ambulo__doubts *doubts) {
  ambulo__place place = {.file = c->file};
  char list[LIST] = "";
  size_t used = 0;
  for (int i = 0; i < c->table->columns && used + 1 < LIST; i++) {
    int more = i == MOST_NAMED;
    int length = snprintf(list + used, LIST - used, "%s%s", i ? ", " : "",
                          more ? "..." : c->table->names[i]);
    used += length > 0 ? (size_t)length : 0;
    if (more) break;
  }
  return ambulo__error(doubts->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                       "no column of forces on a foot; expected for example ground_force_r_vx or "
                       "grf.right.x, or --force-columns FOOT=F:P:T with the beginnings of their "
                       "names; the file has %s",
                       list);
}

ambulo_status ambulo__force_columns_match(ambulo__force_columns *columns, const ambulo_model *model,
                                          const char *map, ambulo__doubts *doubts) {
  matching m = {.columns = columns, .model = model, .doubts = doubts};
  size_t feet = (size_t)ambulo_model_foot_count(model);
  int forces = 0;
  m.settled = ambulo__alloc(&columns->allocator, feet, 1);
  if (!m.settled) return AMBULO_E_MEMORY;
  ambulo_status status = map ? read_map(&m, map) : AMBULO_OK;
  if (!status) status = match_by_names(&m);
  for (int i = 0; i < columns->count; i++) {
    const int *force = columns->groups[i].force;
    forces += force[0] >= 0 || force[1] >= 0 || force[2] >= 0;
  }
  if (!status && forces == 0 && !map) status = refuse_empty(columns, doubts);
  if (!status) status = tell_rest(&m, map != NULL);
  ambulo__free(&columns->allocator, m.settled);
  return status;
}
