/* exchange/npz.c - see export.h. */
#include "exchange/export.h"

#include "base/arithmetic.h"

#include <stdio.h>
#include <string.h>

/* zip's signatures; 1980-01-01, the zero of its dates */
enum { LOCAL = 0x04034b50, CENTRAL = 0x02014b50, END = 0x06054b50, DATE = 0x0021, VERSION = 20 };
/* data of an array begin at a multiple of this in its .npy */
enum { ALIGN = 64, MAGIC = 10 };

uint32_t ambulo__crc32(uint32_t crc, const char *bytes, size_t length) {
  crc = ~crc;
  for (size_t i = 0; i < length; i++) {
    crc ^= (unsigned char)bytes[i];
    for (int bit = 0; bit < 8; bit++) crc = (crc >> 1) ^ (crc & 1U ? 0xedb88320U : 0U);
  }
  return ~crc;
}

static void put(ambulo__text_buffer *text, uint64_t value, int bytes) {
  for (int i = 0; i < bytes; i++)
    ambulo__text_append_char(text, (char)(unsigned char)(value >> (8 * i) & 0xffU));
}

/* what local headers and the directory say alike */
static void put_common(ambulo__text_buffer *text, const ambulo__npz_entry *e) {
  put(text, VERSION, 2);
  put(text, 0, 2); /* flags */
  put(text, 0, 2); /* stored */
  put(text, 0, 2); /* time */
  put(text, DATE, 2);
  put(text, e->crc, 4);
  put(text, e->size, 4);
  put(text, e->size, 4);
  put(text, strlen(e->name), 2);
  put(text, 0, 2); /* no extra field */
}

void ambulo__npz_begin(ambulo__npz *npz, ambulo__text_buffer *text) {
  *npz = (ambulo__npz){.text = text};
}

/* magic, version, length of the description, description: all of a multiple of ALIGN bytes */
static void put_description(ambulo__text_buffer *array, const char *type, int dimensions,
                            const size_t *shape) {
  char said[160];
  int length =
      snprintf(said, sizeof said, "{'descr': '%s', 'fortran_order': False, 'shape': (", type);
  for (int i = 0; i < dimensions; i++)
    length += snprintf(said + length, sizeof said - (size_t)length, "%zu, ", shape[i]);
  length += snprintf(said + length, sizeof said - (size_t)length, "), }");
  int blanks = ALIGN - 1 - (MAGIC + length) % ALIGN;
  ambulo__text_append_bytes(array, "\x93NUMPY\x01\x00", 8);
  put(array, (uint64_t)(length + blanks + 1), 2);
  ambulo__text_append(array, said);
  while (blanks-- > 0) ambulo__text_append_char(array, ' ');
  ambulo__text_append_char(array, '\n');
}

static void add(ambulo__npz *npz, const char *name, const ambulo__text_buffer *array) {
  if (npz->count == AMBULO__NPZ_ARRAYS || array->length > UINT32_MAX ||
      npz->text->length > UINT32_MAX - array->length) {
    npz->too_large = 1;
    return;
  }
  ambulo__npz_entry *e = &npz->entry[npz->count++];
  (void)snprintf(e->name, sizeof e->name, "%.*s.npy", (int)AMBULO__NPZ_NAME, name);
  e->at = npz->text->length;
  e->size = array->length;
  e->crc = ambulo__crc32(0, ambulo__text_data(array), array->length);
  put(npz->text, LOCAL, 4);
  put_common(npz->text, e);
  ambulo__text_append(npz->text, e->name);
  ambulo__text_append_bytes(npz->text, ambulo__text_data(array), array->length);
}

void ambulo__npz_numbers(ambulo__npz *npz, const char *name, const double *values, int dimensions,
                         const size_t *shape) {
  ambulo__text_buffer array;
  size_t count = 1;
  ambulo__text_init_part(&array, npz->text);
  put_description(&array, "<f8", dimensions, shape);
  for (int i = 0; i < dimensions; i++) count *= shape[i];
  for (size_t i = 0; i < count; i++) {
    uint64_t bits;
    memcpy(&bits, &values[i], sizeof bits);
    put(&array, bits, 8);
  }
  add(npz, name, &array);
  ambulo__text_free(&array);
}

void ambulo__npz_texts(ambulo__npz *npz, const char *name, const char *const *texts, size_t count) {
  ambulo__text_buffer array;
  char type[24];
  size_t longest = 1;
  for (size_t i = 0; i < count; i++)
    longest = strlen(texts[i]) > longest ? strlen(texts[i]) : longest;
  (void)snprintf(type, sizeof type, "<U%zu", longest);
  ambulo__text_init_part(&array, npz->text);
  put_description(&array, type, 1, &count);
  for (size_t i = 0; i < count; i++) {
    size_t length = strlen(texts[i]);
    for (size_t c = 0; c < longest; c++) {
      unsigned char letter = c < length ? (unsigned char)texts[i][c] : 0;
      put(&array, letter < 0x80 ? letter : '?', 4);
    }
  }
  add(npz, name, &array);
  ambulo__text_free(&array);
}

ambulo_status ambulo__npz_end(ambulo__npz *npz) {
  size_t at = npz->text->length;
  for (int i = 0; i < npz->count; i++) {
    const ambulo__npz_entry *e = &npz->entry[i];
    put(npz->text, CENTRAL, 4);
    put(npz->text, VERSION, 2);
    put_common(npz->text, e);
    put(npz->text, 0, 2); /* no comment */
    put(npz->text, 0, 2); /* disk */
    put(npz->text, 0, 2); /* attributes, inside and outside */
    put(npz->text, 0, 4);
    put(npz->text, e->at, 4);
    ambulo__text_append(npz->text, e->name);
  }
  size_t size = npz->text->length - at;
  put(npz->text, END, 4);
  put(npz->text, 0, 4); /* disks */
  put(npz->text, (uint64_t)npz->count, 2);
  put(npz->text, (uint64_t)npz->count, 2);
  put(npz->text, size, 4);
  put(npz->text, at, 4);
  put(npz->text, 0, 2);
  if (npz->too_large || npz->text->length > UINT32_MAX) return AMBULO_E_LIMIT;
  return ambulo__text_status(npz->text);
}

/*
 * n rows, m coordinates that do not carry the root, c loads (export.h). With a free root (p, R its
 * frame in the ground's axes, v its velocity, w its angular velocity):
 *
 *   q     [n][7 + m]  p, quaternion x y z w, coordinates            Pinocchio, JointModelFreeFlyer
 *   v     [n][6 + m]  R' v, R' w, rates
 *   a     [n][6 + m]  R' a - (R' w) x (R' v), R' w', second rates: the time derivatives of v
 *   tau   [n][6 + m]  R' f, R' (m - p x f), torques: f, m what the root wrench has besides contacts
 *   qpos  [n][7 + m]  p, quaternion w x y z, coordinates            MuJoCo
 *   qvel, qacc  [n][6 + m]  v, R' w, rates; a, R' w', second rates
 *
 * and without one the coordinates alone. Loads: force and moment about contact_point, in the
 * ground's axes, so that rnea(q, v, a) - sum J' wrench = tau.
 */

/* numbers of the base in positions, in rates */
enum { BASE_Q = 7, BASE_V = 6, ARRAYS = 7, WRENCH = 6 };
enum { Q, V, A, TAU, QPOS, QVEL, QACC };
static const char *const array_names[ARRAYS] = {"q", "v", "a", "tau", "qpos", "qvel", "qacc"};

typedef struct arrays {
  const ambulo__bodies *bodies;
  const ambulo__source *source;
  const ambulo__loads *loads;
  double *field[ARRAYS]; /* [rows][width] */
  size_t width[ARRAYS];
  double *wrench, *point; /* [rows][acting][6], [rows][acting][3] */
  int acting;             /* loads on bodies that move */
  const char **joints;    /* [rest count] */
  int *rest;              /* coordinates that do not carry the root */
  int rest_count;
} arrays;

/* coordinates of the way from the world to the root are the base's */
static void find_rest(arrays *s) {
  const ambulo_model *model = s->bodies->model;
  for (int i = 0; i < model->coordinate_count; i++) {
    int carries = 0;
    for (int link = s->bodies->root; link >= 0; link = model->links[link].parent)
      carries |= model->links[link].coordinate == i;
    if (carries) continue;
    s->joints[s->rest_count] = model->coordinates[i].name;
    s->rest[s->rest_count++] = i;
  }
}

static void fill_joints(arrays *s, int k, int base) {
  const ambulo__source *in = s->source;
  const double *const from[ARRAYS] = {in->q, in->qd, in->qdd, in->tau, in->q, in->qd, in->qdd};
  for (int f = 0; f < ARRAYS; f++) {
    size_t first = !base ? 0 : f == Q || f == QPOS ? BASE_Q : BASE_V;
    double *row = s->field[f] + (size_t)k * s->width[f] + first;
    for (int i = 0; i < s->rest_count; i++)
      row[i] = from[f][(size_t)k * (size_t)in->coordinates + (size_t)s->rest[i]];
  }
}

static int acts(const ambulo__export_load *load) {
  return load->body >= 0;
}

/* loads of row k; what of the root wrench they leave over: f, m about the origin */
static void fill_loads(arrays *s, int k, double f[3], double m[3]) {
  const ambulo__source *in = s->source;
  const ambulo__loads *loads = s->loads;
  const ambulo__rigid *world = &s->bodies->world;
  size_t to = (size_t)k * (size_t)s->acting;
  ambulo__rigid_vector(world, in->wrench + WRENCH * (size_t)k, m);
  ambulo__rigid_vector(world, in->wrench + WRENCH * (size_t)k + 3, f);
  for (int l = 0; l < loads->count; l++) {
    size_t at = 3 * ((size_t)k * (size_t)loads->count + (size_t)l);
    if (!acts(&loads->list[l])) continue;
    double *wrench = s->wrench + WRENCH * to, *point = s->point + 3 * to, moment[3];
    to++;
    ambulo__rigid_vector(world, loads->force + at, wrench);
    ambulo__rigid_vector(world, loads->point + at, point);
    ambulo__rigid_vector(world, loads->torque + at, wrench + 3);
    ambulo__cross(point, wrench, moment);
    int has = loads->list[l].kind == AMBULO__LOAD_HAND; /* the root wrench has it in it */
    for (int i = 0; !has && i < 3; i++) {
      f[i] -= wrench[i];
      m[i] -= moment[i] + wrench[3 + i];
    }
  }
}

static void fill_base(arrays *s, int k, const double f[3], const double m[3]) {
  const ambulo__source *in = s->source;
  size_t at = (size_t)k * (size_t)in->coordinates;
  ambulo__frame_motion base;
  double *row[ARRAYS], turn[3], about[3];
  for (int i = 0; i < ARRAYS; i++) row[i] = s->field[i] + (size_t)k * s->width[i];
  ambulo__frame_motion_of(s->bodies->model, s->bodies->root, &s->bodies->world, in->q + at,
                          in->qd + at, in->qdd + at, &base);
  ambulo__quaternion_of((const double(*)[3])base.place.r, k > 0 ? row[Q] - s->width[Q] + 3 : NULL,
                        row[Q] + 3);
  memcpy(row[Q], base.place.p, sizeof base.place.p);
  memcpy(row[QPOS], base.place.p, sizeof base.place.p);
  memcpy(row[QPOS] + 4, row[Q] + 3, 3 * sizeof(double));
  row[QPOS][3] = row[Q][6];
  ambulo__rigid_back(&base.place, base.velocity, row[V]);
  ambulo__rigid_back(&base.place, base.spin, row[V] + 3);
  ambulo__rigid_back(&base.place, base.acceleration, row[A]);
  ambulo__rigid_back(&base.place, base.spin_rate, row[A] + 3);
  memcpy(row[QVEL], base.velocity, sizeof base.velocity);
  memcpy(row[QVEL] + 3, row[V] + 3, 3 * sizeof(double));
  memcpy(row[QACC], base.acceleration, sizeof base.acceleration);
  memcpy(row[QACC] + 3, row[A] + 3, 3 * sizeof(double));
  ambulo__cross(row[V] + 3, row[V], turn);
  for (int i = 0; i < 3; i++) row[A][i] -= turn[i];
  ambulo__cross(base.place.p, f, turn);
  for (int i = 0; i < 3; i++) about[i] = m[i] - turn[i];
  ambulo__rigid_back(&base.place, f, row[TAU]);
  ambulo__rigid_back(&base.place, about, row[TAU] + 3);
}

/* ------------------------------------------------------------------------- archive */

static void write_names(const arrays *s, ambulo__npz *npz, const char **names) {
  const ambulo_model *model = s->bodies->model;
  const ambulo__loads *loads = s->loads;
  ambulo__npz_texts(npz, "joint_names", s->joints, (size_t)s->rest_count);
  for (int i = 0, to = 0; i < loads->count; i++)
    if (acts(&loads->list[i])) names[to++] = loads->list[i].name;
  ambulo__npz_texts(npz, "contact_names", names, (size_t)s->acting);
  for (int i = 0, to = 0; i < loads->count; i++)
    if (acts(&loads->list[i])) names[to++] = ambulo__export_name(s->bodies, loads->list[i].body);
  ambulo__npz_texts(npz, "contact_links", names, (size_t)s->acting);
  const char *root = s->bodies->root >= 0 ? model->links[s->bodies->root].name : "world";
  ambulo__npz_texts(npz, "root_link", &root, 1);
}

static ambulo_status write_archive(const arrays *s, const char **names, ambulo__text_buffer *text) {
  ambulo__npz npz;
  size_t rows = (size_t)s->source->rows, acting = (size_t)s->acting;
  double gravity[3];
  ambulo__rigid_vector(&s->bodies->world, s->bodies->model->gravity, gravity);
  ambulo__npz_begin(&npz, text);
  ambulo__npz_numbers(&npz, "times", s->source->time, 1, &rows);
  for (int f = 0; f < ARRAYS; f++)
    ambulo__npz_numbers(&npz, array_names[f], s->field[f], 2, (size_t[]){rows, s->width[f]});
  ambulo__npz_numbers(&npz, "contact_wrench", s->wrench, 3, (size_t[]){rows, acting, WRENCH});
  ambulo__npz_numbers(&npz, "contact_point", s->point, 3, (size_t[]){rows, acting, 3});
  ambulo__npz_numbers(&npz, "gravity", gravity, 1, &(size_t){3});
  write_names(s, &npz, names);
  return ambulo__npz_end(&npz);
}

ambulo_status ambulo__npz_motion(const ambulo__bodies *bodies, const ambulo__source *source,
                                 const ambulo__loads *loads, ambulo__text_buffer *text) {
  const ambulo_allocator *allocator = &bodies->allocator;
  arrays s = {.bodies = bodies, .source = source, .loads = loads};
  size_t rows = (size_t)source->rows, d = (size_t)source->coordinates;
  int base = bodies->root >= 0, complete = 1;
  for (int i = 0; i < loads->count; i++) s.acting += acts(&loads->list[i]);
  size_t acting = (size_t)s.acting;
  const char **names = ambulo__alloc(allocator, acting, sizeof *names);
  s.joints = ambulo__alloc(allocator, d, sizeof *s.joints);
  s.rest = ambulo__alloc(allocator, d, sizeof *s.rest);
  s.wrench = ambulo__alloc(allocator, rows * acting * WRENCH, sizeof *s.wrench);
  s.point = ambulo__alloc(allocator, rows * acting * 3, sizeof *s.point);
  if (s.joints && s.rest) find_rest(&s);
  for (int f = 0; f < ARRAYS; f++) {
    s.width[f] = (size_t)s.rest_count + (!base ? 0 : f == Q || f == QPOS ? BASE_Q : BASE_V);
    s.field[f] = ambulo__alloc(allocator, rows * s.width[f], sizeof(double));
    complete = complete && s.field[f];
  }
  complete = complete && names && s.joints && s.rest && s.wrench && s.point;
  for (int k = 0; complete && k < source->rows; k++) {
    double f[3], m[3];
    fill_joints(&s, k, base);
    fill_loads(&s, k, f, m);
    if (base) fill_base(&s, k, f, m);
  }
  ambulo_status status = complete ? write_archive(&s, names, text) : AMBULO_E_MEMORY;
  for (int f = 0; f < ARRAYS; f++) ambulo__free(allocator, s.field[f]);
  ambulo__free(allocator, s.wrench);
  ambulo__free(allocator, s.point);
  ambulo__free(allocator, s.rest);
  ambulo__free(allocator, s.joints);
  ambulo__free(allocator, names);
  return status;
}
