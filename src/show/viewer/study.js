// A batch: a table of its cases that sorts and filters, a plot of two columns and a shade, a case to
// watch. Lines join cases that differ along an axis alone, and the points of a front.
import { el, short, svg } from "./dom.js";
import { strongest } from "./effects.js";

const good = new Set(["optimal", "feasible"]);
export const tone = (state) => good.has(state) ? "good"
  : ["missing", "stale"].includes(state) ? "gone" : "bad";

const isNumber = (x) => typeof x === "number" && Number.isFinite(x);

// round numbers between two, four to ten of them
function ticks(low, high) {
  const rough = (high - low) / 5, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough) ?? rough;
  const list = [];
  for (let i = Math.ceil(low / step); i * step <= high && list.length < 12; i++) list.push(i * step);
  return list;
}

export class Study {
  constructor(parent, study, onChoose) {
    Object.assign(this, { study, onChoose });
    this.chosen = -1;
    this.sort = { column: 0, down: false };
    this.filter = "";
    this.columns = ["case", "state", ...study.columns];
    this.cell = (row, c) => c === 0 ? row.name : c === 1 ? row.state : row.values[c - 2];
    const numeric = this.columns.map((_, c) => c)
      .filter((c) => study.cases.some((row) => isNumber(this.cell(row, c))));
    this.numeric = numeric;
    // columns behind the case and its state
    const { front } = study, terms = front?.order.length ? front.terms.map((c) => c + 2) : [];
    const telling = terms.length ? null : this.telling();
    this.x = terms[0] ?? telling?.x ?? numeric[0];
    this.y = terms[1] ?? telling?.y ?? numeric.find((c) => this.columns[c] === "objective") ?? numeric[1] ?? numeric[0];
    this.shade = terms[2] ?? telling?.shade ?? -1;
    this.build(parent);
  }

  // the axis with most effect, and what it has that on; of axes that advance together the first stands for all.
  // By cases with a solution, where there are enough
  telling() {
    const { axes = 0, zipped = 0, cases } = this.study, solved = cases.filter((row) => good.has(row.state));
    const together = this.numeric.find((c) => c >= 2 && c < 2 + zipped);
    const own = this.numeric.filter((c) => c >= 2 && c < 2 + axes && (c >= 2 + zipped || c === together));
    return strongest(solved.length > 2 ? solved : cases, own, this.numeric.filter((c) => c >= 2 + axes), this.cell);
  }

  build(parent) {
    const choices = (none) => [...(none ? [el("option", { value: -1 }, "none")] : []),
      ...this.numeric.map((c) => el("option", { value: c }, this.columns[c]))];
    const pick = (label, key, none) => {
      const select = el("select", { "aria-label": label, onchange: () => {
        this[key] = Number(select.value);
        this.draw();
      } }, choices(none));
      select.value = this[key];
      return el("label", {}, `${label} `, select);
    };
    this.plot = el("div", { class: "scatter" });
    const search = el("input", { type: "search", placeholder: "Filter: a word, or speed > 1.2",
      "aria-label": "Filter the cases", oninput: () => {
        this.filter = search.value;
        this.draw();
      } });
    this.count = el("span", { class: "note", role: "status" });
    this.body = el("tbody");
    this.head = el("tr");
    parent.append(el("h2", {}, "Cases"));
    if (this.numeric.length)
      parent.append(el("div", { class: "bar" }, pick("across", "x"), pick("up", "y"),
        pick("shade", "shade", true)), this.plot);
    parent.append(el("div", { class: "bar" }, search, this.count),
      el("div", { class: "table-box", tabindex: 0, role: "region", "aria-label": "Table of cases" },
        el("table", { class: "cases" }, el("thead", {}, this.head), this.body)));
    parent.append(el("p", { class: "note", id: "precision" }));
    this.draw();
    if (!this.numeric.length) return;
    new ResizeObserver(() => { // letters keep their size on any screen
      if (Math.abs(this.plot.clientWidth - this.width) > 40) this.drawPlot(this.rows());
    }).observe(this.plot);
  }

  // "speed > 1.2" of the column whose name has "speed" in it, or a word that any cell has
  matches(row) {
    const text = this.filter.trim().toLowerCase();
    if (!text) return true;
    const rule = text.match(/^(.+?)\s*(<=|>=|!=|=|<|>)\s*(.+)$/);
    if (rule) {
      const c = this.columns.findIndex((name) => name.toLowerCase().includes(rule[1].trim()));
      if (c >= 0) {
        const value = this.cell(row, c), bound = Number(rule[3]);
        if (!isNumber(value) || Number.isNaN(bound)) {
          const same = String(value ?? "").toLowerCase() === rule[3].trim();
          return rule[2] === "=" ? same : rule[2] === "!=" ? !same : false;
        }
        return { "<": value < bound, ">": value > bound, "<=": value <= bound, ">=": value >= bound,
          "=": value === bound, "!=": value !== bound }[rule[2]];
      }
    }
    // from the beginning of a word on: "feasible" is not found in "infeasible"
    const at = new RegExp(`(?<![\\p{L}\\p{N}])${text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")}`, "u");
    return this.columns.some((_, c) => at.test(String(this.cell(row, c) ?? "").toLowerCase()));
  }

  rows() {
    const { column, down } = this.sort;
    const list = this.study.cases.map((row, index) => ({ row, index })).filter(({ row }) => this.matches(row));
    const order = (a, b) => {
      const [x, y] = [this.cell(a.row, column), this.cell(b.row, column)];
      if (isNumber(x) && isNumber(y)) return x - y;
      if (x === null || x === undefined) return 1;
      if (y === null || y === undefined) return -1;
      return String(x).localeCompare(String(y), undefined, { numeric: true });
    };
    list.sort((a, b) => (down ? -order(a, b) : order(a, b)) || a.index - b.index);
    return list;
  }

  draw() {
    const rows = this.rows();
    this.count.textContent = rows.length === this.study.cases.length ? `${rows.length} cases`
      : `${rows.length} of ${this.study.cases.length} cases`;
    this.head.replaceChildren(...this.columns.map((name, c) => el("th", { scope: "col",
      "aria-sort": this.sort.column === c ? (this.sort.down ? "descending" : "ascending") : "none" },
    el("button", { type: "button", onclick: () => {
      this.sort = { column: c, down: this.sort.column === c && !this.sort.down };
      this.draw();
    } }, name))));
    this.body.replaceChildren(...rows.map(({ row, index }) => el("tr", {
      class: index === this.chosen ? "chosen" : "", "data-case": index,
      onclick: () => this.choose(index) },
    this.columns.map((_, c) => {
      const value = this.cell(row, c);
      if (c === 0) return el("th", { scope: "row" }, el("button", { type: "button" }, row.name));
      if (c === 1) return el("td", {}, el("span", { class: `badge ${tone(row.state)}` }, row.state));
      return el("td", {}, value === null ? "" : isNumber(value) ? short(value, 4) : String(value));
    }))));
    if (this.numeric.length) this.drawPlot(rows);
  }

  // [from, to, dashed] of cases that a line joins
  joins(rows) {
    const { front, axes = 0, zipped = 0, cases } = this.study, c = this.x - 2;
    const seen = new Set(rows.map(({ index }) => index)), joined = [];
    if (front && [this.x, this.y].every((column) => front.terms.includes(column - 2))) {
      if (front.terms.length > 2) return [];
      front.order.forEach((index, place) => place
        && joined.push([front.order[place - 1], index, front.refused.includes(place - 1)]));
    } else if (!front && c >= 0 && c < axes) {
      const lines = new Map(), own = (i) => i === c || (c < zipped && i < zipped);
      for (const index of seen) {
        const key = JSON.stringify(cases[index].values.slice(0, axes).filter((_, i) => !own(i)));
        if (!lines.has(key)) lines.set(key, []);
        lines.get(key).push(index);
      }
      for (const line of lines.values()) {
        line.sort((a, b) => cases[a].values[c] - cases[b].values[c]);
        line.forEach((index, i) => i && joined.push([line[i - 1], index, false]));
      }
    }
    return joined.filter(([a, b]) => seen.has(a) && seen.has(b));
  }

  drawPlot(rows) {
    const width = this.width = Math.min(Math.max(this.plot.clientWidth, 260), 700);
    const height = 250, pad = { left: 58, right: 14, top: 12, bottom: 40 };
    const points = rows.map(({ row, index }) => ({ row, index, x: this.cell(row, this.x), y: this.cell(row, this.y) }))
      .filter((p) => isNumber(p.x) && isNumber(p.y));
    const range = (key) => {
      const values = points.map((p) => p[key]);
      const low = Math.min(...values), high = Math.max(...values);
      const room = high > low ? 0.06 * (high - low) : Math.abs(high) * 0.1 || 1;
      return [low - room, high + room];
    };
    const picture = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "group",
      "aria-label": `${this.columns[this.y]} over ${this.columns[this.x]}` });
    this.plot.replaceChildren(picture);
    if (!points.length) {
      this.plot.append(el("p", { class: "note" }, "No case has both numbers."));
      return;
    }
    const [x0, x1] = range("x"), [y0, y1] = range("y");
    const X = (x) => pad.left + ((x - x0) / (x1 - x0)) * (width - pad.left - pad.right);
    const Y = (y) => height - pad.bottom - ((y - y0) / (y1 - y0)) * (height - pad.top - pad.bottom);
    for (const y of ticks(y0, y1))
      picture.append(svg("line", { class: "rule", x1: pad.left, x2: width - pad.right, y1: Y(y), y2: Y(y) }),
        svg("text", { x: pad.left - 6, y: Y(y) + 4, "text-anchor": "end" }, short(y)));
    for (const x of ticks(x0, x1).filter((_, i, all) => all.length * 46 < width || i % 2 === 0))
      picture.append(svg("text", { x: X(x), y: height - pad.bottom + 16, "text-anchor": "middle" }, short(x)));
    picture.append(svg("text", { class: "name", x: (width + pad.left) / 2, y: height - 6,
      "text-anchor": "middle" }, this.columns[this.x]),
    svg("text", { class: "name", x: 12, y: height / 2, "text-anchor": "middle",
      transform: `rotate(-90 12 ${height / 2})` }, this.columns[this.y]));
    const at = new Map(points.map((p) => [p.index, p]));
    for (const [a, b, dashed] of this.joins(rows)) {
      const [p, q] = [at.get(a), at.get(b)];
      if (p && q) picture.append(svg("line", { class: dashed ? "join refused" : "join",
        x1: X(p.x), y1: Y(p.y), x2: X(q.x), y2: Y(q.y) }));
    }
    const shades = points.map((p) => this.shade < 0 ? null : this.cell(p.row, this.shade)).filter(isNumber);
    const [least, most] = [Math.min(...shades), Math.max(...shades)];
    const shadeOf = (value) => `color-mix(in srgb, var(--shade-high) ${
      Math.round(most > least ? (100 * (value - least)) / (most - least) : 50)}%, var(--shade-low))`;
    if (shades.length)
      this.plot.append(el("p", { class: "note" }, `${this.columns[this.shade]}: `, el("span", { class: "shades" }),
        ` from ${short(least)} to ${short(most)}`));
    for (const p of points) {
      const go = () => this.choose(p.index);
      const shade = this.shade < 0 ? null : this.cell(p.row, this.shade), place = this.study.front?.order.indexOf(p.index);
      const label = `${p.row.name}: ${short(p.x)}, ${short(p.y)}${isNumber(shade) ? `, ${short(shade)}` : ""}, `
        + (place >= 0 ? `place ${place + 1} of the front, ${p.row.state}` : p.row.state);
      picture.append(svg("circle", { cx: X(p.x), cy: Y(p.y), r: p.index === this.chosen ? 7 : 4.5,
        class: `dot ${tone(p.row.state)} ${p.index === this.chosen ? "chosen" : ""} ${place === -1 ? "off" : ""}`,
        ...(isNumber(shade) && good.has(p.row.state) ? { style: `fill: ${shadeOf(shade)}` } : {}), tabindex: 0,
        role: "button", "aria-label": `Watch ${label}`, onclick: go,
        onkeydown: (e) => (e.key === "Enter" || e.key === " ") && (e.preventDefault(), e.stopPropagation(), go()) },
      svg("title", {}, label)));
    }
  }

  choose(index) {
    this.chosen = index;
    this.draw();
    this.onChoose(index);
  }
}
