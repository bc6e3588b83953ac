// The buttons of a replay: those that play it, the menu of its picture, full screen, and the link of the moment.

import { button, group } from "./button";
import { SPEEDS, type Cursor } from "./cursor";
import type { Replay } from "./data";
import { element } from "./dom";
import { setIcon } from "./icon";
import type { Part } from "./view";
import { ViewMenu, type ViewActions } from "./view_menu";

export interface Actions extends ViewActions {
  event(direction: 1 | -1): void;
  copyLink(): void;
  /** Fills the screen, or stops; none where the browser cannot. */
  readonly fullScreen: (() => void) | null;
}

export class Controls {
  readonly element: HTMLElement;
  private readonly menu: ViewMenu;
  private readonly full: HTMLButtonElement | null;

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

    this.menu = new ViewMenu(replay, actions);
    this.full = actions.fullScreen && button("Full screen", "full", actions.fullScreen);
    const link = button("Copy link", "link", () => actions.copyLink(), null);

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
    const other = element("div", { class: "replay-group" }, this.menu.element, ...(this.full ? [this.full] : []), link);
    this.element = element("div", { class: "replay-controls" }, playback, other);
  }

  /** Shows a part or leaves it out, as its button does. */
  show(part: Part, on: boolean): void {
    this.menu.show(part, on);
  }

  /** Hides what only a camera can do. */
  flat(on: boolean): void {
    this.menu.flat(on);
  }

  /** Says whether the replay fills the screen. */
  filled(on: boolean): void {
    if (!this.full) return;
    this.full.title = on ? "Leave full screen (Escape)" : "Full screen";
    this.full.setAttribute("aria-label", this.full.title);
    setIcon(this.full, on ? "window" : "full");
  }
}
