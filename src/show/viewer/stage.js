// The view in space: camera, light, one motion or two; drawn only when something changed.
import {
  AmbientLight, DirectionalLight, Fog, Group, HemisphereLight, PCFShadowMap, PerspectiveCamera, Scene,
  Vector2, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Actor } from "./actor.js";
import { css } from "./dom.js";
import { sampleAt, valueAt } from "./decode.js";
import { Figure } from "./figure.js";

const names = ["left", "right", "middle", "carried", "device", "ghost", "floor", "grid", "step",
  "step2", "obstacle", "place", "pressure", "force", "mass", "sky", "muscle", "active", "contact"];
const readColors = () => Object.fromEntries(names.map((n) => [n, css(`--${n}`)]));

export function hasWebGL() {
  try {
    const canvas = document.createElement("canvas");
    return Boolean(canvas.getContext("webgl2"));
  } catch {
    return false;
  }
}

export class Stage {
  constructor(canvas) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.camera = new PerspectiveCamera(32, 1, 0.05, 80);
    this.camera.position.set(2.6, 1.5, 4.2);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enablePan = true;
    this.controls.minDistance = 0.6;
    this.controls.maxDistance = 18;
    this.controls.maxPolarAngle = Math.PI / 2 + 0.15;
    this.controls.addEventListener("change", () => this.draw());
    this.controls.addEventListener("start", () => this.onTurn?.());
    this.root = new Group();
    this.scene = new Scene();
    this.scene.add(this.root);
    this.lights();
    this.shows = { forces: true, prints: true, paths: false, mass: false, bones: false,
      ghost: true, follow: true, muscles: true, contacts: false, meshes: true };
    this.time = 0;
    this.period = 0;
    this.apart = false; // two motions side by side
    this.focus = new Vector3();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
  }

  lights() {
    this.scene.add(new HemisphereLight(0xffffff, 0x9aa3ad, 1.7), new AmbientLight(0xffffff, 0.2));
    const sun = this.sun = new DirectionalLight(0xffffff, 1.9);
    sun.castShadow = true;
    sun.shadow.mapSize.set(1024, 1024);
    sun.shadow.bias = -0.0006;
    sun.shadow.normalBias = 0.015;
    Object.assign(sun.shadow.camera, { left: -2.2, right: 2.2, top: 2.4, bottom: -1.6, near: 0.5,
      far: 14 });
    this.scene.add(sun, sun.target);
  }

  load(scene, ghost) {
    this.data = scene;
    this.ghostData = ghost;
    this.build();
    this.frame();
  }

  // another motion is a ghost in the place of the first one's body, or an actor in a picture of its own
  build() {
    this.root.clear();
    const colors = this.colors = readColors();
    const { data, ghostData } = this;
    this.actor = new Actor(data, colors);
    this.root.add(this.actor.root);
    this.ghost = this.second = null;
    if (ghostData && this.apart) {
      this.second = new Actor(ghostData, colors);
      this.root.add(this.second.root);
    } else if (ghostData) {
      const c = colors.ghost;
      this.ghost = new Figure(ghostData, { left: c, right: c, middle: c, carried: c, device: c }, true);
      this.actor.figures.add(this.ghost.group);
    }
    this.renderer.setClearColor(colors.sky);
    this.scene.fog = new Fog(colors.sky, 9, 24);
    this.setAspect();
    this.show({});
  }

  show(change) {
    Object.assign(this.shows, change);
    const { shows } = this;
    this.actor.show(shows);
    this.second?.show(shows);
    if (this.ghost) {
      this.ghost.group.visible = shows.ghost;
      this.ghost.showBones(false, false, shows.meshes);
    }
    this.moveTo(this.time, this.period, this.ghostTime);
  }

  moveTo(time, period, ghostTime) {
    const { data, actor, second, shows } = this;
    this.time = time;
    this.period = period;
    this.ghostTime = ghostTime;
    const center = actor.centerAt(time, period);
    actor.moveTo(time, period, shows, this.camera);
    if (this.ghost) this.placeGhost(sampleAt(data, time), ghostTime);
    if (second) this.placeSecond(center, second);
    if (shows.follow && data.ground.is_there) this.goAlong(center);
    this.sun.target.position.copy(center);
    this.sun.position.copy(center).add(new Vector3(1.6, 4.6, 2.4));
    this.draw();
  }

  // before the same camera, wherever its own way leads; it walks on as often as the first
  placeSecond(center, second) {
    const { shows, ghostTime, period } = this, moves = shows.follow && this.data.ground.is_there;
    const own = second.data.repeats ? period : 0;
    second.moveTo(ghostTime, own, shows, this.camera);
    second.root.position.copy(moves ? center : this.actor.centerAt(0))
      .sub(moves ? second.centerAt(ghostTime, own) : second.centerAt(0));
    if (!this.followsHeight()) second.root.position.y = 0;
  }

  // beside the body, wherever its own way has led it
  placeGhost(where, time) {
    const g = this.ghostData;
    this.ghost.pose(time);
    const there = sampleAt(g, time);
    const at = (s, i, w) => valueAt(s.center_of_mass[i], w);
    this.ghost.group.position.set(at(this.data, 0, where) - at(g, 0, there), 0,
      -(at(this.data, 1, where) - at(g, 1, there)));
  }

  goAlong(center) {
    const change = center.clone().sub(this.focus);
    if (this.data.repeats === undefined || !this.followsHeight()) change.y = 0;
    this.focus.add(change);
    this.camera.position.add(change);
    this.controls.target.add(change);
    this.camera.updateMatrixWorld();
  }

  followsHeight() {
    const up = this.data.center_of_mass[2];
    return Math.abs(this.data.rise ?? 0) > 0 || Math.max(...up) - Math.min(...up) > 0.7 ||
      this.data.ground.slope !== 0;
  }

  // how much there is to see, m: from the lowest to the highest point; of what stands on no ground
  // also from the rearmost to the foremost, around a middle of its own
  size() {
    const ends = [Infinity, -Infinity, Infinity, -Infinity];
    for (const { points, samples } of this.second ? [this.data, this.second.data] : [this.data]) for (const p of points) {
      for (let k = 0; k < samples; k += 8) {
        [0, 2].forEach((axis, i) => {
          ends[2 * i] = Math.min(ends[2 * i], p[axis][k]);
          ends[2 * i + 1] = Math.max(ends[2 * i + 1], p[axis][k]);
        });
      }
    }
    const [rear, front, low, high] = [ends[0], ends[1], ends[2],
      Math.max(ends[3], this.actor.figure.meshes?.top() ?? ends[3])];
    if (this.data.ground.is_there) return { low, high, height: Math.max(high - low, 0.6) };
    return { low, high, height: Math.max(high - low, front - rear, 0.3), middle: (rear + front) / 2 };
  }

  frame(view = "free") {
    const { low, high, height, middle: center } = this.size();
    const mass = this.actor.centerAt(this.time, this.period);
    const rises = Math.abs(this.data.rise ?? 0) > 0 || this.data.ground.slope !== 0;
    const hangs = center !== undefined;
    const middle = rises ? mass.y - 0.08 : (hangs ? low + high : Math.max(low, -0.2) + high) / 2;
    const target = new Vector3(hangs ? center : mass.x, middle, mass.z);
    const aspect = this.camera.aspect || 1.4;
    const tall = Math.max(rises ? Math.min(height, 2.1) : height, hangs ? 0.4 : 1.0);
    // the buttons lie over the upper edge: the body stands below them
    const above = view === "top" ? 0 : Math.min(46 / (this.renderer.domElement.clientHeight || 600), 0.2);
    const slope = Math.tan((this.camera.fov * Math.PI) / 360);
    const far = (0.58 * tall + 0.12) / (slope * (1 - above)) * Math.max(1, (this.second ? 0.7 : 0.95) / aspect);
    target.y += above * slope * far;
    const ways = { free: [0.52, 0.2, 1], side: [0, 0.04, 1], front: [1, 0.06, 0.0001],
      top: [0.0001, 1, 0.0002], back: [-1, 0.1, 0.12] };
    const way = new Vector3(...ways[view]).normalize();
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(way, far);
    this.focus.copy(mass);
    this.controls.update();
    this.draw();
  }

  zoom(factor) {
    const { target } = this.controls;
    this.camera.position.sub(target).multiplyScalar(factor).add(target);
    this.controls.update();
    this.draw();
  }

  orbit(right, upward) {
    const { target } = this.controls;
    const offset = this.camera.position.clone().sub(target);
    offset.applyAxisAngle(new Vector3(0, 1, 0), right);
    const flat = Math.hypot(offset.x, offset.z), radius = offset.length();
    const angle = Math.min(Math.max(Math.atan2(offset.y, flat) + upward, -0.12), 1.5);
    const level = radius * Math.cos(angle) / Math.max(flat, 1e-6);
    offset.set(offset.x * level, radius * Math.sin(angle), offset.z * level);
    this.camera.position.copy(target).add(offset);
    this.controls.update();
    this.draw();
  }

  // so many pixels for a film, whatever the window; without them as the window has it
  fix(width, height) {
    const { renderer } = this;
    this.fixed = width !== undefined;
    if (!this.fixed) return this.resize();
    renderer.setPixelRatio(1);
    renderer.setSize(width, height, false);
    this.setAspect();
    return this.drawNow();
  }

  resize() {
    if (this.fixed) return;
    const box = this.renderer.domElement.parentElement.getBoundingClientRect();
    if (box.width < 2 || box.height < 2) return;
    const before = this.camera.aspect;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.setSize(box.width, box.height, false);
    this.setAspect();
    if (this.data && Math.abs(before - this.camera.aspect) > 0.2 && !this.turned) this.frame(this.view);
    this.drawNow();
  }

  setAspect() {
    const { width, height } = this.renderer.getSize(new Vector2());
    this.camera.aspect = (this.second ? Math.floor(width / 2) : width) / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
  }

  // a picture of so many pixels, as data of an <img>
  still(width, height) {
    this.fix(width, height);
    const picture = this.renderer.domElement.toDataURL("image/jpeg", 0.92);
    this.fix();
    return picture;
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => this.drawNow());
  }

  drawNow() {
    this.waiting = false;
    if (!this.data) return;
    const { renderer, second } = this, { width, height } = renderer.getSize(new Vector2());
    const half = Math.floor(width / 2);
    renderer.setScissorTest(Boolean(second));
    this.actor.root.visible = true;
    if (second) {
      second.root.visible = false;
      this.drawIn(0, half, height);
      second.root.visible = true;
      this.actor.root.visible = false;
      this.drawIn(width - half, half, height);
    } else this.drawIn(0, width, height);
  }

  drawIn(left, width, height) {
    this.renderer.setViewport(left, 0, width, height);
    this.renderer.setScissor(left, 0, width, height);
    this.renderer.render(this.scene, this.camera);
  }
}
