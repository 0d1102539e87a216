// The frame of a sequence, or the time of a single plate: scrubbed, typed and played.

import {byId, numberOf, short} from "./dom.js";

const longest = 10;  // seconds, the range of a single plate's scrubber

export class Timeline {
  #slider = byId("time");
  #number = byId("time_number");
  #play = byId("play");
  #frames;
  #fps;
  #own;
  #changed;
  #timer = null;
  #begun = null;

  // `changed({frame, time}, isScrubbed)`: time is null for frames, and for a plate until the user chooses a time.
  constructor({frames, frame, time, fps}, changed) {
    this.#frames = frames;
    this.#fps = fps;
    this.#own = time;
    this.#changed = changed;
    this.at = {frame, time: null};
    const most = frames.length > 0 ? frames.length - 1 : longest;
    Object.assign(this.#slider, {min: 0, max: most, step: frames.length > 0 ? 1 : 1 / fps});
    byId("time_label").textContent = frames.length > 0 ? "frame" : "time";
    byId("time_unit").textContent = frames.length > 0 ? `of ${frames[0]} … ${frames.at(-1)}` : "s";
    this.#slider.addEventListener("input", () => this.#scrub(Number(this.#slider.value)));
    this.#slider.addEventListener("change", () => this.#changed(this.at, false));
    this.#number.addEventListener("change", () => this.#type());
    this.#play.addEventListener("click", () => this.toggle());
    this.#draw();
  }

  get plays() { return this.#timer !== null; }

  toggle() {
    this.plays ? this.stop() : this.#start();
  }

  stop() {
    if (!this.plays) return;
    cancelAnimationFrame(this.#timer);
    this.#timer = null;
    this.#draw();
    this.#changed(this.at, false);
  }

  // In real time: late frames are skipped.
  #start() {
    const first = this.#position;
    const turn = (now) => {
      this.#begun ??= now;
      const seconds = (now - this.#begun) / 1000;
      const count = this.#frames.length;
      const position = count > 0 ? (first + Math.floor(seconds * this.#fps)) % count : (first + seconds) % longest;
      if (position !== this.#position) this.#scrub(position);
      this.#timer = requestAnimationFrame(turn);
    };
    this.#begun = null;
    this.#timer = requestAnimationFrame(turn);
    this.#draw();
  }

  get #position() {
    return this.#frames.length > 0 ? this.#frames.indexOf(this.at.frame) : this.at.time ?? this.#own;
  }

  #scrub(position) {
    this.at = this.#frames.length > 0 ? {frame: this.#frames[position], time: null} : {frame: null, time: position};
    this.#draw();
    this.#changed(this.at, true);
  }

  // Invalid text is replaced by the last value.
  #type() {
    const value = numberOf(this.#number.value);
    const isFrame = this.#frames.length > 0;
    if (value !== undefined && (!isFrame || this.#frames.includes(value))) {
      this.at = isFrame ? {frame: value, time: null} : {frame: null, time: value};
      this.#changed(this.at, false);
    }
    this.#draw();
  }

  #draw() {
    const {frame} = this.at, time = this.at.time ?? this.#own;
    this.#slider.value = this.#position;
    this.#slider.setAttribute("aria-valuetext", frame !== null ? `frame ${frame}` : `${short(time)} s`);
    if (document.activeElement !== this.#number || !this.plays) this.#number.value = frame ?? short(time);
    this.#play.textContent = this.plays ? "Pause" : "Play";
    this.#play.setAttribute("aria-pressed", this.plays);
  }
}
