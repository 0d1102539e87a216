// The page of a shot, from its report.json: a wipe between any two of its pictures, and tables.

import {byId} from "./dom.js";
import {Stage} from "./stage.js";

const groups = {
  pictures: "pictures", aovs: "AOVs", without: "without an operator", differences: "differences",
};
const pictureOf = (file) => report.pictures.find((picture) => picture.file === file);
const hasTruth = report.truth !== null;

// ---- the wipe

const stage = new Stage((at) => { byId("at").textContent = at ? `${at.x}, ${at.y}` : ""; }, (event) => event.ctrlKey);
const sides = {left: {image: byId("other"), word: byId("wipe_left")}, right: {image: byId("picture"), word: byId("wipe_right")}};

function scaleText({scale}) {
  return scale === null ? "" : `${shortNumber(scale[0])} ... ${shortNumber(scale[1])}`;
}

function show(side, file) {
  const {image, word} = sides[side], picture = pictureOf(file);
  byId(side).value = file;
  image.src = file;
  word.textContent = picture.name;
  const texts = Object.keys(sides).map((one) => {
    const {name, about, ...rest} = pictureOf(byId(one).value || file), scale = scaleText(rest);
    return `${name}: ${about}${scale && ", " + scale}`;
  });
  byId("shown").textContent = `Left ${texts[0]}. Right ${texts[1]}.`;
}

function fillSides() {
  for (const side of Object.keys(sides)) {
    byId(side).append(...Object.entries(groups).map(([group, label]) => element("optgroup", {label},
        ...report.pictures.filter((picture) => picture.group === group).map(({file, name}) =>
            element("option", {value: file}, name)))));
    byId(side).addEventListener("change", ({target}) => show(side, target.value));
  }
  byId("left").value = "dry.png";
  show("right", "wet.png");
  show("left", "dry.png");
}

function see(file) {
  show("right", file);
  byId("wipe").scrollIntoView();
}

function startStage() {
  byId("stage").style.aspectRatio = `${report.width} / ${report.height}`;
  stage.resize(report.width, report.height);
  stage.wipes = true;
  byId("fit").addEventListener("click", () => stage.fit());
  byId("full").addEventListener("click", () => stage.zoomTo(1));
  byId("stage").addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const act = {f: () => stage.fit(), 1: () => stage.zoomTo(1), "+": () => stage.zoomBy(2), "=": () => stage.zoomBy(2),
                 "-": () => stage.zoomBy(1 / 2)}[event.key];
    act?.();
  });
}

// ---- pictures below the wipe

function figureOf(file) {
  const picture = pictureOf(file), scale = scaleText(picture);
  const image = element("img", {
    alt: picture.name, width: report.width, height: report.height, loading: "lazy", decoding: "async", src: file});
  const button = element("button", {type: "button", title: "Show it to the right of the wipe"}, image);
  button.addEventListener("click", () => see(file));
  return element("figure", {}, button, element("figcaption", {}, element("b", {}, picture.name),
      `: ${picture.about}${scale && ", " + scale}`));
}

function gallery(name, files) {
  document.querySelector(`[data-gallery="${name}"]`).append(...files.map(figureOf));
}

function link(text, file) {
  const made = element("a", {class: "see", role: "button", tabindex: "0"}, text);
  made.addEventListener("click", () => see(file));
  made.addEventListener("keydown", (event) => { if (event.key === "Enter") see(file); });
  return made;
}

// ---- tables

const errorColumns = (beside) => [number("mean", beside), number("99.99 %", beside), number("max", beside), number("FLIP", beside)];
const errorCells = (row) => [row?.error.mean ?? null, row?.error.p99_99 ?? null, row?.error.max ?? null, row?.flip ?? null];
const truthColumns = hasTruth ? [number("of the wet", "truth"), number("mean", "truth"), number("SSIM", "truth"), number("FLIP", "truth")] : [];
const truthCells = (row) => !hasTruth ? [] : [
  percent(row?.relative_error_wet ?? NaN, 1), row?.error.mean ?? null, row?.ssim ?? null, row?.flip ?? null];

function lookTable() {
  const own = report.looks[0].milliseconds, pixels = report.width * report.height;
  const rows = report.looks.map((row, i) => ({
    cells: [shown(null, link(row.look, row.picture)), row.milliseconds, row.milliseconds * 1e6 / pixels,
            percent(row.milliseconds / own), ...errorCells(row.beside_shot), ...truthCells(row.beside_truth)],
    marked: i === 0,
  }));
  rows.push({cells: [shown(null, link("dry", report.dry.picture)), null, null, percent(NaN), ...errorCells(report.dry.beside_shot),
                     ...truthCells(report.dry.beside_truth)]});
  return table("The shot's own look is highlighted. Differences from it" + (hasTruth ? ", and from the truth." : "."),
      [word("look"), number("time", "ms"), number("time", "ns/pixel"), number("of the shot's", "time"),
       ...errorColumns("difference"), ...truthColumns], rows);
}

function operatorTable() {
  const whole = report.chain_milliseconds;
  const rows = report.operators.map((row) => {
    if (!row.runs) {
      return {cells: [row.operator, row.planned, ...Array(7 + truthColumns.length).fill(null)]};
    }
    const falls = row.falls_with_it.length > 0 ? "; without it these do not run: " + row.falls_with_it.join(", ") : "";
    return {cells: [shown(null, link(row.operator, row.picture)), row.planned + falls, row.milliseconds,
                    row.milliseconds_without, percent(1 - row.milliseconds_without / whole),
                    ...errorCells(row.without_beside_shot), ...truthCells(row.without_beside_truth)]};
  });
  return table(
      `The look ${report.looks[0].look} takes ${shortNumber(whole)} ms. Saved: the share of that time saved without the ` +
      "operator." + (hasTruth ? " Truth: the picture without it against the truth." : ""),
      [word("operator"), long("planner"), number("in it", "ms, sum of threads"), number("without it", "ms"),
       number("saved", "of the time"), ...errorColumns("change"), ...truthColumns], rows);
}

function facts(entries) {
  return entries.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]);
}

// ---- the most important numbers

function summary() {
  const {looks: [own], fast, settings: {threads}, off_frame, confidence} = report, items = [];
  const item = (...children) => items.push(element("li", {}, ...children));
  item("The look ", code(own.look), " takes ", element("b", {}, shortNumber(own.milliseconds) + " ms"),
      ` on ${threads} ${threads === 1 ? "thread" : "threads"} (${report.width}x${report.height}, ` +
      `${percent(report.wet_share).text} wet, ${report.settings.simd}).`);
  if (fast) {
    item(code("fast"), " takes ", element("b", {}, percent(fast.time_share).text), " of the time of ", code("physical"),
        `; its picture differs by ${shortNumber(fast.beside_physical.error.mean)} in the mean (white = 1), FLIP ` +
        `${shortNumber(fast.beside_physical.flip)}.`);
  }
  if (hasTruth) {
    item("Against ", code(report.truth), " the water reduces the error of the wet pixels from ",
        element("b", {}, percent(report.dry.beside_truth.relative_error_wet, 1).text), " (dry) to ",
        element("b", {}, percent(own.beside_truth.relative_error_wet, 1).text), ".");
  }
  item(`${percent(confidence.guessed_share_of_wet ?? NaN, 1).text} of the wet pixels show a guess through the water; ` +
      off_frame.advice + ".");
  for (const warning of report.warnings) item(element("b", {}, "Warning: "), warning + ".");
  return items;
}

function offFrameFacts() {
  const {off_frame: {share_of_wet, overscan: {left, right, top, bottom}}, confidence} = report;
  return facts([
    ["off-frame lookups", `${percent(share_of_wet, 1).text} of the wet pixels`],
    ["overscan that would show them", `${left} pixels on the left, ${right} on the right, ${top} at the top, ${bottom} at the bottom`],
    ["confidence, mean of the wet", shortNumber(confidence.mean_of_wet)],
    ["guessed (confidence below 0.5)", `${percent(confidence.guessed_share_of_wet ?? NaN, 1).text} of the wet pixels`],
  ]);
}

// ---- the page

const {made, build, machine, settings} = report, plate = report.plate.length > 1 && report.scene ? report.scene : report.plate.join(", ");
const where = machine.processor + ", " + machine.cores + " cores";
document.title = `${plate}, ${report.look} - limpid`;
fill("title", `${plate} with the look ${report.look}`);
fill("made", [made, "limpid " + build.limpid, where, ...(report.scene ? [report.scene] : []),
              `${plainNumber(report.time_s)} s`].join(", "));
fill("summary", ...summary());
fillSides();
startStage();
put("heat_legend", () => heatLegend(report.heat_scale));
gallery("aovs", report.pictures.filter(({group}) => group === "aovs").map(({file}) => file));
fill("off_frame", ...offFrameFacts());
put("look_table", lookTable);
fill("differs", ...facts(report.looks.filter(({differs}) => differs.length > 0).map(({look, differs}) =>
    [look, differs.join("; ")])));
gallery("looks", [...report.looks.slice(1).flatMap(({picture}) => [picture, picture.replace(".png", "_difference.png")]),
                  ...(hasTruth ? ["truth.png", "truth_difference.png"] : [])]);
put("operator_table", operatorTable);
gallery("operators", report.operators.filter(({runs}) => runs).map(({difference}) => difference));
put("rounds", () => String(settings.rounds));
fill("machine", ...facts(Object.entries({
  plate: report.plate.join(", "),
  processor: machine.processor, cores: machine.cores, "instruction set": settings.simd,
  system: `${machine.system}, kernel ${machine.kernel}`, limpid: build.limpid,
  compiler: `${build.compiler}, build type ${build.type}`, libraries: build.libraries, rounds: settings.rounds,
  threads: settings.threads, "samples per pixel": settings.samples,
}).map(([name, value]) => [name, String(value)])));
