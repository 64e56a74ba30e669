// Stands last in the page of a task: plays it as its reader would, and tells what came of it. What every page
// can do is checked by tests/show.
(async () => {
  const results = [], $ = (id) => document.getElementById(id);
  const check = (what, ok, got) => results.push([Boolean(ok), what, got === undefined ? "" : String(got)]);
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const clock = () => parseFloat($("clock").textContent);
  const picture = async () => {
    await wait(120);
    const small = document.createElement("canvas");
    small.width = small.height = 64;
    const pen = small.getContext("2d");
    pen.drawImage($("canvas"), 0, 0, 64, 64);
    return Array.from(pen.getImageData(0, 0, 64, 64).data);
  };
  const apart = (a, b) => a.reduce((sum, x, i) => sum + Math.abs(x - b[i]), 0) / a.length;
  const scrub = (share) => {
    $("scrub").value = String(1000 * share);
    $("scrub").dispatchEvent(new Event("input"));
  };
  await wait(300);
  check("its title is its task", $("title").textContent === window.kind.replace(/_/g, " "), $("title").textContent);
  scrub(0.1);
  const one = await picture(), before = clock();
  check("draws something", new Set(one).size > 20, new Set(one).size);
  scrub(0.6);
  check("moves", apart(one, await picture()) > 0.05 && clock() > before, clock());
  check("draws curves", document.querySelectorAll(".plot canvas").length >= 3);
  check("no failure, no praise that is bad", !$("failure").textContent && !/\bbad\b/.test($("badge").className), `${$("badge").className}: ${$("failure").textContent}`);
  check("no error, no warning", window.faults.length === 0, window.faults.join(" | "));
  window.report(window.kind, results);
})().catch((error) => window.report(window.kind, [[false, "the checks end", error.stack]]));
