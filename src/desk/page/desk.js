// The page: the wanted picture, the shown picture, and the requests from one to the other.

import * as api from "./api.js";
import {CommandDialog, SaveDialog} from "./dialogs.js";
import {byId, element, short} from "./dom.js";
import {History} from "./history.js";
import {Looks} from "./look.js";
import {Notes} from "./notes.js";
import {Panel} from "./panel.js";
import {Pictures} from "./pictures.js";
import {PixelNumbers} from "./pixel.js";
import {Timeline} from "./timeline.js";
import {View} from "./view.js";

const slow = 300;    // ms: if a full picture takes longer, one of half size comes first
const stillness = 300;  // ms without a move: a drag counts as ended

const desk = await api.describe().catch((error) => {
  byId("gone").hidden = !(error instanceof api.Gone);
  byId("note").textContent = error.message;
  throw error;
});
const looks = new Looks(desk);
const notes = new Notes();

// Kept over a reload of the page.
const kept = JSON.parse(sessionStorage.getItem(location.pathname) ?? "null");
const keep = () => sessionStorage.setItem(location.pathname, JSON.stringify(history.now));

// ---- the wanted picture

const history = new History(kept ?? {look: desk.start, set: desk.set});
const options = {show: "picture", exposure: 0, display: desk.displays[0], against: ""};  // against: "", "dry", "reference" or "look NAME"
let isLive = false, ended = Promise.resolve(), endLive = () => {}, liveTimer;

const madeOf = () => ({...history.now, ...timeline.at});
const shownBy = () => ({exposure: options.exposure, display: options.display});
const wanted = () => ({...madeOf(), show: options.show, ...shownBy()});

// The picture left of the wipe; null without a wipe.
function wantedOther() {
  const {against} = options;
  if (!against) return null;
  if (against.startsWith("look ")) return {look: against.slice(5), set: {}, ...timeline.at, show: "picture", ...shownBy()};
  return {look: desk.start, set: {}, ...timeline.at, show: against, ...shownBy()};
}

// During a drag pictures have half size; after it, or when the pointer rests, the full picture is made.
function live(on) {
  clearTimeout(liveTimer);
  if (on) {
    if (!isLive) ended = new Promise((done) => { endLive = done; });
    liveTimer = setTimeout(() => { live(false); pictures.wake(); }, stillness);
  }
  isLive = on;
  if (!on) endLive();
}

function changed(isDragged = false) {
  live(isDragged);
  if (!isDragged) history.settle();
  stuck = null;
  notes.bad = "";
  keep();
  drawControls();
  pictures.wake();
}

function change(key, value, isDragged) {
  history.replace({...history.now, set: looks.with(history.now.set, key, value)});
  changed(isDragged);
}

// ---- the shown picture

const drawn = {key: null, half: false, other: null};
let good = null;       // the state of the last picture made
let stuck = null;      // the refused request, if there is no earlier state
let isGone = false;
const watching = [];   // callbacks for the next picture
let fullTime = desk.size[0] * desk.size[1] * 3e-4;  // ms for the last full picture, initially a guess

const pictures = new Pictures(() => {
  const job = isGone ? null : nextJob();
  document.body.toggleAttribute("data-busy", job !== null);
  return job;
}, () => numbers.isRunning);

function nextJob() {
  const request = wanted(), key = JSON.stringify(request), isNew = key !== drawn.key;
  if (key === stuck) return null;
  const hurries = isLive || timeline.plays;
  if (isNew && (hurries || Math.max(fullTime, pictures.running) > slow)) return pictureJob(request, key, true);
  if (hurries) return null;
  if (isNew || drawn.half) return pictureJob(request, key, false);
  const other = wantedOther(), otherKey = JSON.stringify(other);
  return other === null || otherKey === drawn.other || otherKey === stuck ? null : otherJob(other, otherKey);
}

function pictureJob(request, key, half) {
  const state = history.now, begun = performance.now();
  return {
    request: {...request, half},
    done(picture) {
      if (!half) fullTime = performance.now() - begun;
      view.show(picture);
      Object.assign(drawn, {key, half});
      good = state;
      if (!half) {
        notes.notes = [...desk.warnings, ...picture.warnings, ...picture.advice];
        numbers.again();
      }
      panel.planned(picture);
      tellCost(picture);
      tellShown(request.show, picture.scale);
      for (const tell of watching.splice(0)) tell({half, asked: begun});
    },
    failed: (error) => failed(error, key, state),
  };
}

function otherJob(request, key) {
  return {
    request: {...request, half: false},
    done(picture) {
      view.showOther(picture);
      drawn.other = key;
    },
    failed: (error) => failed(error, key, null),
  };
}

// Shows a refusal until the next change, and restores the state before it. If the refused state had a picture before, no
// setting is at fault: no further request until something changes.
function failed(error, key, state) {
  if (error instanceof api.Gone) {
    isGone = true;
    byId("gone").hidden = false;
    return;
  }
  // The request is outdated: a newer one reports its own error.
  if (key !== JSON.stringify(wanted()) && key !== JSON.stringify(wantedOther())) return;
  notes.bad = error.message;
  if (state === history.now && state !== good) {
    history.forget();
    live(false);
    keep();
    drawControls();
    panel.again(history.now);
  }
  // There is no earlier state.
  if (state === null || state === history.now) stuck = key;
}

function tellCost({milliseconds, half, wet}) {
  const {all, ...parts} = milliseconds;
  const rounded = (ms) => ms < 10 ? ms.toFixed(1) : Math.round(ms);
  const words = Object.entries(parts).filter(([, ms]) => ms >= 0.05).sort(([, a], [, b]) => b - a)
      .map(([name, ms]) => `${name} ${rounded(ms)}`);
  byId("cost").textContent = `${half ? "half size, " : ""}${rounded(all)} ms: ${words.join(", ")}`;
  byId("cost").title = `${words.join(" ms\n")} ms\nsum of all threads, on ${desk.runner}; ` +
      `${(100 * wet).toFixed(1)} % of the pixels are wet`;
}

// The description of an AOV that replaces the picture, and the values of its colors.
function tellShown(show, scale) {
  const {about} = desk.shows.find(({name}) => name === show);
  const ends = scale ? `; darkest ${short(scale[0])}, brightest ${short(scale[1])}` : "";
  byId("shown").textContent = `${show}: ${about ?? ""}${ends}`;
  byId("shown").hidden = show === "picture";
}

// ---- the parts of the page

const view = new View((at) => numbers.point(at, at && view.seen(at.x, at.y)));
const timeline = new Timeline(desk, (at, isScrubbed) => changed(isScrubbed));
const numbers = new PixelNumbers(wanted, idle);
const panel = new Panel(desk, looks, {
  change,
  back(key) {
    history.replace({...history.now, set: looks.without(history.now, key)});
    changed();
  },
  bad(sentence) { notes.bad = sentence; },
});
const saveDialog = new SaveDialog(desk.folder, () => history.now);
const commandDialog = new CommandDialog(madeOf);

function drawControls() {
  const {now} = history;
  panel.show(now);
  byId("look").value = now.look;
  byId("undo").disabled = !history.canUndo;
  byId("redo").disabled = !history.canRedo;
}

function undo() { history.undo(); changed(); }
function redo() { history.redo(); changed(); }

function expose(isDragged) {
  options.exposure = Number(byId("exposure").value);
  byId("exposure_text").textContent = `${options.exposure > 0 ? "+" : ""}${options.exposure}`;
  changed(isDragged);
}

function wipeWith(against) {
  options.against = byId("against").value = against;
  view.wipes = against !== "";
  byId("wipe_left").textContent = byId("against").selectedOptions[0].textContent;
  changed();
}

function showNumbers() {
  const isOn = byId("pixel_box").hidden;
  byId("pixel_box").hidden = !isOn;
  byId("numbers").setAttribute("aria-pressed", isOn);
}

function on(id, event, act) {
  byId(id).addEventListener(event, act);
}

// A new look begins without settings; undo brings them back.
on("look", "change", ({target}) => { history.replace({look: target.value, set: {}}); changed(); });
on("show", "change", ({target}) => {
  options.show = target.value;
  byId("wipe_right").textContent = target.value;
  changed();
});
on("against", "change", ({target}) => wipeWith(target.value));
on("display", "change", ({target}) => { options.display = target.value; changed(); });
on("exposure", "input", () => expose(true));
on("exposure", "change", () => expose(false));
on("exposure", "dblclick", () => { byId("exposure").value = 0; expose(false); });
on("fit", "click", () => view.fit());
on("full", "click", () => view.zoomTo(1));
on("undo", "click", undo);
on("redo", "click", redo);
on("numbers", "click", showNumbers);
on("save", "click", () => saveDialog.open());
on("command", "click", () => commandDialog.open());
on("try_again", "click", () => {
  isGone = false;
  byId("gone").hidden = true;
  pictures.wake();
});

const keys = {
  "1": () => view.zoomTo(1), "f": () => view.fit(), "+": () => view.zoomBy(2 ** 0.5), "-": () => view.zoomBy(2 ** -0.5),
  "w": () => wipeWith(options.against ? "" : "dry"), "i": showNumbers, "/": () => byId("search").focus(),
  " ": () => timeline.toggle(),
};
const keysWithCtrl = {"z": undo, "Z": redo, "y": redo, "s": () => saveDialog.open()};

// Text inputs keep the keys typed into them, buttons their space bar.
document.addEventListener("keydown", (event) => {
  const {target, key} = event, withCtrl = event.ctrlKey || event.metaKey;
  if (document.querySelector("dialog[open]") || event.altKey) return;
  const isText = target.matches("input[type=text], input[type=search]");
  const isTyped = isText && (!withCtrl || (key !== "s" && target.value !== target.defaultValue));
  if (isTyped || (!withCtrl && target.matches("select")) || (key === " " && target.matches("button, summary, input"))) {
    return;
  }
  const act = (withCtrl ? keysWithCtrl : keys)[withCtrl && event.shiftKey ? key.toUpperCase() : key];
  if (!act) return;
  event.preventDefault();
  act();
});

// ---- the first picture

document.title = `${desk.plate} - limpid`;
const lookOptions = (label, isPreset, valueOf) => {
  const options = desk.looks.filter(({preset}) => preset === isPreset)
      .map(({name, about}) => element("option", {value: valueOf(name), title: about}, name));
  return options.length ? [element("optgroup", {label}, ...options)] : [];
};
byId("look").append(...lookOptions("looks", false, (name) => name), ...lookOptions("presets", true, (name) => name));
byId("show").append(...desk.shows.map(({name, about}) => element("option", {value: name, title: about}, name)));
byId("against").append(element("option", {value: ""}, "nothing"),
    ...desk.shows.filter(({name}) => name === "dry" || name === "reference")
        .map(({name}) => element("option", {value: name}, name)),
    ...lookOptions("looks", false, (name) => "look " + name), ...lookOptions("presets", true, (name) => "look " + name));
byId("display").append(...desk.displays.map((name) => element("option", {value: name}, name)));
byId("display_label").hidden = desk.displays.length === 1;
byId("wipe_right").textContent = options.show;
view.resize(...desk.size);
view.wipes = false;
notes.notes = desk.warnings;
drawControls();
pictures.wake();

// Waits until the wanted picture is shown at full size, or cannot be made.
async function idle() {
  for (;;) {
    await pictures.idle();
    if (isGone || (!isLive && nextJob() === null)) return;
    await ended;
    pictures.wake();
  }
}

// For scripts and tests that drive the page.
window.desk = {
  idle,
  set: (key, value) => change(key, value, false),
  pixels: () => view.pixels(),
  next: () => new Promise((tell) => watching.push(tell)),  // picture, of half or full size
  get state() { return history.now; },
  get asked() { return pictures.asked; },
  get broken() { return pictures.broken; },
  get isGone() { return isGone; },
};
