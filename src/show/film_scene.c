/* show/film_scene.c - scene.json as arrays (film_scene.h).
 *
 * A series is whole numbers in second differences: value += slope += series[k]. Numbers of points
 * are checked; a key that is away is nothing to draw. */
#include "show/film_scene.h"

#include <math.h>
#include <string.h>

enum { MOST_SAMPLES = 100000, MOST_ITEMS = 20000 };

static const char *const sides[] = {"middle", "left", "right"};
static const ambulo__color side_color[] = {0x98a3ae, 0xd4551c, 0x1f6fb2};

static ambulo__color color_of(const ambulo__yaml_node *item) {
  return side_color[ambulo__yaml_choice(ambulo__yaml_get(item, "side"), sides, 3, 0)];
}

static int items_of(const ambulo__yaml_node *root, const char *key) {
  int count = ambulo__yaml_items(ambulo__yaml_get(root, key));
  return count < MOST_ITEMS ? count : MOST_ITEMS;
}

static double number_at(const ambulo__yaml_node *map, const char *key, double fallback) {
  const ambulo__yaml_node *node = ambulo__yaml_get(map, key);
  return node && strcmp(ambulo__yaml_text(node), "null") != 0 ? ambulo__yaml_number(node, fallback)
                                                              : fallback;
}

static int point_at(const ambulo__film_scene *s, const ambulo__yaml_node *node) {
  return ambulo__yaml_integer(node, 0, s->points - 1, 0);
}

/* ------------------------------------------------------------------- series */

static double *read_series(ambulo__film_scene *s, const ambulo__yaml_node *node, double unit) {
  double *out = s->series + s->used, value = 0.0, slope = 0.0;
  if (ambulo__yaml_items(node) != s->samples)
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "a series of %d numbers; expected %d",
                             ambulo__yaml_items(node), s->samples);
  for (int k = 0; k < s->samples; k++) {
    double next = ambulo__yaml_number(ambulo__yaml_item(node, k), 0.0);
    slope += k > 0 ? next : 0.0;
    value += k > 0 ? slope : next;
    out[k] = unit * value;
  }
  s->used += (size_t)s->samples;
  return out;
}

static void read_three(ambulo__film_scene *s, const ambulo__yaml_node *three, double unit,
                       double *series[3]) {
  for (int i = 0; i < 3; i++) series[i] = read_series(s, ambulo__yaml_item(three, i), unit);
}

/* ------------------------------------------------------------ what they say */

static void read_bone(ambulo__film_scene *s, const ambulo__yaml_node *item) {
  static const char *const kinds[] = {"line", "capsule", "head"};
  const ambulo__yaml_node *ends = ambulo__yaml_require(item, "points");
  const ambulo__yaml_node *named = ambulo__yaml_get(item, "name");
  const char *name = named ? ambulo__yaml_text(named) : "";
  int kind = ambulo__yaml_choice(ambulo__yaml_require(item, "kind"), kinds, 3, 0);
  s->bone[s->bones++] = (ambulo__film_bone){
      .point = {point_at(s, ambulo__yaml_item(ends, 0)), point_at(s, ambulo__yaml_item(ends, 1))},
      .radius = number_at(item, "radius", 0.0),
      .color = color_of(item),
      .is_capsule = kind == 1,
      .is_head = kind == 2,
      .is_foot = strstr(name, "foot") || strstr(name, "toes")};
}

/* of a sole without four corners nothing is drawn */
static void read_foot(ambulo__film_scene *s, const ambulo__yaml_node *item) {
  const ambulo__yaml_node *sole = ambulo__yaml_require(item, "sole");
  ambulo__film_foot *f = &s->foot[s->feet];
  if (ambulo__yaml_items(sole) != 4) return;
  for (int i = 0; i < 4; i++) f->sole[i] = point_at(s, ambulo__yaml_item(sole, i));
  f->ankle = point_at(s, ambulo__yaml_require(item, "ankle"));
  f->color = color_of(item);
  s->feet++;
}

static void read_worn(ambulo__film_scene *s, const ambulo__yaml_node *item) {
  static const char *const kinds[] = {"device", "load"};
  int load = ambulo__yaml_choice(ambulo__yaml_require(item, "kind"), kinds, 2, 0);
  int from = point_at(s, ambulo__yaml_require(item, "from"));
  const ambulo__yaml_node *to = ambulo__yaml_get(item, "to");
  const ambulo__yaml_node *hinge = ambulo__yaml_get(item, "hinge");
  ambulo__film_rod rod = {
      .point = {from, from}, .size = {0.1, 0.14, 0.2}, .from = -INFINITY, .to = INFINITY};
  if (load) {
    (void)ambulo__yaml_numbers(ambulo__yaml_get(item, "size"), 3, rod.size);
    s->rod[s->rods++] = rod;
    return;
  }
  rod.radius = hinge ? 0.06 : 0.012;
  rod.point[1] = hinge ? point_at(s, hinge) : to ? point_at(s, to) : from;
  s->rod[s->rods++] = rod;
  rod.point[0] = hinge && to ? point_at(s, to) : from;
  if (hinge) s->rod[s->rods++] = rod;
}

static void read_held(ambulo__film_scene *s, const ambulo__yaml_node *item) {
  ambulo__film_rod rod = {.point = {point_at(s, ambulo__yaml_require(item, "one")),
                                    point_at(s, ambulo__yaml_require(item, "other"))},
                          .from = number_at(item, "from", -INFINITY),
                          .to = number_at(item, "to", INFINITY)};
  (void)ambulo__yaml_numbers(ambulo__yaml_get(item, "center"), 3, rod.center);
  (void)ambulo__yaml_numbers(ambulo__yaml_get(item, "size"), 3, rod.size);
  for (int i = 0; i < 3; i++)
    if (!(rod.size[i] > 0.0)) rod.size[i] = 0.12;
  s->rod[s->rods++] = rod;
}

/* -------------------------------------------------------------- surroundings */

enum { BOX_FACES = 12, STEP_COLOR = 0xc2cad4, OBSTACLE_COLOR = 0xa98d62 };

/* corners: bottom four around, then the four above them */
static void add_box(ambulo__film_scene *s, double corner[8][3], ambulo__color color) {
  static const int around[BOX_FACES][3] = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7},
                                           {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                           {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  for (int f = 0; f < BOX_FACES; f++) {
    ambulo__film_face *face = &s->face[s->faces++];
    face->color = color;
    for (int k = 0; k < 3; k++)
      memcpy(face->corner[k], corner[around[f][k]], sizeof face->corner[k]);
  }
}

/* from `low` up to heights at both ends */
static void add_step(ambulo__film_scene *s, const double ends[2], const double heights[2],
                     double low) {
  double corner[8][3];
  for (int k = 0; k < 8; k++) {
    int far = k % 4 == 1 || k % 4 == 2;
    corner[k][0] = ends[far];
    corner[k][1] = k % 4 < 2 ? -0.65 : 0.65;
    corner[k][2] = k < 4 ? low : heights[far];
  }
  add_box(s, corner, STEP_COLOR);
}

static void read_surfaces(ambulo__film_scene *s, const ambulo__yaml_node *list) {
  double first = s->mass[0][0], last = first, low = 0.0, ends[2], heights[2];
  for (int k = 0; k < s->samples; k++) {
    first = fmin(first, s->mass[0][k]);
    last = fmax(last, s->mass[0][k]);
  }
  for (int pass = 0; pass < 2; pass++) {
    for (int i = 0; i < ambulo__yaml_items(list); i++) {
      const ambulo__yaml_node *one = ambulo__yaml_item(list, i);
      double at = number_at(one, "at", 0.0), slope = number_at(one, "slope", 0.0);
      ends[0] = number_at(one, "from", fmin(at, first) - 0.9);
      ends[1] = number_at(one, "to", fmax(at, last) + 0.9);
      for (int e = 0; e < 2; e++)
        heights[e] = number_at(one, "height", 0.0) + slope * (ends[e] - at);
      int near = ends[1] > first - 2.5 && ends[0] < last + 2.5 && ends[1] - ends[0] > 1e-6;
      if (pass && near && s->faces + BOX_FACES <= MOST_ITEMS) add_step(s, ends, heights, s->floor);
      if (near) low = fmin(low, fmin(heights[0], heights[1]) - 0.02);
    }
    s->floor = low;
  }
}

static void read_obstacle(ambulo__film_scene *s, const ambulo__yaml_node *one) {
  static const char *const shapes[] = {"box", "capsule"};
  double middle[3] = {0.0}, half[3] = {0.0}, corner[8][3];
  if (ambulo__yaml_choice(ambulo__yaml_require(one, "shape"), shapes, 2, 0)) {
    ambulo__film_post *post = &s->post[s->posts++];
    (void)ambulo__yaml_numbers(ambulo__yaml_require(one, "from"), 3, post->end[0]);
    (void)ambulo__yaml_numbers(ambulo__yaml_require(one, "to"), 3, post->end[1]);
    post->radius = number_at(one, "radius", 0.0);
    return;
  }
  double turn = number_at(one, "heading", 0.0);
  (void)ambulo__yaml_numbers(ambulo__yaml_require(one, "center"), 3, middle);
  (void)ambulo__yaml_numbers(ambulo__yaml_require(one, "half_size"), 3, half);
  for (int k = 0; k < 8; k++) {
    double f = k % 4 == 1 || k % 4 == 2 ? half[0] : -half[0], l = k % 4 < 2 ? -half[1] : half[1];
    corner[k][0] = middle[0] + cos(turn) * f - sin(turn) * l;
    corner[k][1] = middle[1] + sin(turn) * f + cos(turn) * l;
    corner[k][2] = middle[2] + (k < 4 ? -half[2] : half[2]);
  }
  add_box(s, corner, OBSTACLE_COLOR);
}

/* ------------------------------------------------------------------- memory */

static ambulo_status reserve(ambulo__film_scene *s, const ambulo__yaml_node *root) {
  const ambulo_allocator *a = &s->allocator;
  int forces = items_of(root, "forces"), obstacles = items_of(root, "obstacles");
  int surfaces = items_of(ambulo__yaml_get(root, "ground"), "surfaces");
  size_t series = 3 * ((size_t)s->points + 2 * (size_t)forces + 1) * (size_t)s->samples;
  size_t boxes = (size_t)obstacles + (size_t)surfaces;
  s->series = ambulo__alloc(a, series, sizeof *s->series);
  s->bone = ambulo__alloc(a, (size_t)items_of(root, "bones") + 1, sizeof *s->bone);
  s->foot = ambulo__alloc(a, (size_t)items_of(root, "feet") + 1, sizeof *s->foot);
  s->force = ambulo__alloc(a, (size_t)forces + 1, sizeof *s->force);
  s->rod = ambulo__alloc(a, 2 * (size_t)items_of(root, "worn") + (size_t)items_of(root, "held") + 1,
                         sizeof *s->rod);
  s->face = ambulo__alloc(a, BOX_FACES * boxes + 1, sizeof *s->face);
  s->post = ambulo__alloc(a, (size_t)obstacles + 1, sizeof *s->post);
  int got = s->series && s->bone && s->foot && s->force && s->rod && s->face && s->post;
  return got ? AMBULO_OK : AMBULO_E_MEMORY;
}

void ambulo__film_scene_free(ambulo__film_scene *s) {
  void *all[] = {s->series, s->bone, s->foot, s->force, s->rod, s->face, s->post};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    if (all[i]) ambulo__free(&s->allocator, all[i]);
  memset(s, 0, sizeof *s);
}

static void read_lists(ambulo__film_scene *s, const ambulo__yaml_node *root) {
  typedef void reader(ambulo__film_scene *, const ambulo__yaml_node *);
  static const struct {
    const char *key;
    reader *read;
  } lists[] = {{"bones", read_bone},
               {"feet", read_foot},
               {"worn", read_worn},
               {"held", read_held},
               {"obstacles", read_obstacle}};
  const ambulo__yaml_node *units = ambulo__yaml_require(root, "units");
  double metre = number_at(units, "length", 1e-4), newton = number_at(units, "force", 0.1);
  const ambulo__yaml_node *points = ambulo__yaml_get(root, "points");
  double *three[3];
  s->place = s->series;
  for (int i = 0; i < s->points; i++) read_three(s, ambulo__yaml_item(points, i), metre, three);
  read_three(s, ambulo__yaml_require(root, "center_of_mass"), metre, s->mass);
  for (int i = 0, count = items_of(root, "forces"); i < count; i++, s->forces++) {
    const ambulo__yaml_node *one = ambulo__yaml_item(ambulo__yaml_get(root, "forces"), i);
    read_three(s, ambulo__yaml_require(one, "force"), newton, s->force[i].force);
    read_three(s, ambulo__yaml_require(one, "pressure"), metre, s->force[i].pressure);
  }
  for (size_t k = 0; k < sizeof lists / sizeof *lists; k++)
    for (int i = 0, count = items_of(root, lists[k].key); i < count; i++)
      lists[k].read(s, ambulo__yaml_item(ambulo__yaml_get(root, lists[k].key), i));
}

ambulo_status ambulo__film_scene_read(const ambulo__yaml *document, const ambulo_allocator *a,
                                      ambulo__film_scene *scene) {
  const ambulo__yaml_node *root = ambulo__yaml_root(document);
  const ambulo__yaml_node *ground = ambulo__yaml_get(root, "ground");
  ambulo__film_scene s = {
      .allocator = *a,
      .samples = ambulo__yaml_integer(ambulo__yaml_require(root, "samples"), 2, MOST_SAMPLES, 2),
      .points = items_of(root, "points"),
      .duration = number_at(root, "duration", 1.0),
      .weight = fmax(number_at(root, "weight", 1.0), 1e-9),
      .repeats = number_at(root, "repeats", 0.0) != 0.0,
      .travel = number_at(root, "travel", 0.0),
      .rise = number_at(root, "rise", 0.0),
      .is_there = number_at(ground, "is_there", 0.0) != 0.0,
      .slope = number_at(ground, "slope", 0.0)};
  if (s.points == 0)
    (void)ambulo__yaml_error(root, AMBULO_E_SCHEMA, NULL, "no points; expected those of a body");
  ambulo_status status = ambulo__yaml_finish(document);
  if (!status) status = reserve(&s, root);
  if (!status) {
    read_lists(&s, root);
    if (s.is_there) read_surfaces(&s, ambulo__yaml_get(ground, "surfaces"));
    status = ambulo__yaml_finish(document);
  }
  *scene = s;
  if (status) ambulo__film_scene_free(scene);
  return status;
}

/* --------------------------------------------------------------------- time */

ambulo__film_time ambulo__film_time_of(const ambulo__film_scene *s, double time) {
  int last = s->samples - 1;
  double x = fmin(fmax(time / s->duration * last, 0.0), last);
  int sample = (int)fmin(floor(x), last - 1);
  return (ambulo__film_time){sample, x - sample};
}

double ambulo__film_value(const double *series, ambulo__film_time at) {
  return series[at.sample] + at.share * (series[at.sample + 1] - series[at.sample]);
}

void ambulo__film_point(const ambulo__film_scene *s, int point, ambulo__film_time at,
                        double place[3]) {
  for (int i = 0; i < 3; i++)
    place[i] = ambulo__film_value(s->place + (size_t)(3 * point + i) * (size_t)s->samples, at);
}
