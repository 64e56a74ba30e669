/* show/scene_muscles.c - "muscles" of scene.json: muscles as lines along the limbs, and what joints
 * bear (scene.h).
 *
 * A muscle has lengths and no places. Where it passes a joint follows from its moment arms, r_c =
 * -dl/dq_c: a force along u at o from the joint's centre has the moment arm z_c . (o x u) about the
 * axis z_c, so that
 *
 *     o = u x sum_c r_c z_c
 *
 * is the nearest place with these arms; u is along the limb: from the next joint below, or, of the
 * lowest, to the joint above. Lines are drawn on the body at q = 0, with the arms there. They begin
 * and end where the muscle's length there is used up, half of the rest on either side. Each corner
 * is fixed on a link; beside a joint it is in the middle between where either link has it. */
#include "show/scene.h"

#include <math.h>
#include <string.h>

#include "base/arithmetic.h"
#include "mechanics/pose.h"

enum { MOST_FRAMES = 4 * AMBULO__MOST_CUTS };

static const double axis = 0.3;       /* m, of what shows how a link is turned */
static const double shortest = 0.08;  /* of a segment: a line's end from its joint, at least */
static const double longest = 0.9;    /* and at most */
static const double end_inside = 0.5; /* offset of an end from the bone, of that at the joint */
static const double sole = 0.12;      /* below the lowest joint, by the segment above it */
static const double dorsum = 2.2;     /* and so far ahead, by the offset there */
static const double no_segment = 0.3; /* m, where a body has one joint alone */

/* What lines are drawn on. */
typedef struct board {
  const ambulo_muscles *muscles;
  const ambulo__cut *cuts;
  int count;
  int above[AMBULO__MOST_CUTS], below[AMBULO__MOST_CUTS]; /* the next cut along the limb; -1 */
  double center[AMBULO__MOST_CUTS][3];                    /* world, at q = 0 */
  double along[AMBULO__MOST_CUTS][3], segment[AMBULO__MOST_CUTS]; /* u; the length it is from */
  ambulo__pose pose;                                              /* at q = 0 */
  int frames[MOST_FRAMES], frame_count;                           /* links that carry corners */
} board;

/* --------------------------------------------------------------------- joints */

static void way(const double from[3], const double to[3], double unit[3], double *length) {
  for (int k = 0; k < 3; k++) unit[k] = to[k] - from[k];
  *length = sqrt(ambulo__dot(unit, unit));
  for (int k = 0; k < 3 && *length > 0.0; k++) unit[k] /= *length;
}

static void find_neighbours(board *b) {
  const ambulo_model *model = b->muscles->model;
  for (int j = 0; j < b->count; j++) b->above[j] = b->below[j] = -1;
  for (int j = 0; j < b->count; j++)
    for (int link = b->cuts[j].axes; link >= 0 && b->above[j] < 0; link = model->links[link].parent)
      for (int k = 0; k < b->count; k++)
        if (b->cuts[k].link == link) b->above[j] = k;
  for (int j = 0; j < b->count; j++)
    if (b->above[j] >= 0) b->below[b->above[j]] = j;
}

static ambulo_status prepare(const ambulo_muscles *muscles, const ambulo__cut *cuts, int count,
                             const ambulo_allocator *allocator, board *b) {
  const ambulo_model *model = muscles->model;
  *b = (board){.muscles = muscles, .cuts = cuts, .count = count};
  double *q = ambulo__alloc(allocator, (size_t)model->coordinate_count + 1, sizeof *q);
  if (!q) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__pose_create(model, allocator, &b->pose);
  if (!status) ambulo__pose_at(&b->pose, q);
  ambulo__free(allocator, q);
  if (status) return status;
  find_neighbours(b);
  for (int j = 0; j < count; j++) /* a joint turns about the origin of the link before it */
    ambulo__pose_point(&b->pose, model->links[cuts[j].link].parent, (const double[3]){0.0},
                       b->center[j]);
  for (int j = 0; j < count; j++) {
    int from = b->below[j] >= 0 ? b->below[j] : j, to = b->below[j] >= 0 ? j : b->above[j];
    memcpy(b->along[j], model->up, sizeof b->along[j]);
    b->segment[j] = no_segment;
    if (to >= 0) way(b->center[from], b->center[to], b->along[j], &b->segment[j]);
  }
  return AMBULO_OK;
}

/* the cut that a link moves at: the nearest on its way up */
static int cut_of(const board *b, int link) {
  const ambulo_model *model = b->muscles->model;
  for (; link >= 0; link = model->links[link].parent)
    for (int j = 0; j < b->count; j++)
      for (int l = b->cuts[j].link; l >= 0 && l != b->cuts[j].axes; l = model->links[l].parent)
        if (l == link) return j;
  return -1;
}

static int link_of(const ambulo_model *model, int coordinate) {
  int link = 0;
  while (link + 1 < model->link_count && model->links[link].coordinate != coordinate) link++;
  return link;
}

/* -------------------------------------------------------------------- a muscle */

/* the coefficient of one coordinate alone; -1: of none */
static double linear(const ambulo_muscle *m, int coordinate) {
  double sum = 0.0;
  for (int t = 0; t < m->term_count; t++) {
    int fits = 1;
    for (int i = 0; i < m->coordinate_count; i++) fits &= m->exponents[t][i] == (i == coordinate);
    if (fits) sum += m->length[t];
  }
  return sum;
}

/* o at a cut, and the lowest link that the muscle moves there */
static int offset(const board *b, const ambulo_muscle *m, int cut, double o[3]) {
  const ambulo_model *model = b->muscles->model;
  double moment[3] = {0.0, 0.0, 0.0};
  int lowest = b->cuts[cut].link;
  for (int i = 0; i < m->coordinate_count; i++) {
    int link = link_of(model, m->coordinates[i]);
    if (cut_of(b, link) != cut) continue;
    if (link > lowest) lowest = link;
    int before = model->links[link].parent;
    for (int k = 0; k < 3; k++) {
      double z = before >= 0 ? b->pose.frames[12 * before + 4 * k + 2] : k == 2;
      moment[k] -= linear(m, i) * z;
    }
  }
  ambulo__cross(b->along[cut], moment, o);
  return lowest;
}

/* the cuts that a muscle crosses, from above; their number */
static int crossed(const board *b, const ambulo_muscle *m, int cuts[AMBULO__MOST_CUTS]) {
  int count = 0;
  for (int p = 0; p < m->pull_count; p++)
    for (int j = 0; j < b->count; j++) {
      if (strcmp(m->pulls[p].joint, b->cuts[j].name) != 0 || count == AMBULO__MOST_CUTS) continue;
      int at = count++;
      for (; at > 0 && b->cuts[cuts[at - 1]].link > b->cuts[j].link; at--) cuts[at] = cuts[at - 1];
      cuts[at] = j;
    }
  return count;
}

static int frame_of(board *b, int link) {
  for (int i = 0; i < b->frame_count; i++)
    if (b->frames[i] == link) return i;
  if (b->frame_count == MOST_FRAMES) return 0;
  b->frames[b->frame_count] = link;
  return b->frame_count++;
}

/* [frame, x, y, z] of a place on a link, twice beside a joint (other >= 0) */
static void corner(ambulo__json *json, board *b, int link, int other, const double at[3]) {
  const int links[2] = {link, other};
  ambulo__text_buffer line;
  ambulo__text_init_part(&line, json->text);
  for (int i = 0; i < 2 && links[i] >= 0; i++) {
    const double *frame = b->pose.frames + 12 * links[i];
    ambulo__text_append_format(&line, i ? ", %d" : "[%d", frame_of(b, links[i]));
    for (int c = 0; c < 3; c++) {
      double local = 0.0;
      for (int r = 0; r < 3; r++) local += frame[4 * r + c] * (at[r] - frame[4 * r + 3]);
      ambulo__text_append(&line, ", ");
      ambulo__text_append_number(&line, round(local * 1e4) / 1e4 + 0.0);
    }
  }
  ambulo__text_append_char(&line, ']');
  ambulo__json_raw(json, NULL, ambulo__text_data(&line));
  ambulo__text_free(&line);
}

static void moved(const double from[3], double a, const double u[3], double b, const double v[3],
                  double to[3]) {
  for (int k = 0; k < 3; k++) to[k] = from[k] + a * u[k] + b * v[k];
}

static double within(double length, double segment) {
  return fmin(fmax(length, shortest * segment), longest * segment);
}

static void path(ambulo__json *json, board *b, const ambulo_muscle *m) {
  int cuts[AMBULO__MOST_CUTS], count = crossed(b, m, cuts), lowest = -1;
  double o[3], at[3], rest = linear(m, -1), between;
  ambulo__json_open(json, "path", '[');
  for (int i = 0; i + 1 < count; i++) {
    way(b->center[cuts[i]], b->center[cuts[i + 1]], at, &between);
    rest -= between;
  }
  for (int i = 0; i < count; i++) {
    const int cut = cuts[i], over = b->above[cut], ends_low = b->below[cuts[count - 1]] < 0;
    const double *u = over >= 0 ? b->along[over] : b->along[cut], *center = b->center[cut];
    double size = over >= 0 ? b->segment[over] : b->segment[cut];
    double up = ends_low ? rest - sole * b->segment[cuts[count - 1]] : 0.5 * rest;
    lowest = offset(b, m, cut, o);
    if (i == 0) {
      moved(center, within(up, size), u, end_inside, o, at);
      corner(json, b, b->cuts[cut].axes, -1, at);
    }
    moved(center, 0.0, u, 1.0, o, at);
    corner(json, b, b->cuts[cut].axes, b->cuts[cut].link, at);
    if (i + 1 < count) continue;
    if (ends_low)
      moved(center, -sole * b->segment[cut], b->along[cut],
            ambulo__dot(o, b->muscles->model->forward) > 0.0 ? dorsum : 1.0, o, at);
    else
      moved(center, -within(0.5 * rest, b->segment[cut]), b->along[cut], end_inside, o, at);
    corner(json, b, lowest, -1, at);
  }
  ambulo__json_close(json, ']');
}

/* --------------------------------------------------------------------- series */

static void three(ambulo__json *json, const char *key, const double *values, int step, int samples,
                  double unit) {
  ambulo__json_open(json, key, '[');
  for (int i = 0; i < 3; i++) ambulo__series(json, NULL, values + i, step, samples, unit);
  ambulo__json_close(json, ']');
}

/* forward, left and up of a vector along the axes of a frame */
static void turn(const ambulo_model *model, const double *frame, const double local[3],
                 double out[3]) {
  double world[3];
  for (int r = 0; r < 3; r++) world[r] = ambulo__dot(frame + 4 * r, local);
  ambulo__scene_place(model, 0.0, world, out);
}

/* at one time: three places of each frame, then of each cut its centre and its force */
static void find_places(const board *b, const ambulo__pose *pose, double ground,
                        const double *contact, double *out) {
  static const double ends[3][3] = {{0.0, 0.0, 0.0}, {axis, 0.0, 0.0}, {0.0, axis, 0.0}};
  const ambulo_model *model = b->muscles->model;
  double world[3];
  for (int f = 0; f < b->frame_count; f++)
    for (int e = 0; e < 3; e++, out += 3) {
      ambulo__pose_point(pose, b->frames[f], ends[e], world);
      ambulo__scene_place(model, ground, world, out);
    }
  for (int j = 0; j < b->count; j++, out += 6) {
    ambulo__pose_point(pose, model->links[b->cuts[j].link].parent, ends[0], world);
    ambulo__scene_place(model, ground, world, out);
    turn(model, pose->frames + 12 * b->cuts[j].axes, contact + 3 * j, out + 3);
  }
}

static void frames_and_joints(ambulo__json *json, const board *b, const double *places, int step,
                              int samples) {
  ambulo__json_open(json, "frames", '[');
  for (int f = 0; f < b->frame_count; f++) {
    ambulo__json_open(json, NULL, '[');
    for (int e = 0; e < 3; e++, places += 3)
      three(json, NULL, places, step, samples, AMBULO__SCENE_LENGTH);
    ambulo__json_close(json, ']');
  }
  ambulo__json_close(json, ']');
  ambulo__json_open(json, "joints", '[');
  for (int j = 0; j < b->count; j++, places += 6) {
    int coordinate = b->muscles->model->links[b->cuts[j].link].coordinate;
    ambulo__side side =
        coordinate < 0 ? AMBULO__MIDDLE : ambulo__coordinate_side(b->muscles->model, coordinate);
    ambulo__json_open(json, NULL, '{');
    ambulo__json_text(json, "name", b->cuts[j].name);
    ambulo__json_text(json, "side", ambulo__scene_side(side));
    three(json, "at", places, step, samples, AMBULO__SCENE_LENGTH);
    three(json, "force", places + 3, step, samples, AMBULO__SCENE_FORCE);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, ']');
}

/* ----------------------------------------------------------------------- all */

static void muscle(ambulo__json *json, board *b, int i, const ambulo_muscle_values *v) {
  const ambulo_muscle *m = &b->muscles->muscles[i];
  ambulo__json_open(json, NULL, '{');
  ambulo__json_text(json, "name", m->name);
  ambulo__json_text(json, "group", m->group);
  ambulo__json_text(
      json, "side",
      ambulo__scene_side(ambulo__coordinate_side(b->muscles->model, m->coordinates[0])));
  ambulo__json_number(json, "strength", round(m->force));
  path(json, b, m);
  ambulo__series(json, "activation", v->activation + i, b->muscles->count, v->rows,
                 AMBULO__SCENE_ACTIVATION);
  ambulo__json_close(json, '}');
}

ambulo_status ambulo__scene_muscles(ambulo__json *json, const ambulo__stride *s,
                                    const ambulo_muscle_analysis *a) {
  const ambulo_muscle_values *v = &a->values;
  const ambulo_allocator *allocator = &json->text->allocator;
  board b;
  ambulo_status status = prepare(a->muscles, a->cuts, v->joints, allocator, &b);
  if (status) return status;
  ambulo__json_open(json, "muscles", '{');
  ambulo__json_text(json, "name", a->muscles->name);
  ambulo__json_open(json, "muscles", '[');
  for (int i = 0; i < a->muscles->count; i++) muscle(json, &b, i, v);
  ambulo__json_close(json, ']');
  const int step = 9 * b.frame_count + 6 * b.count;
  double *places = ambulo__alloc(allocator, (size_t)s->samples * (size_t)step + 1, sizeof *places);
  if (!places) status = AMBULO_E_MEMORY;
  for (int k = 0; k < s->samples && !status; k++) {
    ambulo__pose_at(&b.pose, s->q + (size_t)k * (size_t)s->coordinates);
    find_places(&b, &b.pose, s->problem->definition.ground_height,
                v->contact + 3 * (size_t)k * (size_t)v->joints, places + (size_t)k * (size_t)step);
  }
  if (!status) frames_and_joints(json, &b, places, step, s->samples);
  ambulo__json_close(json, '}');
  ambulo__free(allocator, places);
  ambulo__pose_free(&b.pose);
  return status;
}
