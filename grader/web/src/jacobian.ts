// The Jacobian of the TCP's position: how fast, and in which direction, each joint alone moves the TCP.

import type { Posture } from "./chain";

/** Columns in the axes of the world, one for each entry of `q` \[m/s at 1 rad/s or 1 m/s\]. */
export function columnsInWorld(posture: Posture): number[][] {
  const { chain, poses, axes, tcp } = posture;
  const columns = chain.q.map(() => [0, 0, 0]);
  let node = chain.tcp.node;
  // from the TCP to the root, since a joint carries only what is beyond it
  for (let j = chain.joints.length - 1; j >= 0; j--) {
    const joint = chain.joints[j];
    if (joint.child !== node) continue;
    node = joint.parent;
    if (joint.q === null) continue;
    const [ax, ay, az] = [axes[3 * j], axes[3 * j + 1], axes[3 * j + 2]];
    let moves = [ax, ay, az];
    if (joint.turns) {
      const o = 7 * joint.child;
      const [x, y, z] = [tcp[0] - poses[o], tcp[1] - poses[o + 1], tcp[2] - poses[o + 2]];
      moves = [ay * z - az * y, az * x - ax * z, ax * y - ay * x];
    }
    // a joint that mimics another adds to its column
    for (let c = 0; c < 3; c++) columns[joint.q][c] += joint.gear * moves[c];
  }
  return columns;
}

/** The same columns in the axes of the lab frame. */
export function columnsInLab(posture: Posture): number[][] {
  return columnsInWorld(posture).map(([x, y, z]) => posture.directionInLab(x, y, z));
}
