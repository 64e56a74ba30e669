// The page: reads the data that stand in it, sets up view, clock, curves and text.
import { css, el, seconds } from "./dom.js";
import { spoken, unpack } from "./decode.js";
import { inflated } from "./inflated.js";
import { Cases } from "./cases.js";
import { Charts } from "./charts.js";
import { Film, canFilm, savePicture } from "./film.js";
import { failure, panels } from "./panels.js";
import { Stage, hasWebGL } from "./stage.js";
import { Study, tone } from "./study.js";
import { taskWords, verdictOf, worstOf } from "./words.js";

const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const hash = new URLSearchParams(location.hash.slice(1));
const calm = matchMedia("(prefers-reduced-motion: reduce)");

// {name, summary, scene, strip} of {name, packed}
const opened = (packed) => Object.assign(packed, JSON.parse(inflated(packed.packed)));

// its table is packed; which of the motions is a case's
if (data.study) {
  Object.assign(data.study, JSON.parse(inflated(data.study.table)));
  data.study.shown.forEach((index, motion) => { data.study.cases[index].motion = motion; });
}
const cases = data.study && new Cases(data.study.motions);

const page = {
  results: (data.results ?? []).map(opened),
  main: 0, ghost: -1, apart: hash.get("with") === "apart", stage: null, charts: null,
  time: 0, period: 0, playing: false, speed: 1,
};

const sceneOf = (result) => result.unpacked ??= unpack(result.scene);
// for who looks closer, from the console: what is shown, all series as arrays of SI units
globalThis.ambulo.scene = () => sceneOf(page.results[page.main]);
globalThis.ambulo.study = data.study;

// ------------------------------------------------------------------- theme

function setTheme(theme) {
  const root = document.documentElement;
  if (theme) root.dataset.theme = theme;
  else delete root.dataset.theme;
  const dark = css("--is-dark") === "1";
  byId("theme").setAttribute("aria-label", dark ? "Light colours" : "Dark colours");
  byId("theme").textContent = dark ? "Light" : "Dark";
  redrawAll();
}

function redrawAll() {
  if (page.stage?.data) {
    page.stage.build();
    page.stage.drawNow();
  }
  page.charts?.show();
}

// ------------------------------------------------------------------- clock

const ghostTime = (t) => {
  const other = page.results[page.ghost];
  if (!other) return t;
  return (t / sceneOf(page.results[page.main]).duration) * sceneOf(other).duration;
};

function setTime(time, period = page.period) {
  page.time = time;
  page.period = period;
  page.stage?.moveTo(time, period, ghostTime(time));
  page.charts?.setTime(time);
  const scrub = byId("scrub"), scene = sceneOf(page.results[page.main]);
  scrub.value = String(Math.round((1000 * time) / scene.duration));
  scrub.setAttribute("aria-valuetext", `${seconds(time)} of ${seconds(scene.duration)}`);
  byId("clock").textContent = `${time.toFixed(2)} / ${scene.duration.toFixed(2)} s`;
}

function goTo(time) {
  play(false);
  setTime(time);
}

let last = 0;
function tick(now) {
  if (!page.playing) return;
  const scene = sceneOf(page.results[page.main]);
  const step = Math.min(Math.max((now - last) / 1000, 0), 0.1) * page.speed;
  last = now;
  let time = page.time + step, { period } = page;
  if (page.film && time >= scene.duration) {
    setTime(scene.duration, 0);
    play(false);
    return;
  }
  if (page.pause > 0) page.pause -= step / page.speed;
  else if (time >= scene.duration) {
    if (goesOn(scene)) {
      time -= scene.duration;
      period += 1;
      const most = scene.rise ? 2 : 40;
      if (period >= most) period = 0;
    } else if (page.pause === undefined) {
      time = scene.duration;
      page.pause = 0.7; // a look at the end before it begins again
    } else {
      time = 0;
      page.pause = undefined;
    }
  }
  setTime(Math.min(time, scene.duration), period);
  requestAnimationFrame(tick);
}

// what repeats walks on, but for what stands in its way once
const goesOn = (scene) => Boolean(scene.repeats && !scene.obstacles.length);

function play(on) {
  page.playing = on;
  page.pause = undefined;
  const button = byId("play");
  button.setAttribute("aria-label", on ? "Pause" : "Play");
  button.setAttribute("aria-pressed", String(on));
  button.classList.toggle("playing", on);
  if (on) {
    const scene = sceneOf(page.results[page.main]);
    if (page.time >= scene.duration) page.time = 0;
    last = performance.now();
    requestAnimationFrame(tick);
  } else endFilm();
}

// from the beginning to the end once, at the speed that is chosen; stopped before, nothing is saved
function film() {
  const scene = sceneOf(page.results[page.main]);
  if (page.film) return play(false);
  play(false);
  setTime(0, 0);
  page.film = new Film(page.stage, page.results[page.main].name);
  byId("film").textContent = "Stop";
  byId("film").title = `${seconds(scene.duration / page.speed)} of film`;
  return play(true);
}

function endFilm() {
  const { film: made } = page;
  if (!made) return;
  page.film = null;
  byId("film").textContent = "Film";
  if (page.time >= sceneOf(page.results[page.main]).duration) made.end();
  else made.cancel();
}

function step(frames) {
  const scene = sceneOf(page.results[page.main]), dt = scene.duration / (scene.samples - 1);
  const t = Math.round(page.time / dt) + frames;
  goTo(Math.min(Math.max(t * dt, 0), scene.duration));
}

// ---------------------------------------------------------------- controls

function lanes(scene) {
  const box = byId("lanes"), names = [...new Set(scene.contacts.map((c) => c.name))];
  const longest = Math.max(0, ...names.map((name) => spoken(name).length));
  box.parentElement.style.setProperty("--names", longest ? `${Math.min(0.9 + 0.42 * longest, 7)}rem` : "0rem");
  box.replaceChildren(...names.map((name) => {
    const side = scene.feet.find((f) => f.name === name)?.side
      ?? scene.forces.find((f) => f.name === name)?.side ?? "middle";
    const spans = scene.contacts.filter((c) => c.name === name);
    return el("div", { class: "lane", title: `${spoken(name)}: on the ground` },
      el("span", { class: `lane-name ${side}` }, spoken(name)), el("div", { class: "lane-bar" },
        spans.map((c) => el("span", { class: `span ${side} ${c.mode}`,
          style: `left:${(100 * c.from) / scene.duration}%;`
            + `width:${(100 * (c.to - c.from)) / scene.duration}%` }))));
  }));
}

function setView(view) {
  for (const button of document.querySelectorAll("[data-view]"))
    button.setAttribute("aria-pressed", String(button.dataset.view === view));
  if (!page.stage) return;
  page.stage.view = view;
  page.stage.turned = false;
  page.stage.frame(view);
}

function connect() {
  byId("play").addEventListener("click", () => play(!page.playing));
  byId("back").addEventListener("click", () => step(-1));
  byId("ahead").addEventListener("click", () => step(1));
  byId("scrub").addEventListener("input", (e) => {
    goTo((Number(e.target.value) / 1000) * sceneOf(page.results[page.main]).duration);
  });
  byId("speed").addEventListener("change", (e) => { page.speed = Number(e.target.value); });
  for (const button of document.querySelectorAll("[data-view]"))
    button.addEventListener("click", () => setView(button.dataset.view));
  for (const box of document.querySelectorAll("[data-show]")) {
    if (!page.stage) continue;
    box.checked = page.stage.shows[box.dataset.show];
    box.addEventListener("change", () => page.stage.show({ [box.dataset.show]: box.checked }));
  }
  byId("theme").addEventListener("click", () => setTheme(css("--is-dark") === "1" ? "light" : "dark"));
  byId("print").addEventListener("click", () => print());
  byId("picture").addEventListener("click", () => savePicture(page.stage, page.results[page.main].name));
  byId("film").addEventListener("click", film);
  byId("film").hidden = !canFilm || !page.stage;
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => setTheme(
    document.documentElement.dataset.theme));
  let before;
  addEventListener("beforeprint", () => {
    play(false);
    before = document.documentElement.dataset.theme ?? "";
    setTheme("light");
    if (page.stage?.data) byId("still").src = page.stage.still(1500, 800);
  });
  addEventListener("afterprint", () => setTheme(before));
  document.addEventListener("keydown", keys);
}

function keys(e) {
  if (e.ctrlKey || e.metaKey || e.altKey) return;
  const tag = e.target.tagName;
  const typing = (tag === "INPUT" && !/checkbox|range/.test(e.target.type)) || tag === "SELECT";
  if (typing) return;
  const onStage = e.target.id === "canvas";
  const turnBy = 0.12, actions = {
    ArrowLeft: () => onStage ? page.stage?.orbit(-turnBy, 0) : step(-1),
    ArrowRight: () => onStage ? page.stage?.orbit(turnBy, 0) : step(1),
    ArrowUp: () => onStage && page.stage?.orbit(0, turnBy),
    ArrowDown: () => onStage && page.stage?.orbit(0, -turnBy),
    "+": () => page.stage?.zoom(0.88), "-": () => page.stage?.zoom(1.14),
    Home: () => goTo(0), End: () => goTo(sceneOf(page.results[page.main]).duration),
    1: () => setView("free"), 2: () => setView("side"), 3: () => setView("front"),
    4: () => setView("top"),
  };
  if (e.key === " " && !/BUTTON|SUMMARY|INPUT/.test(tag)) {
    e.preventDefault();
    play(!page.playing);
    return;
  }
  const action = actions[e.key];
  if (!action || (tag === "INPUT" && e.target.type === "range" && /Arrow|Home|End/.test(e.key))) return;
  if (/Arrow(Up|Down)/.test(e.key) && !onStage) return;
  e.preventDefault();
  action();
}

// ------------------------------------------------------------------ results

function heading(result) {
  const { summary } = result, scene = sceneOf(result);
  const name = spoken(summary.problem ?? result.name, false);
  byId("title").textContent = data.study ? data.study.name.replace(/_/g, " ") : name;
  document.title = `${byId("title").textContent} · Ambulo`;
  const [kind, word] = summary.verdict ? verdictOf(summary) : [tone(result.state), result.state];
  byId("badge").className = `badge ${kind}`;
  byId("badge").textContent = word;
  const about = taskWords(summary, scene);
  byId("subtitle").textContent = data.study ? `${result.name} · ${about}` : about;
  byId("failure").replaceChildren(failure(summary, scene, goTo) ?? "");
}

function choosers() {
  const box = byId("choosers");
  if (page.results.length < 2) return;
  const names = page.results.map((r, i) => [r.name, i]);
  const select = (label, value, list, change) => {
    const s = el("select", { "aria-label": label, onchange: () => change(Number(s.value)) },
      list.map(([name, i]) => el("option", { value: i }, name)));
    s.value = value;
    return el("label", {}, `${label} `, s);
  };
  const motions = names.filter(([, i]) => page.results[i].summary.verdict);
  box.replaceChildren(
    data.study || motions.length < 2 ? "" : select("motion", page.main, motions, (i) => show(i, page.ghost === i ? -1 : page.ghost)),
    select("with", page.ghost, [["nothing", -1], ...names.filter(([, i]) => i !== page.main)],
      (i) => show(page.main, i)),
    page.ghost < 0 || !page.stage ? "" : select("shown", Number(page.apart), [["overlaid", 0], ["side by side", 1]],
      (i) => {
        page.apart = Boolean(i);
        show(page.main, page.ghost);
      }));
}

// the picture of the folder; in place of the view where there is none
function showStrip(strip) {
  byId("flat-strip")?.remove();
  byId("strip").replaceChildren();
  if (!strip) return;
  const image = (id) => el("img", { id, alt:
    "Figures of the motion side by side, contacts, angles and torques over time",
    src: `data:image/svg+xml;charset=utf-8,${encodeURIComponent(strip)}` });
  if (page.stage) byId("strip").append(el("h2", {}, "At a glance"), image());
  else document.querySelector(".view").append(image("flat-strip"));
}

function show(main, ghost) {
  if (page.film) play(false);
  const time = page.main === main ? page.time : 0;
  page.main = main;
  page.ghost = ghost;
  const result = page.results[main], scene = sceneOf(result), other = page.results[ghost];
  heading(result);
  lanes(scene);
  page.charts?.destroy();
  const apart = Boolean(page.stage && other && page.apart);
  byId("apart").hidden = !apart;
  byId("apart").replaceChildren(...(apart ? [result, other].map((r) => el("span", {}, r.name)) : []));
  if (page.stage) {
    page.stage.apart = apart;
    page.stage.load(scene, other ? sceneOf(other) : null);
    if (page.stage.view) page.stage.frame(page.stage.view);
  }
  document.querySelectorAll("[data-needs]").forEach((node) => {
    const need = { forces: scene.forces.length, ghost: Boolean(other) && !apart, feet: scene.feet.length,
      meshes: scene.meshes.length, muscles: Boolean(scene.muscles), joints: Boolean(scene.muscles?.joints.length),
      sides: scene.bones.some((b) => b.side !== "middle") }[node.dataset.needs];
    node.hidden = !need;
  });
  page.charts = new Charts(byId("curves"), result.summary, scene, other ? { scene: sceneOf(other),
    summary: other.summary, time: ghostTime } : null, goTo);
  byId("panels").replaceChildren(...panels(result.summary, goTo));
  showStrip(result.strip);
  choosers();
  setTime(Math.min(time, scene.duration), 0);
}

// --------------------------------------------------------------------- study

// a case of a batch becomes a result; the one watched before stays as its ghost to choose
function watch(index) {
  const row = data.study.cases[index];
  if (row.motion === undefined) {
    byId("failure").replaceChildren(el("section", { class: "failure" }, el("h2", {}, row.name),
      el("p", {}, "Its motion is not in this page.")));
    return;
  }
  const playing = page.playing;
  const known = page.results.findIndex((r) => r.index === index);
  const at = known >= 0 ? known : page.results.push({ name: row.name, state: row.state, index,
    ...cases.open(row.motion) }) - 1;
  show(at, page.ghost === at ? -1 : page.ghost);
  byId("precision").textContent = cases.precision(sceneOf(page.results[at]));
  if (playing) play(true);
}

// --------------------------------------------------------------------- begin

function noView(why) {
  byId("stage").classList.add("flat");
  byId("no-webgl").hidden = false;
  byId("no-webgl").textContent = why;
  document.querySelectorAll(".needs-view").forEach((node) => { node.hidden = true; });
}

function begin() {
  if (hash.get("theme")) document.documentElement.dataset.theme = hash.get("theme");
  if (hash.get("webgl") !== "0" && hasWebGL()) {
    try {
      page.stage = new Stage(byId("canvas"));
      page.stage.onTurn = () => {
        page.stage.turned = true;
        for (const button of document.querySelectorAll("[data-view]")) button.setAttribute("aria-pressed", "false");
      };
      page.stage.resize();
    } catch (error) {
      page.stage = null;
    }
  }
  if (!page.stage) noView("This browser cannot draw in space: it has no WebGL. Here are figures "
    + "of the motion side by side; the curves follow the clock as ever.");
  connect();
  if (data.study) {
    byId("study").hidden = false;
    const study = new Study(byId("study"), data.study, watch);
    const index = data.study.cases.findIndex((c) => c.motion !== undefined);
    if (index >= 0) study.choose(index);
    else {
      byId("title").textContent = data.study.name.replace(/_/g, " ");
      byId("subtitle").textContent = "No case has a motion yet.";
      document.querySelector("main").classList.add("empty");
    }
  } else show(0, page.results.length > 1 ? 1 : -1);
  if (!page.results.length) return;
  setTheme(hash.get("theme") ?? "");
  setView(hash.get("view") ?? "free");
  const { summary } = page.results[page.main], scene = sceneOf(page.results[page.main]);
  if (hash.has("t")) setTime(Math.min(Math.max(Number(hash.get("t")) || 0, 0), scene.duration));
  else if (verdictOf(summary)[0] === "bad" && worstOf(summary)?.family)
    setTime(Math.min(Math.max(worstOf(summary).time ?? 0, 0), scene.duration));
  else if (!calm.matches) play(true);
}
begin();
