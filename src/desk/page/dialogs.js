// Saving the look, and the command line that makes the same picture.

import * as api from "./api.js";
import {byId} from "./dom.js";

// `request` returns {look, set} of the look to be saved.
export class SaveDialog {
  #dialog = byId("save_dialog");
  #name = byId("save_name");
  #told = byId("save_told");
  #replace = byId("save_replace");
  #request;

  constructor(folder, request) {
    this.#request = request;
    byId("save_folder").textContent = folder;
    byId("save_form").addEventListener("submit", (event) => {
      event.preventDefault();
      this.#save(event.submitter === this.#replace);
    });
    this.#name.addEventListener("input", () => this.#tell(""));
    byId("save_close").addEventListener("click", () => this.#dialog.close());
  }

  open() {
    this.#tell("");
    this.#dialog.showModal();
    this.#name.select();
  }

  async #save(replace) {
    const typed = this.#name.value.trim(), name = typed.endsWith(".toml") ? typed : typed + ".toml";
    try {
      const {saved} = await api.save({...this.#request(), name, replace});
      this.#tell(`Saved: ${saved}. Use it by --look.`);
    } catch (error) {
      this.#tell(error.message, error.status === 409);
    }
  }

  #tell(sentence, isThere = false) {
    this.#told.textContent = sentence;
    this.#replace.hidden = !isThere;
  }
}

// `request` returns {look, set, frame, time} of the picture.
export class CommandDialog {
  #dialog = byId("command_dialog");
  #text = byId("command_text");
  #told = byId("command_told");
  #request;

  constructor(request) {
    this.#request = request;
    byId("command_copy").addEventListener("click", () => this.#copy());
    byId("command_close").addEventListener("click", () => this.#dialog.close());
  }

  async open() {
    this.#text.value = "";
    this.#told.textContent = "";
    this.#dialog.showModal();
    try {
      this.#text.value = (await api.command(this.#request())).command;
      this.#text.select();
      await this.#copy();
    } catch (error) {
      this.#told.textContent = error.message;
    }
  }

  // A browser may deny access to the clipboard; then the text is selected for copying by keyboard.
  async #copy() {
    this.#text.select();
    try {
      await navigator.clipboard.writeText(this.#text.value);
      this.#told.textContent = "Copied.";
    } catch {
      this.#told.textContent = "Press Ctrl+C to copy.";
    }
  }
}
