// Bundles the page to one file that needs nothing else: `node build.js [FILE]`, by default where the program has it.

import { build } from "esbuild";
import { readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const target = process.argv[2] ?? join(here, "../crates/lissom/src/pictures/view/viewer.html");

const script = await build({
  entryPoints: [join(here, "src/main.js")],
  bundle: true,
  minify: true,
  format: "iife",
  target: ["es2022"],
  legalComments: "eof",
  charset: "utf8",
  write: false,
});
const read = (name) => readFile(join(here, name), "utf8");
const style = (await read("node_modules/uplot/dist/uPlot.min.css")) + (await read("src/style.css"));
// A script ends at its end tag, even within a text.
const code = script.outputFiles[0].text.replaceAll("</script", "<\\/script").trim();
const page = (await read("index.html"))
  .replace("/*{{style}}*/", () => style.trim())
  .replace("/*{{script}}*/", () => code);
await writeFile(target, page);
console.log(`${target}: ${(page.length / 1024).toFixed(0)} kB`);
