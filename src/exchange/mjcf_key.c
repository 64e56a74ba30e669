/* exchange/mjcf_key.c - the start pose of a MuJoCo model: its first keyframe.
 *
 * qpos has of a free joint its place in the world and a quaternion, of a ball a quaternion, of
 * others a number, in rad or m, all in the order of the joints. With R the turn, of a free joint
 * against the body's own orientation in the file and in axes along forward, left and up,
 *
 *     free   R = Rot_y(tilt) Rot_x(list) Rot_z(rotation)     (chain.c)
 *     ball   R = Rot_x(x) Rot_y(y) Rot_z(z)
 */
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "exchange/mjcf.h"

enum { MOST = 4096 };

void ambulo__mjcf_key(ambulo__mjcf *m) {
  const ambulo__xml_node *frames = ambulo__xml_child(m->root, "keyframe");
  const ambulo__xml_node *key = ambulo__xml_child(frames, "key");
  const char *text = key ? ambulo__xml_attribute(key, "qpos") : NULL;
  const char *name = key ? ambulo__xml_attribute(key, "name") : NULL;
  if (!text) return;
  m->key = ambulo__arena_take(m->tree->arena, MOST, sizeof *m->key);
  if (!m->key) return;
  m->key_count = ambulo__xml_numbers(m->xml, key, "qpos", text, MOST, 0, m->key);
  ambulo__tree_note(m->tree, key, "the start pose is that of keyframe '%.60s'",
                    name && name[0] ? name : "0");
}

const double *ambulo__mjcf_take(ambulo__mjcf *m, int count) {
  int at = m->key_used;
  m->key_used += count;
  return m->key && m->key_used <= m->key_count ? m->key + at : NULL;
}

static void set(ambulo__tree *tree, int link, double value) {
  if (link < tree->link_count) tree->links[link].coordinate.default_value = value;
}

void ambulo__mjcf_start_free(ambulo__mjcf *m, int first, const ambulo__rigid *body) {
  const double *key = ambulo__mjcf_take(m, 7);
  const ambulo__tree *t = m->tree;
  ambulo__rigid turn = ambulo__rigid_identity();
  double axes[3][3], n[3][3];
  if (!key || !ambulo__rotation_of_quaternion(key + 3, turn.r)) return;
  ambulo__rigid own = ambulo__rigid_turned(body), back = ambulo__rigid_inverse(&own);
  turn = ambulo__rigid_times(&turn, &back);
  for (int i = 0; i < 3; i++) {
    axes[2][i] = -t->gravity[i];
    axes[0][i] = t->forward[i];
  }
  (void)ambulo__normalize(axes[2]);
  ambulo__cross(axes[2], axes[0], axes[1]);
  (void)ambulo__normalize(axes[1]);
  ambulo__cross(axes[1], axes[2], axes[0]);
  for (int j = 0; j < 3; j++) {
    double column[3];
    ambulo__rigid_vector(&turn, axes[j], column);
    for (int i = 0; i < 3; i++) n[i][j] = ambulo__dot(axes[i], column);
  }
  for (int i = 0; i < 3; i++) set(m->tree, first + i, key[i] - body->p[i]);
  set(m->tree, first + 3, atan2(n[0][2], n[2][2]));
  set(m->tree, first + 4, -asin(fmax(-1.0, fmin(1.0, n[1][2]))));
  set(m->tree, first + 5, atan2(n[1][0], n[1][1]));
}

void ambulo__mjcf_start_ball(ambulo__mjcf *m, int first) {
  const double *key = ambulo__mjcf_take(m, 4);
  double n[3][3];
  if (!key || !ambulo__rotation_of_quaternion(key, n)) return;
  set(m->tree, first, atan2(-n[1][2], n[2][2]));
  set(m->tree, first + 1, asin(fmax(-1.0, fmin(1.0, n[0][2]))));
  set(m->tree, first + 2, atan2(-n[0][1], n[0][0]));
}
