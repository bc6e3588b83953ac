// What lies over the picture of an arm: the columns of its Jacobian as arrows, and the manipulability ellipse.

import type { ArmWorld } from "./arm_world";
import { drawing } from "./dom";
import type { Project } from "./view";

/** Joints that have a colour of their own. */
export const COLOURS = 6;
/** Points of an ellipse. */
const ROUND = 72;
/** An arrow shorter than this has no head and no name [px]. */
const SHORT = 7;
const HEAD = 11;
/** Height of a name, and width of a letter, roughly [px]. */
const LINE = 17;
const LETTER = 7.4;

interface Arrow {
  readonly group: SVGGElement;
  readonly shaft: SVGLineElement;
  readonly head: SVGPathElement;
  readonly name: SVGTextElement;
  readonly joint: number;
  readonly wide: number;
}

interface Box {
  readonly x: number;
  readonly y: number;
  readonly wide: number;
}

export class ArmMarks {
  readonly element = drawing("svg", { class: "arm-marks", "aria-hidden": "true" });
  jacobian = false;
  ellipse = false;
  private readonly arrows: Arrow[];
  private readonly rings: SVGPathElement[];
  private readonly spot: [number, number] = [0, 0];

  constructor(
    private readonly world: ArmWorld,
    /** Length of a velocity of 1 m/s \[m\]. */
    private readonly scale: number,
  ) {
    const { space, data } = world;
    // an ellipsoid is seen by the ellipses through two of its axes
    const pairs = space.basis.length === 3 ? 3 : 1;
    this.rings = Array.from({ length: pairs }, () => drawing("path", { class: "arm-ring" }));
    this.arrows = space.active.map((joint) => {
      const { name } = data.chain.q[joint];
      const made = {
        shaft: drawing("line"),
        head: drawing("path"),
        name: drawing("text", { "text-anchor": "middle", "dominant-baseline": "central" }),
      };
      made.name.textContent = name;
      const group = drawing("g", { class: `arm-arrow arm-colour-${joint % COLOURS}` }, made.shaft, made.head, made.name);
      return { ...made, group, joint, wide: 0.5 * LETTER * name.length + 4 };
    });
    this.element.append(...this.rings, ...this.arrows.map(({ group }) => group));
  }

  draw(project: Project): void {
    const { tcpInWorld } = this.world;
    const origin: [number, number] = [0, 0];
    const seen = project(origin, tcpInWorld);
    this.drawRings(project, seen && this.ellipse);
    const columns = this.jacobian ? this.world.columnsInWorld() : [];
    const taken: Box[] = [];
    const tips = this.arrows.map(({ joint }): readonly number[] => (this.jacobian ? [...this.at(project, columns[joint])] : origin));
    this.arrows.forEach((arrow, i) => {
      arrow.group.style.display = seen && this.jacobian ? "" : "none";
      if (this.jacobian) this.drawArrow(arrow, tips[i], origin, goesOn(tips[i], tips, origin), taken);
    });
  }

  private at(project: Project, direction: readonly number[]): [number, number] {
    const { tcpInWorld } = this.world;
    project(this.spot, direction.map((x, c) => tcpInWorld[c] + this.scale * x));
    return this.spot;
  }

  private drawArrow({ shaft, head, name, wide }: Arrow, [tipX, tipY]: readonly number[], [x, y]: readonly [number, number], covered: boolean, taken: Box[]): void {
    const length = Math.hypot(tipX - x, tipY - y);
    const [ux, uy] = length > 0 ? [(tipX - x) / length, (tipY - y) / length] : [0, 0];
    const long = length >= SHORT;
    const size = Math.min(HEAD, 0.6 * length);
    const set = (made: SVGElement, values: Record<string, number>): void => {
      for (const [key, value] of Object.entries(values)) made.setAttribute(key, value.toFixed(1));
    };
    set(shaft, { x1: x, y1: y, x2: tipX - 0.7 * size * ux, y2: tipY - 0.7 * size * uy });
    for (const made of [head, name]) made.style.display = long ? "" : "none";
    if (!long) return;
    const corner = (along: number, beside: number): string => `${(tipX - along * ux - beside * uy).toFixed(1)} ${(tipY - along * uy + beside * ux).toFixed(1)}`;
    head.setAttribute("d", `M${corner(0, 0)}L${corner(size, 0.45 * size)}L${corner(size, -0.45 * size)}Z`);
    // beyond the tip, or beside it where a longer arrow goes on there; inside of the picture, and not over another name
    const { clientWidth, clientHeight } = this.element;
    let at = covered ? { x: tipX - uy * (wide + 8), y: tipY + ux * LINE, wide } : { x: tipX + ux * (wide + 4), y: tipY + uy * LINE, wide };
    at.x = Math.min(clientWidth - wide, Math.max(wide, at.x));
    for (const other of taken) if (Math.abs(at.x - other.x) < wide + other.wide && Math.abs(at.y - other.y) < LINE) at = { ...at, y: other.y + (at.y < other.y ? -LINE : LINE) };
    at.y = Math.min(clientHeight - 0.5 * LINE, Math.max(0.5 * LINE, at.y));
    taken.push(at);
    set(name, { x: at.x, y: at.y });
  }

  private drawRings(project: Project, on: boolean): void {
    for (const ring of this.rings) ring.style.display = on ? "" : "none";
    if (!on) return;
    const axes = this.world.ellipse().axes.map((axis) => this.world.directionInWorld(axis));
    const pairs = [[0, 1], [0, 2], [1, 2]];
    this.rings.forEach((ring, k) => {
      const [a, b] = pairs[k].map((i) => axes[i] ?? [0, 0, 0]);
      const points = Array.from({ length: ROUND }, (_, i) => {
        const turn = (2 * Math.PI * i) / ROUND;
        const [x, y] = this.at(project, a.map((value, c) => Math.cos(turn) * value + Math.sin(turn) * b[c]));
        return `${x.toFixed(1)} ${y.toFixed(1)}`;
      });
      ring.setAttribute("d", `M${points.join("L")}Z`);
    });
  }
}

/** Whether another arrow of those from `origin` goes on behind a tip, so that it would run through what stands there. */
function goesOn(tip: readonly number[], tips: readonly (readonly number[])[], [x, y]: readonly number[]): boolean {
  const [dx, dy] = [tip[0] - x, tip[1] - y];
  const length = Math.hypot(dx, dy);
  return tips.some((other) => {
    const [ox, oy] = [other[0] - x, other[1] - y];
    const longer = Math.hypot(ox, oy);
    return other !== tip && longer > length && dx * ox + dy * oy > 0.9 * length * longer;
  });
}
