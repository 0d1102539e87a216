// The picture on its stage: three canvases on one sheet. `picture` holds the picture at its full size, byte by byte;
// `draft`, of half the size and drawn at twice its size, covers it until the full picture arrives; `other` is the picture
// left of a wipe's line.

import {byId} from "./dom.js";
import {Stage} from "./stage.js";

export class View extends Stage {
  #canvases = {picture: byId("picture"), draft: byId("draft"), other: byId("other")};
  #contexts = {};

  // `pointed` is called with the pixel under the pointer, or with null.
  constructor(pointed) {
    super(pointed);
    for (const [name, canvas] of Object.entries(this.#canvases)) {
      this.#contexts[name] = canvas.getContext("2d", {alpha: false, willReadFrequently: name === "picture"});
    }
  }

  resize(width, height) {
    for (const name of ["picture", "other"]) Object.assign(this.#canvases[name], {width, height});
    this.#canvases.draft.hidden = true;
    super.resize(width, height);
  }

  show({image, half}) {
    const {draft} = this.#canvases, [width, height] = this.size;
    if (half) {
      if (draft.width !== image.width || draft.height !== image.height) {
        Object.assign(draft, {width: image.width, height: image.height});
        Object.assign(draft.style, {width: 2 * image.width + "px", height: 2 * image.height + "px"});
      }
      this.#contexts.draft.putImageData(image, 0, 0);
    } else {
      if (image.width !== width || image.height !== height) this.resize(image.width, image.height);
      this.#contexts.picture.putImageData(image, 0, 0);
    }
    draft.hidden = !half;
  }

  showOther({image}) {
    this.#contexts.other.putImageData(image, 0, 0);
  }

  // The bytes of the full picture: RGBA.
  pixels() {
    return this.#contexts.picture.getImageData(0, 0, ...this.size);
  }

  // The visible bytes at a pixel: left of a wipe's line, those of the other picture.
  seen(x, y) {
    const context = this.#contexts[this.showsOther(x) ? "other" : "picture"];
    return [...context.getImageData(x, y, 1, 1).data];
  }
}
