// Curves over time or percent of the cycle, in pairs left and right, that follow the clock.
import uPlot from "uplot";
import { css, el, short } from "./dom.js";
import { sampleAt, spoken, valueAt } from "./decode.js";

const degrees = 180 / Math.PI;
const sides = ["left", "right", "middle"];
const first = ["hip_flexion", "knee_angle", "ankle_angle", "pelvis_tilt", "lumbar_extension",
  "hip_adduction", "shoulder_flexion", "elbow_flexion"];
// so many decimals, no zero with a sign
const fixed = (x, decimals) => (x.toFixed(decimals).replace(/^-(?=[0.]*$)/, "")).replace("-", "−");
const rank = (name) => {
  const i = first.findIndex((word) => name.startsWith(word));
  return i < 0 ? first.length : i;
};

const largestFirst = (map, size) => [...map].sort((a, b) => size(b[1]) - size(a[1]));

// mean activation of each group, by strength, from the strongest group on; what joints bear
function muscleTabs({ muscles, joints }, weight) {
  const mean = (list) => {
    const out = new Float64Array(list[0].activation.length);
    const all = list.reduce((sum, m) => sum + m.strength, 0);
    for (const m of list) m.activation.forEach((a, k) => { out[k] += (m.strength / all) * a; });
    return out;
  };
  const bySide = (list, values) => sides.map((side) => [side, list.filter((x) => x.side === side)])
    .filter(([, own]) => own.length).map(([side, own]) => ({ side, values: values(own) }));
  const gathered = (list, key) => list.reduce((map, x) =>
    map.set(key(x), [...(map.get(key(x)) ?? []), x]), new Map());
  const groups = largestFirst(gathered(muscles, (m) => m.group || m.name),
    (list) => list.reduce((sum, m) => sum + m.strength, 0));
  const tabs = [{ name: "Muscles", charts: groups.map(([name, list]) => ({ title: spoken(name, false),
    unit: "activation", limits: [], curves: bySide(list, mean) })) }];
  const sizeOf = ([{ force: [f, l, u] }]) =>
    Float64Array.from(f, (x, k) => Math.hypot(x, l[k], u[k]) / weight);
  if (joints.length) tabs.push({ name: "Joints", charts: [...gathered(joints, (j) => spoken(j.name, false))]
    .map(([name, list]) => ({ title: `contact force, ${name}`, unit: "body weights", limits: [],
      curves: bySide(list, sizeOf) })) });
  return tabs;
}

// what can be shown of a scene: tabs of charts, each with one curve or a pair
export function tabsOf(scene) {
  const mass = scene.mass || 1, weight = scene.weight || 1;
  const groups = [];
  scene.coordinates.forEach((c, i) => {
    if (c.mirror !== undefined && c.mirror < i && c.mirror !== i) return;
    const pair = c.mirror === i || c.mirror === undefined ? [c] : [c, scene.coordinates[c.mirror]];
    groups.push(pair);
  });
  groups.sort((a, b) => rank(a[0].name) - rank(b[0].name));
  const scaled = (values, factor) => values && Float64Array.from(values, (x) => x * factor);
  const people = (p, factor) => p && { mean: scaled(p.mean, factor), band: scaled(p.band, Math.abs(factor)),
    source: p.source };
  const chart = (pair, unit, key, factor, limit) => ({
    title: spoken(pair[0].name, pair.length === 1), unit,
    curves: pair.map((c) => ({ side: c.side, values: scaled(c[key], factor),
      people: people(c[`people_${key}`], factor) })),
    limits: limit ? pair[0][limit]?.map((x) => x === null ? null : x * factor) ?? [] : [],
  });
  const angle = (pair) => chart(pair, pair[0].unit === "rad" ? "°" : "m", "q",
    pair[0].unit === "rad" ? degrees : 1, "range");
  const driven = groups.filter((pair) => pair[0].actuated && pair[0].tau);
  const tabs = [{ name: "Angles", charts: groups.map(angle) }];
  if (driven.length) {
    const unit = (pair, turn, push) => pair[0].unit === "rad" ? turn : push;
    tabs.push({ name: "Torques", charts: driven.map((pair) =>
      chart(pair, unit(pair, "N m/kg", "N/kg"), "tau", 1 / mass, "torque")) });
    tabs.push({ name: "Power", charts: driven.map((pair) => chart(pair, "W/kg", "power", 1 / mass)) });
  }
  if (scene.forces.length) {
    const names = ["forward", "to the left", "upward"];
    tabs.push({ name: "Forces", charts: [2, 0, 1].map((axis) => ({
      title: `ground force, ${names[axis]}`, unit: "body weights", limits: [],
      curves: scene.forces.map((f) => ({ side: f.side, name: f.name,
        values: scaled(f.force[axis], 1 / weight),
        people: people(axis === 2 ? f.people_up : axis === 0 ? f.people_forward : null, 1 / weight) })),
    })) });
  }
  if (scene.muscles) tabs.push(...muscleTabs(scene.muscles, weight));
  const devices = scene.worn.filter((w) => w.kind === "device");
  if (devices.length) tabs.push({ name: "Devices", charts: devices.map((d) => ({
    title: spoken(d.name), unit: d.unit, limits: [],
    curves: [{ side: "middle", values: Float64Array.from(d.effort) }] })) });
  return tabs;
}

// first strike of each side, s: where its cycle begins
export function strikesOf(summary, scene) {
  const out = { left: 0, right: 0, middle: 0 };
  if (!scene.repeats) return out;
  for (const side of ["left", "right"]) {
    const foot = scene.feet.find((f) => f.side === side)?.name ?? side;
    const strike = (summary.strikes ?? []).filter((s) => s.foot === foot)[0];
    if (strike) out[side] = strike.time;
  }
  out.middle = out.left;
  return out;
}

export class Charts {
  constructor(parent, summary, scene, ghost, onTime) {
    Object.assign(this, { parent, scene, onTime, ghost });
    this.strikes = strikesOf(summary, scene);
    this.tabs = tabsOf(scene);
    this.ghostTabs = ghost ? tabsOf(ghost.scene) : [];
    this.ghostStrikes = ghost ? strikesOf(ghost.summary, ghost.scene) : null;
    this.percent = false;
    this.people = true;
    this.all = false;
    this.tab = 0;
    this.plots = [];
    this.build();
  }

  build() {
    this.bar = el("div", { class: "tabs", role: "tablist", "aria-label": "Curves" });
    this.grid = el("div", { class: "charts", role: "tabpanel" });
    this.note = el("p", { class: "note" });
    this.tabs.forEach((tab, i) => this.bar.append(el("button", { role: "tab", type: "button",
      "aria-selected": String(i === this.tab), onclick: () => this.choose(i) }, tab.name)));
    this.bar.addEventListener("keydown", (e) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
      if (!step) return;
      e.stopPropagation();
      e.preventDefault();
      this.choose((this.tab + step + this.tabs.length) % this.tabs.length);
      this.bar.children[this.tab].focus();
    });
    const axis = el("select", { "aria-label": "Axis of the curves", onchange: () => {
      this.percent = axis.value === "percent";
      this.show();
    } }, el("option", { value: "seconds" }, "seconds"),
    el("option", { value: "percent" }, this.scene.repeats ? "% of the cycle" : "% of the motion"));
    this.axis = axis;
    const tools = el("div", { class: "tools" }, axis);
    if (this.scene.people.length) {
      const box = el("input", { type: "checkbox", checked: true, onchange: () => {
        this.people = box.checked;
        this.show();
      } });
      tools.append(el("label", { class: "check" }, box, "people"));
    }
    this.more = el("button", { type: "button", class: "more", onclick: () => {
      this.all = !this.all;
      this.show();
    } });
    this.parent.append(el("div", { class: "bar" }, this.bar, tools), this.grid, this.more, this.note);
    this.watch = new ResizeObserver(() => this.resize());
    this.watch.observe(this.grid);
    this.show();
  }

  choose(i) {
    this.tab = i;
    [...this.bar.children].forEach((b, k) => {
      b.setAttribute("aria-selected", String(k === i));
      b.tabIndex = k === i ? 0 : -1;
    });
    this.show();
  }

  // values over the x axis that is chosen
  along(values, scene, strike) {
    if (!this.percent) return values;
    const out = new Float64Array(101);
    for (let p = 0; p <= 100; p++) {
      const t = (p / 100) * scene.duration + strike;
      const inside = scene.repeats && t > scene.duration + 1e-9 ? t - scene.duration : t;
      out[p] = valueAt(values, sampleAt(scene, inside));
    }
    return out;
  }

  // the other result's curve of the same name and side, stretched to this one's duration
  ghostCurve(chart, curve) {
    if (!this.ghost) return null;
    const tab = this.ghostTabs.find((t) => t.name === this.tabs[this.tab].name);
    const same = tab?.charts.find((c) => c.title === chart.title);
    const other = same?.curves.find((c) => c.side === curve.side && c.name === curve.name);
    if (!other?.values) return null;
    if (this.percent) return this.along(other.values, this.ghost.scene, this.ghostStrikes[curve.side]);
    const { scene } = this, out = new Float64Array(scene.samples);
    for (let k = 0; k < scene.samples; k++)
      out[k] = valueAt(other.values, sampleAt(this.ghost.scene, this.ghost.time(scene.at[k])));
    return out;
  }

  show() {
    for (const p of this.plots) p.plot.destroy();
    this.plots = [];
    this.grid.replaceChildren();
    const { charts } = this.tabs[this.tab];
    const few = 6, shown = this.all ? charts : charts.slice(0, few);
    this.more.hidden = charts.length <= few;
    this.more.textContent = this.all ? "Show fewer" : `Show all ${charts.length}`;
    const sources = new Set();
    for (const chart of shown) this.addChart(chart, sources);
    this.note.replaceChildren(...[...sources].map((s) =>
      el("span", {}, `People: ${this.scene.people[s]}. `)));
    if (sources.size) this.note.append("Dashed: their mean; shaded: two standard deviations to either side.");
    this.setTime(this.time ?? 0);
    queueMicrotask(() => this.setTime(this.time)); // plots have their scales from then on
  }

  addChart(chart, sources) {
    const box = el("figure", { class: "chart" });
    const values = el("span", { class: "values" });
    box.append(el("figcaption", {}, el("b", {}, chart.title), el("span", { class: "unit" },
      ` ${chart.unit}`), values));
    const holder = el("div", { class: "plot", role: "img", "aria-label":
      `${chart.title}, ${chart.unit}, over ${this.percent ? "percent of the cycle" : "time"}` });
    box.append(holder);
    this.grid.append(box);
    const x = this.percent ? Array.from({ length: 101 }, (_, p) => p) : Array.from(this.scene.at);
    const data = [x], series = [{}], bands = [];
    const add = (list, options) => {
      data.push(Array.from(list));
      series.push({ points: { show: false }, ...options });
      return data.length - 1;
    };
    for (const curve of chart.curves) {
      const p = this.people && curve.people, strike = this.strikes[curve.side];
      if (!p) continue;
      sources.add(p.source);
      const mean = this.along(p.mean, this.scene, strike);
      if (p.band) {
        const band = this.along(p.band, this.scene, strike);
        const high = add(mean.map((m, k) => m + band[k]), { stroke: "transparent" });
        const low = add(mean.map((m, k) => m - band[k]), { stroke: "transparent" });
        bands.push({ series: [high, low], fill: css(`--${curve.side}-band`) });
      }
      add(mean, { stroke: css(`--${curve.side}`), width: 1.2, dash: [5, 4], alpha: 0.7 });
    }
    for (const curve of chart.curves) {
      const other = this.ghostCurve(chart, curve);
      if (other) add(other, { stroke: css("--ghost"), width: 1.6,
        dash: curve.side === "right" ? [2, 2] : undefined });
    }
    for (const curve of chart.curves)
      add(this.along(curve.values, this.scene, this.strikes[curve.side]),
        { stroke: css(`--${curve.side}`), width: 2.1 });
    const plot = new uPlot(this.options(chart, series, bands), data, holder);
    const marks = sides.filter((s) => chart.curves.some((c) => c.side === s)).map((side) => {
      const line = el("div", { class: `now ${this.percent ? side : ""}` });
      plot.over.append(line);
      return { side, line };
    });
    for (const canvas of holder.querySelectorAll("canvas")) canvas.ariaHidden = "true";
    this.listen(plot);
    this.plots.push({ plot, chart, values, marks, holder });
  }

  options(chart, series, bands) {
    const text = css("--soft"), grid = css("--line"), font = "11px system-ui, sans-serif";
    const axis = { stroke: text, grid: { stroke: grid, width: 1 }, ticks: { show: false }, font };
    return {
      width: 280, height: 132, padding: [6, 8, 0, 0], legend: { show: false },
      cursor: { show: false }, series, bands,
      scales: { x: { time: false, range: (u, low, high) => [low, high] },
        y: { range: (u, low, high) => this.range(chart, low, high) } },
      axes: [{ ...axis, size: 24, space: 44, values: (u, ticks) =>
        ticks.map((t) => `${short(t)}${this.percent ? " %" : " s"}`) },
      { ...axis, size: 42, space: 26, values: (u, ticks) => ticks.map((t) => short(t)) }],
      hooks: { drawAxes: [(u) => this.drawLimits(u, chart)] },
    };
  }

  // limits belong to the picture where the curve comes near them
  range(chart, low, high) {
    if (!Number.isFinite(low)) return [0, 1];
    const span = Math.max(high - low, chart.unit === "°" ? 2 : 0.02);
    let [from, to] = [low - 0.06 * span, high + 0.06 * span];
    for (const limit of chart.limits) {
      if (limit === null || limit === undefined) continue;
      if (limit < low + 1e-9 && limit > low - 0.25 * span) from = Math.min(from, limit - 0.05 * span);
      if (limit > high - 1e-9 && limit < high + 0.25 * span) to = Math.max(to, limit + 0.05 * span);
    }
    return [from, to];
  }

  drawLimits(u, chart) {
    const { ctx, bbox } = u;
    ctx.save();
    const line = (value, color, dash) => {
      const y = Math.round(u.valToPos(value, "y", true)) + 0.5;
      if (y < bbox.top || y > bbox.top + bbox.height) return;
      ctx.strokeStyle = color;
      ctx.setLineDash(dash);
      ctx.lineWidth = devicePixelRatio || 1;
      ctx.beginPath();
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.stroke();
    };
    line(0, css("--zero"), []);
    for (const limit of chart.limits) {
      if (limit === null || limit === undefined) continue;
      line(limit, css("--limit"), [7, 4]);
    }
    ctx.restore();
  }

  listen(plot) {
    const go = (e) => {
      const x = plot.posToVal(e.clientX - plot.over.getBoundingClientRect().left, "x");
      const { duration, repeats } = this.scene;
      let t = this.percent ? (x / 100) * duration + this.strikes.left : x;
      if (this.percent && repeats && t > duration) t -= duration;
      this.onTime(Math.min(Math.max(t, 0), duration));
    };
    plot.over.addEventListener("pointerdown", (e) => {
      plot.over.setPointerCapture(e.pointerId);
      go(e);
    });
    plot.over.addEventListener("pointermove", (e) => e.buttons && go(e));
  }

  setTime(time) {
    this.time = time;
    const where = sampleAt(this.scene, time);
    for (const { plot, chart, values, marks } of this.plots) {
      for (const { side, line } of marks) {
        let x = time;
        if (this.percent) {
          x = ((time - this.strikes[side]) / this.scene.duration) * 100;
          if (x < 0) x += 100;
        }
        line.style.transform = `translateX(${plot.valToPos(x, "x").toFixed(1)}px)`;
      }
      values.replaceChildren(...chart.curves.map((c) => el("span", { class: c.side },
        fixed(valueAt(c.values, where), chart.unit === "°" ? 0 : 2))));
    }
  }

  resize() {
    for (const { plot, holder } of this.plots) {
      const width = Math.floor(holder.clientWidth);
      if (width > 40 && Math.abs(width - plot.width) > 1) plot.setSize({ width, height: 132 });
    }
    this.setTime(this.time ?? 0);
  }

  destroy() {
    this.watch.disconnect();
    for (const p of this.plots) p.plot.destroy();
    this.parent.replaceChildren();
  }
}
