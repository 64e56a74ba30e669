/* study/front_cases.c - the key `front` of a sweep file: which terms, how many points; and the
 * cases of a front, which grow while it is computed.
 *
 *     front: {terms: [torque_power, force_rate], points: 12, least: 0.01}
 *
 * The weight of each term is an axis, named weight(TERM), whose key is that of the term's weight in
 * the base problem. The file's own weights say how terms compare before anything is known of the
 * front. Point k of the front is case k of the list: a point is named by its place in the list, an
 * anchor by the term that it has least of. */
#include "base/diagnostics.h"
#include "base/numtext.h"
#include "problem/nlp.h"
#include "study/study.h"

#include <stdio.h>
#include <string.h>

enum { MOST_TERMS = 64, HINT = 200, DEFAULT_POINTS = 12 };
static const double default_least = 0.01;

/* --------------------------------------------------------------------- reading */

/* keys that make a list of cases: a front makes its own */
static ambulo_status refuse_others(const ambulo__yaml_node *root) {
  static const char *const others[] = {"axes",   "combine", "table", "latin_hypercube",
                                       "random", "filters", "cases", "case_name",
                                       "along"};
  for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
    const ambulo__yaml_node *node = ambulo__yaml_get(root, others[i]);
    if (node)
      return ambulo__yaml_error(node, AMBULO_E_SCHEMA,
                                "a front of another problem is a sweep of its own",
                                "'%s' beside 'front', which makes its cases itself; expected one "
                                "of them",
                                others[i]);
  }
  return AMBULO_OK;
}

static ambulo_status read_terms(ambulo_sweep *s, const ambulo__yaml_node *node) {
  if (!node) return AMBULO_OK;
  if (!ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE))
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                              "'terms' is no list; expected two or three terms of the objective");
  int items = ambulo__yaml_items(node);
  if (items < 2 || items > AMBULO__FRONT_TERMS)
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                              "a front of %d term%s; expected two or three", items,
                              items == 1 ? "" : "s");
  for (int i = 0; i < items; i++) {
    ambulo_status status = ambulo__sweep_copy(s, ambulo__yaml_item(node, i), &s->front.name[i]);
    if (status) return status;
  }
  s->front.terms = items;
  return AMBULO_OK;
}

ambulo_status ambulo__sweep_read_front(ambulo_sweep *s, const ambulo__yaml_node *root) {
  const ambulo__yaml_node *node = ambulo__yaml_get(root, "front");
  if (!node) return AMBULO_OK;
  ambulo_status status = refuse_others(root);
  const ambulo__yaml_node *terms = ambulo__yaml_require(node, "terms");
  if (!status) status = read_terms(s, terms);
  int fewest = s->front.terms > 0 ? s->front.terms + 1 : 3;
  s->front.wanted = ambulo__yaml_integer(ambulo__yaml_get(node, "points"), fewest,
                                         AMBULO__FRONT_POINTS, DEFAULT_POINTS);
  s->front.least =
      ambulo__yaml_number_in(ambulo__yaml_get(node, "least"), 1e-6, 0.2, default_least);
  return ambulo__sweep_close(node, status);
}

/* --------------------------------------------------------- the base's terms */

/* "did you mean 'force_rate'?", or the terms that are not in the list yet */
static void hint_terms(const ambulo_sweep *s, const ambulo_problem *base, const char *word,
                       char hint[HINT]) {
  const char *name[MOST_TERMS];
  int count = ambulo_problem_term_count(base), others = 0;
  if (count > MOST_TERMS) count = MOST_TERMS;
  for (int i = 0; i < count; i++) name[i] = ambulo_problem_term_name(base, i);
  const char *near = ambulo__nearest(word, name, (size_t)count);
  hint[0] = '\0';
  if (near && strcmp(near, word) != 0) (void)snprintf(hint, HINT, "did you mean '%s'?", near);
  for (int i = 0; i < count && (others || !hint[0]); i++) {
    int taken = 0;
    for (int k = 0; k < s->front.terms; k++) taken |= strcmp(name[i], s->front.name[k]) == 0;
    size_t used = strlen(hint);
    if (!taken)
      (void)snprintf(hint + used, HINT - used, "%s%s", others++ ? ", " : "other terms: ", name[i]);
  }
}

static ambulo_status take_term(ambulo_sweep *s, const ambulo_problem *base,
                               const ambulo__yaml_node *node, int index) {
  char hint[HINT], key[48], name[AMBULO__SWEEP_TEXT];
  const char *word = s->front.name[index];
  int found = 0, count = ambulo_problem_term_count(base);
  while (found < count && strcmp(ambulo_problem_term_name(base, found), word) != 0) found++;
  hint_terms(s, base, word, hint);
  if (found == count)
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, hint[0] ? hint : NULL,
                              "unknown term (got '%s'); expected a term of the base problem's "
                              "objective",
                              word);
  for (int i = 0; i < index; i++)
    if (strcmp(s->front.name[i], word) == 0)
      return ambulo__yaml_error(node, AMBULO_E_SCHEMA, hint[0] ? hint : NULL,
                                "the term '%s' twice; expected different terms", word);
  s->front.own[index] = base->definition.terms[found].weight;
  if (!(s->front.own[index] > 0.0))
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA,
                              "weights of the base problem say how its terms compare",
                              "the term '%s' has no weight in the base problem; expected a "
                              "positive one",
                              word);
  ambulo__axis *axis = NULL;
  (void)snprintf(key, sizeof key, "objective[%d].weight", found);
  (void)snprintf(name, sizeof name, "weight(%.200s)", word);
  return ambulo__sweep_add_axis(s, name, key, ambulo__spot_of(node), &axis);
}

/* --------------------------------------------------------------------- cases */

/* whether a case is an anchor of this term */
static int is_anchor(const char *name, const char *term) {
  static const char lead[] = "least ";
  size_t length = strlen(term);
  if (strncmp(name, lead, sizeof lead - 1) != 0) return 0;
  name += sizeof lead - 1;
  return strncmp(name, term, length) == 0 && (!name[length] || name[length] == ',');
}

static void name_point(const ambulo_sweep *s, const ambulo__front_request *request,
                       char name[AMBULO__SWEEP_TEXT]) {
  int again = 0;
  for (int k = 0; k < s->case_count && request->anchor >= 0; k++)
    again += is_anchor(s->cases[k].name, s->front.name[request->anchor]);
  if (request->anchor >= 0 && again > 0) {
    (void)snprintf(name, AMBULO__SWEEP_TEXT, "least %.200s, %d", s->front.name[request->anchor],
                   again + 1);
  } else if (request->anchor >= 0) {
    (void)snprintf(name, AMBULO__SWEEP_TEXT, "least %.200s", s->front.name[request->anchor]);
  } else if (request->from >= 0 && !s->front.neighbour) {
    (void)snprintf(name, AMBULO__SWEEP_TEXT, "%d from %d", s->case_count + 1, request->from + 1);
  } else {
    (void)snprintf(name, AMBULO__SWEEP_TEXT, "%d", s->case_count + 1);
  }
}

ambulo_status ambulo__sweep_append_point(ambulo_sweep *s, const ambulo__front_request *request,
                                         ambulo_diagnostics *diagnostics, int *index) {
  char text[AMBULO__FRONT_TERMS][AMBULO__NUMTEXT_SIZE + 64], name[AMBULO__SWEEP_TEXT];
  const char *overrides[AMBULO__FRONT_TERMS];
  for (int i = 0; i < s->axes; i++) {
    (void)snprintf(text[i], sizeof text[i], "%.48s=%s", s->axis[i].key,
                   ambulo__number_text(request->weight[i]).text);
    overrides[i] = text[i];
  }
  name_point(s, request, name);
  return ambulo__sweep_append(s, name, overrides, s->axes, request->from, diagnostics, index);
}

ambulo_status ambulo__sweep_build_front(ambulo_sweep *s, const ambulo__yaml_node *node,
                                        const ambulo_problem *base) {
  const ambulo__yaml_node *list = ambulo__yaml_get(node, "terms");
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < s->front.terms && !status; i++)
    status = take_term(s, base, ambulo__yaml_item(list, i), i);
  int anchor[AMBULO__FRONT_TERMS], count = 0, probe[AMBULO__FRONT_TERMS] = {0};
  double lowest[AMBULO__FRONT_TERMS], range[AMBULO__FRONT_TERMS];
  ambulo__front_request request[AMBULO__FRONT_TERMS];
  if (!status) (void)ambulo__front_anchors(&s->front, anchor, lowest, range, request, &count);
  for (int i = 0; i < count && !status; i++)
    status = ambulo__sweep_append_point(s, &request[i], s->diagnostics, &probe[i]);
  return status ? status : ambulo__sweep_check_cases(s, probe, count);
}
