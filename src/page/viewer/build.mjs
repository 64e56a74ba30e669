// Makes src/page/viewer.html of these sources: one page with style and script in it, in which only
// the data are missing. Run by `make viewer`; users' builds take the page as it stands.
import { readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const read = (name) => readFileSync(new URL(name, import.meta.url), "utf8");
const bundle = await build({
  entryPoints: [new URL("main.js", import.meta.url).pathname],
  bundle: true, minify: true, format: "iife", target: "es2021", legalComments: "none", write: false,
});
const licence = (name) => `/*!\n${name}\n\n${read(`licenses/${name.split(" ")[0]}.txt`).trim()}\n*/\n`;
const versions = JSON.parse(read("package.json")).dependencies;
// nothing in the script may end the element that it stands in
const script = bundle.outputFiles[0].text.replaceAll("</script", "<\\/script")
  .replaceAll("<!--", "<\\!--");
const style = [read("node_modules/uplot/dist/uPlot.min.css"), read("style.css")].join("\n")
  .replace(/\/\*[\s\S]*?\*\//g, "").replace(/\s*\n\s*/g, "\n");
const page = read("page.html")
  .replace("/*STYLE*/", () => style)
  .replace("/*SCRIPT*/", () => licence(`three.js ${versions.three}`) + licence(`uPlot ${versions.uplot}`) + script);
writeFileSync(new URL("../viewer.html", import.meta.url), page);
console.log(`src/page/viewer.html: ${Math.round(page.length / 1000)} kB`);
