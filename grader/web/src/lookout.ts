// From where a run is looked at first: from where what counts at the marked moments is not hidden behind something.

import { balls, type Balls } from "./balls";
import type { Replay } from "./data";
import type { Extent, Look } from "./extent";
import { hull } from "./hull";
import { place } from "./pose";
import type { Placed } from "./world";

/** How far aside one stands and how high \[rad\], the usual one first. */
const UPRIGHT: readonly Look[] = [0.5, -0.5, 0.3, -0.3].flatMap((turn) => [{ turn, elevation: 0.36 }, { turn, elevation: 0.28 }]);
const LEVEL: readonly Look[] = [-0.5, 0.5].map((turn) => ({ turn, elevation: 0.65 }));
const MOST_MOMENTS = 12;

/** Directions of a picture: to the right, up, and to the eye. */
interface Axes {
  readonly right: readonly number[];
  readonly up: readonly number[];
  readonly back: readonly number[];
}

function axes(extent: Extent, { turn, elevation }: Look): Axes {
  const azimuth = (extent.side === 0 ? 0 : -Math.PI / 2) + (extent.flipped ? Math.PI : 0) + turn;
  const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)];
  return { right: [-sa, ca, 0], up: [-se * ca, -se * sa, ce], back: [ce * ca, ce * sa, se] };
}

const dot = (a: readonly number[], p: ArrayLike<number>): number => a[0] * p[0] + a[1] * p[1] + a[2] * p[2];

/** Whether a point lies in a convex outline. */
function holds(outline: ReadonlyArray<readonly [number, number]>, x: number, y: number): boolean {
  return outline.length > 2 && outline.every(([ax, ay], i) => {
    const [bx, by] = outline[(i + 1) % outline.length];
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0;
  });
}

/** How many of the points are hidden by what stands still, seen from there; all lie before it that are nearer to the eye. */
function hiddenFrom(view: Axes, points: readonly number[][], walls: readonly number[][][]): number {
  let count = 0;
  for (const wall of walls) {
    const outline = hull(wall.map((p) => [dot(view.right, p), dot(view.up, p)] as const));
    const middle = wall.reduce((sum, p) => sum + dot(view.back, p), 0) / wall.length;
    for (const p of points) if (dot(view.back, p) < middle && holds(outline, dot(view.right, p), dot(view.up, p))) count++;
  }
  return count;
}

/** The view of a run. */
export function lookout(replay: Replay, world: Placed, extent: Extent): Look {
  const { nodes, ticks, stepS, events, meshes } = replay;
  const moments = [...new Set([...events.map(({ tick }) => tick), ticks[ticks.length - 1]])];
  const stride = Math.ceil(moments.length / MOST_MOMENTS);
  const points: number[][] = [];
  // the last one is always among them: how it ended counts
  for (const tick of moments.reverse().filter((_, i) => i % stride === 0)) {
    world.at(tick * stepS);
    points.push([...world.tcpInWorld]);
    nodes.forEach((node, n) => node.kind === "free" && points.push([...world.poses.subarray(7 * n, 7 * n + 3)]));
  }
  world.at(ticks[0] * stepS);
  const corners = (own: Balls, n: number): number[][] => {
    const out: number[][] = [];
    const spot = new Float64Array(3);
    for (let i = 0; i < own.length; i += 4) {
      place(spot, 0, world.poses, 7 * n, own[i], own[i + 1], own[i + 2]);
      out.push([...spot]);
    }
    return out;
  };
  const walls = nodes.flatMap((node, n) => (node.kind === "fixed" && node.track < 0 ? node.shapes.map((shape) => corners(balls(shape, meshes), n)) : []));
  const choices = extent.side === 2 ? LEVEL : UPRIGHT;
  const costs = choices.map((look) => hiddenFrom(axes(extent, look), points, walls));
  return choices[costs.indexOf(Math.min(...costs))];
}
