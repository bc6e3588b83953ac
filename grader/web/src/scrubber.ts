// The time line: a slider over the run, and above it the marks of what happened.

import type { Cursor } from "./cursor";
import type { Replay, RunEvent } from "./data";
import { element } from "./dom";
import { EVENTS, mark } from "./icon";
import { lanes, MARK } from "./lanes";
import { Tip } from "./tip";
import { seconds, eventWords } from "./words";

/** Width of what is pressed to go to an event \[px\]. */
const TARGET = 28;
/** Height of the marks' row at least \[px\]. */
const LEAST_HEIGHT = 26;
/** Events in a tip. */
const MOST_EVENTS = 6;

export class Scrubber {
  readonly element: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly row = element("div", { class: "replay-events", role: "group", "aria-label": "Events" });
  private readonly targets = element("div", { class: "replay-targets" });
  private readonly marks = element("div", { class: "replay-marks" });
  private readonly tip = new Tip();
  private width = 0;

  constructor(
    private readonly replay: Replay,
    private readonly cursor: Cursor,
    private readonly chosen: (event: RunEvent) => void,
  ) {
    const first = replay.ticks[0];
    const last = replay.ticks[replay.ticks.length - 1];
    this.slider = element("input", {
      type: "range",
      class: "replay-slider",
      min: String(first),
      max: String(Math.max(last, first + 1)),
      step: "1",
      "aria-label": "Moment of the run",
    });
    this.slider.disabled = !cursor.moves;
    this.slider.addEventListener("input", () => cursor.seekTick(this.slider.valueAsNumber));
    // while it plays the words stand still, so they are those of now when one comes to it
    this.slider.addEventListener("focus", () => this.say());
    this.element = element("div", { class: "replay-time" });
    if (replay.events.length > 0) {
      this.row.append(this.marks, this.targets);
      this.element.append(this.row, this.tip.element);
      new ResizeObserver(() => this.layout()).observe(this.row);
    }
    this.element.append(this.slider);
    cursor.on("moved", () => this.follow());
    cursor.on("rested", () => this.say());
    this.follow();
    this.say();
  }

  private share(tick: number): number {
    const first = this.replay.ticks[0];
    const last = this.replay.ticks[this.replay.ticks.length - 1];
    return last > first ? Math.min(1, Math.max(0, (tick - first) / (last - first))) : 0;
  }

  private follow(): void {
    const tick = this.cursor.tick;
    this.slider.valueAsNumber = tick;
    this.slider.style.setProperty("--done", String(Math.round(1e4 * this.share(tick)) / 100) + "%");
  }

  private say(): void {
    const now = this.cursor.now().slice(0, 2).map((event) => event.text);
    this.slider.setAttribute("aria-valuetext", [seconds(this.cursor.t, this.replay.stepS), ...now].join(", "));
  }

  private layout(): void {
    const width = this.row.clientWidth;
    if (width === 0 || width === this.width) return;
    this.width = width;
    this.draw(width);
    this.target(width);
  }

  /** The marks, those of the same moment above each other. */
  private draw(width: number): void {
    const placed = lanes(this.replay.events.map(({ kind, tick }) => ({ kind, x: width * this.share(tick) })));
    const count = Math.max(1, ...placed.map(({ lane }) => lane + 1));
    const height = Math.max(LEAST_HEIGHT, count * (MARK + 1));
    this.row.style.height = `${height}px`;
    this.marks.replaceChildren(
      ...placed.map(({ kind, x, lane }) => {
        const sign = mark(kind);
        // in parts of the width, so that they hold on paper too
        sign.style.left = `${(100 * x) / width}%`;
        sign.style.top = `${0.5 * height + (0.5 * count - lane - 1) * (MARK + 1) + 0.5}px`;
        return sign;
      }),
    );
  }

  /** Buttons side by side, each for the events above it: none is too small and none lies on another. */
  private target(width: number): void {
    const bins = Math.max(1, Math.floor(width / TARGET));
    const filled = new Map<number, RunEvent[]>();
    for (const event of this.replay.events) {
      const bin = Math.min(bins - 1, Math.floor(this.share(event.tick) * bins));
      const held = filled.get(bin);
      if (held) held.push(event);
      else filled.set(bin, [event]);
    }
    const focused = this.targets.contains(document.activeElement);
    this.targets.replaceChildren();
    for (const [bin, events] of filled) {
      const button = element("button", { type: "button", tabindex: "-1", "aria-label": this.words(events).join("; ") });
      button.style.left = `${(100 * bin) / bins}%`;
      button.style.width = `${100 / bins}%`;
      button.addEventListener("click", (click) => this.choose(events, click));
      button.addEventListener("pointerenter", () => this.show(button, events));
      button.addEventListener("focus", () => {
        this.stop(button);
        this.show(button, events);
      });
      button.addEventListener("pointerleave", () => this.tip.leave());
      button.addEventListener("blur", () => this.tip.leave());
      button.addEventListener("keydown", (key) => this.key(key, button));
      this.targets.append(button);
    }
    const first = this.targets.firstElementChild;
    if (first instanceof HTMLElement) {
      this.stop(first);
      if (focused) first.focus();
    }
  }

  /** Makes one button the stop of the tabulator; arrows lead to the others. */
  private stop(button: HTMLElement): void {
    for (const other of this.targets.querySelectorAll<HTMLElement>("[tabindex='0']")) other.tabIndex = -1;
    button.tabIndex = 0;
  }

  private key(event: KeyboardEvent, button: HTMLButtonElement): void {
    const to = event.key === "ArrowRight" ? button.nextElementSibling : event.key === "ArrowLeft" ? button.previousElementSibling : null;
    if (event.key !== "ArrowRight" && event.key !== "ArrowLeft") return;
    event.preventDefault();
    event.stopPropagation();
    if (to instanceof HTMLElement) to.focus();
  }

  private choose(events: RunEvent[], click: MouseEvent): void {
    const tick = this.cursor.tick;
    let event = events.find((other) => other.tick > tick) ?? events[0];
    if (click.detail > 0) {
      const box = this.row.getBoundingClientRect();
      const at = (click.clientX - box.left) / box.width;
      for (const other of events) if (Math.abs(this.share(other.tick) - at) < Math.abs(this.share(event.tick) - at)) event = other;
    }
    this.chosen(event);
  }

  private words(events: readonly RunEvent[]): string[] {
    const said = events.slice(0, MOST_EVENTS).map((event) => `${seconds(this.cursor.timeOf(event.tick), this.replay.stepS)}, ${eventWords(event)}`);
    if (events.length > MOST_EVENTS) said.push(`and ${events.length - MOST_EVENTS} more`);
    return said;
  }

  private show(button: HTMLElement, events: readonly RunEvent[]): void {
    this.tip.show(this.words(events), button.offsetLeft + 0.5 * button.offsetWidth + this.row.offsetLeft);
  }

  /** What the marks mean: each kind that occurs, with its shape. */
  meanings(): HTMLElement[] {
    const kinds = [...new Set(this.replay.events.map((event) => event.kind))];
    return kinds.map((kind) => element("li", {}, mark(kind), EVENTS[kind].name));
  }
}
