/** What a mouse, fingers and a wheel do to a chart. All places are px from the element's left edge. */
export interface Gestures {
  point(x: number | null): void; // the mouse is over it; null: it has left
  click(x: number): void;
  zoom(x: number, factor: number): void; // factor < 1: closer
  pan(pixels: number): void; // what is shown moves to the right
  select: ((from: number, to: number, done: boolean) => void) | null; // null: a drag of the mouse moves, too
}

const still = 5; // px that a click may move

export function followGestures(element: HTMLElement, gestures: Gestures): void {
  const held = new Map<number, number>(); // x of each pointer that is down
  let start = 0, moved = false, mouse = false;
  const at = (event: PointerEvent | WheelEvent): number => event.clientX - element.getBoundingClientRect().left;

  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || (event.target as Element).closest("button, a, input")) return;
    held.set(event.pointerId, at(event));
    mouse = event.pointerType === "mouse";
    if (held.size === 1) [start, moved] = [at(event), false];
    else moved = true;
    element.setPointerCapture(event.pointerId);
  });
  element.addEventListener("pointermove", (event) => {
    const x = at(event), before = held.get(event.pointerId);
    if (before === undefined) {
      if (event.pointerType === "mouse") gestures.point(x);
      return;
    }
    if (held.size === 2) {
      const other = [...held].find(([id]) => id !== event.pointerId)![1];
      const apart = Math.max(10, Math.abs(before - other)), now = Math.max(10, Math.abs(x - other));
      gestures.pan((x - before) / 2);
      gestures.zoom((x + other) / 2, apart / now);
    } else if (moved || Math.abs(x - start) > still) {
      moved = true;
      if (mouse && gestures.select) gestures.select(start, x, false);
      else gestures.pan(x - before);
    }
    held.set(event.pointerId, x);
  });
  const release = (event: PointerEvent, given: boolean): void => {
    if (!held.delete(event.pointerId) || held.size > 0) return;
    if (moved && mouse && gestures.select) gestures.select(given ? start : 0, given ? at(event) : 0, true);
    else if (!moved && given) gestures.click(at(event));
  };
  element.addEventListener("pointerup", (event) => release(event, true));
  element.addEventListener("pointercancel", (event) => release(event, false));
  element.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && held.size === 0 && gestures.point(null));
  element.addEventListener("wheel", (event) => {
    event.preventDefault();
    const unit = event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1;
    if (Math.abs(event.deltaX) > Math.abs(event.deltaY)) gestures.pan(-event.deltaX * unit);
    else gestures.zoom(at(event), Math.exp(Math.max(-1, Math.min(1, event.deltaY * unit * 0.0025))));
  }, { passive: false });
}
