// The names of the frames and letters of their axes, over the picture or in it.

import { Vector3, type Camera } from "three";
import type { Frame } from "./data";
import { element } from "./dom";
import { place } from "./pose";
import type { Placed } from "./world";

/** Frames whose axes have letters; of more one would see letters only. */
const MOST_LETTERED = 6;
const AXES = ["x", "y", "z"] as const;
/** Room between a frame's origin and its name \[px\]. */
const GAP = 6;
/** Sides of an origin where its name may be, the preferred first. */
const WAYS = [[1, 1], [-1, 1], [1, -1], [-1, -1], [1, 0], [-1, 0], [0, 1], [0, -1]] as const;

interface Label {
  readonly element: HTMLElement;
  readonly text: string;
  readonly letter: boolean;
  /** Its middle \[px\], and half of its size. */
  x: number;
  y: number;
  half: readonly [number, number] | null;
  seen: boolean;
  /** Of a name, on which side of its origin it is. */
  way: number;
}

export class Labels {
  readonly element = element("div", { class: "replay-labels", "aria-hidden": "true" });
  private readonly names: Array<{ name: Label; letters: Label[] }>;
  private readonly lettered: boolean;
  private width = 1;
  private height = 1;
  private readonly point = new Vector3();
  private readonly spot = new Float64Array(7);
  private readonly end = new Float64Array(3);

  constructor(
    private readonly frames: readonly Frame[],
    /** How far from the origin the letters are \[m\]. */
    private readonly reach: number,
    private readonly world: Placed,
  ) {
    this.element.hidden = true;
    const lettered = frames.length <= MOST_LETTERED;
    this.names = frames.map((frame) => ({ name: this.label(frame.name, false), letters: AXES.map((letter) => this.label(letter, true)) }));
    for (const { letters } of lettered ? [] : this.names) for (const { element } of letters) element.remove();
    this.lettered = lettered;
  }

  private label(text: string, letter: boolean): Label {
    const made = element("span", letter ? { class: "replay-axis" } : {}, text);
    this.element.append(made);
    return { element: made, text, letter, x: 0, y: 0, half: null, seen: false, way: 0 };
  }

  /** Size of the picture \[px\]. */
  resize(width: number, height: number): void {
    this.width = width;
    this.height = height;
    // letters may be of another size now
    for (const { name } of this.names) name.half = null;
  }

  /** Puts all where the camera sees them. */
  place(camera: Camera): void {
    const { spot, end } = this;
    for (let f = 0; f < this.frames.length; f++) {
      const { name, letters } = this.names[f];
      this.world.frame(spot, this.frames[f].node, this.frames[f].pose);
      this.put(name, spot, camera);
      const [x, y] = [name.x, name.y];
      for (let c = 0; c < 3; c++) {
        place(end, 0, spot, 0, c === 0 ? this.reach : 0, c === 1 ? this.reach : 0, c === 2 ? this.reach : 0);
        this.put(letters[c], end, camera);
        this.move(letters[c]);
      }
      this.besides(name, x, y, letters);
      this.move(name);
    }
  }

  /** Puts a name around its origin where it is farthest from the axes, and stays there while that is nearly so. */
  private besides(name: Label, x: number, y: number, letters: readonly Label[]): void {
    name.half ??= [0.5 * name.element.offsetWidth + GAP, 0.5 * name.element.offsetHeight + GAP];
    const [wide, high] = name.half;
    let best = -Infinity;
    let found = name.way;
    for (let way = 0; way < WAYS.length; way++) {
      const [atX, atY] = [x + WAYS[way][0] * wide, y + WAYS[way][1] * high];
      // how far each letter is outside of the name's box, or inside where negative; and the middle of its axis
      let free = way === name.way ? GAP : 0;
      let least = Infinity;
      for (const letter of letters) {
        for (const part of [0.5, 1]) {
          const across = Math.abs(x + part * (letter.x - x) - atX) - wide;
          const down = Math.abs(y + part * (letter.y - y) - atY) - high;
          least = Math.min(least, Math.max(across, down));
        }
      }
      free += Math.min(least, 3 * GAP);
      if (free > best) {
        best = free;
        found = way;
      }
    }
    name.way = found;
    name.x = x + WAYS[found][0] * wide;
    name.y = y + WAYS[found][1] * high;
  }

  private put(label: Label, p: Float64Array, camera: Camera): void {
    const { point } = this;
    point.set(p[0], p[1], p[2]).project(camera);
    label.seen = point.z <= 1;
    label.x = 0.5 * (1 + point.x) * this.width;
    label.y = 0.5 * (1 - point.y) * this.height;
  }

  private move({ element, x, y, seen }: Label): void {
    element.style.visibility = seen ? "visible" : "hidden";
    element.style.transform = `translate(${x.toFixed(1)}px,${y.toFixed(1)}px) translate(-50%,-50%)`;
  }

  /** A picture with the labels in it, dark on white, as data. */
  onto(picture: HTMLCanvasElement): string | null {
    const paper = element("canvas");
    paper.width = picture.width;
    paper.height = picture.height;
    const draw = paper.getContext("2d");
    if (!draw) return null;
    draw.drawImage(picture, 0, 0);
    const scale = picture.width / this.width;
    Object.assign(draw, { textAlign: "center", textBaseline: "middle", lineJoin: "round", strokeStyle: "#fff", fillStyle: "#1c222c", lineWidth: 4 * scale });
    for (const { name, letters } of this.names) {
      for (const { text, x, y, seen, letter } of [...(this.lettered ? letters : []), name]) {
        if (!seen) continue;
        draw.font = `${letter ? 600 : 400} ${12 * scale}px sans-serif`;
        draw.strokeText(text, x * scale, y * scale);
        draw.fillText(text, x * scale, y * scale);
      }
    }
    return paper.toDataURL("image/png");
  }
}
