// Shapes of limbs and trunk around capsules whose names tell what they are. Capsules are the room
// that a body takes up; here they only become rounder where people are.
import { BufferAttribute, BufferGeometry, LatheGeometry, SphereGeometry, Vector2, Vector3 } from "three";
import { pointAt } from "./figure.js";

// radii by the capsule's, from its first end to its second
const profiles = [
  [/^thigh/, [1.3, 1.27, 1.16, 1.03, 0.92, 0.84]],
  [/^shank/, [0.95, 1.1, 1.14, 0.98, 0.8, 0.68]],
  [/^upper_arm/, [1.22, 1.2, 1.1, 1.0, 0.92, 0.86]],
  [/^forearm/, [0.98, 1.06, 0.98, 0.85, 0.74, 0.68]],
];

export function limb(name, radius, length) {
  if (name === "head") {
    const head = new SphereGeometry(radius * 0.97, 32, 24);
    head.scale(1, (length / 2 + radius * 1.04) / (radius * 0.97), 1);
    return head;
  }
  const profile = profiles.find(([word]) => word.test(name ?? ""))?.[1];
  if (!profile) return null;
  const points = [], steps = 24, caps = 6;
  const at = (t) => {
    const x = t * (profile.length - 1), k = Math.min(Math.floor(x), profile.length - 2), s = x - k;
    const p = (i) => profile[Math.min(Math.max(i, 0), profile.length - 1)];
    const [a, b, c, d] = [p(k - 1), p(k), p(k + 1), p(k + 2)];
    return radius * (b + 0.5 * s * (c - a + s * (2 * a - 5 * b + 4 * c - d + s * (3 * (b - c) + d - a))));
  };
  const cap = (end, r, sign) => {
    for (let i = 0; i < caps; i++) {
      const angle = ((sign > 0 ? i + 1 : caps - i) / caps) * (Math.PI / 2);
      points.push(new Vector2(r * Math.cos(angle), end + sign * r * Math.sin(angle)));
    }
  };
  cap(-length / 2, at(0), -1);
  for (let i = 0; i <= steps; i++) points.push(new Vector2(at(i / steps), length * (i / steps - 0.5)));
  cap(length / 2, at(1), 1);
  return new LatheGeometry(points.map((p) => p.set(Math.max(p.x, 1e-5), p.y)), 26);
}

const around = 30, between = 4;

// rings around a line from the hips to the neck: elliptic, wide from side to side
export class Trunk {
  constructor(scene) {
    const bone = (name) => scene.bones.find((b) => b.kind === "capsule" && b.name === name);
    this.bones = ["pelvis", "trunk", "shoulders", "head"].map(bone);
    this.isThere = this.bones.slice(0, 3).every(Boolean);
    if (!this.isThere) return;
    this.scene = scene;
    this.ends = this.bones.map((b) => b && [new Vector3(), new Vector3()]);
    this.place([0, 0]);
    const rings = this.rings();
    this.count = (rings.length - 1) * between + 1;
    const index = [];
    for (let i = 0; i < this.count - 1; i++) {
      for (let j = 0; j < around; j++) {
        const a = i * around + j, b = i * around + ((j + 1) % around);
        index.push(a, a + around, b, b, a + around, b + around);
      }
    }
    this.geometry = new BufferGeometry();
    this.position = new Float32Array(this.count * around * 3);
    this.geometry.setAttribute("position", new BufferAttribute(this.position, 3));
    this.geometry.setIndex(index);
  }

  place(where) {
    this.bones.forEach((bone, i) => bone?.points.forEach((p, e) =>
      pointAt(this.scene, p, where, this.ends[i][e])));
  }

  // center, half width, half depth, direction to the side
  rings() {
    const [[p0, p1], [t0, t1], [s0, s1], head] = this.ends;
    const [pelvis, trunk, shoulders] = this.bones;
    const middle = (a, b) => a.clone().lerp(b, 0.5);
    const hips = middle(p0, p1), top = middle(s0, s1);
    const sideP = p1.clone().sub(p0), sideS = s1.clone().sub(s0);
    const hip = sideP.length() / 2 + 0.92 * pelvis.radius, shoulder = sideS.length() / 2;
    sideP.normalize();
    sideS.normalize();
    const spine = t0.clone().sub(hips).normalize(), chest = top.clone().sub(t1).normalize();
    const r = trunk.radius, pr = pelvis.radius, sr = shoulders.radius;
    const on = (from, way, by) => from.clone().addScaledVector(way, by);
    const ring = (c, w, d, share) => ({ c, w, d, side: sideP.clone().lerp(sideS, share) });
    const list = [
      ring(on(hips, spine, -1.25 * pr), 0.18 * hip, 0.3 * pr, 0),
      ring(on(hips, spine, -1.05 * pr), 0.62 * hip, 0.8 * pr, 0),
      ring(on(hips, spine, -0.5 * pr), 0.98 * hip, 1.08 * pr, 0),
      ring(on(hips, spine, 0.1 * pr), 1.04 * hip, 1.12 * pr, 0),
      ring(hips.clone().lerp(t0, 0.85), 0.94 * hip, 1.02 * pr, 0.15),
      ring(t0.clone().lerp(t1, 0.3), 1.08 * r, 0.84 * r, 0.4),
      ring(t0.clone().lerp(t1, 0.65), 1.2 * r, 0.93 * r, 0.65),
      ring(t1.clone(), 1.36 * r, 1.0 * r, 0.9),
      ring(on(top, chest, -0.25 * sr), shoulder + 0.62 * sr, 1.2 * sr, 1),
      ring(on(top, chest, 0.45 * sr), 0.86 * shoulder + 0.4 * sr, 0.95 * sr, 1),
      ring(on(top, chest, 0.95 * sr), 0.52 * shoulder, 0.78 * sr, 1),
    ];
    if (head) {
      const neck = head[0].clone();
      list.push(ring(on(top, chest, 1.3 * sr), 0.8 * sr, 0.75 * sr, 1),
        ring(top.clone().lerp(neck, 0.75), 0.7 * sr, 0.74 * sr, 1), ring(neck, 0.66 * sr, 0.7 * sr, 1));
    } else list.push(ring(on(top, chest, 1.15 * sr), 0.02, 0.02, 1));
    return list;
  }

  pose(where) {
    this.place(where);
    const rings = this.rings(), one = new Vector3(), way = new Vector3(), ahead = new Vector3();
    const curve = (i, s, get) => {
      const p = (k) => get(rings[Math.min(Math.max(k, 0), rings.length - 1)]);
      const [a, b, c, d] = [p(i - 1), p(i), p(i + 1), p(i + 2)];
      return b + 0.5 * s * (c - a + s * (2 * a - 5 * b + 4 * c - d + s * (3 * (b - c) + d - a)));
    };
    const vector = (i, s, key, out) => out.set(...["x", "y", "z"].map((k) => curve(i, s, (r) => r[key][k])));
    const center = [], side = [];
    for (let n = 0; n < this.count; n++) {
      const i = Math.min(Math.floor(n / between), rings.length - 2), s = n / between - i;
      center.push(vector(i, s, "c", new Vector3()));
      side.push(vector(i, s, "side", new Vector3()));
    }
    for (let n = 0; n < this.count; n++) {
      const i = Math.min(Math.floor(n / between), rings.length - 2), s = n / between - i;
      const w = Math.max(curve(i, s, (r) => r.w), 0.01), d = Math.max(curve(i, s, (r) => r.d), 0.01);
      way.subVectors(center[Math.min(n + 1, this.count - 1)], center[Math.max(n - 1, 0)]).normalize();
      ahead.crossVectors(side[n], way).normalize();
      one.crossVectors(way, ahead).normalize();
      for (let j = 0; j < around; j++) {
        const angle = (2 * Math.PI * j) / around, at = 3 * (n * around + j);
        const a = w * Math.cos(angle), b = d * Math.sin(angle);
        this.position[at] = center[n].x + a * one.x + b * ahead.x;
        this.position[at + 1] = center[n].y + a * one.y + b * ahead.y;
        this.position[at + 2] = center[n].z + a * one.z + b * ahead.z;
      }
    }
    this.geometry.attributes.position.needsUpdate = true;
    this.geometry.computeVertexNormals();
  }
}
