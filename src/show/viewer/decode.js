// What scene.json holds, unpacked: series of whole numbers in second differences (docs/results.md).

// [first, first difference, then differences of differences] in units of `unit`; of a study's cases
// they are what they say already (cases.js)
export function series(list, unit) {
  if (list instanceof Float32Array) return list;
  const out = new Float32Array(list.length);
  let value = 0, slope = 0;
  for (let k = 0; k < list.length; k++) {
    if (k === 0) value = list[0];
    else {
      slope += list[k];
      value += slope;
    }
    out[k] = value * unit;
  }
  return out;
}

// whole numbers in a text, each the difference from the one `step` before it (src/import/meshes.h)
function sums(text, step, unit) {
  const out = Float64Array.from(text.split(" "), Number);
  for (let i = step; i < out.length; i++) out[i] += out[i - step];
  return out.map((x) => x * unit);
}

// three series of a place: forward, left, up, m
const places = (three, unit) => three.map((one) => series(one, unit));

// A scene with its series as arrays; `at` are the times of the samples, s.
export function unpack(raw) {
  const u = raw.units ?? {};
  const scene = { ...raw, series: undefined };
  scene.at = Float64Array.from({ length: raw.samples },
    (_, k) => (raw.duration * k) / (raw.samples - 1));
  scene.points = raw.points.map((p) => places(p, u.length));
  scene.center_of_mass = places(raw.center_of_mass, u.length);
  const curve = (people, unit) => people && {
    source: people.source,
    mean: series(people.mean, unit),
    band: people.band && series(people.band, unit),
  };
  scene.coordinates = (raw.coordinates ?? []).map((c) => {
    const unit = c.unit === "rad" ? u.angle : u.length;
    return {
      ...c,
      q: series(c.q, unit),
      tau: c.tau && series(c.tau, u.torque),
      power: c.power && series(c.power, u.power),
      people_q: curve(c.people_q, unit),
      people_tau: curve(c.people_tau, u.torque),
    };
  });
  scene.forces = (raw.forces ?? []).map((f) => ({
    ...f,
    force: places(f.force, u.force),
    pressure: places(f.pressure, u.length),
    people_up: curve(f.people_up, u.force),
    people_forward: curve(f.people_forward, u.force),
  }));
  scene.worn = (raw.worn ?? []).map((w) => ({
    ...w,
    effort: w.effort && series(w.effort, w.unit === "N" ? u.force : u.torque),
  }));
  scene.muscles = raw.muscles && {
    ...raw.muscles,
    muscles: raw.muscles.muscles.map((m) => ({ ...m, activation: series(m.activation, u.activation) })),
    frames: raw.muscles.frames.map((frame) => frame.map((p) => places(p, u.length))),
    joints: raw.muscles.joints.map((j) => ({ ...j, at: places(j.at, u.length),
      force: places(j.force, u.force) })),
  };
  scene.meshes = (raw.meshes ?? []).map((m) => ({
    ...m,
    frame: m.frame.map((p) => places(p, u.length)),
    vertices: sums(m.vertices, 3, 1e-4),
    triangles: sums(m.triangles, 1, 1),
  }));
  scene.ground = raw.ground ?? { is_there: 1, slope: 0, surfaces: [] };
  scene.obstacles = raw.obstacles ?? [];
  scene.places = raw.places ?? [];
  scene.contacts = raw.contacts ?? [];
  scene.feet = raw.feet ?? [];
  scene.people = raw.people ?? [];
  return scene;
}

// Between which samples a time falls: index of the first, and the share of the way to the next.
export function sampleAt(scene, time) {
  const last = scene.samples - 1;
  const x = Math.min(Math.max((time / scene.duration) * last, 0), last);
  const k = Math.min(Math.floor(x), last - 1);
  return [k, x - k];
}

export const valueAt = (values, [k, share]) => values[k] + share * (values[k + 1] - values[k]);

// A name as it is said: knee_angle_r becomes "knee angle", ball_arc_l "ball arc, left".
export function spoken(name, withSide = true) {
  name = String(name ?? "");
  const side = /_l$/.test(name) ? ", left" : /_r$/.test(name) ? ", right" : "";
  return name.replace(/_[lr]$/, "").replace(/_/g, " ") + (withSide ? side : "");
}
