// One motion in space: a body, what stands around it, its forces and muscles; posed at a time.
import { Group, Mesh, MeshBasicMaterial, SphereGeometry, Vector3 } from "three";
import { sampleAt, valueAt } from "./decode.js";
import { Figure, toView } from "./figure.js";
import { Muscles } from "./muscles.js";
import { Arrow, World } from "./world.js";

const forceLength = 0.9; // m for the body weight
const ahead = new Vector3(0, 0, 1);

export class Actor {
  constructor(data, colors) {
    this.data = data;
    this.root = new Group();
    this.world = new World(data, colors);
    this.figure = new Figure(data, colors, false);
    this.figures = new Group();
    this.figures.add(this.figure.group);
    this.arrows = data.forces.map((f) => ({ force: f, arrow: new Arrow(colors.force) }));
    for (const { arrow } of this.arrows) this.figures.add(arrow.group);
    this.muscles = data.muscles && new Muscles(data, colors);
    if (this.muscles) this.figures.add(this.muscles.group);
    this.massBall = new Mesh(new SphereGeometry(0.045, 20, 14),
      new MeshBasicMaterial({ color: colors.mass, depthTest: false, transparent: true }));
    this.massBall.renderOrder = 5;
    this.figures.add(this.massBall);
    this.root.add(this.world.group, this.figures);
    this.root.rotation.z = data.ground.slope;
    this.copies();
  }

  // prints and paths of the periods before and behind
  copies() {
    const { data, world } = this;
    if (!data.repeats || !data.travel) return;
    for (const n of [-1, 1, 2]) {
      const copy = world.repeated.clone();
      copy.position.set(n * data.travel, n * data.rise, 0);
      world.repeated.add(copy);
    }
  }

  show(shows) {
    this.world.repeated.traverse((o) => {
      if (o.isInstancedMesh) o.visible = shows.paths;
      else if (o.isMesh) o.visible = shows.prints;
    });
    this.figure.showBones(shows.bones, shows.bones || Boolean(this.muscles && shows.muscles),
      shows.meshes);
    this.massBall.visible = shows.mass;
  }

  // where its centre of mass is then, on ground that may slope; a period of a motion that repeats is
  // further on
  centerAt(time, period = 0) {
    const { data } = this, where = sampleAt(data, time);
    const mass = toView(...data.center_of_mass.map((x) => valueAt(x, where)));
    mass.x += period * (data.travel ?? 0);
    mass.y += period * (data.rise ?? 0);
    return mass.applyAxisAngle(ahead, data.ground.slope);
  }

  moveTo(time, period, shows, camera) {
    const { data } = this, where = sampleAt(data, time);
    const shift = period * (data.travel ?? 0), rise = period * (data.rise ?? 0);
    this.figure.pose(time);
    this.figures.position.set(shift, rise, 0);
    this.world.repeated.position.set(shift, rise, 0);
    toView(...data.center_of_mass.map((x) => valueAt(x, where)), this.massBall.position);
    this.placeArrows(where, shows);
    this.muscles?.pose(where, shows);
    this.world.follow(this.massBall.position.x + shift);
    this.world.at(time, camera);
  }

  placeArrows(where, shows) {
    const force = new Vector3(), at = new Vector3();
    for (const { force: f, arrow } of this.arrows) {
      toView(...f.force.map((x) => valueAt(x, where)), force);
      toView(...f.pressure.map((x) => valueAt(x, where)), at);
      const length = (force.length() / this.data.weight) * forceLength;
      // a foot in the air has no center of pressure: none is drawn between two that are far apart
      const [k] = where;
      const jump = Math.hypot(...f.pressure.map((x) => x[k + 1] - x[k])) > 0.2;
      arrow.set(at, force, shows.forces && !jump ? length : 0);
    }
  }
}
