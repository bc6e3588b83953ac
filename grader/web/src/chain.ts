// Forward kinematics of a tree of joints: where every link is at joint positions `q`, and which way every axis points.

import { compose, normalize, place } from "./pose";

export interface ChainJoint {
  /** Nodes that it joins; a joint stands in the list behind that of its parent. */
  readonly parent: number;
  readonly child: number;
  /** Pose of the child in the parent where the joint is at zero. */
  readonly pose: readonly number[];
  /** Axis in the child, of length 1. */
  readonly axis: readonly number[];
  readonly turns: boolean;
  /** Its entry in `q`; none where it is fixed. */
  readonly q: number | null;
  /** Its position is `gear * q + offset`: other than 1 and 0 where it mimics another joint. */
  readonly gear: number;
  readonly offset: number;
}

/** A frame that is fixed to a node. */
export interface Mount {
  readonly node: number;
  readonly pose: readonly number[];
}

/** One entry of `q`. */
export interface Position {
  readonly name: string;
  readonly unit: string;
  readonly lower: number | null;
  readonly upper: number | null;
}

export interface Chain {
  /** How many nodes there are; the first is fixed to the world. */
  readonly count: number;
  readonly joints: readonly ChainJoint[];
  readonly q: readonly Position[];
  readonly tcp: Mount;
  readonly lab: Mount;
}

const WORLD = [0, 0, 0, 1, 0, 0, 0];

/** A chain at joint positions. */
export class Posture {
  readonly q: Float64Array;
  /** Pose of every node in the world, seven numbers each. */
  readonly poses: Float64Array;
  /** Unit axis of every joint in the world. */
  readonly axes: Float64Array;
  /** TCP in the world \[m\], and the pose of the lab frame there. */
  readonly tcp = new Float64Array(3);
  readonly lab = new Float64Array(7);
  private readonly moved = new Float64Array(7);
  private readonly rested = new Float64Array(7);

  constructor(readonly chain: Chain) {
    this.q = new Float64Array(chain.q.length);
    this.poses = new Float64Array(7 * chain.count);
    this.axes = new Float64Array(3 * chain.joints.length);
    this.poses.set(WORLD);
    this.put(this.q);
  }

  /** Puts the chain at `q`. */
  put(q: ArrayLike<number>): this {
    const { chain, poses, axes, moved, rested } = this;
    for (let i = 0; i < this.q.length; i++) this.q[i] = q[i];
    for (let j = 0; j < chain.joints.length; j++) {
      const joint = chain.joints[j];
      const [x, y, z] = joint.axis;
      compose(rested, 0, poses, 7 * joint.parent, joint.pose, 0);
      const at = joint.q === null ? 0 : joint.gear * this.q[joint.q] + joint.offset;
      if (joint.turns) {
        const s = Math.sin(0.5 * at);
        moved.set([0, 0, 0, Math.cos(0.5 * at), s * x, s * y, s * z]);
      } else moved.set([at * x, at * y, at * z, 1, 0, 0, 0]);
      compose(poses, 7 * joint.child, rested, 0, moved, 0);
      // a long chain would lose its unit quaternions to rounding
      normalize(poses, 7 * joint.child);
      this.turned(axes, 3 * j, 7 * joint.child, joint.axis);
    }
    this.point(this.tcp, chain.tcp);
    compose(this.lab, 0, poses, 7 * chain.lab.node, chain.lab.pose, 0);
    normalize(this.lab, 0);
    return this;
  }

  /** A direction of a node's frame in the axes of the world. */
  private turned(out: Float64Array, o: number, pose: number, direction: readonly number[]): void {
    place(out, o, this.poses, pose, direction[0], direction[1], direction[2]);
    for (let c = 0; c < 3; c++) out[o + c] -= this.poses[pose + c];
  }

  private point(out: Float64Array, { node, pose }: Mount): void {
    place(out, 0, this.poses, 7 * node, pose[0], pose[1], pose[2]);
  }

  /** A direction of the world in the axes of the lab frame. */
  directionInLab(x: number, y: number, z: number): [number, number, number] {
    const [w, a, b, c] = this.lab.subarray(3);
    const out = new Float64Array(3);
    place(out, 0, [0, 0, 0, w, -a, -b, -c], 0, x, y, z);
    return [out[0], out[1], out[2]];
  }

  /** The TCP in the lab frame \[m\]. */
  tcpInLab(): [number, number, number] {
    const { tcp, lab } = this;
    return this.directionInLab(tcp[0] - lab[0], tcp[1] - lab[1], tcp[2] - lab[2]);
  }
}

/** How far the TCP can be from the first joint at most, roughly \[m\]: a measure of the arm's size. */
export function sizeOf(chain: Chain): number {
  let size = Math.hypot(chain.tcp.pose[0], chain.tcp.pose[1], chain.tcp.pose[2]);
  for (const { pose } of chain.joints) size += Math.hypot(pose[0], pose[1], pose[2]);
  return size > 0 ? size : 1;
}

/** The positions in which a joint is shown: its limits, a whole turn where it has none, and of a slide without limits the arm's size. */
export function range(chain: Chain, i: number): readonly [number, number] {
  const { unit, lower, upper } = chain.q[i];
  const free = unit === "rad" ? Math.PI : sizeOf(chain);
  const low = lower ?? Math.min(-free, (upper ?? free) - 2 * free);
  const high = upper ?? Math.max(free, low + 2 * free);
  return [low, high];
}

/** Postures all over the range of every joint, the same ones each time. */
export function postures(chain: Chain, count: number): number[][] {
  const primes = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
  // Halton's sequence: even in every joint, and no two joints alike
  const part = (i: number, base: number): number => {
    let [sum, step] = [0, 1];
    for (let rest = i; rest > 0; rest = Math.floor(rest / base)) {
      step /= base;
      sum += step * (rest % base);
    }
    return sum;
  };
  return Array.from({ length: count }, (_, i) =>
    chain.q.map((position, j) => {
      let [low, high] = range(chain, j);
      // more than a turn shows nothing new
      if (position.unit === "rad" && high - low > 2 * Math.PI) [low, high] = [0.5 * (low + high) - Math.PI, 0.5 * (low + high) + Math.PI];
      return low + (high - low) * part(i + 1 + j, primes[j % primes.length]);
    }),
  );
}
