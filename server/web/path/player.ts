/** Controls of the playback: play, step by line, slider, speed. */
import { h } from "../base/dom";
import { onKey } from "../base/page";
import { number } from "../base/numbers";
import { PlaybackClock, type PlayBy } from "./clock";
import { t } from "./words";

const speeds = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];
const shareEvery = 5, sliderEvery = 3; // frames

export interface PlayerEvents {
  /** Rows of the line to which a row belongs; null while it is not known. */
  line(row: number): { first: number; end: number } | null;
  /** A frame of the playback. `share`: whether other panels are to follow. */
  frame(row: number, share: boolean): void;
  /** The playback has begun or has ended. */
  started(playing: boolean): void;
  /** Somebody wants to see a row. */
  seek(row: number): void;
  step(lines: 1 | -1): void;
}

export class Player {
  readonly element: HTMLElement;
  readonly clock: PlaybackClock;
  private readonly play = h("button", { id: "play", type: "button", class: "primary", "aria-pressed": "false", click: () => this.toggle() }, t("play"));
  private readonly slider: HTMLInputElement;
  private frames = 0;
  private request = 0;

  constructor(rows: number, cycle: number, hasLines: boolean, private readonly events: PlayerEvents) {
    this.clock = new PlaybackClock(rows, cycle);
    this.slider = h("input", {
      type: "range", id: "play-position", min: 0, max: rows - 1, step: 1, value: 0, "aria-label": t("position"),
      input: () => {
        this.clock.seek(Number(this.slider.value));
        this.events.seek(this.clock.row);
      },
    });
    const speed = h("select", { id: "play-speed", "aria-label": t("speed"), change: () => (this.clock.speed = Number(speed.value)) });
    for (const each of speeds) speed.append(h("option", { value: each, selected: each === 1 }, `${number(each)} ×`));
    const by = h("select", { id: "play-by", "aria-label": t("step"), change: () => (this.clock.by = by.value as PlayBy) });
    for (const each of ["time", "row", ...(hasLines ? ["line"] : [])]) by.append(h("option", { value: each }, t(`step_${each as PlayBy}`)));
    const step = (lines: 1 | -1, name: "line_before" | "line_after", sign: string, key: string) => {
      onKey(key, t(lines < 0 ? "key_line_before" : "key_line_after"), () => this.events.step(lines));
      return h("button", { type: "button", id: name.replace("_", "-"), title: t(name), "aria-label": t(name), click: () => this.events.step(lines) }, sign);
    };
    onKey("p", t("key_play"), () => this.toggle());
    this.element = h(
      "div", { class: "path-player" }, this.play, hasLines && step(-1, "line_before", "↑", ","), hasLines && step(1, "line_after", "↓", "."), this.slider,
      h("span", { class: "path-pace" }, speed, by),
    );
  }
  toggle(): void {
    if (this.clock.playing) this.stop();
    else this.start();
  }
  start(): void {
    this.clock.start();
    this.frames = 0;
    this.label();
    this.events.started(true);
    this.request = requestAnimationFrame(this.frame);
  }
  stop(): void {
    if (!this.clock.playing && this.request === 0) return;
    cancelAnimationFrame(this.request);
    this.request = 0;
    this.clock.stop();
    this.label();
    this.slider.value = String(Math.round(this.clock.row));
    this.events.frame(this.clock.row, true);
    this.events.started(false);
  }
  /** Shows a row that another panel has chosen. */
  follow(row: number): void {
    if (Math.round(this.clock.row) === row) return;
    this.clock.seek(row);
    this.slider.value = String(row);
  }
  private label(): void {
    this.play.textContent = t(this.clock.playing ? "pause" : "play");
    this.play.setAttribute("aria-pressed", String(this.clock.playing));
  }
  private readonly frame = (now: number): void => {
    const row = this.clock.tick(now, (at) => this.events.line(at));
    if (!this.clock.playing) {
      this.stop();
      return;
    }
    ++this.frames;
    if (this.frames % sliderEvery === 0) this.slider.value = String(Math.round(row));
    this.events.frame(row, this.frames % shareEvery === 0);
    this.request = requestAnimationFrame(this.frame);
  };
}
