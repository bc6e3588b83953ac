// How far apart the lines of the grid are.

/** A pitch of 1, 2 or 5 times a power of ten \[m\] that gives a run of this radius some ten lines. */
export function pitchFor(radius: number): number {
  const wanted = radius / 6;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const rest = wanted / power;
  return (rest < 1.5 ? 1 : rest < 3.5 ? 2 : rest < 7.5 ? 5 : 10) * power;
}
