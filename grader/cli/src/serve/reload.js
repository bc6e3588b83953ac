"use strict";
(() => {
  // the report that is open; the server answers when there is another
  const seen = document.currentScript.dataset.seen;
  const place = "kinemark-place";
  const replays = () => window.kinemark?.replays ?? [];

  function leave() {
    const times = {};
    for (const replay of replays()) times[replay.task] = replay.shown()?.t;
    sessionStorage.setItem(place, JSON.stringify({ x: scrollX, y: scrollY, times }));
    location.reload();
  }

  function arrive() {
    const left = JSON.parse(sessionStorage.getItem(place) ?? "null");
    sessionStorage.removeItem(place);
    if (!left) return;
    for (const replay of replays()) {
      const time = left.times[replay.task];
      if (typeof time === "number") replay.seek(time);
    }
    // once the replays have their size
    requestAnimationFrame(() => requestAnimationFrame(() => scrollTo(left.x, left.y)));
  }

  let waits = false;
  async function follow() {
    // tabs that nobody looks at do not wait: a browser waits on a few answers at once only
    if (waits || document.hidden) return;
    waits = true;
    try {
      const answer = await fetch(`/kinemark/changes?seen=${seen}`, { cache: "no-store" });
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
