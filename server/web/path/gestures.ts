/** Pointers, wheel and keys on a picture, told as moves of it. */
export interface Moves {
  pan(dx: number, dy: number): void;
  /** What one finger or the left button does: in space it turns. */
  drag(dx: number, dy: number, shift: boolean): void;
  zoom(sx: number, sy: number, factor: number): void;
  /** A pointer that hovers; null where it leaves. */
  hover(place: [number, number] | null): void;
  tap(sx: number, sy: number, touch: boolean): void;
  key(event: KeyboardEvent): boolean; // whether the key means something
}

const clickReach = 5; // CSS pixels that a click may move

/** Tells the moves of pointers on an element. */
export function onGestures(element: HTMLElement, moves: Moves): void {
  const held = new Map<number, { x: number; y: number }>();
  let travelled = 0, button = 0;
  const place = (event: MouseEvent): { x: number; y: number } => {
    const box = element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  element.addEventListener("pointerdown", (event) => {
    if (held.size === 0) {
      travelled = 0;
      button = event.button;
    }
    held.set(event.pointerId, place(event));
    element.setPointerCapture(event.pointerId);
  });
  element.addEventListener("pointermove", (event) => {
    const now = place(event), before = held.get(event.pointerId);
    if (!before) {
      if (event.pointerType === "mouse") moves.hover([now.x, now.y]);
      return;
    }
    if (held.size === 1) {
      travelled += Math.hypot(now.x - before.x, now.y - before.y);
      if (travelled > clickReach) {
        if (button === 0) moves.drag(now.x - before.x, now.y - before.y, event.shiftKey);
        else moves.pan(now.x - before.x, now.y - before.y);
        held.set(event.pointerId, now);
      }
    } else if (held.size === 2) {
      travelled = Infinity;
      const other = [...held.entries()].find(([id]) => id !== event.pointerId)![1];
      const apart = Math.hypot(before.x - other.x, before.y - other.y), now_apart = Math.hypot(now.x - other.x, now.y - other.y);
      moves.pan((now.x - before.x) / 2, (now.y - before.y) / 2);
      if (apart > 1 && now_apart > 1) moves.zoom((now.x + other.x) / 2, (now.y + other.y) / 2, now_apart / apart);
      held.set(event.pointerId, now);
    }
  });
  const up = (event: PointerEvent): void => {
    if (!held.delete(event.pointerId)) return;
    const { x, y } = place(event);
    if (event.type === "pointerup" && travelled <= clickReach && held.size === 0 && button === 0) moves.tap(x, y, event.pointerType !== "mouse");
  };
  element.addEventListener("pointerup", up);
  element.addEventListener("pointercancel", up);
  element.addEventListener("pointerleave", (event) => held.size === 0 && event.pointerType === "mouse" && moves.hover(null));
  element.addEventListener("contextmenu", (event) => event.preventDefault());
  element.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const { x, y } = place(event);
      const lines = event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1;
      moves.zoom(x, y, Math.exp(-Math.max(-300, Math.min(300, event.deltaY * lines)) / (event.ctrlKey ? 120 : 400)));
    },
    { passive: false },
  );
  element.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !moves.key(event)) return;
    event.preventDefault();
    event.stopPropagation();
  });
}
