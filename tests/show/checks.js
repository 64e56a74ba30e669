// Stands last in a page under test: uses it as a person would, and tells what came of it.
(async () => {
  const results = [], $ = (id) => document.getElementById(id);
  const check = (what, ok, got) => results.push([Boolean(ok), what, got === undefined ? "" : String(got)]);
  // what was asked for is drawn in the next frame, however late a loaded machine has it
  const frame = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const until = async (holds) => {
    for (let i = 0; i < 200 && !holds(); i++) await wait(50);
    return holds();
  };
  const clock = () => parseFloat($("clock").textContent);
  const canvas = $("canvas"), kind = window.kind;
  // what the view shows, as a number; drawn in this task
  const picture = async () => {
    await frame();
    const small = document.createElement("canvas");
    small.width = small.height = 64;
    const pen = small.getContext("2d");
    pen.imageSmoothingQuality = "high"; // every pixel counts, however small a thing is
    pen.drawImage(canvas, 0, 0, 64, 64);
    return Array.from(pen.getImageData(0, 0, 64, 64).data);
  };
  const apart = (a, b) => a.reduce((sum, x, i) => sum + Math.abs(x - b[i]), 0) / a.length;
  const scrub = (share) => {
    $("scrub").value = String(1000 * share);
    $("scrub").dispatchEvent(new Event("input"));
  };
  const press = (key) => document.body.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
  const shown = (node) => node && node.offsetParent !== null;

  function names() {
    const nameOf = (n) => (n.getAttribute("aria-label") || n.labels?.[0]?.textContent || n.textContent
      || n.alt || n.title || "").trim();
    const controls = document.querySelectorAll("button, input, select, summary, a, canvas, img, "
      + "[role=button], [role=tab], [role=img], [tabindex]");
    const bare = [...controls].filter((n) => !nameOf(n) && n.ariaHidden !== "true");
    check("controls have names", controls.length > 10 && bare.length === 0,
      bare.map((n) => n.outerHTML.slice(0, 80)));
    check("one title", document.querySelectorAll("h1").length === 1);
    check("a language", document.documentElement.lang === "en");
    const ids = [...document.querySelectorAll("[id]")].map((n) => n.id);
    check("no two of one id", new Set(ids).size === ids.length);
  }

  async function view() {
    await frame();
    const before = clock();
    check("is paused at the time of its address", Math.abs(before - 0.1) < 0.006, before);
    $("play").click();
    check("says that it plays", $("play").getAttribute("aria-label") === "Pause");
    check("plays", await until(() => clock() !== before), before);
    $("play").click();
    await frame();
    const still = clock();
    await wait(200);
    await frame();
    check("pauses", clock() === still, clock());
    scrub(0.1);
    const one = await picture();
    check("draws something", new Set(one).size > 20, new Set(one).size);
    scrub(0.5);
    const other = await picture();
    check("scrubs", apart(one, other) > 0.05, apart(one, other));
    scrub(0.1);
    check("comes back to the same", apart(one, await picture()) < 0.02);
    for (const name of ["side", "front", "top"]) {
      document.querySelector(`[data-view=${name}]`).click();
      check(`view from ${name}`, apart(one, await picture()) > 0.5);
    }
    document.querySelector("[data-view=free]").click();
    check("the free view again", apart(one, await picture()) < 1.0);
    const off = ["forces", "prints", "follow"].map((key) => document.querySelector(`[data-show=${key}]`));
    for (const box of off) box.click();
    scrub(0.1);
    const alone = await picture();
    scrub(0.16);
    check("the body moves", apart(alone, await picture()) > 0.05, apart(alone, await picture()));
    for (const box of off) box.click();
    scrub(0.1);
    for (const key of ["forces", "prints", "paths", "mass", "bones"]) {
      const box = document.querySelector(`[data-show=${key}]`), whole = await picture();
      box.click();
      check(`shows ${key} or not`, apart(whole, await picture()) > 0.0005, key);
      box.click();
    }
    const step = clock();
    for (let i = 0; i < 4; i++) press("ArrowRight");
    check("a key steps", clock() > step, clock());
    press(" ");
    const stood = clock();
    check("the space bar plays", await until(() => clock() !== stood)
      && $("play").getAttribute("aria-label") === "Pause");
    press(" ");
    const lightSky = getComputedStyle(document.documentElement).getPropertyValue("--sky");
    $("theme").click();
    check("dark and light", getComputedStyle(document.documentElement).getPropertyValue("--sky") !== lightSky);
    check("the view turns dark too", apart(one, await picture()) > 10);
    $("theme").click();
  }

  async function curves() {
    const tabs = [...document.querySelectorAll("[role=tab]")];
    check("four tabs of curves", tabs.length === 4, tabs.map((t) => t.textContent));
    for (const tab of tabs) {
      tab.click();
      await frame();
      const inks = [...document.querySelectorAll(".plot canvas")].map((c) => {
        const { data } = c.getContext("2d").getImageData(0, 0, c.width, c.height);
        return data.filter((x, i) => i % 4 === 3 && x > 0).length;
      });
      check(`curves of ${tab.textContent}`, inks.length >= 3 && inks.every((x) => x > 200), inks);
    }
    tabs[0].click();
    scrub(0.25);
    await frame();
    const line = document.querySelector(".now"), place = line.style.transform;
    scrub(0.75);
    check("a line follows the clock", line.style.transform !== place, place);
    const values = document.querySelector(".values").textContent;
    scrub(0.3);
    check("values follow the clock", document.querySelector(".values").textContent !== values, values);
    check("people are named", /24 young adults/.test($("curves").textContent));
    const axis = document.querySelector("#curves select");
    axis.value = "percent";
    axis.dispatchEvent(new Event("change"));
    await frame();
    check("percent of the cycle, a line for each side", document.querySelectorAll(".chart:first-child .now").length === 2);
    const hip = document.querySelector(".plot .u-over"), box = hip.getBoundingClientRect();
    const before = clock();
    hip.setPointerCapture = () => {};
    hip.dispatchEvent(new PointerEvent("pointerdown", { clientX: box.left + box.width * 0.8, clientY: box.top + 5 }));
    check("a click on a curve sets the clock", clock() !== before, clock());
  }

  // the chart of the solve: what it draws is what its table says
  async function way() {
    const box = document.querySelector(".way"), now = () => box.getAttribute("aria-valuetext");
    await until(() => box?.querySelector("svg"));
    check("the way of the solve is shown", shown(box) && box.querySelectorAll(".way-line").length === 2);
    const table = box.parentElement.querySelector("details");
    table.open = true;
    await until(() => table.querySelector("tbody tr"));
    const rows = [...table.querySelectorAll("tbody tr")].map((r) => [...r.children].map((c) => c.textContent));
    check("a row for each of its points", rows.length === Number(box.getAttribute("aria-valuemax"))
      && rows.length > 2, rows.length);
    const lines = [...box.querySelectorAll(".way-line")].map((l) => l.getAttribute("d").split(/[ML]/).slice(1)
      .map((at) => at.split(" ").map(Number)));
    check("both lines go through all of them", lines.every((l) => l.length === rows.length));
    const changes = rows.filter((r, i) => i && r[1] !== rows[i - 1][1]).length;
    check("a mark where another grid begins", box.querySelectorAll(".way-switch").length === changes, changes);
    const raised = { "⁻": "-", "⁰": "0", "¹": "1", "²": "2", "³": "3", "⁴": "4", "⁵": "5", "⁶": "6", "⁷": "7", "⁸": "8", "⁹": "9" };
    const number = (text) => Number(text.replace("−", "-").replace(/·10([⁻⁰-⁹¹²³]+)/,
      (all, e) => `e${[...e].map((c) => raised[c]).join("")}`));
    const logs = rows.map((r) => Math.log10(number(r[3]))), high = lines[1].map((at) => at[1]);
    const low = logs.indexOf(Math.min(...logs)), top = logs.indexOf(Math.max(...logs));
    const slope = (high[low] - high[top]) / (logs[low] - logs[top]);
    const off = logs.map((x, i) => Math.abs(high[top] + slope * (x - logs[top]) - high[i]));
    check("violations stand by powers of ten", slope < 0 && Math.max(...off) < 1.5, Math.max(...off));
    const time = clock(), key = (k) => box.dispatchEvent(new KeyboardEvent("keydown", { key: k, bubbles: true }));
    check("the end is read first", /^The end/.test(now()), now());
    key("Home");
    check("Home leads to the first iteration", /^Iteration 1 /.test(now()), now());
    key("ArrowRight");
    check("an arrow to the next", !/^Iteration 1 /.test(now()) && clock() === time, now());
    check("a line is where is read", Math.abs(Number(box.querySelector(".way-now").getAttribute("x1"))
      - lines[0][1][0]) < 0.2);
    const place = box.getBoundingClientRect();
    box.dispatchEvent(new PointerEvent("pointerdown", { clientX: place.right - 2, clientY: place.top + 60 }));
    check("the pointer leads there too", /^The end/.test(now()), now());
    const ink = () => getComputedStyle(box.querySelector(".way-line")).stroke, light = ink();
    $("theme").click();
    check("in dark and light", ink() !== light, light);
    $("theme").click();
    table.open = false;
  }

  // a case beside the scene.json of its own folder, of which its own page is made (window.own); steps are
  // those of src/study/case_pack.h, four times finer where there is room
  function nearOwn(own) {
    const row = [...document.querySelectorAll(".cases tbody tr")].find((r) => r.textContent.includes(own.row));
    row.click();
    const scene = globalThis.ambulo.scene(), off = {};
    const near = (name, got, list, unit, step) => {
      let value = 0, slope = 0;
      list.forEach((x, k) => {
        slope = k ? slope + x : 0;
        value = k ? value + slope : x;
        const error = Math.abs(got[k] - value * unit) / (step / 8);
        if (!(error <= (off[name] ?? 0))) off[name] = error;
      });
      if (got.length !== list.length) off[name] = Infinity;
    };
    const { units, mass } = own;
    own.points.forEach((three, p) => three.forEach((list, i) =>
      near("places", scene.points[p][i], list, units.length, 2e-3)));
    own.center_of_mass.forEach((list, i) => near("centre", scene.center_of_mass[i], list, units.length, 2e-3));
    own.coordinates.forEach((c, i) => {
      near("angles", scene.coordinates[i].q, c.q, units.angle, 3.4e-3);
      near("torques", scene.coordinates[i].tau, c.tau, units.torque, 1e-2 * mass);
      near("powers", scene.coordinates[i].power, c.power, units.power, 1e-2 * mass);
    });
    const worst = Object.entries(off).map(([name, x]) => `${name} ${x.toFixed(4)}`).join(", ");
    check(`${own.row} moves as in its own folder`, Object.keys(off).length === 5
      && Object.values(off).every((x) => x <= 1.001), worst);
    check(`${own.row} lasts as long`, Math.abs(scene.duration / own.duration - 1) < 1e-5, scene.duration);
  }

  // two motions overlaid, or each in a half of the view
  async function sideBySide() {
    const shownAs = () => document.querySelector("#choosers select[aria-label=shown]");
    const halves = (rgba) => [0, 1].map((h) => rgba.filter((_, i) => Math.floor(((i / 4) % 64) / 32) === h));
    const choose = (value) => {
      shownAs().value = value;
      shownAs().dispatchEvent(new Event("change"));
    };
    scrub(0.4);
    const over = await picture(), [l, r] = halves(over);
    check("overlaid at first", shownAs().value === "0" && $("apart").hidden && apart(l, r) > 0.5);
    choose("1");
    const [left, right] = halves(await picture());
    check("side by side, each with its name", $("apart").textContent.includes("walk")
      && $("apart").textContent.includes("brisk<b>") && $("apart").children.length === 2, $("apart").textContent);
    check("alike, but not the same", apart(left, right) > 0.1 && apart(left, right) < 12, apart(left, right));
    check("no ghost there", !shown(document.querySelector("[data-show=ghost]")));
    scrub(0.7);
    const later = halves(await picture());
    check("both move", apart(left, later[0]) > 0.1 && apart(right, later[1]) > 0.1);
    choose("0");
    scrub(0.4);
    check("overlaid again", apart(over, await picture()) < 0.02);
  }

  // what would be saved, in place of a download
  async function saves() {
    const blobs = [], make = URL.createObjectURL, click = HTMLAnchorElement.prototype.click, names = [];
    URL.createObjectURL = (blob) => {
      blobs.push(blob);
      return make.call(URL, blob);
    };
    HTMLAnchorElement.prototype.click = function () {
      names.push(this.download);
    };
    $("picture").click();
    await until(() => names.length === 1);
    check("saves a picture", names[0] === "walk.png" && blobs[0].type === "image/png" && blobs[0].size > 5000, names);
    $("film").click();
    check("a film begins at the beginning", clock() < 0.1 && $("film").textContent === "Stop", clock());
    await until(() => clock() > 0.1);
    $("film").click();
    await wait(300);
    check("one that is stopped is not saved", names.length === 1 && $("film").textContent === "Film", names);
    $("film").click();
    await until(() => names.length === 2);
    check("saves a film", /^walk\.(webm|mp4)$/.test(names[1]) && /^video/.test(blobs[1].type) && blobs[1].size > 20000,
      `${names} ${blobs[1]?.size}`);
    check("and stands at the end", $("play").getAttribute("aria-label") === "Play" && canvas.width !== 1280);
    URL.createObjectURL = make;
    HTMLAnchorElement.prototype.click = click;
  }

  // what is shown at first, or not, and else
  async function switches(list) {
    for (const [key, on] of list) {
      const box = document.querySelector(`[data-show=${key}]`), whole = await picture();
      check(`${key} are ${on ? "" : "not "}shown at first`, shown(box) && box.checked === on);
      box.click();
      check(`shows ${key} or not`, apart(whole, await picture()) > 0.01, key);
      box.click();
      check(`and ${key} as before`, apart(whole, await picture()) < 0.02, key);
    }
  }

  const words = () => document.body.textContent;
  if (kind === "walk") {
    names();
    await view();
    await sideBySide();
    await saves();
    await curves();
    await way();
    check("in words", /\d+ iterations on grids of [\d, ]+ and \d+ intervals.*counts as kept/.test(words()));
    const evil = "a<" + "/script><b>\u2028\"'&\u00fc";
    check("a name is only a name", $("title").textContent === evil.replace(/_/g, " "), $("title").textContent);
    check("nothing of it became an element", !document.querySelector("h1 b, option b"));
    check("nor of a folder's", [...document.querySelectorAll("option")].some((o) => o.textContent === "brisk<b>"),
      [...document.querySelectorAll("#choosers option")].map((o) => o.textContent));
    check("the other result is a ghost", !document.querySelector("[data-show=ghost]").closest("label").hidden);
    check("verdict, sensitivities, objective, convergence, versions", ["Verdict and audit", "What costs what",
      "Objective by term", "How the solve went", "Versions"].every((w) => words().includes(w)));
    check("the failure box is empty", !$("failure").textContent);
    check("no control for what is not there", !["muscles", "contacts", "meshes"].some((key) =>
      shown(document.querySelector(`[data-show=${key}]`))));
  } else if (kind === "muscles") {
    await frame();
    names();
    scrub(0.4);
    await switches([["muscles", true], ["contacts", false]]);
    const { muscles } = globalThis.ambulo.scene();
    check("activations are shares", muscles.muscles.length === 80 && muscles.muscles.every((m) =>
      m.activation.every((a) => a >= 0 && a <= 1)));
    for (const [name, charts] of [["Muscles", 6], ["Joints", 3]]) {
      const tab = [...document.querySelectorAll("[role=tab]")].find((t) => t.textContent === name);
      tab.click();
      await frame();
      check(`curves of ${name}`, document.querySelectorAll(".chart").length === charts
        && document.querySelectorAll(".chart:first-child .values span").length === 2);
    }
    const said = $("panels").textContent;
    check("their power is said in place of an estimate", /metabolic power of muscles.*W\/kg/.test(said)
      && !/cost, estimated/.test(said));
  } else if (kind === "robot") {
    await frame();
    names();
    scrub(0.4);
    await switches([["meshes", true], ["bones", false]]);
    const { meshes } = globalThis.ambulo.scene(), [base, arm] = meshes;
    check("meshes of both links", base?.link === "base" && arm?.link === "arm");
    check("a box has eight corners, at half of its edges", [0, 1, 2].every((i) =>
      Math.abs(Math.max(...base.vertices.filter((_, k) => k % 3 === i)) - [0.1, 0.2, 0.3][i]) < 1e-4));
    check("triangles of points that are there", Math.max(...arm.triangles) === arm.vertices.length / 3 - 1
      && Math.min(...arm.triangles) === 0);
  } else if (kind === "failed") {
    await frame();
    names();
    const box = document.querySelector(".failure");
    check("the failure stands first", box && document.querySelector("header").nextElementSibling.contains(box)
      && (box.compareDocumentPosition(document.querySelector("main")) & Node.DOCUMENT_POSITION_FOLLOWING));
    check("it is an alert", box?.getAttribute("role") === "alert");
    check("in plain words, with a place and a time", /off by [\d.]+.{1,20} at [\d.]+ s/.test(box?.textContent), box?.textContent);
    check("and a name", /wrist|hand|elbow|shoulder|a point that has to be/.test(box?.textContent), box?.textContent);
    check("it does not play by itself", $("play").getAttribute("aria-label") === "Play");
    box?.querySelector(".jump")?.click();
    const time = parseFloat(/at ([\d.]+) s/.exec(box?.textContent)?.[1]);
    check("it shows when", Math.abs(clock() - time) < 0.02, clock());
    await way();
    check("what is still broken in words", /still off by .* of its size at the end; 10⁻⁶ would count as kept/.test(words()));
    check("the verdict is no praise", /\bbad\b/.test($("badge").className));
  } else if (kind === "study") {
    await frame();
    names();
    const rows = () => document.querySelectorAll(".cases tbody tr").length;
    check("a row each case", rows() === 4, rows());
    check("a dot each case that has both numbers", document.querySelectorAll(".dot").length === 4);
    check("a line along the only axis", document.querySelectorAll(".join").length === 3);
    const pick = (label, column) => {
      const select = document.querySelector(`#study select[aria-label="${label}"]`);
      select.value = [...select.options].find((o) => o.textContent.startsWith(column)).value;
      select.dispatchEvent(new Event("change"));
    };
    const fills = () => new Set([...document.querySelectorAll(".dot.good")].map((d) => getComputedStyle(d).fill)).size;
    check("dots of one colour", fills() === 1, fills());
    pick("shade", "objective");
    check("shaded by a third column", fills() === 4 && /objective:.*from [\d.]+ to [\d.]+/.test($("study").textContent), fills());
    pick("shade", "none");
    pick("across", "objective");
    check("no line where cases have values of their own", !document.querySelector(".join"));
    pick("across", "time");
    const search = document.querySelector("#study input");
    const filter = (text) => {
      search.value = text;
      search.dispatchEvent(new Event("input"));
      return rows();
    };
    check("filters by a number", filter("time > 1.05") === 2, rows());
    check("filters by a word", filter("optimal") === 4, rows());
    check("a word begins where it begins", filter("ptimal") === 0 && filter("opti") === 4, rows());
    check("and by nothing", filter("") === 4);
    const cells = (n) => [...document.querySelectorAll(`.cases tbody tr > :nth-child(${n})`)].map((c) => c.textContent);
    const sort = () => document.querySelector(".cases thead th:nth-child(3) button").click();
    sort();
    const rising = cells(3).map(Number);
    sort();
    check("sorts both ways", rising.every((x, i) => i === 0 || x >= rising[i - 1])
      && cells(3).map(Number).every((x, i, all) => i === 0 || x <= all[i - 1]), rising);
    const one = await picture(), subtitle = $("subtitle").textContent;
    const dots = [...document.querySelectorAll(".dot")];
    dots[0].dispatchEvent(new MouseEvent("click", { bubbles: true }));
    scrub(0.4);
    check("a click shows another case", $("subtitle").textContent !== subtitle, $("subtitle").textContent);
    check("in space", apart(one, await picture()) > 0.02);
    check("no empty chart of its solve", !document.querySelector(".way"));
    check("its row is marked", document.querySelectorAll("tr.chosen").length === 1);
    for (const own of window.own) nearOwn(own);
    check("how near they are is said", /places are within [\d.]+ mm, angles within [\d.]+°/.test(words()),
      $("precision").textContent);
  } else if (kind === "axes") {
    await frame();
    const chosen = (label) => document.querySelector(`#study select[aria-label="${label}"]`).selectedOptions[0].textContent;
    check("the axis with most effect is across", chosen("across") === "mass", chosen("across"));
    check("what varies most with it is up", chosen("up") === "objective", chosen("up"));
    check("what that leaves is shaded by the other", chosen("shade") === "nodes", chosen("shade"));
    check("lines along it alone", document.querySelectorAll(".join").length === 6);
  } else if (kind === "front") {
    await frame();
    const { front, cases } = globalThis.ambulo.study, on = document.querySelectorAll(".dot:not(.off)").length;
    check("the terms are across and up", ["across", "up"].every((label, i) =>
      document.querySelector(`#study select[aria-label="${label}"]`).selectedOptions[0].textContent
        === ["torque_squared", "acceleration"][i]));
    check("points of the front are filled", on === front.order.length && on < cases.length, on);
    check("a line joins them", document.querySelectorAll(".join").length === on - 1);
    check("and is dashed where no weights lead", document.querySelectorAll(".join.refused").length
      === front.refused.length, front.refused);
    const first = cases[front.order[0]].name;
    check("a dot says its place", [...document.querySelectorAll(".dot")].some((d) =>
      d.getAttribute("aria-label").startsWith(`Watch ${first}: `) && /place 1 of the front/.test(d.getAttribute("aria-label"))));
  } else if (kind === "flat") {
    await frame();
    check("says that there is no WebGL", shown($("no-webgl")) && /no WebGL/.test($("no-webgl").textContent));
    check("shows the figures", shown($("flat-strip")) && await until(() => $("flat-strip").naturalWidth > 100));
    check("shows curves", document.querySelectorAll(".plot canvas").length >= 3);
    scrub(0.5);
    check("the clock goes", clock() > 0.1);
    check("no view is offered", ![...document.querySelectorAll("[data-view]")].some(shown));
  }
  // on a phone too: nothing stands beyond the screen, nor has to be pushed into it, but for tables
  const beyond = [...document.querySelectorAll("header *, .shows *, .bar *, .tabs *")].filter((n) => shown(n)
    && (n.getBoundingClientRect().right > innerWidth + 1 || n.scrollWidth > n.clientWidth + 1 && n.matches("div")));
  check("all of it fits into the screen", document.documentElement.scrollWidth <= innerWidth && beyond.length === 0,
    beyond.map((n) => n.outerHTML.slice(0, 90)));
  const asked = performance.getEntriesByType("resource").filter((r) => !/^(data|blob):/.test(r.name));
  check("asks the network for nothing", asked.length === 0, asked.map((r) => r.name));
  check("no error, no warning", window.faults.length === 0, window.faults.join(" | "));
  window.report(kind, results);
})().catch((error) => window.report(window.kind, [[false, "the checks end", error.stack]]));
