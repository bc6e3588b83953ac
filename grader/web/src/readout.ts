// The moment in numbers: time, tick, TCP and joints, as text that can be copied.

import type { Way } from "./between";
import type { Replay } from "./data";
import type { Track } from "./track";
import { element } from "./dom";
import { breakable, decimals, fixed } from "./words";
import type { World } from "./world";

/** While it plays the numbers change this often \[ms\]: faster than one reads, slower than the screen. */
const PACE_MS = 80;
const DEGREES = 180 / Math.PI;

export class Readout {
  readonly element: HTMLElement;
  private readonly t = element("span");
  private readonly tick = element("span", { "data-readout": "tick" });
  private readonly tcp: HTMLElement[] = [];
  private readonly q: HTMLElement[] = [];
  private readonly inDegrees: Array<HTMLElement | null> = [];
  /** The numbers of another run, where there is one, each with the track and the column that it is from. */
  private readonly others: Array<{ readonly cell: HTMLElement; readonly track: Track; readonly column: number }> = [];
  private written = 0;

  constructor(
    private readonly replay: Replay,
    private readonly world: World,
  ) {
    const time = element("p", { class: "replay-clock" });
    time.append(element("b", { "data-readout": "t" }, this.t, " s"), " ", element("span", { class: "quiet" }, "tick ", this.tick));

    const tcp = element("table", { "data-readout": "tcp" }, element("caption", {}, `TCP in the frame ${replay.lab.name}`));
    const joints = element("table", { "data-readout": "q" }, element("caption", {}, "Joints"));
    const row = (table: HTMLElement, name: string, ...cells: Array<HTMLElement | string>): void => {
      table.append(element("tr", {}, element("th", { scope: "row", title: name }, element("bdi", {}, ...breakable(name))), ...cells.map((cell) => element("td", {}, cell))));
    };
    const number = (into: HTMLElement[], name: string, index: number): HTMLElement => {
      const made = element("span", { [name]: String(index) });
      into.push(made);
      return made;
    };
    const { other } = replay;
    const beside = (track: Track | undefined, column: number): HTMLElement[] => {
      if (!other) return [];
      const cell = element("span", { class: "replay-other" }, "–");
      if (track) this.others.push({ cell, track, column });
      return [cell];
    };
    if (other) {
      const head = (): HTMLElement => element("tr", {}, element("td"), element("th", { scope: "col" }, String(replay.mainLabel ?? "A")), element("th", { scope: "col" }, String(replay.ghostLabel ?? "B")), element("td"));
      tcp.append(head());
      joints.append(head());
    }
    ["x", "y", "z"].forEach((axis, i) => {
      const value = number(this.tcp, "data-axis", i);
      row(tcp, axis, value, ...beside(other?.tcp, i), "m");
    });
    replay.joints.forEach((joint, i) => {
      const value = number(this.q, "data-joint", i);
      if (other) {
        this.inDegrees.push(null);
        row(joints, joint.name, value, ...beside(other.q.find(({ name }) => name === joint.name)?.track, 0), joint.unit);
      } else if (joint.unit === "rad") {
        const degrees = element("span");
        this.inDegrees.push(degrees);
        const cell = element("span", { class: "quiet" }, degrees, "°");
        row(joints, joint.name, value, joint.unit, cell);
      } else {
        this.inDegrees.push(null);
        row(joints, joint.name, value, joint.unit, "");
      }
    });
    this.element = element("div", { class: other ? "replay-readout two" : "replay-readout" }, time, tcp);
    if (replay.joints.length > 0) this.element.append(element("div", { class: "replay-joints", ...(replay.joints.length > 8 ? { tabindex: "0", role: "group", "aria-label": "Joints" } : {}) }, joints));
    this.write();
  }

  /** Writes the numbers, at most as often as one reads them. */
  follow(): void {
    const now = performance.now();
    if (now - this.written >= PACE_MS) this.write(now);
  }

  write(now = performance.now()): void {
    this.written = now;
    const { world, replay } = this;
    this.t.textContent = world.t.toFixed(Math.max(2, decimals(replay.stepS)));
    this.tick.textContent = String(Math.round(world.t / replay.stepS));
    const { tcp, q } = replay.moves;
    for (const { cell, track, column } of this.others) cell.textContent = fixed(between(track, column, world.progress), 4);
    for (let i = 0; i < 3; i++) this.tcp[i].textContent = about(tcp) + fixed(world.tcp[i], 4);
    for (let i = 0; i < this.q.length; i++) {
      this.q[i].textContent = about(q[i]) + fixed(world.q[i], 4);
      const degrees = this.inDegrees[i];
      if (degrees) degrees.textContent = fixed(DEGREES * world.q[i], 2);
    }
  }
}

/** What stands before a number that may be farther than this from the run's: between frames of what is recorded less accurately. */
const ROUGH = 1e-3;
const about = (way: Way): string => (way.within > ROUGH && !way.isFrame ? "≈ " : "");

/** The number of a column at a step, on the line between two steps. */
function between({ values, width, count }: Track, column: number, progress: number): number {
  const step = Math.min(count - 1, Math.floor(progress));
  const next = Math.min(count - 1, step + 1);
  const share = progress - step;
  return values[step * width + column] + share * (values[next * width + column] - values[step * width + column]);
}
