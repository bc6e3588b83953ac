// The plots of a task: the cursor in each, the values under the pointer or at the cursor. Pointer and keys show other moments of the run;
// a click and Enter stay there. All plots of a task show the same stretch of time, which wheel, drag and keys change.

import { button } from "./button";
import { beyond } from "./costly";
import type { Cursor } from "./cursor";
import { drawing, element } from "./dom";
import { drawn, inside, middleOf, ofLine, pieces, spanAt, type Piece } from "./curve";
import { listen } from "./keys";
import { words } from "./reading";
import { Stretched } from "./stretched";
import { TimeWindow } from "./time_window";
import { seconds } from "./words";
import type { World } from "./world";

interface Series {
  readonly name: string;
  readonly colour: string;
  /** The dashes of its line, as `stroke-dasharray`. */
  readonly dashes?: string;
  /** How far above or below what is drawn a value may lie, in units of the picture. */
  readonly off?: number;
  /** How far a band reaches beyond its values, in units of the picture. */
  readonly pad?: number;
  /** The size at which values are cut off. */
  readonly cut?: number;
}

interface TimePanel {
  readonly kind: "time";
  /** left, top, right, bottom in units of the picture. */
  readonly box: readonly number[];
  readonly t: readonly number[];
  readonly y: readonly number[];
  readonly unit: string;
  /** Whether equal ways up are equal ratios. */
  readonly log?: boolean;
  /** Values that earn all points, and none, where it has one of each. */
  readonly full?: number;
  readonly zero?: number;
  /** What stands above it. */
  readonly name?: string;
  readonly series: readonly Series[];
}

interface PlanePanel {
  readonly kind: "plane";
  readonly box: readonly number[];
  readonly axes: readonly number[];
  readonly signs: readonly number[];
  readonly zero: readonly number[];
  readonly pixelsPerM: number;
}

type Panel = TimePanel | PlanePanel;

/** Rows of a box of values. */
const MOST_ROWS = 12;
const GAP = 12;
/** A pointer that moved less than this was not dragged \[px\]. */
const DRAG = 6;
/** How much one press of a key zooms. */
const ZOOM = 1.6;
/** Distance of the lines that hatch what costs points, in units of the picture. */
const HATCH = 70;
let hatches = 0;

const numbers = (value: unknown, count: number): value is number[] =>
  Array.isArray(value) && value.length === count && value.every((v) => typeof v === "number" && Number.isFinite(v));

function panels(text: string): Panel[] {
  const list: unknown = JSON.parse(text);
  if (!Array.isArray(list)) return [];
  return list.filter((panel): panel is Panel => {
    if (!panel || !numbers(panel.box, 4)) return false;
    if (panel.kind === "time") {
      return numbers(panel.t, 2) && panel.t[1] > panel.t[0] && numbers(panel.y, 2) && panel.y[1] !== panel.y[0] && (!panel.log || (panel.y[0] > 0 && panel.y[1] > 0)) && Array.isArray(panel.series);
    }
    return panel.kind === "plane" && numbers(panel.axes, 2) && numbers(panel.signs, 2) && numbers(panel.zero, 2) && typeof panel.pixelsPerM === "number";
  });
}

/** The cursor of one panel. */
interface Hand {
  readonly panel: Panel;
  readonly mark: SVGElement;
  x: number;
  y: number;
}

/** A line of the box of values. */
interface Row {
  readonly panel: TimePanel;
  readonly series: Series;
  /** Its height in the picture. */
  readonly at: number;
  readonly text: string;
}

/** What a plot asks of its replay. */
export interface Acts {
  /** After a click that sought. */
  readonly sought: () => void;
  readonly event: (direction: 1 | -1) => void;
  readonly say: (text: string) => void;
}

export class Plot {
  private readonly hands: Hand[] = [];
  private paths: Map<string, Piece[]> | null = null;
  private readonly curves = new Map<Series, Piece[]>();
  /** Whether the box stands at the cursor, for a reader without a pointer. */
  private held = false;
  private readonly box = element("div", { class: "replay-values", "aria-hidden": "true" });
  private hover: SVGElement | null = null;
  private readonly stretched: Array<{ panel: TimePanel; drawn: Stretched }> = [];
  private drag: { panel: TimePanel; x: number; clientX: number; moved: boolean } | null = null;
  private readonly picked = drawing("rect", { class: "replay-picked" });
  private readonly reset = button("Whole run", null, () => {
    this.window.reset();
    this.figure.focus({ preventScroll: true });
  });

  constructor(
    private readonly figure: HTMLElement,
    private readonly svg: SVGSVGElement,
    private readonly cursor: Cursor,
    private readonly world: World,
    private readonly stepS: number,
    private readonly window: TimeWindow,
    private readonly acts: Acts,
  ) {
    const overlay = drawing("g", { class: "replay-overlay", "aria-hidden": "true" });
    for (const panel of panels(figure.dataset.panels ?? "[]")) {
      const [, top, , bottom] = panel.box;
      const mark = panel.kind === "time"
        ? drawing("line", { class: "replay-cursor", x1: "0", x2: "0", y1: String(top), y2: String(bottom) })
        : drawing("circle", { class: "replay-dot", r: String(0.5 * this.unit()) });
      overlay.append(mark);
      this.hands.push({ panel, mark, x: NaN, y: NaN });
    }
    if (this.hands.length === 0) return;
    svg.append(overlay);
    figure.classList.add("replay-plot");
    this.box.hidden = true;
    figure.append(this.box);
    if (this.hands.some((hand) => hand.panel.kind === "time")) {
      const line = drawing("line", { class: "replay-hover" });
      line.style.visibility = "hidden";
      this.picked.style.visibility = "hidden";
      overlay.append(this.picked, line);
      this.hover = line;
      this.reset.classList.add("replay-reset");
      this.reset.hidden = true;
      figure.append(this.reset);
      window.on(() => this.stretch());
      svg.addEventListener("pointermove", (event) => this.point(event));
      svg.addEventListener("pointerdown", (event) => this.press(event));
      svg.addEventListener("pointerup", (event) => this.release(event));
      svg.addEventListener("dblclick", (event) => {
        window.reset();
        this.point(event);
      });
      svg.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
      figure.addEventListener("pointerleave", () => this.leave());
      svg.addEventListener("pointercancel", () => {
        this.drag = null;
        this.leave();
      });
      svg.addEventListener("click", (event) => this.click(event));
      this.byKeys();
    }
    this.follow();
    // what is hatched has words below the plot, which must not come later and move the page
    if (this.timePanels().some(({ full, zero }) => full !== undefined && zero !== undefined)) this.read();
  }

  /** Arrows seek, and the values at the cursor stand beside it and are said. */
  private byKeys(): void {
    const { figure, cursor } = this;
    figure.tabIndex = 0;
    figure.setAttribute("aria-description", "Arrow keys show other moments of the run and read out their values. Enter stays there; Escape, or leaving, goes back. Plus and minus zoom the time, 0 shows the whole run.");
    const look = (t: number): void => {
      cursor.pause();
      cursor.peek(t);
      this.window.hold(cursor.t);
    };
    figure.addEventListener("keydown", (event) => this.zoomKey(event));
    listen(figure, {
      start: cursor.start,
      end: cursor.end,
      get loop() {
        return cursor.loop;
      },
      step: (frames) => look(cursor.stepped(frames)),
      seek: look,
      toggle: () => cursor.toggle(),
      setLoop: (loop) => cursor.setLoop(loop),
    }, this.acts.event);
    // after the keys have done what they do
    let last = cursor.t;
    figure.addEventListener("keydown", (event) => {
      if (event.key === "Escape" || event.key === "Tab") return;
      if (event.key === "Enter" && event.target === figure) cursor.stay();
      this.stay();
      if (cursor.t !== last && !cursor.playing) this.acts.say(this.said());
      last = cursor.t;
    });
    figure.addEventListener("focus", () => figure.matches(":focus-visible") && this.stay());
    figure.addEventListener("blur", () => this.leave());
  }

  private stay(): void {
    this.held = true;
    this.beside();
  }

  private timePanels(): TimePanel[] {
    return this.hands.map((hand) => hand.panel).filter((panel) => panel.kind === "time");
  }

  /** Whether a check judged what it shows. */
  private get isJudged(): boolean {
    return this.timePanels().some(({ full }) => full !== undefined);
  }

  /** The box of all panels, at the cursor. */
  private beside(): void {
    const panels = this.timePanels();
    if (panels.length === 0) return;
    if (this.hover) this.hover.style.visibility = "hidden";
    this.write(this.cursor.t, panels.flatMap((panel) => this.rows(panel, this.cursor.t)), panels.length === 1 ? panels[0].name : undefined);
    const { top, bottom } = this.figure.getBoundingClientRect();
    this.place(this.seen(panels[0], this.cursor.t), 0.5 * (Math.max(0, top) + Math.min(innerHeight, bottom)));
  }

  /** The moment and all values there. */
  private said(): string {
    const { t } = this.cursor;
    const panels = this.timePanels();
    const values = panels.map((panel) => {
      const rows = this.rows(panel, t).map(({ series, text }) => `${series.name} ${text}`);
      return panels.length > 1 && panel.name ? `${panel.name}: ${rows.join(", ")}` : rows.join(", ");
    });
    return [seconds(t, this.stepS), ...values].join("; ");
  }

  /** Reads the picture, which takes its time, before anyone asks. */
  read(): void {
    if (this.paths) return;
    this.paths = drawn(this.svg);
    for (const panel of this.timePanels()) {
      const shaded = this.shade(panel);
      const still = new Stretched(this.svg, panel.box, panel.t);
      still.add(shaded);
      this.stretched.push({ panel, drawn: still });
      this.thin(panel, still);
    }
    if (this.window.shown) this.stretch();
  }

  /** The pieces of a series in its panel. */
  private curve(panel: TimePanel, series: Series): Piece[] {
    let curve = this.curves.get(series);
    if (!curve) this.curves.set(series, (curve = inside(ofLine(this.paths, series.colour, series.dashes ?? null), panel.box, this.unit())));
    return curve;
  }

  /** Hatches where the curve costs points, and says in words what is hatched. */
  private shade(panel: TimePanel): SVGElement[] {
    const { full, zero, series, box: [left, top, right, foot] } = panel;
    if (full === undefined || zero === undefined || full === zero || series.length === 0) return [];
    const share = panel.log ? Math.log(full / panel.y[0]) / Math.log(panel.y[1] / panel.y[0]) : (full - panel.y[0]) / (panel.y[1] - panel.y[0]);
    if (!Number.isFinite(share)) return [];
    const height = Math.min(foot, Math.max(top, foot - share * (foot - top)));
    const id = `hatch-${++hatches}`;
    const found = beyond(this.curve(panel, series[0]), height, zero > full);
    const areas = found.map(([from, to]) => {
      const [a, b] = [Math.max(left, from), Math.min(right, to)];
      return drawing("rect", { class: "replay-costly", x: a.toFixed(0), y: String(top), width: Math.max(10, b - a).toFixed(0), height: String(foot - top), fill: `url(#${id})` });
    });
    if (areas.length === 0) return [];
    const hatch = (): SVGElement => drawing("pattern", { id, width: String(HATCH), height: String(HATCH), patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)", class: "replay-hatch" }, drawing("rect", { width: String(HATCH), height: String(HATCH) }), drawing("line", { x1: "0", x2: "0", y1: "0", y2: String(HATCH) }));
    // below all lines, above the paper
    this.svg.querySelector("path")?.before(hatch(), ...areas);
    const swatch = drawing("svg", { class: "replay-swatch", viewBox: "0 0 280 160", width: "28", height: "16", "aria-hidden": "true" }, drawing("rect", { width: "280", height: "160", class: "replay-costly", fill: `url(#${id})` }));
    if (!this.figure.querySelector(".replay-costs")) this.figure.append(element("p", { class: "replay-costs" }, swatch, "hatched: beyond what earns all points"));
    return areas;
  }

  /** Where values go up and down faster than can be seen, lightens their band and draws the middle of it. */
  private thin(panel: TimePanel, still: Stretched): void {
    for (const path of this.svg.querySelectorAll<SVGPathElement>("path[opacity]")) {
      const series = panel.series.find(({ colour }) => colour.toUpperCase() === path.getAttribute("fill")?.toUpperCase());
      const bands = series ? inside(pieces(path.getAttribute("d") ?? "", true), panel.box, this.unit()) : [];
      if (!series || bands.length === 0) continue;
      path.classList.add("replay-band");
      const middle = drawing("path", { class: "replay-middle", fill: "none", stroke: series.colour, d: bands.map((band) => middleOf(band)).join("") });
      path.after(middle);
      still.take(middle);
    }
  }

  /** Draws all panels for the stretch of time that is shown. */
  private stretch(): void {
    this.read();
    const { shown } = this.window;
    for (const { drawn: still } of this.stretched) still.show(shown);
    this.reset.hidden = shown === null;
    for (const hand of this.hands) hand.x = NaN;
    this.follow();
  }

  /** The moments at the left and at the right end. */
  private range(panel: TimePanel): readonly number[] {
    return this.window.shown ?? panel.t;
  }

  private zoomKey(event: KeyboardEvent): void {
    if (event.target !== this.figure || event.ctrlKey || event.metaKey || event.altKey) return;
    const { window, cursor } = this;
    const acts: Record<string, () => void> = {
      "+": () => window.zoom(1 / ZOOM, cursor.t),
      "=": () => window.zoom(1 / ZOOM, cursor.t),
      "-": () => window.zoom(ZOOM, cursor.t),
      "0": () => window.reset(),
      // the whole run first, then its start
      ...(window.shown ? { Home: () => window.reset() } : {}),
    };
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  /** The wheel zooms with Ctrl, or after a click into the plot, so that a reader who scrolls is not caught. */
  private wheel(event: WheelEvent): void {
    if (!event.ctrlKey && !event.metaKey && document.activeElement !== this.figure) return;
    const found = this.under(event);
    if (!found) return;
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    this.window.zoom(Math.exp(Math.min(0.5, Math.max(-0.5, 0.002 * lines * event.deltaY))), this.time(found.panel, found.x));
    this.point(event);
  }

  private press(event: PointerEvent): void {
    const found = this.under(event);
    if (found && event.button === 0) this.drag = { panel: found.panel, x: found.x, clientX: event.clientX, moved: false };
    this.point(event);
  }

  /** Marks the stretch that is dragged over. */
  private pick(event: MouseEvent): void {
    const { drag, picked } = this;
    if (!drag || (event.buttons & 1) === 0) return;
    const found = this.under(event);
    if (Math.abs(event.clientX - drag.clientX) < DRAG || found?.panel !== drag.panel) return;
    drag.moved = true;
    const [, top, , bottom] = drag.panel.box;
    for (const [name, value] of [["x", Math.min(drag.x, found.x)], ["width", Math.abs(found.x - drag.x)], ["y", top], ["height", bottom - top]] as const) picked.setAttribute(name, value.toFixed(0));
    picked.style.visibility = "visible";
  }

  private release(event: PointerEvent): void {
    const { drag, picked } = this;
    picked.style.visibility = "hidden";
    if (!drag?.moved) return;
    const x = Number(picked.getAttribute("x"));
    const ends = [x, x + Number(picked.getAttribute("width"))].map((at) => this.time(drag.panel, at));
    this.window.show(ends[0], ends[1]);
    this.point(event);
  }

  /** Units of the picture in ten pixels as it was drawn. */
  private unit(): number {
    const width = Number(this.svg.getAttribute("width")) || 640;
    return (10 * (this.svg.viewBox.baseVal.width || width)) / width;
  }

  /** Puts the cursor where the moment is. */
  follow(): void {
    if (this.held) this.beside();
    for (let i = 0; i < this.hands.length; i++) {
      const hand = this.hands[i];
      const panel = hand.panel;
      let x: number;
      let y = 0;
      if (panel.kind === "time") {
        const [from, to] = this.range(panel);
        const slack = 0.001 * (to - from);
        hand.mark.style.visibility = this.cursor.t < from - slack || this.cursor.t > to + slack ? "hidden" : "";
        x = this.seen(panel, this.cursor.t);
      } else {
        x = panel.zero[0] + panel.signs[0] * this.world.tcp[panel.axes[0]] * panel.pixelsPerM;
        y = panel.zero[1] - panel.signs[1] * this.world.tcp[panel.axes[1]] * panel.pixelsPerM;
      }
      // a tenth of a unit is no pixel
      if (Math.abs(x - hand.x) < 0.1 && Math.abs(y - hand.y) < 0.1) continue;
      hand.x = x;
      hand.y = y;
      hand.mark.setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
    }
  }

  /** The panel under the pointer, and where in it, in units of the picture. */
  private under(event: PointerEvent | MouseEvent): { panel: TimePanel; x: number; y: number } | null {
    const matrix = this.svg.getScreenCTM();
    if (!matrix) return null;
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    const slack = this.unit();
    for (const { panel } of this.hands) {
      const [left, top, right, bottom] = panel.box;
      if (panel.kind !== "time" || at.x < left - slack || at.x > right + slack || at.y < top - slack || at.y > bottom + slack) continue;
      return { panel, x: Math.min(right, Math.max(left, at.x)), y: at.y };
    }
    return null;
  }

  private time(panel: TimePanel, x: number): number {
    const [left, , right] = panel.box;
    const [from, to] = this.range(panel);
    return from + ((x - left) / (right - left)) * (to - from);
  }

  /** Where a moment is seen, in the stretch that is shown. */
  private seen(panel: TimePanel, t: number): number {
    const [left, , right] = panel.box;
    const [from, to] = this.range(panel);
    return left + Math.min(1, Math.max(0, (t - from) / (to - from))) * (right - left);
  }

  /** Where a moment was drawn. */
  private across(panel: TimePanel, t: number): number {
    const [left, , right] = panel.box;
    const share = (t - panel.t[0]) / (panel.t[1] - panel.t[0]);
    return left + Math.min(1, Math.max(0, share)) * (right - left);
  }

  private click(event: MouseEvent): void {
    const found = this.under(event);
    const dragged = this.drag?.moved ?? false;
    this.drag = null;
    if (!found || dragged) return;
    this.cursor.seek(this.time(found.panel, found.x));
    this.acts.sought();
  }

  /** Hides the values, and leaves the moment that was only looked at. */
  leave(): void {
    if (!this.box.hidden) this.cursor.back();
    this.held = false;
    this.box.hidden = true;
    if (this.hover) this.hover.style.visibility = "hidden";
  }

  private point(event: MouseEvent): void {
    this.pick(event);
    const found = this.under(event);
    if (!found || !this.hover) {
      this.leave();
      return;
    }
    const { panel, x, y } = found;
    const [, top, , bottom] = panel.box;
    this.held = false;
    for (const [name, value] of [["x1", x], ["x2", x], ["y1", top], ["y2", bottom]] as const) this.hover.setAttribute(name, String(value));
    this.hover.style.visibility = "visible";
    const t = this.cursor.timeOf(Math.round(this.time(panel, x) / this.stepS));
    this.write(t, this.rows(panel, t), panel.name, y);
    this.place(x, event.clientY);
    this.cursor.peek(t);
  }

  /** What stands at a moment, a row for each line. */
  private rows(panel: TimePanel, t: number): Row[] {
    this.read();
    const [, top, , foot] = panel.box;
    const scale = { foot, top, low: panel.y[0], high: panel.y[1], log: panel.log ?? false };
    const x = this.across(panel, t);
    return panel.series.flatMap((series) => {
      const span = spanAt(this.curve(panel, series), x, series.pad ?? 0);
      if (!span) return [];
      const text = words(scale, span, { off: series.off ?? 1, cut: series.cut });
      return [{ panel, series, at: 0.5 * (span[0] + span[1]), text: panel.unit ? `${text}\u00a0${panel.unit}` : text }];
    });
  }

  /** Fills the box; of many rows, those near `y` are the ones that are pointed at. */
  private write(t: number, rows: Row[], name: string | undefined, y?: number): void {
    const more = rows.length - MOST_ROWS;
    if (more > 0) {
      if (y !== undefined) rows.sort((a, b) => Math.abs(a.at - y) - Math.abs(b.at - y));
      rows.length = MOST_ROWS;
    }
    rows.sort((a, b) => a.at - b.at);
    const head = element("p", { class: "replay-when" }, element("b", {}, seconds(t, this.stepS)));
    if (name) head.append(" ", element("bdi", { class: "quiet" }, String(name)));
    const lines = rows.map(({ panel, series, text }) => {
      const swatch = drawing("svg", { class: "plot replay-swatch", viewBox: "0 0 14 4" }, drawing("line", { x1: "0", x2: "14", y1: "2", y2: "2", stroke: String(series.colour), "stroke-width": "3", "stroke-dasharray": String(series.dashes ?? "none") }));
      const label = name || !panel.name ? String(series.name) : `${panel.name}: ${series.name}`;
      return element("p", {}, swatch, element("bdi", {}, label), element("span", {}, text));
    });
    // a check may judge a part of the run only
    if (lines.length === 0) lines.push(element("p", { class: "quiet" }, this.isJudged ? "not judged here" : "nothing is drawn here"));
    this.box.replaceChildren(head, ...lines);
    if (more > 0) this.box.append(element("p", { class: "quiet" }, `and ${more} more`));
  }

  /** Beside the line, on the side with room, and inside what is seen of the figure. */
  private place(x: number, clientY: number): void {
    const { box, figure, svg } = this;
    box.hidden = false;
    box.style.maxWidth = "";
    const frame = figure.getBoundingClientRect();
    const matrix = svg.getScreenCTM();
    if (!matrix) return;
    const line = x * matrix.a + matrix.e - frame.left - figure.clientLeft;
    const seen = figure.clientWidth;
    const right = seen - line - GAP;
    const left = line - GAP;
    const onRight = box.offsetWidth <= right || right >= left;
    box.style.maxWidth = `${Math.max(80, onRight ? right : left)}px`;
    const at = onRight ? line + GAP : line - GAP - box.offsetWidth;
    const height = figure.clientHeight;
    const y = Math.min(height - box.offsetHeight, Math.max(0, clientY - frame.top - 0.5 * box.offsetHeight));
    box.style.left = `${at + figure.scrollLeft}px`;
    box.style.top = `${Math.max(0, y) + figure.scrollTop}px`;
  }
}

/** Does what takes time when nothing else does, piece by piece. */
function idle(work: Array<() => void>): void {
  const next = (): void => {
    work.shift()?.();
    if (work.length) later(next);
  };
  const later = (act: () => void): unknown => (typeof requestIdleCallback === "function" ? requestIdleCallback(act) : setTimeout(act, 50));
  if (work.length) later(next);
}

/** The plots of a task on this page. A figure that cannot be read stays a picture. */
export function plots(task: string, cursor: Cursor, world: World, stepS: number, acts: Acts): Plot[] {
  const out: Plot[] = [];
  const window = new TimeWindow(0, cursor.end, stepS);
  for (const figure of document.querySelectorAll<HTMLElement>("figure[data-panels]")) {
    const svg = figure.querySelector("svg");
    if (figure.dataset.task !== task || !svg) continue;
    try {
      out.push(new Plot(figure, svg, cursor, world, stepS, window, acts));
    } catch {
      // the picture itself is there
    }
  }
  // paper has the whole run
  let shown: TimeWindow["shown"] = null;
  addEventListener("beforeprint", () => {
    shown = window.shown;
    window.reset();
  });
  addEventListener("afterprint", () => shown && window.show(...shown));
  idle(out.map((plot) => () => plot.read()));
  document.addEventListener("keydown", (event) => event.key === "Escape" && out.forEach((plot) => plot.leave()));
  return out;
}
