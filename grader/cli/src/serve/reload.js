"use strict";
(() => {
  // the report that is open; the server answers, beside it, when there is another
  const seen = document.currentScript.dataset.seen;
  const place = "kinemark-place";
  const kept = () => JSON.parse(sessionStorage.getItem(place) ?? "null") ?? {};
  // where a page that is shorter than the one before could not be scrolled to
  let beyond = null;

  // parts that fold, by what they are in
  function folds() {
    const counts = {};
    return [...document.querySelectorAll("details")].map((part) => {
      const at = part.closest("[id]")?.id ?? "";
      counts[at] = (counts[at] ?? 0) + 1;
      return [`${at} ${counts[at]}`, part];
    });
  }

  function leave() {
    // a version that does not build has no replays: those of the one before it are kept
    const { replays, open } = kept();
    const at = beyond && scrollY === beyond.reached ? beyond.y : scrollY;
    sessionStorage.setItem(place, JSON.stringify({
      goes: true,
      x: scrollX,
      y: at,
      replays: { ...replays, ...window.kinemark?.state?.() },
      open: { ...open, ...Object.fromEntries(folds().map(([name, part]) => [name, part.open])) },
    }));
    location.reload();
  }

  function arrive() {
    const left = kept();
    // a page that was loaded by hand starts as it is
    if (!left.goes) return sessionStorage.removeItem(place);
    sessionStorage.setItem(place, JSON.stringify({ ...left, goes: false }));
    for (const [name, part] of folds()) part.open = left.open[name] ?? part.open;
    window.kinemark?.restore?.(left.replays);
    // once the replays have their size
    requestAnimationFrame(() => requestAnimationFrame(() => {
      scrollTo(left.x, left.y);
      if (scrollY < left.y - 1) beyond = { y: left.y, reached: scrollY };
    }));
  }

  let waits = false;
  async function follow() {
    // tabs that nobody looks at do not wait: a browser waits on a few answers at once only
    if (waits || document.hidden) return;
    waits = true;
    try {
      const answer = await fetch(`kinemark/changes?seen=${seen}`, { cache: "no-store" });
      if (answer.ok && String((await answer.json()).version) !== seen) return leave();
    } catch {
      // the server is gone, or not there again yet
    }
    waits = false;
    setTimeout(follow, 1000);
  }

  history.scrollRestoration = "manual";
  addEventListener("load", arrive);
  document.addEventListener("visibilitychange", follow);
  follow();
})();
