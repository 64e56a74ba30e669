// Stands first in a page under test: keeps what must not happen, tells what came of the checks.
window.faults = [];
addEventListener("error", (e) => faults.push(`error: ${e.message}`));
addEventListener("unhandledrejection", (e) => faults.push(`rejected: ${e.reason}`));
addEventListener("securitypolicyviolation", (e) => faults.push(`policy: ${e.violatedDirective} ${e.blockedURI}`));
for (const kind of ["error", "warn"]) {
  const before = console[kind];
  console[kind] = (...words) => {
    faults.push(`console.${kind}: ${words.join(" ").slice(0, 300)}`);
    before.apply(console, words);
  };
}
// a line each, which the browser writes to its log
window.report = (name, results) => {
  for (const [ok, what, got] of results)
    console.info(`check: ${ok ? "ok" : "FAILED"} ${name}: ${what}${ok || !got ? "" : `, got ${got.replace(/\s+/g, " ").slice(0, 300)}`}`);
  console.info(`check: end ${name}`);
};
