// The buttons of a replay.

import { SPEEDS, type Cursor } from "./cursor";
import { isReference, type Replay } from "./data";
import { element } from "./dom";
import { icon, setIcon, type Sign } from "./icon";
import type { Preset } from "./orbit";
import type { Part, View } from "./view";

export interface Actions {
  event(direction: 1 | -1): void;
  copyLink(): void;
  view(): View;
  show(part: Part, on: boolean): void;
}

function button(name: string, sign: Sign | null, act: () => void, keys?: string): HTMLButtonElement {
  const made = element("button", { type: "button", class: sign ? "replay-sign" : "replay-word" });
  if (sign) {
    made.setAttribute("aria-label", name);
    made.title = keys ? `${name} (${keys})` : name;
    made.append(icon(sign));
  } else made.append(name);
  made.addEventListener("click", act);
  return made;
}

function group(name: string, ...children: HTMLElement[]): HTMLElement {
  return element("div", { role: "group", "aria-label": name, class: "replay-group" }, ...children);
}

export class Controls {
  readonly element: HTMLElement;
  readonly views: HTMLElement;
  private readonly shadows: HTMLButtonElement;
  private readonly cameraOnly: HTMLElement[] = [];

  constructor(replay: Replay, cursor: Cursor, actions: Actions) {
    const play = button("Play", "play", () => cursor.toggle(), "space");
    play.classList.add("replay-play");
    const loop = button("Loop", "loop", () => cursor.setLoop(!cursor.loop), "L");
    const playback = group("Playback");
    if (replay.events.length > 0) playback.append(button("Previous event", "previous", () => actions.event(-1), "["));
    playback.append(
      button("One frame back", "back", () => cursor.step(-1), "left arrow"),
      play,
      button("One frame on", "on", () => cursor.step(1), "right arrow"),
    );
    if (replay.events.length > 0) playback.append(button("Next event", "next", () => actions.event(1), "]"));
    playback.append(loop);

    const speed = element("select", { "aria-label": "Speed" });
    for (const value of SPEEDS) {
      const option = element("option", { value: String(value) }, `${value}×`);
      option.selected = value === 1;
      speed.append(option);
    }
    speed.addEventListener("change", () => cursor.setSpeed(Number(speed.value)));
    playback.append(speed);

    const toggle = (name: string, part: Part, on: boolean): HTMLButtonElement => {
      const made = button(name, null, () => {
        const next = made.getAttribute("aria-pressed") !== "true";
        made.setAttribute("aria-pressed", String(next));
        actions.show(part, next);
      });
      made.setAttribute("aria-pressed", String(on));
      return made;
    };
    this.shadows = toggle("Shadows", "shadows", true);
    this.cameraOnly.push(this.shadows);
    const shown = group("Show", toggle("Frames", "frames", false), this.shadows);
    if (replay.nodes.some((node) => node.kind === "ghost")) shown.append(toggle(isReference(replay) ? "Ghost arm" : `Run ${replay.ghostLabel}`, "ghost", true));

    const camera = (name: string, preset: Preset): HTMLButtonElement => button(name, null, () => actions.view().camera?.view(preset));
    this.views = group(
      "Camera",
      camera("Fit", "fit"),
      camera("Side", "side"),
      camera("Top", "top"),
      button("Turn left", "left", () => actions.view().camera?.turn(-Math.PI / 12, 0)),
      button("Turn right", "right", () => actions.view().camera?.turn(Math.PI / 12, 0)),
      button("Farther", "farther", () => actions.view().camera?.zoom(1.25)),
      button("Closer", "closer", () => actions.view().camera?.zoom(0.8)),
    );
    this.cameraOnly.push(this.views);
    const link = button("Copy link", null, () => actions.copyLink());
    link.prepend(icon("link"));

    cursor.on("changed", () => {
      setIcon(play, cursor.playing ? "pause" : "play");
      play.setAttribute("aria-label", cursor.playing ? "Pause" : "Play");
      play.title = cursor.playing ? "Pause (space)" : "Play (space)";
      loop.setAttribute("aria-pressed", String(cursor.loop));
      speed.value = String(cursor.speed);
    });
    loop.setAttribute("aria-pressed", "false");
    this.element = element("div", { class: "replay-controls" }, playback, shown, this.views, group("Share", link));
  }

  /** Hides what only a camera can do. */
  flat(on: boolean): void {
    for (const made of this.cameraOnly) made.hidden = on;
  }
}
