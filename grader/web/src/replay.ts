// One task's replay: its picture, controls, numbers and plots, all at one moment.

import { Announcer } from "./announce";
import { contactMarks } from "./contacts";
import { Controls } from "./controls";
import { Cursor, SPEEDS } from "./cursor";
import { isReference, type Replay as Data, type RunEvent } from "./data";
import { dock, framed } from "./docking";
import { element } from "./dom";
import { extent, type Extent } from "./extent";
import { mark } from "./icon";
import { listen } from "./keys";
import { lookout } from "./lookout";
import { left } from "./left";
import { Address, copy, format, shareable } from "./links";
import { plots, type Plot } from "./plots";
import { Readout } from "./readout";
import { Scrubber } from "./scrubber";
import { bring } from "./sections";
import { Side } from "./side";
import { Stage } from "./stage";
import type { Part, View } from "./view";
import { webgl } from "./webgl";
import { moment, seconds, eventWords } from "./words";
import { World } from "./world";

/** What a test sees of a replay. */
export interface Shown {
  readonly t: number;
  readonly tick: number;
  readonly tcp: number[];
  readonly q: number[];
  readonly nodes: Record<string, number[]>;
}

/** How a replay stands: for a page that is loaded anew. */
export interface State {
  readonly t: number;
  readonly speed: number;
  readonly loop: boolean;
  readonly parts: Record<Part, boolean>;
}

export class Replay {
  readonly cursor: Cursor;
  private readonly world: World;
  private readonly extent: Extent;
  private readonly announcer = new Announcer();
  private readonly scrubber: Scrubber;
  private readonly controls: Controls;
  private readonly readout: Readout;
  private readonly plots: Plot[];
  private readonly note = element("p", { class: "replay-note" });
  private readonly shared = element("p", { class: "replay-shared" });
  private readonly parts: Record<Part, boolean>;
  private view: View;
  /** The picture in space, while the flat one stands in its place by choice. */
  private spatial: View | null = null;
  /** Whether there is no picture in space. */
  private lost = false;
  private picture: HTMLImageElement | null = null;
  private quiet = false;

  constructor(
    private readonly root: HTMLElement,
    private readonly data: Data,
    private readonly address: Address,
  ) {
    this.cursor = new Cursor(data);
    // where velocities are commanded, they are what the task is about
    this.parts = { shadows: true, frames: false, ghost: true, velocity: data.wanted !== null };
    this.world = new World(data);
    const looked = new World(data);
    const size = extent(data, looked);
    this.extent = { ...size, look: lookout(data, looked, size) };
    this.view = this.open();
    this.view.show("velocity", this.parts.velocity);
    this.scrubber = new Scrubber(data, this.cursor, (event) => this.goTo(event));
    this.readout = new Readout(data, this.world);
    this.controls = new Controls(data, this.cursor, {
      event: (direction) => this.event(direction),
      copyLink: () => void this.copyLink(),
      view: () => this.view,
      show: (part, on) => {
        this.parts[part] = on;
        this.view.show(part, on);
      },
      shown: (part) => this.parts[part],
      flatten: this.extent.flat && this.view instanceof Stage ? (on) => this.flatten(on) : null,
      fullScreen: document.fullscreenEnabled ? () => this.fill() : null,
    });
    this.view.tooSlow = () => this.controls.show("shadows", false);
    this.note.hidden = true;
    this.shared.hidden = true;
    const ended = data.ended ? [element("p", { class: "replay-ended" }, `The run ended early: ${data.ended}`)] : [];
    root.append(
      framed(root, this.view.element),
      element("div", { class: "replay-beside" }, this.readout.element, this.legend()),
      element("div", { class: "replay-below" }, this.note, this.scrubber.element, this.controls.element, this.shared, ...ended),
      this.announcer.element,
    );
    root.setAttribute("role", "group");
    root.setAttribute("aria-label", `Replay: ${data.title}`);
    root.tabIndex = -1;
    dock(root);
    root.addEventListener("fullscreenchange", () => this.controls.filled(document.fullscreenElement === root));
    listen(root, this.cursor, (direction) => this.event(direction));
    this.plots = plots(data.task, this.cursor, this.world, data.stepS, {
      sought: () => this.announcer.say(this.here()),
      event: (direction) => this.event(direction),
      say: (text) => this.announcer.say(text),
    });
    this.cursor.on("moved", () => this.follow());
    this.cursor.on("rested", () => this.rest());
    this.cursor.on("ended", () => this.announcer.say(`${this.here()}, the end`));
    root.classList.add("on");
    if (this.view instanceof Side) {
      this.lost = true;
      this.sayFlat("This browser shows no WebGL");
    }
  }

  get task(): string {
    return this.data.task;
  }

  private open(): View {
    const label = "The run in 3D. Arrow keys turn the view, with Shift they move it, plus and minus zoom.";
    if (!webgl()) return this.side();
    return new Stage(this.data, this.world, this.extent, label, () => this.fall());
  }

  private side(): Side {
    return new Side(this.data, this.world, this.extent, "The run, seen from the side");
  }

  /** Takes the flat picture where the other one can no longer be had. */
  private fall(): void {
    if (this.lost) return;
    this.lost = true;
    if (this.view instanceof Side) {
      this.sayFlat("The 3D view was lost");
      return;
    }
    const before = this.view.element;
    const focused = before.contains(document.activeElement);
    this.view = this.side();
    for (const part of ["frames", "ghost", "velocity"] as const) this.view.show(part, this.parts[part]);
    before.replaceWith(this.view.element);
    if (focused) this.view.element.focus({ preventScroll: true });
    this.sayFlat("The 3D view was lost");
  }

  /** Shows the run flat, from the side, or in space again. */
  private flatten(on: boolean): void {
    if (this.lost || on === this.view instanceof Side) return;
    const before = this.view;
    const after = on ? this.side() : (this.spatial ?? before);
    if (on) this.spatial = before;
    this.view = after;
    for (const part of ["shadows", "frames", "ghost", "velocity"] as const) after.show(part, this.parts[part]);
    before.element.replaceWith(after.element);
    after.invalidate();
  }

  private sayFlat(why: string): void {
    this.note.textContent = `${why}, so the run is drawn flat, seen from the side.`;
    this.note.hidden = false;
    this.controls.flat(true);
  }

  private fill(): void {
    // a browser may refuse, and then nothing changes
    const done = document.fullscreenElement === this.root ? document.exitFullscreen() : this.root.requestFullscreen();
    done.catch(() => {});
  }

  /** What is drawn, with its colour and its kind of line. */
  private legend(): HTMLElement {
    const { data } = this;
    const items: HTMLElement[] = [];
    const item = (name: string, text: string): void => {
      items.push(element("li", {}, element("i", { class: `replay-swatch-${name}`, "aria-hidden": "true" }), text));
    };
    if (data.mainLabel) item("main", `run ${data.mainLabel}`);
    if (data.nodes.some((node) => node.kind === "ghost")) item("ghost", isReference(data) ? "the reference's arm" : `run ${data.ghostLabel}`);
    item("trail", "path of the TCP, thin where it is still to come");
    if (left(data).length > 0) item("left", "where it was farther from the path than earns all points, with an arrow to the path");
    if (data.wanted) {
      item("velocity", "velocity of the TCP, as an arrow");
      item("wanted", "velocity that was commanded");
    }
    if (contactMarks(data, data.contacts.length).some(({ force }) => force)) item("force", "force of the arm on what it touches, at its greatest");
    if (data.reference && data.reference.path.count > 1) item("reference", isReference(data) ? "the reference's path" : `path of run ${data.ghostLabel}`);
    if (data.goals.length) item("goal", data.goals.length > 1 ? "goals" : "goal");
    if (data.paths.length) item("path", "path to follow, and how far off still counts");
    const list = element("ul", { class: "replay-legend" }, ...items);
    for (const meaning of this.scrubber.meanings()) list.append(meaning);
    if (data.contacts.length && !data.events.some((event) => event.kind === "contact")) list.append(element("li", {}, mark("contact"), "contact"));
    return list;
  }

  private follow(): void {
    this.world.at(this.cursor.t);
    this.view.invalidate();
    // what is looked at is read at once; while it plays, as often as one reads
    if (this.cursor.playing) this.readout.follow();
    else this.readout.write();
    for (let i = 0; i < this.plots.length; i++) this.plots[i].follow();
  }

  private rest(): void {
    this.readout.write();
    this.shared.hidden = true;
    if (this.quiet) return;
    this.address.write(this.link());
    // who works here hears where the run is; the slider announces it by itself
    const at = document.activeElement;
    if (at && this.root.contains(at) && !at.matches("input")) this.announcer.soon(() => this.here());
  }

  /** Does something that changes neither the address nor what a screen reader announces. */
  quietly(act: () => void): void {
    this.quiet = true;
    act();
    this.quiet = false;
  }

  state(): State {
    const { rest, speed, loop } = this.cursor;
    return { t: rest, speed, loop, parts: { ...this.parts } };
  }

  /** Puts it as it stood. What comes from outside may be of another version, so each part is looked at. */
  restore(state: Partial<State>): void {
    const { t, speed, loop, parts } = state;
    this.quietly(() => {
      if (typeof t === "number") this.cursor.seek(t);
      if (SPEEDS.some((one) => one === speed)) this.cursor.setSpeed(speed!);
      if (typeof loop === "boolean") this.cursor.setLoop(loop);
      for (const part of Object.keys(this.parts) as Part[]) {
        const on = parts?.[part];
        if (typeof on === "boolean") this.controls.show(part, on);
      }
    });
  }

  private link(): string {
    return format(this.data.task, moment(this.cursor.t, this.data.stepS));
  }

  /** The moment and what happens in it, in words. */
  private here(): string {
    const now = this.cursor.now().slice(0, 2).map(eventWords);
    return [seconds(this.cursor.t, this.data.stepS), ...now].join(", ");
  }

  private event(direction: 1 | -1): void {
    const event = this.cursor.event(direction);
    if (event) this.goTo(event);
    else this.announcer.say(direction > 0 ? "no later event" : "no earlier event");
  }

  private goTo(event: RunEvent): void {
    this.cursor.seekTick(event.tick);
    this.announcer.say(this.here());
  }

  /** Goes to the moment of a link, and brings the replay where it can be seen. */
  visit(t: number | null, atOnce = false): void {
    this.cursor.pause();
    if (t !== null) this.cursor.seek(t);
    bring(this.root, atOnce);
    this.announcer.say(this.here());
  }

  private async copyLink(): Promise<void> {
    this.cursor.pause();
    this.address.write(this.link());
    this.address.flush();
    const link = shareable(location, this.link());
    const done = await copy(link);
    const words = done ? "Link copied" : "Copy this link";
    this.shared.replaceChildren(`${words}: `, element("code", {}, link));
    this.shared.hidden = false;
    this.announcer.say(words);
  }

  /** Puts a picture of the moment in the place of what does not print. */
  toPaper(): void {
    if (this.picture) return;
    const url = this.view.picture?.();
    if (!url) return;
    this.picture = element("img", { class: "replay-print", src: url, alt: `The run at ${this.here()}` });
    this.view.element.append(this.picture);
  }

  toScreen(): void {
    this.picture?.remove();
    this.picture = null;
  }

  shown(): Shown {
    const { world, data, cursor } = this;
    const nodes: Record<string, number[]> = {};
    data.nodes.forEach((node, n) => {
      // a ghost has the names of the arm it is the ghost of
      if (!(node.name in nodes)) nodes[node.name] = [...world.poses.subarray(7 * n, 7 * n + 7)];
    });
    return { t: cursor.t, tick: cursor.tick, tcp: [...world.tcp], q: [...world.q], nodes };
  }
}
