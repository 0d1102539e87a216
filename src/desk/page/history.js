// Undo and redo of an immutable value. A drag replaces it many times per second: that is one step, which ends with
// settle().

export class History {
  #past = [];
  #future = [];
  #settled;

  constructor(now) {
    this.now = this.#settled = now;
  }

  get canUndo() { return this.#past.length > 0 || this.now !== this.#settled; }
  get canRedo() { return this.#future.length > 0; }

  // Without a step, for a drag.
  replace(value) {
    this.now = value;
  }

  // Makes one step of all replacements since the last step.
  settle() {
    if (this.now === this.#settled) return;
    this.#past.push(this.#settled);
    this.#future = [];
    this.#settled = this.now;
  }

  undo() {
    this.settle();
    this.#move(this.#past, this.#future);
  }

  redo() {
    this.settle();
    this.#move(this.#future, this.#past);
  }

  // Removes an invalid value: returns to the value before it, without a redo. The first value stays.
  forget() {
    if (this.now === this.#settled) this.#settled = this.#past.pop() ?? this.#settled;
    this.now = this.#settled;
  }

  #move(from, to) {
    if (from.length === 0) return;
    to.push(this.now);
    this.now = this.#settled = from.pop();
  }
}
