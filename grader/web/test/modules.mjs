// The viewer's modules for Node: built as they are, one at a time.

import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const root = join(dirname(fileURLToPath(import.meta.url)), "..");

export async function load(name) {
  const built = await build({ entryPoints: [join(root, "src", name)], bundle: true, format: "esm", write: false, target: "es2022", logLevel: "error" });
  return import(`data:text/javascript;base64,${Buffer.from(built.outputFiles[0].text).toString("base64")}`);
}
