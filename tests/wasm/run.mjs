// Runs the grader's WebAssembly module in Node and prints what it gives:
//   node run.mjs MODULE CHECKOUT grade LAB SUBMISSION   the grade record
//   node run.mjs MODULE CHECKOUT contact                the digest of the run with contact

import { readFileSync, readdirSync, statSync } from "node:fs";
import { join } from "node:path";

const [modulePath, checkout, what, lab, submission] = process.argv.slice(2);
const module = new WebAssembly.Module(readFileSync(modulePath));

// Crates that could ask a browser for something leave imports behind: a grade asks for none of them.
const imports = {};
for (const { module: from, name } of WebAssembly.Module.imports(module)) {
  imports[from] ??= {};
  imports[from][name] = () => {
    throw new Error(`the module asked its host for ${from}.${name}`);
  };
}
const grader = new WebAssembly.Instance(module, imports).exports;

function put(bytes) {
  for (const byte of bytes) grader.put(byte);
}

function handIn(path, file) {
  put(Buffer.from(path));
  grader.end_path();
  put(readFileSync(file));
  grader.end_file();
}

function handInFolder(path) {
  for (const name of readdirSync(join(checkout, path)).sort()) {
    const inside = `${path}/${name}`;
    const file = join(checkout, inside);
    if (statSync(file).isDirectory()) handInFolder(inside);
    else handIn(inside, file);
  }
}

function taken() {
  const bytes = [];
  for (let byte = grader.take(); byte >= 0; byte = grader.take()) bytes.push(byte);
  return Buffer.from(bytes).toString();
}

handInFolder("labs");
let done;
if (what === "grade") {
  handInFolder("reference");
  handIn(submission.endsWith(".wasm") ? "submission.wasm" : "submission.rhai", submission);
  put(Buffer.from(lab));
  done = grader.grade();
} else {
  done = grader.contact();
}
if (!done) throw new Error(taken());
process.stdout.write(taken());
