// The strip below the picture: errors, warnings, and lookups beyond the frame.

import {byId, element} from "./dom.js";

export class Notes {
  #strip = byId("notes");
  #bad = "";
  #notes = [];

  constructor() {
    this.#strip.addEventListener("toggle", () => {
      if (this.#count === 0) this.#strip.open = false;
    });
    this.#draw();
  }

  // The sentence of a refusal, until the next picture; "" for none.
  set bad(sentence) {
    this.#bad = sentence;
    this.#draw();
  }

  get bad() { return this.#bad; }

  set notes(sentences) {
    this.#notes = sentences;
    this.#draw();
  }

  get #count() { return this.#notes.length + (this.#bad ? 1 : 0); }

  #draw() {
    const all = [...(this.#bad ? [this.#bad] : []), ...this.#notes];
    this.#strip.dataset.count = all.length;
    this.#strip.toggleAttribute("data-bad", this.#bad !== "");
    byId("note").textContent = all[0] ?? "No warnings.";
    byId("more_notes").textContent = all.length > 1 ? `and ${all.length - 1} more` : "";
    byId("note_list").replaceChildren(...all.map((sentence) => element("li", {}, sentence)));
    if (all.length === 0) this.#strip.open = false;
  }
}
