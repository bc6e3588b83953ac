// A robot that the reader of a brief moves: a slider for each joint, the picture, and what kinematics says of the posture.

import type { ArmData } from "./arm_data";
import { ArmJoint } from "./arm_joint";
import { ArmMarks } from "./arm_marks";
import { ArmWorld } from "./arm_world";
import { element } from "./dom";
import { verdict } from "./ellipse";
import { extent, type Extent } from "./extent";
import { Side } from "./side";
import { Stage } from "./stage";
import type { View } from "./view";
import { webgl } from "./webgl";
import { fixed } from "./words";

/** What a test sees of an arm. */
export interface ShownArm {
  readonly q: number[];
  readonly tcp: number[];
  readonly poses: Record<string, number[]>;
  readonly others: number[][];
  readonly jacobian: number[][];
  readonly manipulability: number | null;
}

type Switch = "branches" | "jacobian" | "ellipse";

export class LiveArm {
  private readonly world: ArmWorld;
  private readonly extent: Extent;
  private readonly marks: ArmMarks;
  private readonly joints: ArmJoint[];
  private readonly tcp: HTMLElement[] = [];
  private readonly q: HTMLElement[] = [];
  private readonly scale: number;
  private readonly said = new Map<Switch, HTMLElement>();
  private readonly on: Record<Switch, boolean>;
  private readonly note = element("p", { class: "replay-note" });
  private readonly views: HTMLElement;
  private view: View;

  constructor(root: HTMLElement, private readonly data: ArmData) {
    const world = new ArmWorld(data);
    this.world = world;
    this.extent = extent(world.scenery, world);
    this.scale = world.velocityScale();
    this.marks = new ArmMarks(world, this.scale);
    this.on = { branches: data.branches && world.hasBranches, jacobian: data.jacobian, ellipse: false };
    this.joints = data.chain.q.map((_, i) => new ArmJoint(data.chain, i, (value) => this.put([...world.q].map((old, k) => (k === i ? value : old)))));
    this.note.hidden = true;
    this.views = this.cameraButtons();
    this.view = this.open();
    const sliders = element("div", { class: "arm-joints", role: "group", "aria-label": "Joints" }, ...this.joints.map((joint) => joint.element));
    root.append(
      this.view.element,
      element("div", { class: "replay-beside" }, this.readout(), this.words()),
      element("div", { class: "replay-below" }, this.note, sliders, this.controls()),
    );
    root.setAttribute("role", "group");
    root.setAttribute("aria-label", `The arm ${data.name}, which you can move`);
    root.classList.add("replay", "on");
    this.marks.jacobian = this.on.jacobian;
    world.seekBranches(this.on.branches);
    this.put(world.start());
    if (this.view instanceof Side) this.sayFlat("This browser shows no WebGL");
  }

  private open(): View {
    const { scenery } = this.world;
    // a plane is best seen from in front of it
    const preset = this.world.space.basis.length < 3 ? "side" : "fit";
    const label = "The arm in 3D. Arrow keys turn the view, with Shift they move it, plus and minus zoom.";
    return this.ready(webgl() ? new Stage(scenery, this.world, this.extent, label, () => this.fall(), preset) : this.side());
  }

  private side(): Side {
    return new Side(this.world.scenery, this.world, this.extent, "The arm, seen from the side");
  }

  private ready(view: View): View {
    view.drawnOver = (project) => this.marks.draw(project);
    view.element.append(this.marks.element);
    view.show("frames", true);
    view.invalidate();
    return view;
  }

  /** Takes the flat picture where the other one can no longer be had. */
  private fall(): void {
    if (this.view instanceof Side) return;
    const before = this.view.element;
    this.view = this.ready(this.side());
    before.replaceWith(this.view.element);
    this.sayFlat("The 3D view was lost");
  }

  private sayFlat(why: string): void {
    this.note.textContent = `${why}, so the arm is drawn flat, seen from the side.`;
    this.note.hidden = false;
    this.views.hidden = true;
  }

  /** Puts the arm at joint positions. */
  put(q: ArrayLike<number>): void {
    this.world.put(q);
    this.write();
    this.view.invalidate();
  }

  private readout(): HTMLElement {
    const table = (caption: string, name: string): HTMLElement => element("table", { "data-readout": name }, element("caption", {}, caption));
    const row = (into: HTMLElement, name: string, unit: string, list: HTMLElement[]): void => {
      const value = element("span");
      list.push(value);
      into.append(element("tr", {}, element("th", { scope: "row" }, element("bdi", {}, name)), element("td", {}, value), element("td", {}, unit)));
    };
    const tcp = table(`TCP in the frame ${this.data.labName}`, "tcp");
    for (const axis of ["x", "y", "z"]) row(tcp, axis, "m", this.tcp);
    const q = table("Joint positions q", "q");
    this.data.chain.q.forEach(({ name, unit }) => row(q, name, unit, this.q));
    return element("div", { class: "replay-readout" }, tcp, q);
  }

  /** A sentence for each switch that is on. */
  private words(): HTMLElement {
    const list = element("div", { class: "arm-words" });
    for (const name of ["branches", "jacobian", "ellipse"] as const) {
      const made = element("p", { "data-arm-words": name });
      this.said.set(name, made);
      list.append(made);
    }
    return list;
  }

  private controls(): HTMLElement {
    const shown = element("div", { role: "group", "aria-label": "Show", class: "replay-group" });
    const add = (name: Switch, words: string): void => {
      const made = element("button", { type: "button", class: "replay-word", "data-switch": name, "aria-pressed": String(this.on[name]) }, words);
      made.addEventListener("click", () => {
        this.on[name] = !this.on[name];
        made.setAttribute("aria-pressed", String(this.on[name]));
        this.marks.jacobian = this.on.jacobian;
        this.marks.ellipse = this.on.ellipse;
        if (name === "branches") this.world.seekBranches(this.on.branches);
        this.put(this.world.q);
      });
      shown.append(made);
    };
    if (this.world.hasBranches) add("branches", "Other branches");
    if (this.world.space.active.length > 0) add("jacobian", "Columns of the Jacobian");
    if (this.world.hasEllipse) add("ellipse", "Manipulability");
    const back = element("button", { type: "button", class: "replay-word" }, "Back to the start");
    back.addEventListener("click", () => this.put(this.world.start()));
    return element("div", { class: "replay-controls" }, shown, this.views, back);
  }

  private cameraButtons(): HTMLElement {
    const group = element("div", { role: "group", "aria-label": "View", class: "replay-group" });
    for (const [words, preset] of [["Side", "side"], ["Above", "top"], ["Slanted", "fit"]] as const) {
      const made = element("button", { type: "button", class: "replay-word" }, words);
      made.addEventListener("click", () => this.view.camera?.view(preset));
      group.append(made);
    }
    return group;
  }

  private write(): void {
    const { world, said } = this;
    for (let c = 0; c < 3; c++) this.tcp[c].textContent = fixed(world.tcp[c], 4);
    world.q.forEach((value, i) => {
      this.q[i].textContent = fixed(value, 4);
      this.joints[i].show(value);
    });
    const words: Record<Switch, () => string> = {
      branches: () => this.branchWords(),
      jacobian: () => `Arrows: how the TCP moves while one joint alone moves at ${this.speeds()}. 1 m/s is drawn ${this.scale} m long.`,
      ellipse: () => this.ellipseWords(),
    };
    for (const [name, place] of said) {
      place.hidden = !this.on[name];
      if (this.on[name]) place.textContent = words[name]();
    }
  }

  private speeds(): string {
    const units = new Set(this.data.chain.q.map(({ unit }) => `1 ${unit}/s`));
    return [...units].join(" or ");
  }

  private branchWords(): string {
    const { others, endless } = this.world.branches;
    if (endless) return "Other branches: infinitely many postures have this TCP.";
    if (others.length === 0) return "Other branches: none. Only this posture has this TCP.";
    const count = others.length === 1 ? "one more posture has" : `${others.length} more postures have`;
    return `Other branches: ${count} the same TCP, drawn translucent.`;
  }

  private ellipseWords(): string {
    const found = this.world.ellipse();
    const word = verdict(found);
    const means = {
      singular: "singular: there is a direction in which the TCP cannot move",
      "nearly singular": "nearly singular: in one direction the TCP moves slowly",
      "not singular": "not singular: the TCP can move in every direction",
    }[word];
    const where = this.world.space.basis.length === 3 ? "ellipsoid" : "ellipse";
    return `Manipulability √det(J Jᵀ) = ${fixed(found.manipulability, 4)}, ${means}. The ${where} has all velocities of the TCP for joint speeds of length 1.`;
  }

  shown(): ShownArm {
    const { world, data } = this;
    const poses: Record<string, number[]> = {};
    data.nodes.forEach(({ name }, n) => (poses[name] ??= [...world.poses.subarray(7 * n, 7 * n + 7)]));
    return {
      q: [...world.q],
      tcp: [...world.tcp],
      poses,
      others: world.branches.others.map((other) => [...other]),
      jacobian: world.columns(),
      manipulability: world.hasEllipse ? world.ellipse().manipulability : null,
    };
  }
}
