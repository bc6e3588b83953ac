// How much room a run takes in the world, and in which plane most of it happens.

import { balls, farthest } from "./balls";
import { bones, reach } from "./bones";
import { place } from "./pose";
import type { Placed } from "./world";
import type { Scenery } from "./data";

/** Moments at which the run is looked at. */
const MOMENTS = 32;
/** Points of a path that are looked at. */
const MOST_POINTS = 1500;
/** Motion that is less than this part of the run's size is none. */
const FLAT = 0.02;

/** How far aside of straight one looks at a run, and from how high \[rad\]. */
export interface Look {
  readonly turn: number;
  readonly elevation: number;
}

export interface Extent {
  /** Balls (x, y, z, radius in m) that hull everything worth seeing. */
  readonly hull: Float64Array;
  readonly centre: readonly [number, number, number];
  /** Half the diagonal of the box around it \[m\]. */
  readonly radius: number;
  /** Height of the ground \[m\]. */
  readonly ground: number;
  /** World axis along which the least happens. */
  readonly side: 0 | 1 | 2;
  /** Whether one looks along that axis from its other end, so that the lab's axis points to the right. */
  readonly flipped: boolean;
  /** Whether nothing moves along that axis, so that a flat picture shows all of it. */
  readonly flat: boolean;
  /** From where the whole is looked at, if not as usual. */
  readonly look?: Look;
}

/** A box that grows. */
class Box {
  readonly low = [Infinity, Infinity, Infinity];
  readonly high = [-Infinity, -Infinity, -Infinity];

  add(p: ArrayLike<number>, o = 0, r = 0): void {
    for (let c = 0; c < 3; c++) {
      this.low[c] = Math.min(this.low[c], p[o + c] - r);
      this.high[c] = Math.max(this.high[c], p[o + c] + r);
    }
  }

  get diagonal(): number {
    const d = Math.hypot(...this.high.map((high, c) => high - this.low[c]));
    return Number.isFinite(d) ? d : 0;
  }

  holds(p: ArrayLike<number>, o: number, margin: number): boolean {
    return [0, 1, 2].every((c) => p[o + c] >= this.low[c] - margin && p[o + c] <= this.high[c] + margin);
  }
}

export function extent(replay: Scenery, world: Placed): Extent {
  const { ticks, stepS, nodes, meshes } = replay;
  const local = nodes.map((node) => node.shapes.map((shape) => balls(shape, meshes)));
  const core: number[] = [];
  const other: number[] = [];
  const sticks = bones(replay);
  const tcp = new Box();
  const links = new Box();
  const spot = new Float64Array(3);
  const moments = Math.min(MOMENTS, ticks.length);
  const inLab = (p: ArrayLike<number>, o: number, r: number): void => {
    place(spot, 0, world.lab, 0, p[o], p[o + 1], p[o + 2]);
    core.push(spot[0], spot[1], spot[2], r);
  };
  for (let m = 0; m < moments; m++) {
    const frame = moments > 1 ? Math.round((m * (ticks.length - 1)) / (moments - 1)) : 0;
    world.at(ticks[frame] * stepS);
    nodes.forEach((node, n) => {
      if (m > 0 && node.track < 0) return;
      const arm = node.kind === "link" || node.kind === "ghost";
      for (const shape of local[n]) {
        for (let i = 0; i < shape.length; i += 4) {
          place(spot, 0, world.poses, 7 * n, shape[i], shape[i + 1], shape[i + 2]);
          (arm ? core : other).push(spot[0], spot[1], spot[2], shape[i + 3]);
          if (node.kind === "link") links.add(spot);
        }
      }
    });
    for (const bone of sticks) {
      const at = 7 * bone.from;
      core.push(world.poses[at], world.poses[at + 1], world.poses[at + 2], 0);
      reach(spot, world, bone);
      core.push(spot[0], spot[1], spot[2], 0);
      links.add(spot);
    }
    tcp.add(world.tcpInWorld);
    for (const goal of replay.goals) inLab(goal.position, 0, goal.full ?? 0);
    if (m === 0 || replay.lab.node !== null) {
      for (const path of replay.paths) for (const point of path.points) inLab(point, 0, path.full ?? 0);
      const reference = replay.reference?.path;
      for (const track of reference ? [replay.tcp, reference] : [replay.tcp]) {
        const stride = Math.ceil(track.count / MOST_POINTS);
        for (let i = 0; i < track.count; i += stride) inLab(track.values, 3 * i, 0);
      }
    }
  }
  const box = new Box();
  for (let i = 0; i < core.length; i += 4) box.add(core, i, core[i + 3]);
  // a floor of a kilometre, or a can that fell off the world, would make the rest a dot
  const margin = 0.35 * Math.max(box.diagonal, 1e-3);
  const near = other.length && box.diagonal > 0 ? new Box() : null;
  const all = [...core];
  for (let i = 0; i < other.length; i += 4) {
    if (!box.holds(other, i, margin)) continue;
    near?.add(other, i, other[i + 3]);
    all.push(other[i], other[i + 1], other[i + 2], other[i + 3]);
  }
  const whole = new Box();
  for (let i = 0; i < all.length; i += 4) whole.add(all, i, all[i + 3]);
  const centre = [0, 1, 2].map((c) => 0.5 * (whole.low[c] + whole.high[c])) as [number, number, number];
  const radius = Math.max(0.5 * whole.diagonal, 1e-3);
  const hull = new Float64Array(farthest(all, 4, 96).flatMap((i) => all.slice(4 * i, 4 * i + 4)));

  // the arm that stands still has no plane of motion, but it has one of its own
  const moved = tcp.diagonal > 1e-3 * radius ? tcp : links.diagonal > 0 ? links : whole;
  const span = moved.high.map((high, c) => high - moved.low[c]);
  // of two that are alike, the view along y is the usual one, and the view from above the last
  let side: 0 | 1 | 2 = 1;
  for (const c of [0, 2] as const) if (span[c] < span[side] - 1e-3 * radius) side = c;
  world.at(ticks[0] * stepS);
  const across = side === 0 ? 1 : 0;
  let strongest = 0;
  for (const axis of [[1, 0, 0], [0, 1, 0], [0, 0, 1]]) {
    place(spot, 0, [0, 0, 0, ...world.lab.subarray(3)], 0, axis[0], axis[1], axis[2]);
    if (Math.abs(spot[across]) > Math.abs(strongest) + 1e-6) strongest = spot[across];
  }
  const low = whole.low[2];
  return { hull, centre, radius, ground: low < -0.02 * radius ? low : 0, side, flipped: side !== 2 && strongest < -0.5, flat: span[side] < FLAT * radius };
}
