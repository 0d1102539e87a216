// A sheet of pictures on a stage: moved and scaled as a whole, by mouse, wheel, fingers and keys. The upper picture is
// visible left of a wipe's line, which stays in place on the stage while the sheet moves.

import {byId, clamp} from "./dom.js";

const largest = 64, smallest = 1 / 32;  // zoom: screen pixels per pixel of the picture
const nudge = 0.02;                     // of the stage, by an arrow key

export class Stage {
  #stage = byId("stage");
  #sheet = byId("sheet");
  #line = byId("wipe_line");
  #other = byId("other");
  #size = [1, 1];
  #fits = true;
  #zoom = 1;   // CSS pixels per pixel of the picture
  #left = 0;   // of the sheet on the stage
  #top = 0;
  #wipe = 0.5;  // of the stage
  #wipes = false;
  #fingers = new Map();  // places of the pointers that hold the sheet, by id
  #drags = false;        // moved since it was touched

  // `pointed` is called with the pixel under the pointer, or with null; a wheel event zooms if `zooms` accepts it.
  constructor(pointed, zooms = () => true) {
    new ResizeObserver(() => this.#fits ? this.fit() : this.#place()).observe(this.#stage);
    this.#stage.addEventListener("wheel", (event) => zooms(event) && this.#wheel(event), {passive: false});
    this.#stage.addEventListener("pointerdown", (event) => this.#grasp(event));
    this.#stage.addEventListener("pointermove", (event) => this.#drag(event));
    this.#stage.addEventListener("lostpointercapture", ({pointerId}) => this.#fingers.delete(pointerId));
    this.#stage.addEventListener("dblclick", () => this.fit());
    this.#stage.addEventListener("keydown", (event) => this.#key(event));
    this.#stage.addEventListener("pointermove", (event) => pointed(this.#pixelAt(event)));
    this.#stage.addEventListener("pointerleave", () => pointed(null));
    this.#line.addEventListener("pointerdown", (event) => this.#dragLine(event));
    this.#line.addEventListener("keydown", (event) => {
      const step = {ArrowLeft: -nudge, ArrowRight: nudge, Home: -1, End: 1}[event.key];
      if (step === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      this.wipeAt(this.#wipe + step);
    });
  }

  get size() { return this.#size; }

  resize(width, height) {
    this.#size = [width, height];
    Object.assign(this.#sheet.style, {width: width + "px", height: height + "px"});
    this.fit();
  }

  // ---- wipe

  set wipes(on) {
    this.#wipes = on;
    this.#line.hidden = this.#other.hidden = !on;
    this.#place();
  }

  wipeAt(share) {
    this.#wipe = clamp(share, 0, 1);
    this.#place();
  }

  // Whether this column of the picture shows the upper picture.
  showsOther(x) {
    return this.#wipes && this.#left + (x + 0.5) * this.#zoom < this.#wipe * this.#stage.clientWidth;
  }

  #dragLine(event) {
    event.stopPropagation();
    this.#line.setPointerCapture(event.pointerId);
    const {left, width} = this.#stage.getBoundingClientRect();
    const move = ({clientX}) => this.wipeAt((clientX - left) / width);
    this.#line.addEventListener("pointermove", move);
    this.#line.addEventListener("lostpointercapture", () => this.#line.removeEventListener("pointermove", move),
        {once: true});
  }

  // ---- zoom and pan

  fit() {
    const {clientWidth, clientHeight} = this.#stage, [width, height] = this.#size;
    this.#fits = true;
    this.#zoom = Math.max(1e-3, Math.min(clientWidth / width, clientHeight / height));
    this.#left = (clientWidth - width * this.#zoom) / 2;
    this.#top = (clientHeight - height * this.#zoom) / 2;
    this.#place();
  }

  // `scale`: screen pixels per pixel of the picture. The point (x, y) of the stage keeps its place.
  zoomTo(scale, x = this.#stage.clientWidth / 2, y = this.#stage.clientHeight / 2) {
    const zoom = clamp(scale, smallest, largest) / devicePixelRatio, ratio = zoom / this.#zoom;
    this.#fits = false;
    this.#zoom = zoom;
    this.#left = x - (x - this.#left) * ratio;
    this.#top = y - (y - this.#top) * ratio;
    this.#place();
  }

  zoomBy(ratio) {
    this.zoomTo(this.#zoom * devicePixelRatio * ratio);
  }

  #wheel(event) {
    event.preventDefault();
    const {left, top} = this.#stage.getBoundingClientRect();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
    this.zoomTo(this.#zoom * devicePixelRatio * 2 ** (-event.deltaY * lines / 300), event.clientX - left,
        event.clientY - top);
  }

  #grasp(event) {
    if (event.button > 1) return;
    this.#stage.setPointerCapture(event.pointerId);
    if (this.#fingers.size === 0) this.#drags = false;
    this.#fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  }

  // The sheet follows the mouse or the finger that holds it; two fingers scale it, too.
  #drag({pointerId, clientX, clientY}) {
    const finger = this.#fingers.get(pointerId);
    if (!finger) return;
    this.#drags ||= Math.hypot(clientX - finger.x, clientY - finger.y) > 3;
    if (!this.#drags) return;
    const before = this.#grip;
    Object.assign(finger, {x: clientX, y: clientY});
    const after = this.#grip;
    this.#fits = false;
    this.#left += after.x - before.x;
    this.#top += after.y - before.y;
    const ratio = before.spread > 0 && after.spread > 0 ? after.spread / before.spread : 1;
    if (ratio !== 1) {
      const {left, top} = this.#stage.getBoundingClientRect();
      this.zoomTo(this.#zoom * devicePixelRatio * ratio, after.x - left, after.y - top);
    } else {
      this.#place();
    }
  }

  // The places of the first two fingers on the sheet, and their distance.
  get #grip() {
    const [a, b = a] = this.#fingers.values();
    return {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, spread: Math.hypot(a.x - b.x, a.y - b.y)};
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const [dx, dy] = {ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key] ?? [];
    if (dx === undefined) return;
    event.preventDefault();
    this.#fits = false;
    this.#left += 40 * dx;
    this.#top += 40 * dy;
    this.#place();
  }

  #pixelAt(event) {
    const {left, top} = this.#stage.getBoundingClientRect();
    const x = Math.floor((event.clientX - left - this.#left) / this.#zoom);
    const y = Math.floor((event.clientY - top - this.#top) / this.#zoom);
    return x >= 0 && y >= 0 && x < this.#size[0] && y < this.#size[1] ? {x, y} : null;
  }

  // Keeps a part of the picture on the stage.
  #place() {
    const {clientWidth, clientHeight} = this.#stage, [width, height] = this.#size, rest = 40;
    this.#left = clamp(this.#left, rest - width * this.#zoom, clientWidth - rest);
    this.#top = clamp(this.#top, rest - height * this.#zoom, clientHeight - rest);
    // At whole screen pixels, so that pixels of picture and screen coincide at 1:1.
    const snapped = (x) => Math.round(x * devicePixelRatio) / devicePixelRatio;
    this.#sheet.style.transform = `translate(${snapped(this.#left)}px, ${snapped(this.#top)}px) scale(${this.#zoom})`;
    // Below two screen pixels per pixel, nearest sampling would show pixels of uneven size.
    this.#sheet.classList.toggle("near", this.#zoom * devicePixelRatio >= 2);
    const at = this.#wipe * clientWidth;
    this.#line.style.left = at + "px";
    this.#line.setAttribute("aria-valuenow", Math.round(100 * this.#wipe));
    this.#other.style.clipPath = `inset(0 ${width - clamp((at - this.#left) / this.#zoom, 0, width)}px 0 0)`;
    byId("zoom").textContent = `${Number((100 * this.#zoom * devicePixelRatio).toPrecision(3))} %`;
  }
}
