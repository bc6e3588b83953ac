// The run from the side, drawn flat: what takes the place of the 3D view where there is no WebGL.

import { balls, type Balls } from "./balls";
import { bones, reach, type Bone } from "./bones";
import { contactMarks, coverAt, type ContactMark } from "./contacts";
import { drawing, element } from "./dom";
import type { Frame, Scenery } from "./data";
import type { Extent } from "./extent";
import { nextFrame } from "./frames";
import { hidden } from "./ghosts";
import { hull } from "./hull";
import { left, nearest, offAt, type Left } from "./left";
import { namedFrames } from "./named";
import { pitchFor } from "./pitch";
import { place } from "./pose";
import { turns } from "./theme";
import type { Part, Project, View } from "./view";
import { Velocity } from "./velocity";
import type { Placed } from "./world";

/** Points of a circle that stands for a ball. */
const ROUND = 20;
const MOST_CONTACTS = 100;
/** The arrow of the greatest force of a run is as long as this part of its size. */
const LONGEST_FORCE = 0.35;
const AXES = ["x", "y", "z"] as const;

interface Outline {
  readonly path: SVGPathElement;
  readonly node: number;
  readonly balls: Balls;
  readonly moves: boolean;
}

export class Side implements View {
  readonly element: HTMLElement;
  private readonly svg: SVGSVGElement;
  private readonly outlines: Outline[] = [];
  private readonly sticks: Array<{ bone: Bone; line: SVGLineElement }> = [];
  private readonly marks: Array<{ dot: SVGElement; arrow: SVGElement | null; mark: ContactMark }> = [];
  private readonly past: SVGPolylineElement;
  private readonly dot: SVGCircleElement;
  /** Where the path to follow was left, drawn over the trail, and the arrow back to the path. */
  private readonly left: readonly Left[];
  private readonly off = drawing("path", { class: "side-left" });
  private readonly arrow = drawing("path", { class: "side-arrow" });
  /** The velocity of the TCP, and that which was commanded. */
  private readonly velocity: Velocity;
  private readonly moved = drawing("path", { class: "side-velocity" });
  private readonly wanted = drawing("path", { class: "side-wanted" });
  private moves = false;
  private readonly frames: Array<{ frame: Frame; group: SVGGElement; axes: Array<{ line: SVGLineElement; letter: SVGTextElement }>; name: SVGTextElement }> = [];
  private readonly tip = new Float64Array(3);
  private readonly labFixed: boolean;
  private readonly still: SVGGElement;
  private readonly trail: string[] = [];
  private readonly spot = new Float64Array(7);
  private readonly across: 0 | 1;
  private readonly up: 1 | 2;
  private readonly sign: number;
  private readonly unit: number;
  private first = true;
  private framesShown = false;
  private readonly box: readonly number[];
  drawnOver?: (project: Project) => void;

  constructor(
    private readonly replay: Scenery,
    private readonly world: Placed,
    extent: Extent,
    label: string,
  ) {
    this.across = extent.side === 0 ? 1 : 0;
    this.up = extent.side === 2 ? 1 : 2;
    this.sign = extent.flipped ? -1 : 1;
    this.unit = extent.radius;
    this.labFixed = replay.lab.node === null;
    const [low, high] = this.bounds(extent.hull);
    const margin = 0.06 * Math.max(high[0] - low[0], high[1] - low[1], 1e-3);
    const box = [low[0] - margin, low[1] - margin, high[0] - low[0] + 2 * margin, high[1] - low[1] + 2 * margin];
    this.box = box;
    const g = (name: string): SVGGElement => drawing("g", { class: name });
    const grid = g("side-grid");
    const fixed = g("side-fixed");
    const ghosts = g("side-ghost");
    const arm = g("side-arm");
    this.still = g("side-lab");
    const marks = g("side-marks");
    const frames = g("side-frames");
    frames.style.display = "none";
    this.svg = drawing("svg", { viewBox: box.map((v) => v.toFixed(5)).join(" "), class: "replay-side", role: "img", "aria-label": label, preserveAspectRatio: "xMidYMid meet" }, grid, fixed, this.still, arm, ghosts, marks, frames);
    this.element = element("div", { class: "replay-stage flat", tabindex: "0", role: "group", "aria-label": label });
    this.element.append(this.svg);

    const pitch = pitchFor(extent.radius);
    const reach = 2 * extent.radius;
    for (let i = Math.ceil((box[0] - reach) / pitch); i * pitch < box[0] + box[2] + reach; i++) grid.append(this.line(i * pitch, box[1] - reach, i * pitch, box[1] + box[3] + reach));
    for (let i = Math.ceil((box[1] - reach) / pitch); i * pitch < box[1] + box[3] + reach; i++) grid.append(this.line(box[0] - reach, i * pitch, box[0] + box[2] + reach, i * pitch));

    const colours = turns(replay.nodes);
    replay.nodes.forEach((node, index) => {
      for (const shape of hidden(replay, node) ? [] : node.shapes) {
        const path = drawing("path", { class: `side-shape ${colours[index]}` });
        (node.kind === "ghost" ? ghosts : node.kind === "fixed" ? fixed : arm).append(path);
        this.outlines.push({ path, node: index, balls: balls(shape, replay.meshes), moves: node.track >= 0 });
      }
    });
    for (const bone of bones(replay)) {
      const line = drawing("line", { class: `side-bone${bone.ghost ? " ghost" : ""}` });
      (bone.ghost ? ghosts : arm).append(line);
      this.sticks.push({ bone, line });
    }
    this.past = drawing("polyline", { class: "side-trail" });
    this.dot = drawing("circle", { class: "side-tcp", r: String(0.012 * this.unit) });
    this.left = left(replay);
    this.velocity = new Velocity(replay, extent.radius);
    this.drawLab();
    for (const mark of contactMarks(replay, MOST_CONTACTS)) {
      const [x, y] = this.flat(mark.point);
      const dot = drawing("circle", { class: "side-contact", cx: String(x), cy: String(y), r: String(0.014 * this.unit * mark.size) });
      const { force, point } = mark;
      const arrow = force ? drawing("path", { class: "side-force", d: this.arrowTo([x, y], this.flat(point.map((p, c) => p + LONGEST_FORCE * this.unit * force[c]))) }) : null;
      marks.append(dot);
      if (arrow) marks.append(arrow);
      this.marks.push({ dot, arrow, mark });
    }
    const size = String(0.045 * this.unit);
    const text = (words: string): SVGTextElement => {
      const made = drawing("text", { "font-size": size, "text-anchor": "middle", "dominant-baseline": "central" });
      made.textContent = words;
      return made;
    };
    for (const frame of namedFrames(replay)) {
      const axes = AXES.map((axis) => ({ line: drawing("line", { class: `side-axis ${axis}` }), letter: text(axis) }));
      const name = text(frame.name);
      const group = drawing("g", {}, ...axes.map(({ line }) => line), ...axes.map(({ letter }) => letter), name);
      frames.append(group);
      this.frames.push({ frame, group, axes, name });
    }
    this.draw();
    // what lies over the picture is in pixels
    new ResizeObserver(() => this.drawnOver && this.invalidate()).observe(this.element);
  }

  private bounds(points: Float64Array): [number[], number[]] {
    const low = [Infinity, Infinity];
    const high = [-Infinity, -Infinity];
    for (let i = 0; i < points.length; i += 4) {
      this.flat(points, i).forEach((value, c) => {
        low[c] = Math.min(low[c], value - points[i + 3]);
        high[c] = Math.max(high[c], value + points[i + 3]);
      });
    }
    return [low, high];
  }

  /** A point of the world in the picture, whose y points down. */
  private flat(p: ArrayLike<number>, o = 0): [number, number] {
    return [this.sign * p[o + this.across], -p[o + this.up]];
  }

  private fromLab(p: ArrayLike<number>, o = 0): [number, number] {
    place(this.spot, 0, this.world.lab, 0, p[o], p[o + 1], p[o + 2]);
    return this.flat(this.spot);
  }

  private line(x1: number, y1: number, x2: number, y2: number): SVGLineElement {
    return drawing("line", { x1: String(x1), y1: String(y1), x2: String(x2), y2: String(y2) });
  }

  private points(values: ArrayLike<number>): string[] {
    const out: string[] = [];
    for (let i = 0; i + 2 < values.length; i += 3) out.push(this.fromLab(values, i).map((v) => v.toFixed(5)).join(","));
    return out;
  }

  /** What is given in the lab frame: goals, paths, reference and trail. */
  private drawLab(): void {
    const { replay, still, unit } = this;
    still.replaceChildren();
    for (const path of replay.paths) {
      const points = this.points(path.points.flat()).join(" ");
      for (const [radius, name] of [[path.zero, "side-zero"], [path.full, "side-full"]] as const) {
        if (radius !== null && radius > 0) still.append(drawing("polyline", { class: `${name} side-tube`, points, "stroke-width": String(2 * radius) }));
      }
      still.append(drawing("polyline", { class: "side-path", points }));
    }
    for (const goal of replay.goals) {
      const [x, y] = this.fromLab(goal.position);
      for (const [radius, name] of [[goal.zero, "side-zero"], [goal.full, "side-full"], [0.01 * unit, "side-goal"]] as const) {
        if (radius !== null && radius > 0) still.append(drawing("circle", { class: name, cx: String(x), cy: String(y), r: String(radius) }));
      }
    }
    if (replay.reference) still.append(drawing("polyline", { class: "side-reference", points: this.points(replay.reference.path.values).join(" ") }));
    this.trail.length = 0;
    this.trail.push(...this.points(replay.tcp.values));
    still.append(drawing("polyline", { class: "side-future", points: this.trail.join(" ") }), this.past, this.off, this.arrow, this.wanted, this.moved, this.dot);
  }

  invalidate(): void {
    nextFrame(this.draw);
  }

  show(part: Part, on: boolean): void {
    if (part === "frames") {
      this.framesShown = on;
      this.invalidate();
    }
    if (part === "velocity") {
      this.moves = on;
      this.invalidate();
    }
    const name = part === "frames" ? ".side-frames" : part === "ghost" ? ".side-ghost" : null;
    const group = name ? this.svg.querySelector<SVGGElement>(name) : null;
    if (group) group.style.display = on ? "" : "none";
  }

  private readonly draw = (): void => {
    const { world } = this;
    if (!this.labFixed && !this.first) this.drawLab();
    for (const outline of this.outlines) if (this.first || outline.moves) outline.path.setAttribute("d", this.outline(outline));
    this.first = false;
    if (world.there) {
      for (const { path, node } of this.outlines) path.style.display = world.there(node) ? "" : "none";
      for (const { bone, line } of this.sticks) line.style.display = world.there(bone.to) ? "" : "none";
    }
    for (const { bone, line } of this.sticks) {
      const [x1, y1] = this.flat(world.poses, 7 * bone.from);
      reach(this.spot, world, bone);
      const [x2, y2] = this.flat(this.spot);
      for (const [name, value] of [["x1", x1], ["y1", y1], ["x2", x2], ["y2", y2]] as const) line.setAttribute(name, value.toFixed(5));
    }
    const [x, y] = this.flat(world.tcpInWorld);
    this.past.setAttribute("points", this.trail.slice(0, Math.floor(world.progress) + 1).join(" ") + ` ${x.toFixed(5)},${y.toFixed(5)}`);
    this.dot.setAttribute("cx", x.toFixed(5));
    this.dot.setAttribute("cy", y.toFixed(5));
    if (this.left.length > 0) this.drawLeft(x, y);
    const tick = world.t / this.replay.stepS;
    this.drawVelocities(x, y);
    for (const { dot, arrow, mark } of this.marks) {
      const cover = coverAt(mark, tick);
      dot.style.opacity = String(cover);
      if (arrow) arrow.style.display = cover > 0 ? "" : "none";
    }
    if (this.framesShown) for (const one of this.frames) this.drawFrame(one);
    this.drawnOver?.(this.project);
  };

  /** The trail where the path was left, and while it is, an arrow from the TCP to the path. */
  private drawLeft(x: number, y: number): void {
    const { world, trail, spot } = this;
    let d = "";
    const last = Math.floor(world.progress);
    for (const { off } of this.left) for (let k = 0; k < last; k++) if (off[k]) d += `${k > 0 && off[k - 1] ? "L" : `M${trail[k]}L`}${trail[k + 1]}`;
    this.off.setAttribute("d", d);
    const now = offAt(this.left, world.progress);
    this.arrow.style.display = now ? "" : "none";
    if (!now) return;
    nearest(spot, now.path, world.tcp);
    const [tx, ty] = this.fromLab([spot[0], spot[1], spot[2]]);
    this.arrow.setAttribute("d", this.arrowTo([x, y], [tx, ty]));
  }

  /** The path of an arrow in the picture; nothing where it has no length in it. */
  private arrowTo([x, y]: readonly [number, number], [tx, ty]: readonly [number, number]): string {
    if (Math.hypot(tx - x, ty - y) < 1e-6 * this.unit) return "";
    const way = Math.atan2(ty - y, tx - x);
    const barb = 0.035 * this.unit;
    const barbs = [2.7, -2.7].map((turn) => `M${tx} ${ty}L${tx + barb * Math.cos(way + turn)} ${ty + barb * Math.sin(way + turn)}`);
    return `M${x} ${y}L${tx} ${ty}${barbs.join("")}`;
  }

  private drawVelocities(x: number, y: number): void {
    const { world, velocity, tip } = this;
    const draw = (arrow: SVGPathElement, there: boolean): void => {
      if (there) velocity.tip(tip, world.tcp);
      arrow.setAttribute("d", there ? this.arrowTo([x, y], this.fromLab(tip)) : "");
    };
    if (this.moves) velocity.actual(tip, world.progress);
    draw(this.moved, this.moves);
    draw(this.wanted, this.moves && velocity.wanted(tip, world.progress));
  }

  private readonly project: Project = (out, p) => {
    const { clientWidth, clientHeight } = this.element;
    const [left, top, width, height] = this.box;
    // as preserveAspectRatio has it: whole, and in the middle
    const scale = Math.min(clientWidth / width, clientHeight / height);
    const [x, y] = this.flat(p);
    out[0] = 0.5 * clientWidth + scale * (x - left - 0.5 * width);
    out[1] = 0.5 * clientHeight + scale * (y - top - 0.5 * height);
    return true;
  };

  /** A frame's axes as they are seen from the side, and its name where they are not. */
  private drawFrame({ frame, axes, name }: Side["frames"][number]): void {
    const { spot, tip, unit } = this;
    this.world.frame(spot, frame.node, frame.pose);
    const [x, y] = this.flat(spot);
    let [across, down] = [0, 0];
    axes.forEach(({ line, letter }, c) => {
      const length = 0.16 * unit;
      place(tip, 0, spot, 0, c === 0 ? length : 0, c === 1 ? length : 0, c === 2 ? length : 0);
      const [tx, ty] = this.flat(tip);
      for (const [key, value] of [["x1", x], ["y1", y], ["x2", tx], ["y2", ty]] as const) line.setAttribute(key, value.toFixed(5));
      // an axis towards the eye is a point, which has no letter
      const seen = Math.hypot(tx - x, ty - y) > 0.3 * length;
      letter.style.display = seen ? "" : "none";
      letter.setAttribute("x", (x + 1.2 * (tx - x)).toFixed(5));
      letter.setAttribute("y", (y + 1.2 * (ty - y)).toFixed(5));
      across += tx - x;
      down += ty - y;
    });
    const length = Math.hypot(across, down) || 1;
    name.setAttribute("x", (x - (across / length) * 0.05 * unit).toFixed(5));
    name.setAttribute("y", (y - (down / length) * 0.05 * unit).toFixed(5));
    name.setAttribute("text-anchor", across > 0.3 * length ? "end" : across < -0.3 * length ? "start" : "middle");
  }

  private outline({ node, balls: own }: Outline): string {
    const points: Array<[number, number]> = [];
    for (let i = 0; i < own.length; i += 4) {
      place(this.spot, 0, this.world.poses, 7 * node, own[i], own[i + 1], own[i + 2]);
      const [x, y] = this.flat(this.spot);
      const r = own[i + 3];
      if (r === 0) points.push([x, y]);
      else for (let k = 0; k < ROUND; k++) points.push([x + r * Math.cos((2 * Math.PI * k) / ROUND), y + r * Math.sin((2 * Math.PI * k) / ROUND)]);
    }
    return "M" + hull(points).map(([x, y]) => `${x.toFixed(5)} ${y.toFixed(5)}`).join("L") + "Z";
  }
}
