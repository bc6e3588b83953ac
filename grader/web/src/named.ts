// The frames that are shown by name: the robot's and, first, the lab's.

import type { Frame, Scenery } from "./data";

export function namedFrames(replay: Scenery): readonly Frame[] {
  const named = replay.frames.filter(({ name }) => name !== "");
  return named.some((frame) => frame.name === replay.lab.name) ? named : [replay.lab, ...named];
}
