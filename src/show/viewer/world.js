// What stands around a body: ground, steps, obstacles, seats, footprints, places, paths.
import {
  BoxGeometry, BufferAttribute, BufferGeometry, CapsuleGeometry, CircleGeometry, CylinderGeometry,
  DoubleSide, Group, InstancedMesh, LineBasicMaterial, LineSegments, Matrix4, Mesh,
  MeshBasicMaterial, MeshStandardMaterial, Quaternion, TorusGeometry, Vector3,
} from "three";
import { pointAt, toView } from "./figure.js";
import { sampleAt } from "./decode.js";

const up = new Vector3(0, 1, 0);
const width = 1.3; // of steps, m

const solid = (color, more = {}) => new MeshStandardMaterial({ color, roughness: 0.9, ...more });

function shape(points, faces) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(points.flat()), 3));
  geometry.setIndex(faces);
  const apart = geometry.toNonIndexed();
  apart.computeVertexNormals();
  return apart;
}

// the body's way along forward, from the first to the last sample, m
function extent(scene) {
  const [f, l] = scene.center_of_mass;
  const far = (list, pick) => list.reduce((a, b) => pick(a, b));
  return { from: far(f, Math.min), to: far(f, Math.max), left: far(l, Math.max), right: far(l, Math.min) };
}

// a solid below a surface that goes from (x0, y0) to (x1, y1)
function prism(x0, y0, x1, y1, base) {
  const z = width / 2;
  const p = [[x0, y0, -z], [x1, y1, -z], [x1, y1, z], [x0, y0, z],
    [x0, base, -z], [x1, base, -z], [x1, base, z], [x0, base, z]];
  return shape(p, [0, 2, 1, 0, 3, 2, 3, 6, 2, 3, 7, 6, 0, 1, 5, 0, 5, 4, 0, 4, 7, 0, 7, 3, 1, 2, 6,
    1, 6, 5]);
}

export class World {
  constructor(scene, colors) {
    this.scene = scene;
    this.group = new Group();
    this.prints = new Group();
    this.paths = new Group();
    this.repeated = new Group(); // what comes again each period
    this.repeated.add(this.prints, this.paths);
    this.group.add(this.repeated);
    this.colors = colors;
    this.extent = extent(scene);
    this.moving = []; // functions of time
    if (scene.ground.is_there) this.addGround();
    scene.obstacles.forEach((o) => this.addObstacle(o));
    this.addRests();
    this.addPlaces();
    this.addFootprints();
    this.addPaths();
  }

  add(mesh, parent = this.group) {
    mesh.receiveShadow = true;
    parent.add(mesh);
    return mesh;
  }

  addGround() {
    const { surfaces } = this.scene.ground;
    const steps = surfaces.filter((s) => Math.abs(s.height) > 1e-6 || Math.abs(s.slope) > 1e-6);
    let lowest = 0;
    if (steps.length) lowest = this.addSteps(surfaces);
    const floor = new Mesh(new CircleGeometry(40, 64), solid(this.colors.floor));
    floor.rotation.x = -Math.PI / 2;
    floor.position.y = lowest - 0.002;
    this.floor = this.add(floor);
    // in short pieces: some renderers drop a line of which one end is behind the eye
    const lines = [], half = 15;
    for (let i = -2 * half; i <= 2 * half; i++)
      for (let k = -half; k < half; k++)
        lines.push(0.5 * i, 0, k, 0.5 * i, 0, k + 1, k, 0, 0.5 * i, k + 1, 0, 0.5 * i);
    const grid = new BufferGeometry();
    grid.setAttribute("position", new BufferAttribute(new Float32Array(lines), 3));
    this.grid = new LineSegments(grid, new LineBasicMaterial({ color: this.colors.grid }));
    this.grid.position.y = lowest;
    this.group.add(this.grid);
  }

  // returns the height of the floor below them
  addSteps(surfaces) {
    const first = surfaces[0], last = surfaces[surfaces.length - 1];
    const ends = (s) => [s.from ?? Math.min(s.at, this.extent.from) - 0.9,
      s.to ?? Math.max(s.at, this.extent.to) + 0.9];
    const height = (s, x) => s.height + s.slope * (x - s.at);
    const near = surfaces.filter((s) => {
      const [from, to] = ends(s);
      return to > this.extent.from - 2.5 && from < this.extent.to + 2.5;
    });
    const heights = near.flatMap((s) => ends(s).map((x) => height(s, x)));
    const base = Math.min(...heights) - (near.length > 1 ? 0.02 : 0.1);
    const paint = [solid(this.colors.step), solid(this.colors.step2)];
    near.forEach((s, i) => {
      const [x0, x1] = ends(s);
      if (x1 - x0 > 1e-6)
        this.add(new Mesh(prism(x0, height(s, x0), x1, height(s, x1), base), paint[i % 2]))
          .castShadow = true;
    });
    return Math.min(first.height, last.height, base);
  }

  addObstacle(o) {
    const material = solid(this.colors.obstacle);
    let mesh;
    if (o.shape === "box") {
      const [f, l, u] = o.half_size;
      mesh = new Mesh(new BoxGeometry(2 * f, 2 * u, 2 * l), material);
      toView(...o.center, mesh.position);
      mesh.rotation.y = o.heading;
    } else {
      const from = toView(...o.from), to = toView(...o.to), way = to.clone().sub(from);
      const length = Math.max(way.length(), 1e-4);
      mesh = new Mesh(new CapsuleGeometry(o.radius, length, 6, 16), material);
      mesh.position.addVectors(from, to).multiplyScalar(0.5);
      mesh.quaternion.setFromUnitVectors(up, way.normalize());
    }
    mesh.castShadow = true;
    this.add(mesh);
  }

  // what patches rest on: a stool under a seat, a pad against a wall
  addRests() {
    const known = new Set();
    for (const contact of this.scene.contacts) {
      if (!contact.surface) continue;
      const key = JSON.stringify(contact.surface);
      if (known.has(key)) continue;
      known.add(key);
      const c = contact.surface.map((p) => toView(...p));
      const middle = c.reduce((a, b) => a.add(b), new Vector3()).multiplyScalar(0.25);
      const ahead = c[0].clone().sub(c[1]), aside = c[0].clone().sub(c[3]);
      const normal = new Vector3().crossVectors(aside, ahead).normalize();
      const level = Math.abs(normal.y) > 0.7;
      if (level && normal.y < 0) normal.negate();
      const size = level && middle.y > 0.15 ? 0.36 : 0;
      const slab = new Mesh(new BoxGeometry(Math.max(ahead.length(), size), 0.05,
        Math.max(aside.length(), size)), solid(this.colors.obstacle));
      slab.quaternion.setFromUnitVectors(up, normal);
      slab.position.copy(middle).addScaledVector(normal, -0.026);
      slab.castShadow = true;
      this.add(slab);
      if (!level || middle.y < 0.15) continue;
      for (const [x, z] of [[1, 1], [1, -1], [-1, 1], [-1, -1]]) {
        const leg = new Mesh(new CylinderGeometry(0.018, 0.014, middle.y - 0.05, 10),
          solid(this.colors.step2));
        leg.position.set(middle.x + 0.15 * x, (middle.y - 0.05) / 2, middle.z + 0.15 * z);
        leg.castShadow = true;
        this.add(leg);
      }
    }
  }

  addPlaces() {
    for (const place of this.scene.places) {
      const material = new MeshBasicMaterial({ color: this.colors.place, transparent: true });
      const mesh = new Mesh(new TorusGeometry(0.045, 0.008, 10, 40), material);
      toView(...place.at, mesh.position);
      this.group.add(mesh);
      this.moving.push((time) => {
        const now = time >= place.from - 0.02 && time <= place.to + 0.02;
        material.opacity = now ? 1 : 0.35;
      });
      this.faces = [...(this.faces ?? []), mesh];
    }
  }

  // stances: spans of contact of one foot without a gap, as one print where the foot was flattest
  stances() {
    const list = [];
    for (const foot of this.scene.feet) {
      if (foot.sole.length < 2) continue;
      const spans = this.scene.contacts.filter((c) => c.name === foot.name)
        .sort((a, b) => a.from - b.from);
      let open = null;
      for (const span of spans) {
        if (open && span.from - open.to < 1e-3) open.to = span.to;
        else list.push(open = { foot, from: span.from, to: span.to, time: null });
        if (span.mode === "flat" && open.time === null) open.time = (span.from + span.to) / 2;
      }
    }
    return list.filter((s) => s.time !== null && s.to - s.from > 0.02);
  }

  addFootprints() {
    for (const { foot, time } of this.stances()) {
      if (foot.sole.length < 4) continue;
      const at = foot.sole.map((p) => pointAt(this.scene, p, sampleAt(this.scene, time),
        new Vector3()));
      const outline = at.map((p) => [p.x, p.y + 0.004, p.z]);
      const mesh = new Mesh(shape(outline, [0, 1, 2, 0, 2, 3]), new MeshBasicMaterial({
        color: this.colors[foot.side], transparent: true, opacity: 0.3, side: DoubleSide,
        depthWrite: false }));
      mesh.renderOrder = 1;
      this.prints.add(mesh);
    }
  }

  // where the center of pressure goes while a foot or a patch is loaded: a dot a sample
  addPaths() {
    const least = 0.03 * this.scene.weight, matrix = new Matrix4(), still = new Quaternion();
    for (const f of this.scene.forces) {
      const dots = [];
      for (let k = 0; k < this.scene.samples; k++) {
        if (Math.hypot(...f.force.map((x) => x[k])) < least) continue;
        dots.push(toView(f.pressure[0][k], f.pressure[1][k], f.pressure[2][k] + 0.006));
      }
      if (!dots.length) continue;
      const disc = new CircleGeometry(0.009, 12);
      disc.rotateX(-Math.PI / 2);
      const mesh = new InstancedMesh(disc, new MeshBasicMaterial({ color: this.colors.pressure }),
        dots.length);
      dots.forEach((p, i) => mesh.setMatrixAt(i, matrix.compose(p, still, new Vector3(1, 1, 1))));
      mesh.frustumCulled = false;
      this.paths.add(mesh);
    }
  }

  // ground without end: it goes along in whole squares of the grid
  follow(x) {
    const whole = 5 * Math.round(x / 5);
    if (this.grid) this.grid.position.x = whole;
    if (this.floor) this.floor.position.x = whole;
  }

  at(time, camera) {
    for (const move of this.moving) move(time);
    for (const ring of this.faces ?? []) ring.lookAt(camera.position);
  }
}

// An arrow that is set to a force; length by the body weight.
export class Arrow {
  constructor(color) {
    this.group = new Group();
    const material = new MeshBasicMaterial({ color, depthTest: false, transparent: true, opacity: 0.92 });
    this.shaft = new Mesh(new CylinderGeometry(0.014, 0.014, 1, 12), material);
    this.head = new Mesh(new CylinderGeometry(0, 0.042, 0.11, 20), material);
    for (const mesh of [this.shaft, this.head]) mesh.renderOrder = 4;
    this.group.add(this.shaft, this.head);
    this.way = new Vector3();
  }

  set(at, force, length) {
    this.group.visible = length > 0.02;
    if (!this.group.visible) return;
    this.group.position.copy(at);
    this.group.quaternion.setFromUnitVectors(up, this.way.copy(force).normalize());
    const head = Math.min(0.11, 0.5 * length), shaft = length - head;
    this.head.scale.setScalar(head / 0.11);
    this.shaft.scale.y = shaft;
    this.shaft.position.y = shaft / 2;
    this.head.position.y = shaft + head / 2;
  }
}
