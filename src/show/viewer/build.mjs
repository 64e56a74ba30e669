// Makes src/show/viewer.html of these sources: one page with style and script in it, in which only
// the data are missing. Run by `make viewer` in a copy below build/, where the packages of
// package-lock.json are installed; users' builds take the page as it stands.
import { createHash } from "node:crypto";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { deflateRawSync } from "node:zlib";
import { build } from "esbuild";

const read = (name) => readFileSync(new URL(name, import.meta.url), "utf8");
const bundle = async (entry) => (await build({
  entryPoints: [new URL(entry, import.meta.url).pathname],
  bundle: true, minify: true, format: "iife", target: "es2021", legalComments: "none", write: false,
})).outputFiles[0].text;

const packed = (text) => deflateRawSync(text, { level: 9, memLevel: 9 }).toString("base64");

// by this number tests/show/long_page.sh knows a page that is older than its sources
const sources = readdirSync(new URL(".", import.meta.url))
  .filter((name) => /\.(js|mjs|css|html|json)$/.test(name)).sort();
const digest = createHash("sha256").update(sources.map(read).join("")).digest("hex");

const versions = JSON.parse(read("package.json")).dependencies;
const licence = (name) => `/*!\n${name}\n\n${read(`licenses/${name.split(" ")[0]}.txt`).trim()}\n*/\n`;
// nothing in the script may end the element that it stands in
const script = (await bundle("start.js")).replaceAll("</script", "<\\/script")
  .replaceAll("<!--", "<\\!--");
const program = packed(await bundle("main.js"));
const style = [read("node_modules/uplot/dist/uPlot.min.css"), read("style.css")].join("\n")
  .replace(/\/\*[\s\S]*?\*\//g, "").replace(/\s*\n\s*/g, "\n");
const page = read("page.html")
  .replace("/*SOURCES*/", () => digest)
  .replace("/*STYLE*/", () => style)
  .replace("/*PROGRAM*/", () => program)
  .replace("/*SCRIPT*/", () => licence(`three.js ${versions.three}`)
    + licence(`uPlot ${versions.uplot}`) + licence(`fflate ${versions.fflate}`) + script);
writeFileSync(process.argv[2], page);
console.log(`viewer.html: ${Math.round(Buffer.byteLength(page) / 1000)} kB`);
