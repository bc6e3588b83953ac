// A panel of a plot drawn for another stretch of time: what was drawn of it is moved sideways, and new numbers stand below.

import { pieces, type Piece } from "./curve";
import { drawing } from "./dom";

/** How high above a panel its numbered marks stand, and how far below it the numbers of its axis, in units of the picture. */
const ABOVE = 260;
const BELOW = 200;
/** How far a band may reach beyond its panel. */
const BEYOND = 20;
/** Steps of an axis that read well, and how many numbers it has at least. */
const STEPS = [1, 2, 5];
const LEAST_NUMBERS = 4;

let made = 0;

/** Moments of an axis, a round number apart, with their words. */
export function moments(from: number, to: number): Array<{ t: number; text: string }> {
  let step = 1;
  for (let power = 3; power >= -6; power--) {
    const fits = STEPS.slice().reverse().map((one) => one * 10 ** power).find((one) => (to - from) / one >= LEAST_NUMBERS);
    if (fits === undefined) continue;
    step = fits;
    break;
  }
  const digits = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
  const out = [];
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + 1e-9 * step; i++) out.push({ t: i * step, text: (i * step).toFixed(digits) });
  return out;
}

const attribute = (element: Element, name: string): number => Number(element.getAttribute(name));

export class Stretched {
  private readonly lines: Array<{ path: SVGElement; d: string; parts: Piece[]; closed: boolean }> = [];
  private readonly areas: Array<{ rect: SVGElement; x: number; width: number }> = [];
  private readonly marks: Array<{ x: number; parts: SVGElement[] }> = [];
  private readonly numbers: SVGElement[] = [];
  private readonly fresh = drawing("g", { class: "replay-numbers" });
  private readonly grid = drawing("path", { class: "replay-grid", fill: "none" });
  private readonly clip: string;

  constructor(
    svg: SVGSVGElement,
    private readonly box: readonly number[],
    private readonly t: readonly number[],
  ) {
    const [left, top, right, bottom] = box;
    this.clip = `stretch-${++made}`;
    const rect = drawing("rect", { x: String(left), y: String(top), width: String(right - left), height: String(bottom - top) });
    const all = [...svg.children].filter((one): one is SVGElement => one instanceof SVGElement && !one.classList.contains("replay-overlay"));
    const within = (x: number, y: number): boolean => this.within(x, y);
    for (const one of all) {
      if (one.tagName === "path") this.take(one);
      else if (one.tagName === "rect" && within(attribute(one, "x"), attribute(one, "y")) && attribute(one, "width") < right - left - 1) {
        this.areas.push({ rect: one, x: attribute(one, "x"), width: attribute(one, "width") });
      } else if (one.tagName === "text") {
        const [x, y] = [attribute(one, "x"), attribute(one, "y")];
        if (x >= left - 1 && x <= right + 1 && y > bottom && y < bottom + BELOW && Number.isFinite(Number(one.textContent?.replace("−", "-")))) this.numbers.push(one);
      }
    }
    for (const mark of this.marks) {
      const at = attribute(mark.parts[0], "data-at");
      for (const one of all) {
        const [x, y] = one.tagName === "circle" ? [attribute(one, "cx"), attribute(one, "cy")] : [attribute(one, "x"), attribute(one, "y")];
        if (["circle", "text"].includes(one.tagName) && Math.abs(x - at) < 2 && y < top && y > top - ABOVE) mark.parts.push(one);
      }
    }
    svg.append(drawing("clipPath", { id: this.clip }, rect));
    this.lines[0]?.path.before(this.grid);
    svg.append(this.fresh);
  }

  private within(x: number, y: number): boolean {
    const [left, top, right, bottom] = this.box;
    return x >= left - 1 && x <= right + 1 && y >= top - BEYOND && y <= bottom + BEYOND;
  }

  /** Takes a path along: a line or an area in the panel, or what leads from the number of a mark to its moment. */
  take(path: SVGElement): void {
    const [left, top, right, bottom] = this.box;
    const d = path.getAttribute("d") ?? "";
    const parts = pieces(d, false);
    const points = parts.flatMap(({ x, y }) => [...x].map((x, i) => [x, y[i]] as const));
    if (points.length === 0) return;
    const end = points[points.length - 1];
    // what leads from a number down to its moment
    if (points.length === 2 && points[0][1] < top - 1 && points[0][1] > top - ABOVE && Math.abs(end[1] - top) < 2) {
      path.setAttribute("data-at", String(points[0][0]));
      this.marks.push({ x: end[0], parts: [path] });
    } else if (points.every(([x, y]) => this.within(x, y))) {
      const corner = ([x, y]: readonly [number, number]): boolean => Math.min(Math.abs(x - left), Math.abs(x - right)) < 2 && Math.min(Math.abs(y - top), Math.abs(y - bottom)) < 2;
      const frame = parts.length === 1 && points.length >= 4 && points.every(corner);
      if (!frame) this.lines.push({ path, d, parts, closed: path.getAttribute("fill") !== "none" });
    }
  }

  /** Takes along areas that were drawn later. */
  add(rects: readonly SVGElement[]): void {
    for (const rect of rects) this.areas.push({ rect, x: attribute(rect, "x"), width: attribute(rect, "width") });
  }

  /** Draws the panel from one moment to another \[s\], or as it was drawn. */
  show(range: readonly [number, number] | null): void {
    const [left, , right] = this.box;
    const [start, end] = this.t;
    const whole = right - left;
    const [from, to] = range ?? [start, end];
    const lowest = left + ((from - start) / (end - start)) * whole;
    const scale = (end - start) / (to - from);
    const put = (x: number): number => left + (x - lowest) * scale;
    const inside = (x: number): boolean => x >= left - 1 && x <= right + 1;
    for (const { path, d, parts, closed } of this.lines) {
      path.setAttribute("d", range ? drawnAgain(parts, closed, put, left - whole, right + whole) : d);
      if (range) path.setAttribute("clip-path", `url(#${this.clip})`);
      else path.removeAttribute("clip-path");
    }
    for (const { rect, x, width } of this.areas) {
      const a = Math.min(right, Math.max(left, put(x)));
      const b = Math.min(right, Math.max(left, put(x + width)));
      rect.setAttribute("x", a.toFixed(0));
      rect.setAttribute("width", Math.max(0, b - a).toFixed(0));
    }
    for (const { x, parts } of this.marks) {
      const at = put(x);
      for (const part of parts) {
        if (range) part.setAttribute("transform", `translate(${(at - x).toFixed(0)} 0)`);
        else part.removeAttribute("transform");
        part.style.display = inside(at) ? "" : "none";
      }
    }
    this.write(range, from, to);
  }

  private write(range: readonly [number, number] | null, from: number, to: number): void {
    const [left, top, right, bottom] = this.box;
    for (const number of this.numbers) number.style.display = range ? "none" : "";
    this.fresh.replaceChildren();
    this.grid.setAttribute("d", "");
    if (!range) return;
    const ticks = moments(from, to).map(({ t, text }) => ({ x: Math.round(left + ((t - from) / (to - from)) * (right - left)), text }));
    this.grid.setAttribute("d", ticks.map(({ x }) => `M${x} ${top}V${bottom}`).join(""));
    for (const { x, text } of this.numbers.length ? ticks : []) {
      const copy = this.numbers[0].cloneNode() as SVGElement;
      copy.style.display = "";
      copy.setAttribute("x", String(x));
      copy.textContent = text;
      this.fresh.append(copy);
    }
  }
}

/** A path through the same points moved sideways; what lies far outside is left out of a line and drawn together in an area. */
function drawnAgain(parts: readonly Piece[], closed: boolean, put: (x: number) => number, low: number, high: number): string {
  let d = "";
  for (const { x, y } of parts) {
    const at = [...x].map(put);
    let open = false;
    for (let i = 0; i < at.length; i++) {
      const near = closed || (Math.max(at[i], at[i + 1] ?? at[i], at[i - 1] ?? at[i]) >= low && Math.min(at[i], at[i + 1] ?? at[i], at[i - 1] ?? at[i]) <= high);
      if (near) d += `${open ? "L" : "M"}${(closed ? Math.min(high, Math.max(low, at[i])) : at[i]).toFixed(1)} ${y[i]}`;
      open = near;
    }
    if (closed && at.length) d += "z";
  }
  return d;
}
