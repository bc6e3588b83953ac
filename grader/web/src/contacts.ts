// Which contacts are marked, and how strongly: those of the arm are what a motion did, while a can also touches the shelf it stands on.

import type { Contact, Scenery, Vector } from "./data";

export interface ContactMark {
  readonly point: Vector;
  /** First and last tick. */
  readonly from: number;
  readonly to: number;
  /** Size as a part of the greatest. */
  readonly size: number;
  /** How much it covers while it lasts. */
  readonly lasting: number;
  /** The direction of the force on what the arm touches, as long as its size is a part of the greatest; null where it is not known. */
  readonly force: Vector | null;
}

/** The marks of a run, at most so many: those of the arm first, then by impulse. */
export function contactMarks(replay: Scenery, most: number): ContactMark[] {
  const links = replay.nodes.filter((node) => node.kind === "link").map((node) => node.name);
  // a second run's parties stand behind what that is called
  const arm = new Set([...links, ...links.map((name) => `${replay.ghostLabel}/${name}`)]);
  const all = replay.contacts.map((contact) => ({ contact, arm: arm.has(contact.first) || arm.has(contact.second) }));
  all.sort((a, b) => Number(b.arm) - Number(a.arm) || b.contact.impulse - a.contact.impulse);
  const greatest = Math.max(0, ...all.slice(0, 1).map(({ contact }) => contact.impulse));
  const strongest = Math.max(0, ...all.filter(({ arm }) => arm).map(({ contact }) => contact.force));
  const forceOf = ({ force, normal }: Contact): Vector | null => {
    if (!normal || !(strongest > 0) || !(force > 0)) return null;
    // the root, so that a weak one is seen beside a strong one
    const length = Math.sqrt(force / strongest);
    return normal.map((x) => length * x);
  };
  return all.slice(0, most).map(({ contact, arm }) => {
    const share = greatest > 0 ? Math.min(1, contact.impulse / greatest) : 1;
    return {
      point: contact.point,
      from: contact.from,
      to: contact.to,
      size: arm ? 0.65 + 0.35 * Math.sqrt(share) : 0.5,
      lasting: arm ? 1 : 0.45,
      force: arm ? forceOf(contact) : null,
    };
  });
}

/** How much a mark covers at a tick: nothing before the contact began, and nothing once it is over. */
export function coverAt(mark: ContactMark, tick: number): number {
  return tick + 0.5 < mark.from || tick - 0.5 > mark.to ? 0 : mark.lasting;
}
