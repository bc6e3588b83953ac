// The time line: a slider over the run, and above it the marks of what happened.

import type { Cursor } from "./cursor";
import type { Replay, RunEvent } from "./data";
import { element } from "./dom";
import { EVENTS, mark } from "./icon";
import { seconds, told } from "./words";

/** Width of what is pressed to go to an event \[px\]. */
const TARGET = 28;
const MOST_MARKS = 400;
/** Events a tip tells. */
const MOST_TOLD = 6;

export class Scrubber {
  readonly element: HTMLElement;
  readonly slider: HTMLInputElement;
  private readonly row = element("div", { class: "replay-events", role: "group", "aria-label": "Events" });
  private readonly targets = element("div", { class: "replay-targets" });
  private readonly tip = element("div", { class: "replay-tip", role: "tooltip" });
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
    this.slider.addEventListener("input", () => {
      cursor.pause();
      cursor.seekTick(Number(this.slider.value));
    });
    this.tip.hidden = true;
    this.element = element("div", { class: "replay-time" });
    if (replay.events.length > 0) {
      let before = -1;
      for (const event of replay.events.slice(0, MOST_MARKS)) {
        const at = this.share(event.tick);
        // marks that would lie on each other are one
        if (at === before) continue;
        before = at;
        const sign = mark(event.kind);
        sign.style.left = `${100 * at}%`;
        this.row.append(sign);
      }
      this.row.append(this.targets);
      this.element.append(this.row, this.tip);
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

  /** Buttons side by side, each for the events above it: none is too small and none lies on another. */
  private layout(): void {
    const width = this.row.clientWidth;
    if (width === 0 || width === this.width) return;
    this.width = width;
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
      button.addEventListener("focus", () => this.show(button, events));
      button.addEventListener("pointerleave", () => (this.tip.hidden = true));
      button.addEventListener("blur", () => (this.tip.hidden = true));
      button.addEventListener("keydown", (key) => this.key(key, button));
      this.targets.append(button);
    }
    const first = this.targets.firstElementChild;
    if (first instanceof HTMLElement) {
      first.tabIndex = 0;
      if (focused) first.focus();
    }
  }

  /** One stop for the tabulator, and arrows between the marks. */
  private key(event: KeyboardEvent, button: HTMLButtonElement): void {
    if (event.key === "Escape") this.tip.hidden = true;
    const to = event.key === "ArrowRight" ? button.nextElementSibling : event.key === "ArrowLeft" ? button.previousElementSibling : null;
    if (event.key !== "ArrowRight" && event.key !== "ArrowLeft") return;
    event.preventDefault();
    event.stopPropagation();
    if (!(to instanceof HTMLElement)) return;
    button.tabIndex = -1;
    to.tabIndex = 0;
    to.focus();
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
    const said = events.slice(0, MOST_TOLD).map((event) => `${seconds(this.cursor.timeOf(event.tick), this.replay.stepS)}, ${told(event)}`);
    if (events.length > MOST_TOLD) said.push(`and ${events.length - MOST_TOLD} more`);
    return said;
  }

  private show(button: HTMLElement, events: readonly RunEvent[]): void {
    this.tip.replaceChildren(...this.words(events).map((line) => element("p", {}, line)));
    this.tip.hidden = false;
    const room = this.element.clientWidth - this.tip.offsetWidth;
    const middle = button.offsetLeft + 0.5 * button.offsetWidth + this.row.offsetLeft;
    this.tip.style.left = `${Math.max(0, Math.min(room, middle - 0.5 * this.tip.offsetWidth))}px`;
  }

  /** What the marks mean: each kind that occurs, with its shape. */
  meanings(): HTMLElement[] {
    const kinds = [...new Set(this.replay.events.map((event) => event.kind))];
    return kinds.map((kind) => element("li", {}, mark(kind), EVENTS[kind].name));
  }
}
