// Pictures of time (across) against error (up), both axes logarithmic.
"use strict";

// Taken from the browser, so that the page contains no address.
const svgNamespace = Object.assign(document.createElement("div"), {innerHTML: "<svg></svg>"}).firstChild.namespaceURI;

// At most two digits after the point, never "-0".
function coordinate(value) {
  return String(Number(value.toFixed(2)) + 0);
}

function svg(name, attributes, ...children) {
  const made = document.createElementNS(svgNamespace, name);
  for (const [key, value] of Object.entries(attributes)) {
    made.setAttribute(key, typeof value === "number" ? coordinate(value) : value);
  }
  made.append(...children);
  return made;
}

const line = (type, x1, y1, x2, y2) => svg("line", {class: type, x1, y1, x2, y2});
const path = (type, d) => svg("path", {class: type, d});
const text = (type, x, y, size, anchor, words, more = {}) =>
    svg("text", {class: type, x, y, "font-size": size, "text-anchor": anchor, ...more}, words);
const at = (x, y) => coordinate(x) + " " + coordinate(y);

// ---- axes

// A power of ten times 1 ... 9: 200, 0.05, 10⁻⁵, 2·10⁻⁵.
function tickNumber(digit, power) {
  if (power >= -3 && power <= 4) return (digit * 10 ** power).toFixed(Math.max(0, -power));
  return (digit === 1 ? "" : digit + "·") + powerOfTen(power);
}

// From 1, 2 or 5 times a power of ten to another such number, around all values with some padding. Ticks are at
// 1 ... 9 times a power of ten; labels at powers of ten, and also at 2 and 5 times one for fewer than three decades.
// Throws for values without a logarithm.
function logAxis(values) {
  const air = 1.15;  // padding around the outermost values, a factor
  const least = Math.min(...values) / air, most = Math.max(...values) * air;
  if (!(least > 0 && Number.isFinite(most))) throw new RangeError(`an axis over ${values}: expected numbers above 0`);
  const step = (digit, power) => ({digit, power, value: Number(`${digit}e${power}`), round: [1, 2, 5].includes(digit)});
  const after = ({digit, power}) => digit === 9 ? step(1, power + 1) : step(digit + 1, power);
  let last = step(1, Math.floor(Math.log10(least)));
  for (let s = last; s.value <= least; s = after(s)) {
    if (s.round) last = s;
  }
  const steps = [last];
  while (!(last.round && last.value >= most)) steps.push(last = after(last));
  const first = steps[0].value, few = last.value < 1000 * first;
  return {
    ticks: steps.map(({digit, power, value, round}) =>
        ({value, label: digit === 1 || (few && round) ? tickNumber(digit, power) : ""})),
    place: (value) => Math.log(value / first) / Math.log(last.value / first),  // 0 ... 1 from end to end
  };
}

// ---- labels

const meets = (a, b) => a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
const contains = (a, b) => a.x0 <= b.x0 && a.y0 <= b.y0 && b.x1 <= a.x1 && b.y1 <= a.y1;
const grown = (b, by) => ({x0: b.x0 - by, y0: b.y0 - by, x1: b.x1 + by, y1: b.y1 + by});
const around = ({x, y}, half) => grown({x0: x, y0: y, x1: x, y1: y}, half);
const clamped = (value, least, most) => Math.min(Math.max(value, least), most);

// Whether a line segment and a box intersect: clips the segment to the box (Liang & Barsky 1984).
function crosses(way, box) {
  let from = 0, to = 1;
  const cut = (start, step, low, high) => {
    if (step === 0) return start > low && start < high;
    const a = (low - start) / step, b = (high - start) / step;
    from = Math.max(from, Math.min(a, b));
    to = Math.min(to, Math.max(a, b));
    return from < to;
  };
  return cut(way.x0, way.x1 - way.x0, box.x0, box.x1) && cut(way.y0, way.y1 - way.y0, box.y0, box.y1);
}

// Upper bound of the width of a text, in the widest of the usual sans-serif fonts: DejaVu Sans, rounded up.
function textWidth(words, size) {
  let width = 0;
  for (const c of words) {
    width += " .,:;'|!()[]/ijlftr-".includes(c) ? 0.42 : "mwMW%@".includes(c) ? 1 : c >= "A" && c <= "Z" ? 0.78 : 0.65;
  }
  return width * size;
}

// The place for the label of each marker, a request {x, y, width, height}: as near as possible, without overlap with
// another label, a marker, a lead line or the frame's edge, and with lines of `avoided` only if there is no free place
// nearby. Earlier requests have priority. A place is {box, lead}: lead is the line to a distant label, or null. Null for
// a request without width and if no place is free.
function placeLabels(wishes, frame, avoided = []) {
  const markerHalf = 6, gap = 2, texts = [], leads = [];

  function free(wish, {box, lead}) {
    const wide = grown(box, gap);
    if (!contains(frame, box) || texts.some((b) => meets(wide, b)) || leads.some((l) => crosses(l, wide))) return false;
    for (const other of wishes) {
      if (meets(box, around(other, markerHalf))) return false;
      const same = other.x === wish.x && other.y === wish.y;
      if (lead && !same && crosses(lead, around(other, markerHalf / 2))) return false;
    }
    return !lead || !texts.some((b) => crosses(lead, b));
  }

  // A label whose nearest point has this distance and angle from the marker.
  function placeAt({x, y, width, height}, distance, angle) {
    const dx = Math.cos(angle), dy = Math.sin(angle);
    const x0 = x + distance * dx + (dx - 1) / 2 * width, y0 = y + distance * dy + (dy - 1) / 2 * height;
    const box = {x0, y0, x1: x0 + width, y1: y0 + height};
    const lead = {x0: x, y0: y, x1: clamped(x, box.x0, box.x1), y1: clamped(y, box.y0, box.y1)};
    return {box, lead: distance > 14 ? lead : null};
  }

  function nearest(wish, farthest, accept) {
    // Right, left, above, below, then between them: eighths of a turn.
    const angles = [0, 4, -2, 2, -1, 1, -3, 3, 0.5, -0.5, 3.5, 4.5, 1.5, -1.5, 2.5, -2.5];
    for (const distance of [9, 14, 20, 28, 38, 50, 64, 80, 100, 124].filter((d) => d <= farthest)) {
      for (const angle of angles) {
        const place = placeAt(wish, distance, angle * Math.PI / 4);
        if (free(wish, place) && accept(place)) return place;
      }
    }
    return null;
  }

  const offLines = ({box}) => !avoided.some((l) => crosses(l, grown(box, gap)));
  return wishes.map((wish) => {
    const place = wish.width > 0 ? nearest(wish, 28, offLines) ?? nearest(wish, 124, () => true) : null;
    if (place) texts.push(place.box);
    if (place?.lead) leads.push(place.lead);
    return place;
  });
}

// ---- the plot

const markerStyles = 7;

// The marker of a series: shapes distinguish series of the same color.
function marker(series, filled, x, y) {
  const shape = series % markerStyles, r = filled ? 5.5 : 4.5, d = 1.25 * r;
  const type = `m s${shape}${filled ? " on" : ""}`;
  if (shape === 0) return svg("circle", {class: type, cx: x, cy: y, r});
  const corners = [
    [[-r, -r], [r, -r], [r, r], [-r, r]],
    [[0, -d], [d, 0], [0, d], [-d, 0]],
    [[0, -d], [d, r], [-d, r]],
    [[0, d], [d, -r], [-d, -r]],
    [[-d, 0], [-r / 2, -d], [r / 2, -d], [d, 0], [r / 2, d], [-r / 2, d]],
    [[-r, -d], [0, -r / 2], [r, -d], [r, d], [0, r / 2], [-r, d]],
  ][shape - 1];
  return path(type, "M" + corners.map(([dx, dy]) => at(x + dx, y + dy)).join("L") + "Z");
}

const canDraw = ({time, error}) => time > 0 && Number.isFinite(time) && error >= 0 && Number.isFinite(error);

// {title, errorAxis, points, hasFront, connected} as an <svg>; null if no point can be drawn. Points are {time, error,
// series, label, about, onFront}: the error 0 is drawn in a separate band under the axis, a point without an error or
// with an infinite one is not drawn; the label is beside the point, "" for none; `about` is its tooltip. Each series has
// a color and a marker, repeated after seven, and several series have a legend. With `hasFront` a stepped line connects
// the points on the Pareto front, which alone are filled; with `connected` a line connects the points of each series, in
// their order.
function scatter({title, errorAxis, points: all, hasFront = false, connected = false}) {
  const width = 760, plotHeight = 360, band = 30, left = 78, right = 20, bottom = 54, legendLine = 22, labelSize = 12;
  const names = [...new Set(all.map((p) => p.series))];
  const points = all.filter(canDraw);
  if (points.length === 0) return null;

  const drawn = [];
  let legendHeight = 0;
  if (names.length > 1) {
    let x = left, y = legendLine / 2;
    names.forEach((name, i) => {
      const room = 26 + textWidth(name, labelSize);
      if (x + room > width && x > left) [x, y] = [left, y + legendLine];
      drawn.push(marker(i, true, x + 7, y), text("label", x + 18, y + 4, labelSize, "start", name));
      x += room;
    });
    legendHeight = y + legendLine / 2;
  }

  // The frame of the axes, without the band for 0.
  const errors = points.map((p) => p.error).filter((e) => e > 0), hasZero = errors.length < points.length;
  const frame = {x0: left, y0: legendHeight + 8, x1: width - right, y1: legendHeight + 8 + plotHeight};
  const ground = frame.y1 + (hasZero ? band : 0);
  const timeAxis = logAxis(points.map((p) => p.time)), errorsAxis = logAxis(errors.length > 0 ? errors : [1e-3, 1]);
  const xOf = (time) => frame.x0 + (frame.x1 - frame.x0) * timeAxis.place(time);
  const yOf = (error) =>
      error === 0 ? frame.y1 + band / 2 : frame.y1 + (frame.y0 - frame.y1) * errorsAxis.place(error);
  for (const {value, label} of timeAxis.ticks) {
    drawn.push(line(label ? "grid main" : "grid", xOf(value), frame.y0, xOf(value), ground));
    if (label) drawn.push(text("tick", xOf(value), ground + 18, 12, "middle", label));
  }
  for (const {value, label} of errorsAxis.ticks) {
    drawn.push(line(label ? "grid main" : "grid", frame.x0, yOf(value), frame.x1, yOf(value)));
    if (label) drawn.push(text("tick", frame.x0 - 8, yOf(value) + 4, 12, "end", label));
  }
  if (hasZero) {
    drawn.push(line("break", frame.x0, frame.y1, frame.x1, frame.y1),
               text("tick", frame.x0 - 8, yOf(0) + 4, 12, "end", "0"));
  }
  const middle = (frame.y0 + frame.y1) / 2;
  drawn.push(path("frame", `M${at(frame.x0, frame.y0)}V${coordinate(ground)}H${coordinate(frame.x1)}`),
             text("axis", (frame.x0 + frame.x1) / 2, ground + 42, 13, "middle", "time, ns/pixel, one thread"),
             text("axis", 16, middle, 13, "middle", errorAxis, {transform: `rotate(-90 ${at(16, middle)})`}));

  const avoided = [];  // lines that labels should not cover
  const front = hasFront ? points.filter((p) => p.onFront).sort((a, b) => a.time - b.time || a.error - b.error) : [];
  if (front.length > 0) {
    let x = xOf(front[0].time), y = frame.y0, way = "M" + at(x, y);
    for (const p of front) {
      const toX = xOf(p.time), toY = yOf(p.error);
      way += `H${coordinate(toX)}V${coordinate(toY)}`;
      avoided.push({x0: x, y0: y, x1: toX, y1: y}, {x0: toX, y0: y, x1: toX, y1: toY});
      [x, y] = [toX, toY];
    }
    avoided.push({x0: x, y0: y, x1: frame.x1, y1: y});
    drawn.push(path("front", way + "H" + coordinate(frame.x1)));
  }
  for (const [i, name] of connected ? names.entries() : []) {
    const stops = points.filter((p) => p.series === name).map((p) => at(xOf(p.time), yOf(p.error)));
    if (stops.length > 0) drawn.push(path(`link s${i % markerStyles}`, "M" + stops.join("L")));
  }
  for (const p of points) {
    const filled = !hasFront || p.onFront;
    drawn.push(svg("g", {}, svg("title", {}, p.about),
                   marker(names.indexOf(p.series), filled, xOf(p.time), yOf(p.error))));
  }

  // Labels of the front have priority.
  const order = [...front, ...points.filter((p) => !front.includes(p))];
  const wishes = order.map((p) =>
      ({x: xOf(p.time), y: yOf(p.error), width: textWidth(p.label, labelSize), height: 15}));
  const places = placeLabels(wishes, {x0: frame.x0 + 2, y0: frame.y0, x1: frame.x1, y1: ground - 1}, avoided);
  places.forEach((place, i) => {
    if (!place) return;
    const {box, lead} = place, {x} = wishes[i];
    if (lead) drawn.push(line("lead", lead.x0, lead.y0, lead.x1, lead.y1));
    // Aligned towards the marker, because the true width is smaller than the reserved width.
    const [from, anchor] = box.x1 <= x + 1 ? [box.x1, "end"] : box.x0 >= x - 1 ? [box.x0, "start"]
        : [(box.x0 + box.x1) / 2, "middle"];
    drawn.push(text("label", from, box.y0 + 11.5, labelSize, anchor, order[i].label));
  });

  const height = ground + bottom;
  return svg("svg", {class: "plot", role: "img", viewBox: "0 0 " + at(width, height), width, height,
                     "aria-label": title}, svg("title", {}, title), ...drawn);
}

// The plot as a figure; empty if no point can be drawn.
function plotFigure(plot, ...caption) {
  const drawn = scatter(plot);
  return drawn ? element("figure", {class: "chart"}, element("div", {class: "scroll"}, drawn),
                         element("figcaption", {}, ...caption)) : [];
}

// The legend of heat maps: a ramp from 10^-decades to 1.
function heatLegend({decades, colors}) {
  const left = 24, width = 320, stops = colors.map((rgb, i) =>
      svg("stop", {offset: String(i / (colors.length - 1)), "stop-color": `rgb(${rgb})`}));
  const marks = [];
  for (let i = 0; i <= decades; ++i) {
    const x = left + width * i / decades;
    marks.push(line("frame", x, 12, x, 18), text("tick", x, 32, 12, "middle", tickNumber(1, i - decades)));
  }
  const drawn = svg("svg", {role: "img", "aria-label": "color scale", viewBox: `0 0 ${2 * left + width} 38`,
                            width: 2 * left + width, height: 38},
                    svg("defs", {}, svg("linearGradient", {id: "heat"}, ...stops)),
                    svg("rect", {x: left, y: 0, width, height: 12, fill: "url(#heat)"}), ...marks);
  return element("figure", {class: "legend"}, drawn, element("figcaption", {},
      "largest |difference| of the three channels, white = 1; beyond the ends as at the ends, NaN and infinity " +
      "magenta"));
}
