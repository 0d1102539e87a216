// The numbers of the pixel under the pointer, requested once picture and pointer rest.

import * as api from "./api.js";
import {byId, element, short} from "./dom.js";

const pause = 150;  // ms without a move

export class PixelNumbers {
  #line = byId("pixel_line");
  #box = byId("pixel_box");
  #request;
  #idle;
  #at = null;
  #timer;
  #asks = 0;
  #running = 0;

  // `request` returns the current request of api/picture, `idle` a promise that resolves when no picture is pending.
  constructor(request, idle) {
    this.#request = request;
    this.#idle = idle;
  }

  get isRunning() {
    return this.#running > 0;
  }

  // A pixel {x, y} with its bytes on screen, or null.
  point(at, seen) {
    if (!at) return;  // the last numbers stay
    if (this.#at?.x === at.x && this.#at?.y === at.y) return;
    this.#at = at;
    this.#line.textContent = `${at.x}, ${at.y}   seen ${seen.slice(0, 3).join(" ")}`;
    this.again();
  }

  // To be called for a new picture, whose numbers differ.
  again() {
    clearTimeout(this.#timer);
    if (this.#at) this.#timer = setTimeout(() => this.#ask(), pause);
  }

  async #ask() {
    const asked = ++this.#asks;
    await this.#idle();
    const {half, show, exposure, display, ...request} = this.#request();
    let numbers;
    ++this.#running;
    try {
      numbers = await api.pixel({...request, ...this.#at});
    } catch (error) {
      // A picture has broken them off; the request of the picture reports any other error.
      if (error instanceof api.Stopped && asked === this.#asks) this.again();
      return;
    } finally {
      --this.#running;
    }
    if (asked === this.#asks) this.#tell(numbers);
  }

  #tell({x, y, dry, picture, aovs}) {
    if (x !== this.#at.x || y !== this.#at.y) return;
    const rgb = (values) => values.map(short).join(" ");
    this.#line.textContent = `${x}, ${y}   picture ${rgb(picture)}   dry ${rgb(dry)}`;
    const rows = [["picture", picture], ["dry", dry],
                  ...Object.entries(aovs).map(([name, channels]) => [name, Object.values(channels)])];
    this.#box.replaceChildren(element("table", {}, element("caption", {}, `pixel ${x}, ${y}`),
        element("tbody", {}, ...rows.map(([name, values]) => element("tr", {},
            element("th", {scope: "row"}, name),
            ...[0, 1, 2].map((i) => element("td", {class: "n"}, i < values.length ? short(values[i]) : "")))))));
  }
}
