// Whether the reader asked for less motion.

const less = matchMedia("(prefers-reduced-motion: reduce)");

export const reducedMotion = (): boolean => less.matches;
