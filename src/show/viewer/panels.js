// Verdict, audit, sensitivities, objective, convergence, versions: text and bars.
import { el, seconds, short } from "./dom.js";
import { Convergence, wayWords } from "./convergence.js";
import { spoken } from "./decode.js";
import { amount, familyWords, rowWords, termWords, verdictOf, violationWords, worstOf } from "./words.js";

const percent = (x) => `${short(100 * x, 2)} %`;

function timeButton(time, onTime, label) {
  if (!Number.isFinite(time)) return null;
  return el("button", { type: "button", class: "jump", onclick: () => onTime(time),
    "aria-label": `Show the motion at ${seconds(time)}` }, label ?? seconds(time));
}

function section(title, open, ...children) {
  return el("details", { class: "panel", open }, el("summary", {}, el("h2", {}, title)), ...children);
}

// what failed, before anything else
export function failure(summary, scene, onTime) {
  const [tone, word, meaning] = verdictOf(summary);
  if (tone !== "bad") return null;
  const worst = worstOf(summary);
  const lines = summary.explanation?.lines ?? [];
  const suggestion = summary.explanation?.suggestion;
  const box = el("section", { class: "failure", role: "alert", "aria-label": "What failed" },
    el("h2", {}, word), el("p", {}, meaning));
  if (summary.audit?.fault) box.append(el("p", { class: "strong" }, summary.audit.fault));
  if (worst?.family) box.append(el("p", { class: "strong" }, "The worst: ", violationWords(worst), ". ",
    timeButton(worst.time, onTime, "Show it")));
  if (suggestion) box.append(el("p", { class: "advice" }, el("b", {}, "What would help: "), suggestion));
  const others = lines.filter((line) => line.trim() && line.trim() !== suggestion?.trim());
  if (others.length) box.append(el("details", {}, el("summary", {}, "Why, in the solver's words"),
    el("ul", {}, others.map((line) => el("li", {}, line)))));
  if (scene && scene.is_finite === 0)
    box.append(el("p", {}, "Where the motion is not finite, the body stands still."));
  return box;
}

function audit(summary, onTime) {
  const a = summary.audit;
  if (!a) return null;
  const items = [];
  const worst = violationWords(a.violation);
  if (worst) items.push(el("li", {}, "At the times where rules are enforced, the worst is ", worst, ". ",
    timeButton(a.violation.time, onTime)));
  const dense = summary.between_nodes;
  if (dense) {
    if (dense.samples === 0) items.push(el("li", {}, `Between those times nothing is known: ${dense.reason}.`));
    else if (dense.holds) items.push(el("li", {}, "Between those times every rule stays within its tolerance."));
    else items.push(el("li", {}, `Between those times ${dense.failing} of ${dense.families.length} `
      + "families of rules leave their tolerance", dense.summary ? `: ${dense.summary}` : ".",
    el("ul", {}, dense.families.filter((f) => !f.holds).map((f) => el("li", {},
      `${familyWords(f.family)} (${rowWords(f)}): ${amount(f.worst, f.unit)}, tolerance `
      + `${amount(f.tolerance, f.unit)} `, timeButton(f.time, onTime), f.advice ? ` ${f.advice}` : "")))));
  }
  if (a.active_rows >= 0) items.push(el("li", {}, `${a.active_rows} rules hold with equality, `
    + `${a.rank} of them independent.`));
  for (const near of (summary.approaches ?? []).slice().sort((x, y) => x.gap - y.gap).slice(0, 3))
    items.push(el("li", {}, `${spoken(near.capsule)} and ${spoken(near.other ?? near.obstacle)} come `
      + `within ${amount(near.gap, "m")} `, timeButton(near.time, onTime)));
  return el("ul", {}, items);
}

function keyNumbers(summary) {
  const rows = [];
  const add = (name, value) => rows.push(el("div", {}, el("dt", {}, name), el("dd", {}, value)));
  const { gait, work, center_of_mass: mass, ground_reaction: ground } = summary;
  if (gait) {
    add("speed", `${short(gait.speed)} m/s`);
    add("step", `${short(gait.step_length)} m in ${short(gait.step_time)} s`);
    add("foot on the ground", percent(gait.duty_factor));
  }
  const peaks = Object.entries(ground ?? {}).filter(([, f]) => f.peak > 0);
  if (peaks.length) add("largest force", peaks.slice(0, 3)
    .map(([name, f]) => `${spoken(name)} ${short(f.peak)}`).join(", ") + " body weights");
  const { metabolic } = summary.muscles ?? {};
  if (metabolic) {
    const way = metabolic.bhargava_per_kg_metre;
    add("metabolic power of muscles", `${short(metabolic.bhargava)} W/kg`
      + (way ? `; ${short(way)} J/(kg m)` : ""));
  } else if (work?.metabolic_per_kg_metre) {
    const people = work.people_per_kg_metre;
    add("metabolic cost, estimated", `${short(work.metabolic_per_kg_metre)} J/(kg m)`
      + (people ? `; people ${short(people)}` : ""));
  } else if (work) add("work", `${short(work.positive)} J, ${short(work.negative)} J`);
  if (mass) add("centre of mass rises", amount(mass.rise, "m"));
  return rows.length ? el("dl", { class: "numbers" }, rows) : null;
}

function bars(rows, label) {
  const most = Math.max(...rows.map((r) => Math.abs(r.share)), 1e-12);
  return el("table", { class: "bars" }, el("caption", { class: "hidden" }, label), el("tbody", {},
    rows.map((r) => el("tr", {}, el("th", { scope: "row", title: r.code }, r.words,
      r.code ? el("code", {}, r.code) : null),
    el("td", { class: "bar-cell" }, el("span", { class: `fill ${r.share < 0 ? "saves" : ""}`,
      style: `width:${((100 * Math.abs(r.share)) / most).toFixed(1)}%` })),
    el("td", { class: "number" }, r.value)))));
}

function objective(summary) {
  const terms = Object.entries(summary.objective?.terms ?? {}).filter(([, v]) => v !== null);
  const total = summary.objective?.total ?? 0;
  if (!terms.length) return null;
  terms.sort((a, b) => b[1] - a[1]);
  const solved = verdictOf(summary)[0] === "good";
  return el("div", {}, el("p", {}, solved ? `The motion makes the sum of these least: ${short(total, 4)}.`
    : `What this motion would cost, which is no solution: ${short(total, 4)}.`),
    bars(terms.map(([name, v]) => ({ words: termWords(name), share: v,
      value: `${short(v)} · ${total ? percent(v / total) : ""}` })), "Objective by term"));
}

function sensitivities(summary) {
  const list = (summary.sensitivities ?? []).filter((s) => Math.abs(s.share ?? 0) >= 1e-5);
  if (!list.length) {
    const why = summary.no_sensitivities;
    return why ? el("p", {}, `There are none: ${why}.`) : null;
  }
  const sorted = list.slice().sort((a, b) => Math.abs(b.share) - Math.abs(a.share));
  const error = (s) => (Number.isFinite(s.error) && s.derivative
    ? ` ± ${short(100 * Math.abs((s.share * s.error) / s.derivative), 1)}` : "");
  const rows = (part) => bars(part.map((s) => ({ words: s.words, code: s.name, share: s.share,
    value: `${s.share > 0 ? "+" : "−"}${short(100 * Math.abs(s.share), 2)}${error(s)} %` })), "Sensitivities");
  const box = el("div", {}, el("p", {}, "What a small change of one number of the problem does to the "
    + "least objective; everything else stays, and the motion adapts."), rows(sorted.slice(0, 10)));
  if (sorted.length > 10) box.append(el("details", {}, el("summary", {},
    `${sorted.length - 10} more`), rows(sorted.slice(10))));
  return box;
}

function convergence(summary) {
  const items = [];
  const way = summary.convergence;
  if (way) items.push(el("p", {}, wayWords(way)), new Convergence(way).node);
  if (summary.ending) items.push(el("p", { class: "note" }, `${summary.ending}.`));
  const numbers = [];
  const add = (name, value) => numbers.push(el("div", {}, el("dt", {}, name), el("dd", {}, value)));
  const s = summary.seconds, a = summary.audit;
  if (summary.iterations !== undefined) add("iterations", String(summary.iterations));
  if (summary.evaluations !== undefined) add("evaluations", String(summary.evaluations));
  if (a) {
    add("gradient left (KKT)", short(a.kkt, 2));
    add("worst violation", a.violation?.unit ? amount(a.violation.worst, a.violation.unit) : "none");
  }
  if (summary.sizes) add("size", `${summary.sizes.variables} unknowns, `
    + `${summary.sizes.equalities + summary.sizes.inequalities} rows, ${summary.sizes.nodes} times`);
  if (s) add("time", `${short(s.total)} s`);
  items.push(el("dl", { class: "numbers" }, numbers));
  if (s?.total > 0) {
    const rest = Math.max(s.total - s.evaluate - s.linear_algebra - s.nlopt, 0);
    items.push(bars([["linear algebra", s.linear_algebra], ["motion and derivatives", s.evaluate],
      ["NLopt itself", s.nlopt], ["the rest", rest]].map(([words, v]) => ({ words, share: v,
      value: `${short(v, 2)} s` })), "Where the time went"));
  }
  if (summary.starts) items.push(el("p", {}, `${summary.starts.count} starts, ${summary.starts.solved} `
    + `of them solved, in ${summary.starts.basins.length} valleys: `
    + summary.starts.basins.map((b) => `${short(b.objective, 4)} (${b.found} times)`).join(", ") + "."));
  return el("div", {}, items);
}

function freeParameters(summary) {
  const list = summary.free?.parameters;
  if (!list?.length) return null;
  return el("table", { class: "plain" }, el("thead", {}, el("tr", {}, ["number", "value", "between", "from"]
    .map((t) => el("th", { scope: "col" }, t)))), el("tbody", {}, list.map((p) => el("tr", {},
    el("th", { scope: "row" }, p.name), el("td", {}, `${short(p.value)} ${p.unit}`),
    el("td", {}, `${short(p.lower)} and ${short(p.upper)}${p.at_bound ? `, at its ${p.at_bound} bound` : ""}`),
    el("td", {}, short(p.first))))));
}

function versions(summary) {
  const v = summary.versions;
  if (!v) return null;
  const rows = [["Ambulo", v.ambulo], ["NLopt", v.nlopt], ["libyaml", v.libyaml], ["BLAS", v.blas],
    ["instruction set", v.instruction_set], ["model", summary.model], ["input hash", summary.input_hash]];
  return el("dl", { class: "numbers" }, rows.filter((r) => r[1]).map(([a, b]) => el("div", {},
    el("dt", {}, a), el("dd", {}, b))));
}

export function panels(summary, onTime) {
  const [, , meaning] = verdictOf(summary);
  const parts = [["Verdict and audit", true, el("div", {}, el("p", {}, meaning), keyNumbers(summary),
    audit(summary, onTime))],
  ["Numbers that were free", true, freeParameters(summary)],
  ["What costs what", true, sensitivities(summary)],
  ["Objective by term", true, objective(summary)],
  ["How the solve went", true, summary.seconds || summary.ending ? convergence(summary) : null],
  ["Versions", false, versions(summary)]];
  return parts.filter(([, , body]) => body).map(([title, open, body]) => section(title, open, body));
}
