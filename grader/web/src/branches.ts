// Inverse kinematics of branches: all postures that bring the TCP where one posture has it.
//
// Newton's method from starts all over the joints' ranges, damped while it is far away: no formula of a certain arm, so it holds for any
// arm that reaches a place in a finite number of ways.

import { Posture, range, sizeOf, type Chain } from "./chain";
import { columnsInWorld } from "./jacobian";
import type { MotionSpace } from "./motion_space";

/** Starts along each joint, by how many joints there are. */
const STARTS = [0, 24, 12, 7];
const MOST_STEPS = 60;
/** A TCP this near is there, in sizes of the arm. */
const THERE = 1e-12;
/** Postures this near are one [rad, or sizes of the arm]. */
const SAME = 1e-4;

/** The other postures; `endless` where there is a whole curve of them. */
export interface Branches {
  readonly others: readonly (readonly number[])[];
  readonly endless: boolean;
}

/** Whether an arm reaches places in a finite number of ways, and whole turns of a joint change nothing, as they do where another mimics it. */
export function hasBranches(chain: Chain, { active, rank }: MotionSpace): boolean {
  const plain = chain.joints.every(({ q, gear, offset }) => q === null || (gear === 1 && offset === 0 && chain.joints.filter((other) => other.q === q).length === 1));
  return plain && active.length > 0 && active.length <= 3 && active.length === rank;
}

/** How many other postures there can be: two joints reach a place in at most two ways, three in at most four. */
export function mostOthers({ active }: MotionSpace): number {
  return active.length < 3 ? 1 : 3;
}

export class BranchFinder {
  private readonly at: Posture;
  private readonly size: number;

  constructor(
    private readonly chain: Chain,
    private readonly space: MotionSpace,
  ) {
    this.at = new Posture(chain);
    this.size = sizeOf(chain);
  }

  /** The postures other than `q` with its TCP, within the limits of the joints. Joints that do not move the TCP stay as they are. */
  find(q: ArrayLike<number>): Branches {
    const target = [...this.at.put(q).tcp];
    const here = Array.from(q);
    const found = [here];
    for (const start of this.starts(here)) {
      const reached = this.solve(start, target);
      const posture = reached && this.within(reached);
      if (!posture || found.some((other) => this.same(other, posture))) continue;
      found.push(posture);
      // more than there can be are infinitely many
      if (found.length > 1 + mostOthers(this.space)) return { others: [], endless: true };
    }
    return { others: found.slice(1), endless: false };
  }

  /** A grid over the active joints. */
  private *starts(here: readonly number[]): Generator<number[]> {
    const { active } = this.space;
    const each = STARTS[active.length];
    for (let k = 0; k < each ** active.length; k++) {
      const start = [...here];
      let rest = k;
      for (const i of active) {
        let [low, high] = range(this.chain, i);
        if (this.chain.q[i].unit === "rad" && high - low > 2 * Math.PI) [low, high] = [-Math.PI, Math.PI];
        start[i] = low + (high - low) * ((rest % each) + 0.5) / each;
        rest = Math.floor(rest / each);
      }
      yield start;
    }
  }

  /** Newton's method from `q`; nothing where it does not arrive. */
  private solve(q: number[], target: readonly number[]): number[] | null {
    const { at, size, space } = this;
    let damping = 0.1;
    let error = this.off(q, target);
    for (let step = 0; step < MOST_STEPS; step++) {
      const off = Math.hypot(...error);
      if (off <= THERE * size) return q;
      const columns = columnsInWorld(at);
      const moved = solveDamped(space.active.map((i) => columns[i]), error, damping * off * off);
      const next = [...q];
      space.active.forEach((i, k) => (next[i] += moved[k]));
      const after = this.off(next, target);
      if (Math.hypot(...after) < off) {
        [q, error] = [next, after];
        damping = Math.max(1e-9, 0.2 * damping);
      } else {
        this.off(q, target);
        damping = Math.max(1e-6, 8 * damping);
        if (damping > 1e8) return null;
      }
    }
    return null;
  }

  /** From the TCP at `q` to the target. */
  private off(q: readonly number[], target: readonly number[]): number[] {
    const { tcp } = this.at.put(q);
    return target.map((x, c) => x - tcp[c]);
  }

  /** The same posture with whole turns taken away, so that every joint is within its limits; nothing where that cannot be. */
  private within(q: readonly number[]): number[] | null {
    const out = [...q];
    for (const i of this.space.active) {
      const { unit, lower, upper } = this.chain.q[i];
      const fits = (x: number): boolean => (lower === null || x >= lower - 1e-9) && (upper === null || x <= upper + 1e-9);
      if (unit === "rad") {
        const turn = 2 * Math.PI;
        const near = out[i] - turn * Math.round(out[i] / turn);
        out[i] = [near, near - turn, near + turn].find(fits) ?? NaN;
      }
      if (!fits(out[i])) return null;
    }
    return out;
  }

  private same(a: readonly number[], b: readonly number[]): boolean {
    return this.space.active.every((i) => {
      const d = a[i] - b[i];
      if (this.chain.q[i].unit !== "rad") return Math.abs(d) < SAME * this.size;
      return Math.abs(d - 2 * Math.PI * Math.round(d / (2 * Math.PI))) < SAME;
    });
  }
}

/** The least-squares step of `columns` towards `error`, damped: (JᵀJ + λ 1)⁻¹ Jᵀ e, for up to three columns. */
function solveDamped(columns: readonly (readonly number[])[], error: readonly number[], damping: number): number[] {
  const n = columns.length;
  const dot = (a: readonly number[], b: readonly number[]): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const rows = columns.map((a, i) => [...columns.map((b, k) => dot(a, b) + (i === k ? damping + 1e-300 : 0)), dot(a, error)]);
  // Gauss with the largest pivot
  for (let i = 0; i < n; i++) {
    let pivot = i;
    for (let k = i + 1; k < n; k++) if (Math.abs(rows[k][i]) > Math.abs(rows[pivot][i])) pivot = k;
    [rows[i], rows[pivot]] = [rows[pivot], rows[i]];
    for (let k = i + 1; k < n; k++) {
      const factor = rows[k][i] / rows[i][i];
      for (let c = i; c <= n; c++) rows[k][c] -= factor * rows[i][c];
    }
  }
  const out = new Array<number>(n).fill(0);
  for (let i = n - 1; i >= 0; i--) {
    let left = rows[i][n];
    for (let k = i + 1; k < n; k++) left -= rows[i][k] * out[k];
    out[i] = left / rows[i][i];
  }
  return out;
}
