// How a solve came to its end: objective and violation over its iterations, read off by pointer or keys.
import { el, short, svg } from "./dom.js";

const pad = { left: 50, right: 12, top: 34, between: 44, bottom: 34 };
const high = 92; // of each of the two charts
const isNumber = (x) => typeof x === "number" && Number.isFinite(x);

// the lists of summary.json as points, each with its place across: its iteration, or its evaluations
// where many are of one iteration
export function pointsOf(convergence) {
  const { iteration, objective, violation } = convergence;
  const count = iteration.length, last = iteration[count - 1];
  const same = iteration.filter((n, i) => n === iteration[i - 1]).length;
  const across = same > 1 ? convergence.evaluations : iteration;
  return { unit: same > 1 ? "evaluations" : "iterations", last, points: iteration.map((n, i) => ({
    n, x: across[i], objective: objective[i], violation: violation[i],
    intervals: convergence.intervals[i], gradient: convergence.gradient[i],
    seconds: convergence.seconds[i], isEnd: i === count - 1 })) };
}

// runs of points of one grid: {from, to, intervals}
function gridsOf(points) {
  const grids = [];
  points.forEach((p, i) => {
    const now = grids[grids.length - 1];
    if (now && now.intervals === p.intervals) now.to = i;
    else grids.push({ from: i, to: i, intervals: p.intervals });
  });
  return grids;
}

const listed = (words) => words.length < 2 ? words.join("")
  : `${words.slice(0, -1).join(", ")} and ${words[words.length - 1]}`;

// what the chart shows, in words
export function wayWords(convergence) {
  const { points, last } = pointsOf(convergence), grids = gridsOf(points);
  const end = points[points.length - 1], first = points[0], tolerance = convergence.tolerance;
  const sizes = [...new Set(grids.map((g) => g.intervals))];
  const words = [`${last} iteration${last === 1 ? "" : "s"} ${sizes.length > 1
    ? `on grids of ${listed(sizes.map(String))} intervals` : `on ${sizes[0]} intervals`}.`];
  if (isNumber(first.objective) && isNumber(end.objective))
    words.push(`The objective went from ${short(first.objective)} to ${short(end.objective, 4)}.`);
  if (isNumber(end.violation)) words.push(end.violation <= tolerance
    ? `The rule that is broken most is off by ${short(end.violation, 2)} of its size at the end: `
      + `up to ${near(tolerance)} counts as kept.`
    : `The rule that is broken most is still off by ${short(end.violation, 2)} of its size at the end; `
      + `${near(tolerance)} would count as kept.`);
  const least = Math.min(...points.map((p) => isNumber(p.objective) ? p.objective : Infinity));
  if (end.objective > 1.02 * least && end.violation <= tolerance)
    words.push("On the way it was lower, where rules were still broken: that is cheaper, and no solution.");
  return words.join(" ");
}

// a scale from values to 0..1 with its ticks; by powers of ten where `log`
function scaleOf(values, log) {
  const finite = values.filter((v) => isNumber(v) && (!log || v > 0));
  let low = Math.min(...finite), top = Math.max(...finite);
  if (!finite.length) [low, top] = log ? [1e-8, 1] : [0, 1];
  const ticks = [];
  if (log) {
    const from = Math.floor(Math.log10(low)), to = Math.max(Math.ceil(Math.log10(top)), from + 1);
    const step = Math.max(1, Math.ceil((to - from) / 4));
    for (let e = to; e >= from; e -= step) ticks.unshift(10 ** e);
    return { at: (v) => (Math.log10(Math.max(v, 10 ** from)) - from) / (to - from), ticks };
  }
  const room = top > low ? 0.08 * (top - low) : Math.abs(top) * 0.1 || 1;
  [low, top] = [low - room, top + room];
  const rough = (top - low) / 3, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough);
  for (let i = Math.ceil(low / step); i * step <= top; i++) ticks.push(i * step);
  return { at: (v) => (v - low) / (top - low), ticks };
}

// 0.001 as 10⁻³
function powerText(value) {
  const exponent = Math.round(Math.log10(value));
  if (exponent === 0) return "1";
  return `10${[...String(exponent)].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("")}`;
}

// a power of ten as one, all else in two digits
const near = (value) => Math.abs(Math.log10(value) % 1) < 1e-9 ? powerText(value) : short(value, 2);

export class Convergence {
  constructor(convergence) {
    Object.assign(this, pointsOf(convergence));
    this.tolerance = convergence.tolerance;
    this.grids = gridsOf(this.points);
    this.chosen = this.points.length - 1;
    this.box = el("div", { class: "way", tabindex: 0, role: "slider", "aria-label":
      "Iteration of the solve", "aria-valuemin": 1, "aria-valuemax": this.points.length,
    onkeydown: (e) => this.key(e), onpointerdown: (e) => this.point(e),
    onpointermove: (e) => (e.pointerType === "mouse" || e.buttons) && this.point(e) });
    this.read = el("p", { class: "way-read" });
    this.node = el("figure", { class: "way-figure" }, this.box, this.read, this.table());
    new ResizeObserver(() => this.draw()).observe(this.box);
    this.choose(this.chosen);
  }

  // everything in numbers, for who cannot see the chart or wants to have them
  table() {
    const number = (v, digits = 3) => isNumber(v) ? short(v, digits) : "–";
    const rows = () => this.points.map((p) => el("tr", {}, el("th", { scope: "row" },
      p.isEnd ? "end" : String(p.n)), [String(p.intervals), number(p.objective, 5), number(p.violation, 2),
      number(p.gradient, 2), number(p.seconds)].map((t) => el("td", {}, t))));
    const body = el("tbody");
    return el("details", { ontoggle: () => body.children.length || body.append(...rows()) },
      el("summary", {}, "As a table"), el("div", { class: "table-box", tabindex: 0, role: "region",
        "aria-label": "Table of iterations" }, el("table", { class: "cases" }, el("thead", {}, el("tr", {},
        ["iteration", "intervals", "objective", "worst violation", "gradient left", "seconds"]
          .map((t) => el("th", { scope: "col" }, t)))), body)));
  }

  words(p) {
    return [p.isEnd ? "The end" : `Iteration ${p.n}`, `${p.intervals} intervals`,
      `objective ${isNumber(p.objective) ? short(p.objective, 4) : "not finite"}`,
      `worst violation ${isNumber(p.violation) ? short(p.violation, 2) : "not finite"}`,
      isNumber(p.gradient) ? `gradient left ${short(p.gradient, 2)}` : "",
      `${short(p.seconds, 2)} s`].filter(Boolean).join(" · ");
  }

  choose(i) {
    this.chosen = Math.min(Math.max(i, 0), this.points.length - 1);
    const p = this.points[this.chosen];
    this.read.textContent = this.words(p);
    this.box.setAttribute("aria-valuenow", String(this.chosen + 1));
    this.box.setAttribute("aria-valuetext", this.words(p));
    this.mark();
  }

  key(e) {
    const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10,
      Home: -this.points.length, End: this.points.length }[e.key];
    if (!step) return;
    e.preventDefault();
    e.stopPropagation();
    this.choose(this.chosen + step);
  }

  point(e) {
    if (!this.X) return;
    const x = e.clientX - this.box.getBoundingClientRect().left;
    const away = this.points.map((p) => Math.abs(this.X(p.x) - x));
    this.choose(away.lastIndexOf(Math.min(...away)));
  }

  draw() {
    const width = Math.floor(this.box.clientWidth);
    if (width < 60 || width === this.width) return;
    this.width = width;
    const { points } = this, first = points[0].x, last = points[points.length - 1].x;
    this.X = (x) => pad.left + ((x - first) / (last - first || 1)) * (width - pad.left - pad.right);
    const height = pad.top + 2 * high + pad.between + pad.bottom;
    const objectives = points.map((p) => p.objective).filter(isNumber);
    const wide = objectives.every((v) => v > 0) && Math.max(...objectives) > 30 * Math.min(...objectives);
    const picture = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, "aria-hidden": "true" });
    this.drawGrids(picture, width, height);
    this.charts = [
      this.chart(picture, "objective", "Objective", pad.top, scaleOf(objectives, wide), wide),
      this.chart(picture, "violation", "Worst violation, of its rule's size", pad.top + high + pad.between,
        scaleOf([...points.map((p) => p.violation), this.tolerance], true), true)];
    this.ticks(picture, width, height);
    this.line = svg("line", { class: "way-now", y1: pad.top, y2: height - pad.bottom });
    this.dots = this.charts.map(() => svg("circle", { class: "way-dot", r: 4.5 }));
    picture.append(this.line, ...this.dots);
    this.box.replaceChildren(picture);
    this.mark();
  }

  // a stripe for each grid, with its name where that has room
  drawGrids(picture, width, height) {
    const { grids, points } = this;
    grids.forEach((grid, i) => {
      const edge = (k) => (this.X(points[k - 1].x) + this.X(points[k].x)) / 2;
      const from = i ? edge(grid.from) : pad.left - 6;
      const to = i + 1 < grids.length ? edge(grids[i + 1].from) : width - pad.right + 6;
      for (const top of [pad.top, pad.top + high + pad.between])
        picture.append(svg("rect", { class: `way-grid ${i % 2 ? "odd" : ""}`, x: from, y: top,
          width: to - from, height: high }));
      if (i) picture.append(svg("line", { class: "way-switch", x1: from, x2: from, y1: pad.top - 4,
        y2: height - pad.bottom }));
      const name = [`${grid.intervals} intervals`, String(grid.intervals)]
        .find((t) => t.length * 5.6 + 6 < to - from);
      if (name && grids.length > 1) picture.append(svg("text", { x: (from + to) / 2, y: 11,
        "text-anchor": "middle" }, name));
    });
  }

  chart(picture, key, title, top, scale, log) {
    const Y = (v) => top + high - scale.at(v) * high;
    picture.append(svg("text", { class: "name", x: pad.left - 44, y: top - 9 }, title,
      log ? svg("tspan", { class: "unit-text" }, ", by powers of ten") : ""));
    for (const tick of scale.ticks) picture.append(svg("line", { class: "rule", x1: pad.left - 6,
      x2: this.width - pad.right + 6, y1: Y(tick), y2: Y(tick) }), svg("text", { x: pad.left - 10,
      y: Y(tick) + 4, "text-anchor": "end" }, log ? powerText(tick) : short(tick)));
    if (key === "violation" && this.tolerance > 0) picture.append(svg("line", { class: "way-limit",
      x1: pad.left - 6, x2: this.width - pad.right + 6, y1: Y(this.tolerance), y2: Y(this.tolerance) }),
    svg("text", { class: "way-limit-text", x: pad.left, y: Y(this.tolerance) - 4 }, "kept below this"));
    let path = "", drawn = false; // a gap where a number is not finite
    for (const p of this.points) {
      if (isNumber(p[key])) path += `${drawn ? "L" : "M"}${this.X(p.x).toFixed(1)} ${Y(p[key]).toFixed(1)}`;
      drawn = isNumber(p[key]);
    }
    picture.append(svg("path", { class: "way-line", d: path }));
    return { key, Y };
  }

  ticks(picture, width, height) {
    const first = this.points[0].x, last = this.points[this.points.length - 1].x, y = height - pad.bottom + 15;
    const rough = (last - first) / Math.max(2, Math.floor(width / 90)), power = 10 ** Math.floor(Math.log10(rough || 1));
    const step = Math.max(1, [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough) ?? 1);
    for (let n = Math.ceil(first / step) * step; n <= last; n += step)
      picture.append(svg("text", { x: this.X(n), y, "text-anchor": "middle" }, String(n)));
    picture.append(svg("text", { class: "name", x: (pad.left + width) / 2, y: y + 15,
      "text-anchor": "middle" }, this.unit));
  }

  mark() {
    if (!this.charts) return;
    const p = this.points[this.chosen], x = this.X(p.x);
    this.line.setAttribute("x1", x);
    this.line.setAttribute("x2", x);
    this.charts.forEach(({ key, Y }, i) => {
      this.dots[i].setAttribute("cx", x);
      this.dots[i].setAttribute("cy", isNumber(p[key]) ? Y(p[key]) : -20);
    });
  }
}
