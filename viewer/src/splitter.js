// The border between picture and plots, which the pointer or the arrow keys move.

const STEP = 24;
const LEAST = 60;

export const split = (bar, below) => {
  const set = (height) => {
    const most = window.innerHeight - 320;
    below.style.height = `${Math.min(Math.max(height, LEAST), Math.max(most, LEAST))}px`;
    bar.setAttribute("aria-valuenow", String(Math.round((100 * below.clientHeight) / window.innerHeight)));
  };
  bar.addEventListener("pointerdown", (event) => {
    bar.setPointerCapture(event.pointerId);
    const [from, height] = [event.clientY, below.clientHeight];
    const move = (moved) => set(height + from - moved.clientY);
    bar.addEventListener("pointermove", move);
    bar.addEventListener("pointerup", () => bar.removeEventListener("pointermove", move), { once: true });
  });
  bar.addEventListener("keydown", (event) => {
    const step = { ArrowUp: STEP, ArrowDown: -STEP }[event.key];
    if (!step) return;
    event.preventDefault();
    set(below.clientHeight + step);
  });
};
