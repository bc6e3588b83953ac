// The reports and logs that the tests look at: every lab's good submission, and the labs of tests/lab_files/reports.
//
// The binary is that in KINEMARK, else the optimised build, else the other one. Each run of tests makes the reports in a temporary folder
// that goes away; `node graded.mjs FOLDER` makes them once, for tests with KINEMARK_REPORTS=FOLDER.
import { execFileSync, spawnSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

export const root = resolve(fileURLToPath(import.meta.url), "../../../..");
const fixtures = join(root, "tests/lab_files/reports");

/** The binary under test. */
export const kinemark = [process.env.KINEMARK, join(root, "target/release/kinemark"), join(root, "target/debug/kinemark")].find(
  (path) => path && existsSync(path),
);
if (!kinemark) throw new Error("there is no kinemark to test: build it, or name it in KINEMARK");

/** The labs of the course, by name, in order. */
export const courseLabs = readdirSync(join(root, "labs")).filter((name) => /^\d/.test(name)).sort();

/** The labs made to be hard on a report. */
export const hardLabs = ["hostile", "humanoid", "long-run", "meshes", "stopped"];

/** Grades into `out`; points may be lost (exit code 1), nothing else may go wrong. */
export function grade(lab, submission, out, ...options) {
  const ran = spawnSync(kinemark, ["grade", lab, submission, "--out", out, ...options], { encoding: "utf8", cwd: root });
  if (ran.status !== 0 && ran.status !== 1) throw new Error(`${lab}: ${ran.stderr || ran.error}`);
  return ran.stdout;
}

function gradeAll(folder) {
  mkdirSync(folder, { recursive: true });
  for (const lab of courseLabs) {
    grade(lab, join(root, "tests/submissions", lab, "good/submission.rhai"), join(folder, lab));
  }
  const labs = join(folder, "labs");
  cpSync(fixtures, labs, { recursive: true });
  cpSync(join(root, "labs/robots/rrbot.toml"), join(labs, "robots/rrbot.toml"), { recursive: true });
  const humanoid = execFileSync(kinemark, ["robot", "convert", join(root, "tests/golden/models/humanoid25.urdf")], { stdio: ["ignore", "pipe", "ignore"] });
  writeFileSync(join(labs, "robots/humanoid25.toml"), humanoid);
  for (const lab of hardLabs) {
    let submission = join(labs, "submissions", `${lab}.rhai`);
    if (lab === "hostile") {
      // the name of a file is text of a student's, too
      const named = join(labs, "submissions", "<img src=x onerror=\"window.harmed='name'\">.rhai");
      renameSync(submission, named);
      submission = named;
    }
    grade(lab, submission, join(folder, lab), "--labs", labs, "--practice");
  }
  return folder;
}

/** The folder with a report of each lab. */
export function reports() {
  const made = process.env.KINEMARK_REPORTS;
  if (made) return resolve(made);
  const folder = mkdtempSync(join(tmpdir(), "kinemark-reports-"));
  process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
  return gradeAll(folder);
}

/** Every log of a report: `{ task, path }`. */
export function logsOf(report) {
  const tasks = readdirSync(report, { withFileTypes: true }).filter((entry) => entry.isDirectory());
  const path = (entry) => join(report, entry.name, "run.mcap");
  return tasks.map((entry) => ({ task: basename(entry.name), path: path(entry) })).filter(({ path }) => existsSync(path));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) gradeAll(resolve(process.argv[2]));
