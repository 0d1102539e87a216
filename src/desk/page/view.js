// The picture on its stage: three canvases on one sheet, which is moved and scaled as a whole. `picture` holds the
// picture at its full size, byte by byte; `draft`, half as large and drawn at twice its size, lies over it until the
// full one is there; `other` is what a wipe shows left of its line. The line stands still on the stage while the sheet
// is moved below it.

import {byId, clamp} from "./dom.js";

const largest = 64, smallest = 1 / 32;  // zoom: screen pixels of one of the picture
const nudge = 0.02;                     // of the stage, by an arrow key

export class View {
  #stage = byId("stage");
  #sheet = byId("sheet");
  #line = byId("wipe_line");
  #canvases = {picture: byId("picture"), draft: byId("draft"), other: byId("other")};
  #contexts = {};
  #size = [1, 1];
  #fits = true;
  #zoom = 1;   // CSS pixels of one of the picture
  #left = 0;   // of the sheet on the stage
  #top = 0;
  #wipe = 0.5;  // of the stage
  #wipes = false;

  // `pointed` is called with the pixel under the pointer, or with null.
  constructor(pointed) {
    for (const [name, canvas] of Object.entries(this.#canvases)) {
      this.#contexts[name] = canvas.getContext("2d", {alpha: false, willReadFrequently: name === "picture"});
    }
    new ResizeObserver(() => this.#fits ? this.fit() : this.#place()).observe(this.#stage);
    this.#stage.addEventListener("wheel", (event) => this.#wheel(event), {passive: false});
    this.#stage.addEventListener("pointerdown", (event) => this.#pan(event));
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

  resize(width, height) {
    this.#size = [width, height];
    for (const name of ["picture", "other"]) Object.assign(this.#canvases[name], {width, height});
    Object.assign(this.#sheet.style, {width: width + "px", height: height + "px"});
    this.#canvases.draft.hidden = true;
    this.fit();
  }

  show({image, half}) {
    const {draft} = this.#canvases;
    if (half) {
      if (draft.width !== image.width || draft.height !== image.height) {
        Object.assign(draft, {width: image.width, height: image.height});
        Object.assign(draft.style, {width: 2 * image.width + "px", height: 2 * image.height + "px"});
      }
      this.#contexts.draft.putImageData(image, 0, 0);
    } else {
      if (image.width !== this.#size[0] || image.height !== this.#size[1]) this.resize(image.width, image.height);
      this.#contexts.picture.putImageData(image, 0, 0);
    }
    draft.hidden = !half;
  }

  showOther({image}) {
    this.#contexts.other.putImageData(image, 0, 0);
  }

  // The bytes of the full picture: RGBA.
  pixels() {
    return this.#contexts.picture.getImageData(0, 0, ...this.#size);
  }

  // Of what is seen at a pixel: on the left of a wipe's line that is the other picture.
  seen(x, y) {
    const isOther = this.#wipes && this.#left + (x + 0.5) * this.#zoom < this.#wipe * this.#stage.clientWidth;
    return [...this.#contexts[isOther ? "other" : "picture"].getImageData(x, y, 1, 1).data];
  }

  // ---- wipe

  set wipes(on) {
    this.#wipes = on;
    this.#line.hidden = this.#canvases.other.hidden = !on;
    this.#place();
  }

  wipeAt(share) {
    this.#wipe = clamp(share, 0, 1);
    this.#place();
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

  // So that `scale` screen pixels show one of the picture; the point (x, y) of the stage stays where it is.
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

  #pan(event) {
    if (event.button > 1) return;
    this.#stage.setPointerCapture(event.pointerId);
    const start = {x: event.clientX - this.#left, y: event.clientY - this.#top};
    let moved = false;
    const move = ({clientX, clientY}) => {
      moved ||= Math.hypot(clientX - event.clientX, clientY - event.clientY) > 3;
      if (!moved) return;
      this.#fits = false;
      [this.#left, this.#top] = [clientX - start.x, clientY - start.y];
      this.#place();
    };
    this.#stage.addEventListener("pointermove", move);
    this.#stage.addEventListener("lostpointercapture", () => this.#stage.removeEventListener("pointermove", move),
        {once: true});
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

  // A part of the picture stays on the stage, wherever it is dragged.
  #place() {
    const {clientWidth, clientHeight} = this.#stage, [width, height] = this.#size, rest = 40;
    this.#left = clamp(this.#left, rest - width * this.#zoom, clientWidth - rest);
    this.#top = clamp(this.#top, rest - height * this.#zoom, clientHeight - rest);
    // At whole screen pixels, so that one of the picture is one of the screen at 1:1.
    const snapped = (x) => Math.round(x * devicePixelRatio) / devicePixelRatio;
    this.#sheet.style.transform = `translate(${snapped(this.#left)}px, ${snapped(this.#top)}px) scale(${this.#zoom})`;
    // Below two screen pixels for one, pixels of even size could not be shown.
    this.#sheet.classList.toggle("near", this.#zoom * devicePixelRatio >= 2);
    const at = this.#wipe * clientWidth;
    this.#line.style.left = at + "px";
    this.#line.setAttribute("aria-valuenow", Math.round(100 * this.#wipe));
    this.#canvases.other.style.clipPath = `inset(0 ${width - clamp((at - this.#left) / this.#zoom, 0, width)}px 0 0)`;
    byId("zoom").textContent = `${Number((100 * this.#zoom * devicePixelRatio).toPrecision(3))} %`;
  }
}
