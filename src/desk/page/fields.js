// A control for each kind of parameter. A control is {nodes, show(value, own)}: its nodes in the page, and the function
// that shows a value; `own` is the look's value. User input goes to `change(value, isLive)`, with isLive during a drag,
// and invalid input to `bad(sentence)`.

import {element, numberOf, plain, short} from "./dom.js";
import {scaleOf, steps} from "./scale.js";

const isNumber = (value) => typeof value === "number";

// A text box for a number. Invalid text is reported and replaced by the last value; `others` are valid words.
function numberBox({id, label, describe, others = []}, change, bad) {
  const box = element("input", {id, type: "text", inputmode: others.length ? null : "decimal", class: "number",
                                autocomplete: "off", spellcheck: "false", "aria-label": label});
  let shown;
  box.addEventListener("change", () => {
    const text = box.value.trim(), value = others.includes(text) ? text : numberOf(text);
    if (value === undefined) {
      bad(`${describe} = '${text}': expected a number${others.map((word) => ` or ${word}`).join("")}`);
      box.value = shown;
    } else {
      change(value, false);
    }
  });
  return {box, show: (value) => { box.value = box.defaultValue = shown = plain(value); }};
}

// A slider over the field's range, whose ends depend on the look's value.
function slider(field, id, label, change) {
  const input = element("input", {id, type: "range", min: 0, max: steps, step: 1, "aria-label": label});
  let scale, ownValue;
  const value = () => scale.value(Number(input.value) / steps);
  input.addEventListener("input", () => change(value(), true));
  input.addEventListener("change", () => change(value(), false));
  const show = (number, own) => {
    if (own !== ownValue) scale = scaleOf(field.least, field.most, ownValue = own);
    input.value = Math.round(scale.position(number) * steps);
    input.setAttribute("aria-valuetext", `${short(number)} ${field.unit}`.trim());
  };
  return {input, show};
}

function real(field, names, change, bad) {
  const bar = slider(field, names.id, null, change);
  const number = numberBox({label: names.label + ", number", describe: names.key}, change, bad);
  return {
    nodes: [element("div", {class: "pair"}, bar.input, number.box)],
    show(value, own) {
      bar.show(value, own);
      number.show(value);
    },
  };
}

function choice(field, names, change) {
  const select = element("select", {id: names.id}, ...field.choices.map((word) => element("option", {}, word)));
  select.addEventListener("change", () => change(select.value, false));
  return {nodes: [select], show: (value) => { select.value = value; }};
}

function text(field, names, change) {
  const box = element("input", {id: names.id, type: "text", autocomplete: "off", spellcheck: "false"});
  box.addEventListener("change", () => change(box.value, false));
  return {nodes: [box], show: (value) => { box.value = box.defaultValue = value; }};
}

// A count, or a word for no count: "8" or "march".
function countOrWord(field, names, change, bad) {
  const number = numberBox({...names, describe: names.key, others: field.choices}, change, bad);
  const words = field.choices.map((word) => {
    const button = element("button", {type: "button"}, word);
    button.addEventListener("click", () => change(word, false));
    return button;
  });
  return {
    nodes: [element("div", {class: "pair words"}, number.box, ...words)],
    show(value) {
      number.show(value);
      words.forEach((button) => button.setAttribute("aria-pressed", button.textContent === value));
    },
  };
}

// ---- colors

const encoded = (x) => x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
const linear = (x) => x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
const hex = (color) => "#" + color.map((x) =>
    Math.round(255 * encoded(Math.min(Math.max(x, 0), 1))).toString(16).padStart(2, "0")).join("");
const fromHex = (text) => [1, 3, 5].map((at) =>
    Number(linear(parseInt(text.slice(at, at + 2), 16) / 255).toPrecision(4)));

// Three numbers, a slider that scales them together, and a swatch of their color, scaled to at most white.
function color(field, names, change, bad) {
  let now = [0, 0, 0];
  const most = () => Math.max(...now);
  let start;  // of a drag: scaled from there, so that a drag to 0 and back keeps the hue
  const bar = slider(field, names.id, null, (size, isLive) => {
    start ??= now;
    const high = Math.max(...start);
    change(start.map((x) => Number((high > 0 ? x / high * size : size).toPrecision(4))), isLive);
    if (!isLive) start = undefined;
  });
  const boxes = ["red", "green", "blue"].map((channel, i) =>
      numberBox({label: `${names.label}, ${channel}`, describe: names.key},
          (x) => change(now.map((old, k) => k === i ? x : old), false), bad));
  const swatch = element("input", {type: "color", "aria-label": `${names.label}, hue`});
  swatch.addEventListener("input", () => pick(true));
  swatch.addEventListener("change", () => pick(false));
  const pick = (isLive) => {
    const picked = fromHex(swatch.value), size = Math.max(1, most());
    change(picked.map((x) => Number((x * size).toPrecision(4))), isLive);
  };
  return {
    nodes: [element("div", {class: "pair"}, bar.input, swatch),
            element("div", {class: "three"}, ...boxes.map(({box}) => box))],
    show(value, own) {
      now = value;
      bar.show(most(), Math.max(...own));
      boxes.forEach((number, i) => number.show(value[i]));
      swatch.value = hex(value.map((x) => x / Math.max(1, most())));
    },
  };
}

function direction(field, names, change, bad) {
  let now = [0, 0, 1];
  const boxes = ["x", "y", "z"].map((axis, i) =>
      numberBox({id: i === 0 ? names.id : null, label: `${names.label}, ${axis}`, describe: names.key},
          (x) => change(now.map((old, k) => k === i ? x : old), false), bad));
  return {
    nodes: [element("div", {class: "three"}, ...boxes.map(({box}) => box))],
    show(value) {
      now = value;
      boxes.forEach((number, i) => number.show(value[i]));
    },
  };
}

// ---- rows of numbers

// A grid; rows of a table can be added and removed, a matrix has four. The last columns of a table may be empty.
function rows(field, names, change, bad) {
  const isTable = field.kind === "table";
  const columns = isTable ? field.columns : ["", "", "", ""];
  const least = isTable ? field.least_columns : 4;
  const grid = element("tbody", {}), add = element("button", {type: "button", id: names.id}, "add a row");
  let now = [];
  const cell = (row, r, c) => {
    const box = element("input", {type: "text", inputmode: "decimal", class: "number", autocomplete: "off",
                                  "aria-label": `${names.label}, row ${r + 1}, ${columns[c] || c + 1}`,
                                  value: c < row.length ? plain(row[c]) : ""});
    box.addEventListener("change", () => {
      const value = numberOf(box.value);
      const next = now.map((old) => [...old]);
      if (value !== undefined && c <= row.length) next[r][c] = value;
      else if (box.value.trim() === "" && c >= least) next[r].length = Math.min(c, row.length);
      else {
        bad(`${names.key}, row ${r + 1}: '${box.value}': expected a number`);
        box.value = c < row.length ? plain(row[c]) : "";
        return;
      }
      change(next, false);
    });
    return element("td", {}, box);
  };
  const takeOut = (r) => {
    const button = element("button", {type: "button", "aria-label": `remove row ${r + 1}`, title: "Remove"}, "×");
    button.addEventListener("click", () => change(now.filter((_, k) => k !== r), false));
    return element("td", {}, button);
  };
  add.addEventListener("click", () => change([...now, now.at(-1) ?? Array(least).fill(0)], false));
  return {
    nodes: [element("div", {class: "scroll"}, element("table", {class: "rows"},
        isTable ? element("thead", {}, element("tr", {}, ...columns.map((name) =>
            element("th", {scope: "col"}, name)))) : "", grid)), ...(isTable ? [add] : [])],
    show(value) {
      now = value;
      grid.replaceChildren(...value.map((row, r) => element("tr", {},
          ...columns.map((_, c) => cell(row, r, c)), ...(isTable ? [takeOut(r)] : []))));
    },
  };
}

const kinds = {real, choice, color, text, file: text, count_or_word: countOrWord, direction, table: rows, matrix: rows};

// `names`: {key: "depth_fog.murkiness", label, id}; the id is that of the label's target.
export function controlOf(field, names, change, bad) {
  const control = kinds[field.kind](field, names, change, bad);
  // An unchanged value is not written again, which would overwrite text being typed.
  let before;
  return {
    nodes: control.nodes,
    show(value, own, again = false) {
      const text = JSON.stringify([value, own]);
      if (text === before && !again) return;
      before = text;
      control.show(value, isNumber(own) || Array.isArray(own) ? own : 0);
    },
  };
}
