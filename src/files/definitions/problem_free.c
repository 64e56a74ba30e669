/* definitions/problem_free.c - `free:` of a problem file: which numbers the solver chooses, between
 * which bounds.
 *
 * The keys are names of sensitivities, which are known once there is a problem. A bound that no
 * file may say is refused; whether a problem makes sense at a bound is found out by the run.
 */
#include "definitions/problem_free.h"

#include "formats/read_file.h"
#include "solver/free_search.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_FREE = 64, LIST = 1600 };

/* as they are read, before they are packed into one block */
typedef struct gathered {
  ambulo__problem_reader *reader;
  const ambulo__yaml_node *section;
  ambulo_problem *problem;
  ambulo__parameters known;
  ambulo_parameter *item;
  int count;
  ambulo_per per;
  int solves;
} gathered;

/* ------------------------------------------------------------------- refusals */

/* names of the walk, the ground and the body one by one, of lists by their heads */
static void list_known(const gathered *g, char text[LIST]) {
  size_t used = 0;
  int terms = 0, limits = 0;
  text[0] = '\0';
  for (int i = 0; i < g->known.count; i++) {
    const char *name = g->known.list[i].name;
    terms += strncmp(name, "objective[", 10) == 0;
    limits += strncmp(name, "model.", 6) == 0;
    if (strncmp(name, "objective[", 10) == 0 || strncmp(name, "model.", 6) == 0) continue;
    int length = snprintf(text + used, LIST - used, "%s%s", used ? ", " : "", name);
    if (length < 0 || (size_t)length >= LIST - used) break;
    used += (size_t)length;
  }
  if (terms > 0 && used < LIST)
    used += (size_t)snprintf(text + used, LIST - used, ", numbers of 'objective'");
  if (limits > 0 && used < LIST) (void)snprintf(text + used, LIST - used, ", limits of 'model'");
}

static void refuse_name(const gathered *g, const ambulo__yaml_node *node, const char *name) {
  char list[LIST], hint[LIST + 40];
  const char **names = ambulo__reader_alloc(g->reader, (size_t)g->known.count, sizeof *names);
  if (!names) return;
  for (int i = 0; i < g->known.count; i++) names[i] = g->known.list[i].name;
  const char *near = ambulo__nearest(name, names, (size_t)g->known.count);
  list_known(g, list);
  if (strcmp(name, "gait.step_time") == 0 && g->reader->gait)
    (void)snprintf(hint, sizeof hint,
                   "give gait.step_time a value, beside gait.speed and in place of time.duration "
                   "and gait.step_length");
  else if (near)
    (void)snprintf(hint, sizeof hint, "did you mean '%s'?", near);
  else
    (void)snprintf(hint, sizeof hint, "those are %s", list);
  (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, hint,
                           "'%s' cannot be free; expected a number of this problem on which the "
                           "least objective depends smoothly",
                           name);
}

static void tell_outside(const ambulo__yaml_node *node, const ambulo__parameter *p, double unit,
                         const double bound[2]) {
  double value = p->value / unit;
  const char *of_unit = unit == 1.0 ? ambulo__quantity_unit(p->quantity) : "";
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                           "%s is %.9g, outside of %.9g to %.9g; expected bounds around it%s%s",
                           p->name, value, bound[0], bound[1], of_unit[0] ? ", in " : "", of_unit);
}

/* what no file may say */
static int is_legal(const ambulo__yaml_node *node, const ambulo__parameter *p, double unit,
                    double bound) {
  double low = p->low / unit, high = p->high / unit;
  if (bound >= low * (1.0 - 1e-12) - 1e-300 && bound <= high * (1.0 + 1e-12)) return 1;
  (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "got '%g'; expected a number from %g to %g",
                           bound, low, high);
  return 0;
}

/* -------------------------------------------------------------------- reading */

static void read_item(gathered *g, const char *name, const ambulo__yaml_node *node) {
  double bound[2] = {0.0, 0.0};
  const ambulo__parameter *p = ambulo__parameters_find(&g->known, name);
  int smooth = 1;
  if (p && ambulo__parameter_is_smooth(&g->known, p, &smooth)) {
    g->reader->failure = AMBULO_E_MEMORY;
    return;
  }
  if (!p || !smooth) {
    refuse_name(g, node, name);
    return;
  }
  if (!ambulo__yaml_numbers(node, 2, bound)) return;
  double unit = ambulo__parameter_unit(g->problem, p);
  if (g->problem->keys.written_for && strncmp(name, "objective[", 10) == 0) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "'%s' cannot be free in a file that is written for another body; "
                             "expected a number of the walk, the ground or the constraints",
                             name);
    return;
  }
  if (unit == 0.0) {
    (void)ambulo__read_plain_angle(g->reader, node, 0.0); /* says what is missing */
    return;
  }
  if (!(bound[0] < bound[1])) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "bounds of %s from %.9g to %.9g; expected [lower, upper]", name,
                             bound[0], bound[1]);
    return;
  }
  double lower = unit * bound[0], upper = unit * bound[1], slack = 1e-12 * (upper - lower);
  if (!(p->value >= lower - slack && p->value <= upper + slack)) {
    tell_outside(node, p, unit, bound);
    return;
  }
  if (!is_legal(ambulo__yaml_item(node, 0), p, unit, bound[0]) ||
      !is_legal(ambulo__yaml_item(node, 1), p, unit, bound[1]))
    return;
  g->item[g->count++] = (ambulo_parameter){p->name, lower, upper};
}

static int is_setting(const char *key) {
  return strcmp(key, "per") == 0 || strcmp(key, "maximum_solves") == 0;
}

static void read_settings(gathered *g) {
  static const char *const words[] = {"distance", "none"};
  const ambulo__yaml_node *per = ambulo__yaml_get(g->section, "per");
  int choice = ambulo__yaml_choice(per, words, 2, -1);
  g->per = choice < 0 ? AMBULO_PER_DEFAULT : choice ? AMBULO_PER_NONE : AMBULO_PER_DISTANCE;
  if (g->per == AMBULO_PER_DISTANCE && g->problem->definition.travel == 0.0)
    (void)ambulo__yaml_error(per, AMBULO_E_PROBLEM, NULL,
                             "the objective per distance, but the body travels 0 m; expected "
                             "'per: none'");
  g->solves = ambulo__yaml_integer(ambulo__yaml_get(g->section, "maximum_solves"), 1, 1000000,
                                   ambulo_parameters_default().maximum_solves);
}

/* the other side's number moves along: it is not free beside it */
static void read_items(gathered *g) {
  int pairs = ambulo__yaml_pairs(g->section), items = 0;
  for (int i = 0; i < pairs; i++) {
    const char *name = ambulo__yaml_key(g->section, i);
    if (is_setting(name)) continue;
    ambulo__yaml_expect(g->section, name);
    if (++items <= MOST_FREE) read_item(g, name, ambulo__yaml_value(g->section, i));
  }
  if (items > 0 && items <= MOST_FREE) return;
  (void)ambulo__yaml_error(g->section, items ? AMBULO_E_LIMIT : AMBULO_E_SCHEMA, NULL,
                           "%d free parameters; expected 1 to %d, as in 'gait.step_time: "
                           "[0.4, 0.8]'",
                           items, MOST_FREE);
}

/* another result than without */
static unsigned long long add_to_hash(unsigned long long hash, const gathered *g) {
  char text[64];
  for (int i = 0; i < g->count; i++) {
    (void)snprintf(text, sizeof text, "%.17g %.17g", g->item[i].lower, g->item[i].upper);
    hash = ambulo__hash_text(ambulo__hash_text(hash, g->item[i].name), text);
  }
  return ambulo__hash_word(hash, (unsigned long long)g->per);
}

static ambulo_status gather(gathered *g) {
  ambulo_status status = ambulo__parameters_init(g->problem, &g->reader->allocator, &g->known);
  g->item = ambulo__reader_alloc(g->reader, MOST_FREE, sizeof *g->item);
  if (status || !g->item) return AMBULO_E_MEMORY;
  read_settings(g);
  read_items(g);
  if (g->reader->failure) return g->reader->failure;
  status = ambulo__yaml_finish(g->reader->document);
  ambulo_parameters free = ambulo_parameters_default();
  free.items = g->item;
  free.count = g->count;
  free.per = g->per;
  free.maximum_solves = g->solves;
  if (!status) status = ambulo__free_keep(g->problem, &free);
  if (!status) g->problem->hash = add_to_hash(g->problem->hash, g);
  return status;
}

ambulo_status ambulo__read_free(ambulo__problem_reader *reader, const ambulo__yaml_node *root,
                                ambulo_problem *problem) {
  const ambulo__yaml_node *section = ambulo__reader_section(root, "free");
  if (!section) return ambulo__yaml_finish(reader->document);
  gathered g = {.reader = reader, .section = section, .problem = problem};
  ambulo_status status = gather(&g);
  ambulo__parameters_clear(&g.known);
  return status;
}
