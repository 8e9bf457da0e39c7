"use strict";
for (const reel of document.querySelectorAll("[data-reel]")) {
  const frames = [...reel.querySelectorAll("[data-frame]")];
  const range = reel.querySelector("input[type=range]"), told = reel.querySelector("output"), play = reel.querySelector("button");
  const show = at => {
    frames.forEach((frame, k) => { frame.hidden = k !== at; });
    range.value = at;
    told.textContent = frames[at].dataset.frame;
  };
  let timer = 0;
  const stop = () => { clearInterval(timer); timer = 0; play.textContent = "Play"; };
  range.addEventListener("input", () => { stop(); show(Number(range.value)); });
  play.addEventListener("click", () => {
    if (timer) { stop(); return; }
    timer = setInterval(() => show((Number(range.value) + 1) % frames.length), 125);
    play.textContent = "Stop";
  });
  reel.dataset.reel = "ready";
  show(0);
}
