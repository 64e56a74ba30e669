/* cli/cmd_info.c - ambulo info: what was understood of a model or a problem, as tables. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/body.h"
#include "cli/output.h"

static const double degrees = 57.295779513082321;

/* --------------------------------------------------------------------- model */

static void print_links(const ambulo_model *model) {
  static const char *const types[] = {"", "fixed", "revolute", "prismatic"};
  printf("\nlinks (m, degrees, kg)\n  %-3s %-22s %-22s %-9s %8s %8s %8s %8s %8s\n", "", "name",
         "parent", "joint", "theta", "d", "a", "alpha", "mass");
  for (int i = 0; i < ambulo_model_link_count(model); i++) {
    const ambulo_link *link = ambulo_model_link(model, i);
    const char *parent = link->parent >= 0 ? ambulo_model_link(model, link->parent)->name : "world";
    printf("  %-3d %-22s %-22s %-9s %8.2f %8.4f %8.4f %8.2f ", i, link->name, parent,
           types[link->type], degrees * link->theta, link->d, link->a, degrees * link->alpha);
    if (link->mass > 0.0) {
      printf("%8.4f", link->mass);
    } else {
      printf("%8s", "-");
    }
    if (link->coupled_to >= 0)
      printf("  follows %s", ambulo_model_coordinate(model, link->coupled_to)->name);
    printf("\n");
  }
}

static void print_range(const double *range, double factor) {
  for (int i = 0; i < 2; i++) {
    if (isfinite(range[i])) {
      printf(" %8.2f", factor * range[i]);
    } else {
      printf(" %8s", "-");
    }
  }
}

static void print_coordinates(const ambulo_model *model) {
  printf("\ncoordinates (degrees or m; N m or N)\n  %-3s %-22s %-6s %17s %17s %17s  %-9s %s\n", "",
         "name", "unit", "range", "speed", "torque", "driven", "mirror image");
  for (int i = 0; i < ambulo_model_coordinate_count(model); i++) {
    const ambulo_coordinate *c = ambulo_model_coordinate(model, i);
    int angle = c->type == AMBULO_REVOLUTE;
    printf("  %-3d %-22s %-6s", i, c->name, angle ? "deg" : "m");
    print_range(c->range, angle ? degrees : 1.0);
    print_range(c->speed, angle ? degrees : 1.0);
    print_range(c->torque, 1.0);
    printf("  %-9s %s%s\n", c->actuated ? "yes" : "no", c->mirror_sign < 0.0 ? "-" : "",
           c->mirror == i && c->mirror_sign > 0.0
               ? "itself"
               : ambulo_model_coordinate(model, c->mirror)->name);
  }
}

/* of those that have some of it */
static void print_drives(const ambulo_model *model) {
  int printed = 0;
  for (int i = 0; i < ambulo_model_coordinate_count(model); i++) {
    const ambulo_coordinate *c = ambulo_model_coordinate(model, i);
    if (c->armature == 0.0 && c->damping == 0.0 && c->friction == 0.0) continue;
    if (!printed++)
      printf("\ndrives (kg m^2 or kg; N m s/rad or N s/m; N m or N)\n  %-3s %-22s %10s %10s %10s\n",
             "", "coordinate", "armature", "damping", "friction");
    printf("  %-3d %-22s %10.4g %10.4g %10.4g\n", i, c->name, c->armature, c->damping, c->friction);
  }
}

static const char *point_name(const ambulo_model *model, int index) {
  const ambulo_point *point = ambulo_model_point(model, index);
  return point ? point->name : "-";
}

static void print_points(const ambulo_model *model) {
  int points = ambulo_model_point_count(model), feet = ambulo_model_foot_count(model);
  if (points) printf("\npoints (m, link frame)\n");
  for (int i = 0; i < points; i++) {
    const ambulo_point *p = ambulo_model_point(model, i);
    printf("  %-3d %-22s %-22s %9.4f %9.4f %9.4f\n", i, p->name,
           ambulo_model_link(model, p->link)->name, p->position[0], p->position[1], p->position[2]);
  }
  if (feet) printf("\nfeet\n");
  for (int i = 0; i < feet; i++) {
    const ambulo_foot *f = ambulo_model_foot(model, i);
    printf("  %-3d %-10s heel %s %s, toe %s %s, centres %s %s, mirror image %s\n", i, f->name,
           point_name(model, f->heel[0]), point_name(model, f->heel[1]),
           point_name(model, f->toe[0]), point_name(model, f->toe[1]),
           point_name(model, f->heel_center), point_name(model, f->toe_center),
           ambulo_model_foot(model, f->mirror)->name);
  }
}

static void print_patches(const ambulo_model *model) {
  int patches = ambulo_model_patch_count(model);
  if (patches) printf("\npatches (m)\n");
  for (int i = 0; i < patches; i++) {
    const ambulo_patch *p = ambulo_model_patch(model, i);
    printf("  %-3d %-10s point %s, %.4g long, %.4g wide, mirror image %s\n", i, p->name,
           point_name(model, p->point), 2.0 * p->size[0], 2.0 * p->size[1],
           ambulo_model_patch(model, p->mirror)->name);
  }
}

static void print_capsules(const ambulo_model *model) {
  int capsules = ambulo_model_capsule_count(model);
  if (capsules) printf("\ncapsules (m, link frame)\n");
  for (int i = 0; i < capsules; i++) {
    const ambulo_capsule *c = ambulo_model_capsule(model, i);
    printf(
        "  %-3d %-12s %-12s radius %.4f, from %.4f %.4f %.4f to %.4f %.4f %.4f, mirror image %s\n",
        i, c->name, ambulo_model_link(model, c->link)->name, c->radius, c->from[0], c->from[1],
        c->from[2], c->to[0], c->to[1], c->to[2], ambulo_model_capsule(model, c->mirror)->name);
  }
}

/* *symmetry, one line, to be freed: its own mirror image, or the first difference */
static ambulo_status describe_symmetry(const ambulo_model *model, char **symmetry) {
  static const char whole[] = "the body is its own mirror image, left for right";
  static const char lead[] = "none, left for right: ";
  ambulo_diagnostics *differences = ambulo_diagnostics_create(NULL);
  if (!differences) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo_model_check_mirror(model, NULL, differences);
  const ambulo_diagnostic *first = ambulo_diagnostics_get(differences, 0);
  int differs = status == AMBULO_E_MODEL && first;
  if (!status || differs) {
    size_t size = sizeof whole + (differs ? sizeof lead + strlen(first->message) : 0);
    *symmetry = malloc(size);
    status = *symmetry ? AMBULO_OK : AMBULO_E_MEMORY;
    if (*symmetry)
      ambulo__cli_format(*symmetry, size, "%s%s", differs ? lead : whole,
                         differs ? first->message : "");
  }
  ambulo_diagnostics_free(differences);
  return status == AMBULO_E_MODEL ? AMBULO_E_MEMORY : status; /* without a difference */
}

static void print_model(const ambulo_model *model, const char *symmetry) {
  const double *g = ambulo_model_gravity(model), *f = ambulo_model_forward(model);
  printf("model        %s\n", ambulo_model_name(model));
  printf("body         %.4f kg", ambulo_model_mass(model));
  if (ambulo_model_stature(model) > 0.0) printf(", %.3f m tall", ambulo_model_stature(model));
  printf("\ngravity      %g %g %g m/s^2\nforward      %g %g %g\n", g[0], g[1], g[2], f[0], f[1],
         f[2]);
  printf("symmetry     %s\n", symmetry);
  print_links(model);
  print_coordinates(model);
  print_drives(model);
  print_points(model);
  print_patches(model);
  print_capsules(model);
}

/* ------------------------------------------------------------------- problem */

static void print_schedule(const ambulo_problem *problem) {
  static const char *const modes[] = {"", "heel", "flat", "toe", "patch"};
  int count = ambulo_problem_contact_count(problem);
  if (count == 0) return;
  printf("\ncontacts (s; place in m along forward, left and up)\n  %-3s %-10s %-5s %9s %9s %9s %9s "
         "%9s\n",
         "", "of", "mode", "from", "to", "forward", "left", "up");
  for (int i = 0; i < count; i++) {
    const ambulo_contact *c = ambulo_problem_contact(problem, i);
    const ambulo_model *model = ambulo_problem_model(problem);
    const char *name = c->foot >= 0 ? ambulo_model_foot(model, c->foot)->name
                                    : ambulo_model_patch(model, c->patch)->name;
    printf("  %-3d %-10s %-5s %9.4f %9.4f %9.4f %9.4f %9.4f\n", i, name, modes[c->mode], c->from,
           c->to, c->place[0], c->place[1], c->place[2]);
  }
}

enum { MOST_KINDS = 64 };

/* one line for the rows that agree in family, relation and unit */
static void print_families(const ambulo_problem *problem) {
  ambulo_row kinds[MOST_KINDS], row;
  int counts[MOST_KINDS] = {0}, kind_count = 0;
  printf("\nrows\n");
  for (int r = 0; r < ambulo_problem_row_count(problem); r++) {
    if (ambulo_problem_row(problem, r, &row)) continue;
    int k = 0;
    while (k < kind_count &&
           (strcmp(kinds[k].family, row.family) != 0 || strcmp(kinds[k].unit, row.unit) != 0 ||
            kinds[k].relation != row.relation))
      k++;
    if (k == MOST_KINDS) continue;
    if (k == kind_count) kinds[kind_count++] = row;
    counts[k]++;
  }
  for (int k = 0; k < kind_count; k++)
    printf("  %-22s %6d  %-4s %s\n", kinds[k].family, counts[k],
           kinds[k].relation == AMBULO_EQUAL ? "= 0" : ">= 0", kinds[k].unit);
  if (kind_count == 0) printf("  none\n");
}

/* where mirrored ends leave less than the model's limits */
static void print_limits(const ambulo_problem *problem) {
  static const char *const words[] = {"range", "speed", "torque"};
  const ambulo_model *model = ambulo_problem_model(problem);
  int printed = 0;
  for (int i = 0; i < ambulo_model_coordinate_count(model); i++) {
    const ambulo_coordinate *c = ambulo_model_coordinate(model, i);
    const double *given[] = {c->range, c->speed, c->torque};
    for (int k = 0; k < 3; k++) {
      ambulo_limited what = (ambulo_limited)(AMBULO_LIMITED_POSITION + k);
      ambulo_limits l;
      if (ambulo_problem_limits(problem, i, what, &l)) continue;
      int lower = l.low > given[k][0], upper = l.high < given[k][1];
      if (!lower && !upper) continue;
      if (!printed++)
        printf("\nlimits, narrower than the model's because of the mirrored half of the stride\n");
      double interval[2] = {l.low, l.high};
      int angle = c->type == AMBULO_REVOLUTE && what != AMBULO_LIMITED_TORQUE;
      printf("  %-22s %-6s", c->name, words[k]);
      print_range(interval, angle ? degrees : 1.0);
      if (lower) printf("  lower end by %s", ambulo_model_coordinate(model, l.low_of)->name);
      if (upper) printf("  upper end by %s", ambulo_model_coordinate(model, l.high_of)->name);
      printf("\n");
    }
  }
}

/* names of pairs, as many as fit on lines of six */
static void print_pairs(const ambulo_problem *problem, const char *title,
                        int (*get)(const ambulo_problem *, int, ambulo_capsule_pair *)) {
  const ambulo_model *model = ambulo_problem_model(problem);
  int count = get(problem, 0, NULL);
  if (count == 0) return;
  printf("\n%s\n", title);
  for (int i = 0; i < count; i++) {
    ambulo_capsule_pair pair = {0, 0};
    (void)get(problem, i, &pair);
    printf("%s%s and %s%s", i % 6 ? ", " : "  ", ambulo_model_capsule(model, pair.one)->name,
           ambulo_model_capsule(model, pair.other)->name, i % 6 == 5 || i + 1 == count ? "\n" : "");
  }
}

static void print_obstacles(const ambulo_problem *problem) {
  int count = ambulo_problem_obstacle_count(problem);
  if (count) printf("\nobstacles (m, along forward, left and up)\n");
  for (int i = 0; i < count; i++) {
    const ambulo_obstacle *o = ambulo_problem_obstacle(problem, i);
    int is_box = o->shape == AMBULO_OBSTACLE_BOX;
    const double *a = is_box ? o->center : o->from, *b = is_box ? o->half : o->to;
    printf("  %-12s %s %.4g %.4g %.4g %s %.4g %.4g %.4g", o->name,
           is_box ? "box about" : "bar from", a[0], a[1], a[2], is_box ? "+-" : "to", b[0], b[1],
           b[2]);
    if (!is_box) printf(", radius %.4g", o->radius);
    if (is_box && o->heading != 0.0) printf(", turned by %.4g degrees", degrees * o->heading);
    printf(", margin %.4g\n", o->margin);
  }
}

static void print_bodies(const ambulo_problem *problem) {
  print_pairs(problem, "pairs of capsules that keep apart", ambulo_problem_pairs);
  print_pairs(problem, "left out, since they overlap in the rest pose",
              ambulo_problem_pairs_left_out);
  print_obstacles(problem);
}

/* "180 N m/rad above 2 degrees", or what its kind has */
static void print_law(const ambulo_device *v, int turns) {
  static const char *const sides[] = {"", "from", "above", "below"};
  const char *force = turns ? "N m" : "N", *place = turns ? "degrees" : "m";
  const char *unit = turns ? "rad" : "m";
  double scale = turns ? degrees : 1.0;
  switch (v->kind) {
  case AMBULO_DEVICE_SPRING:
    printf("spring    %g %s/%s %s %g %s", v->stiffness, force, unit, sides[v->side],
           scale * v->rest, place);
    if (v->pretension != 0.0) printf(", %g %s there", v->pretension, force);
    return;
  case AMBULO_DEVICE_DAMPER:
    printf("damper    %g %s s/%s", v->damping, force, unit);
    return;
  case AMBULO_DEVICE_KIND_NOT_SET:
  case AMBULO_DEVICE_ACTUATOR:
    break;
  }
  printf("actuator  %g ", v->amount);
  if (v->clock == AMBULO_DEVICE_CONSTANT) {
    printf("%s", force);
  } else {
    printf("times a profile of %d points by %s", v->point_count,
           v->clock == AMBULO_DEVICE_BY_TIME ? "time" : "stride");
  }
}

static void print_devices(const ambulo_problem *problem) {
  const ambulo_model *model = ambulo_problem_model(problem);
  int count = ambulo_problem_device_count(problem);
  if (count) printf("\ndevices\n");
  for (int i = 0; i < count; i++) {
    const ambulo_device *v = ambulo_problem_device(problem, i);
    const ambulo_coordinate *at = ambulo_model_coordinate(model, v->coordinate);
    printf("  %-3d %-22s ", i, v->name);
    print_law(v, at && at->type == AMBULO_REVOLUTE);
    if (at) {
      printf(", at %s", at->name);
    } else {
      printf(", from %s to %s", ambulo_model_link(model, v->link[0])->name,
             ambulo_model_link(model, v->link[1])->name);
    }
    if (v->clutch)
      printf(", engaged from %g to %g of the stride of %s", v->from, v->to,
             ambulo_model_foot(model, v->foot)->name);
    printf("\n");
  }
}

static void print_holds(const ambulo_problem *problem) {
  const ambulo_model *model = ambulo_problem_model(problem);
  int count = ambulo_problem_hold_count(problem);
  if (count) printf("\nheld\n");
  for (int i = 0; i < count; i++) {
    const ambulo_hold *h = ambulo_problem_hold(problem, i);
    double to = fmin(h->to, ambulo_problem_duration(problem));
    printf("  %-3d %-22s %g kg, pushed with [%g, %g, %g] N, in %s", i, h->name, h->mass,
           h->force[0], h->force[1], h->force[2], ambulo_model_point(model, h->hand[0])->name);
    if (h->hand[1] >= 0) printf(" and %s", ambulo_model_point(model, h->hand[1])->name);
    printf(", from %g to %g s\n", h->from, to);
  }
}

static void print_problem(const ambulo_problem *problem, const char *symmetry) {
  static const char *const ends[] = {"free", "periodic", "mirrored"};
  int equalities = ambulo_problem_equality_count(problem);
  const char *name = ambulo_problem_name(problem);
  printf("problem      %s\n", name ? name : "");
  printf("duration     %g s, %d nodes%s, %s ends\n", ambulo_problem_duration(problem),
         ambulo_problem_node_count(problem),
         ambulo_problem_grid(problem) == AMBULO_GRID_EVENTS ? " on events" : "",
         ends[ambulo_problem_ends(problem)]);
  printf("unknowns     %d: %d control points of %d coordinates\n",
         ambulo_problem_variable_count(problem), ambulo_problem_control_point_count(problem),
         ambulo_model_coordinate_count(ambulo_problem_model(problem)));
  printf("constraints  %d equalities, %d inequalities\n", equalities,
         ambulo_problem_row_count(problem) - equalities);
  ambulo_memory memory = ambulo_problem_memory(problem);
  printf("memory       about %.3g MB to solve, %.3g MB of it to evaluate\n",
         memory.solve / 1048576.0, memory.evaluation / 1048576.0);
  printf("input hash   %016llx\n", ambulo_problem_hash(problem));
  printf("\nobjective\n");
  for (int i = 0; i < ambulo_problem_term_count(problem); i++)
    printf("  %s\n", ambulo_problem_term_name(problem, i));
  if (ambulo_problem_term_count(problem) == 0) printf("  none (feasibility only)\n");
  print_families(problem);
  print_limits(problem);
  print_bodies(problem);
  print_schedule(problem);
  print_devices(problem);
  print_holds(problem);
  printf("\n");
  print_model(ambulo_problem_model(problem), symmetry);
}

static int run(const ambulo__cli_input *input) {
  const char *file = input->arguments[0];
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo__cli_body body = {.model = NULL};
  char *symmetry = NULL;
  ambulo_status status = ambulo__cli_load(input, file, diagnostics, &body);
  if (!status) status = describe_symmetry(body.model, &symmetry);
  if (!status && body.problem) print_problem(body.problem, symmetry);
  if (!status && !body.problem) print_model(body.model, symmetry);
  int code = ambulo__cli_diagnostics(diagnostics, status, file);
  free(symmetry);
  ambulo__cli_body_free(&body);
  ambulo_diagnostics_free(diagnostics);
  return code;
}

static const ambulo__cli_option options[] = {
    AMBULO__CLI_SET_OPTION,
};

const ambulo__cli_command ambulo__cli_info = {
    .name = "info",
    .arguments = "MODEL.yaml|PROBLEM.yaml",
    .summary = "show how a model or a problem was understood",
    .description =
        "Prints links, masses, coordinates with their limits, points, feet, patches and capsules "
        "of\n"
        "a model. For a problem also the unknowns, rows by family, terms of the objective, pairs\n"
        "that keep apart, and the contact schedule with its footholds.",
    .example = "ambulo info models/lower_body_18.yaml\n"
               "ambulo info models/yardstick_36.yaml",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 1,
    .maximum = 1,
    .files = 1,
    .words = "ambulo models --names",
    .run = run,
};
