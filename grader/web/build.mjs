// Builds what the report embeds: one script, its digest for the content security policy, and its style sheet.
//
// The same sources give the same bytes: no date, no path and no name of a machine goes in.

import { createHash } from "node:crypto";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const licence = (await readFile(join(here, "node_modules/three/LICENSE"), "utf8")).trim().replace(/\s*\n\s*/g, "\n");

// the shaders of three are text with indents and comments, which esbuild cannot shorten; in what begins with # a blank has a meaning
function short(line) {
  const code = line.replace(/\\t/g, " ").replace(/\/\/.*$/, "").trim();
  return code.startsWith("#") ? code : code.replace(/ *([=*,;{}()?:<>&|]) */g, "$1");
}

const shaders = {
  name: "shaders",
  setup(build) {
    build.onLoad({ filter: /three\.(module|core)\.js$/ }, async ({ path }) => {
      const text = await readFile(path, "utf8");
      const shorter = text.replace(/"(?:[^"\\\n]|\\.)*"/g, (string) =>
        string.includes("\\n") ? string.slice(1, -1).split("\\n").map(short).filter((line) => line !== "").join("\\n").replace(/^|$/g, '"') : string,
      );
      return { contents: shorter, loader: "js" };
    });
  },
};

const common = { absWorkingDir: here, bundle: true, minify: true, write: false, charset: "ascii", logLevel: "warning" };
const script = await build({
  ...common,
  entryPoints: ["src/main.ts"],
  format: "iife",
  target: "es2022",
  legalComments: "none",
  banner: { js: `/*! Kinemark's replay viewer. It contains three.js:\n${licence} */` },
  plugins: [shaders],
});
const style = await build({ ...common, entryPoints: ["src/viewer.css"], target: ["chrome111", "firefox113", "safari16.4"] });

const js = script.outputFiles[0].text.trimEnd();
const css = style.outputFiles[0].text.trimEnd();
for (const [name, text, ends] of [["viewer.js", js, /<\/?script|<!--/i], ["viewer.css", css, /<\/style|<!--/i]]) {
  if (ends.test(text)) throw new Error(`${name} holds what would end or break the element it is put into: ${ends}`);
}
const digest = createHash("sha256").update(js, "utf8").digest("base64");

await mkdir(join(here, "dist"), { recursive: true });
await writeFile(join(here, "dist/viewer.js"), js);
await writeFile(join(here, "dist/viewer.js.sha256"), digest);
await writeFile(join(here, "dist/viewer.css"), css);
console.log(`viewer.js ${js.length} bytes, viewer.css ${css.length} bytes, sha256-${digest}`);
