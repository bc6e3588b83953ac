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
  /** Whether a part is shown. */
  shown(part: Part): boolean;
}

/** What the four arrows of the camera do. */
const ARROWS = [
  { sign: "left", turn: [-1, 0], name: "left" },
  { sign: "right", turn: [1, 0], name: "right" },
  { sign: "up", turn: [0, 1], name: "up" },
  { sign: "down", turn: [0, -1], name: "down" },
] as const;
const TURN = Math.PI / 12;
const SHIFT = 0.1;

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
  private readonly cameraOnly: HTMLElement[] = [];
  private readonly toggles = new Map<Part, HTMLButtonElement>();

  constructor(
    replay: Replay,
    cursor: Cursor,
    private readonly actions: Actions,
  ) {
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

    const toggle = (name: string, part: Part): HTMLButtonElement => {
      const made = button(name, null, () => this.show(part, !actions.shown(part)));
      made.setAttribute("aria-pressed", String(actions.shown(part)));
      this.toggles.set(part, made);
      return made;
    };
    const shadows = toggle("Shadows", "shadows");
    const shown = group("Show", toggle("Frames", "frames"), shadows);
    if (replay.nodes.some((node) => node.kind === "ghost")) shown.append(toggle(isReference(replay) ? "Reference arm" : `Run ${replay.ghostLabel}`, "ghost"));
    const views = this.camera(actions);
    this.cameraOnly.push(shadows, views);
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
    // a single moment has nothing to play
    if (!cursor.moves) for (const made of playback.querySelectorAll<HTMLButtonElement | HTMLSelectElement>("button, select")) made.disabled = true;
    this.element = element("div", { class: "replay-controls" }, playback, shown, views, group("Share", link));
  }

  /** The views, and what a drag of the pointer does, as buttons. */
  private camera(actions: Actions): HTMLElement {
    const view = (name: string, preset: Preset): HTMLButtonElement => button(name, null, () => actions.view().camera?.view(preset));
    const arrows = ARROWS.map(({ sign, turn: [x, y] }) =>
      button("", sign, () => {
        const camera = actions.view().camera;
        if (camera?.panning) camera.shift(SHIFT * x, SHIFT * y);
        else camera?.turn(TURN * x, TURN * y);
      }),
    );
    const move = button("Move", null, () => {
      const camera = actions.view().camera;
      if (!camera) return;
      camera.panning = !camera.panning;
      name(camera.panning);
    });
    move.title = "Whether the arrows, and a drag, move the view rather than turn it";
    const name = (panning: boolean): void => {
      move.setAttribute("aria-pressed", String(panning));
      arrows.forEach((arrow, i) => {
        arrow.title = `${panning ? "Move" : "Turn"} ${ARROWS[i].name}`;
        arrow.setAttribute("aria-label", arrow.title);
      });
    };
    name(false);
    const zoom = (name: string, sign: Sign, factor: number, keys: string): HTMLButtonElement => button(name, sign, () => actions.view().camera?.zoom(factor), keys);
    return group(
      "Camera",
      view("Fit", "fit"),
      view("Side", "side"),
      view("Top", "top"),
      ...arrows,
      move,
      zoom("Farther", "farther", 1.25, "− in the 3D view, or Ctrl and the wheel"),
      zoom("Closer", "closer", 0.8, "+ in the 3D view, or Ctrl and the wheel"),
    );
  }

  /** Shows a part or leaves it out, as its button does. */
  show(part: Part, on: boolean): void {
    this.actions.show(part, on);
    this.toggles.get(part)?.setAttribute("aria-pressed", String(on));
  }

  /** Hides what only a camera can do. */
  flat(on: boolean): void {
    for (const made of this.cameraOnly) made.hidden = on;
  }
}
