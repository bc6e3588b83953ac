// A class graded with the binary, so that its book has every page of `kinemark course page`: students with names of all kinds, good and
// wrong work, copies, and a variant for each.
import { spawn, spawnSync } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { kinemark, root } from "./graded.mjs";

export const lab = "01-kinematics";

/** Who hands in what; a name that would run if it were not text. */
const names = ["Jörg Müller", "李 雷", "=SUM(A1)", "Ann Lee", "Renée d'Été", "😀", "محمد علي", "<img src=x onerror=\"window.harmed='name'\">", "O'Neil, Pat", "A".repeat(120)];
const works = ["good", "degrees", "syntax", "four-millimetres-off", "misnamed", "elbow-flips", "whole-turns", "never-refuses", "quintic", "good"];

const text = (submission) => readFileSync(join(root, "tests/submissions", lab, submission, "submission.rhai"), "utf8");

function run(folder, ...args) {
  const ran = spawnSync(kinemark, args, { encoding: "utf8", cwd: folder });
  if (ran.status !== 0 && ran.status !== 1) throw new Error(`${args.join(" ")}: ${ran.stderr || ran.error}`);
  return ran.stdout;
}

/** The folder of the course; it goes away with this process. */
export function course() {
  const folder = mkdtempSync(join(tmpdir(), "kinemark-class-"));
  process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
  for (const part of ["labs", "reference"]) cpSync(join(root, part), join(folder, part), { recursive: true });
  mkdirSync(join(folder, "in"));
  const rows = ["id,name,section"];
  for (let i = 0; i < 24; i++) {
    rows.push(`s${100 + i},"${names[i % names.length].replaceAll('"', '""')}",${"AB"[i % 2]}`);
    if (i % 11 === 10) continue;
    // an author of their own, but for two who handed in one file
    writeFileSync(join(folder, "in", `s${100 + i}.rhai`), `${text(works[i % works.length])}\n// <script>window.harmed = 'code'</script> ${i === 20 ? 0 : i}\n`);
  }
  writeFileSync(join(folder, "roster.csv"), rows.join("\n"));
  writeFileSync(join(folder, "salt.txt"), "a line that nobody can guess\n");
  const file = (digest) => `format = 1\ntitle = "Robotics 1 <b>"\nsalt_file = "salt.txt"\npublic_solutions = true\nlabs_folder = "labs"\nreference = "reference"\n\n[[labs]]\nname = "${lab}"\n${digest}\n`;
  writeFileSync(join(folder, "course.toml"), file(""));
  const [digest] = spawnSync(kinemark, ["course", "check", "--json"], { encoding: "utf8", cwd: folder }).stdout.match(/digest = \\"\w{64}\\"/);
  writeFileSync(join(folder, "course.toml"), file(digest.replaceAll("\\", "")));
  run(folder, "course", "grade", "in", lab);
  run(folder, "course", "page", lab, "--names", "--similar");
  return folder;
}

/** Serves a book until `close`: `{ address, close }`. */
export async function served(book) {
  const child = spawn(kinemark, ["view", book, "--no-open", "--json"], { stdio: ["ignore", "pipe", "inherit"] });
  const line = await new Promise((resolve, reject) => {
    child.stdout.once("data", resolve);
    child.once("exit", (code) => reject(new Error(`view ended with ${code}`)));
  });
  return { address: JSON.parse(line).address, close: () => child.kill() };
}
