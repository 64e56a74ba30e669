/* cli/foot_list.c - see foot_list.h.
 *
 * What an answer gives is found out by an import that is thrown away: the body with these feet, or
 * a refusal. A link stands, in the start pose, at the product of its chain's
 *
 *     T = Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha)        (docs/conventions.md)
 */
#include "cli/foot_list.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "ambulo/model.h"
#include "ambulo/tools/report.h"
#include "ambulo/tools/load.h"
#include "cli/format.h"

enum { LINE = 240 };
static const char *const sides[AMBULO__CLI_FEET] = {"left", "right"};
static const double middle = 0.01; /* m: nearer to it a link is on neither side */

typedef struct place {
  double r[3][3], p[3]; /* columns of r: axes of the link */
} place;

typedef struct end {
  int link;
  double height, left; /* m */
} end;

/* the body with these options; NULL: it is refused, and *status says why */
static ambulo_model *imported(const char *source, const ambulo_import_options *options,
                              ambulo_status *status) {
  char *text = NULL;
  ambulo_model *model = NULL;
  *status = ambulo_import_model(source, NULL, options, NULL, NULL, &text);
  if (!*status)
    *status = ambulo_model_load_text(text, strlen(text), source, NULL, NULL, NULL, &model);
  ambulo_text_free(text, NULL);
  return model;
}

/* -------------------------------------------------------------------- the list */

static place after(const place *at, const ambulo_link *link, double q) {
  double theta = link->theta + (link->type == AMBULO_REVOLUTE ? q : 0.0);
  double d = link->d + (link->type == AMBULO_PRISMATIC ? q : 0.0);
  double ct = cos(theta), st = sin(theta), ca = cos(link->alpha), sa = sin(link->alpha);
  const double r[3][3] = {{ct, -st * ca, st * sa}, {st, ct * ca, -ct * sa}, {0.0, sa, ca}};
  const double p[3] = {link->a * ct, link->a * st, d};
  place next = *at;
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) {
      next.r[i][k] = 0.0;
      for (int j = 0; j < 3; j++) next.r[i][k] += at->r[i][j] * r[j][k];
      next.p[i] += at->r[i][k] * p[k];
    }
  return next;
}

static place place_of(const ambulo_model *model, int link) {
  place at = {.r = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  const ambulo_link *l = ambulo_model_link(model, link);
  const ambulo_coordinate *c = ambulo_model_coordinate(model, l->coordinate);
  if (l->parent >= 0) at = place_of(model, l->parent);
  return after(&at, l, c ? c->default_value : 0.0);
}

static int by_height(const void *one, const void *other) {
  const end *a = one, *b = other;
  if (fabs(a->height - b->height) > 1e-6) return a->height < b->height ? -1 : 1;
  return a->link - b->link;
}

static int is_end(const ambulo_model *model, int link) {
  for (int i = 0; i < ambulo_model_link_count(model); i++)
    if (ambulo_model_link(model, i)->parent == link) return 0;
  return 1;
}

/* lowest first; how many */
static int find_ends(const ambulo_model *model, end *ends) {
  int count = 0;
  const double *up = ambulo_model_up(model), *left = ambulo_model_left(model);
  for (int i = 0; i < ambulo_model_link_count(model); i++) {
    if (!is_end(model, i)) continue;
    place at = place_of(model, i);
    ends[count] = (end){.link = i};
    for (int k = 0; k < 3; k++) {
      ends[count].height += up[k] * at.p[k];
      ends[count].left += left[k] * at.p[k];
    }
    count++;
  }
  qsort(ends, (size_t)count, sizeof *ends, by_height);
  return count;
}

static void print_ends(const ambulo_model *model, const end *ends, int count) {
  fputs("No link says that it is a foot and has geometry. Links at the ends of the body, by their\n"
        "height above the lowest one, m:\n",
        stderr);
  for (int i = 0; i < count; i++)
    fprintf(stderr, "%4d  %-6s %5.2f  %s\n", i + 1,
            ends[i].left > middle    ? "left"
            : ends[i].left < -middle ? "right"
                                     : "middle",
            ends[i].height - ends[0].height, ambulo_model_link(model, ends[i].link)->name);
}

/* ---------------------------------------------------------------- the questions */

/* a line without blanks around it; 0: nothing was given, or the input is at its end */
static int answer(char line[LINE]) {
  fflush(stderr);
  if (!fgets(line, LINE, stdin)) {
    fputc('\n', stderr);
    return 0;
  }
  if (!strchr(line, '\n'))
    for (int c = getchar(); c != EOF && c != '\n';) c = getchar();
  size_t blanks = strspn(line, " \t"), length = strcspn(line + blanks, "\r\n");
  memmove(line, line + blanks, length);
  while (length > 0 && (line[length - 1] == ' ' || line[length - 1] == '\t')) length--;
  line[length] = '\0';
  return length > 0;
}

/* which of the ends is the foot of this side; -1: none */
static int ask_end(const char *side, int count, int taken) {
  char line[LINE], *behind;
  for (;;) {
    fprintf(stderr, "%s foot (1 to %d, empty: none): ", side, count);
    if (!answer(line)) return -1;
    long number = strtol(line, &behind, 10);
    if (*behind || behind == line || number < 1 || number > count)
      fprintf(stderr, "  '%.40s' is not in the list; expected a number from 1 to %d, or nothing\n",
              line, count);
    else if ((int)number - 1 == taken)
      fprintf(stderr, "  %ld is the other foot already; expected another number, or nothing\n",
              number);
    else
      return (int)number - 1;
  }
}

/* a place on a link as an option has it, which `with` takes; 0: none was given */
static int ask_place(const char *source, const char *part, const char *foot,
                     const ambulo_import_options *with, char text[AMBULO__CLI_FOOT_TEXT]) {
  char line[LINE];
  const char *link = strchr(foot, '=') + 1;
  for (;;) {
    fprintf(stderr, "%s of the %.*s foot, X,Y,Z in the frame of %s, m (empty: none): ", part,
            (int)(link - 1 - foot), foot, link);
    if (!answer(line)) return 0;
    ambulo__cli_format(text, AMBULO__CLI_FOOT_TEXT, "%s:%s", foot, line);
    ambulo_status status;
    ambulo_model_free(imported(source, with, &status));
    if (!status) return 1;
    fprintf(
        stderr,
        "  '%.60s' will not do; expected X,Y,Z, as 0.18,0,0, or two corners, X,Y,Z:X,Y,Z, at the "
        "heel and at the toe\n",
        line);
  }
}

/* the foot has points of its own by its link's geometry */
static int has_points(const char *source, const ambulo_import_options *options, const char *foot,
                      const char *side) {
  ambulo_import_options one = *options;
  ambulo_status status;
  one.heel_count = one.toe_count = 0;
  one.feet = &foot;
  one.foot_count = 1;
  ambulo_model *model = imported(source, &one, &status);
  int has = model && ambulo_model_find_foot(model, side) >= 0;
  ambulo_model_free(model);
  return has;
}

/* "left=LINK": as it is, or with heel and toe by hand */
static void add_foot(const char *source, const char *side, const char *foot,
                     ambulo_import_options *options, ambulo__cli_feet *feet) {
  if (has_points(source, options, foot, side)) {
    feet->foot[options->foot_count++] = foot;
    return;
  }
  fprintf(stderr, "%s has no geometry that could touch the ground.\n", strchr(foot, '=') + 1);
  int next = options->heel_count;
  const char *heel = feet->heel_text[next], *toe = feet->toe_text[next];
  ambulo_import_options one = *options;
  one.foot_count = 0;
  one.heels = one.toes = &heel; /* the same place will do to see whether it is one */
  one.heel_count = one.toe_count = 1;
  if (!ask_place(source, "heel", foot, &one, feet->heel_text[next])) return;
  one.toes = &toe;
  if (!ask_place(source, "toe", foot, &one, feet->toe_text[next])) return;
  feet->heel[options->heel_count++] = heel;
  feet->toe[options->toe_count++] = toe;
}

/* a file that is not written over without --force: there is nothing to ask for */
static int stands(const char *output) {
  struct stat there;
  return output && stat(output, &there) == 0 && there.st_size > 0;
}

static void tell(const ambulo_import_options *o) {
  if (o->foot_count + o->heel_count == 0) return;
  fputs("As options:", stderr);
  for (int i = 0; i < o->foot_count; i++) fprintf(stderr, " --foot %s", o->feet[i]);
  for (int i = 0; i < o->heel_count; i++)
    fprintf(stderr, " --heel %s --toe %s", o->heels[i], o->toes[i]);
  fputc('\n', stderr);
}

void ambulo__cli_ask_feet(const char *source, const char *output, ambulo_import_options *options,
                          ambulo__cli_feet *feet) {
  if (stands(output) && !options->overwrite) return;
  if (!isatty(STDIN_FILENO) || !isatty(STDERR_FILENO)) return;
  if (options->foot_count || options->heel_count || options->toe_count) return;
  ambulo_status status;
  ambulo_model *model = imported(source, options, &status);
  int links = model && ambulo_model_foot_count(model) == 0 ? ambulo_model_link_count(model) : 0;
  end *ends = links ? malloc((size_t)links * sizeof *ends) : NULL;
  if (ends) {
    int count = find_ends(model, ends), taken = -1;
    options->feet = feet->foot;
    options->heels = feet->heel;
    options->toes = feet->toe;
    print_ends(model, ends, count);
    for (int i = 0; i < AMBULO__CLI_FEET; i++) {
      int chosen = ask_end(sides[i], count, taken);
      if (chosen < 0) continue;
      taken = chosen;
      ambulo__cli_format(feet->foot_text[i], AMBULO__CLI_FOOT_TEXT, "%s=%s", sides[i],
                         ambulo_model_link(model, ends[chosen].link)->name);
      add_foot(source, sides[i], feet->foot_text[i], options, feet);
    }
    tell(options);
  }
  free(ends);
  ambulo_model_free(model);
}
