// Where everything is at a moment: the poses of the trace, and between two frames the way from one to the other.

import { lastAt } from "./between";
import type { Replay } from "./data";
import { compose, normalize, place } from "./pose";

/** Where everything is that is drawn. */
export interface Placed {
  /** Pose of every node in the world, seven numbers each. */
  readonly poses: Float64Array;
  readonly lab: Float64Array;
  readonly tcp: Float64Array;
  readonly tcpInWorld: Float64Array;
  readonly t: number;
  readonly progress: number;
  frame(out: Float64Array, node: number | null, pose: readonly number[]): void;
  /** Whether a node is there at all; without it all are. */
  there?(node: number): boolean;
  /** Goes to a moment. */
  at(t: number): void;
}

export class World implements Placed {
  /** Pose of every node in the world, seven numbers each. */
  readonly poses: Float64Array;
  /** Pose of the lab frame in the world. */
  readonly lab = new Float64Array(7);
  /** TCP in the lab frame \[m\]. */
  readonly tcp = new Float64Array(3);
  /** TCP in the world \[m\]. */
  readonly tcpInWorld = new Float64Array(3);
  readonly q: Float64Array;
  /** Moment that is shown \[s\]. */
  t = 0;
  /** Steps that have passed, with the fraction of the one under way. */
  progress = 0;

  constructor(readonly replay: Replay) {
    this.poses = new Float64Array(7 * replay.nodes.length);
    this.q = new Float64Array(replay.joints.length);
    replay.nodes.forEach((node, n) => {
      if (node.pose === null) return;
      this.poses.set(node.pose, 7 * n);
      normalize(this.poses, 7 * n);
    });
    this.at(replay.ticks[0] * replay.stepS);
  }

  /** Puts everything where it is at `t` \[s\]. */
  at(t: number): void {
    const { ticks, stepS, nodes, moves, lab } = this.replay;
    // a time read from a link may miss its tick by a rounding
    const exact = t / stepS;
    const tick = Math.abs(exact - Math.round(exact)) < 1e-6 ? Math.round(exact) : exact;
    const i = lastAt(ticks, tick);
    const k = Math.min(i + 1, ticks.length - 1);
    this.t = t;
    this.progress = i + (k > i ? Math.min(1, Math.max(0, (tick - ticks[i]) / (ticks[k] - ticks[i]))) : 0);
    for (let i = 0; i < moves.nodes.length; i++) moves.nodes[i].at(tick);
    for (let n = 0; n < nodes.length; n++) {
      const at = nodes[n].track;
      if (at >= 0) moves.nodes[at].pose(this.poses, 7 * n);
    }
    moves.tcp.at(tick);
    for (let c = 0; c < 3; c++) this.tcp[c] = moves.tcp.number(c);
    for (let c = 0; c < this.q.length; c++) {
      moves.q[c].at(tick);
      this.q[c] = moves.q[c].number(0);
    }
    this.frame(this.lab, lab.node, lab.pose);
    place(this.tcpInWorld, 0, this.lab, 0, this.tcp[0], this.tcp[1], this.tcp[2]);
  }

  /** Writes the pose in the world of a frame that stands on a node, or in the world where `node` is null. */
  frame(out: Float64Array, node: number | null, pose: readonly number[]): void {
    if (node === null) out.set(pose);
    else compose(out, 0, this.poses, 7 * node, pose, 0);
    normalize(out, 0);
  }
}
