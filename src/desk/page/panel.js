// All parameters: first the most useful ones for tuning water, then those of each operator.

import {byId, element} from "./dom.js";
import {controlOf} from "./fields.js";
import {same} from "./look.js";

// With names for the visible effect.
const first = [
  ["depth_fog.murkiness", "Murkiness"],
  ["wave_normals.wind", "Wind"],
  ["depth_fog.sediment", "Brightness, by sediment"],
  ["depth_fog.cdom", "Brown, by humus"],
  ["wave_normals.strength", "Waves"],
  ["wave_normals.tile_size", "Wave length"],
  ["depth_fog.water_type", "Water"],
  ["depth_fog.ambient", "Light of an unknown sky"],
  ["sun_highlight.strength", "Glint of the sun"],
  ["caustics.strength", "Light on the bottom"],
];

export class Panel {
  #looks;
  #on;
  #rows = [];    // {key, node, control, why, back, words, told}
  #groups = [];  // {node, rows}
  #search = byId("search");
  #changedOnly = byId("changed_only");
  #hint = byId("hint");
  #replaced = [];  // {key, value, why}: choices that run as others on this plate
  #unread = [];    // {key, why}: parameters whose quantity this plate or its scene gives
  #shown = null;

  // `on`: change(key, value, isLive), back(key), bad(sentence).
  constructor({operators}, looks, on) {
    this.#looks = looks;
    this.#on = on;
    const list = byId("fields");
    const known = first.filter(([key]) => looks.fields.has(key));
    list.append(this.#group("First", "", known.map(([key, label]) => this.#row(key, label, "first")), true));
    for (const {name, about, fields} of operators) {
      const rows = fields.map((field) => this.#row(`${name}.${field.name}`, field.name, "all"));
      list.append(this.#group(name, about, rows, false));
    }
    this.#search.addEventListener("input", () => this.#filter());
    this.#changedOnly.addEventListener("change", () => this.#filter());
    for (const event of ["pointerover", "focusin"]) list.addEventListener(event, ({target}) => this.#tell(target));
  }

  // What the plan of the last picture says of the look's parameters.
  planned({replaced, unread}) {
    if (same([replaced, unread], [this.#replaced, this.#unread])) return;
    this.#replaced = replaced;
    this.#unread = unread;
    if (this.#shown) this.show(this.#shown);
  }

  show({look, set}) {
    this.#shown = {look, set};
    const values = this.#looks.values({look, set});
    const running = new Map([...values, ...this.#replaced.map(({key, value}) => [key, value])]);
    for (const row of this.#rows) {
      const {key} = row, value = values.get(key), own = this.#looks.own(look, key);
      const isChanged = Object.hasOwn(set, key) || !same(value, own);
      const unused = this.#looks.unused(key, values), brings = this.#looks.brings(key, values);
      const lost = unused ? "" : this.#looks.unused(key, running) ? this.#whyReplaced(key) :
          this.#unread.find((other) => other.key === key)?.why ?? "";
      row.control.show(value, own);
      // Unchanged rows are skipped: a drag updates all rows many times per second.
      const told = JSON.stringify([look, isChanged, unused, brings, lost]);
      if (told === row.told) continue;
      row.told = told;
      row.node.classList.toggle("changed", isChanged);
      row.node.classList.toggle("unused", unused !== "" || lost !== "");
      row.back.hidden = !isChanged;
      row.back.title = `Back to ${JSON.stringify(own)}, as in ${look}`;
      row.why.textContent = row.why.title = unused ? `only with ${unused}` : lost ? `no effect: ${lost}` : brings ? `sets ${brings}` : "";
    }
    if (this.#changedOnly.checked) this.#filter();
  }

  // Why a choice of that parameter's operator runs as another one.
  #whyReplaced(key) {
    const operator = key.slice(0, key.indexOf("."));
    return this.#replaced.filter((choice) => choice.key.startsWith(operator + ".")).map(({why}) => why).join("; ");
  }

  // After a refusal: replaces the typed values by the current ones.
  again({look, set}) {
    const values = this.#looks.values({look, set});
    for (const {control, key} of this.#rows) control.show(values.get(key), this.#looks.own(look, key), true);
  }

  #row(key, label, place) {
    const field = this.#looks.fields.get(key), id = `${place}:${key}`;
    const control = controlOf(field, {key, label, id}, (value, isLive) => this.#on.change(key, value, isLive),
        this.#on.bad);
    const why = element("span", {class: "why"});
    const back = element("button", {type: "button", class: "back", "aria-label": `Reset ${key} to the look's value`}, "↺");
    back.addEventListener("click", () => this.#on.back(key));
    const node = element("div", {class: "field", "data-key": key, "data-kind": field.kind},
        element("div", {class: "name"}, element("label", {for: id, title: key}, label),
            element("span", {class: "unit"}, field.unit), why, back),
        ...control.nodes);
    const row = {key, node, control, why, back, words: `${key} ${label} ${field.about}`.toLowerCase()};
    this.#rows.push(row);
    return row;
  }

  #group(name, about, rows, isOpen) {
    const node = element("details", {class: "group", open: isOpen, "data-group": name},
        element("summary", {title: about}, name), ...rows.map((row) => row.node));
    this.#groups.push({node, rows, isOpen});
    node.addEventListener("toggle", () => {
      const group = this.#groups.find((other) => other.node === node);
      if (!this.#filters) group.isOpen = node.open;
    });
    return node;
  }

  get #filters() { return this.#search.value.trim() !== "" || this.#changedOnly.checked; }

  #filter() {
    const words = this.#search.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const {node, rows, isOpen} of this.#groups) {
      const isFirst = node.dataset.group === "First";
      for (const row of rows) {
        row.node.hidden = !words.every((word) => row.words.includes(word)) ||
            (this.#changedOnly.checked && !row.node.classList.contains("changed"));
      }
      // Each parameter is found once, at its operator.
      node.hidden = this.#filters && (isFirst || rows.every((row) => row.node.hidden));
      node.open = this.#filters ? true : isOpen;
    }
    byId("none_found").hidden = !this.#filters || this.#groups.some(({node}) => !node.hidden);
  }

  // Shows the description of the parameter under the pointer, in a fixed place, so that the layout does not move.
  #tell(target) {
    const key = target.closest?.(".field")?.dataset.key;
    if (!key) return;
    const {about, unit, least, most} = this.#looks.fields.get(key);
    const ends = least === null && most === null ? "" : ` ${least ?? "any"} … ${most ?? "any"}${unit && " " + unit}.`;
    const why = this.#rows.find((row) => row.key === key).why.textContent;
    this.#hint.replaceChildren(element("code", {}, key), ` ${about}${ends}${why && ` It ${why.replace(/^only/, "is read only").replace(/^no/, "has no")}.`}`);
  }
}
