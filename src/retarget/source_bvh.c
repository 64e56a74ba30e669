/* retarget/source_bvh.c - BVH: a hierarchy of joints with offsets and channels, then a line of
 * numbers for each frame.
 *
 * A joint's rotation is the product of those of its channels in their order, its angles in degrees.
 * The format has no unit of length: the skeleton is made as large as its legs are those of an
 * adult, unless they are that in metres or centimetres. y is up, and the skeleton at rest faces
 * along z.
 */
#include "retarget/source.h"

#include "base/numtext.h"
#include "import/rigid.h"
#include "formats/read_file.h"
#include "model/model.h"
#include "retarget/segments.h"
#include "retarget/skeleton_model.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

enum { MOST_CHANNELS = 6 };

typedef struct bvh {
  const char *path, *at; /* what is left to read */
  int line;
  ambulo_diagnostics *diagnostics;
  ambulo__skeleton_joints joints;
  int channels[AMBULO__MOST_JOINTS];
  char channel[AMBULO__MOST_JOINTS][MOST_CHANNELS]; /* "XYZ": places, "xyz": angles */
  int channel_count;
  int frames;
  double frame_time, scale;
} bvh;

static ambulo_status fault(const bvh *b, const char *expected, const char *got, size_t length) {
  ambulo__place place = {.file = b->path, .line = b->line};
  return ambulo__error(b->diagnostics, AMBULO_E_PARSE, place, NULL, "got '%.*s'; expected %s",
                       length > 40 ? 40 : (int)length, got, expected);
}

/* the next word; its length, 0 at the end */
static size_t next(bvh *b, const char **word) {
  while (*b->at && isspace((unsigned char)*b->at)) b->line += *b->at++ == '\n';
  *word = b->at;
  while (*b->at && !isspace((unsigned char)*b->at)) b->at++;
  return (size_t)(b->at - *word);
}

static int is(const char *word, size_t length, const char *what) {
  return strlen(what) == length && memcmp(word, what, length) == 0;
}

static ambulo_status expect(bvh *b, const char *what) {
  const char *word;
  size_t length = next(b, &word);
  return is(word, length, what) ? AMBULO_OK : fault(b, what, word, length);
}

static ambulo_status read_number(bvh *b, double *value) {
  const char *word;
  size_t length = next(b, &word);
  if (length > 0 && ambulo__parse_double(word, length, value)) return AMBULO_OK;
  return fault(b, "a number", word, length);
}

static ambulo_status read_channels(bvh *b, int joint) {
  double count;
  ambulo_status status = read_number(b, &count);
  if (!status && (count < 0 || count > MOST_CHANNELS || count != floor(count)))
    return fault(b, "at most 6 channels", "more", 4);
  for (int i = 0; !status && i < (int)count; i++) {
    const char *word;
    size_t length = next(b, &word);
    int turns = length == 9 && memcmp(word + 1, "rotation", 8) == 0;
    int slides = length == 9 && memcmp(word + 1, "position", 8) == 0;
    if ((!turns && !slides) || !strchr("XYZ", word[0]))
      return fault(b, "a channel such as Xposition, Zrotation", word, length);
    b->channel[joint][i] = turns ? (char)tolower((unsigned char)word[0]) : word[0];
  }
  if (!status) b->channels[joint] = (int)count;
  if (!status) b->channel_count += (int)count;
  return status;
}

/* a name of a model file: "mixamorig:LeftArm" is LeftArm */
static void take_name(const char *word, size_t length, char *name) {
  for (size_t i = 0; i < length; i++) {
    if (word[i] != ':') continue;
    word += i + 1;
    length -= i + 1;
    i = (size_t)-1;
  }
  if (length >= AMBULO__JOINT_NAME) length = AMBULO__JOINT_NAME - 1;
  for (size_t i = 0; i < length; i++) name[i] = isalnum((unsigned char)word[i]) ? word[i] : '_';
  name[length] = '\0';
}

static ambulo_status open_joint(bvh *b, int parent, int is_end, int *opened) {
  const char *word;
  size_t length = next(b, &word);
  if (b->joints.count == AMBULO__MOST_JOINTS)
    return ambulo__error(b->diagnostics, AMBULO_E_LIMIT, (ambulo__place){.file = b->path}, NULL,
                         "more than %d joints", AMBULO__MOST_JOINTS);
  *opened = b->joints.count++;
  ambulo__skeleton_joint *j = &b->joints.joint[*opened];
  j->parent = parent;
  j->is_end = is_end;
  take_name(word, length, j->name);
  return expect(b, "{");
}

static ambulo_status read_hierarchy(bvh *b) {
  const char *word;
  int joint = -1, done = 0;
  ambulo_status status = expect(b, "HIERARCHY");
  while (!status && !done) {
    size_t length = next(b, &word);
    if (is(word, length, "ROOT") || is(word, length, "JOINT") || is(word, length, "End")) {
      int inside = joint >= 0 && !b->joints.joint[joint].is_end;
      if (inside != !is(word, length, "ROOT")) return fault(b, "one ROOT", word, length);
      status = open_joint(b, joint, is(word, length, "End"), &joint);
    } else if (joint >= 0 && is(word, length, "OFFSET")) {
      for (int i = 0; !status && i < 3; i++)
        status = read_number(b, &b->joints.joint[joint].offset[i]);
    } else if (joint >= 0 && is(word, length, "CHANNELS")) {
      status = read_channels(b, joint);
    } else if (joint >= 0 && is(word, length, "}")) {
      joint = b->joints.joint[joint].parent;
      done = joint < 0;
    } else {
      return fault(b, "JOINT, End, OFFSET, CHANNELS or }", word, length);
    }
  }
  return status;
}

static ambulo_status read_head(bvh *b) {
  double frames = 0.0;
  ambulo_status status = expect(b, "MOTION");
  if (!status) status = expect(b, "Frames:");
  if (!status) status = read_number(b, &frames);
  if (!status) status = expect(b, "Frame");
  if (!status) status = expect(b, "Time:");
  if (!status) status = read_number(b, &b->frame_time);
  if (!status && (frames < 1 || frames > 1e7 || !(b->frame_time > 0.0)))
    status = fault(b, "frames, and a time between them", "none", 4);
  b->frames = (int)frames;
  return status;
}

/* legs of an adult, or their length in metres or centimetres */
static void find_scale(bvh *b) {
  static const double adult = 0.82; /* from the hip to the ankle */
  double leg = 0.0;
  for (int i = 0; i < b->joints.count; i++) {
    int segment = b->joints.joint[i].is_end ? -1 : ambulo__segment_of(b->joints.joint[i].name);
    if (segment != AMBULO__SHANK && segment != AMBULO__FOOT) continue;
    const double *o = b->joints.joint[i].offset;
    leg += sqrt(o[0] * o[0] + o[1] * o[1] + o[2] * o[2]);
  }
  b->scale = leg > 0.0 ? adult / leg : 1.0;
  if (b->scale > 0.75 && b->scale < 2.0) b->scale = 1.0;
  if (b->scale > 0.0075 && b->scale < 0.02) b->scale = 0.01;
  for (int i = 0; i < b->joints.count; i++)
    for (int k = 0; k < 3; k++) b->joints.joint[i].offset[k] *= b->scale;
}

static ambulo_status read_frame(bvh *b, double *q) {
  static const double degree = 3.14159265358979323846 / 180.0;
  ambulo_status status = AMBULO_OK;
  for (int j = 0, first = 3; !status && j < b->joints.count; j++) {
    if (b->joints.joint[j].is_end) continue;
    ambulo__rigid turn = ambulo__rigid_identity();
    for (int i = 0; !status && i < b->channels[j]; i++) {
      double value = 0.0, axis[3] = {0.0};
      char kind = b->channel[j][i];
      status = read_number(b, &value);
      if (isupper((unsigned char)kind)) {
        if (j == 0) q[kind - 'X'] = b->scale * value;
        continue;
      }
      axis[kind - 'x'] = 1.0;
      ambulo__rigid step = ambulo__rigid_turn(axis, degree * value);
      turn = ambulo__rigid_times(&turn, &step);
    }
    ambulo__joint_angles((const double(*)[3])turn.r, q + first);
    first += 3;
  }
  return status;
}

ambulo_status ambulo__given_bvh(const char *path, ambulo_diagnostics *diagnostics,
                                ambulo__given *given) {
  static const size_t limit = (size_t)1 << 28;
  char *text = NULL;
  size_t length = 0;
  bvh *b = ambulo__alloc(&given->allocator, 1, sizeof *b);
  ambulo_status status =
      b ? ambulo__read_file(path, limit, &given->allocator, diagnostics, &text, &length)
        : AMBULO_E_MEMORY;
  if (!status) {
    b->path = path;
    b->at = text;
    b->line = 1;
    b->diagnostics = diagnostics;
    status = read_hierarchy(b);
  }
  if (!status) status = read_head(b);
  if (!status) find_scale(b);
  if (!status) status = ambulo__joints_model(&b->joints, "skeleton", diagnostics, given);
  if (!status) status = ambulo__given_rows(given, b->frames);
  for (int k = 0; !status && k < given->rows; k++) {
    given->time[k] = b->frame_time * k;
    status = read_frame(b, given->q + (size_t)k * (size_t)given->body->coordinate_count);
  }
  ambulo__free(&given->allocator, text);
  ambulo__free(&given->allocator, b);
  return status;
}
